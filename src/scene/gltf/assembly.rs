//! Meshes and instances of a scene, out of its placed nodes.

use std::collections::HashMap;

use glam::{DAffine3, DMat4, DVec3, Vec3};
use gltf::json::Root;

use super::accessor::Accessors;
use super::nodes::{Placed, node_label};
use super::primitives::Reader;
use super::{Fault, name};
use crate::scene::error::label;
use crate::scene::notices::Notices;
use crate::scene::{Bounds, Instance, Material, Scene};

/// A few bytes of a file put a mesh of many primitives at one more node.
const INSTANCES_MAX: usize = 1 << 20;
/// Metres from the origin within which things stand: beyond Saturn, and the cube of it fits in 32-bit floats.
const REACH: f64 = 1e12;
/// A transform whose axes, made unit, span less than this much volume has no inverse in 32-bit floats.
const SINGULAR: f64 = 1e-6;
/// Shortest axis of a transform: the square of anything shorter is nothing in 32-bit floats.
const SHORTEST: f64 = 1e-18;

/// `mesh 3 "sleeve" primitive 0`.
fn primitive_label(root: &Root, mesh: usize, primitive: usize) -> String {
    format!("{} primitive {primitive}", label("mesh", mesh, root.meshes[mesh].name.as_deref()))
}

/// Fills a scene.
pub struct Assembly<'a> {
    root: &'a Root,
    reader: Reader<'a>,
    scene: &'a mut Scene,
    notices: &'a mut Notices,
    /// What each of the file's meshes has become: indices into the scene's, and their bounds.
    meshes: HashMap<usize, Vec<(usize, Bounds)>>,
    default_material: Option<usize>,
}

impl<'a> Assembly<'a> {
    /// `scene` holds the file's materials.
    pub fn new(accessors: Accessors<'a>, scene: &'a mut Scene, notices: &'a mut Notices) -> Self {
        let (root, reader) = (accessors.root, Reader::new(accessors));
        Self { root, reader, scene, notices, meshes: HashMap::new(), default_material: None }
    }

    /// Adds an instance for each primitive at a node, and the meshes that these show.
    pub fn add(mut self, placed: &[Placed]) -> Result<(), Fault> {
        for &Placed { node: index, world_from_node } in placed {
            let node = &self.root.nodes[index];
            let Some(mesh) = node.mesh else { continue };
            if node.skin.is_some() {
                self.notices.add("skins are not applied", || node_label(self.root, index));
            }
            self.load(mesh.value())?;
            let wrong = |what: String| Fault::at(node_label(self.root, index), what);
            for &(mesh, bounds) in &self.meshes[&mesh.value()] {
                check_reach(world_from_node, bounds.min.abs().max(bounds.max.abs())).map_err(wrong)?;
                if is_singular(world_from_node) {
                    continue;
                }
                if self.scene.instances.len() == INSTANCES_MAX {
                    return Err(wrong(format!("more than {INSTANCES_MAX} primitives at nodes; split the file")));
                }
                let name = name(node.name.as_deref());
                let world_from_mesh = DMat4::from(world_from_node).as_mat4();
                self.scene.instances.push(Instance { name, mesh, world_from_mesh });
            }
        }
        Ok(())
    }

    /// Reads a mesh of the file unless that has been done.
    fn load(&mut self, mesh: usize) -> Result<(), Fault> {
        if self.meshes.contains_key(&mesh) {
            return Ok(());
        }
        let mut parts = Vec::new();
        for (index, primitive) in self.root.meshes[mesh].primitives.iter().enumerate() {
            let name = primitive_label(self.root, mesh, index);
            let material = primitive.material.map_or_else(|| self.default_material(), |material| material.value());
            let read = self.reader.read(primitive, material, name.clone(), self.notices);
            if let Some(read) = read.map_err(|fault| Fault::at(name, fault))? {
                parts.push((self.scene.meshes.len(), Bounds::of_points(&read.positions)));
                self.scene.meshes.push(read);
            }
        }
        self.meshes.insert(mesh, parts);
        Ok(())
    }

    fn default_material(&mut self) -> usize {
        *self.default_material.get_or_insert_with(|| {
            self.scene.materials.push(Material { name: "default".to_owned(), ..Material::default() });
            self.scene.materials.len() - 1
        })
    }
}

/// Whether 32-bit floats can place points whose coordinates are up to `extent`; else what is wrong.
pub fn check_reach(world_from_node: DAffine3, extent: Vec3) -> Result<(), String> {
    let matrix = world_from_node.matrix3;
    // No sum on the way to a placed coordinate is greater.
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(DVec3::abs);
    let extent = extent.as_dvec3();
    let reach = x * extent.x + y * extent.y + z * extent.z + world_from_node.translation.abs();
    let values = [reach, x, y, z].into_iter().flat_map(|vector| vector.to_array());
    match values.into_iter().find(|value| value.is_nan() || *value > REACH) {
        None => Ok(()),
        Some(value) => Err(format!("reaches {value:e} m in the world; bring it within {REACH:e} m of the origin")),
    }
}

/// Scaled to nothing along some axis: glTF's way to hide a thing.
fn is_singular(world_from_node: DAffine3) -> bool {
    let matrix = world_from_node.matrix3;
    let lengths = [matrix.x_axis.length(), matrix.y_axis.length(), matrix.z_axis.length()];
    let volume = matrix.determinant().abs();
    lengths.iter().any(|&length| length < SHORTEST) || volume < SINGULAR * lengths.iter().product::<f64>()
}
