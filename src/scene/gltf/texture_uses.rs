//! Which textures a material uses, and how (KHR_texture_transform).

use glam::Affine2;
use gltf::json::Index;
use gltf::json::texture::{Info, Texture};
use serde::Deserialize;
use serde_json::{Map, Value};

use super::material_extensions::object;
use crate::scene::notices::Notices;
use crate::scene::{Material, TextureSlot, TextureUse};

const TRANSFORM: &str = "KHR_texture_transform";

/// KHR_texture_transform as the JSON holds it.
#[derive(Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct Transform {
    offset: [f32; 2],
    rotation: f32,
    scale: [f32; 2],
    tex_coord: Option<u32>,
}

impl Default for Transform {
    fn default() -> Self {
        Self { offset: [0.0; 2], rotation: 0.0, scale: [1.0; 2], tex_coord: None }
    }
}

impl Transform {
    /// Scaled, then turned, then moved. The specification's words and its example turn (1, 0) towards (0, -1), upwards
    /// in the image, as all renderers do; the matrix that it prints has the other sign (KhronosGroup/glTF issue 1563).
    fn uv_from_tex_coord(&self) -> Affine2 {
        Affine2::from_scale_angle_translation(self.scale.into(), -self.rotation, self.offset.into())
    }
}

/// The textures of a material under construction, by `TextureSlot`. Indices are those of the file's textures.
pub struct Uses {
    pub slots: [Option<TextureUse>; TextureSlot::COUNT],
    /// How many textures the file has.
    count: usize,
}

impl Uses {
    pub fn new(count: usize) -> Self {
        Self { slots: [None; TextureSlot::COUNT], count }
    }

    /// Fills a slot with what the member `name` says, where there is one.
    pub fn add(&mut self, name: &str, slot: TextureSlot, info: &Option<Info>) -> Result<(), String> {
        let Some(info) = info else { return Ok(()) };
        let others = info.extensions.as_ref().map(|extensions| &extensions.others);
        self.add_parts(name, slot, (info.index, info.tex_coord, others))
    }

    /// The same from a member's parts: texture, set of texture coordinates, extensions.
    pub fn add_parts(
        &mut self,
        name: &str,
        slot: TextureSlot,
        (texture, tex_coord, others): (Index<Texture>, u32, Option<&Map<String, Value>>),
    ) -> Result<(), String> {
        if texture.value() >= self.count {
            return Err(format!("{name}: there is no texture {texture}; export the file again"));
        }
        let transform = others.and_then(|others| others.get(TRANSFORM)).map(|value| object(TRANSFORM, value));
        let transform: Transform = transform.transpose().map_err(|what| format!("{name}: {what}"))?.unwrap_or_default();
        let uv_from_tex_coord = transform.uv_from_tex_coord();
        if !uv_from_tex_coord.is_finite() {
            return Err(format!("{name}: {TRANSFORM} is not finite; give finite numbers"));
        }
        let tex_coord = transform.tex_coord.unwrap_or(tex_coord) as usize;
        self.slots[slot as usize] = Some(TextureUse { texture: texture.value(), tex_coord, uv_from_tex_coord });
        Ok(())
    }
}

/// Leaves out textures on sets of texture coordinates that meshes do not keep.
pub fn tex_coord_limit(material: &mut Material, place: &dyn Fn() -> String, notices: &mut Notices) {
    for slot in &mut material.textures {
        if slot.is_some_and(|texture| texture.tex_coord > 1) {
            notices.add("textures on a third or later set of texture coordinates are left out", place);
            *slot = None;
        }
    }
}
