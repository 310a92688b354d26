//! EXT_mesh_gpu_instancing: a mesh that stands at many places about its node.

use glam::{DAffine3, DQuat, Vec3, Vec4};
use gltf::json::accessor::Type;
use serde::Deserialize;

use super::accessor::Numbers;
use super::nodes::node_label;
use super::primitives::Reader;
use super::{Fault, extensions};

const EXTENSION: &str = "EXT_mesh_gpu_instancing";

#[derive(Deserialize)]
struct Instancing {
    attributes: Attributes,
}

/// Accessors. Those of an application's own, whose names begin with an underscore, are nothing to draw.
#[derive(Deserialize)]
#[serde(rename_all = "UPPERCASE")]
struct Attributes {
    translation: Option<usize>,
    rotation: Option<usize>,
    scale: Option<usize>,
}

/// The places of a node's mesh.
pub struct Places {
    /// Each is empty where the file leaves it out, or has `count` elements.
    translations: Vec<Vec3>,
    rotations: Vec<Vec4>,
    scales: Vec<Vec3>,
    count: usize,
}

/// The places of a node's mesh, at most `most` of them; `None` where it stands once, at the node.
pub fn places(reader: &mut Reader, node: usize, most: usize) -> Result<Option<Places>, Fault> {
    let root = reader.accessors.root;
    let Some(Instancing { attributes }) = extensions::of_node(root, node, EXTENSION)? else { return Ok(None) };
    let place = || format!("{}: {EXTENSION}", node_label(root, node));
    Places::read(reader, &attributes, most).map_err(|fault| Fault::at(place(), fault))
}

impl Places {
    fn read(reader: &mut Reader, attributes: &Attributes, most: usize) -> Result<Option<Self>, Fault> {
        let &Attributes { translation, rotation, scale } = attributes;
        let mut counts = Vec::new();
        for accessor in [translation, rotation, scale].into_iter().flatten() {
            counts.push(reader.accessors.count(accessor)?);
        }
        let Some(&count) = counts.first() else { return Ok(None) };
        if let Some(other) = counts.iter().find(|&&other| other != count) {
            let what = "of its attributes one has";
            return Err(Fault::new(format_args!("{what} {count} elements and one {other}; export the file again")));
        }
        if count > most {
            return Err(Fault::new(format_args!("{count} instances are more than are served; split the file")));
        }
        reader.charge(count.saturating_mul(size_of::<DAffine3>()))?;
        let accessors = &reader.accessors;
        let vectors = |accessor: Option<usize>| {
            accessor.map_or(Ok(Vec::new()), |accessor| accessors.read(accessor, Type::Vec3, Numbers::Floats, None))
        };
        let (translations, scales) = (vectors(translation)?, vectors(scale)?);
        let rotations: Vec<Vec4> = match rotation {
            None => Vec::new(),
            Some(rotation) => accessors.read(rotation, Type::Vec4, Numbers::Signed, None)?,
        };
        if let Some(at) = rotations.iter().position(|&rotation| rotation == Vec4::ZERO) {
            return Err(Fault::new(format_args!("rotation {at} is a quaternion of length 0; give one of length 1")));
        }
        Ok(Some(Self { translations, rotations, scales, count }))
    }

    pub fn count(&self) -> usize {
        self.count
    }

    /// The transform of each place.
    pub fn node_from_instance(&self) -> impl Iterator<Item = DAffine3> {
        (0..self.count).map(|at| {
            let translation = self.translations.get(at).copied().unwrap_or(Vec3::ZERO);
            let scale = self.scales.get(at).copied().unwrap_or(Vec3::ONE);
            let rotation = self.rotations.get(at).copied().unwrap_or(Vec4::W);
            let rotation = DQuat::from_vec4(rotation.as_dvec4()).normalize();
            DAffine3::from_scale_rotation_translation(scale.as_dvec3(), rotation, translation.as_dvec3())
        })
    }
}
