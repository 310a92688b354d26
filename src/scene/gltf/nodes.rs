//! The tree of nodes: checked to be one, then walked.

use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};
use gltf::json::Root;

use super::Fault;
use super::exact::{self, Exact};
use crate::scene::error::label;
use crate::scene::notices::Notices;

/// How far a rotation's length may be from 1 before it is normalised: far more than exporters that round need.
const ROTATION_TOLERANCE: f64 = 1e-2;

/// A node of the scene, and where it stands.
pub struct Placed {
    /// Index into the file's nodes.
    pub node: usize,
    pub world_from_node: DAffine3,
    /// The rotations of the node and of those above it, without scales: for things that no scale may mirror.
    pub rotation: DQuat,
    /// Whether the scene lists it or one above it.
    is_in_scene: bool,
    /// Whether neither the node nor one above it is hidden (KHR_node_visibility).
    pub is_visible: bool,
    /// Its level in the tree; roots have 1.
    depth: u32,
}

/// The nodes of a file.
pub struct Nodes {
    /// Those of the scene: parents before children, siblings in the file's order.
    pub placed: Vec<Placed>,
    /// Where each of the file's nodes stands, in the scene or not; empty where the file has no skins.
    pub stands: Vec<Stand>,
}

/// Where a node stands that may be a joint.
#[derive(Clone, Copy, Default)]
pub struct Stand {
    pub world_from_node: DAffine3,
    /// Its level in the tree; roots have 1.
    pub depth: u32,
}

impl Nodes {
    /// Counts the places of the scene's nodes from another origin.
    pub fn count_from(&mut self, origin: DVec3) {
        self.placed.iter_mut().for_each(|place| place.world_from_node.translation -= origin);
    }
}

/// `node 3 "sleeve"`.
pub fn node_label(root: &Root, index: usize) -> String {
    label("node", index, root.nodes.get(index).and_then(|node| node.name.as_deref()))
}

/// Places the nodes of the default scene, else of the first, else, where there is no scene, all nodes. All are checked,
/// whether in the scene or not. `visible` has what each says of itself.
pub fn place(root: &Root, exact: &Exact, visible: &[bool], notices: &mut Notices) -> Result<Nodes, Fault> {
    let parents = parents(root)?;
    let local = exact
        .nodes
        .iter()
        .enumerate()
        .map(|(index, node)| parent_from_node(node).map_err(|what| Fault::at(node_label(root, index), what)));
    let local: Vec<Local> = local.collect::<Result<_, _>>()?;
    let mut is_listed = vec![false; parents.len()];
    let mut roots = listed(root, &parents, notices)?;
    roots.iter().for_each(|&node| is_listed[node] = true);
    // Below other roots there may be joints, and nodes that are listed though they are no roots.
    roots.retain(|&node| parents[node].is_none());
    roots.extend((0..parents.len()).filter(|&node| parents[node].is_none() && !is_listed[node]));
    let mut placed = walk(root, &local, &is_listed, visible, roots);
    let mut stands = Vec::new();
    if !root.skins.is_empty() {
        stands.resize(root.nodes.len(), Stand::default());
        for &Placed { node, world_from_node, depth, .. } in &placed {
            stands[node] = Stand { world_from_node, depth };
        }
    }
    placed.retain(|place| place.is_in_scene);
    Ok(Nodes { placed, stands })
}

/// All nodes, from these roots down: parents before children, siblings in the file's order.
fn walk(root: &Root, local: &[Local], is_listed: &[bool], visible: &[bool], roots: Vec<usize>) -> Vec<Placed> {
    let place = |node: usize, above: &Placed| Placed {
        node,
        world_from_node: above.world_from_node * local[node].transform,
        rotation: (above.rotation * local[node].rotation).normalize(),
        is_in_scene: above.is_in_scene || is_listed[node],
        is_visible: above.is_visible && visible[node],
        depth: above.depth + 1,
    };
    let world = Placed {
        node: usize::MAX,
        world_from_node: DAffine3::IDENTITY,
        rotation: DQuat::IDENTITY,
        is_in_scene: false,
        is_visible: true,
        depth: 0,
    };
    // Not by recursion: chains of nodes may be of any length.
    let mut open: Vec<Placed> = roots.into_iter().rev().map(|node| place(node, &world)).collect();
    let mut placed = Vec::with_capacity(local.len());
    while let Some(next) = open.pop() {
        let children = root.nodes[next.node].children.iter().flatten().rev();
        open.extend(children.map(|child| place(child.value(), &next)));
        placed.push(next);
    }
    placed
}

/// The parent of each node, once it is certain that the nodes form trees.
fn parents(root: &Root) -> Result<Vec<Option<usize>>, Fault> {
    let mut parents = vec![None; root.nodes.len()];
    for (index, node) in root.nodes.iter().enumerate() {
        for child in node.children.iter().flatten() {
            let place = || node_label(root, index);
            let Some(parent) = parents.get_mut(child.value()) else {
                return Err(Fault::at(place(), format_args!("there is no node {child}; export the file again")));
            };
            if let Some(other) = parent.replace(index) {
                let what = format_args!("is a child of node {other} and of node {index}; give each its own copy");
                return Err(Fault::at(node_label(root, child.value()), what));
            }
        }
    }
    match cycle(&parents) {
        None => Ok(parents),
        Some(node) => {
            Err(Fault::at(node_label(root, node), "is its own ancestor (a cycle of nodes); export the file again"))
        }
    }
}

/// A node on a cycle, if there is one, in a graph in which each node has at most one parent.
fn cycle(parents: &[Option<usize>]) -> Option<usize> {
    // The walk on which each node was first met: whoever meets one twice on the same walk is going in circles.
    let mut met = vec![usize::MAX; parents.len()];
    for start in 0..parents.len() {
        let mut node = start;
        while met[node] == usize::MAX {
            met[node] = start;
            match parents[node] {
                None => break,
                Some(parent) if met[parent] == start => return Some(parent),
                Some(parent) => node = parent,
            }
        }
    }
    None
}

/// The nodes that the scene lists, each once, after a check of all scenes. They should be roots.
fn listed(root: &Root, parents: &[Option<usize>], notices: &mut Notices) -> Result<Vec<usize>, Fault> {
    let place = |scene: usize| label("scene", scene, root.scenes[scene].name.as_deref());
    let count = parents.len();
    for (index, scene) in root.scenes.iter().enumerate() {
        if let Some(node) = scene.nodes.iter().find(|node| node.value() >= count) {
            return Err(Fault::at(place(index), format_args!("there is no node {node}; export the file again")));
        }
    }
    let wanted = root.scene.map(|scene| scene.value());
    let index = wanted.unwrap_or(0);
    let scene = match (wanted, root.scenes.get(index)) {
        (_, Some(scene)) => scene,
        (None, None) => return Ok((0..count).filter(|&node| parents[node].is_none()).collect()),
        (Some(_), None) => {
            return Err(Fault::at("scene", format_args!("there is no scene {index}; name one of the file's")));
        }
    };
    let mut known = vec![false; count];
    let mut nodes: Vec<usize> = scene.nodes.iter().map(|node| node.value()).collect();
    nodes.retain(|&node| {
        let place = || format!("{} of {}", node_label(root, node), place(index));
        let is_known = std::mem::replace(&mut known[node], true);
        if is_known {
            notices.add("nodes that a scene lists twice are drawn once", place);
        } else if parents[node].is_some() {
            let kind = "nodes that a scene lists and that stand below others are drawn where they stand";
            notices.add(kind, place);
        }
        !is_known
    });
    Ok(nodes)
}

/// A transform, and the rotation in it.
#[derive(Clone, Copy)]
struct Local {
    transform: DAffine3,
    rotation: DQuat,
}

/// A node's own transform, or what is wrong with it.
fn parent_from_node(node: &exact::Node) -> Result<Local, String> {
    let has_parts = node.translation.is_some() || node.rotation.is_some() || node.scale.is_some();
    if let Some(matrix) = &node.matrix {
        if has_parts {
            return Err("has both a matrix and translation, rotation or scale; keep one".to_owned());
        }
        let transform = affine(matrix)?;
        return Ok(Local { transform, rotation: rotation_of(transform) });
    }
    let translation = node.translation.map_or(DVec3::ZERO, DVec3::from);
    let scale = node.scale.map_or(DVec3::ONE, DVec3::from);
    let rotation = node.rotation.map_or(DQuat::IDENTITY, DQuat::from_array);
    let length = rotation.length();
    if !((1.0 - ROTATION_TOLERANCE)..=(1.0 + ROTATION_TOLERANCE)).contains(&length) {
        return Err(format!("rotation is a quaternion of length {length}; give one of length 1"));
    }
    let rotation = rotation.normalize();
    Ok(Local { transform: DAffine3::from_scale_rotation_translation(scale, rotation, translation), rotation })
}

/// The rotation that takes z where a transform takes it, and y as near as can be to where that takes it; no rotation
/// where the transform leaves no such directions.
fn rotation_of(transform: DAffine3) -> DQuat {
    let axes = transform.matrix3;
    let back = axes.z_axis.try_normalize();
    let up = back.and_then(|back| (axes.y_axis - back * axes.y_axis.dot(back)).try_normalize());
    let rotation = back.zip(up).map(|(back, up)| DQuat::from_mat3(&DMat3::from_cols(up.cross(back), up, back)));
    rotation.unwrap_or(DQuat::IDENTITY)
}

fn affine(matrix: &[f64; 16]) -> Result<DAffine3, String> {
    let matrix = DMat4::from_cols_array(matrix);
    let last = matrix.row(3);
    if (last - glam::DVec4::W).abs().max_element() > 1e-6 {
        return Err(format!("the last row of its matrix is {last}, no affine transform's; make it 0, 0, 0, 1"));
    }
    Ok(DAffine3::from_mat4(matrix))
}
