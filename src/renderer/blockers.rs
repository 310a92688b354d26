//! What stands in the way of light, as shaders read it: the hierarchies over a scene's triangles, and what of them lets light
//! through.
//!
//! There are two trees: emitters move with their lights, and may be hidden; all else stays where it was loaded. The first is
//! built anew where lights change, the second once.

use bytemuck::{Pod, Zeroable};
use glam::{DVec2, DVec3, Vec2, Vec3};
use rayon::prelude::*;

use super::numbers::Words;
use crate::bvh::{Bvh, Triangle};
use crate::scene::{AlphaMode, Drawn, Filter, Material, Mesh, Sampler, Scene, TextureSlot, Wrap};

/// `BLOCKERS_NONE` of `blockers.wgsl`.
const NONE: u32 = u32::MAX;

/// Most looks that a record tells apart: it has 16 bits for that.
pub(super) const MOST_LOOKS: usize = 1 << 16;

/// `BlockersTriangle` of `blockers.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(super) struct GpuTriangle {
    corner: Vec3,
    light: u32,
    first_edge: Vec3,
    opacity: u32,
    second_edge: Vec3,
    padding: u32,
}

/// A tree as the shaders read it.
pub(super) struct Tree {
    pub nodes: Vec<[Words; 5]>,
    pub triangles: Vec<GpuTriangle>,
}

/// How triangles that are cut out or blended let light through.
#[derive(Default)]
pub(super) struct Opacities {
    /// Of each triangle: its corners' texture coordinates, opacities, and its look.
    pub records: Vec<[Words; 2]>,
    /// Of the materials that are not opaque, in their order: at most [`MOST_LOOKS`].
    pub looks: Vec<[Words; 2]>,
    /// The alphas of images, one after the other.
    pub alphas: Vec<u8>,
    /// By instance, the record of its first triangle.
    first_of: Vec<Option<u32>>,
}

/// Whose triangles a tree holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Emitters that light the scene, where they are drawn.
    Emitters,
    /// Everything else.
    Others,
}

impl Kind {
    fn holds(self, drawn: &Drawn, instance: usize) -> bool {
        let is_emitter = drawn.light_index(instance).is_some();
        is_emitter == (self == Self::Emitters) && drawn.is_drawn(instance)
    }
}

/// How many triangles the emitters of a scene have, whether they are drawn or not.
pub(super) fn emitting_triangles(drawn: &Drawn) -> usize {
    let emitters = (0..drawn.instances.len()).filter(|&instance| drawn.light_index(instance).is_some());
    emitters.map(|instance| mesh(drawn, instance).indices.len() / 3).sum()
}

/// The triangles of a scene of one kind, in the world: what a tree is made of. Making it is long work, which may be done
/// on another thread.
pub(super) struct Gathered {
    triangles: Vec<Triangle>,
    /// By instance: the light that it is of.
    lights: Vec<u32>,
    /// By instance: what it is of the scene as loaded, if it is of it.
    loaded: Vec<Option<usize>>,
}

impl Gathered {
    pub fn new(drawn: &Drawn, kind: Kind) -> Self {
        let lights = |instance| drawn.light_index(instance).map_or(NONE, |light| light as u32);
        let held: Vec<usize> = (0..drawn.instances.len()).filter(|&instance| kind.holds(drawn, instance)).collect();
        let triangles = held.into_par_iter().flat_map(|instance| triangles(drawn, instance)).collect();
        let instances = || 0..drawn.instances.len();
        let loaded = instances().map(|instance| drawn.loaded_instance(instance)).collect();
        Self { triangles, lights: instances().map(lights).collect(), loaded }
    }

    pub fn triangles(&self) -> usize {
        self.triangles.len()
    }

    /// The tree in these units, with places of records of opacity counted from 0.
    pub fn build(self, (center, unit): (DVec3, f64), opacities: &Opacities) -> Tree {
        let bvh = Bvh::in_units(self.triangles, (center, unit));
        let scaled = |vector: DVec3| (vector / unit).as_vec3();
        let triangle = |triangle: &Triangle| {
            let [first_edge, second_edge] = triangle.edges().map(scaled);
            let instance = triangle.instance as usize;
            let first = self.loaded[instance].and_then(|loaded| opacities.first_of[loaded]);
            let record = first.map_or(NONE, |first| first + triangle.index);
            let (light, corner) = (self.lights[instance], scaled(triangle.corner() - center));
            GpuTriangle { corner, light, first_edge, opacity: record, second_edge, padding: 0 }
        };
        Tree {
            nodes: spread(&bytemuck::pod_collect_to_vec::<u8, [Words; 5]>(bvh.nodes())),
            triangles: bvh.primitives().par_iter().map(triangle).collect(),
        }
    }
}

impl Tree {
    /// Counts nodes, triangles, and places of records of opacity in `blockers_nodes` from these on.
    pub fn place(&mut self, root: usize, first_triangle: usize, first_record: usize) {
        for node in &mut self.nodes {
            // The first child's, and the first triangle's: `CwBvhNode` of obvhs.
            let [children, triangles, ..] = &mut node[1];
            *children += root as u32;
            *triangles += first_triangle as u32;
        }
        for triangle in self.triangles.iter_mut().filter(|triangle| triangle.opacity != NONE) {
            triangle.opacity = first_record as u32 + 2 * triangle.opacity;
        }
    }
}

/// Moves nodes apart: a child's place is its parent's number plus its slot, of eight, so that shaders need not count which of its
/// siblings are nodes too. Places between the first and the last of a node's children that are none stay empty.
fn spread(nodes: &[[Words; 5]]) -> Vec<[Words; 5]> {
    let mut spread: Vec<[Words; 5]> = nodes.first().copied().into_iter().collect();
    let mut parents: Vec<usize> = (0..spread.len()).collect();
    while let Some(parent) = parents.pop() {
        let [[.., extents], [children, ..], ..] = spread[parent];
        // `CwBvhNode` of obvhs: a bit for each slot that has a node.
        let slots: Vec<usize> = (0..8).filter(|slot| extents >> (24 + slot) & 1 == 1).collect();
        let (Some(&first), Some(&last)) = (slots.first(), slots.last()) else { continue };
        let base = spread.len().saturating_sub(first);
        spread.resize(base + last + 1, [[0; 4]; 5]);
        spread[parent][1][0] = base as u32;
        for (child, slot) in (children as usize..).zip(slots) {
            spread[base + slot] = nodes[child];
            parents.push(base + slot);
        }
    }
    spread
}

/// The most places of nodes of a tree over so many triangles. Where two of a node's children are nodes, or more, there are at most
/// eight places between them, and two triangles to each such node; where one is, one place, and one triangle.
pub(super) fn most_nodes(triangles: usize) -> usize {
    4 * triangles + 4
}

fn mesh<'a>(drawn: &'a Drawn, instance: usize) -> &'a Mesh {
    drawn.mesh_of(instance)
}

fn triangles(drawn: &Drawn, instance: usize) -> Vec<Triangle> {
    let (mesh, world_from_mesh) = (mesh(drawn, instance), drawn.instances[instance].world_from_mesh.as_dmat4());
    let corner = |corner: u32| world_from_mesh.transform_point3(mesh.positions[corner as usize].as_dvec3());
    let triangles = mesh.indices.as_chunks::<3>().0.iter().enumerate();
    triangles.map(|(at, corners)| Triangle::new(corners.map(corner), instance as u32, at as u32)).collect()
}

impl Opacities {
    pub fn new(drawn: &Drawn) -> Self {
        let (scene, mut found) = (drawn.scene, Self::default());
        let mut images: Vec<Option<u32>> = vec![None; scene.images.len()];
        let mut looks = Vec::with_capacity(drawn.materials.len());
        for material in &drawn.materials {
            let look = found.look(scene, material, &mut images);
            looks.push(look.map(|_| found.looks.len() as u32));
            found.looks.extend(look);
        }
        for instance in 0..drawn.scene.instances.len() {
            let mesh = mesh(drawn, instance);
            let look = looks[mesh.material];
            found.first_of.push(look.map(|_| found.records.len() as u32));
            if let Some(look) = look {
                let record = |corners: &[u32; 3]| record(mesh, &drawn.materials[mesh.material], look, *corners);
                found.records.extend(mesh.indices.as_chunks::<3>().0.iter().map(record));
            }
        }
        found
    }

    /// What `blockers_texel` and `blockers_opacity` read of a material; nothing of one that is opaque.
    fn look(&mut self, scene: &Scene, material: &Material, images: &mut [Option<u32>]) -> Option<[Words; 2]> {
        let cutoff: f32 = match material.alpha_mode {
            AlphaMode::Opaque => return None,
            AlphaMode::Mask { cutoff } => cutoff,
            AlphaMode::Blend => -1.0,
        };
        let factors = [material.opacity.to_bits(), cutoff.to_bits(), 0, 0];
        let Some(used) = material.texture(TextureSlot::BaseColor) else { return Some([[0; 4], factors]) };
        let texture = scene.textures[used.texture];
        let image = &scene.images[texture.image];
        if image.texels.iter().all(|texel| texel[3] == u8::MAX) {
            return Some([[0; 4], factors]);
        }
        let first = *images[texture.image].get_or_insert_with(|| {
            let first = self.alphas.len() as u32;
            self.alphas.extend(image.texels.iter().map(|texel| texel[3]));
            first
        });
        Some([[first, image.width, image.height, bits(texture.sampler)], factors])
    }
}

/// As `blockers_texel` reads them.
fn bits(sampler: Sampler) -> u32 {
    let wrap = |wrap: Wrap| match wrap {
        Wrap::Repeat => 0,
        Wrap::Mirror => 1,
        Wrap::Clamp => 2,
    };
    let [u, v] = sampler.wrap.map(wrap);
    u | v << 2 | u32::from(sampler.magnify == Filter::Nearest) << 4
}

/// A triangle's texture coordinates, opacities, and its look.
fn record(mesh: &Mesh, material: &Material, look: u32, corners: [u32; 3]) -> [Words; 2] {
    let uv = |corner: u32| {
        let Some(used) = material.texture(TextureSlot::BaseColor) else { return DVec2::ZERO };
        let at = mesh.tex_coords[used.tex_coord].get(corner as usize).copied().unwrap_or(Vec2::ZERO);
        used.uv_from_tex_coord.as_daffine2().transform_point2(at.as_dvec2())
    };
    let [a, b, c] = corners.map(|corner| uv(corner).as_vec2());
    let alpha = |corner: u32| mesh.colors.get(corner as usize).map_or(u32::from(u16::MAX), |color| color[3].into());
    let [first, second, third] = corners.map(alpha);
    [
        [a.x.to_bits(), a.y.to_bits(), b.x.to_bits(), b.y.to_bits()],
        [c.x.to_bits(), c.y.to_bits(), first | second << 16, third | look << 16],
    ]
}

#[cfg(test)]
mod tests {
    use glam::Mat4;
    use rand::SeedableRng;
    use rand_pcg::Pcg64;

    use super::*;
    use crate::math::warp::{uniform, unit_sphere};
    use crate::scene::{Edits, Instance};

    /// A triangle of the last material, which is cut out, after so many that are opaque.
    fn after(opaque: usize) -> Scene {
        let mut materials = vec![Material::matte("opaque", Vec3::ONE); opaque];
        materials.push(Material { alpha_mode: AlphaMode::Mask { cutoff: 0.25 }, ..Material::matte("cut", Vec3::ONE) });
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
        let mesh = Mesh { positions, indices: vec![0, 1, 2], material: opaque, ..Mesh::default() };
        let instance = Instance { name: String::new(), mesh: 0, world_from_mesh: Mat4::IDENTITY };
        Scene { meshes: vec![mesh], instances: vec![instance], materials, ..Scene::default() }
    }

    /// Its index took more than the bits that a record has for a look.
    #[test]
    fn a_look_is_found_whatever_its_material_s_index() {
        for opaque in [0, 3, MOST_LOOKS + 4] {
            let (scene, edits) = (after(opaque), Edits::default());
            let opacities = Opacities::new(&Drawn::new(&scene, &edits));
            let [[_, [_, _, _, last]]] = opacities.records[..] else { panic!("a record for each triangle") };
            let [_, [_, cutoff, ..]] = opacities.looks[(last >> 16) as usize];
            assert_eq!((f32::from_bits(cutoff), opacities.looks.len()), (0.25, 1), "after {opaque}");
        }
    }

    /// `RAYS_STACK` of `rays.wgsl`.
    const STACK: usize = 32;

    /// Follows the nodes as `rays_passing` does, all of them: the triangles that it comes to, in order, and how many groups wait at most.
    fn walked(nodes: &[[Words; 5]]) -> (Vec<u32>, usize) {
        let (mut met, mut most, mut waiting) = (Vec::new(), 0, vec![(0, 0)]);
        while let Some((place, groups)) = waiting.pop() {
            let [children, first, metas @ ..] = nodes[place][1];
            let metas: [u8; 8] = bytemuck::cast(metas);
            // While one child is gone through, the others wait.
            let groups = groups + usize::from(metas.iter().filter(|&&meta| meta & 31 >= 24).count() > 1);
            most = groups.max(most);
            for (slot, meta) in metas.into_iter().enumerate() {
                match meta & 31 {
                    24.. => waiting.push((children as usize + slot, groups)),
                    at => met.extend((0..(meta >> 5).count_ones()).map(|index| first + u32::from(at) + index)),
                }
            }
        }
        met.sort_unstable();
        (met, most)
    }

    /// Triangles everywhere; and each a little smaller than the one around it, down to what `f64` tells apart.
    #[test]
    fn all_triangles_are_found_in_the_room_that_there_is() {
        let mut rng = Pcg64::seed_from_u64(4);
        let mut corners = |center: DVec3, size: f64| [0; 3].map(|_| center + size * unit_sphere(&mut rng));
        let mut everywhere = Pcg64::seed_from_u64(5);
        for count in [1, 2, 3, 9, 25, 60, 400, 5000] {
            let spread_out = (0..count).map(|_| unit_sphere(&mut everywhere) * uniform(&mut everywhere));
            let spread_out: Vec<[DVec3; 3]> = spread_out.map(|center| corners(center, 0.02)).collect();
            let nested = |ratio: f64| -> Vec<[DVec3; 3]> {
                (0..count).map(|at| [DVec3::X, DVec3::Y, -DVec3::ONE].map(|corner| corner * ratio.powi(at))).collect()
            };
            for corners in [spread_out, nested(0.5), nested(0.9), nested(0.99)] {
                let triangles = corners.into_iter().zip(0..).map(|(corners, index)| Triangle::new(corners, 0, index));
                let bvh = Bvh::new(triangles.collect());
                let nodes = spread(&bytemuck::pod_collect_to_vec::<u8, [Words; 5]>(bvh.nodes()));
                let (met, groups) = walked(&nodes);
                assert!(met.into_iter().eq(0..count as u32), "{count}");
                assert!(nodes.len() <= most_nodes(count as usize), "{} of {count}", nodes.len());
                // One of them may be the other tree's root.
                assert!(groups < STACK, "{groups} of {count}");
            }
        }
    }
}
