//! A picture by a compute shader.

use velour::picture::LinearImage;
use velour::renderer::device::Gpu;
use velour::table::{GgxTable, SheenTable};
use wgpu::util::DeviceExt;
use wgpu::{BufferUsages, PollType};

/// Corners of the lights, four each: one stands behind and reaches below the floor, one hangs above, one shines from the front.
const CORNERS: [[f32; 4]; 12] = [
    [-2.4, -0.3, -0.6, 0.0],
    [-1.0, -0.3, -2.0, 0.0],
    [-1.0, 2.2, -2.0, 0.0],
    [-2.4, 2.2, -0.6, 0.0],
    [1.0, 3.2, -1.0, 0.0],
    [2.6, 2.6, -1.0, 0.0],
    [2.6, 2.6, 1.0, 0.0],
    [1.0, 3.2, 1.0, 0.0],
    [2.0, 0.6, 3.6, 0.0],
    [0.4, 0.6, 4.4, 0.0],
    [0.4, 2.6, 4.4, 0.0],
    [2.0, 2.6, 3.6, 0.0],
];
const RADIANCES: [[f32; 3]; 3] = [[3.2, 2.8, 2.2], [1.6, 2.0, 3.0], [1.5, 1.5, 1.5]];

/// Draws the picture that a source makes with the shipped tables.
pub fn draw(gpu: &Gpu, source: &str, [width, height]: [u32; 2]) -> LinearImage {
    let Gpu { device, queue, .. } = gpu;
    let size = u64::from(width * height) * 16;
    let buffer =
        |usage| device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false });
    let picture = buffer(BufferUsages::STORAGE | BufferUsages::COPY_SRC);
    let readback = buffer(BufferUsages::COPY_DST | BufferUsages::MAP_READ);
    let storage = |contents: &[u8]| {
        let usage = BufferUsages::STORAGE;
        device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
    };
    let (lights, corners) = (storage(bytemuck::cast_slice(&lights())), storage(bytemuck::cast_slice(&CORNERS)));
    let (sheen, ggx) = (SheenTable::embedded(), GgxTable::embedded());
    let tables = [(sheen.size(), sheen.texels()), (ggx.texture_size(), ggx.texels())]
        .map(|(size, texels)| texture(gpu, size, &texels));
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
    let resources = [picture.as_entire_binding(), lights.as_entire_binding(), corners.as_entire_binding()]
        .into_iter()
        .chain(tables.iter().map(wgpu::BindingResource::TextureView));
    let entries: Vec<wgpu::BindGroupEntry<'_>> =
        (0..).zip(resources).map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }).collect();
    let layout = pipeline.get_bind_group_layout(0);
    let group =
        device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries });
    let mut encoder = device.create_command_encoder(&Default::default());
    {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(width.div_ceil(8), height.div_ceil(8), 1);
    }
    encoder.copy_buffer_to_buffer(&picture, 0, &readback, 0, size);
    queue.submit([encoder.finish()]);
    readback.map_async(wgpu::MapMode::Read, .., |mapped| mapped.expect("a buffer made to be read"));
    device.poll(PollType::wait_indefinitely()).expect("the device answers");
    let pixels: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&readback.get_mapped_range(..).expect("mapped above"));
    LinearImage { width, height, pixels: pixels.into_iter().map(|[red, green, blue, _]| [red, green, blue]).collect() }
}

/// As lights_buffers.wgsl has them.
fn lights() -> Vec<[f32; 8]> {
    let corner = |k: usize| glam::Vec3::from_slice(&CORNERS[k]);
    let light = |(index, [red, green, blue]): (usize, [f32; 3])| {
        let first = 4 * index;
        let normal = (corner(first + 1) - corner(first)).cross(corner(first + 2) - corner(first)).normalize();
        let [first, count] = [first as u32, 4].map(f32::from_bits);
        [normal.x, normal.y, normal.z, first, red, green, blue, count]
    };
    RADIANCES.into_iter().enumerate().map(light).collect()
}

fn texture(gpu: &Gpu, [width, height]: [usize; 2], texels: &[[f32; 4]]) -> wgpu::TextureView {
    let descriptor = wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: width as u32, height: height as u32, depth_or_array_layers: 1 },
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
