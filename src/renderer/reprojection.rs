//! Shadows of a picture in another view, for what moves: they are looked up where they were seen, and no ray is traced.

use bytemuck::{Pod, Zeroable};
use glam::{DMat4, DVec3, Mat4, Vec4};
use wgpu::{BindGroupLayout, BufferUsages, CommandEncoder, Device, Queue, RenderPipeline, TextureFormat};
use wgpu::{TextureUsages, TextureView};

use super::fullscreen;
use super::shader::module;
use super::targets::{Targets, attachment};
use super::tracked_buffer::TrackedBuffer;
use super::view::View;

/// The pass' WGSL.
pub(super) const REPROJECTION_WGSL: &str = include_str!("../../shaders/passes/reprojection.wgsl");

const FORMAT: TextureFormat = TextureFormat::Rgba16Float;

/// `ReprojectionUniforms` of `reprojection.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Uniforms {
    from_clip: Mat4,
    other_clip_from: Mat4,
    eye: Vec4,
    pixel: f32,
    padding: [u32; 3],
}

impl Uniforms {
    /// From `view` to the `other` one, of so many rows.
    fn new(view: &View, other: &View, rows: u32) -> Self {
        let origin = other.origin.as_dvec3();
        let (to_origin, from_origin) = (DMat4::from_translation(-origin), DMat4::from_translation(origin));
        let eye = match other.eye.w == 0.0 {
            true => other.eye.truncate().as_dvec3(),
            false => other.eye.truncate().as_dvec3() - origin,
        };
        Self {
            from_clip: (to_origin * view.clip_from_world.as_dmat4().inverse()).as_mat4(),
            other_clip_from: (other.clip_from_world.as_dmat4() * from_origin).as_mat4(),
            eye: eye.as_vec3().extend(other.eye.w),
            pixel: (2.0 / (f64::from(rows) * scale(other))) as f32,
            padding: [0; 3],
        }
    }
}

/// By how much clip space stretches what is upright, at distance 1.
fn scale(view: &View) -> f64 {
    let row = view.clip_from_world.row(1);
    DVec3::new(row.x.into(), row.y.into(), row.z.into()).length()
}

/// Where the last picture's shadows are seen in the present view.
pub(super) struct Reprojection {
    layout: BindGroupLayout,
    pipeline: RenderPipeline,
    uniforms: TrackedBuffer,
    /// Of the size of what was drawn last.
    shares: Option<([u32; 2], TextureView)>,
}

impl Reprojection {
    pub fn new(device: &Device) -> Self {
        let layout = fullscreen::layout(device, "reprojection", true, &[1, 2, 3].map(|binding| (binding, false)));
        let shader = module(device, "reprojection", REPROJECTION_WGSL);
        let pipeline = fullscreen::pipeline(device, (&layout, &shader), "reprojection_fragment", &[], &[FORMAT]);
        let uniforms = [0; size_of::<Uniforms>()];
        let uniforms = TrackedBuffer::new(device, "reprojection", &uniforms, BufferUsages::UNIFORM);
        Self { layout, pipeline, uniforms, shares: None }
    }

    /// Finds the shares of what the targets, of one sample a pixel, show of `view`, among those that `other` has.
    pub fn encode(
        &mut self,
        (device, queue): (&Device, &Queue),
        encoder: &mut CommandEncoder,
        (view, targets): (&View, &Targets),
        other: &Seen,
    ) {
        let uniforms = Uniforms::new(view, other.view, other.size[1]);
        self.uniforms.write(queue, bytemuck::bytes_of(&uniforms));
        let new =
            || (targets.size, attachment(device, "shares", (targets.size, 1, FORMAT), TextureUsages::TEXTURE_BINDING));
        let shares = match self.shares.take() {
            Some(shares) if shares.0 == targets.size => shares,
            _ => new(),
        };
        let textures = [(1, &targets.depth), (2, other.guide), (3, other.shares)];
        let bind_group = fullscreen::bind_group(device, &self.layout, Some(self.uniforms.binding()), &textures);
        fullscreen::run(encoder, (&self.pipeline, &bind_group), &[&shares.1], None);
        self.shares = Some(shares);
    }

    /// The shares that were found last.
    pub fn shares(&self) -> Option<&TextureView> {
        self.shares.as_ref().map(|(_, view)| view)
    }
}

/// A picture whose shadows are looked up.
pub(super) struct Seen<'a> {
    pub view: &'a View,
    pub size: [u32; 2],
    pub guide: &'a TextureView,
    pub shares: &'a TextureView,
}

#[cfg(test)]
mod tests {
    use super::super::layout::{differences, members};
    use super::*;

    #[test]
    fn the_uniforms_stand_as_the_shader_reads_them() {
        let members = members!(Uniforms { from_clip, other_clip_from, eye, pixel });
        assert_eq!(differences(REPROJECTION_WGSL, "ReprojectionUniforms", size_of::<Uniforms>(), members), [""; 0]);
    }
}
