//! Runs compute shaders in SPIR-V on the device, handed to the driver as they are.

use std::borrow::Cow;

use wgpu::util::DeviceExt;
use wgpu::{BindingType, BufferBindingType, BufferUsages, Features, PollType, ShaderStages};

use super::golden::Rows;

/// The outputs of all rows, one after the other.
pub fn run(spirv: &[u32], rows: &Rows) -> Vec<f32> {
    let (device, queue) = pollster::block_on(open());
    // SAFETY: the compiler's validator has passed it, and it reads and writes where the rows say.
    let module = unsafe {
        device.create_shader_module_passthrough(wgpu::ShaderModuleDescriptorPassthrough {
            entry_points: Cow::Owned(vec![wgpu::PassthroughShaderEntryPoint {
                name: Cow::Borrowed("main"),
                workgroup_size: (64, 1, 1),
            }]),
            spirv: Some(Cow::Borrowed(spirv)),
            ..Default::default()
        })
    };
    let layout = layout(&device);
    let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &[Some(&layout)],
        immediate_size: 0,
    });
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: Some(&pipeline_layout),
        module: &module,
        entry_point: Some("main"),
        compilation_options: Default::default(),
        cache: None,
    });
    let size = 4 * rows.outputs as u64;
    let results = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size,
        usage: BufferUsages::STORAGE | BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let storage = |contents: &[u8]| {
        let usage = BufferUsages::STORAGE;
        device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
    };
    let (numbers, heads) = (storage(bytemuck::cast_slice(&rows.inputs)), storage(bytemuck::cast_slice(&rows.heads)));
    let tables = rows.tables.each_ref().map(|table| texture(&device, &queue, table.size, &table.texels));
    let resources = [results.as_entire_binding(), numbers.as_entire_binding(), heads.as_entire_binding()]
        .into_iter()
        .chain(tables.iter().map(wgpu::BindingResource::TextureView));
    let entries: Vec<wgpu::BindGroupEntry<'_>> =
        (0..).zip(resources).map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }).collect();
    let group =
        device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries });
    let readback = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size,
        usage: BufferUsages::COPY_DST | BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups((rows.heads.len() as u32).div_ceil(64), 1, 1);
    }
    encoder.copy_buffer_to_buffer(&results, 0, &readback, 0, size);
    queue.submit([encoder.finish()]);
    readback.map_async(wgpu::MapMode::Read, .., |mapped| mapped.expect("a buffer made to be read"));
    device.poll(PollType::wait_indefinitely()).expect("the device answers");
    bytemuck::pod_collect_to_vec(&readback.get_mapped_range(..).expect("mapped above"))
}

/// A Vulkan device that takes SPIR-V as it is.
async fn open() -> (wgpu::Device, wgpu::Queue) {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::VULKAN;
    let adapters = wgpu::Instance::new(descriptor).enumerate_adapters(wgpu::Backends::VULKAN).await;
    let required_features = Features::PASSTHROUGH_SHADERS;
    let takes_spirv = |adapter: &&wgpu::Adapter| adapter.features().contains(required_features);
    let adapter = adapters.iter().find(takes_spirv).expect("these tests need a Vulkan device");
    // SAFETY: what is experimental is handing shaders on unseen, which is what these tests are for.
    let experimental_features = unsafe { wgpu::ExperimentalFeatures::enabled() };
    let descriptor = wgpu::DeviceDescriptor { required_features, experimental_features, ..Default::default() };
    adapter.request_device(&descriptor).await.expect("the device opens")
}

/// Results, numbers, rows, and both tables.
fn layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let buffer = |read_only| BindingType::Buffer {
        ty: BufferBindingType::Storage { read_only },
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let texture = BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let types = [buffer(false), buffer(true), buffer(true), texture, texture];
    let entries: Vec<wgpu::BindGroupLayoutEntry> = (0..)
        .zip(types)
        .map(|(binding, ty)| wgpu::BindGroupLayoutEntry { binding, visibility: ShaderStages::COMPUTE, ty, count: None })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: None, entries: &entries })
}

fn texture(device: &wgpu::Device, queue: &wgpu::Queue, size: [u32; 2], texels: &[f32]) -> wgpu::TextureView {
    let descriptor = wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba32Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let order = wgpu::util::TextureDataOrder::LayerMajor;
    let texture = device.create_texture_with_data(queue, &descriptor, order, bytemuck::cast_slice(texels));
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
