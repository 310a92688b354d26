//! The lobes of a surface at a point: what they scatter, and how directions are sampled in them.

use glam::DVec3;
use smallvec::SmallVec;

use super::models::Models;
use super::surface::{SheenAt, Surface};
use crate::math::sine;
use crate::models::{Bsdf, Ggx, Schlick};
use crate::scene::{Layering, Lobes as Wanted, SheenModel};
use crate::table::{Ltc, SheenTable};

/// A lobe as it is seen from `wi`.
pub(super) struct Lobe<'a> {
    /// By which its density, or its model, is multiplied.
    pub color: DVec3,
    /// The transformed cosine that it is, or that resembles it: lights are sampled by it.
    pub ltc: Ltc,
    /// It scatters light much as that cosine does. Earlier models do not: for them lights are sampled by the plain
    /// cosine too.
    pub is_near: bool,
    /// Under the layer of fibres.
    is_base: bool,
    shape: Shape<'a>,
}

enum Shape<'a> {
    /// The transformed cosine itself.
    Ltc,
    Model(&'a dyn Bsdf),
    /// Microfacets, a reflectance for each channel.
    Facets(&'a Ggx, [Schlick; 3]),
}

impl Lobe<'_> {
    /// The share of light that it scatters to a view of cosine `mu`.
    pub fn albedo(&self, mu: f64) -> DVec3 {
        match &self.shape {
            Shape::Ltc => self.color,
            Shape::Model(model) => self.color * model.albedo(mu.min(1.0)),
            Shape::Facets(facets, schlick) => self.color * facets.albedo_channels(mu.min(1.0), schlick),
        }
    }
}

/// All lobes of a surface that scatter as functions; the random walk through the fibres stands apart.
pub(super) struct Lobes<'a> {
    pub lobes: SmallVec<[Lobe<'a>; 3]>,
    pub wi: DVec3,
    /// Of the reciprocal rule: the sheen, its strongest channel, and what is left of the base on the view's side.
    reciprocal: Option<(SheenAlbedo<'a>, f64, f64)>,
}

/// What share of light the layer of fibres sends back.
#[derive(Clone, Copy)]
enum SheenAlbedo<'a> {
    /// The table's r at this alpha.
    Table(&'a SheenTable, f64),
    Model(&'a dyn Bsdf),
}

impl SheenAlbedo<'_> {
    fn at(self, mu: f64) -> f64 {
        match self {
            Self::Table(table, alpha) => table.lookup(alpha, mu)[2],
            Self::Model(model) => model.albedo(mu),
        }
    }
}

impl<'a> Lobes<'a> {
    /// Those of the surface's lobes that are wanted, as the view sees them.
    pub fn new(surface: &Surface, models: &'a Models, wanted: Wanted) -> Self {
        let mut found = Self { lobes: SmallVec::new(), wi: surface.wi, reciprocal: None };
        let mu = surface.mu();
        let mut base = 1.0;
        if let Some(at) = &surface.sheen {
            let model = (at.model != SheenModel::Ltc).then(|| models.sheen(surface.material, at));
            let albedo = model.map_or(SheenAlbedo::Table(&models.sheen_table, at.alpha), SheenAlbedo::Model);
            base = found.base_weight(at, albedo, mu);
            if wanted.sheen && at.model != SheenModel::Walk {
                found.add_sheen(at, &models.sheen_table, model, mu);
            }
        }
        found.add_base(surface, models, wanted, base);
        found
    }

    /// Those of the base alone, with nothing on top, as seen from a direction of cosine `mu` and azimuth 0.
    pub fn bare(surface: &Surface, models: &'a Models, wanted: Wanted, mu: f64) -> Self {
        let mut found = Self { lobes: SmallVec::new(), wi: DVec3::new(sine(mu), 0.0, mu), reciprocal: None };
        found.add_base(surface, models, wanted, 1.0);
        found
    }

    fn add(&mut self, lobe: Lobe<'a>) {
        if lobe.color.max_element() > 0.0 && lobe.ltc.a > 0.0 {
            self.lobes.push(lobe);
        }
    }

    /// What the sheen leaves of the base, seen from the view's side.
    fn base_weight(&mut self, at: &SheenAt, albedo: SheenAlbedo<'a>, mu: f64) -> f64 {
        let strongest = at.color.max_element();
        let left = |share: f64| (1.0 - share * albedo.at(mu)).max(0.0);
        match at.layering {
            Layering::Gltf => left(strongest),
            Layering::Reciprocal => {
                self.reciprocal = Some((albedo, strongest, left(strongest)));
                1.0
            }
            Layering::OpenPbr => left(at.weight),
            Layering::Manual(share) => share.into(),
            // The walk goes through both.
            Layering::None | Layering::Walk => 1.0,
        }
    }

    fn add_sheen(&mut self, at: &SheenAt, table: &SheenTable, model: Option<&'a dyn Bsdf>, mu: f64) {
        let [a, b, r] = table.lookup(at.alpha, mu);
        let (color, shape) = match model {
            None => (at.color * r, Shape::Ltc),
            Some(model) => (at.color, Shape::Model(model)),
        };
        let is_near = matches!(at.model, SheenModel::Ltc | SheenModel::Slab | SheenModel::Walk);
        self.add(Lobe { color, ltc: Ltc::sheen(a, b), is_near, is_base: false, shape });
    }

    fn add_base(&mut self, surface: &Surface, models: &'a Models, wanted: Wanted, weight: f64) {
        let mu = self.wi.z.min(1.0);
        let specular = models.specular(surface.material, surface.roughness, mu);
        let Surface { base_color, metallic, f0, f90, .. } = *surface;
        let dielectric = Schlick::channels(f0, DVec3::splat(f90));
        let below = (1.0 - specular.albedo(&dielectric).max_element()).max(0.0);
        if wanted.diffuse {
            let color = weight * (1.0 - metallic) * below * base_color;
            self.add(Lobe { color, ltc: Ltc::COSINE, is_near: true, is_base: true, shape: Shape::Ltc });
        }
        if wanted.specular {
            let metal = f0.lerp(base_color, metallic).clamp(DVec3::ZERO, DVec3::ONE);
            let schlick = Schlick::channels(metal, DVec3::splat(f90 + (1.0 - f90) * metallic));
            let albedo = specular.albedo(&schlick);
            let (color, shape) = match specular.facets {
                None => (weight * albedo, Shape::Ltc),
                Some(facets) if albedo.max_element() > 0.0 => (DVec3::splat(weight), Shape::Facets(facets, schlick)),
                Some(_) => (DVec3::ZERO, Shape::Ltc),
            };
            self.add(Lobe { color, ltc: specular.ltc, is_near: true, is_base: true, shape });
        }
    }

    /// What the reciprocal rule leaves of the base for light of this cosine.
    fn left(&self, mu: f64) -> f64 {
        let rule =
            |(albedo, strongest, left): (SheenAlbedo, f64, f64)| left.min(1.0 - strongest * albedo.at(mu)).max(0.0);
        self.reciprocal.map_or(1.0, rule)
    }

    /// How much a direction sampled in the lobes weighs against one sampled on the lights. Where all lobes are
    /// transformed cosines, sampling the lights finds everything; where they resemble some, nearly everything, and for
    /// large lights samples of the lobes would add noise.
    pub fn weight(&self) -> f64 {
        if self.lobes.iter().all(|lobe| matches!(lobe.shape, Shape::Ltc)) {
            0.0
        } else if self.lobes.iter().all(|lobe| lobe.is_near) {
            0.25
        } else {
            1.0
        }
    }

    /// f_r times the cosine of `wo`, which is unit and above the horizon.
    pub fn evaluate(&self, wo: DVec3) -> DVec3 {
        let left = self.left(wo.z.min(1.0));
        self.lobes
            .iter()
            .map(|lobe| {
                let value = match &lobe.shape {
                    Shape::Ltc => lobe.color * lobe.ltc.density(wo),
                    Shape::Model(model) => lobe.color * model.evaluate(self.wi, wo),
                    Shape::Facets(facets, schlick) => lobe.color * facets.evaluate_channels(self.wi, wo, schlick),
                };
                if lobe.is_base { left * value } else { value }
            })
            .sum()
    }

    /// The share of samples that each lobe gets: by its albedo.
    fn shares(&self) -> impl Iterator<Item = (f64, &Lobe<'a>)> + '_ {
        // No lobe goes without samples.
        let weight = |lobe: &Lobe| lobe.albedo(self.wi.z).max_element().max(1e-3 * lobe.color.max_element());
        let all: f64 = self.lobes.iter().map(weight).sum();
        self.lobes.iter().map(move |lobe| (weight(lobe) / all, lobe))
    }

    /// The density of [`Self::sample`], per steradian.
    pub fn pdf(&self, wo: DVec3) -> f64 {
        let pdf = |lobe: &Lobe| match &lobe.shape {
            Shape::Ltc => lobe.ltc.density(wo),
            Shape::Model(model) => model.pdf(self.wi, wo),
            Shape::Facets(facets, _) => facets.pdf(self.wi, wo),
        };
        self.shares().map(|(share, lobe)| share * pdf(lobe)).sum()
    }

    /// A direction from three uniform numbers in \[0, 1).
    pub fn sample(&self, choice: f64, uniforms: [f64; 2]) -> Option<DVec3> {
        let mut rest = choice;
        let mut chosen = None;
        for (share, lobe) in self.shares() {
            chosen = Some(lobe);
            if rest < share {
                break;
            }
            rest -= share;
        }
        let lobe = chosen?;
        let wo = match &lobe.shape {
            Shape::Ltc => Some(lobe.ltc.sample(uniforms)),
            Shape::Model(model) => model.sample(self.wi, uniforms).map(|sample| sample.wo),
            Shape::Facets(facets, _) => facets.sample(self.wi, uniforms).map(|sample| sample.wo),
        };
        wo.filter(|wo| wo.z > 0.0)
    }

    /// The share of a uniform environment's light that is scattered to the view, with nothing in the way. Under the
    /// reciprocal rule it has no closed form.
    pub fn albedo(&self) -> Option<DVec3> {
        self.reciprocal.is_none().then(|| self.lobes.iter().map(|lobe| lobe.albedo(self.wi.z)).sum())
    }
}
