//! The tree of nodes: checked to be one, then walked.

use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};
use gltf::json::scene::Node;
use gltf::json::{Index, Root};

use super::Fault;
use crate::scene::error::label;

/// How far a rotation's length may be from 1 before it is normalised: far more than exporters that round need.
const ROTATION_TOLERANCE: f64 = 1e-2;

/// A node of the scene, and where it stands.
pub struct Placed {
    /// Index into the file's nodes.
    pub node: usize,
    pub world_from_node: DAffine3,
    /// The rotations of the node and of those above it, without scales: for things that no scale may mirror.
    pub rotation: DQuat,
}

/// `node 3 "sleeve"`.
pub fn node_label(root: &Root, index: usize) -> String {
    label("node", index, root.nodes.get(index).and_then(|node| node.name.as_deref()))
}

/// The nodes of the default scene, else of the first, else, where there is no scene, all nodes: parents before
/// children, siblings in the file's order. All nodes are checked, whether in the scene or not.
pub fn place(root: &Root) -> Result<Vec<Placed>, Fault> {
    let parents = parents(root)?;
    let local = root
        .nodes
        .iter()
        .enumerate()
        .map(|(index, node)| parent_from_node(node).map_err(|what| Fault::at(node_label(root, index), what)));
    let local: Vec<Local> = local.collect::<Result<_, _>>()?;
    let roots = scene_roots(root, &parents)?;
    // Not by recursion: chains of nodes may be of any length.
    let start = Local { transform: DAffine3::IDENTITY, rotation: DQuat::IDENTITY };
    let mut open: Vec<(usize, Local)> = roots.into_iter().rev().map(|node| (node, start)).collect();
    let mut placed = Vec::new();
    while let Some((node, above)) = open.pop() {
        let (transform, rotation) =
            (above.transform * local[node].transform, (above.rotation * local[node].rotation).normalize());
        placed.push(Placed { node, world_from_node: transform, rotation });
        let children = root.nodes[node].children.iter().flatten().rev();
        open.extend(children.map(|child| (child.value(), Local { transform, rotation })));
    }
    Ok(placed)
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

fn scene_roots(root: &Root, parents: &[Option<usize>]) -> Result<Vec<usize>, Fault> {
    let check = |scene: usize, nodes: &[Index<Node>]| {
        let place = || label("scene", scene, root.scenes[scene].name.as_deref());
        let mut listed = vec![false; parents.len()];
        for node in nodes {
            let what = match parents.get(node.value()) {
                None => format!("there is no node {node}; export the file again"),
                Some(Some(parent)) => format!("node {node} is no root: it is a child of node {parent}; list its root"),
                Some(None) if std::mem::replace(&mut listed[node.value()], true) => {
                    format!("lists node {node} twice; list it once")
                }
                Some(None) => continue,
            };
            return Err(Fault::at(place(), what));
        }
        Ok(())
    };
    root.scenes.iter().enumerate().try_for_each(|(index, scene)| check(index, &scene.nodes))?;
    let wanted = root.scene.map(|scene| scene.value());
    match (wanted, root.scenes.get(wanted.unwrap_or(0))) {
        (_, Some(scene)) => Ok(scene.nodes.iter().map(|node| node.value()).collect()),
        (None, None) => Ok((0..parents.len()).filter(|&node| parents[node].is_none()).collect()),
        (Some(index), None) => {
            Err(Fault::at("scene", format_args!("there is no scene {index}; name one of the file's")))
        }
    }
}

/// A transform, and the rotation in it.
#[derive(Clone, Copy)]
struct Local {
    transform: DAffine3,
    rotation: DQuat,
}

/// A node's own transform, or what is wrong with it.
fn parent_from_node(node: &Node) -> Result<Local, String> {
    let has_parts = node.translation.is_some() || node.rotation.is_some() || node.scale.is_some();
    if let Some(matrix) = &node.matrix {
        if has_parts {
            return Err("has both a matrix and translation, rotation or scale; keep one".to_owned());
        }
        let transform = affine(matrix)?;
        return Ok(Local { transform, rotation: rotation_of(transform) });
    }
    let vector =
        |name: &str, value: Option<[f32; 3]>, default: DVec3| match value.map(|v| DVec3::from(v.map(f64::from))) {
            Some(vector) if !vector.is_finite() => Err(format!("{name} is {vector}; give finite numbers")),
            vector => Ok(vector.unwrap_or(default)),
        };
    let translation = vector("translation", node.translation, DVec3::ZERO)?;
    let scale = vector("scale", node.scale, DVec3::ONE)?;
    let rotation = node.rotation.map_or(DQuat::IDENTITY, |rotation| DQuat::from_array(rotation.0.map(f64::from)));
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

fn affine(matrix: &[f32; 16]) -> Result<DAffine3, String> {
    if let Some(value) = matrix.iter().find(|value| !value.is_finite()) {
        return Err(format!("its matrix holds {value}; give finite numbers"));
    }
    let matrix = DMat4::from_cols_array(&matrix.map(f64::from));
    let last = matrix.row(3);
    if (last - glam::DVec4::W).abs().max_element() > 1e-6 {
        return Err(format!("the last row of its matrix is {last}, no affine transform's; make it 0, 0, 0, 1"));
    }
    Ok(DAffine3::from_mat4(matrix))
}
