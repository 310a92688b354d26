//! What is seen of an emitter's glow: the means of its emissive texture and of its opacity, from which follows the
//! radiance of its light.

use std::collections::HashMap;

use glam::{DVec2, DVec3, Mat4, Vec2, Vec3};
use rayon::prelude::*;

use super::mipmap::halved;
use super::{AlphaMode, Filter, Image, Material, Mesh, Sampler, Scene, TextureSlot, TextureUse, linear_from_srgb};

/// The most texels of the emissive texture that an emitter may cover, all triangles together: where it covers more, a
/// smaller mipmap is looked up.
const TEXELS: f64 = (1 << 20) as f64;
/// Points per texel.
const POINTS: f64 = 4.0;
/// The least number of points, all triangles together.
const POINTS_MIN: f64 = (1 << 16) as f64;

/// What is seen of a surface, as means over it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Seen {
    /// The share of its material's emission that is seen, in each channel: what the emissive texture and the opacity
    /// leave, in \[0, 1\].
    pub emission: DVec3,
    /// The share of its area that is seen at all, in \[0, 1\]: a mask has holes.
    pub area: f64,
    /// The share of its area that is seen to glow.
    pub glowing: f64,
}

impl Seen {
    const NOTHING: Self = Self { emission: DVec3::ZERO, area: 0.0, glowing: 0.0 };

    /// At a point where the emissive texture is `texel`.
    fn new(texel: DVec3, opacity: f64) -> Self {
        let one_where = |holds: bool| f64::from(u8::from(holds));
        let is_seen = opacity > 0.0;
        Self {
            emission: opacity * texel,
            area: one_where(is_seen),
            glowing: one_where(is_seen && texel != DVec3::ZERO),
        }
    }

    fn plus(self, other: Self, weight: f64) -> Self {
        Self {
            emission: self.emission + weight * other.emission,
            area: self.area + weight * other.area,
            glowing: self.glowing + weight * other.glowing,
        }
    }

    fn over(self, count: f64) -> Self {
        Self { emission: self.emission / count, area: self.area / count, glowing: self.glowing / count }
    }
}

/// The glow of a scene's emitters. What is found of a mesh holds for all its instances.
pub(super) struct Glows<'a> {
    scene: &'a Scene,
    /// By mesh.
    known: HashMap<usize, Glow>,
    /// Those meshes of which patterns were made.
    surfaces: HashMap<usize, Surface<'a>>,
}

/// What a mesh emits.
struct Glow {
    /// For each triangle; one for all of them where all are seen alike.
    seen: Vec<Seen>,
    /// Whether any triangle emits anything.
    is_bright: bool,
}

impl<'a> Glows<'a> {
    pub fn new(scene: &'a Scene) -> Self {
        Self { scene, known: HashMap::new(), surfaces: HashMap::new() }
    }

    /// Whether any part of an instance emits.
    pub fn is_bright(&mut self, instance: usize) -> bool {
        self.glow(self.scene.instances[instance].mesh).is_bright
    }

    /// What is seen of an instance, as means over its surface's area in the world; nothing where it has no area. Where
    /// a mesh lacks a set of texture coordinates, all of them are (0, 0).
    ///
    /// The textures are looked up, as they are magnified, at the points of a low-discrepancy sequence in each triangle,
    /// at least 4 per texel of the emissive one. For noise, where every texel differs from the next, the mean is right
    /// to 0.0005, where white is 1.
    pub fn of(&mut self, instance: usize) -> Seen {
        let scene = self.scene;
        let instance = &scene.instances[instance];
        let mesh = &scene.meshes[instance.mesh];
        let seen = &self.glow(instance.mesh).seen;
        if let [all] = seen[..] {
            return all;
        }
        let add = |(sum, whole): (Seen, f64), (triangle, &seen): (&[u32; 3], &Seen)| {
            let area = area(mesh, instance.world_from_mesh, triangle);
            (sum.plus(seen, area), whole + area)
        };
        // Summed in order, so that the result is the same every time.
        let triangles = mesh.indices.as_chunks::<3>().0;
        let (sum, whole) = triangles.iter().zip(seen).fold((Seen::NOTHING, 0.0), add);
        if whole > 0.0 && sum.emission.is_finite() { sum.over(whole) } else { Seen::NOTHING }
    }

    /// Whether triangles of an instance are each known by more than what all are like.
    pub fn varies(&mut self, instance: usize) -> bool {
        self.glow(self.scene.instances[instance].mesh).seen.len() > 1
    }

    /// What says how much is seen where; none where all triangles of an instance are alike.
    pub fn surface(&mut self, instance: usize) -> Option<&Surface<'a>> {
        if !self.varies(instance) {
            return None;
        }
        let (scene, mesh) = (self.scene, self.scene.instances[instance].mesh);
        Some(self.surfaces.entry(mesh).or_insert_with(|| Surface::new(scene, &scene.meshes[mesh])))
    }

    fn glow(&mut self, mesh: usize) -> &Glow {
        self.known.entry(mesh).or_insert_with(|| {
            let mesh = &self.scene.meshes[mesh];
            let seen = Surface::new(self.scene, mesh).seen();
            let emission = self.scene.materials[mesh.material].emission.as_dvec3();
            let is_bright = seen.iter().any(|seen| emission * seen.emission != DVec3::ZERO);
            Glow { seen, is_bright }
        })
    }
}

/// A mesh with what says how much of its glow is seen where.
pub(super) struct Surface<'a> {
    mesh: &'a Mesh,
    material: &'a Material,
    emission: Option<Layer<'a, Linear>>,
    opacity: Option<Layer<'a, &'a Image>>,
}

/// A triangle in the coordinates of the textures.
pub(super) struct OnTriangle {
    corners: [u32; 3],
    emission: Option<[DVec2; 3]>,
    opacity: Option<[DVec2; 3]>,
}

/// A texture as it lies on a mesh.
struct Layer<'a, Texels> {
    used: TextureUse,
    sampler: Sampler,
    /// By vertex; all are (0, 0) where it is empty.
    coordinates: &'a [Vec2],
    texels: Texels,
}

impl<'a> Surface<'a> {
    fn new(scene: &'a Scene, mesh: &'a Mesh) -> Self {
        let material = &scene.materials[mesh.material];
        let (opaque, dark) = (material.alpha_mode == AlphaMode::Opaque, material.emission == Vec3::ZERO);
        let emission = Layer::new(scene, mesh, TextureSlot::Emission).filter(|_| !dark);
        let opacity = Layer::new(scene, mesh, TextureSlot::BaseColor).filter(|_| !dark && !opaque);
        Self { mesh, material, emission: emission.map(|layer| layer.map(Linear::new)), opacity }
    }

    /// By triangle; one for all of them where all are seen alike.
    fn seen(mut self) -> Vec<Seen> {
        let varies = self.varies();
        if self.emission.is_none() && self.opacity.is_none() && !varies {
            return vec![Seen::new(DVec3::ONE, self.opacity(1.0, &[0; 3], DVec3::X))];
        }
        let triangles = self.mesh.indices.as_chunks::<3>().0;
        // Points in all triangles together for each unit of area in texture coordinates, and for each triangle.
        let emission = self.emission.as_mut().map_or(0.0, |layer| {
            let covered = layer.covered(triangles);
            while layer.texels.texels.len() > 1 && covered * layer.texels.texels.len() as f64 > TEXELS {
                layer.texels = layer.texels.halved();
            }
            density(layer.texels.texels.len(), covered)
        });
        let opacity = self.opacity.as_ref().map_or(0.0, |layer| {
            let covered = layer.covered(triangles);
            density(layer.texels.texels.len(), covered).min((POINTS * TEXELS).max(POINTS_MIN) / covered)
        });
        let least = if varies { POINTS_MIN / triangles.len() as f64 } else { 1.0 };
        let seen = |triangle: &[u32; 3]| {
            let of_emission = self.emission.as_ref().map_or(0.0, |layer| emission * layer.area(triangle));
            let of_opacity = self.opacity.as_ref().map_or(0.0, |layer| opacity * layer.area(triangle));
            self.mean(triangle, of_emission.max(of_opacity).max(least).ceil() as u32)
        };
        triangles.par_iter().map(seen).collect()
    }

    /// The mean over a triangle, from so many points.
    fn mean(&self, triangle: &[u32; 3], points: u32) -> Seen {
        let on = self.on(triangle);
        let sum = (0..points).fold(Seen::NOTHING, |sum, point| {
            let at = if points == 1 { DVec2::splat(1.0 / 3.0) } else { spread(point) };
            let (texel, opacity) = self.at(&on, at, false);
            sum.plus(Seen::new(texel, opacity), 1.0)
        });
        sum.over(points.into())
    }

    fn on(&self, triangle: &[u32; 3]) -> OnTriangle {
        let emission = self.emission.as_ref().map(|layer| layer.corners(triangle));
        let opacity = self.opacity.as_ref().map(|layer| layer.corners(triangle));
        OnTriangle { corners: *triangle, emission, opacity }
    }

    /// The emissive texture and the opacity at a place in a triangle, given by its shares of the edges from the first
    /// corner; of single texels where `is_single`.
    fn at(&self, on: &OnTriangle, at: DVec2, is_single: bool) -> (DVec3, f64) {
        let uv = |[a, b, c]: [DVec2; 3]| a + at.x * (b - a) + at.y * (c - a);
        let sampler = |own: Sampler| if is_single { Sampler { magnify: Filter::Nearest, ..own } } else { own };
        let emission = self.emission.as_ref().zip(on.emission).map_or(DVec3::ONE, |(layer, corners)| {
            let Linear { size, texels } = &layer.texels;
            sampler(layer.sampler).magnified(*size, uv(corners), |at| texels[at].as_dvec3())
        });
        let alpha = self.opacity.as_ref().zip(on.opacity).map_or(1.0, |(layer, corners)| {
            let Image { width, height, texels, .. } = layer.texels;
            let alpha = |at: usize| f64::from(texels[at][3]) / 255.0;
            sampler(layer.sampler).magnified([*width, *height], uv(corners), alpha)
        });
        (emission, self.opacity(alpha, &on.corners, DVec3::new(1.0 - at.x - at.y, at.x, at.y)))
    }

    /// The share of the emission that is seen at a place in a triangle, as [`Self::at`] has it.
    pub fn shown(&self, on: &OnTriangle, at: DVec2, is_single: bool) -> DVec3 {
        let (texel, opacity) = self.at(on, at, is_single);
        Seen::new(texel, opacity).emission
    }

    /// A triangle in the mesh, and in the textures.
    pub fn triangle(&self, index: usize) -> ([DVec3; 3], OnTriangle) {
        let corners = self.mesh.indices.as_chunks::<3>().0[index];
        (corners.map(|corner| self.mesh.positions[corner as usize].as_dvec3()), self.on(&corners))
    }

    /// Of the texture whose texels count, the emissive one where there is one: its size.
    pub fn leading_size(&self) -> Option<[u32; 2]> {
        let emission = self.emission.as_ref().map(|layer| layer.texels.size);
        emission.or(self.opacity.as_ref().map(|layer| [layer.texels.width, layer.texels.height]))
    }

    /// A triangle in its coordinates.
    pub fn leading(&self, on: &OnTriangle) -> Option<[DVec2; 3]> {
        on.emission.or(on.opacity)
    }

    /// The texels of it that a triangle covers.
    pub fn leading_texels(&self, on: &OnTriangle) -> f64 {
        let (Some([width, height]), Some([a, b, c])) = (self.leading_size(), self.leading(on)) else { return 0.0 };
        let texels = 0.5 * (b - a).perp_dot(c - a).abs() * f64::from(width) * f64::from(height);
        if texels.is_finite() { texels } else { f64::MAX.sqrt() }
    }

    /// Whether more than one thing varies.
    pub fn has_both(&self) -> bool {
        usize::from(self.emission.is_some()) + usize::from(self.opacity.is_some()) + usize::from(self.varies()) > 1
    }

    /// Whether the vertices' opacity counts.
    fn varies(&self) -> bool {
        !self.mesh.colors.is_empty() && self.material.alpha_mode != AlphaMode::Opaque
    }

    /// The share of what is behind a point that it hides, in \[0, 1\], where the texture has the alpha `texel`.
    fn opacity(&self, texel: f64, triangle: &[u32; 3], weights: DVec3) -> f64 {
        let of_vertex =
            |corner: u32| self.mesh.colors.get(corner as usize).map_or(1.0, |&[.., a]| f64::from(a) / 65535.0);
        let color = weights.dot(DVec3::from(triangle.map(of_vertex)));
        let opacity = f64::from(self.material.opacity) * texel * color;
        match self.material.alpha_mode {
            AlphaMode::Opaque => 1.0,
            AlphaMode::Mask { cutoff } => f64::from(u8::from(opacity >= f64::from(cutoff))),
            AlphaMode::Blend => opacity,
        }
    }
}

impl<'a> Layer<'a, &'a Image> {
    /// That of a slot, where the mesh's material has one.
    fn new(scene: &'a Scene, mesh: &'a Mesh, slot: TextureSlot) -> Option<Self> {
        let used = scene.materials[mesh.material].texture(slot)?;
        let texture = scene.textures[used.texture];
        let coordinates = &mesh.tex_coords[used.tex_coord];
        Some(Self { used, sampler: texture.sampler, coordinates, texels: &scene.images[texture.image] })
    }
}

impl<'a, Texels: Sync> Layer<'a, Texels> {
    fn map<Others>(self, convert: impl FnOnce(Texels) -> Others) -> Layer<'a, Others> {
        let Self { used, sampler, coordinates, texels } = self;
        Layer { used, sampler, coordinates, texels: convert(texels) }
    }

    /// A triangle in texture coordinates.
    fn corners(&self, triangle: &[u32; 3]) -> [DVec2; 3] {
        let transform = self.used.uv_from_tex_coord.as_daffine2();
        triangle.map(|corner| {
            let own = self.coordinates.get(corner as usize).copied().unwrap_or(Vec2::ZERO);
            transform.transform_point2(own.as_dvec2())
        })
    }

    /// Of a triangle in texture coordinates: 1 is the whole image. Finite.
    fn area(&self, triangle: &[u32; 3]) -> f64 {
        let [a, b, c] = self.corners(triangle);
        let area = 0.5 * (b - a).perp_dot(c - a).abs();
        if area.is_finite() { area } else { f64::MAX.sqrt() }
    }

    fn covered(&self, triangles: &[[u32; 3]]) -> f64 {
        triangles.par_iter().map(|triangle| self.area(triangle)).sum()
    }
}

/// Points for the whole of an image of so many texels, of which triangles cover so much; 0 where there is a single
/// texel, or no area, and one point per triangle will do.
fn density(texels: usize, covered: f64) -> f64 {
    let density = (POINTS * texels as f64).max(POINTS_MIN / covered);
    if texels > 1 && density.is_finite() { density } else { 0.0 }
}

/// Points of a low-discrepancy sequence in a triangle, as shares of its edges from the first corner: that of the plastic
/// number (M. Roberts 2018), folded back from beyond the unit square's diagonal. The first is the middle of the third edge.
pub(super) fn spread(index: u32) -> DVec2 {
    const STEP: DVec2 = DVec2::new(0.754_877_666_246_692_8, 0.569_840_290_998_053_3);
    let at = (DVec2::splat(0.5) + f64::from(index) * STEP).fract();
    if at.x + at.y > 1.0 { 1.0 - at } else { at }
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
}
