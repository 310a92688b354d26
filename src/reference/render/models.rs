//! The models of a scene's materials, made once for each roughness that is met.

use std::sync::OnceLock;

use glam::DVec3;

use super::options::SpecularModel;
use super::surface::SheenAt;
use crate::models::{
    Bsdf, Burley, ContyKulla, Ggx, LtcSheen, NeubeltPettineo, Patry, Schlick, SheenWalk, SlabSheen, Terminator,
};
use crate::scene::{Drawn, Material, SheenModel, TextureSlot};
use crate::table::{GgxLobe, GgxTable, Ltc, SheenTable, SlabTable};

/// Textured roughnesses are rounded to this many steps, except for the transformed cosines.
const STEPS: usize = 256;

/// Models by roughness, each made when it is first asked for.
struct Steps<T> {
    made: Vec<OnceLock<T>>,
}

impl<T> Steps<T> {
    /// For one value, or for any in \[0, 1\].
    fn new(is_textured: bool) -> Self {
        Self { made: (0..if is_textured { STEPS + 1 } else { 1 }).map(|_| OnceLock::new()).collect() }
    }

    fn get(&self, value: f64, make: impl FnOnce(f64) -> T) -> &T {
        let last = self.made.len() - 1;
        let step = (value * last as f64).round() as usize;
        let value = if last == 0 { value } else { step as f64 / last as f64 };
        self.made[step.min(last)].get_or_init(|| make(value))
    }
}

struct OfMaterial {
    sheen: Steps<Box<dyn Bsdf + Send + Sync>>,
    walk: Steps<SheenWalk>,
    facets: Steps<Ggx>,
}

/// Everything that lobes are made of.
pub(super) struct Models {
    pub sheen_table: SheenTable,
    ggx_table: GgxTable,
    slab_table: OnceLock<SlabTable>,
    specular: SpecularModel,
    materials: Vec<OfMaterial>,
}

impl Models {
    pub fn new(drawn: &Drawn, sheen_table: &SheenTable, specular: SpecularModel) -> Self {
        let of_material = |material: &Material| {
            let rough = material.texture(TextureSlot::SheenRoughness).is_some();
            let base = material.texture(TextureSlot::MetallicRoughness).is_some();
            OfMaterial { sheen: Steps::new(rough), walk: Steps::new(rough), facets: Steps::new(base) }
        };
        Self {
            sheen_table: sheen_table.clone(),
            ggx_table: GgxTable::embedded(),
            slab_table: OnceLock::new(),
            specular,
            materials: drawn.materials.iter().map(of_material).collect(),
        }
    }

    /// The sheen's model; for the walk, the slab that it walks through. Real time's model at any alpha is
    /// `sheen_table`.
    pub fn sheen(&self, material: usize, at: &SheenAt) -> &dyn Bsdf {
        let make = |alpha: f64| -> Box<dyn Bsdf + Send + Sync> {
            match at.model {
                SheenModel::Ltc => Box::new(LtcSheen::new(&self.sheen_table, alpha)),
                SheenModel::Slab | SheenModel::Walk => {
                    Box::new(SlabSheen::new(self.slab_table.get_or_init(SlabTable::embedded), alpha))
                }
                SheenModel::Burley => Box::new(Burley::new()),
                SheenModel::ContyKulla => Box::new(ContyKulla::new(alpha, Terminator::Physical)),
                SheenModel::NeubeltPettineo => Box::new(NeubeltPettineo::new(alpha)),
                SheenModel::Patry => Box::new(Patry::new(alpha)),
            }
        };
        &**self.materials[material].sheen.get(at.alpha, make)
    }

    /// The walk through the layer of fibres.
    pub fn walk(&self, material: usize, at: &SheenAt) -> &SheenWalk {
        self.materials[material].walk.get(at.alpha, SheenWalk::new)
    }

    pub fn specular(&self, material: usize, roughness: f64, mu: f64) -> SpecularAt<'_> {
        let GgxLobe { ltc, albedo, fresnel } = self.ggx_table.lookup(roughness.clamp(0.0, 1.0), mu.min(1.0));
        if self.specular == SpecularModel::Ltc {
            return SpecularAt { ltc, shares: [albedo, fresnel], facets: None };
        }
        let make = |roughness: f64| Ggx::new(roughness, Schlick::MIRROR);
        let facets = self.materials[material].facets.get(roughness.clamp(0.0, 1.0), make);
        SpecularAt { ltc, shares: facets.shares_at(mu.min(1.0)), facets: Some(facets) }
    }
}

/// The specular base at a point.
pub(super) struct SpecularAt<'a> {
    /// The transformed cosine.
    pub ltc: Ltc,
    /// The albedo of a mirror, and its Fresnel share.
    pub shares: [f64; 2],
    pub facets: Option<&'a Ggx>,
}

impl SpecularAt<'_> {
    pub fn albedo(&self, schlick: &[Schlick; 3]) -> DVec3 {
        let [albedo, fresnel] = self.shares;
        DVec3::from(schlick.each_ref().map(|schlick| schlick.albedo(albedo, fresnel)))
    }
}
