//! Direct light at a point of a surface: from the polygons, from lights without extent and from the environment, each
//! as much as reaches the point.

use glam::DVec3;

use super::chooser::{Chooser, Sampled};
use super::context::Context;
use super::lights::{Lit, arriving};
use super::lobes::Lobes;
use super::surface::Surface;
use super::uniforms::Sample;
use crate::scene::PunctualLight;
use crate::table::Ltc;

/// The light that a point of a surface receives.
pub(super) struct DirectLight<'a> {
    pub context: &'a Context<'a>,
    pub surface: &'a Surface,
    /// The polygons that the point sees.
    pub chooser: Chooser<'a>,
}

impl<'a> DirectLight<'a> {
    /// Polygons are sampled by the lobes of the surface, in `most` directions at most; for a layer that is walked
    /// through, by the transformed cosine that resembles it too.
    pub fn new(context: &'a Context<'a>, surface: &'a Surface, lobes: &Lobes, most: usize) -> Self {
        let mut sampled: Sampled = lobes.lobes.iter().map(|lobe| (lobe.albedo(surface.mu()), lobe.ltc)).collect();
        let others = lobes.lobes.iter().filter(|lobe| !lobe.is_near);
        sampled.extend(others.map(|lobe| (lobe.albedo(surface.mu()), Ltc::COSINE)));
        if let Some(at) = surface.sheen.filter(|at| at.is_walked()) {
            let [a, b, r] = context.models.sheen_table.lookup(at.alpha, surface.mu());
            sampled.push((at.color * r, Ltc::sheen(a, b)));
        }
        sampled.retain(|(color, ltc)| color.max_element() > 0.0 && ltc.a > 0.0);
        let seen = context.lights.seen(surface.p_world, surface.world_from_local.transpose(), surface.up);
        Self { context, surface, chooser: Chooser::new(sampled, seen, most) }
    }

    /// Light that is found by sampling the lights, as the lobes scatter it. A direction sampled in the lobes, which may
    /// find the same light, weighs `weight` against one sampled on the lights.
    pub fn scattered(&self, lobes: &Lobes, weight: f64, sample: &mut Sample) -> DVec3 {
        let mut sum = DVec3::ZERO;
        for index in 0..self.chooser.samples() {
            let [choice, one, other, _] = sample.uniforms.next();
            let Some(lit) = self.chooser.sample(index, [choice, one, other]) else { continue };
            let by_lobes = if weight > 0.0 { weight * lobes.pdf(lit.wo) } else { 0.0 };
            let value = lobes.evaluate(lit.wo) * lit.radiance / (self.chooser.density(&lit) + by_lobes);
            sum += value * self.visible(&lit, &mut sample.rays);
        }
        for light in self.context.lights.punctual {
            if let Some((wo, irradiance)) = self.punctual(light, &mut sample.rays) {
                sum += lobes.evaluate(wo) * irradiance;
            }
        }
        sum
    }

    /// Radiance of the environment from a direction, as much of it as gets through.
    pub fn environment(&self, wo: DVec3, rays: &mut u64) -> DVec3 {
        let ambient = self.context.settings.ambient.as_dvec3() * self.surface.occlusion;
        if !self.context.options.shadows {
            return ambient;
        }
        *rays += 1;
        let world = &self.context.world;
        ambient * world.passing(&self.surface.ray(wo), [world.apart, f64::INFINITY], (usize::MAX, 0.0))
    }

    /// The share of a light that is seen in a direction, in \[0, 1\].
    pub fn visible(&self, lit: &Lit, rays: &mut u64) -> f64 {
        if !self.context.options.shadows {
            return 1.0;
        }
        *rays += 1;
        let (surface, world) = (self.surface, &self.context.world);
        let mut ray = surface.ray(lit.wo);
        let mut distance = lit.distance;
        if distance.is_finite() {
            // To the same point of the light, but from where rays start.
            let way = surface.p_world + distance * ray.direction - surface.origin;
            distance = way.length();
            ray.direction = way.normalize_or(ray.direction);
        }
        // The light's own surface lies within rounding of the point that was found on it.
        let range = [world.apart, distance * (1.0 - 1e-7)];
        world.passing(&ray, range, (lit.instance, distance * (1.0 - 1e-3)))
    }

    /// The direction to a light without extent and the irradiance that arrives from it, across the ray; none where the
    /// light is below the horizon or does not reach the point.
    pub fn punctual(&self, light: &PunctualLight, rays: &mut u64) -> Option<(DVec3, DVec3)> {
        let surface = self.surface;
        let (direction, distance, irradiance) = arriving(light, surface.p_world);
        // A light at the point itself has no direction.
        let wo = (surface.world_from_local.transpose() * direction).try_normalize()?;
        if wo.z <= 0.0 || surface.up.dot(wo) <= 0.0 || irradiance == DVec3::ZERO {
            return None;
        }
        let lit = Lit {
            wo,
            radiance: irradiance,
            mean: irradiance,
            by_texels: None,
            distance,
            instance: usize::MAX,
            part: usize::MAX,
        };
        Some((wo, irradiance * self.visible(&lit, rays)))
    }
}
