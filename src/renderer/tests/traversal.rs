//! Rays through the trees on the device against all triangles one after the other, in `f64`.

use glam::{Affine2, DVec2, DVec3, Mat4, Vec2, Vec3};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use wgpu::util::DeviceExt;
use wgpu::{BindGroupLayout, BufferUsages, ComputePipeline};

use super::super::device::{self, Gpu};
use super::super::shader::SHADOWED_WGSL;
use super::super::shadows::Shadows;
use crate::math::warp::unit_sphere;
use crate::scene::{
    AlphaMode, Drawn, Edits, Image, Instance, Light, Material, Mesh, Sampler, Scene, Texture, TextureSlot, TextureUse,
    Wrap,
};

/// One thread follows one ray: its start and distance, and its direction and light, as bits.
const ENTRY: &str = "
@group(0) @binding(30) var<storage, read> traversal_rays: array<vec4u>;
@group(0) @binding(31) var<storage, read_write> traversal_shares: array<f32>;
@compute @workgroup_size(64)
fn traversal(@builtin(global_invocation_id) thread: vec3u) {
    let start = bitcast<vec4f>(traversal_rays[2u * thread.x]);
    let way = traversal_rays[2u * thread.x + 1u];
    traversal_shares[thread.x] = rays_passing(start.xyz, bitcast<vec3f>(way.xyz), start.w, way.w);
}";

/// `RAYS_UNTIL` and `RAYS_OWN_UNTIL` of `rays.wgsl`.
const UNTIL: [f64; 2] = [0.99999, 0.999];
/// What 32 bits leave of a place, as a share of what it is computed from.
const ROUNDING: f64 = 1e-6;
/// What they leave of an opacity.
const OPACITY: f64 = 2e-3;
/// Rays of each kind.
const RAYS: usize = 8192;
/// The share of rays that may be too near to an edge, or to their end, to be judged.
const MOST_UNCERTAIN: f64 = 0.03;

#[derive(Clone, Copy)]
struct Ray {
    start: Vec3,
    direction: Vec3,
    distance: f32,
    light: u32,
}

impl Ray {
    fn between(start: Vec3, end: Vec3, light: u32) -> Self {
        let way = (end - start).as_dvec3();
        Self { start, direction: way.normalize().as_vec3(), distance: way.length() as f32, light }
    }

    fn words(&self) -> [u32; 8] {
        let ([x, y, z], [u, v, w]) = (self.start.to_array(), self.direction.to_array());
        [
            x.to_bits(),
            y.to_bits(),
            z.to_bits(),
            self.distance.to_bits(),
            u.to_bits(),
            v.to_bits(),
            w.to_bits(),
            self.light,
        ]
    }
}

struct Device {
    gpu: Gpu,
    pipeline: ComputePipeline,
}

impl Device {
    fn new() -> Self {
        let gpu = pollster::block_on(device::open_offscreen(None)).expect("this test needs a device");
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("traversal"),
            source: wgpu::ShaderSource::Wgsl([SHADOWED_WGSL, ENTRY].concat().into()),
        });
        let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("traversal"),
            layout: None,
            module: &module,
            entry_point: Some("traversal"),
            compilation_options: Default::default(),
            cache: None,
        });
        Self { gpu, pipeline }
    }

    /// What is bound for a scene as the surfaces' pass binds it, but for this pipeline.
    fn shadows(&self, drawn: &Drawn) -> Shadows {
        let layout: BindGroupLayout = self.pipeline.get_bind_group_layout(2);
        let mut shadows = Shadows::default();
        let blockers = shadows.gather(&self.gpu.device.limits(), drawn).expect("there is something to build");
        shadows.receive(&self.gpu, &layout, blockers.build());
        assert_eq!(shadows.lack, None);
        shadows
    }

    /// The shares that pass along rays, a multiple of 64.
    fn shares(&self, shadows: &Shadows, rays: &[Ray]) -> Vec<f32> {
        let Gpu { device, queue, .. } = &self.gpu;
        let words: Vec<[u32; 8]> = rays.iter().map(Ray::words).collect();
        let buffer = |contents: &[u8], usage| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
        };
        let (size, storage) = (4 * rays.len(), BufferUsages::STORAGE);
        let rays_buffer = buffer(bytemuck::cast_slice(&words), storage);
        let results = buffer(&vec![0; size], storage | BufferUsages::COPY_SRC);
        let readback = buffer(&vec![0; size], BufferUsages::COPY_DST | BufferUsages::MAP_READ);
        let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &[
                wgpu::BindGroupEntry { binding: 30, resource: rays_buffer.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 31, resource: results.as_entire_binding() },
            ],
        });
        let mut encoder = device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &bind_group, &[]);
        pass.set_bind_group(2, shadows.bound().expect("something stands in the way").0, &[]);
        pass.dispatch_workgroups(rays.len() as u32 / 64, 1, 1);
        drop(pass);
        encoder.copy_buffer_to_buffer(&results, 0, &readback, 0, size as u64);
        queue.submit([encoder.finish()]);
        readback.map_async(wgpu::MapMode::Read, .., |mapped| mapped.expect("results are read"));
        device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
        bytemuck::cast_slice(&readback.get_mapped_range(..).expect("they are mapped")).to_vec()
    }
}

/// A triangle in the world, and what of it counts.
struct Obstacle<'a> {
    corners: [DVec3; 3],
    uvs: [DVec2; 3],
    light: Option<u32>,
    material: &'a Material,
}

fn obstacles<'a>(drawn: &'a Drawn) -> Vec<Obstacle<'a>> {
    let shown = (0..drawn.instances.len()).filter(|&instance| drawn.is_drawn(instance));
    let of = |instance: usize| {
        let Instance { mesh, world_from_mesh, .. } = &drawn.instances[instance];
        let mesh = &drawn.scene.meshes[*mesh];
        let light = drawn.light_index(instance).map(|light| light as u32);
        let one = move |corners: &[u32; 3]| Obstacle {
            corners: corners
                .map(|at| world_from_mesh.as_dmat4().transform_point3(mesh.positions[at as usize].as_dvec3())),
            uvs: corners.map(|at| mesh.tex_coords[0].get(at as usize).copied().unwrap_or_default().as_dvec2()),
            light,
            material: &drawn.materials[mesh.material],
        };
        mesh.indices.as_chunks::<3>().0.iter().map(one)
    };
    shown.flat_map(of).collect()
}

/// The share of light that a triangle lets through; none where rounding decides whether it is met.
fn passing(scene: &Scene, obstacle: &Obstacle, ray: &Ray, rounding: f64) -> Option<f64> {
    let [a, b, c] = obstacle.corners;
    let (start, direction) = (ray.start.as_dvec3(), ray.direction.as_dvec3());
    let (ab, ac) = (b - a, c - a);
    let face = ab.cross(ac);
    let longest = [ab, ac, c - b].map(DVec3::length).into_iter().fold(0.0, f64::max);
    if face.length() <= 1e-9 * longest * longest {
        return Some(1.0);
    }
    let slope = face.dot(direction);
    let distance = face.dot(a - start) / slope;
    // How far rounding moves the place where they meet, and how far that is in weights and along the ray.
    let steepness = slope.abs() / face.length();
    let moved = rounding / steepness.max(1e-12);
    let (slack, until) = (moved * longest / face.length(), UNTIL[usize::from(obstacle.light == Some(ray.light))]);
    let end = until * f64::from(ray.distance);
    let p = start + distance * direction;
    let weights = [(b, c), (c, a), (a, b)].map(|(p0, p1)| (p1 - p0).cross(p - p0).dot(face) / face.length_squared());
    let least = weights.into_iter().fold(f64::INFINITY, f64::min);
    let is_beyond = |by: f64| least > by && distance > moved && distance < end - moved;
    let may_meet = least > -slack && distance > -moved && distance < end + moved;
    match (is_beyond(slack), may_meet) {
        (_, false) => Some(1.0),
        (false, true) => None,
        (true, true) => left(scene, obstacle, weights),
    }
}

/// What a triangle lets through at these weights of its corners; none where rounding decides.
fn left(scene: &Scene, obstacle: &Obstacle, weights: [f64; 3]) -> Option<f64> {
    let material = obstacle.material;
    let uv: DVec2 = obstacle.uvs.iter().zip(weights).map(|(uv, weight)| *uv * weight).sum();
    let texel = material.texture(TextureSlot::BaseColor).map_or(1.0, |used| {
        let texture = scene.textures[used.texture];
        let image = &scene.images[texture.image];
        let uv = used.uv_from_tex_coord.as_daffine2().transform_point2(uv);
        texture.sampler.magnified([image.width, image.height], uv, |at| f64::from(image.texels[at][3]) / 255.0)
    });
    let opacity = f64::from(material.opacity) * texel;
    match material.alpha_mode {
        AlphaMode::Opaque => Some(0.0),
        AlphaMode::Blend => Some(1.0 - opacity),
        AlphaMode::Mask { cutoff } if (opacity - f64::from(cutoff)).abs() < OPACITY => None,
        AlphaMode::Mask { cutoff } => Some(if opacity < f64::from(cutoff) { 1.0 } else { 0.0 }),
    }
}

/// Holds all rays through a scene to what the triangles say, and says how many of them pass, pass in part, and are stopped.
fn hold(device: &Device, scene: &Scene, edits: &Edits, rays: &[Ray]) -> [usize; 3] {
    let drawn = Drawn::new(scene, edits);
    let found = device.shares(&device.shadows(&drawn), rays);
    let obstacles = obstacles(&drawn);
    let extent = obstacles.iter().flat_map(|obstacle| obstacle.corners).map(|corner| corner.abs().max_element());
    let extent = extent.fold(0.0, f64::max);
    let (mut uncertain, mut kinds) = (0, [0; 3]);
    for (ray, found) in rays.iter().zip(found) {
        let rounding = ROUNDING * extent.max(ray.start.as_dvec3().abs().max_element());
        let shares = obstacles.iter().map(|obstacle| passing(scene, obstacle, ray, rounding));
        let Some(expected) = shares.product::<Option<f64>>() else {
            uncertain += 1;
            continue;
        };
        let off = (f64::from(found) - expected).abs();
        let what = format!("from {} along {} for {}", ray.start, ray.direction, ray.distance);
        assert!(off <= if expected.fract() == 0.0 { 0.0 } else { OPACITY }, "{what}: {found}, not {expected}");
        kinds[if expected == 1.0 {
            0
        } else if expected == 0.0 {
            2
        } else {
            1
        }] += 1;
    }
    assert!(f64::from(uncertain) < MOST_UNCERTAIN * rays.len() as f64, "{uncertain} rays of {}", rays.len());
    kinds
}

fn anywhere(rng: &mut impl Rng, half: f64) -> Vec3 {
    let mut number = || half * (rng.next_u32() as f64 / (1u64 << 31) as f64 - 1.0);
    DVec3::new(number(), number(), number()).as_vec3()
}

/// So many triangles about places in a cube of half side 1.
fn mesh(rng: &mut impl Rng, count: usize, size: f64, material: usize) -> Mesh {
    let mut triangle = || {
        let center = anywhere(rng, 1.0);
        [0; 3].map(|_| center + size as f32 * unit_sphere(rng).as_vec3())
    };
    let positions: Vec<Vec3> = (0..count).flat_map(|_| triangle()).collect();
    Mesh {
        normals: vec![Vec3::Z; positions.len()],
        indices: (0..positions.len() as u32).collect(),
        tex_coords: [positions.iter().map(|at| 2.0 * at.truncate()).collect(), Vec::new()],
        positions,
        material,
        ..Mesh::default()
    }
}

fn scene(meshes: Vec<Mesh>, world_from_meshes: &[Mat4]) -> Scene {
    let used =
        TextureUse { texture: 0, tex_coord: 0, uv_from_tex_coord: Affine2::from_translation(Vec2::new(0.1, 0.3)) };
    let opacity = |alpha_mode, opacity| {
        let mut material = Material { alpha_mode, opacity, ..Material::matte("", Vec3::ONE) };
        material.textures[TextureSlot::BaseColor as usize] = Some(used);
        material
    };
    let texel = |at: u32| [255, 255, 255, (at * 37 % 256) as u8];
    let instance = |(mesh, world_from_mesh): (usize, &Mat4)| Instance {
        name: String::new(),
        mesh,
        world_from_mesh: *world_from_mesh,
    };
    Scene {
        instances: world_from_meshes.iter().enumerate().map(instance).collect(),
        meshes,
        materials: vec![
            Material::matte("", Vec3::ONE),
            opacity(AlphaMode::Mask { cutoff: 0.5 }, 0.9),
            opacity(AlphaMode::Blend, 0.7),
            Material { emission: Vec3::ONE, ..Material::matte("", Vec3::ZERO) },
        ],
        images: vec![Image { name: String::new(), width: 5, height: 3, texels: (0..15).map(texel).collect() }],
        textures: vec![Texture {
            image: 0,
            sampler: Sampler { wrap: [Wrap::Repeat, Wrap::Mirror], ..Sampler::DEFAULT },
        }],
        ..Scene::default()
    }
}

/// Triangles of all kinds: opaque, cut out, blended, glowing; some without area, and one that reaches far beyond all others.
fn mixed(rng: &mut impl Rng) -> Scene {
    let mut meshes = vec![mesh(rng, 60, 0.2, 0), mesh(rng, 60, 0.3, 1), mesh(rng, 60, 0.3, 2), mesh(rng, 20, 0.3, 3)];
    let positions = &mut meshes[0].positions;
    positions.extend([Vec3::splat(0.1); 3]);
    positions.extend([Vec3::ZERO, Vec3::splat(0.25), Vec3::splat(0.5)]);
    positions.extend([Vec3::new(-40.0, -0.7, -30.0), Vec3::new(50.0, -0.8, -20.0), Vec3::new(0.0, -0.6, 40.0)]);
    let all = meshes[0].positions.len();
    meshes[0].indices = (0..all as u32).collect();
    meshes[0].tex_coords[0].resize(all, Vec2::ZERO);
    let turned = Mat4::from_rotation_y(0.7) * Mat4::from_scale(Vec3::new(-1.0, 1.3, 0.7));
    let mut scene = scene(meshes, &[Mat4::IDENTITY, turned, Mat4::from_rotation_x(0.4), Mat4::IDENTITY]);
    scene.lights = vec![Light { instance: 3, radiance: Vec3::ONE, ..Light::default() }];
    scene
}

#[test]
fn rays_pass_where_no_triangle_is_in_the_way() {
    let (device, mut rng) = (Device::new(), Pcg64::seed_from_u64(1));
    let scene = mixed(&mut rng);
    let shown = Edits::default();
    // To places on the emitter too, to which it counts as their own light, or as another.
    let own = scene.meshes[3].positions.clone();
    let mut ray = |kind: usize, light: u32| {
        let (start, end) = (anywhere(&mut rng, 1.2), anywhere(&mut rng, 1.2));
        let (axis, sign) = (kind % 3, [0.0, -0.0][kind / 3 % 2]);
        match kind {
            0..6 => {
                let mut direction = [sign; 3];
                direction[axis] = if start[axis] < 0.0 { 1.0 } else { -1.0 };
                Ray { start, direction: direction.into(), distance: 1.5, light }
            }
            6..12 => {
                let mut end = end;
                end[axis] = start[axis];
                let mut ray = Ray::between(start, end, light);
                ray.direction[axis] = sign;
                ray
            }
            12..20 => Ray::between(start, end, light),
            20..22 => Ray::between(40.0 * start, end, light),
            22..24 => Ray::between(start, 60.0 * end, light),
            _ => {
                let corner = kind * 3 % (own.len() / 3) * 3;
                let mut ray =
                    Ray::between(start, 0.3 * own[corner] + 0.3 * own[corner + 1] + 0.4 * own[corner + 2], light);
                // Another light's goes on beyond.
                ray.distance *= [1.0, 1.05][light as usize];
                ray
            }
        }
    };
    let rays: Vec<Ray> = (0..RAYS).map(|at| ray(at % 32, (at / 32 % 2) as u32)).collect();
    let kinds = hold(&device, &scene, &shown, &rays);
    assert!(kinds.iter().all(|&count| count > RAYS / 16), "{kinds:?}");
    // Lamps that are not shown are not in the way.
    let unseen = Edits { lights_visible: Some(false), ..shown };
    let more = hold(&device, &scene, &unseen, &rays);
    assert!(more[0] > kinds[0] + RAYS / 100, "{kinds:?} {more:?}");
}

/// Nothing blocks where nothing is; what moves with lights blocks alone, and so does what stays.
#[test]
fn either_tree_may_be_empty() {
    let (device, mut rng) = (Device::new(), Pcg64::seed_from_u64(2));
    let drawn_of = |scene: &Scene, edits: &Edits| {
        let rays: Vec<Ray> =
            (0..RAYS).map(|_| Ray::between(anywhere(&mut rng, 1.2), anywhere(&mut rng, 1.2), 0)).collect();
        hold(&device, scene, edits, &rays)
    };
    let mut mixed = mixed(&mut Pcg64::seed_from_u64(3));
    let mut drawn_of = drawn_of;
    let mut glowing = mixed.clone();
    glowing.instances.drain(..3);
    glowing.lights[0].instance = 0;
    mixed.instances.truncate(3);
    mixed.lights.clear();
    for scene in [&glowing, &mixed] {
        let [passed, .., stopped] = drawn_of(scene, &Edits::default());
        assert!(passed > RAYS / 20 && stopped > RAYS / 20, "{passed} {stopped}");
    }
    // With its only emitter hidden, there is nothing.
    for (scene, lights_visible) in [(&Scene::default(), true), (&glowing, false)] {
        let edits = Edits { lights_visible: Some(lights_visible), ..Edits::default() };
        assert!(device.shadows(&Drawn::new(scene, &edits)).bound().is_none());
    }
}
