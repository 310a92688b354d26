//! Emitters of many flat parts that are merged into fewer.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, Mat4, Vec3};

use super::shapes::{area, grid, scene, sphere};
use crate::scene::{Mesh, Polygon, clusters, islands};

fn merged(mesh: &Mesh, limit: usize) -> Vec<Polygon> {
    let scene = scene(mesh.clone(), Mat4::IDENTITY);
    clusters::polygons(&islands::Topology::new(mesh).placed(mesh, &scene.instances[0]), limit)
}

/// The area of a mesh's triangles.
fn whole(mesh: &Mesh) -> f64 {
    let area = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|corner| mesh.positions[corner as usize].as_dvec3());
        0.5 * (b - a).cross(c - a).length()
    };
    mesh.indices.as_chunks::<3>().0.iter().map(area).sum()
}

/// From afar a sphere of radius 1 is a disk of area pi from everywhere, and parts are what they project to.
#[test]
fn a_sphere_of_few_parts_shines_alike_in_all_directions() {
    for (n, limit, most) in [(23, 512, 0.007), (64, 256, 0.0035), (64, 128, 0.008), (64, 64, 0.022), (64, 16, 0.12)] {
        let mesh = sphere(n);
        let polygons = merged(&mesh, limit);
        assert_eq!(polygons.len(), limit);
        let corners: usize = polygons.iter().flat_map(|polygon| &polygon.contours).map(Vec::len).sum();
        assert!(corners < 7 * limit, "{n} {limit}: {corners}");
        // The radiant power is kept.
        let found: f64 = polygons.iter().map(area).sum();
        assert!((found / whole(&mesh) - 1.0).abs() < 1e-5, "{n} {limit}: {found}");
        for step in 0..500 {
            let z = 1.0 - (2.0 * f64::from(step) + 1.0) / 500.0;
            let (sine, cosine) = (TAU * 0.618_034 * f64::from(step)).sin_cos();
            let direction = DVec3::new((1.0 - z * z).sqrt() * cosine, (1.0 - z * z).sqrt() * sine, z);
            let facing = |polygon: &Polygon| area(polygon) * polygon.normal.as_dvec3().dot(direction).max(0.0);
            let seen = polygons.iter().map(facing).sum::<f64>() / PI;
            // Of the sphere's own facets.
            let expected = whole(&mesh) / (4.0 * PI);
            assert!((seen / expected - 1.0).abs() < most, "{n} {limit} {direction}: {seen} {expected}");
        }
    }
}

/// Whatever lies in one plane is one part at no loss, and what does not touch is never joined.
#[test]
fn flat_parts_stay_what_they_are() {
    let mesh = grid(12, |i, j| i % 3 != 2 && j % 3 != 2, |_, _| 0.5);
    let mut areas: Vec<f64> = merged(&mesh, 1).iter().map(area).collect();
    areas.sort_by(f64::total_cmp);
    assert_eq!(areas.len(), 16);
    assert!(areas.iter().all(|area| (area - 4.0 / 144.0).abs() < 1e-6), "{areas:?}");
    // A roof: both sides face too far apart.
    let roof = grid(2, |_, _| true, |x, _| 2.0 * (0.5 - (x - 0.5).abs()));
    assert_eq!(merged(&roof, 1).len(), 2);
}

/// Every part of a bumpy disk stays near it, and what its parts send straight up is what the disk does.
#[test]
fn a_curved_sheet_keeps_its_power_and_its_place() {
    let bump = |x: f32, y: f32| 0.05 * (7.0 * x).sin() * (5.0 * y).cos();
    let mesh = grid(60, |i, j| (f64::from(i) - 29.5).hypot(f64::from(j) - 29.5) < 29.0, bump);
    let polygons = merged(&mesh, 100);
    assert_eq!(polygons.len(), 100);
    let found: f64 = polygons.iter().map(area).sum();
    assert!((found / whole(&mesh) - 1.0).abs() < 1e-5, "{found}");
    let flat = mesh.indices.len() as f64 / 6.0 / 3600.0;
    let up: f64 = polygons.iter().map(|polygon| area(polygon) * f64::from(polygon.normal.z)).sum();
    assert!((up / flat - 1.0).abs() < 0.02, "{up} {flat}");
    for vertex in polygons.iter().flat_map(|polygon| &polygon.contours).flatten() {
        let height = vertex.z - bump(vertex.x, vertex.y);
        assert!(height.abs() < 0.03 && vertex.abs_diff_eq(Vec3::splat(0.5), 0.6), "{vertex}");
    }
}
