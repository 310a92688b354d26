//! A scene's meshes and instances, made from its placed nodes.

use std::collections::HashMap;
use std::rc::Rc;

use glam::{DAffine3, DVec3, Vec3};
use gltf::json::Root;

use super::accessor::Accessors;
use super::instancing::Places;
use super::nodes::{Nodes, Placed, node_label};
use super::primitives::{Reader, Shape, Shaped};
use super::skins::{Bones, Skins};
use super::{Fault, Pose, cut, instancing, materials, morph};
use crate::scene::error::label;
use crate::scene::notices::Notices;
use crate::scene::{Bounds, FARTHEST, Instance, Mesh, Scene};

/// The most instances: with a few bytes a file puts a mesh of many primitives at one more node.
const INSTANCES_MAX: usize = 1 << 20;
/// Metres from the origin within which things must stand.
const REACH: f64 = FARTHEST as f64;
/// A transform whose axes, made unit, span less than this volume has no inverse in 32-bit floats.
const SINGULAR: f64 = 1e-6;
/// A mesh whose middle is this near to its origin, in lengths of its bounds' diagonal, stays where it is.
const NEAR: f64 = 2.0;
/// Shortest axis of a transform in metres: the square of anything shorter is lost in 32-bit floats.
const SHORTEST: f64 = 1e-18;

/// `mesh 3 "sleeve" primitive 0`.
pub fn primitive_label(root: &Root, mesh: usize, primitive: usize) -> String {
    let name = root.meshes.get(mesh).and_then(|mesh| mesh.name.as_deref());
    format!("{} primitive {primitive}", label("mesh", mesh, name))
}

/// What the scene's meshes are made of: a mesh of the file, and what shapes it.
#[derive(Clone, PartialEq, Eq, Hash)]
struct Model {
    mesh: usize,
    /// The skin by whose joints it is bent.
    skin: Option<usize>,
    /// The bits of its morph targets' weights.
    weights: Vec<u32>,
}

/// A mesh of the scene where the file puts it.
pub struct Placement {
    /// The node's name.
    pub name: String,
    /// Index into the scene's meshes.
    pub mesh: usize,
    /// To the space of the file.
    pub world_from_mesh: DAffine3,
}

/// A primitive of a model.
#[derive(Clone, Copy)]
struct Part {
    /// Index into the scene's meshes.
    mesh: usize,
    bounds: Bounds,
    /// By how much its positions have been moved: from the file's mesh to the scene's is `-center`.
    center: DVec3,
    /// Whether it is bound to joints.
    is_bound: bool,
    /// Where in the world joints have put the mesh's origin, if they have.
    origin: Option<DVec3>,
}

/// Fills a scene.
pub struct Assembly<'a> {
    root: &'a Root,
    reader: Reader<'a>,
    scene: &'a mut Scene,
    notices: &'a mut Notices,
    /// What each model has become.
    models: HashMap<Model, Rc<[Part]>>,
    placements: Vec<Placement>,
    /// How many primitives have been placed, seen or not.
    placed: usize,
    default_material: Option<usize>,
}

impl<'a> Assembly<'a> {
    /// `scene` holds the file's materials already.
    pub fn new(accessors: Accessors<'a>, scene: &'a mut Scene, notices: &'a mut Notices) -> Self {
        let (root, reader) = (accessors.root, Reader::new(accessors));
        Self {
            root,
            reader,
            scene,
            notices,
            models: HashMap::new(),
            placements: Vec::new(),
            placed: 0,
            default_material: None,
        }
    }

    /// Adds the meshes at visible nodes, and says where their primitives stand.
    pub fn add(mut self, nodes: &Nodes, pose: Pose) -> Result<Vec<Placement>, Fault> {
        let mut skins = Skins::new(self.root, &nodes.stands, pose);
        for place in nodes.placed.iter().filter(|place| place.is_visible) {
            let node = &self.root.nodes[place.node];
            let Some(mesh) = node.mesh.map(|mesh| mesh.value()) else { continue };
            let weights = match pose {
                Pose::File => self.weights(place.node, mesh)?,
                Pose::Bind => &[],
            };
            let bones = node.skin.map(|skin| skins.get(&mut self.reader, skin.value())).transpose()?.flatten();
            let model = Model {
                mesh,
                skin: node.skin.map(|skin| skin.value()).filter(|_| matches!(bones, Some(Bones::Bent(_)))),
                weights: weights.iter().map(|weight| weight.to_bits()).collect(),
            };
            let joints = bones.as_ref().and_then(Bones::joints);
            let parts = self.load(model, Shape { weights, joints })?;
            self.place(place, &parts, bones.as_ref())?;
        }
        Ok(self.placements)
    }

    /// The weights of the morph targets of a node's mesh.
    fn weights(&mut self, node: usize, mesh: usize) -> Result<&'a [f32], Fault> {
        let label = || node_label(self.root, node);
        let wrong = |what: String| Fault::at(label(), what);
        let (node, mesh) = (&self.root.nodes[node], &self.root.meshes[mesh]);
        let weights = morph::weights(node, mesh);
        // Many nodes may share a mesh's long list.
        self.reader.charge(size_of_val(weights)).map_err(|fault| wrong(fault.to_string()))?;
        let count = mesh.primitives.first().map_or(0, morph::count);
        let is_given = node.weights.is_some() || mesh.weights.is_some();
        if is_given && weights.len() != count {
            let kind = "weights and morph targets of different numbers are paired as far as they go";
            self.notices.add(kind, || format!("{} and {count} of {}", weights.len(), label()));
        }
        morph::checked(weights).map_err(wrong)
    }

    /// Places the primitives of a node's mesh.
    fn place(&mut self, place: &Placed, parts: &[Part], bones: Option<&Bones>) -> Result<(), Fault> {
        if parts.is_empty() {
            return Ok(());
        }
        let label = || node_label(self.root, place.node);
        let most = INSTANCES_MAX.saturating_sub(self.placed) / parts.len();
        let places = instancing::places(&mut self.reader, place.node, most)?;
        for &part in parts {
            // Joints put what is bound to them where it stands, whatever the node.
            let by_joints = match (bones.filter(|_| part.is_bound), part.origin) {
                (Some(_), Some(origin)) => Some(DAffine3::from_translation(origin)),
                (Some(&Bones::Rigid(world_from_mesh)), None) => Some(world_from_mesh),
                _ => None,
            };
            match (by_joints, &places) {
                (Some(world_from_part), _) => {
                    if places.is_some() {
                        self.notices.add("meshes that joints move are drawn once, not at each instance", label);
                    }
                    self.push(place.node, part, world_from_part)?;
                }
                (None, Some(places)) => self.push_all(place, part, places)?,
                (None, None) => self.push(place.node, part, place.world_from_node)?,
            }
            if by_joints.is_none() && bones.is_some() {
                self.notices.add("meshes without joints and weights stand at their nodes, whatever the skin", label);
            }
        }
        Ok(())
    }

    /// Adds an instance at each place about a node.
    fn push_all(&mut self, place: &Placed, part: Part, places: &Places) -> Result<(), Fault> {
        let name = self.root.nodes[place.node].name.as_ref().map_or(0, String::len);
        let bytes = places.count().saturating_mul(size_of::<Instance>() + name);
        self.reader.charge(bytes).map_err(|fault| Fault::at(node_label(self.root, place.node), fault))?;
        places
            .node_from_instance()
            .try_for_each(|node_from_instance| self.push(place.node, part, place.world_from_node * node_from_instance))
    }

    /// Adds an instance, unless its transform leaves nothing of it.
    fn push(&mut self, node: usize, part: Part, world_from_mesh: DAffine3) -> Result<(), Fault> {
        let world_from_mesh = world_from_mesh * DAffine3::from_translation(part.center);
        let wrong = |what: String| Fault::at(node_label(self.root, node), what);
        check_reach(world_from_mesh, part.bounds.corners()).map_err(wrong)?;
        if self.placed == INSTANCES_MAX {
            return Err(wrong(format!("more than {INSTANCES_MAX} primitives at nodes; split the file")));
        }
        self.placed += 1;
        if is_singular(world_from_mesh) {
            self.notices.add("things scaled to nothing are not drawn", || node_label(self.root, node));
            return Ok(());
        }
        let name = cut(self.root.nodes[node].name.as_deref().unwrap_or_default());
        self.placements.push(Placement { name, mesh: part.mesh, world_from_mesh });
        Ok(())
    }

    /// Reads a model, unless it has been read already.
    fn load(&mut self, model: Model, shape: Shape) -> Result<Rc<[Part]>, Fault> {
        if let Some(parts) = self.models.get(&model) {
            return Ok(Rc::clone(parts));
        }
        let mut parts = Vec::new();
        for (index, primitive) in self.root.meshes[model.mesh].primitives.iter().enumerate() {
            let name = primitive_label(self.root, model.mesh, index);
            let material = primitive.material.map_or_else(|| self.default_material(), |material| material.value());
            let read = self.reader.read(primitive, &self.scene.materials[material], name.clone(), shape, self.notices);
            if let Some(Shaped { mut mesh, is_bound, origin }) = read.map_err(|fault| Fault::at(name, fault))? {
                let (center, bounds) = center(&mut mesh);
                parts.push(Part { mesh: self.scene.meshes.len(), bounds, center, is_bound, origin });
                self.scene.meshes.push(Mesh { material, ..mesh });
            }
        }
        let parts: Rc<[Part]> = parts.into();
        self.models.insert(model, Rc::clone(&parts));
        Ok(parts)
    }

    fn default_material(&mut self) -> usize {
        *self.default_material.get_or_insert_with(|| {
            self.scene.materials.push(materials::default_material());
            self.scene.materials.len() - 1
        })
    }
}

/// Moves a mesh that is far from its own origin to it: how far, and the bounds that it has there. Transforms in `f32`
/// would lose of it what its coordinates still tell apart.
fn center(mesh: &mut Mesh) -> (DVec3, Bounds) {
    let bounds = Bounds::of_points(&mesh.positions);
    let center = bounds.center().as_dvec3();
    if center.abs().max_element() <= NEAR * bounds.diagonal() {
        return (DVec3::ZERO, bounds);
    }
    mesh.positions.iter_mut().for_each(|position| *position = (position.as_dvec3() - center).as_vec3());
    (center, Bounds::of_points(&mesh.positions))
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
