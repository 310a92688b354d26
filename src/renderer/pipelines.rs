//! The pipelines of the surfaces' pass: one for each variant that a scene needs.

use std::cell::OnceCell;

use wgpu::{Device, PipelineLayout, RenderPipeline, ShaderModule, TextureFormat, VertexBufferLayout, VertexFormat};

use super::draws::{Attributes, Variant};
use super::materials::Look;
use super::prior_sheens::NODES;
use super::shader::{SHADOWED_WGSL, SURFACES_WGSL, module};
use super::targets::{DEPTH_FORMAT, RadianceFormat};

/// What of the scene a pipeline draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Stage {
    /// Everything, with nothing in the way of light.
    Unshadowed,
    /// Depth alone, of what is opaque.
    Depth,
    /// What is nearest, and what is blended before it; and what of it is blocked.
    Shadowed {
        /// Over what a sample stands for.
        filtered: bool,
        /// Where some of what stands in the way of light lets light through.
        opacities: bool,
    },
}

/// What all pipelines of the pass have in common.
pub(super) struct Pipelines {
    pub shaders: Shaders,
    pub layout: PipelineLayout,
    /// With what stands in the way of light.
    pub shadowed_layout: PipelineLayout,
    pub radiance: RadianceFormat,
    /// Of the target that the filter of shadows goes by, where there is one.
    pub guide: Option<TextureFormat>,
}

/// Modules, each compiled when it is needed first.
#[derive(Default)]
pub(super) struct Shaders {
    surfaces: OnceCell<ShaderModule>,
    shadowed: OnceCell<ShaderModule>,
}

impl Shaders {
    /// Without shadows.
    pub fn surfaces(&self, device: &Device) -> &ShaderModule {
        self.surfaces.get_or_init(|| module(device, "surfaces", SURFACES_WGSL))
    }

    fn shadowed(&self, device: &Device) -> &ShaderModule {
        self.shadowed.get_or_init(|| module(device, "surfaces with shadows", SHADOWED_WGSL))
    }
}

impl Pipelines {
    /// The pipeline of a variant; `culled` are the faces that it leaves out.
    pub fn make(&self, device: &Device, variant: &Variant, stage: Stage, culled: Option<wgpu::Face>) -> RenderPipeline {
        let Variant { look, attributes, mirrored, .. } = *variant;
        let samples = if stage == Stage::Unshadowed { self.radiance.samples } else { 1 };
        let shader = match stage {
            Stage::Unshadowed => self.shaders.surfaces(device),
            Stage::Depth | Stage::Shadowed { .. } => self.shaders.shadowed(device),
        };
        let constants = self.constants(variant, stage, samples);
        let compilation_options = wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
        let vertex = if attributes.any { "vertices_textured" } else { "vertices_plain" };
        let layouts = vertex_layouts(attributes);
        let targets = self.targets(look, stage);
        let fragment = fragment(variant, stage, samples).map(|entry_point| wgpu::FragmentState {
            module: shader,
            entry_point: Some(entry_point),
            compilation_options: compilation_options.clone(),
            targets: &targets,
        });
        let is_shadowed = matches!(stage, Stage::Shadowed { .. });
        let compare =
            if is_shadowed && !look.blend { wgpu::CompareFunction::Equal } else { wgpu::CompareFunction::Greater };
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("surfaces"),
            layout: Some(if is_shadowed { &self.shadowed_layout } else { &self.layout }),
            vertex: wgpu::VertexState {
                module: shader,
                entry_point: Some(vertex),
                compilation_options,
                buffers: &layouts[..if attributes.any { layouts.len() } else { 2 }],
            },
            primitive: wgpu::PrimitiveState {
                front_face: if mirrored { wgpu::FrontFace::Cw } else { wgpu::FrontFace::Ccw },
                cull_mode: culled,
                ..Default::default()
            },
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(!look.blend && !is_shadowed),
                depth_compare: Some(compare),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState { count: samples, ..Default::default() },
            fragment,
            multiview_mask: None,
            cache: None,
        })
    }

    /// The values of the shader's `override` constants.
    fn constants(&self, variant: &Variant, stage: Stage, samples: u32) -> [(&'static str, f64); 19] {
        let Variant { look, lights, .. } = *variant;
        let number = |on: bool| f64::from(u8::from(on));
        let (shadowed, filtered, opacities) = match stage {
            Stage::Shadowed { filtered, opacities } => (true, filtered, opacities),
            Stage::Unshadowed | Stage::Depth => (stage == Stage::Depth, samples > 1, false),
        };
        [
            ("VARIANT_SHEEN", number(look.sheen)),
            ("VARIANT_SPECULAR", number(look.specular)),
            ("VARIANT_RECIPROCAL", number(look.reciprocal)),
            ("VARIANT_UNLIT", number(look.unlit)),
            ("VARIANT_MASK", number(look.mask)),
            ("VARIANT_BLEND", number(look.blend)),
            ("VARIANT_SHEEN_MODEL", f64::from(look.sheen_model)),
            ("VARIANT_TEXTURES", f64::from(look.textures)),
            ("VARIANT_QUADS", number(lights.quads)),
            ("VARIANT_POLYGONS", number(lights.polygons)),
            ("VARIANT_PUNCTUAL", number(lights.punctual)),
            ("VARIANT_PATTERNS", number(lights.patterns)),
            ("VARIANT_SHADOWED", number(shadowed)),
            ("VARIANT_OPACITIES", number(opacities)),
            ("VARIANT_SHARP", number(look.sharp && samples > 1)),
            ("VARIANT_DITHERED", number(samples > 1)),
            ("VARIANT_FILTERED", number(filtered)),
            ("PRIOR_SHEENS_NODES", f64::from(NODES)),
            ("SURFACES_GREATEST", self.radiance.greatest()),
        ]
    }

    fn targets(&self, look: Look, stage: Stage) -> Vec<Option<wgpu::ColorTargetState>> {
        let blend = look.blend.then_some(if look.unlit { OVER_UNLIT } else { OVER });
        let write_mask = wgpu::ColorWrites::ALL;
        let radiance = wgpu::ColorTargetState { format: self.radiance.texture, blend, write_mask };
        // The filter goes by what is opaque.
        let write_mask = if look.blend { wgpu::ColorWrites::empty() } else { write_mask };
        let guide = |format| wgpu::ColorTargetState { format, blend: None, write_mask };
        match stage {
            Stage::Unshadowed => vec![Some(radiance)],
            Stage::Depth => Vec::new(),
            Stage::Shadowed { .. } => {
                let blocked = wgpu::ColorTargetState { blend: look.blend.then_some(OVER), ..radiance.clone() };
                [Some(radiance), Some(blocked)]
                    .into_iter()
                    .chain(self.guide.map(|format| Some(guide(format))))
                    .collect()
            }
        }
    }
}

/// The fragment shader's entry point; none where there is only depth.
fn fragment(variant: &Variant, stage: Stage, samples: u32) -> Option<&'static str> {
    let (is_textured, is_mask) = (variant.attributes.any, variant.look.mask);
    Some(match stage {
        Stage::Unshadowed => match (is_textured, samples > 1) {
            (false, false) => "surfaces_fragment",
            (true, false) => "surfaces_fragment_textured",
            (false, true) => "surfaces_multisampled",
            (true, true) if is_mask => "surfaces_multisampled_cutout",
            (true, true) => "surfaces_multisampled_textured",
        },
        Stage::Depth if is_mask && is_textured => "shadowed_cutout_textured",
        Stage::Depth if is_mask => "shadowed_cutout",
        Stage::Depth => return None,
        Stage::Shadowed { .. } if is_textured => "shadowed_fragment_textured",
        Stage::Shadowed { .. } => "shadowed_fragment",
    })
}

/// What lies before the rest: radiance, and the share of the pixel that is lit.
const OVER: wgpu::BlendState = wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING;
/// The same where nothing of it is lit.
const OVER_UNLIT: wgpu::BlendState = wgpu::BlendState {
    alpha: wgpu::BlendComponent { src_factor: wgpu::BlendFactor::Zero, ..wgpu::BlendComponent::OVER },
    ..OVER
};

/// One buffer for each attribute, in the order of the shader's locations. For an attribute that the mesh lacks, every
/// vertex reads the same constant.
fn vertex_layouts(attributes: Attributes) -> [Option<VertexBufferLayout<'static>>; 6] {
    const fn attribute(format: VertexFormat, shader_location: u32) -> wgpu::VertexAttribute {
        wgpu::VertexAttribute { format, offset: 0, shader_location }
    }
    const ATTRIBUTES: [wgpu::VertexAttribute; 6] = [
        attribute(VertexFormat::Float32x3, 0),
        attribute(VertexFormat::Float32x3, 1),
        attribute(VertexFormat::Float32x4, 2),
        attribute(VertexFormat::Float32x2, 3),
        attribute(VertexFormat::Float32x2, 4),
        attribute(VertexFormat::Unorm16x4, 5),
    ];
    // The constant that stands in for colours is made of floats, as those of the other attributes are.
    const WHITE: wgpu::VertexAttribute = attribute(VertexFormat::Float32x4, 5);
    let Attributes { tangents, tex_coords: [first, second], colors, .. } = attributes;
    let present = [true, true, tangents, first, second, colors];
    std::array::from_fn(|location| {
        let is_white = location == 5 && !colors;
        let attributes =
            if is_white { std::slice::from_ref(&WHITE) } else { std::slice::from_ref(&ATTRIBUTES[location]) };
        let array_stride = if present[location] { attributes[0].format.size() } else { 0 };
        Some(VertexBufferLayout { array_stride, step_mode: wgpu::VertexStepMode::Vertex, attributes })
    })
}
