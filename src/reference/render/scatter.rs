//! Light that lobes scatter to the view, and the direction in which a path goes on from them.
//!
//! Directions are sampled on the lights, and one in the lobes. Where all lobes are transformed cosines, sampling the
//! lights has exactly the density of the integrand, so it is used alone. Otherwise the balance heuristic (Veach and
//! Guibas 1995) weighs both, with the density of the lobes' sample scaled down.

use glam::{DVec3, Vec3};

use super::direct::DirectLight;
use super::lobes::Lobes;
use super::uniforms::Sample;
use crate::bvh::Ray;

/// The ray on which a path goes on, and what the radiance along it is multiplied by; none where the path ends.
pub(super) type Onward = Option<(Ray, DVec3)>;

/// Direct light that the lobes scatter to the view, and, where the path is to go `on`, its next ray.
pub(super) fn scattered(light: &DirectLight, lobes: &Lobes, on: bool, sample: &mut Sample) -> (DVec3, Onward) {
    if lobes.lobes.is_empty() {
        return (DVec3::ZERO, None);
    }
    let (surface, settings) = (light.surface, light.context.settings);
    let weight = lobes.weight();
    let mut sum = light.scattered(lobes, weight, sample);
    let has_ambient = settings.ambient != Vec3::ZERO;
    let closed = if light.context.options.shadows { None } else { lobes.albedo() };
    if let Some(albedo) = closed.filter(|_| has_ambient) {
        sum += settings.ambient.as_dvec3() * surface.occlusion * albedo;
    }
    let looks_around = has_ambient && closed.is_none();
    let is_needed = weight > 0.0 || on || looks_around;
    let [choice, one, other, _] = sample.uniforms.next();
    let Some(wo) = is_needed.then(|| lobes.sample(choice, [one, other])).flatten() else { return (sum, None) };
    let (value, pdf) = (lobes.evaluate(wo), lobes.pdf(wo));
    if !(pdf > 0.0 && value.max_element() > 0.0 && surface.up.dot(wo) > 0.0) {
        return (sum, None);
    }
    if weight > 0.0 {
        for lit in light.chooser.along(wo) {
            let density = light.chooser.density(&lit) + weight * pdf;
            sum += weight * value * lit.radiance / density * light.visible(&lit, &mut sample.rays);
        }
    }
    let brought = value / pdf;
    if looks_around {
        sum += brought * light.environment(wo, &mut sample.rays);
    }
    (sum, on.then(|| (surface.ray(wo), brought)))
}
