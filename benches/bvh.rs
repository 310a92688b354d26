//! Rays against the default scene's 80,000 triangles: the time to build hierarchies over them, the bytes that these take,
//! and the time to trace rays through them.
//!
//! The library's hierarchy has nodes of eight boxes in `f32`, around triangles that are intersected in `f64`. It is
//! compared with one of two boxes per node, by the same crate. The rays are a camera's, side by side, and those of
//! light that is scattered from where these meet the scene. From there shadows' rays go to points of a light, and stop at the
//! first thing that they meet.

use std::hint::black_box;
use std::ops::ControlFlow;
use std::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::{DVec3, Vec3A};
use obvhs::aabb::Aabb;
use obvhs::bvh2::{Bvh2, builder::build_bvh2};
use obvhs::ray::RayHit;
use obvhs::{Boundable, BvhBuildParams};
use rand::SeedableRng;
use rand_pcg::Pcg64;
use velour::bvh::{Bvh, Primitive, Ray, Triangle};
use velour::math::warp::{uniform, unit_sphere};
use velour::scene::assets::DRAPE;
use velour::scene::{Instance, Scene};

/// Rays of each kind.
const SIDE: usize = 128;

/// A triangle's box, for the hierarchy of two boxes a node.
struct Boxed(Aabb);

impl Boxed {
    fn new(triangle: &Triangle) -> Self {
        let [low, high] = triangle.bounds().map(|corner| Vec3A::from(corner.as_vec3()));
        Self(Aabb::new(low - 1e-5, high + 1e-5))
    }
}

impl Boundable for Boxed {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

fn triangles(scene: &Scene) -> Vec<Triangle> {
    let of_instance = |(index, instance): (usize, &Instance)| {
        let (mesh, world_from_mesh) = (&scene.meshes[instance.mesh], instance.world_from_mesh.as_dmat4());
        let place = |corner: u32| world_from_mesh.transform_point3(mesh.positions[corner as usize].as_dvec3());
        let triangles = mesh.indices.as_chunks::<3>().0.iter().zip(0..);
        triangles.map(|(corners, at)| Triangle::new(corners.map(place), index as u32, at)).collect::<Vec<_>>()
    };
    scene.instances.iter().enumerate().flat_map(of_instance).collect()
}

/// The camera's rays, and a random one from each place where they meet the scene.
fn rays(bvh: &Bvh<Triangle>) -> [Vec<Ray>; 2] {
    let origin = DVec3::new(0.6, 1.2, 2.4);
    let towards = |k: usize| {
        let at = [k % SIDE, k / SIDE].map(|at| at as f64 / SIDE as f64 - 0.5);
        Ray { origin, direction: (DVec3::new(at[0], 0.5 - at[1], 0.0) - origin).normalize() }
    };
    let camera: Vec<Ray> = (0..SIDE * SIDE).map(towards).collect();
    let mut rng = Pcg64::seed_from_u64(1);
    let met = camera.iter().filter_map(|ray| Some(ray.at(bvh.nearest(ray, [0.0, 1e9], |_| true)?.distance - 1e-6)));
    let scattered = met.map(|origin| Ray { origin, direction: unit_sphere(&mut rng) }).collect();
    [camera, scattered]
}

/// From where rays start to points of the scene's first light, with the distances to there.
fn to_light(scene: &Scene, rays: &[Ray]) -> Vec<(Ray, f64)> {
    let corners: Vec<DVec3> = scene.lights[0].polygons[0].contours[0].iter().map(|corner| corner.as_dvec3()).collect();
    let mut rng = Pcg64::seed_from_u64(2);
    let mut to_light = |ray: &Ray| {
        let [u, v] = [(); 2].map(|()| uniform(&mut rng));
        let way = corners[0] + u * (corners[1] - corners[0]) + v * (corners[3] - corners[0]) - ray.origin;
        (Ray { origin: ray.origin, direction: way.normalize() }, way.length())
    };
    rays.iter().map(&mut to_light).collect()
}

fn nearest_of_two(tree: &Bvh2, triangles: &[Triangle], ray: &Ray) -> f64 {
    let [origin, direction] = [ray.origin, ray.direction].map(|vector| Vec3A::from(vector.as_vec3()) + Vec3A::ZERO);
    let mut nearest = f64::INFINITY;
    tree.ray_traverse(obvhs::ray::Ray::new(origin, direction, 0.0, f32::INFINITY), &mut RayHit::none(), |_, index| {
        let triangle = &triangles[tree.primitive_indices[index] as usize];
        if let Some((distance, _)) = triangle.meet(ray).filter(|(distance, _)| (0.0..nearest).contains(distance)) {
            nearest = distance;
        }
        nearest as f32 * 1.000_01
    });
    nearest
}

fn bench(criterion: &mut Criterion) {
    let scene = DRAPE.load().expect("the asset is read");
    let triangles = triangles(&scene);
    let mut group = criterion.benchmark_group("bvh");
    group.sample_size(20);
    group.throughput(Throughput::Elements(triangles.len() as u64));
    group.bench_function("build", |bencher| bencher.iter(|| Bvh::new(black_box(triangles.clone()))));
    let two = || {
        let boxes: Vec<Boxed> = triangles.iter().map(Boxed::new).collect();
        build_bvh2(&boxes, BvhBuildParams::medium_build(), &mut Duration::default())
    };
    group.bench_function("build, two boxes a node", |bencher| bencher.iter(two));
    let (bvh, tree) = (Bvh::new(triangles.clone()), two());
    println!("bvh: {:.2} bytes of nodes a triangle", bvh.nodes().len() as f64 / triangles.len() as f64);
    let rays = rays(&bvh);
    let to_light = to_light(&scene, &rays[1]);
    let is_stopped =
        |(ray, far): &(Ray, f64)| bvh.visit(ray, [1e-4, 0.999 * far], |_| ControlFlow::Break(())).is_some();
    group.throughput(Throughput::Elements(to_light.len() as u64));
    let stopped = || to_light.iter().filter(|ray| is_stopped(ray)).count();
    println!("bvh: {} of {} rays to a light are stopped", stopped(), to_light.len());
    group.bench_function("to a light", |bencher| bencher.iter(stopped));
    for (name, rays) in ["camera", "scattered"].into_iter().zip(rays) {
        group.throughput(Throughput::Elements(rays.len() as u64));
        let nearest = |ray: &Ray| bvh.nearest(ray, [0.0, 1e9], |_| true).map_or(f64::INFINITY, |met| met.distance);
        for ray in &rays {
            assert_eq!(nearest(ray), nearest_of_two(&tree, &triangles, ray));
        }
        let sum = |value: &dyn Fn(&Ray) -> f64| rays.iter().map(value).sum::<f64>();
        group.bench_function(name, |bencher| bencher.iter(|| sum(&nearest)));
        let other = |ray: &Ray| nearest_of_two(&tree, &triangles, ray);
        group.bench_function(format!("{name}, two boxes a node"), |bencher| bencher.iter(|| sum(&other)));
    }
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
