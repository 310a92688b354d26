//! Which attributes of a primitive are kept, and how they are read.

use glam::{Vec2, Vec3, Vec4};
use gltf::json::accessor::Type;
use gltf::json::mesh::{Primitive, Semantic};
use gltf::json::validation::Checked::Valid;

use super::Fault;
use super::accessor::{Accessors, Numbers};
use super::skinning::Influences;
use crate::scene::notices::Notices;
use crate::scene::{Material, Mesh, TextureSlot, TextureUse};

/// The colour that changes nothing.
pub const WHITE: [u16; 4] = [u16::MAX; 4];

/// The accessors of those of a primitive's attributes that its material needs.
pub struct Attributes {
    pub positions: usize,
    pub normals: Option<usize>,
    /// Only where the file has normals: tangents mean nothing beside other ones.
    tangents: Option<usize>,
    tex_coords: [Option<usize>; 2],
    colors: Option<usize>,
    /// Sets of up to four joints and their weights, by which a skin moves the vertices.
    pub influences: Vec<[usize; 2]>,
    /// The material's normal map.
    pub normal_map: Option<TextureUse>,
}

impl Attributes {
    /// `None` without positions. `place` is where notices say that the primitive is.
    pub fn of(primitive: &Primitive, material: &Material, notices: &mut Notices, place: &str) -> Option<Self> {
        let get = |semantic| primitive.attributes.get(&Valid(semantic)).map(|accessor| accessor.value());
        for semantic in primitive.attributes.keys() {
            if let Valid(semantic @ (Semantic::TexCoords(2..) | Semantic::Colors(1..))) = semantic {
                notices.add("vertex attributes that are not drawn", || format!("{} of {place}", semantic.to_string()));
            }
        }
        let needs = |set: usize| material.textures.iter().flatten().any(|texture| texture.tex_coord == set);
        let tex_coords = [0, 1].map(|set| {
            let accessor = needs(set).then(|| get(Semantic::TexCoords(set as u32)))?;
            if accessor.is_none() {
                let kind = "texture coordinates that a material needs and the mesh lacks are taken to be 0";
                notices.add(kind, || format!("TEXCOORD_{set} of {place}"));
            }
            accessor
        });
        let (normals, normal_map) = (get(Semantic::Normals), material.texture(TextureSlot::Normal));
        Some(Self {
            positions: get(Semantic::Positions)?,
            normals,
            tangents: normals.and(normal_map).and_then(|_| get(Semantic::Tangents)),
            tex_coords,
            colors: get(Semantic::Colors(0)),
            influences: influences(primitive),
            normal_map,
        })
    }

    /// The number of vertices, after a check that all attributes have that many.
    pub fn count(&self, accessors: &Accessors) -> Result<usize, Fault> {
        let count = accessors.count(self.positions)?;
        let [first, second] = self.tex_coords;
        let others = [
            ("normals", self.normals),
            ("tangents", self.tangents),
            ("texture coordinates", first),
            ("texture coordinates", second),
            ("colors", self.colors),
        ];
        let others = others.into_iter().filter_map(|(name, accessor)| Some((name, accessor?)));
        let pairs = self.influences.iter().flat_map(|&[joints, weights]| [("joints", joints), ("weights", weights)]);
        for (name, accessor) in others.chain(pairs) {
            let own = accessors.count(accessor)?;
            if own != count {
                return Err(Fault::new(format_args!("has {count} positions and {own} {name}; export it again")));
            }
        }
        Ok(count)
    }

    /// Bytes in memory for each vertex, besides what moves it.
    pub fn vertex_bytes(&self) -> usize {
        let coords = self.tex_coords.iter().flatten().count() * size_of::<Vec2>();
        let tangents = self.normal_map.map_or(0, |_| size_of::<Vec4>());
        2 * size_of::<Vec3>() + coords + tangents + self.colors.map_or(0, |_| size_of_val(&WHITE))
    }

    /// Whether every triangle may have to be given vertices of its own.
    pub fn may_split(&self) -> bool {
        self.normals.is_none() || self.normal_map.is_some()
    }

    /// The vertices of a mesh that is nothing else yet, as the file has them: normals and tangents of any length, empty
    /// where there are none.
    pub fn read(&self, accessors: &Accessors, used: Option<&[u32]>) -> Result<Mesh, Fault> {
        let mut mesh = Mesh {
            positions: accessors.read(self.positions, Type::Vec3, Numbers::Quantized, used)?,
            colors: self.read_colors(accessors, used)?,
            ..Mesh::default()
        };
        if let Some(normals) = self.normals {
            mesh.normals = accessors.read(normals, Type::Vec3, Numbers::Signed, used)?;
        }
        if let Some(tangents) = self.tangents {
            mesh.tangents = accessors.read(tangents, Type::Vec4, Numbers::Signed, used)?;
        }
        for (coords, accessor) in mesh.tex_coords.iter_mut().zip(self.tex_coords) {
            let Some(accessor) = accessor else { continue };
            *coords = if accessors.is_of(accessor, Type::Vec3) {
                let wide: Vec<Vec3> = accessors.read(accessor, Type::Vec3, Numbers::Quantized, used)?;
                wide.into_iter().map(Vec3::truncate).collect()
            } else {
                accessors.read(accessor, Type::Vec2, Numbers::Quantized, used)?
            };
        }
        Ok(mesh)
    }

    /// Whether texture coordinates have a third component, as some exporters write them and no specification has it.
    pub fn has_wide_tex_coords(&self, accessors: &Accessors) -> bool {
        self.tex_coords.iter().flatten().any(|&accessor| accessors.is_of(accessor, Type::Vec3))
    }

    pub fn read_influences(&self, accessors: &Accessors, used: Option<&[u32]>) -> Result<Vec<Influences>, Fault> {
        let read = |&[joints, weights]: &[usize; 2]| {
            Ok(Influences {
                joints: accessors.read(joints, Type::Vec4, Numbers::Indices, used)?,
                weights: accessors.read(weights, Type::Vec4, Numbers::Unsigned, used)?,
            })
        };
        self.influences.iter().map(read).collect()
    }

    /// Colours and opacities; empty where there are none.
    fn read_colors(&self, accessors: &Accessors, used: Option<&[u32]>) -> Result<Vec<[u16; 4]>, Fault> {
        let Some(colors) = self.colors else { return Ok(Vec::new()) };
        let colors: Vec<Unorm> = if accessors.is_of(colors, Type::Vec3) {
            accessors.read::<_, 3>(colors, Type::Vec3, Numbers::Unsigned, used)?
        } else {
            accessors.read::<_, 4>(colors, Type::Vec4, Numbers::Unsigned, used)?
        };
        Ok(colors.into_iter().map(|color| color.0).collect())
    }
}

/// The accessors of each set of joints that has weights.
fn influences(primitive: &Primitive) -> Vec<[usize; 2]> {
    let get = |semantic| primitive.attributes.get(&Valid(semantic)).map(|accessor| accessor.value());
    let pair = |semantic: &_| match semantic {
        &Valid(Semantic::Joints(set)) => Some([get(Semantic::Joints(set))?, get(Semantic::Weights(set))?]),
        _ => None,
    };
    primitive.attributes.keys().filter_map(pair).collect()
}

/// Numbers clamped to [0, 1], as the nearest of 65536 steps.
struct Unorm([u16; 4]);

impl From<[f32; 4]> for Unorm {
    fn from(color: [f32; 4]) -> Self {
        Self(color.map(|number| (number.clamp(0.0, 1.0) * f32::from(u16::MAX)).round() as u16))
    }
}

impl From<[f32; 3]> for Unorm {
    fn from([r, g, b]: [f32; 3]) -> Self {
        Self::from([r, g, b, 1.0])
    }
}
