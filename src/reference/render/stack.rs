//! The layer of fibres itself, by a random walk: light is followed through the layer, to the base and back, through all
//! orders of scattering.
//!
//! Fibres tint what they scatter by `C_sheen`, once on each way through the layer, so that by itself the layer reflects
//! C R; what passes without being scattered keeps its colour. At each scattering event, in the fibres or on the base,
//! the balance heuristic weighs directions sampled on the lights against the direction in which the path leaves, whose
//! density is known: that of the last event, times the share of light that leaves the layer after it.

use glam::{DVec3, Vec3};
use rand::Rng;

use super::direct::DirectLight;
use super::lobes::Lobes;
use super::scatter::{Onward, scattered};
use super::surface::SheenAt;
use super::uniforms::Sample;
use crate::math::frame::AzimuthFrame;
use crate::math::warp::uniform;
use crate::models::{Flight, Layer, SheenWalk};
use crate::scene::Layering;

/// Paths of less throughput, relative to what entered the layer, are ended at random.
const ROULETTE: f64 = 0.05;
/// Least cosine at which the walk enters: along the surface it would never leave.
const GRAZING: f64 = 1e-6;

/// A layer over a base at a point.
pub(super) struct Stack<'a, 'b> {
    light: &'b DirectLight<'a>,
    /// Of the base, where another rule than the walk layers it.
    lobes: &'b Lobes<'a>,
    fibres: &'a SheenWalk,
    /// By which the fibres tint.
    color: DVec3,
    /// The share of the surface that the layer covers.
    weight: f64,
    /// The walk goes on to the base; otherwise what leaves by the bottom is lost.
    has_base: bool,
}

/// A direction in which light arrives, and how it was found.
struct Sent {
    wo: DVec3,
    radiance: DVec3,
    /// How many such directions are expected per steradian; none for lights without extent, which no path finds by
    /// itself.
    density: Option<f64>,
}

/// A path on its way.
struct Walker {
    depth: f64,
    along: DVec3,
    throughput: DVec3,
    /// The density with which the last event chose this direction, per steradian.
    pdf: f64,
    /// The fibres have scattered it since it entered the layer or left the base.
    is_tinted: bool,
    /// The throughput at the start.
    entered: f64,
    /// What it sends to the view is wanted: light that only fibres have scattered is the sheen's.
    counts: bool,
    sum: DVec3,
}

impl Walker {
    /// Adds light that an event scatters: `value` is the scattering function, `pdf` the density with which the path
    /// itself takes that way.
    fn add(&mut self, sent: &Sent, value: DVec3, pdf: f64) {
        if self.counts {
            let weight = sent.density.map_or(1.0, |own| 1.0 / (own + pdf));
            self.sum += self.throughput * value * sent.radiance * weight;
        }
    }

    /// Ends some of the paths of little throughput, and gives the others more in return; false where this one ends.
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
    pub fn new(light: &'b DirectLight<'a>, lobes: &'b Lobes<'a>, at: &SheenAt) -> Self {
        let fibres = light.context.models.walk(light.surface.material, at);
        let has_base = at.layering == Layering::Walk;
        let color = if has_base { at.tint() } else { at.color };
        Self { light, lobes, fibres, color, weight: at.weight, has_base }
    }

    /// Light that layer and base scatter to the view, and, where the path is to go `on`, its next ray.
    pub fn reflected(&self, on: bool, sample: &mut Sample) -> (DVec3, Onward) {
        let rng = &mut sample.uniforms.stream();
        let (surface, context) = (self.light.surface, self.light.context);
        let wanted = context.settings.lobes;
        if self.has_base {
            if uniform(rng) < self.weight {
                return self.walked(on, rng, sample);
            }
            let bare = Lobes::bare(surface, &context.models, wanted, surface.mu());
            return scattered(self.light, &bare, on, sample);
        }
        // The base is layered by another rule: both scatter, and the path goes on from one of them, chosen at random.
        let (below, base_on) = scattered(self.light, self.lobes, on, sample);
        if !wanted.sheen {
            return (below, base_on);
        }
        let (above, sheen_on) = self.walked(on, rng, sample);
        let chosen = if uniform(rng) < 0.5 { base_on } else { sheen_on };
        (below + above, chosen.map(|(ray, weight)| (ray, 2.0 * weight)))
    }

    /// Light that arrives at the surface: in directions sampled on the polygons, and from the lights without extent.
    fn sent(&self, sample: &mut Sample) -> Vec<Sent> {
        let (chooser, punctual) = (&self.light.chooser, self.light.context.lights.punctual);
        let mut sent = Vec::with_capacity(chooser.samples() + punctual.len());
        for index in 0..chooser.samples() {
            let [choice, one, other, _] = sample.uniforms.next();
            let Some(lit) = chooser.sample(index, [choice, one, other]) else { continue };
            let radiance = lit.radiance * self.light.visible(&lit, &mut sample.rays);
            sent.push(Sent { wo: lit.wo, radiance, density: Some(chooser.density(&lit)) });
        }
        for light in punctual {
            if let Some((wo, radiance)) = self.light.punctual(light, &mut sample.rays) {
                sent.push(Sent { wo, radiance, density: None });
            }
        }
        sent
    }

    /// Follows one path until it leaves.
    fn walked(&self, on: bool, rng: &mut impl Rng, sample: &mut Sample) -> (DVec3, Onward) {
        let sent = self.sent(sample);
        let wi = self.light.surface.wi;
        let mut walker = Walker {
            depth: 0.0,
            along: -DVec3::new(wi.x, wi.y, wi.z.max(GRAZING)).normalize(),
            throughput: DVec3::ONE,
            pdf: 0.0,
            is_tinted: false,
            entered: 1.0,
            counts: self.light.context.settings.lobes.sheen,
            sum: DVec3::ZERO,
        };
        if !self.has_base {
            // What passes through unscattered is lost: every path stands for what does not.
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

    /// Scatters at a fibre at `depth`.
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

    /// Scatters at the base; false where the path ends.
    fn meet_base(&self, walker: &mut Walker, sent: &[Sent], rng: &mut impl Rng) -> bool {
        let back = -walker.along;
        let frame = AzimuthFrame::of(back);
        let context = self.light.context;
        let wanted = context.settings.lobes;
        let lobes = Lobes::bare(self.light.surface, &context.models, wanted, back.z.clamp(0.0, 1.0));
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

    /// Leaves by the top, and meets the lights and the environment that lie in its direction.
    fn leave(&self, mut walker: Walker, on: bool, rays: &mut u64) -> (DVec3, Onward) {
        let (light, surface) = (self.light, self.light.surface);
        let wo = walker.along;
        if !walker.counts || surface.up.dot(wo) <= 0.0 {
            return (walker.sum, None);
        }
        let pdf = walker.pdf * self.fibres.passing(walker.depth, wo);
        for lit in light.chooser.along(wo) {
            let weight = pdf / (light.chooser.density(&lit) + pdf);
            walker.sum += walker.throughput * lit.radiance * weight * light.visible(&lit, rays);
        }
        if light.context.settings.ambient != Vec3::ZERO {
            walker.sum += walker.throughput * light.environment(wo, rays);
        }
        (walker.sum, on.then_some((surface.ray(wo), walker.throughput)))
    }
}
