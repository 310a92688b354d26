//! The layer of fibres as it is: light is followed through it, to the base and back, through all orders of scattering.
//!
//! Fibres tint what they scatter by `C_sheen`, once on each way through the layer, so that alone the layer reflects C R; what passes
//! without a scattering keeps its colour. At each scattering, in the fibres or on the base, a direction to the lights is weighed
//! against the path's own by the balance heuristic: the density of the last scattering, times the share that leaves the layer after
//! it, is known.

use glam::DVec3;
use rand::Rng;

use super::chooser::Chooser;
use super::lights::shadow_ray;
use super::lobes::Lobes;
use super::path::{Light, Onward, Sample};
use super::surface::{SheenAt, Surface};
use crate::math::frame::AzimuthFrame;
use crate::math::warp::uniform;
use crate::models::{Flight, Layer, SheenWalk};
use crate::scene::{Layering, SheenModel};

/// Paths that bring less than this are ended at random.
const ROULETTE: f64 = 0.05;
/// The cosine of views along the surface.
const GRAZING: f64 = 1e-6;

/// Whether light is followed through this layer.
pub(super) fn is_walked(at: &SheenAt) -> bool {
    at.model == SheenModel::Walk || at.layering == Layering::Walk
}

/// A layer over a base at a point.
pub(super) struct Stack<'a, 'b> {
    light: &'a Light<'a>,
    surface: &'b Surface,
    lobes: &'b Lobes<'a>,
    chooser: &'b Chooser<'a>,
    fibres: &'a SheenWalk,
    /// What the fibres tint by.
    color: DVec3,
    /// How much of the surface the layer covers.
    weight: f64,
    /// Light goes on to the base; otherwise what leaves by the bottom is lost.
    has_base: bool,
}

/// A direction in which light arrives, and how it was found.
struct Sent {
    wo: DVec3,
    radiance: DVec3,
    /// How many such are expected per steradian; none of lights without extent, which no path finds by itself.
    density: Option<f64>,
}

/// A path on its way.
struct Walker {
    depth: f64,
    along: DVec3,
    throughput: DVec3,
    /// The density of the last scattering in this direction.
    pdf: f64,
    /// On this way through the layer the fibres have scattered it.
    is_tinted: bool,
    /// What was there at first.
    entered: f64,
    /// What it has scattered to the view counts: of light that fibres alone have scattered only where the sheen is wanted.
    counts: bool,
    sum: DVec3,
}

impl Walker {
    /// Light that the last scattering sends to the view: `value` scattered, of density `pdf`.
    fn add(&mut self, sent: &Sent, value: DVec3, pdf: f64) {
        if self.counts {
            let weight = sent.density.map_or(1.0, |own| 1.0 / (own + pdf));
            self.sum += self.throughput * value * sent.radiance * weight;
        }
    }

    /// Ends some of the paths that bring little, so that the others bring more; false where it ends.
    fn survives(&mut self, rng: &mut impl Rng) -> bool {
        let survival = self.throughput.max_element() / (ROULETTE * self.entered);
        if survival >= 1.0 {
            return true;
        }
        self.throughput /= survival.max(f64::MIN_POSITIVE);
        uniform(rng) < survival
    }
}

impl<'a, 'b> Stack<'a, 'b> {
    pub fn new(
        light: &'a Light<'a>,
        surface: &'b Surface,
        at: &SheenAt,
        (lobes, chooser): (&'b Lobes<'a>, &'b Chooser<'a>),
    ) -> Self {
        let fibres = light.models.walk(surface.material, at);
        let has_base = at.layering == Layering::Walk;
        let color = if has_base { at.tint() } else { at.color };
        Self { light, surface, lobes, chooser, fibres, color, weight: at.weight, has_base }
    }

    /// Light that comes to the view, and, where the path goes `on`, its next ray with what it brings.
    pub fn reflected(&self, on: bool, sample: &mut Sample) -> (DVec3, Onward) {
        let rng = &mut sample.uniforms.stream();
        let wanted = self.light.settings.lobes;
        if self.has_base {
            if uniform(rng) < self.weight {
                return self.walked(on, rng, sample);
            }
            let bare = Lobes::bare(self.surface, &self.light.models, wanted, self.surface.mu());
            return self.light.scattered(self.surface, (&bare, self.chooser), on, sample);
        }
        // The base lies below by another rule; chance has it with which of both the path goes on.
        let (below, base_on) = self.light.scattered(self.surface, (self.lobes, self.chooser), on, sample);
        if !wanted.sheen {
            return (below, base_on);
        }
        let (above, sheen_on) = self.walked(on, rng, sample);
        let chosen = if uniform(rng) < 0.5 { base_on } else { sheen_on };
        (below + above, chosen.map(|(ray, weight)| (ray, 2.0 * weight)))
    }

    /// What arrives: from directions that are chosen on the lights, and from the lights without extent.
    fn sent(&self, sample: &mut Sample) -> Vec<Sent> {
        let mut sent = Vec::with_capacity(self.chooser.samples() + self.light.lights.punctual.len());
        for index in 0..self.chooser.samples() {
            let [choice, one, other, _] = sample.uniforms.next();
            let Some(lit) = self.chooser.sample(index, [choice, one, other]) else { continue };
            let radiance = lit.radiance * self.light.visible(self.surface, &lit, &mut sample.rays);
            sent.push(Sent { wo: lit.wo, radiance, density: Some(self.chooser.density(&lit)) });
        }
        for light in self.light.lights.punctual {
            if let Some((wo, radiance)) = self.light.punctual(light, self.surface, &mut sample.rays) {
                sent.push(Sent { wo, radiance, density: None });
            }
        }
        sent
    }

    /// Follows one path until it leaves.
    fn walked(&self, on: bool, rng: &mut impl Rng, sample: &mut Sample) -> (DVec3, Onward) {
        let sent = self.sent(sample);
        // Along the surface no light would ever leave it.
        let wi = self.surface.wi;
        let mut walker = Walker {
            depth: 0.0,
            along: -DVec3::new(wi.x, wi.y, wi.z.max(GRAZING)).normalize(),
            throughput: DVec3::ONE,
            pdf: 0.0,
            is_tinted: false,
            entered: 1.0,
            counts: self.light.settings.lobes.sheen,
            sum: DVec3::ZERO,
        };
        if !self.has_base {
            // What passes by is lost: all paths stand for what does not.
            let Some((depth, share)) = self.fibres.first_scattering(walker.along, rng) else {
                return (DVec3::ZERO, None);
            };
            walker.throughput *= share;
            walker.entered = share;
            self.scatter(&mut walker, depth, &sent, rng);
        }
        loop {
            match self.fibres.flight(walker.depth, walker.along, rng) {
                Flight::Scattered(depth) => self.scatter(&mut walker, depth, &sent, rng),
                Flight::Below if self.has_base => {
                    if !self.meet_base(&mut walker, &sent, rng) {
                        return (walker.sum, None);
                    }
                }
                Flight::Below => return (walker.sum, None),
                Flight::Above => return self.leave(walker, on, &mut sample.rays),
            }
            if !walker.survives(rng) {
                return (walker.sum, None);
            }
        }
    }

    /// At a fibre.
    fn scatter(&self, walker: &mut Walker, depth: f64, sent: &[Sent], rng: &mut impl Rng) {
        walker.depth = depth;
        if !walker.is_tinted {
            walker.throughput *= self.color;
            walker.is_tinted = true;
        }
        for sent in sent {
            let leaving = self.fibres.phase(walker.along, sent.wo) * self.fibres.passing(walker.depth, sent.wo);
            walker.add(sent, DVec3::splat(leaving), leaving);
        }
        let out = self.fibres.scatter(walker.along, rng);
        walker.pdf = self.fibres.phase(walker.along, out);
        walker.along = out;
    }

    /// At the base; false where the path ends.
    fn meet_base(&self, walker: &mut Walker, sent: &[Sent], rng: &mut impl Rng) -> bool {
        let back = -walker.along;
        let frame = AzimuthFrame::of(back);
        let wanted = self.light.settings.lobes;
        let lobes = Lobes::bare(self.surface, &self.light.models, wanted, back.z.clamp(0.0, 1.0));
        if lobes.lobes.is_empty() {
            return false;
        }
        (walker.depth, walker.is_tinted, walker.counts) = (1.0, false, true);
        for sent in sent {
            let wo = frame.local(sent.wo);
            let passing = self.fibres.passing(1.0, sent.wo);
            walker.add(sent, lobes.evaluate(wo) * passing, lobes.pdf(wo) * passing);
        }
        let Some(wo) = lobes.sample(uniform(rng), [uniform(rng), uniform(rng)]) else { return false };
        walker.pdf = lobes.pdf(wo);
        walker.throughput *= lobes.evaluate(wo) / walker.pdf;
        walker.along = frame.outside(wo);
        walker.pdf > 0.0
    }

    /// By the top: what the direction meets of the lights and the environment.
    fn leave(&self, mut walker: Walker, on: bool, rays: &mut u64) -> (DVec3, Onward) {
        let wo = walker.along;
        if !walker.counts || self.surface.up.dot(wo) <= 0.0 {
            return (walker.sum, None);
        }
        let pdf = walker.pdf * self.fibres.passing(walker.depth, wo);
        for lit in self.chooser.along(wo) {
            let weight = pdf / (self.chooser.density(&lit) + pdf);
            walker.sum += walker.throughput * lit.radiance * weight * self.light.visible(self.surface, &lit, rays);
        }
        if self.light.settings.ambient != glam::Vec3::ZERO {
            walker.sum += walker.throughput * self.light.environment(self.surface, wo, rays);
        }
        let ray = shadow_ray(self.surface.origin, self.surface.world_from_local, wo);
        (walker.sum, on.then_some((ray, walker.throughput)))
    }
}
