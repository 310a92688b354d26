//! What a pixel pays for a rectangle light: the shipped files against the published quad shader, each a full-screen triangle.
//!
//! The variants take turns, so that whatever else the machine does slows all of them alike; figures are medians over
//! the rounds.

use glam::{Vec3, Vec4};
use half::f16;
use std::time::{Duration, Instant};
use velour::renderer::device::{self, Gpu};
use velour::table::SheenTable;
use wgpu::util::DeviceExt;

const SIZE: [u32; 2] = [1280, 720];
const ROUNDS: usize = 30;
/// The least duration of a sample, against which the time to submit it does not count.
const SAMPLE: Duration = Duration::from_millis(20);
const SPECULAR_NODES: u32 = 64;

const VARIANTS: [(&str, &str); 8] = [
    ("empty", "a constant of the point"),
    ("published", "published quad, GGX + diffuse, two filtered fetches"),
    ("filtered", "ltc.wgsl, the same lobes and fetches"),
    ("shipped", "ltc.wgsl, with eight loads for two fetches"),
    ("with_sheen", "  the same and the sheen, four loads more"),
    ("streamed", "  GGX + diffuse, vertices in a loop"),
    ("one", "  GGX alone, vertices in a loop"),
    ("sampled", "  the same and a point, ltc_sample.wgsl"),
];
const EMPTY: usize = 0;
const PUBLISHED: usize = 1;
const FILTERED: usize = 2;
const SHIPPED: usize = 3;
const WITH_SHEEN: usize = 4;
const ONE: usize = 6;
const SAMPLED: usize = 7;

/// The target, and what all variants read.
struct Stage {
    gpu: Gpu,
    target: wgpu::Texture,
    layout: wgpu::BindGroupLayout,
    group: wgpu::BindGroup,
}

impl Stage {
    fn new(gpu: Gpu) -> Self {
        let target = gpu.device.create_texture(&texture_descriptor(
            SIZE,
            wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        ));
        let scene = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: None,
            contents: bytemuck::cast_slice(&scene()),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let matrices = table(&gpu, SPECULAR_NODES, &specular_nodes(specular_matrix));
        let weights = table(&gpu, SPECULAR_NODES, &specular_nodes(specular_weights));
        let sheen = SheenTable::embedded();
        let sheen = table(&gpu, sheen.size()[0] as u32, &sheen.texels());
        let linear = wgpu::FilterMode::Linear;
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            mag_filter: linear,
            min_filter: linear,
            ..Default::default()
        });
        let uniform = wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let texture = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: true },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        };
        let filtering = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
        let bindings = [
            (uniform, scene.as_entire_binding()),
            (texture, wgpu::BindingResource::TextureView(&matrices)),
            (texture, wgpu::BindingResource::TextureView(&weights)),
            (filtering, wgpu::BindingResource::Sampler(&sampler)),
            (texture, wgpu::BindingResource::TextureView(&sheen)),
        ];
        let visibility = wgpu::ShaderStages::FRAGMENT;
        let (layout, resources): (Vec<_>, Vec<_>) = (0..)
            .zip(bindings)
            .map(|(binding, (ty, resource))| {
                let entry = wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None };
                (entry, wgpu::BindGroupEntry { binding, resource })
            })
            .unzip();
        let layout =
            gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: None, entries: &layout });
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &layout,
            entries: &resources,
        });
        Self { gpu, target, layout, group }
    }

    fn pipeline(&self, entry: &str) -> wgpu::RenderPipeline {
        let source = [
            include_str!("../shaders/ltc.wgsl"),
            include_str!("../shaders/ltc_sample.wgsl"),
            include_str!("../shaders/sheen.wgsl"),
            include_str!("polygon/scene.wgsl"),
            include_str!("polygon/published.wgsl"),
            include_str!("polygon/shipped.wgsl"),
            include_str!("polygon/sampled.wgsl"),
        ]
        .concat();
        let module = self.gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(entry),
            source: wgpu::ShaderSource::Wgsl(source.into()),
        });
        let layout = self.gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&self.layout)],
            immediate_size: 0,
        });
        self.gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(entry),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("cover"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: Default::default(),
            depth_stencil: None,
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some(entry),
                compilation_options: Default::default(),
                targets: &[Some(self.target.format().into())],
            }),
            multiview_mask: None,
            cache: None,
        })
    }

    /// Seconds for a picture, which is drawn this many times in a row.
    fn draw(&self, pipeline: &wgpu::RenderPipeline, times: u32) -> f64 {
        let view = self.target.create_view(&Default::default());
        let start = Instant::now();
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: Default::default(),
            })],
            ..Default::default()
        });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.draw(0..3, 0..times);
        drop(pass);
        self.gpu.queue.submit([encoder.finish()]);
        self.wait();
        start.elapsed().as_secs_f64() / f64::from(times)
    }

    fn wait(&self) {
        self.gpu.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
    }

    /// The picture drawn last: specular, diffuse, the specular form factor, sheen.
    fn picture(&self) -> Vec<[f16; 4]> {
        let stride = SIZE[0] * 8;
        let buffer = self.gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(stride * SIZE[1]),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(stride), rows_per_image: None };
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            self.target.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
            self.target.size(),
        );
        self.gpu.queue.submit([encoder.finish()]);
        buffer.map_async(wgpu::MapMode::Read, .., |mapped| mapped.expect("a buffer made to be read"));
        self.wait();
        bytemuck::pod_collect_to_vec(&buffer.get_mapped_range(..).expect("mapped above"))
    }
}

fn texture_descriptor(size: [u32; 2], usage: wgpu::TextureUsages) -> wgpu::TextureDescriptor<'static> {
    wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba16Float,
        usage,
        view_formats: &[],
    }
}

fn table(gpu: &Gpu, width: u32, texels: &[[f32; 4]]) -> wgpu::TextureView {
    let descriptor = texture_descriptor([width, texels.len() as u32 / width], wgpu::TextureUsages::TEXTURE_BINDING);
    let halves: Vec<f16> = texels.iter().flatten().map(|&number| f16::from_f32(number)).collect();
    let order = wgpu::util::TextureDataOrder::LayerMajor;
    let texture = gpu.device.create_texture_with_data(&gpu.queue, &descriptor, order, bytemuck::cast_slice(&halves));
    texture.create_view(&Default::default())
}

/// The shaders' `Scene`: an upright light that leans and is turned a little, and the eye.
fn scene() -> Vec<Vec4> {
    let (centre, across, up) = (Vec3::new(0.3, 9.0, 2.6), Vec3::new(5.0, 0.4, 0.3), Vec3::new(-0.25, 0.75, 2.5));
    let corners = [centre + across - up, centre + across + up, centre - across + up, centre - across - up];
    let normal = across.cross(up).normalize();
    let eye = Vec3::new(0.0, 0.0, 2.0);
    corners.into_iter().chain([normal, eye]).map(|vector| vector.extend(0.0)).collect()
}

fn specular_nodes(node: fn(f32, f32) -> [f32; 4]) -> Vec<[f32; 4]> {
    let last = (SPECULAR_NODES - 1) as f32;
    let row = |mu: f32| (0..SPECULAR_NODES).map(move |k| node(k as f32 / last, mu));
    (0..SPECULAR_NODES).flat_map(|k| row(k as f32 / last)).collect()
}

fn specular_matrix(roughness: f32, mu: f32) -> [f32; 4] {
    let c = 1.0 / (roughness * roughness).max(0.1);
    [(0.3 + 0.7 * mu) * c, 0.9 * (1.0 - mu) * c, c, 1.0]
}

fn specular_weights(roughness: f32, mu: f32) -> [f32; 4] {
    [1.0 - 0.4 * roughness * mu, 0.1 * (1.0 - mu).powi(5), 0.0, 1.0]
}

fn median(numbers: impl Iterator<Item = f64>) -> f64 {
    let mut sorted: Vec<f64> = numbers.collect();
    sorted.sort_by(f64::total_cmp);
    sorted[sorted.len() / 2]
}

/// How far a variant's diffuse form factors are from the published ones: mean and greatest difference. It would be no
/// use to time a variant that lights something else.
fn difference(pictures: &[Vec<[f16; 4]>], variant: usize) -> [f64; 2] {
    let differences = pictures[variant].iter().zip(&pictures[PUBLISHED]).map(|(a, b)| (a[1] - b[1]).to_f64().abs());
    let (sum, greatest) = differences.fold((0.0, 0.0_f64), |(sum, greatest), next| (sum + next, greatest.max(next)));
    let mean = sum / pictures[variant].len() as f64;
    assert!(mean < 1e-3, "{} and the published form differ by {mean} in the mean", VARIANTS[variant].0);
    [mean, greatest]
}

fn main() {
    let stage = Stage::new(pollster::block_on(device::open_offscreen(None)).expect("this bench needs a device"));
    let pipelines = VARIANTS.map(|(entry, _)| stage.pipeline(entry));
    let pictures = pipelines.each_ref().map(|pipeline| {
        // The first picture pays for the driver's compiler.
        stage.draw(pipeline, 1);
        stage.picture()
    });
    let fastest = stage.draw(&pipelines[EMPTY], 1);
    let times = (SAMPLE.as_secs_f64() / fastest).ceil().clamp(1.0, 1000.0) as u32;
    let rounds: Vec<[f64; VARIANTS.len()]> =
        (0..ROUNDS).map(|_| pipelines.each_ref().map(|pipeline| stage.draw(pipeline, times))).collect();

    println!("{}, {} x {}, {times} pictures x {ROUNDS} rounds", stage.gpu.adapter.get_info().name, SIZE[0], SIZE[1]);
    println!("{:<52} {:>9} {:>9} {:>11}", "", "ns/pixel", "less empty", "/ published");
    let pixels = f64::from(SIZE[0] * SIZE[1]);
    let nanoseconds = |seconds: f64| seconds * 1e9 / pixels;
    for (variant, (_, what)) in VARIANTS.iter().enumerate() {
        let all = nanoseconds(median(rounds.iter().map(|round| round[variant])));
        let own = nanoseconds(median(rounds.iter().map(|round| round[variant] - round[EMPTY])));
        let ratio =
            median(rounds.iter().map(|round| (round[variant] - round[EMPTY]) / (round[PUBLISHED] - round[EMPTY])));
        println!("{what:<52} {all:>9.2} {own:>9.2} {ratio:>11.3}");
    }
    let sheen =
        median(rounds.iter().map(|round| (round[WITH_SHEEN] - round[SHIPPED]) / (round[SHIPPED] - round[EMPTY])));
    println!("the sheen adds {:.1}% of the light without it", 100.0 * sheen);
    let point = median(rounds.iter().map(|round| (round[SAMPLED] - round[ONE]) / (round[ONE] - round[EMPTY])));
    println!("a point on the light costs {point:.2} times one lobe's form factor with its loads");
    let [mean, greatest] = difference(&pictures, FILTERED);
    println!("published and exact diffuse form factors differ by {mean:.1e} in the mean, {greatest:.2} at most");
}
