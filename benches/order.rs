//! The time to sort 100,000 blended triangles for a view: a ball of glass, of which each ray meets two; a crown of
//! leaves, of which each ray meets a few or dozens; and a sheet in which none overlap.

use std::f32::consts::TAU;
use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::{Mat4, Quat, Vec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use velour::renderer::paint_order::{PaintOrder, PlacedMesh};
use velour::renderer::{Rect, View};
use velour::scene::{Camera, Projection};

/// Triangles of each scene, or nearly so many.
const TRIANGLES: u32 = 100_000;

struct Solid {
    positions: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

/// A surface over a square of cells, two triangles each.
fn surface(columns: u32, rows: u32, at: impl Fn(f32, f32) -> Vec3) -> Solid {
    let corners = (0..=rows).flat_map(|row| (0..=columns).map(move |column| [column, row]));
    let positions = corners.map(|[column, row]| at(column as f32 / columns as f32, row as f32 / rows as f32)).collect();
    let cell = |row: u32, column: u32| {
        let [a, b] = [row, row + 1].map(|row| row * (columns + 1) + column);
        [[a, b, a + 1], [a + 1, b, b + 1]]
    };
    Solid { positions, triangles: (0..rows).flat_map(|row| (0..columns).flat_map(move |at| cell(row, at))).collect() }
}

fn ball() -> Solid {
    let side = (TRIANGLES / 4).isqrt();
    surface(2 * side, side, |u, v| {
        let (azimuth, polar) = (TAU * u, 0.5 * TAU * v);
        Vec3::new(polar.sin() * azimuth.cos(), polar.cos(), polar.sin() * azimuth.sin())
    })
}

fn sheet() -> Solid {
    let side = (TRIANGLES / 2).isqrt();
    surface(side, side, |u, v| Vec3::new(2.0 * u - 1.0, -0.3, 2.0 * v - 1.0))
}

/// Square leaves of this half side, turned any way, in a ball of radius 1.
fn leaves(half: f32) -> Solid {
    let mut rng = Pcg64::seed_from_u64(1);
    let mut solid = Solid { positions: Vec::new(), triangles: Vec::new() };
    while solid.triangles.len() < TRIANGLES as usize {
        let [x, y, z, yaw, pitch] = [(); 5].map(|()| rng.random_range(-1.0_f32..1.0));
        let (center, turned) = (Vec3::new(x, y, z), Quat::from_euler(glam::EulerRot::YXZ, TAU * yaw, TAU * pitch, x));
        if center.length() > 1.0 {
            continue;
        }
        let first = solid.positions.len() as u32;
        let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
        solid.positions.extend(corners.map(|[x, y]| center + turned * Vec3::new(x, y, 0.0)));
        solid.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|triangle| triangle.map(|corner| first + corner)));
    }
    solid
}

fn bench(criterion: &mut Criterion) {
    let world_from_camera = Mat4::from_translation(3.5 * Vec3::Z);
    let projection = Projection::Perspective { yfov: 0.7, near: 0.01, far: f32::INFINITY };
    let camera = Camera { name: String::new(), world_from_camera, projection };
    let view = View::new(&camera, [1280, 720], Rect::full([1280, 720]));
    let mut group = criterion.benchmark_group("order");
    group.sample_size(10);
    for (name, solid) in [
        ("ball", ball()),
        ("sheet", sheet()),
        ("leaves, 3 deep", leaves(0.01)),
        ("leaves, 10 deep", leaves(0.018)),
        ("leaves, 50 deep: too many", leaves(0.04)),
    ] {
        let Solid { positions, triangles } = &solid;
        let mesh = PlacedMesh { positions, triangles, world_from_mesh: Mat4::IDENTITY, double_sided: true };
        let order = || PaintOrder::new(black_box(&[mesh]), &view);
        assert_eq!(order().is_exact, !name.ends_with("too many"), "{name}");
        group.throughput(Throughput::Elements(triangles.len() as u64));
        group.bench_function(name, |bencher| bencher.iter(order));
    }
    group.finish();
}

criterion_group!(benches, bench);
criterion_main!(benches);
