// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
//! A sheen for Bevy's `StandardMaterial` under `RectLight`s. Made to be copied, with `sheen.wgsl` beside it and the
//! files that are embedded here.

use bevy::asset::{RenderAssetUsages, uuid_handle};
use bevy::camera::Exposure;
use bevy::mesh::MeshVertexBufferLayoutRef;
use bevy::pbr::{ExtendedMaterial, MaterialExtension, MaterialExtensionKey, MaterialExtensionPipeline};
use bevy::prelude::*;
use bevy::render::render_resource::{
    AsBindGroup, Extent3d, RenderPipelineDescriptor, SpecializedMeshPipelineError, TextureDimension, TextureFormat,
};
use bevy::shader::ShaderRef;

const LTC: &str = include_str!("../../../shaders/ltc.wgsl");
const SHEEN: &str = include_str!("../../../shaders/sheen.wgsl");
const GGX: &str = include_str!("../../../shaders/ggx.wgsl");
const LIGHTS: &str = include_str!("../../lights.wgsl");
const SURFACE: &str = include_str!("sheen.wgsl");
const SHEEN_TABLE: &[u8] = include_bytes!("../../../tables/sheen_ltc.dds");
const GGX_TABLE: &[u8] = include_bytes!("../../../tables/ggx_ltc.dds");

const SURFACE_SHADER: Handle<Shader> = uuid_handle!("7b0d8f2e-4f0e-4f5c-9a55-2f1d1c6a7e10");
/// Shaders that any WGSL of the app may import from: `#import velour::ltc::ltc_frame`.
const MODULES: [(Handle<Shader>, &str, &str); 3] = [
    (uuid_handle!("7b0d8f2e-4f0e-4f5c-9a55-2f1d1c6a7e11"), "velour::ltc", LTC),
    (uuid_handle!("7b0d8f2e-4f0e-4f5c-9a55-2f1d1c6a7e12"), "velour::sheen", SHEEN),
    (uuid_handle!("7b0d8f2e-4f0e-4f5c-9a55-2f1d1c6a7e13"), "velour::ggx", GGX),
];

/// What to add a mesh with: `MeshMaterial3d(materials.add(SheenMaterial { base, extension }))`.
pub type SheenMaterial = ExtendedMaterial<StandardMaterial, Sheen>;

/// An exposure of 1: what a camera with it draws is radiance.
pub const EXPOSURE_OF_ONE: Exposure = Exposure { ev100: -0.263_034_4 };

/// The `intensity`, in lumens, of a `RectLight` of a radiance, in an exposure of 1: Bevy divides by pi and the area.
/// A camera with another exposure takes it times `1.0 / exposure.exposure()`.
pub fn rect_light_intensity(radiance: f32, width: f32, height: f32) -> f32 {
    radiance * std::f32::consts::PI * width * height
}

/// Whose diffuse and specular terms of rectangle lights lie under the sheen.
#[derive(Clone, Copy, Debug, Default, Eq, Hash, PartialEq)]
#[repr(u8)]
pub enum RectLightTerms {
    /// Those of `ggx.wgsl` and `ltc.wgsl`, layered as glTF does.
    #[default]
    Velour,
    /// Those that Bevy has.
    Bevy,
}

/// A sheen over a `StandardMaterial`, in forward rendering.
#[derive(Asset, AsBindGroup, Clone, TypePath)]
#[bind_group_data(RectLightTerms)]
pub struct Sheen {
    /// Linear, in [0,1] in each channel.
    #[uniform(100)]
    pub color: LinearRgba,
    /// Roughness in [0,1]: small is fuzz, large is dust. It is glTF's `sheenRoughnessFactor`.
    #[uniform(100)]
    pub alpha: f32,
    #[texture(101)]
    pub sheen_table: Handle<Image>,
    #[texture(102)]
    pub ggx_table: Handle<Image>,
    pub terms: RectLightTerms,
}

impl From<&Sheen> for RectLightTerms {
    fn from(sheen: &Sheen) -> Self {
        sheen.terms
    }
}

impl MaterialExtension for Sheen {
    fn fragment_shader() -> ShaderRef {
        SURFACE_SHADER.into()
    }

    /// Without its definition AREA_LIGHT_LUTS Bevy's lighting leaves rectangle lights out.
    fn specialize(
        _: &MaterialExtensionPipeline,
        descriptor: &mut RenderPipelineDescriptor,
        _: &MeshVertexBufferLayoutRef,
        key: MaterialExtensionKey<Self>,
    ) -> Result<(), SpecializedMeshPipelineError> {
        if let (RectLightTerms::Velour, Some(fragment)) = (key.bind_group_data, &mut descriptor.fragment) {
            fragment.shader_defs.retain(|definition| *definition != "AREA_LIGHT_LUTS".into());
            fragment.shader_defs.push("VELOUR_TERMS".into());
        }
        Ok(())
    }
}

/// The tables as images.
#[derive(Clone, Resource)]
pub struct SheenTables {
    pub sheen: Handle<Image>,
    pub ggx: Handle<Image>,
}

impl SheenTables {
    pub fn sheen(&self, color: LinearRgba, alpha: f32) -> Sheen {
        let terms = RectLightTerms::default();
        Sheen { color, alpha, sheen_table: self.sheen.clone(), ggx_table: self.ggx.clone(), terms }
    }
}

impl FromWorld for SheenTables {
    fn from_world(world: &mut World) -> Self {
        let mut images = world.resource_mut::<Assets<Image>>();
        Self { sheen: images.add(table(SHEEN_TABLE)), ggx: images.add(table(GGX_TABLE)) }
    }
}

/// A .dds of half floats as it lies in `tables/`: its size in the header, its texels after byte 148.
pub fn table(dds: &[u8]) -> Image {
    let number = |at: usize| u32::from_le_bytes([dds[at], dds[at + 1], dds[at + 2], dds[at + 3]]);
    let size = Extent3d { width: number(16), height: number(12), depth_or_array_layers: 1 };
    let usages = RenderAssetUsages::RENDER_WORLD;
    Image::new(size, TextureDimension::D2, dds[148..].to_vec(), TextureFormat::Rgba16Float, usages)
}

/// Adds the material, the shaders and the tables; after `DefaultPlugins`.
pub struct SheenPlugin;

impl Plugin for SheenPlugin {
    fn build(&self, app: &mut App) {
        let mut shaders = app.world_mut().resource_mut::<Assets<Shader>>();
        for (handle, path, source) in MODULES {
            insert(&mut shaders, handle, format!("#define_import_path {path}\n{source}"), path);
        }
        insert(&mut shaders, SURFACE_SHADER, format!("{SURFACE}\n{LIGHTS}"), "velour::surface");
        app.init_resource::<SheenTables>().add_plugins(MaterialPlugin::<SheenMaterial>::default());
    }
}

fn insert(shaders: &mut Assets<Shader>, handle: Handle<Shader>, source: String, path: &str) {
    let inserted = shaders.insert(&handle, Shader::from_wgsl(source, path));
    inserted.expect("a handle of a constant never goes stale");
}
