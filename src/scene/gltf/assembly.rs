//! A scene's meshes and instances, made from its placed nodes.

use std::collections::HashMap;

use glam::{DAffine3, DMat4, Vec3};
use gltf::json::Root;

use super::accessor::Accessors;
use super::nodes::{Placed, node_label};
use super::primitives::Reader;
use super::skins::Skins;
use super::{Fault, cut, materials};
use crate::scene::error::label;
use crate::scene::notices::Notices;
use crate::scene::{Bounds, FARTHEST, Instance, Mesh, Scene};

/// The most instances: with a few bytes a file puts a mesh of many primitives at one more node.
const INSTANCES_MAX: usize = 1 << 20;
/// Metres from the origin within which things must stand.
const REACH: f64 = FARTHEST as f64;
/// A transform whose axes, made unit, span less than this volume has no inverse in 32-bit floats.
const SINGULAR: f64 = 1e-6;
/// Shortest axis of a transform in metres: the square of anything shorter is lost in 32-bit floats.
const SHORTEST: f64 = 1e-18;

/// `mesh 3 "sleeve" primitive 0`.
pub fn primitive_label(root: &Root, mesh: usize, primitive: usize) -> String {
    let name = root.meshes.get(mesh).and_then(|mesh| mesh.name.as_deref());
    format!("{} primitive {primitive}", label("mesh", mesh, name))
}

/// Fills a scene.
pub struct Assembly<'a> {
    root: &'a Root,
    reader: Reader<'a>,
    scene: &'a mut Scene,
    notices: &'a mut Notices,
    /// What each of the file's meshes has become: indices into the scene's meshes, and their bounds.
    meshes: HashMap<usize, Vec<(usize, Bounds)>>,
    default_material: Option<usize>,
}

impl<'a> Assembly<'a> {
    /// `scene` holds the file's materials already.
    pub fn new(accessors: Accessors<'a>, scene: &'a mut Scene, notices: &'a mut Notices) -> Self {
        let (root, reader) = (accessors.root, Reader::new(accessors));
        Self { root, reader, scene, notices, meshes: HashMap::new(), default_material: None }
    }

    /// Adds an instance for each primitive at a node, and the meshes of these instances.
    pub fn add(mut self, placed: &[Placed]) -> Result<(), Fault> {
        let mut skins = Skins::new(self.root, placed);
        for &Placed { node: index, world_from_node, .. } in placed {
            let node = &self.root.nodes[index];
            let Some(mesh) = node.mesh else { continue };
            let skin = node.skin.map(|skin| skins.world_from_mesh(&self.reader.accessors, skin.value())).transpose()?;
            if skin == Some(None) {
                let kind = "skins whose joints stand in another pose than they were bound in are not applied";
                self.notices.add(kind, || node_label(self.root, index));
            }
            let world_from_node = skin.flatten().unwrap_or(world_from_node);
            self.load(mesh.value())?;
            let wrong = |what: String| Fault::at(node_label(self.root, index), what);
            for &(mesh, bounds) in &self.meshes[&mesh.value()] {
                check_reach(world_from_node, bounds.corners()).map_err(wrong)?;
                if is_singular(world_from_node) {
                    self.notices.add("things scaled to nothing are not drawn", || node_label(self.root, index));
                    continue;
                }
                if self.scene.instances.len() == INSTANCES_MAX {
                    return Err(wrong(format!("more than {INSTANCES_MAX} primitives at nodes; split the file")));
                }
                let name = cut(node.name.as_deref().unwrap_or_default());
                let world_from_mesh = DMat4::from(world_from_node).as_mat4();
                self.scene.instances.push(Instance { name, mesh, world_from_mesh });
            }
        }
        Ok(())
    }

    /// Reads a mesh of the file, unless it has been read already.
    fn load(&mut self, mesh: usize) -> Result<(), Fault> {
        if self.meshes.contains_key(&mesh) {
            return Ok(());
        }
        let mut parts = Vec::new();
        for (index, primitive) in self.root.meshes[mesh].primitives.iter().enumerate() {
            let name = primitive_label(self.root, mesh, index);
            let material = primitive.material.map_or_else(|| self.default_material(), |material| material.value());
            let read = self.reader.read(primitive, &self.scene.materials[material], name.clone(), self.notices);
            if let Some(read) = read.map_err(|fault| Fault::at(name, fault))? {
                parts.push((self.scene.meshes.len(), Bounds::of_points(&read.positions)));
                self.scene.meshes.push(Mesh { material, ..read });
            }
        }
        self.meshes.insert(mesh, parts);
        Ok(())
    }

    fn default_material(&mut self) -> usize {
        *self.default_material.get_or_insert_with(|| {
            self.scene.materials.push(materials::default_material());
            self.scene.materials.len() - 1
        })
    }
}

/// Checks that `points`, once placed, stand where 32-bit floats can work with them; else says what is wrong.
pub fn check_reach<const N: usize>(world_from_node: DAffine3, points: [Vec3; N]) -> Result<(), String> {
    let matrix = world_from_node.matrix3;
    let entries = matrix.to_cols_array().into_iter().chain(world_from_node.translation.to_array());
    let placed = points.into_iter().flat_map(|point| world_from_node.transform_point3(point.as_dvec3()).to_array());
    match entries.chain(placed).find(|value| value.is_nan() || value.abs() > REACH) {
        None => Ok(()),
        Some(value) => Err(format!("reaches {value:.2e} m in the world; bring it within {REACH:e} m of the origin")),
    }
}

/// Whether a transform scales to nothing along some axis: glTF's way to hide a thing.
pub fn is_singular(world_from_node: DAffine3) -> bool {
    let matrix = world_from_node.matrix3;
    let lengths = [matrix.x_axis.length(), matrix.y_axis.length(), matrix.z_axis.length()];
    let volume = matrix.determinant().abs();
    lengths.iter().any(|&length| length < SHORTEST) || volume < SINGULAR * lengths.iter().product::<f64>()
}
