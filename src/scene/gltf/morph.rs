//! Morph targets (glTF 2.0, section 3.7.2.2), at the weights that the file gives them.

use std::collections::HashMap;

use glam::{Vec3, Vec4};
use gltf::json;
use gltf::json::accessor::Type;
use gltf::json::mesh::Primitive;
use gltf::json::scene::Node;
use serde_json::Value;

use super::Fault;
use super::accessor::{Accessors, Numbers};
use super::json::TARGETS;
use crate::scene::Mesh;

/// The accessors of a target's deltas, by the names of the attributes to which they are added.
pub type Target = HashMap<String, usize>;

/// The targets of a primitive.
pub fn targets(primitive: &Primitive) -> Result<Vec<Target>, Fault> {
    let Some(value) = raw(primitive) else { return Ok(Vec::new()) };
    let wrong = |error| Fault::at("targets", format_args!("{error}; correct it or export again"));
    serde_path_to_error::deserialize(value).map_err(wrong)
}

/// How many targets a primitive has.
pub fn count(primitive: &Primitive) -> usize {
    raw(primitive).and_then(Value::as_array).map_or(0, Vec::len)
}

/// Bytes of memory that a primitive's targets take, about.
pub fn targets_bytes(primitive: &Primitive) -> usize {
    let entries = |target: &Value| 1 + target.as_object().map_or(0, serde_json::Map::len);
    let targets = raw(primitive).and_then(Value::as_array).into_iter().flatten();
    targets.map(entries).sum::<usize>().saturating_mul(size_of::<Target>())
}

fn raw(primitive: &Primitive) -> Option<&Value> {
    primitive.extensions.as_ref().and_then(|extensions| extensions.others.get(TARGETS))
}

/// The weights of the targets of a node's mesh (section 3.7.4): the node's own, else the mesh's, else none, which means
/// 0.
pub fn weights<'a>(node: &'a Node, mesh: &'a json::Mesh) -> &'a [f32] {
    node.weights.as_deref().or(mesh.weights.as_deref()).unwrap_or_default()
}

/// Weights without the zeros at the end, which change nothing; or what is wrong with them.
pub fn checked(weights: &[f32]) -> Result<&[f32], String> {
    if let Some(weight) = weights.iter().find(|weight| !weight.is_finite()) {
        return Err(format!("weights holds {weight}; give finite numbers"));
    }
    let last = weights.iter().rposition(|&weight| weight != 0.0);
    Ok(&weights[..last.map_or(0, |last| last + 1)])
}

/// Targets whose weight is not 0, with that.
fn weighted<'a>(targets: &'a [Target], weights: &'a [f32]) -> impl Iterator<Item = (&'a Target, f32)> {
    targets.iter().zip(weights.iter().copied()).filter(|(_, weight)| *weight != 0.0)
}

/// The deltas of one primitive's targets that have a weight.
pub struct Deltas<'a, 'b> {
    pub accessors: &'b Accessors<'a>,
    pub targets: &'b [Target],
    pub weights: &'b [f32],
    /// The vertices that are read; `None` where all are.
    pub used: Option<&'b [u32]>,
    /// How many vertices the primitive has, used or not.
    pub count: usize,
}

impl Deltas<'_, '_> {
    /// Bytes that are read in all, for so many vertices.
    pub fn bytes(targets: &[Target], weights: &[f32], vertices: usize) -> usize {
        let deltas = |target: &Target| target.len().saturating_mul(size_of::<Vec4>()).saturating_mul(vertices);
        weighted(targets, weights).map(|(target, _)| deltas(target)).fold(0, usize::saturating_add)
    }

    /// Adds the deltas to the attributes that the mesh has, as the file has them: normals need not be unit yet, and
    /// tangents' handedness stays.
    pub fn add_to(&self, mesh: &mut Mesh) -> Result<(), Fault> {
        self.add::<_, 3, 3>("POSITION", &mut mesh.positions, Type::Vec3, Numbers::Quantized)?;
        self.add::<_, 3, 3>("NORMAL", &mut mesh.normals, Type::Vec3, Numbers::Signed)?;
        self.add::<_, 4, 3>("TANGENT", &mut mesh.tangents, Type::Vec3, Numbers::Signed)?;
        for (set, name) in ["TEXCOORD_0", "TEXCOORD_1"].into_iter().enumerate() {
            self.add::<_, 2, 2>(name, &mut mesh.tex_coords[set], Type::Vec2, Numbers::Quantized)?;
        }
        self.add_colors(mesh)
    }

    /// The accessors of an attribute's deltas, with their weights. Deltas without data are zeros.
    fn of(&self, name: &str) -> impl Iterator<Item = (usize, f32)> {
        let accessors =
            weighted(self.targets, self.weights).filter_map(move |(target, weight)| Some((*target.get(name)?, weight)));
        accessors.filter(|&(accessor, _)| self.accessors.has_data(accessor))
    }

    fn add<T: AsMut<[f32; M]>, const M: usize, const N: usize>(
        &self,
        name: &'static str,
        values: &mut [T],
        kind: Type,
        numbers: Numbers,
    ) -> Result<(), Fault> {
        if values.is_empty() {
            return Ok(());
        }
        for (accessor, weight) in self.of(name) {
            let deltas: Vec<[f32; N]> = self.read(name, accessor, kind, numbers)?;
            for (value, delta) in values.iter_mut().zip(deltas) {
                value.as_mut().iter_mut().zip(delta).for_each(|(number, delta)| *number += weight * delta);
            }
        }
        match values.iter_mut().position(|value| value.as_mut().iter().any(|number| !number.is_finite())) {
            None => Ok(()),
            Some(at) => Err(Fault::new(format_args!("{name} {at} is morphed past all numbers; lower its weights"))),
        }
    }

    fn read<const N: usize>(
        &self,
        name: &'static str,
        accessor: usize,
        kind: Type,
        numbers: Numbers,
    ) -> Result<Vec<[f32; N]>, Fault> {
        let own = self.accessors.count(accessor)?;
        if own != self.count {
            let what = format_args!("has {} vertices and {own} {name} in a morph target; export it again", self.count);
            return Err(Fault::new(what));
        }
        self.accessors.read(accessor, kind, numbers, self.used)
    }

    /// Colours are clamped once they are summed.
    fn add_colors(&self, mesh: &mut Mesh) -> Result<(), Fault> {
        const ONE: f32 = u16::MAX as f32;
        if mesh.colors.is_empty() || self.of("COLOR_0").next().is_none() {
            return Ok(());
        }
        let mut sums: Vec<Vec4> = mesh.colors.iter().map(|color| Vec4::from(color.map(f32::from)) / ONE).collect();
        for (accessor, weight) in self.of("COLOR_0") {
            let deltas: Vec<Vec4> = if self.accessors.is_of(accessor, Type::Vec3) {
                let deltas = self.read::<3>("COLOR_0", accessor, Type::Vec3, Numbers::Quantized)?;
                deltas.into_iter().map(|delta| Vec3::from(delta).extend(0.0)).collect()
            } else {
                let deltas = self.read::<4>("COLOR_0", accessor, Type::Vec4, Numbers::Quantized)?;
                deltas.into_iter().map(Vec4::from).collect()
            };
            sums.iter_mut().zip(deltas).for_each(|(sum, delta)| *sum += weight * delta);
        }
        let quantized = |sum: Vec4| (sum.clamp(Vec4::ZERO, Vec4::ONE) * ONE).round().to_array().map(|part| part as u16);
        mesh.colors = sums.into_iter().map(quantized).collect();
        Ok(())
    }
}
