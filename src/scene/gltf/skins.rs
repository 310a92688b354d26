//! Skins, as far as their joints are in the pose in which they were bound.

use std::collections::HashMap;

use glam::{DAffine3, DMat4};
use gltf::json::Root;
use gltf::json::accessor::Type;

use super::Fault;
use super::accessor::{Accessors, Numbers};
use super::nodes::Placed;
use crate::scene::error::label;

/// How far joints' matrices may differ, relative to their largest entry or to 1, whichever is greater.
const POSE_TOLERANCE: f64 = 1e-4;

/// The skins of a file, each examined once.
pub struct Skins<'a> {
    root: &'a Root,
    /// Where each node stands; `None` for those that are not in the scene.
    world_from_node: Vec<Option<DAffine3>>,
    known: HashMap<usize, Option<DAffine3>>,
}

impl<'a> Skins<'a> {
    pub fn new(root: &'a Root, placed: &[Placed]) -> Self {
        let mut world_from_node = vec![None; if root.skins.is_empty() { 0 } else { root.nodes.len() }];
        if !root.skins.is_empty() {
            placed.iter().for_each(|place| world_from_node[place.node] = Some(place.world_from_node));
        }
        Self { root, world_from_node, known: HashMap::new() }
    }

    /// Where a skin puts the mesh that wears it, whatever the mesh's node: a joint's place times its inverse bind
    /// matrix, where that is the same for all joints, so that weights do not matter (glTF 2.0, section 3.7.3.3). `None`
    /// where it differs.
    pub fn world_from_mesh(&mut self, accessors: &Accessors, skin: usize) -> Result<Option<DAffine3>, Fault> {
        if let Some(&known) = self.known.get(&skin) {
            return Ok(known);
        }
        let place = || label("skin", skin, self.root.skins[skin].name.as_deref());
        let found = self.common(accessors, skin).map_err(|fault| Fault::at(place(), fault))?;
        self.known.insert(skin, found);
        Ok(found)
    }

    fn common(&self, accessors: &Accessors, skin: usize) -> Result<Option<DAffine3>, Fault> {
        let skin = &self.root.skins[skin];
        let joints: Vec<u32> = (0..skin.joints.len() as u32).collect();
        let bound: Vec<[f32; 16]> = match &skin.inverse_bind_matrices {
            None => vec![glam::Mat4::IDENTITY.to_cols_array(); joints.len()],
            Some(matrices) => {
                let count = accessors.count(matrices.value())?;
                if count < joints.len() {
                    let what = "joints and fewer inverseBindMatrices; export the file again";
                    return Err(Fault::new(format_args!("has {} {what}", joints.len())));
                }
                accessors.read(matrices.value(), Type::Mat4, Numbers::Floats, Some(&joints))?
            }
        };
        let mut common: Option<DAffine3> = None;
        for (joint, bound) in skin.joints.iter().zip(bound) {
            let Some(world_from_joint) = self.world_from_node[joint.value()] else { return Ok(None) };
            let joint_from_mesh = DAffine3::from_mat4(DMat4::from_cols_array(&bound.map(f64::from)));
            let world_from_mesh = world_from_joint * joint_from_mesh;
            let first = *common.get_or_insert(world_from_mesh);
            let largest = first.to_cols_array().into_iter().fold(1.0, |largest: f64, entry| largest.max(entry.abs()));
            if !first.abs_diff_eq(world_from_mesh, POSE_TOLERANCE * largest) {
                return Ok(None);
            }
        }
        Ok(common)
    }
}
