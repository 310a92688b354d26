//! Radiance along a ray: direct light, and what comes by way of other surfaces.
//!
//! At each point one direction is sampled on the lights and one in the lobes; both are weighed by the balance heuristic (Veach and
//! Guibas 1995), the latter's density taken for less. Where all lobes are transformed cosines, those on the lights have the density of
//! what they are to find, and do alone.

use glam::{DVec3, Vec3};

use super::Options;
use super::chooser::{Chooser, Sampled};
use super::lights::{Lights, Lit, arriving, shadow_ray};
use super::lobes::{COSINE, Lobes};
use super::models::Models;
use super::stack::{Stack, is_walked};
use super::surface::Surface;
use super::uniforms::Uniforms;
use super::world::World;
use crate::bvh::Ray;
use crate::scene::{PunctualLight, Settings};
use crate::table::Ltc;

/// Parts of lights that are looked at one by one where the camera looks; of more, and behind, some are chosen.
const LIGHTS_MOST: usize = 16;
/// What lies behind blended surfaces that leave less of it is not looked at.
const LEAST_SEEN: f64 = 1e-6;
/// Blended surfaces, and holes, that a path goes through at most.
const LAYERS_MOST: usize = 256;
/// Paths that bring less than this are ended at random.
const ROULETTE: f64 = 0.1;

/// All that light meets.
pub(super) struct Light<'a> {
    pub world: World<'a>,
    pub lights: Lights<'a>,
    pub models: Models,
    pub settings: &'a Settings,
    pub options: Options,
}

/// The ray on which a path goes on, and what its radiance is multiplied by; none where it ends.
pub(super) type Onward = Option<(Ray, DVec3)>;

/// One sample's numbers, and what it cost.
pub(super) struct Sample {
    pub uniforms: Uniforms,
    pub rays: u64,
}

impl Light<'_> {
    /// Radiance that comes to the camera along a ray between two distances.
    pub fn radiance(&self, ray: &Ray, [mut near, far]: [f64; 2], sample: &mut Sample) -> DVec3 {
        let (mut radiance, mut seen) = (DVec3::ZERO, 1.0);
        for _ in 0..LAYERS_MOST {
            sample.rays += 1;
            let Some(hit) = self.world.nearest_seen(ray, [near, far]) else { break };
            if hit.opacity > 0.0 {
                let surface = Surface::new(&self.world, self.settings, ray, &hit);
                radiance += seen * hit.opacity * self.leaving(surface, sample);
            }
            seen *= 1.0 - hit.opacity;
            if seen < LEAST_SEEN {
                break;
            }
            near = hit.distance.next_up().max(hit.distance + self.world.apart);
        }
        radiance
    }

    /// Radiance that leaves a surface to the camera.
    fn leaving(&self, surface: Surface, sample: &mut Sample) -> DVec3 {
        let mut radiance = if self.settings.lobes.emission { emitted(&surface) } else { DVec3::ZERO };
        let mut throughput = DVec3::ONE;
        let mut surface = surface;
        for bounce in 0..=self.options.max_bounces {
            if surface.unlit {
                break;
            }
            let most = if bounce == 0 { LIGHTS_MOST } else { 1 };
            let (reflected, next) = self.reflected(&surface, bounce < self.options.max_bounces, most, sample);
            radiance += throughput * reflected;
            let Some((ray, weight)) = next else { break };
            throughput *= weight;
            let Some((met, is_light)) = self.met(&ray, sample) else { break };
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

    /// The surface that a path meets next, and whether it is a light's; blended ones are there in as many cases as they are opaque.
    fn met(&self, ray: &Ray, sample: &mut Sample) -> Option<(Surface, bool)> {
        let mut near = self.world.apart;
        for _ in 0..LAYERS_MOST {
            sample.rays += 1;
            let hit = self.world.nearest(ray, [near, f64::INFINITY])?;
            if hit.opacity >= 1.0 || sample.uniforms.next()[0] < hit.opacity {
                // The backs of one-sided surfaces are black.
                let is_seen = hit.front || self.world.material(&hit).double_sided;
                let surface = Surface::new(&self.world, self.settings, ray, &hit);
                return is_seen.then(|| (surface, self.world.is_light(&hit)));
            }
            near = hit.distance.next_up().max(hit.distance + self.world.apart);
        }
        None
    }

    /// Light that a surface scatters to the view, and, where the path goes `on`, its next ray with what it brings. `most` directions are
    /// looked in for lights.
    fn reflected(&self, surface: &Surface, on: bool, most: usize, sample: &mut Sample) -> (DVec3, Onward) {
        let lobes = Lobes::new(surface, &self.models, self.settings.lobes);
        let chooser = self.chooser(surface, &lobes, most);
        match surface.sheen.filter(is_walked) {
            None => self.scattered(surface, (&lobes, &chooser), on, sample),
            Some(at) => Stack::new(self, surface, &at, (&lobes, &chooser)).reflected(on, sample),
        }
    }

    /// The lights that a surface sees, by its lobes; a layer that is walked through by the transformed cosine that resembles it.
    fn chooser(&self, surface: &Surface, lobes: &Lobes, most: usize) -> Chooser<'_> {
        let mut sampled: Sampled = lobes.lobes.iter().map(|lobe| (lobe.albedo(surface.mu()), lobe.ltc)).collect();
        let others = lobes.lobes.iter().filter(|lobe| !lobe.is_near);
        sampled.extend(others.map(|lobe| (lobe.albedo(surface.mu()), COSINE)));
        if let Some(at) = surface.sheen.filter(is_walked) {
            let [a, b, r] = self.models.sheen_table.lookup(at.alpha, surface.mu());
            sampled.push((at.color * r, Ltc { a, b, c: a }));
        }
        sampled.retain(|(color, ltc)| color.max_element() > 0.0 && ltc.a > 0.0);
        let seen = self.lights.seen(surface.p_world, surface.world_from_local.transpose(), surface.up);
        Chooser::new(sampled, seen, most)
    }

    /// Light scattered by lobes that are functions.
    pub fn scattered(
        &self,
        surface: &Surface,
        (lobes, chooser): (&Lobes, &Chooser),
        on: bool,
        sample: &mut Sample,
    ) -> (DVec3, Onward) {
        if lobes.lobes.is_empty() {
            return (DVec3::ZERO, None);
        }
        let weight = lobes.weight();
        let mut sum = self.looked_for(surface, (lobes, chooser), weight, sample);
        let has_ambient = self.settings.ambient != Vec3::ZERO;
        let closed = if self.options.shadows { None } else { lobes.albedo() };
        if let Some(albedo) = closed.filter(|_| has_ambient) {
            sum += self.settings.ambient.as_dvec3() * surface.occlusion * albedo;
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
            for lit in chooser.along(wo) {
                let density = chooser.density(&lit) + weight * pdf;
                sum += weight * value * lit.radiance / density * self.visible(surface, &lit, &mut sample.rays);
            }
        }
        let brought = value / pdf;
        if looks_around {
            sum += brought * self.environment(surface, wo, &mut sample.rays);
        }
        (sum, on.then(|| (shadow_ray(surface.origin, surface.world_from_local, wo), brought)))
    }

    /// Light that is looked for on the lights; a direction found in the lobes weighs `weight`.
    fn looked_for(
        &self,
        surface: &Surface,
        (lobes, chooser): (&Lobes, &Chooser),
        weight: f64,
        sample: &mut Sample,
    ) -> DVec3 {
        let mut sum = DVec3::ZERO;
        for index in 0..chooser.samples() {
            let [choice, one, other, _] = sample.uniforms.next();
            let Some(lit) = chooser.sample(index, [choice, one, other]) else { continue };
            let by_lobes = if weight > 0.0 { weight * lobes.pdf(lit.wo) } else { 0.0 };
            let value = lobes.evaluate(lit.wo) * lit.radiance / (chooser.density(&lit) + by_lobes);
            sum += value * self.visible(surface, &lit, &mut sample.rays);
        }
        for light in self.lights.punctual {
            if let Some((wo, irradiance)) = self.punctual(light, surface, &mut sample.rays) {
                sum += lobes.evaluate(wo) * irradiance;
            }
        }
        sum
    }

    /// Radiance of the environment from a direction, as much of it as comes through.
    pub fn environment(&self, surface: &Surface, wo: DVec3, rays: &mut u64) -> DVec3 {
        let ambient = self.settings.ambient.as_dvec3() * surface.occlusion;
        if !self.options.shadows {
            return ambient;
        }
        *rays += 1;
        let ray = shadow_ray(surface.origin, surface.world_from_local, wo);
        ambient * self.world.passing(&ray, [self.world.apart, f64::INFINITY], (usize::MAX, 0.0))
    }

    /// How much of a light is seen in a direction.
    pub fn visible(&self, surface: &Surface, lit: &Lit, rays: &mut u64) -> f64 {
        if !self.options.shadows {
            return 1.0;
        }
        *rays += 1;
        let mut ray = shadow_ray(surface.origin, surface.world_from_local, lit.wo);
        let mut distance = lit.distance;
        if distance.is_finite() {
            // To where the light is, from where rays start.
            let way = surface.p_world + distance * ray.direction - surface.origin;
            distance = way.length();
            ray.direction = way.normalize_or(ray.direction);
        }
        // The light's own surface is a rounding away from where it is found.
        let range = [self.world.apart, distance * (1.0 - 1e-7)];
        self.world.passing(&ray, range, (lit.instance, distance * (1.0 - 1e-3)))
    }

    /// The direction to a light without extent and what arrives of it across the ray, if it is above the horizon.
    pub fn punctual(&self, light: &PunctualLight, surface: &Surface, rays: &mut u64) -> Option<(DVec3, DVec3)> {
        let (direction, distance, irradiance) = arriving(light, surface.p_world);
        // Where the light is at the point itself, its direction is none.
        let wo = (surface.world_from_local.transpose() * direction).try_normalize()?;
        if wo.z <= 0.0 || surface.up.dot(wo) <= 0.0 || irradiance == DVec3::ZERO {
            return None;
        }
        let lit = Lit { wo, radiance: irradiance, distance, instance: usize::MAX, part: usize::MAX };
        Some((wo, irradiance * self.visible(surface, &lit, rays)))
    }
}

/// What a surface sends out by itself; an unlit one its colour.
fn emitted(surface: &Surface) -> DVec3 {
    if surface.unlit { surface.base_color } else { surface.emission }
}
