//! Materials as the shaders read them, and which variant of the shaders each one needs.

use bytemuck::{Pod, Zeroable};
use glam::{Affine2, Vec3, Vec4};

use crate::scene::{AlphaMode, Layering, Material, SheenModel, TextureSlot};

/// `Factors` of `factors.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(super) struct GpuMaterial {
    base_color: Vec4,
    sheen_color: Vec3,
    sheen_weight: f32,
    f0: Vec3,
    specular: f32,
    metallic: f32,
    roughness: f32,
    sheen_roughness: f32,
    alpha_exponent: f32,
    normal_scale: f32,
    occlusion_strength: f32,
    alpha_cutoff: f32,
    layering: u32,
    manual: f32,
    padding: [u32; 3],
}

/// Which parts of the shaders a material needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Look {
    pub sheen: bool,
    /// `VARIANT_SHEEN_MODEL` of `variant.wgsl`: 0 where the integral over the lights has a closed form.
    pub sheen_model: u32,
    pub specular: bool,
    /// Whether the specular lobe may be narrow.
    pub sharp: bool,
    pub reciprocal: bool,
    pub unlit: bool,
    pub mask: bool,
    pub blend: bool,
    /// Whether back faces are drawn.
    pub double_sided: bool,
    /// Bit k: slot k's texture counts.
    pub textures: u16,
}

/// The base's roughness from which on the specular lobe is wider than what normals vary over most pixels.
const DULL: f32 = 0.5;

impl Look {
    /// What a material as it is drawn needs.
    pub fn new(material: &Material) -> Self {
        let sheen = material.sheen;
        let metallic = material.metallic > 0.0;
        let counts = |slot: TextureSlot| {
            material.texture(slot).is_some()
                && match slot {
                    TextureSlot::SheenColor | TextureSlot::SheenWeight | TextureSlot::SheenRoughness => sheen.is_some(),
                    TextureSlot::BaseColor => true,
                    TextureSlot::Emission => material.emission != Vec3::ZERO,
                    _ => !material.unlit,
                }
        };
        let textures = TextureSlot::ALL.into_iter().filter(|slot| counts(*slot));
        let specular = metallic || material.dielectric_f0() != Vec3::ZERO || material.specular > 0.0;
        Self {
            sheen: sheen.is_some() && !material.unlit,
            sheen_model: sheen.filter(|_| !material.unlit).map_or(0, |sheen| model_number(sheen.model)),
            specular: specular && !material.unlit,
            sharp: specular && !material.unlit && (material.roughness < DULL || counts(TextureSlot::MetallicRoughness)),
            reciprocal: sheen.is_some_and(|sheen| sheen.layering == Layering::Reciprocal),
            unlit: material.unlit,
            mask: matches!(material.alpha_mode, AlphaMode::Mask { .. }),
            blend: material.alpha_mode == AlphaMode::Blend,
            double_sided: material.double_sided,
            textures: textures.fold(0, |bits, slot| bits | 1 << slot as u16),
        }
    }
}

/// As `prior_sheens.wgsl` counts.
fn model_number(model: SheenModel) -> u32 {
    match model {
        // The slab and the walk have been refused before.
        SheenModel::Ltc | SheenModel::Slab | SheenModel::Walk => 0,
        SheenModel::Burley => 1,
        SheenModel::ContyKulla => 2,
        SheenModel::NeubeltPettineo => 3,
        SheenModel::Patry => 4,
    }
}

/// The factors of a material as it is drawn.
pub(super) fn factors(material: &Material) -> GpuMaterial {
    let sheen = material.sheen;
    let (layering, manual) = match sheen.map(|sheen| sheen.layering).unwrap_or_default() {
        Layering::Gltf => (0, 1.0),
        Layering::OpenPbr => (1, 1.0),
        Layering::Reciprocal => (2, 1.0),
        Layering::Manual(share) => (3, share),
        // The walk has been refused before.
        Layering::None | Layering::Walk => (3, 1.0),
    };
    GpuMaterial {
        base_color: material.base_color.extend(material.opacity),
        sheen_color: sheen.map_or(Vec3::ZERO, |sheen| sheen.color),
        sheen_weight: sheen.map_or(0.0, |sheen| sheen.weight),
        f0: material.dielectric_f0(),
        specular: material.specular,
        metallic: material.metallic,
        roughness: material.roughness,
        sheen_roughness: sheen.map_or(0.0, |sheen| sheen.roughness),
        alpha_exponent: sheen.map_or(1.0, |sheen| sheen.roughness_map.exponent()),
        // With larger scales the normal is in the surface's plane anyway, and its square would overflow.
        normal_scale: material.normal_scale.clamp(-1e6, 1e6),
        occlusion_strength: material.occlusion_strength,
        alpha_cutoff: if let AlphaMode::Mask { cutoff } = material.alpha_mode { cutoff } else { 0.0 },
        layering,
        manual,
        padding: [0; 3],
    }
}

/// `MaterialTransforms` of `material.wgsl`: two rows per slot, uv = rows (u, v, 1); w is 1 in the first row where the
/// texture uses the second set of coordinates.
pub(super) fn transforms(material: &Material) -> [Vec4; 2 * TextureSlot::COUNT] {
    let mut rows = [Vec4::ZERO; 2 * TextureSlot::COUNT];
    for (rows, texture) in rows.as_chunks_mut::<2>().0.iter_mut().zip(&material.textures) {
        let Affine2 { matrix2, translation } = texture.map_or(Affine2::IDENTITY, |texture| texture.uv_from_tex_coord);
        let second = texture.is_some_and(|texture| texture.tex_coord == 1);
        *rows = [
            Vec4::new(matrix2.x_axis.x, matrix2.y_axis.x, translation.x, f32::from(u8::from(second))),
            Vec4::new(matrix2.x_axis.y, matrix2.y_axis.y, translation.y, 0.0),
        ];
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::super::layout::{differences, members};
    use super::super::shader::SURFACES_WGSL;
    use super::*;
    use crate::scene::TextureUse;
    use glam::Vec2;

    #[test]
    fn factors_stand_as_the_shader_reads_them() {
        let members = members!(GpuMaterial {
            base_color,
            sheen_color,
            sheen_weight,
            f0,
            specular,
            metallic,
            roughness,
            sheen_roughness,
            alpha_exponent,
            normal_scale,
            occlusion_strength,
            alpha_cutoff,
            layering,
            manual
        });
        assert_eq!(differences(SURFACES_WGSL, "Factors", size_of::<GpuMaterial>(), members), [""; 0]);
    }

    #[test]
    fn transforms_stand_as_the_shader_reads_them() {
        let size = size_of_val(&transforms(&Material::matte("", Vec3::ONE)));
        assert_eq!(differences(SURFACES_WGSL, "MaterialTransforms", size, &[("rows", 0)]), [""; 0]);
    }

    #[test]
    fn rows_are_the_transforms() {
        let uv_from_tex_coord = Affine2::from_scale_angle_translation(Vec2::new(2.0, 3.0), 0.5, Vec2::new(0.1, 0.2));
        let mut material = Material::matte("", Vec3::ONE);
        let texture = TextureUse { texture: 0, tex_coord: 1, uv_from_tex_coord };
        material.textures[TextureSlot::Normal as usize] = Some(texture);
        let rows = transforms(&material);
        let at = Vec3::new(0.3, 0.7, 1.0);
        let [u, v] = [rows[4], rows[5]];
        let uv = Vec2::new(u.truncate().dot(at), v.truncate().dot(at));
        assert!(uv.abs_diff_eq(uv_from_tex_coord.transform_point2(at.truncate()), 1e-6) && u.w == 1.0);
        assert_eq!(rows[..2], [Vec4::X, Vec4::Y]);
    }
}
