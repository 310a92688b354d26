//! Skins: where their joints put what is bound to them.

use std::collections::HashMap;
use std::rc::Rc;

use glam::{DAffine3, DMat4, DVec3, Mat4};
use gltf::json::Root;
use gltf::json::accessor::Type;
use gltf::json::skin::Skin;

use super::accessor::{Accessors, Numbers};
use super::nodes::Stand;
use super::primitives::Reader;
use super::{Fault, Pose};
use crate::scene::FARTHEST;
use crate::scene::error::label;

/// How far the matrices of joints that agree may differ: relative to their largest axis in what they do to directions,
/// and to the distance between joints in where they put things. Rounding to 32 bits stays within it.
const AGREEMENT: f64 = 1e-5;

/// How a skin moves the vertices that are bound to it, whatever the node of their mesh (glTF 2.0, section 3.7.3.3):
/// each joint's place in the world times its inverse bind matrix.
#[derive(Clone)]
pub enum Bones {
    /// All as one.
    Rigid(DAffine3),
    /// By each vertex's weights.
    Bent(Rc<[DAffine3]>),
}

impl Bones {
    /// For each joint, the matrix that takes what is bound to it from the mesh to the world, where these differ.
    pub fn joints(&self) -> Option<&[DAffine3]> {
        match self {
            Self::Rigid(_) => None,
            Self::Bent(joints) => Some(joints),
        }
    }
}

/// The skins of a file, each examined once.
pub struct Skins<'a> {
    root: &'a Root,
    stands: &'a [Stand],
    pose: Pose,
    known: HashMap<usize, Option<Bones>>,
}

impl<'a> Skins<'a> {
    /// `stands` has all nodes of the file.
    pub fn new(root: &'a Root, stands: &'a [Stand], pose: Pose) -> Self {
        Self { root, stands, pose, known: HashMap::new() }
    }

    /// What a skin does to the meshes that wear it; `None` where it has no joints. Takes memory of the reader's budget.
    pub fn get(&mut self, reader: &mut Reader, skin: usize) -> Result<Option<Bones>, Fault> {
        if let Some(known) = self.known.get(&skin) {
            return Ok(known.clone());
        }
        let json = &self.root.skins[skin];
        let bytes = json.joints.len().saturating_mul(size_of::<DAffine3>() + size_of::<Mat4>());
        let found = reader
            .charge(bytes)
            .and_then(|()| self.examine(&reader.accessors, json))
            .map_err(|fault| Fault::at(label("skin", skin, json.name.as_deref()), fault))?;
        self.known.insert(skin, found.clone());
        Ok(found)
    }

    fn examine(&self, accessors: &Accessors, skin: &Skin) -> Result<Option<Bones>, Fault> {
        let matrices = self.world_from_mesh(accessors, skin)?;
        let depth = |joint: usize| self.stands[skin.joints[joint].value()].depth;
        let Some(nearest) = (0..matrices.len()).min_by_key(|&joint| depth(joint)) else { return Ok(None) };
        if self.pose == Pose::Bind || self.agree(skin, &matrices) {
            return Ok(Some(Bones::Rigid(matrices[nearest])));
        }
        Ok(Some(Bones::Bent(matrices.into())))
    }

    /// For each joint, the matrix that takes a vertex bound to it alone from the mesh to the world.
    fn world_from_mesh(&self, accessors: &Accessors, skin: &Skin) -> Result<Vec<DAffine3>, Fault> {
        let joints: Vec<u32> = (0..skin.joints.len() as u32).collect();
        let bound: Vec<[f32; 16]> = match &skin.inverse_bind_matrices {
            None => vec![Mat4::IDENTITY.to_cols_array(); joints.len()],
            Some(matrices) => {
                let count = accessors.count(matrices.value())?;
                if count < joints.len() {
                    let what = "joints and fewer inverseBindMatrices; export the file again";
                    return Err(Fault::new(format_args!("has {} {what}", joints.len())));
                }
                accessors.read(matrices.value(), Type::Mat4, Numbers::Floats, Some(&joints))?
            }
        };
        let placed = |(at, (joint, bound)): (usize, (&gltf::json::Index<_>, [f32; 16]))| {
            let joint_from_mesh = DAffine3::from_mat4(DMat4::from_cols_array(&bound.map(f64::from)));
            let world_from_mesh = self.stands[joint.value()].world_from_node * joint_from_mesh;
            let is_far = |entry: &f64| entry.is_nan() || entry.abs() > f64::from(FARTHEST);
            match world_from_mesh.to_cols_array().into_iter().find(is_far) {
                None => Ok(world_from_mesh),
                Some(entry) => {
                    let what = format_args!("joint {at} moves things by {entry:.2e}; bring it within {FARTHEST:e} m");
                    Err(Fault::new(what))
                }
            }
        };
        skin.joints.iter().zip(bound).enumerate().map(placed).collect()
    }

    /// Whether all joints put things in the same place, so that weights do not matter.
    fn agree(&self, skin: &Skin, matrices: &[DAffine3]) -> bool {
        let at = |joint: usize| self.stands[skin.joints[joint].value()].world_from_node.translation;
        let spread = (1..matrices.len()).map(|joint| at(joint).distance(at(0))).fold(0.0, f64::max);
        let first = matrices[0];
        let largest =
            first.matrix3.to_cols_array().into_iter().fold(0.0, |largest: f64, entry| largest.max(entry.abs()));
        matrices.iter().all(|matrix| {
            let moved: DVec3 = (matrix.translation - first.translation).abs();
            matrix.matrix3.abs_diff_eq(first.matrix3, AGREEMENT * largest) && moved.max_element() <= AGREEMENT * spread
        })
    }
}
