//! What a surface is made of at a point, and the frame in which it is seen.

use glam::{DMat3, DVec3};

use super::world::{Hit, World};
use crate::bvh::Ray;
use crate::scene::{Layering, SheenModel, TextureSlot};

/// A point of a surface as it is seen from one direction, with factors and textures multiplied.
pub(super) struct Surface {
    pub p_world: DVec3,
    /// Where rays from it start.
    pub origin: DVec3,
    /// Columns x, y, z: z is the shading normal on the view's side of the surface, x lies towards the view's
    /// projection.
    pub world_from_local: DMat3,
    /// The direction to the view in that frame, with y = 0; on the horizon where the shading normal turns away from the
    /// view.
    pub wi: DVec3,
    /// The interpolated normal, without the normal map, in that frame.
    pub up: DVec3,
    pub material: usize,
    pub base_color: DVec3,
    pub metallic: f64,
    pub roughness: f64,
    /// Reflectance of the dielectric base, head on and, below, at grazing angles.
    pub f0: DVec3,
    pub f90: f64,
    pub sheen: Option<SheenAt>,
    pub emission: DVec3,
    pub unlit: bool,
    /// The share that the occlusion texture leaves of light from the environment.
    pub occlusion: f64,
}

/// The layer of fibres at a point.
#[derive(Clone, Copy)]
pub(super) struct SheenAt {
    /// `C_sheen` times the weight.
    pub color: DVec3,
    pub weight: f64,
    pub alpha: f64,
    pub model: SheenModel,
    pub layering: Layering,
}

impl SheenAt {
    /// Whether light is followed through the fibres themselves, by a random walk.
    pub fn is_walked(&self) -> bool {
        self.model == SheenModel::Walk || self.layering == Layering::Walk
    }

    /// `C_sheen` of the layer itself, without the weight.
    pub fn tint(&self) -> DVec3 {
        if self.weight > 0.0 { self.color / self.weight } else { DVec3::ZERO }
    }
}

impl Surface {
    pub fn new(world: &World, ray: &Ray, hit: &Hit) -> Self {
        let material = world.material(hit);
        let index = world.material_index(hit);
        let p_world = ray.at(hit.distance);
        let side = if hit.front { 1.0 } else { -1.0 };
        let (interpolated, mapped) = normals(world, hit, f64::from(material.normal_scale));
        let (normal, up) = (side * mapped, side * interpolated.normalize_or_zero());
        let view = -ray.direction;
        let world_from_local = frame(normal, view);
        let local_from_world = world_from_local.transpose();
        let wi = local_from_world * view;
        let texel = |slot| world.texel(hit, slot);
        let color = world.color(hit).truncate();
        let rough = texel(TextureSlot::MetallicRoughness);
        let occlusion = texel(TextureSlot::Occlusion)
            .map_or(1.0, |texel| 1.0 + f64::from(material.occlusion_strength) * (texel.x - 1.0));
        let strength = texel(TextureSlot::Specular).map_or(1.0, |texel| texel.w);
        let tint = texel(TextureSlot::SpecularColor).map_or(DVec3::ONE, |texel| texel.truncate());
        let f90 = f64::from(material.specular) * strength;
        Self {
            p_world,
            origin: world.lifted(hit, p_world),
            world_from_local,
            wi: DVec3::new(wi.x, 0.0, wi.z.max(0.0)).try_normalize().unwrap_or(DVec3::Z),
            up: local_from_world * up,
            material: index,
            base_color: material.base_color.as_dvec3()
                * color
                * texel(TextureSlot::BaseColor).map_or(DVec3::ONE, |texel| texel.truncate()),
            metallic: f64::from(material.metallic) * rough.map_or(1.0, |texel| texel.z),
            roughness: f64::from(material.roughness) * rough.map_or(1.0, |texel| texel.y),
            // Tints may be above 1.
            f0: (material.dielectric_f0().as_dvec3() * strength * tint).min(DVec3::splat(f90)),
            f90,
            sheen: sheen(world, hit),
            emission: world.emission(hit) * texel(TextureSlot::Emission).map_or(DVec3::ONE, |texel| texel.truncate()),
            unlit: material.unlit,
            occlusion,
        }
    }

    /// The view's cosine to the shading normal, in \[0, 1\].
    pub fn mu(&self) -> f64 {
        self.wi.z.min(1.0)
    }

    /// The ray from the surface in a direction of its frame.
    pub fn ray(&self, wo: DVec3) -> Ray {
        Ray { origin: self.origin, direction: (self.world_from_local * wo).normalize() }
    }
}

fn sheen(world: &World, hit: &Hit) -> Option<SheenAt> {
    let sheen = world.material(hit).sheen?;
    let tint = world.texel(hit, TextureSlot::SheenColor).map_or(DVec3::ONE, |texel| texel.truncate());
    let share = world.texel(hit, TextureSlot::SheenWeight).map_or(1.0, |texel| texel.x);
    let rough = world.texel(hit, TextureSlot::SheenRoughness).map_or(1.0, |texel| texel.w);
    let weight = f64::from(sheen.weight) * share;
    Some(SheenAt {
        color: sheen.color.as_dvec3() * tint * weight,
        weight,
        alpha: sheen.roughness_map.alpha_from_roughness(f64::from(sheen.roughness) * rough),
        model: sheen.model,
        layering: sheen.layering,
    })
}

/// The interpolated normal, and the unit normal for shading: the normal map's, where there is one.
fn normals(world: &World, hit: &Hit, scale: f64) -> (DVec3, DVec3) {
    let (normal, tangent) = world.directions(hit);
    let plain = normal.normalize_or(DVec3::Z);
    let Some(texel) = world.texel(hit, TextureSlot::Normal) else { return (normal, plain) };
    let scale = scale.clamp(-1e6, 1e6);
    let mapped = (2.0 * texel.truncate() - 1.0) * DVec3::new(scale, scale, 1.0);
    let tangent = tangent.unwrap_or_default();
    let across = tangent.w * normal.cross(tangent.truncate());
    let mapped = mapped.x * tangent.truncate() + mapped.y * across + mapped.z * normal;
    (normal, mapped.try_normalize().unwrap_or(plain))
}

/// Columns x, y, z: z is the normal, x points towards the view's projection on the surface, or anywhere where it has
/// none.
fn frame(normal: DVec3, view: DVec3) -> DMat3 {
    let across = view - normal * normal.dot(view);
    let x = if across.length_squared() > 1e-24 { across.normalize() } else { normal.any_orthonormal_vector() };
    // Once more, so that it is perpendicular to the last digit.
    let x = (x - normal * normal.dot(x)).normalize_or(normal.any_orthonormal_vector());
    DMat3::from_cols(x, normal.cross(x), normal)
}
