//! Radiance along a ray: what surfaces emit, the direct light that they scatter, and what comes by way of other
//! surfaces.

use glam::{DVec3, DVec4};

use super::context::Context;
use super::direct::DirectLight;
use super::lobes::Lobes;
use super::scatter::{Onward, scattered};
use super::stack::Stack;
use super::surface::Surface;
use super::uniforms::Sample;
use crate::bvh::Ray;

/// Parts of lights that are each sampled at the surface that the camera sees; of more parts, and at further surfaces,
/// some are chosen.
const LIGHTS_MOST: usize = 16;
/// Where blended surfaces leave less than this of what lies behind them, it is not looked at.
const LEAST_SEEN: f64 = 1e-6;
/// Blended surfaces, and holes, that a path passes through at most.
const LAYERS_MOST: usize = 256;
/// Paths of less throughput are ended at random.
const ROULETTE: f64 = 0.1;

/// What comes to the camera along a ray.
#[derive(Clone, Copy, Default)]
pub(super) struct Seen {
    pub radiance: DVec3,
    /// What of that unlit surfaces show, and in `w` the share of the view that they cover.
    pub unlit: DVec4,
}

/// What comes to the camera along a ray between two distances.
pub(super) fn seen(context: &Context, ray: &Ray, [mut near, far]: [f64; 2], sample: &mut Sample) -> Seen {
    let (mut found, mut seen) = (Seen::default(), 1.0);
    for _ in 0..LAYERS_MOST {
        sample.rays += 1;
        let Some(hit) = context.world.nearest_seen(ray, [near, far]) else { break };
        if hit.opacity > 0.0 {
            let surface = Surface::new(&context.world, ray, &hit);
            let (share, is_unlit) = (seen * hit.opacity, surface.unlit);
            let leaving = leaving(context, surface, sample);
            found.radiance += share * leaving;
            if is_unlit {
                found.unlit += share * leaving.extend(1.0);
            }
        }
        seen *= 1.0 - hit.opacity;
        if seen < LEAST_SEEN {
            break;
        }
        near = hit.distance.next_up().max(hit.distance + context.world.apart);
    }
    found
}

/// Radiance that leaves a surface to the camera.
fn leaving(context: &Context, mut surface: Surface, sample: &mut Sample) -> DVec3 {
    let mut radiance = if context.settings.lobes.emission { emitted(&surface) } else { DVec3::ZERO };
    let mut throughput = DVec3::ONE;
    for bounce in 0..=context.options.max_bounces {
        if surface.unlit {
            break;
        }
        let most = if bounce == 0 { LIGHTS_MOST } else { 1 };
        let (reflected, next) = reflected(context, &surface, bounce < context.options.max_bounces, most, sample);
        radiance += throughput * reflected;
        let Some((ray, weight)) = next else { break };
        throughput *= weight;
        let Some((met, is_light)) = met(context, &ray, sample) else { break };
        surface = met;
        if !is_light {
            radiance += throughput * emitted(&surface);
        }
        let worth = throughput.max_element();
        if worth < ROULETTE {
            let survival = worth / ROULETTE;
            if sample.uniforms.next()[0] >= survival {
                break;
            }
            throughput /= survival;
        }
    }
    radiance
}

/// The surface that a path meets next, and whether it is a light's. A blended one is met with a probability of its
/// opacity.
fn met(context: &Context, ray: &Ray, sample: &mut Sample) -> Option<(Surface, bool)> {
    let world = &context.world;
    let mut near = world.apart;
    for _ in 0..LAYERS_MOST {
        sample.rays += 1;
        let hit = world.nearest(ray, [near, f64::INFINITY])?;
        if hit.opacity >= 1.0 || sample.uniforms.next()[0] < hit.opacity {
            // The backs of one-sided surfaces are black.
            let is_seen = hit.front || world.is_double_sided(&hit);
            let surface = Surface::new(world, ray, &hit);
            return is_seen.then(|| (surface, world.is_light(&hit)));
        }
        near = hit.distance.next_up().max(hit.distance + world.apart);
    }
    None
}

/// Direct light that a surface scatters to the view, sampled in `most` directions on the lights at most, and, where the
/// path is to go `on`, its next ray.
fn reflected(context: &Context, surface: &Surface, on: bool, most: usize, sample: &mut Sample) -> (DVec3, Onward) {
    let lobes = Lobes::new(surface, &context.models, context.settings.lobes);
    let light = DirectLight::new(context, surface, &lobes, most);
    match surface.sheen.filter(|at| at.is_walked()) {
        None => scattered(&light, &lobes, on, sample),
        Some(at) => Stack::new(&light, &lobes, &at).reflected(on, sample),
    }
}

/// What a surface emits; an unlit one its colour.
fn emitted(surface: &Surface) -> DVec3 {
    if surface.unlit { surface.base_color } else { surface.emission }
}
