//! Runs the shipped files on a device, together with an entry point of these tests.

use std::sync::OnceLock;
use velour::renderer::device::{self, Gpu};
use wgpu::util::DeviceExt;
use wgpu::{BufferUsages, PollType, TextureView};

/// The device under test. Without one the tests fail: what wasn't run wasn't tested.
fn gpu() -> &'static Gpu {
    static GPU: OnceLock<Gpu> = OnceLock::new();
    GPU.get_or_init(|| {
        let gpu = pollster::block_on(device::open_offscreen(None)).expect("these tests need a device");
        println!("device: {}", gpu.adapter.get_info().name);
        gpu
    })
}

/// A two-dimensional texture of four floats per texel, in rows of `width`.
pub fn texture(width: u32, texels: &[[f32; 4]]) -> TextureView {
    let size = wgpu::Extent3d { width, height: texels.len() as u32 / width, depth_or_array_layers: 1 };
    let descriptor = wgpu::TextureDescriptor {
        label: None,
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba32Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let order = wgpu::util::TextureDataOrder::LayerMajor;
    let texture = gpu().device.create_texture_with_data(&gpu().queue, &descriptor, order, bytemuck::cast_slice(texels));
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// Runs `entry` of the WGSL `source` once for each of `count` results. Its group 0 holds the results at binding 0, the
/// `inputs` as read-only storage from binding 1, and the texture, if any, after them.
pub fn run<T: bytemuck::Pod>(source: &str, inputs: &[&[u8]], table: Option<&TextureView>, count: usize) -> Vec<T> {
    run_with(source, inputs, table.as_slice(), count)
}

/// The same with any number of textures.
pub fn run_with<T: bytemuck::Pod>(source: &str, inputs: &[&[u8]], tables: &[&TextureView], count: usize) -> Vec<T> {
    let Gpu { device, queue, .. } = gpu();
    let size = (count * size_of::<T>()) as u64;
    let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC;
    let results = device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false });
    let usage = BufferUsages::COPY_DST | BufferUsages::MAP_READ;
    let readback =
        device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false });
    let storage = |contents: &&[u8]| {
        device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents,
            usage: BufferUsages::STORAGE,
        })
    };
    let buffers: Vec<wgpu::Buffer> = std::iter::once(results.clone()).chain(inputs.iter().map(storage)).collect();
    let mut entries: Vec<wgpu::BindGroupEntry> = (0..)
        .zip(&buffers)
        .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
        .collect();
    for view in tables {
        entries.push(wgpu::BindGroupEntry {
            binding: entries.len() as u32,
            resource: wgpu::BindingResource::TextureView(view),
        });
    }

    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(source.into()),
    });
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: Some("main"),
        compilation_options: Default::default(),
        cache: None,
    });
    let layout = pipeline.get_bind_group_layout(0);
    let group =
        device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries });
    let mut encoder = device.create_command_encoder(&Default::default());
    {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups((count as u32).div_ceil(64), 1, 1);
    }
    encoder.copy_buffer_to_buffer(&results, 0, &readback, 0, size);
    queue.submit([encoder.finish()]);
    readback.map_async(wgpu::MapMode::Read, .., |mapped| mapped.expect("a buffer made to be read"));
    device.poll(PollType::wait_indefinitely()).expect("the device answers");
    let mapped = readback.get_mapped_range(..).expect("mapped above");
    bytemuck::pod_collect_to_vec(&mapped)
}
