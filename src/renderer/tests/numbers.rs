//! What every pixel reads of a scene, against what was written.

use glam::{Mat4, Vec3};
use wgpu::BufferUsages;
use wgpu::util::DeviceExt;

use super::super::Offscreen;
use super::super::device::{self, Gpu};
use super::super::lights::GpuPolygon;
use super::super::materials::GpuMaterial;
use super::super::numbers::{TrackedNumbers, Words};
use crate::scene::{Camera, Drawn, Edits, Instance, Light, Material, Mesh, Polygon, Projection, Scene};
use crate::table::SheenTable;

/// The files that take records apart, where the lights begin at texel 12 and their outlines at texel 22.
const READERS: &str = concat!(
    include_str!("../../../shaders/passes/numbers.wgsl"),
    include_str!("../../../shaders/passes/factors.wgsl"),
    include_str!("../../../shaders/passes/emitters.wgsl"),
);
/// Puts two records of each kind together again.
const ENTRY: &str = "
    struct Found { materials: array<Factors, 2>, polygons: array<EmittersPolygon, 2>, vertices: array<vec4f, 2> }
    @group(0) @binding(30) var<storage, read_write> found: Found;
    @compute @workgroup_size(1)
    fn read_all() {
        for (var index = 0u; index < 2u; index++) {
            found.materials[index] = factors_of(index);
            found.polygons[index] = emitters_polygon(index);
            found.vertices[index] = emitters_vertex(index);
        }
    }";

/// What the shader makes of these texels: the words of `Found`.
fn read(gpu: &Gpu, texels: Vec<Words>) -> Vec<u32> {
    let (device, bytes) = (&gpu.device, 16 * texels.len() as u64);
    let source = [READERS, ENTRY].concat();
    let source = source.replace("frame_now.first_light", "12u").replace("frame_now.first_vertex", "22u");
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("numbers"),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    });
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("numbers"),
        layout: None,
        module: &module,
        entry_point: Some("read_all"),
        compilation_options: Default::default(),
        cache: None,
    });
    let numbers = TrackedNumbers::new(gpu, "numbers", texels).unwrap();
    let buffer = |usage| {
        let contents = vec![0; bytes as usize];
        device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents: &contents, usage })
    };
    let found = buffer(BufferUsages::STORAGE | BufferUsages::COPY_SRC);
    let readback = buffer(BufferUsages::COPY_DST | BufferUsages::MAP_READ);
    let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[
            wgpu::BindGroupEntry { binding: 4, resource: numbers.binding() },
            wgpu::BindGroupEntry { binding: 30, resource: found.as_entire_binding() },
        ],
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_compute_pass(&Default::default());
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &bind_group, &[]);
    pass.dispatch_workgroups(1, 1, 1);
    drop(pass);
    encoder.copy_buffer_to_buffer(&found, 0, &readback, 0, bytes);
    gpu.queue.submit([encoder.finish()]);
    readback.map_async(wgpu::MapMode::Read, .., |mapped| mapped.expect("results are read"));
    device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
    bytemuck::cast_slice(&readback.get_mapped_range(..).expect("they are mapped")).to_vec()
}

/// Structs stand in memory alike in Rust and in WGSL, as other tests hold; here each word comes to its place in them.
#[test]
fn records_are_put_together_as_they_were_written() {
    let gpu = pollster::block_on(device::open_offscreen(None)).expect("this test needs a device");
    let [material, polygon] = [size_of::<GpuMaterial>(), size_of::<GpuPolygon>()].map(|bytes| bytes / 16);
    assert_eq!([2 * material, 2 * (material + polygon)], [12, 22]);
    // Floats all, and none of them the same.
    let texels: Vec<Words> = (0..24)
        .map(|texel| [0, 1, 2, 3].map(|word| (4 * texel + word) as f32 + 1.0))
        .map(|texel| texel.map(f32::to_bits))
        .collect();
    let written: &[u32] = bytemuck::cast_slice(&texels);
    let found = read(&gpu, texels.clone());
    for (at, (found, written)) in found.iter().zip(written).enumerate() {
        // After `manual` a material has room for three more words, which are not read.
        let is_padding = at < 4 * 2 * material && at % (4 * material) > 20;
        assert_eq!(*found, if is_padding { 0 } else { *written }, "word {at}");
    }
}

/// A floor under so many small lights, each of which leaves its trace.
fn lit_by(count: usize) -> Scene {
    let floor = |x: f32, z: f32| Vec3::new(x, 0.0, z);
    let mesh = Mesh {
        positions: vec![floor(-2.0, -2.0), floor(-2.0, 2.0), floor(2.0, 2.0), floor(2.0, -2.0)],
        normals: vec![Vec3::Y; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Mesh::default()
    };
    let light = |index: usize| {
        let corner = |x: f32, z: f32| {
            Vec3::new(-1.8 + 0.19 * (index % 20) as f32 + x, 0.5, -1.8 + 0.19 * (index / 20) as f32 + z)
        };
        let outline = vec![corner(0.0, 0.0), corner(0.1, 0.0), corner(0.1, 0.1), corner(0.0, 0.1)];
        let polygons = vec![Polygon { contours: vec![outline], normal: Vec3::NEG_Y, pattern: None }];
        Light { radiance: Vec3::splat(1.0 + index as f32 / 100.0), polygons, instance: 1, ..Light::default() }
    };
    let world_from_camera = Mat4::from_translation(4.0 * Vec3::Y) * Mat4::from_rotation_x(-std::f32::consts::FRAC_PI_2);
    let projection = Projection::Perspective { yfov: 1.0, near: 0.1, far: f32::INFINITY };
    let below = Mat4::from_translation(-9.0 * Vec3::Y);
    let instance = |world_from_mesh| Instance { name: String::new(), mesh: 0, world_from_mesh };
    Scene {
        meshes: vec![mesh],
        // The second is the lights' own.
        instances: vec![instance(Mat4::IDENTITY), instance(below)],
        materials: vec![Material::matte("floor", Vec3::splat(0.5))],
        lights: (0..count).map(light).collect(),
        cameras: vec![Camera { name: String::new(), world_from_camera, projection }],
        ..Scene::default()
    }
}

/// From few to more than a row holds, and back.
#[test]
fn lights_may_become_many_and_few_again() {
    let gpu = pollster::block_on(device::open_offscreen(None)).expect("this test needs a device");
    let edits = Edits { shadows: Some(false), ..Edits::default() };
    let scenes = [3, 400, 2].map(lit_by);
    let (table, size) = (SheenTable::embedded(), [24, 16]);
    let mut kept = Offscreen::for_linear(&gpu, 1, &table, &Drawn::new(&scenes[0], &edits)).unwrap();
    for scene in &scenes {
        let drawn = Drawn::new(scene, &edits);
        kept.update(&gpu, &drawn).unwrap();
        let mut fresh = Offscreen::for_linear(&gpu, 1, &table, &drawn).unwrap();
        let [found, expected] = [&mut kept, &mut fresh]
            .map(|renderer| gpu.block_on(renderer.linear(&gpu, &scene.cameras[0], size, &drawn.settings)).unwrap());
        assert_eq!(found.pixels, expected.pixels, "{} lights", scene.lights.len());
        let brightest = expected.pixels.iter().flatten().fold(0.0_f32, |most, value| most.max(*value));
        assert!(brightest > 0.0);
    }
}
