//! The pipelines of the surfaces' pass: one for each variant that a scene needs.

use wgpu::{Device, PipelineLayout, RenderPipeline, ShaderModule, VertexBufferLayout, VertexFormat};

use super::draws::{Attributes, Variant};
use super::prior_sheens::NODES;
use super::targets::{DEPTH_FORMAT, RadianceFormat};

/// What all pipelines of the pass have in common.
pub(super) struct Pipelines {
    pub shader: ShaderModule,
    pub layout: PipelineLayout,
    pub radiance: RadianceFormat,
}

impl Pipelines {
    /// The pipeline of a variant; `culled` are the faces that it leaves out.
    pub fn make(&self, device: &Device, variant: &Variant, culled: Option<wgpu::Face>) -> RenderPipeline {
        let Variant { look, attributes, lights, mirrored } = *variant;
        let number = |on: bool| f64::from(u8::from(on));
        let constants = [
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
            ("VARIANT_SHARP", number(look.sharp && self.radiance.samples > 1)),
            ("VARIANT_FILTERED", number(self.radiance.samples > 1)),
            ("PRIOR_SHEENS_NODES", f64::from(NODES)),
            ("SURFACES_GREATEST", self.radiance.greatest()),
        ];
        let compilation_options = wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
        let vertex = if attributes.any { "surfaces_vertex_textured" } else { "surfaces_vertex" };
        let fragment = match (attributes.any, self.radiance.samples > 1) {
            (false, false) => "surfaces_fragment",
            (true, false) => "surfaces_fragment_textured",
            (false, true) => "surfaces_multisampled",
            (true, true) if look.mask => "surfaces_multisampled_cutout",
            (true, true) => "surfaces_multisampled_textured",
        };
        let layouts = vertex_layouts(attributes);
        let blend = look.blend.then_some(if look.unlit { OVER_UNLIT } else { OVER });
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("surfaces"),
            layout: Some(&self.layout),
            vertex: wgpu::VertexState {
                module: &self.shader,
                entry_point: Some(vertex),
                compilation_options: compilation_options.clone(),
                buffers: &layouts[..if attributes.any { layouts.len() } else { 2 }],
            },
            primitive: wgpu::PrimitiveState {
                front_face: if mirrored { wgpu::FrontFace::Cw } else { wgpu::FrontFace::Ccw },
                cull_mode: culled,
                ..Default::default()
            },
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(!look.blend),
                depth_compare: Some(wgpu::CompareFunction::Greater),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState { count: self.radiance.samples, ..Default::default() },
            fragment: Some(wgpu::FragmentState {
                module: &self.shader,
                entry_point: Some(fragment),
                compilation_options,
                targets: &[Some(wgpu::ColorTargetState {
                    format: self.radiance.texture,
                    blend,
                    write_mask: wgpu::ColorWrites::ALL,
                })],
            }),
            multiview_mask: None,
            cache: None,
        })
    }
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
