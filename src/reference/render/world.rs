//! A scene's surfaces as rays meet them: the triangles of all instances, in the world.

use std::ops::ControlFlow;

use glam::{DMat3, DMat4, DVec2, DVec3, DVec4};
use rayon::prelude::*;

use super::error::ReferenceError;
use super::texels::texel;
use crate::bvh::{Bvh, Meeting, Ray, Triangle};
use crate::scene::{AlphaMode, Drawn, Instance, Material, Mesh, Scene, TextureSlot};

/// The most triangles of all instances together; each takes about 120 bytes.
const TRIANGLES_MAX: usize = 1 << 25;
/// The share of light below which what lies behind blended surfaces counts for nothing.
const OPACITY_LEAST: f64 = 1e-6;

/// The triangles of a scene, each where it stands in the world.
pub(super) struct World<'a> {
    pub scene: &'a Scene,
    drawn: &'a Drawn<'a>,
    places: Vec<Place>,
    bvh: Bvh<Triangle>,
    /// The distance in metres within which a ray does not meet the surface on which it starts.
    pub apart: f64,
    /// Whether some material is unlit.
    pub has_unlit: bool,
}

/// An instance in the world.
struct Place {
    world_from_mesh: DMat4,
    world_from_normal: DMat3,
    mirrors: bool,
    /// Emitted radiance where textures are white.
    emission: DVec3,
    /// Whether its emission is a light's, which is sampled.
    is_light: bool,
}

/// A point of a surface that a ray meets.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hit {
    pub distance: f64,
    triangle: usize,
    weights: [f64; 3],
    /// Whether the ray meets the front face.
    pub front: bool,
    pub opacity: f64,
}

impl<'a> World<'a> {
    pub fn new(drawn: &'a Drawn) -> Result<Self, ReferenceError> {
        let (scene, instances) = (drawn.scene, &drawn.instances);
        let seen: Vec<usize> = (0..instances.len()).filter(|&index| drawn.is_drawn(index)).collect();
        let count = |&index: &usize| drawn.mesh_of(index).indices.len() / 3;
        let triangles: usize = seen.iter().map(count).sum();
        if triangles > TRIANGLES_MAX {
            return Err(ReferenceError::Triangles { triangles, most: TRIANGLES_MAX });
        }
        let place = |(index, instance): (usize, &Instance)| Place {
            world_from_mesh: instance.world_from_mesh.as_dmat4(),
            world_from_normal: instance.world_from_normal().as_dmat3(),
            mirrors: instance.mirrors(),
            emission: drawn.emission(index).as_dvec3(),
            is_light: drawn.light(index).is_some(),
        };
        let places: Vec<Place> = instances.iter().enumerate().map(place).collect();
        let of_instance = |&index: &usize| {
            let mesh = drawn.mesh_of(index);
            let place = &places[index];
            let triangles = mesh.indices.as_chunks::<3>().0.par_iter().enumerate();
            triangles.map(move |(at, corners)| {
                let corner =
                    |corner: u32| place.world_from_mesh.transform_point3(mesh.positions[corner as usize].as_dvec3());
                Triangle::new(corners.map(corner), index as u32, at as u32)
            })
        };
        let triangles: Vec<Triangle> = seen.par_iter().flat_map(of_instance).collect();
        let bounds = scene.bounds();
        let size = (bounds.max - bounds.min).max_element().max(bounds.max.abs().max(bounds.min.abs()).max_element());
        let apart = if size.is_finite() { 1e-9 * f64::from(size) } else { 0.0 };
        let has_unlit = drawn.materials.iter().any(|material| material.unlit);
        Ok(Self { scene, drawn, places, bvh: Bvh::new(triangles), apart, has_unlit })
    }

    pub fn triangles(&self) -> usize {
        self.bvh.primitives().len()
    }

    fn mesh_of(&self, triangle: &Triangle) -> &'a Mesh {
        self.drawn.mesh_of(triangle.instance as usize)
    }

    fn material_of(&self, triangle: &Triangle) -> &'a Material {
        &self.drawn.materials[self.mesh_of(triangle).material]
    }

    /// What a ray has met; `None` where nothing is there: in a mask's hole.
    fn hit(&self, ray: &Ray, meeting: &Meeting<[f64; 2]>) -> Option<Hit> {
        let triangle = &self.bvh.primitives()[meeting.index];
        let [u, v] = meeting.place;
        let weights = [1.0 - u - v, u, v];
        let by_winding = triangle.face().dot(ray.direction) < 0.0;
        let front = by_winding != self.places[triangle.instance as usize].mirrors;
        let material = self.material_of(triangle);
        let opacity = match material.alpha_mode {
            AlphaMode::Opaque => 1.0,
            AlphaMode::Mask { cutoff } => {
                let opacity = self.opacity(triangle, material, weights);
                if opacity < f64::from(cutoff) {
                    return None;
                }
                1.0
            }
            AlphaMode::Blend => self.opacity(triangle, material, weights),
        };
        Some(Hit { distance: meeting.distance, triangle: meeting.index, weights, front, opacity })
    }

    /// The nearest surface that is seen along a ray between two distances; one-sided surfaces are not seen from behind.
    pub fn nearest_seen(&self, ray: &Ray, range: [f64; 2]) -> Option<Hit> {
        self.nearest_of(ray, range, |hit| hit.front || self.is_double_sided(hit))
    }

    /// The nearest surface along a ray between two distances, from the front or from behind.
    pub fn nearest(&self, ray: &Ray, range: [f64; 2]) -> Option<Hit> {
        self.nearest_of(ray, range, |_| true)
    }

    /// The nearest hit, of those that count, between two distances.
    fn nearest_of(&self, ray: &Ray, range: [f64; 2], counts: impl Fn(&Hit) -> bool) -> Option<Hit> {
        let mut nearest = None;
        self.bvh.nearest(ray, range, |meeting| {
            let hit = self.hit(ray, meeting).filter(&counts);
            nearest = hit.or(nearest);
            hit.is_some()
        });
        nearest
    }

    /// The share of light, in [0, 1], that passes along a ray between two distances. What is opaque stops it, from the
    /// front and from behind; what is blended takes the share that is its opacity. The instance `own` counts only up to
    /// the distance `own_until`.
    pub fn passing(&self, ray: &Ray, range: [f64; 2], (own, own_until): (usize, f64)) -> f64 {
        let mut share = 1.0;
        let stopped = self.bvh.visit(ray, range, |meeting| {
            let is_own = self.bvh.primitives()[meeting.index].instance as usize == own;
            if is_own && meeting.distance > own_until {
                return ControlFlow::Continue(());
            }
            if let Some(hit) = self.hit(ray, meeting) {
                share *= 1.0 - hit.opacity;
            }
            if share < OPACITY_LEAST { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        if stopped.is_some() { 0.0 } else { share }
    }

    pub fn material(&self, hit: &Hit) -> &'a Material {
        self.material_of(&self.bvh.primitives()[hit.triangle])
    }

    /// Whether it is seen from behind, too.
    pub fn is_double_sided(&self, hit: &Hit) -> bool {
        self.drawn.is_double_sided(self.bvh.primitives()[hit.triangle].instance as usize)
    }

    /// Index into `Drawn::materials`.
    pub fn material_index(&self, hit: &Hit) -> usize {
        self.mesh_of(&self.bvh.primitives()[hit.triangle]).material
    }

    fn place(&self, hit: &Hit) -> &Place {
        &self.places[self.bvh.primitives()[hit.triangle].instance as usize]
    }

    /// Emitted radiance where the textures are white.
    pub fn emission(&self, hit: &Hit) -> DVec3 {
        self.place(hit).emission
    }

    /// Whether its emission is that of a light.
    pub fn is_light(&self, hit: &Hit) -> bool {
        self.place(hit).is_light
    }

    fn opacity(&self, triangle: &Triangle, material: &Material, weights: [f64; 3]) -> f64 {
        let texel = self.texel_of(triangle, material, weights, TextureSlot::BaseColor);
        f64::from(material.opacity) * texel.map_or(1.0, |texel| texel.w) * self.color_of(triangle, weights).w
    }

    /// What the slot's texture shows at a hit; `None` where there is no texture.
    pub fn texel(&self, hit: &Hit, slot: TextureSlot) -> Option<DVec4> {
        self.texel_of(&self.bvh.primitives()[hit.triangle], self.material(hit), hit.weights, slot)
    }

    fn texel_of(
        &self,
        triangle: &Triangle,
        material: &Material,
        weights: [f64; 3],
        slot: TextureSlot,
    ) -> Option<DVec4> {
        let used = material.texture(slot)?;
        let texture = self.scene.textures[used.texture];
        let coordinates = &self.mesh_of(triangle).tex_coords[used.tex_coord];
        let at = |corner: u32| coordinates.get(corner as usize).map_or(DVec2::ZERO, |at| at.as_dvec2());
        let [a, b, c] = self.corners(triangle).map(at);
        let at = weights[0] * a + weights[1] * b + weights[2] * c;
        let uv = used.uv_from_tex_coord.as_daffine2().transform_point2(at);
        Some(texel(&self.scene.images[texture.image], texture.sampler, slot.is_color(), uv))
    }

    /// The vertices' colour and opacity, interpolated; white and 1 where they have none.
    pub fn color(&self, hit: &Hit) -> DVec4 {
        self.color_of(&self.bvh.primitives()[hit.triangle], hit.weights)
    }

    fn color_of(&self, triangle: &Triangle, weights: [f64; 3]) -> DVec4 {
        let colors = &self.mesh_of(triangle).colors;
        if colors.is_empty() {
            return DVec4::ONE;
        }
        let color = |corner: u32| DVec4::from(colors[corner as usize].map(f64::from)) / 65535.0;
        let [a, b, c] = self.corners(triangle).map(color);
        weights[0] * a + weights[1] * b + weights[2] * c
    }

    fn corners(&self, triangle: &Triangle) -> [u32; 3] {
        let first = 3 * triangle.index as usize;
        let indices = &self.mesh_of(triangle).indices;
        [indices[first], indices[first + 1], indices[first + 2]]
    }

    /// The interpolated normal, not of unit length, and the tangent with its side, where the mesh has them.
    pub fn directions(&self, hit: &Hit) -> (DVec3, Option<DVec4>) {
        let triangle = &self.bvh.primitives()[hit.triangle];
        let (mesh, place) = (self.mesh_of(triangle), &self.places[triangle.instance as usize]);
        let corners = self.corners(triangle);
        let normal =
            self.corner_normals(triangle).into_iter().zip(hit.weights).map(|(normal, weight)| weight * normal).sum();
        let tangent = (!mesh.tangents.is_empty()).then(|| {
            let one = |corner: u32| {
                let tangent = mesh.tangents[corner as usize].as_dvec4();
                let side = if place.mirrors { -tangent.w } else { tangent.w };
                place.world_from_mesh.transform_vector3(tangent.truncate()).normalize_or_zero().extend(side)
            };
            let [a, b, c] = corners.map(one);
            hit.weights[0] * a + hit.weights[1] * b + hit.weights[2] * c
        });
        (normal, tangent)
    }

    fn corner_normals(&self, triangle: &Triangle) -> [DVec3; 3] {
        let (mesh, place) = (self.mesh_of(triangle), &self.places[triangle.instance as usize]);
        let normal = |corner: u32| place.world_from_normal * mesh.normals[corner as usize].as_dvec3();
        self.corners(triangle).map(|corner| normal(corner).normalize_or_zero())
    }

    /// Where rays from a hit start. Where the normals curve outwards, that is off the flat triangle, on the curved
    /// surface for which it stands, so that facets do not shade each other in grazing light (Hanika 2021, "Hacking the
    /// shadow terminator").
    pub fn lifted(&self, hit: &Hit, p_world: DVec3) -> DVec3 {
        let triangle = &self.bvh.primitives()[hit.triangle];
        let place = &self.places[triangle.instance as usize];
        let mesh = self.mesh_of(triangle);
        let sign = if hit.front { 1.0 } else { -1.0 };
        let corners = self.corners(triangle).into_iter().zip(self.corner_normals(triangle)).zip(hit.weights);
        let offset: DVec3 = corners
            .map(|((corner, normal), weight)| {
                let corner = place.world_from_mesh.transform_point3(mesh.positions[corner as usize].as_dvec3());
                let normal = sign * normal;
                // Up to the tangent plane of the corner, where the point is below it.
                weight * -(p_world - corner).dot(normal).min(0.0) * normal
            })
            .sum();
        p_world + offset
    }
}
