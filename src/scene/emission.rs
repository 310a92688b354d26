//! The mean of an emissive texture over an emitter, from which follows the radiance of its light.

use std::collections::HashMap;

use glam::{DVec2, DVec3, Mat4, Vec2, Vec3};
use rayon::prelude::*;

use super::mipmap::halved;
use super::{Filter, Image, Mesh, Sampler, Scene, TextureSlot, linear_from_srgb};

/// The most texels that an emitter may cover, all triangles together: where it covers more, a smaller mipmap is looked
/// up.
const TEXELS: f64 = (1 << 20) as f64;
/// Points per texel.
const POINTS: f64 = 4.0;
/// The least number of points, all triangles together.
const POINTS_MIN: f64 = (1 << 16) as f64;

/// The radiances of a scene's emitters. What is found of a mesh holds for all its instances.
pub(super) struct Radiances<'a> {
    scene: &'a Scene,
    /// By mesh.
    known: HashMap<usize, Glow>,
}

/// What a mesh emits.
struct Glow {
    /// For each triangle, the mean of its emissive texture; empty where there is none.
    means: Vec<DVec3>,
    /// Whether any triangle emits anything.
    is_bright: bool,
}

impl<'a> Radiances<'a> {
    pub fn new(scene: &'a Scene) -> Self {
        Self { scene, known: HashMap::new() }
    }

    /// Whether any part of an instance emits.
    pub fn is_bright(&mut self, instance: usize) -> bool {
        self.glow(self.scene.instances[instance].mesh).is_bright
    }

    /// The radiance of an instance's emissive surface, linear Rec. 709, finite: its material's emission times the mean
    /// of its emissive texture over the surface's area in the world. Where a mesh lacks the set of texture coordinates,
    /// all of them are (0, 0).
    ///
    /// The texture is looked up bilinearly at the points of a low-discrepancy sequence in each triangle, at least 4 per
    /// texel. For noise, where every texel differs from the next, the mean is right to 0.0005, where white is 1.
    pub fn of(&mut self, instance: usize) -> Vec3 {
        let scene = self.scene;
        let instance = &scene.instances[instance];
        let mesh = &scene.meshes[instance.mesh];
        let emission = scene.materials[mesh.material].emission;
        let means = &self.glow(instance.mesh).means;
        if means.is_empty() {
            return emission;
        }
        let weighted = |(triangle, &mean): (&[u32; 3], &DVec3)| {
            let area = area(mesh, instance.world_from_mesh, triangle);
            (area * mean, area)
        };
        let add = |left: (DVec3, f64), right: (DVec3, f64)| (left.0 + right.0, left.1 + right.1);
        // Summed in order, so that the result is the same every time.
        let triangles = mesh.indices.as_chunks::<3>().0;
        let (sum, area) = triangles.iter().zip(means).map(weighted).fold((DVec3::ZERO, 0.0), add);
        if area > 0.0 && sum.is_finite() { emission * (sum / area).as_vec3() } else { Vec3::ZERO }
    }

    fn glow(&mut self, mesh: usize) -> &Glow {
        self.known.entry(mesh).or_insert_with(|| {
            let mesh = &self.scene.meshes[mesh];
            let (means, emission) = (means(self.scene, mesh), self.scene.materials[mesh.material].emission);
            let is_bright = |&mean: &DVec3| emission.as_dvec3() * mean != DVec3::ZERO;
            let is_bright = if means.is_empty() { emission != Vec3::ZERO } else { means.iter().any(is_bright) };
            Glow { means, is_bright }
        })
    }
}

/// For each triangle of a mesh, the mean of its material's emissive texture; empty where nothing emits by a texture.
fn means(scene: &Scene, mesh: &Mesh) -> Vec<DVec3> {
    let material = &scene.materials[mesh.material];
    let Some(used) = material.texture(TextureSlot::Emission).filter(|_| material.emission != Vec3::ZERO) else {
        return Vec::new();
    };
    let texture = scene.textures[used.texture];
    let coordinates = &mesh.tex_coords[used.tex_coord];
    let uv = |corner: u32| {
        let own = coordinates.get(corner as usize).copied().unwrap_or(Vec2::ZERO);
        used.uv_from_tex_coord.as_daffine2().transform_point2(own.as_dvec2())
    };
    let triangles = mesh.indices.as_chunks::<3>().0;
    let span = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(uv);
        let area = 0.5 * (b - a).perp_dot(c - a).abs();
        if area.is_finite() { area } else { f64::MAX.sqrt() }
    };
    let mut level = Linear::new(&scene.images[texture.image]);
    let spans: f64 = triangles.par_iter().map(span).sum();
    while level.texels.len() > 1 && spans * level.texels.len() as f64 > TEXELS {
        level = level.halved();
    }
    // Points for the whole of the image. Where there is a single texel, or no area, one point per triangle will do.
    let density = (POINTS * level.texels.len() as f64).max(POINTS_MIN / spans);
    let density = if level.texels.len() > 1 && density.is_finite() { density } else { 0.0 };
    // Bilinear whatever the sampler says: over whole texels the mean is the same, and it takes fewer points.
    let sampler = Sampler { magnify: Filter::Linear, ..texture.sampler };
    let mean =
        |triangle: &[u32; 3]| level.mean(triangle.map(uv), (density * span(triangle)).ceil().max(1.0) as u32, sampler);
    triangles.par_iter().map(mean).collect()
}

/// Twice a triangle's area in the world.
fn area(mesh: &Mesh, world_from_mesh: Mat4, triangle: &[u32; 3]) -> f64 {
    let place = |corner: u32| world_from_mesh.as_dmat4().transform_point3(mesh.positions[corner as usize].as_dvec3());
    let [a, b, c] = triangle.map(place);
    (b - a).cross(c - a).length()
}

/// An image in linear light.
struct Linear {
    size: [u32; 2],
    texels: Vec<Vec3>,
}

impl Linear {
    fn new(image: &Image) -> Self {
        let linear: Vec<f32> = (0..=255).map(linear_from_srgb).collect();
        let texel = |&[red, green, blue, _]: &[u8; 4]| Vec3::from([red, green, blue].map(|code| linear[code as usize]));
        Self { size: [image.width, image.height], texels: image.texels.iter().map(texel).collect() }
    }

    /// The next mipmap.
    fn halved(&self) -> Self {
        let (size, texels) = halved(self.size, |at| self.texels[at], |mean| mean);
        Self { size, texels }
    }

    /// The mean over a triangle of texture coordinates, from so many points.
    fn mean(&self, [a, b, c]: [DVec2; 3], points: u32, sampler: Sampler) -> DVec3 {
        // The sequence of the plastic number (M. Roberts 2018); its first point is the middle.
        const STEP: DVec2 = DVec2::new(0.754_877_666_246_692_8, 0.569_840_290_998_053_3);
        let sum: DVec3 = (0..points)
            .map(|point| {
                let at = (DVec2::splat(0.5) + f64::from(point) * STEP).fract();
                // Points beyond the unit square's diagonal are folded back into the triangle below it.
                let at = if at.x + at.y > 1.0 { 1.0 - at } else { at };
                let at = if points == 1 { DVec2::splat(1.0 / 3.0) } else { at };
                let uv = a + at.x * (b - a) + at.y * (c - a);
                sampler.magnified(self.size, uv, |at| self.texels[at].as_dvec3())
            })
            .sum();
        sum / f64::from(points)
    }
}
