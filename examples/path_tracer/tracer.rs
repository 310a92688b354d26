// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
//! The shader on a device: one run adds one sample to each pixel.

use velour::picture::LinearImage;
use velour::renderer::device::Gpu;
use velour::table::{GgxTable, SheenTable};
use wgpu::util::DeviceExt;
use wgpu::{BindGroup, BindingResource, Buffer, BufferUsages, ComputePipeline, PollType, TextureView};

use super::scene::TracedScene;

/// The shader: the shipped files as they are, and what calls them.
pub const SOURCE: &str = concat!(
    include_str!("../../shaders/ltc.wgsl"),
    include_str!("../../shaders/sheen.wgsl"),
    include_str!("../../shaders/ggx.wgsl"),
    include_str!("rays.wgsl"),
    include_str!("path_tracer.wgsl"),
);
/// How far off a surface rays start, as a share of the greatest coordinate: what f32 makes of a point on it errs by less.
const APART: f32 = 4e-6;
/// Samples after which the device is waited for, so that it is not given hours of work at once.
const STEP: u32 = 8;

/// As the shader reads it.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Frame {
    world_from_camera: [[f32; 4]; 4],
    size: [u32; 2],
    sample: u32,
    seed: u32,
    max_bounces: u32,
    extent: f32,
    near: f32,
    far: f32,
    apart: f32,
    light_total: f32,
    padding: [u32; 2],
}

pub struct Tracer<'a> {
    gpu: &'a Gpu,
    pipeline: ComputePipeline,
    group: BindGroup,
    uniforms: Buffer,
    film: Buffer,
    frame: Frame,
}

/// How a picture is traced.
#[derive(Clone, Copy)]
pub struct Settings {
    pub size: [u32; 2],
    /// Surfaces that light meets between a light and the surface that is seen.
    pub max_bounces: u32,
    pub seed: u32,
}

impl<'a> Tracer<'a> {
    /// With the shader `source`, which is [`SOURCE`]; an error says in one line what does not fit on the device.
    pub fn new(gpu: &'a Gpu, scene: &TracedScene, source: &str, settings: Settings) -> Result<Self, String> {
        let Gpu { device, .. } = gpu;
        let Settings { size, max_bounces, seed } = settings;
        let pixels = u64::from(size[0]) * u64::from(size[1]);
        let bytes = size_of_val(scene.triangles.as_slice()).max(size_of_val(scene.nodes.as_slice()));
        let most = device.limits().max_storage_buffer_binding_size;
        if (bytes as u64).max(16 * pixels) > most {
            return Err(format!("the scene or the picture takes more than the {most} bytes that the device binds"));
        }
        let frame = Frame {
            world_from_camera: scene.eye.world_from_camera.to_cols_array_2d(),
            size,
            sample: 0,
            seed,
            max_bounces,
            extent: (0.5 * scene.eye.yfov).tan(),
            near: scene.eye.near,
            far: scene.eye.far,
            apart: APART * scene.reach,
            light_total: scene.light_total,
            padding: [0; 2],
        };
        let buffer = |contents: &[u8], usage| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
        };
        let uniforms = buffer(bytemuck::bytes_of(&frame), BufferUsages::UNIFORM | BufferUsages::COPY_DST);
        let storage = |contents: &[u8]| buffer(contents, BufferUsages::STORAGE);
        let [nodes, triangles, surfaces, lights] = [
            bytemuck::cast_slice(&scene.nodes),
            bytemuck::cast_slice(scene.triangles.as_flattened()),
            bytemuck::cast_slice(&scene.surfaces),
            bytemuck::cast_slice(&scene.lights),
        ]
        .map(storage);
        // Buffers begin with zeros.
        let film = device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: 16 * pixels,
            usage: BufferUsages::STORAGE | BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let (sheen, ggx) = (SheenTable::embedded(), GgxTable::embedded());
        let sheen = texture(gpu, sheen.size(), &sheen.texels());
        let ggx = texture(gpu, ggx.texture_size(), &ggx.texels());
        let pipeline = pipeline(gpu, source);
        let resources = [
            uniforms.as_entire_binding(),
            nodes.as_entire_binding(),
            triangles.as_entire_binding(),
            surfaces.as_entire_binding(),
            lights.as_entire_binding(),
            BindingResource::TextureView(&sheen),
            BindingResource::TextureView(&ggx),
            film.as_entire_binding(),
        ];
        let entries: Vec<wgpu::BindGroupEntry> =
            (0..).zip(resources).map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }).collect();
        let layout = &pipeline.get_bind_group_layout(0);
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries });
        Ok(Self { gpu, pipeline, group, uniforms, film, frame })
    }

    /// Adds samples to each pixel; `go_on` hears how many of them there are from time to time.
    pub fn add(&mut self, samples: u32, go_on: impl Fn(u32)) {
        let Gpu { device, queue, .. } = self.gpu;
        for done in 1..=samples {
            queue.write_buffer(&self.uniforms, 0, bytemuck::bytes_of(&self.frame));
            self.frame.sample += 1;
            let mut encoder = device.create_command_encoder(&Default::default());
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &self.group, &[]);
            pass.dispatch_workgroups(self.frame.size[0].div_ceil(8), self.frame.size[1].div_ceil(8), 1);
            drop(pass);
            queue.submit([encoder.finish()]);
            if done % STEP == 0 || done == samples {
                device.poll(PollType::wait_indefinitely()).expect("the device answers");
                go_on(done);
            }
        }
    }

    /// The mean of all samples so far.
    pub fn picture(&self) -> LinearImage {
        let Gpu { device, queue, .. } = self.gpu;
        let readback = device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: self.film.size(),
            usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(&self.film, 0, &readback, 0, self.film.size());
        queue.submit([encoder.finish()]);
        readback.map_async(wgpu::MapMode::Read, .., |mapped| mapped.expect("a buffer made to be read"));
        device.poll(PollType::wait_indefinitely()).expect("the device answers");
        let mapped = readback.get_mapped_range(..).expect("mapped above");
        let sums: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&mapped);
        let pixels = sums.iter().map(|[r, g, b, count]| [r / count, g / count, b / count]).collect();
        let [width, height] = self.frame.size;
        LinearImage { width, height, pixels }
    }
}

fn pipeline(gpu: &Gpu, source: &str) -> ComputePipeline {
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("path tracer"),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    });
    gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("path tracer"),
        layout: None,
        module: &module,
        entry_point: Some("main"),
        compilation_options: Default::default(),
        cache: None,
    })
}

/// A table at the precision of its file: it is read without a sampler.
fn texture(gpu: &Gpu, size: [usize; 2], texels: &[[f32; 4]]) -> TextureView {
    let [width, height] = size.map(|side| side as u32);
    let descriptor = wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba32Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let order = wgpu::util::TextureDataOrder::LayerMajor;
    let texture = gpu.device.create_texture_with_data(&gpu.queue, &descriptor, order, bytemuck::cast_slice(texels));
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
