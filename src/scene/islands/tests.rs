use std::f32::consts::FRAC_PI_2;
use std::time::{Duration, Instant};

use glam::{DVec3, Mat4, Vec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::*;

/// The islands of a mesh, placed.
fn islands(positions: &[Vec3], indices: &[u32], world_from_mesh: Mat4) -> Vec<Polygon> {
    let mesh = Mesh { positions: positions.to_vec(), indices: indices.to_vec(), ..Mesh::default() };
    let instance = Instance { name: String::new(), mesh: 0, world_from_mesh };
    Topology::new(&mesh).polygons(&mesh, &instance, 256).unwrap()
}

/// Twice the signed area along the normal, from the outline alone.
fn area(polygon: &Polygon) -> f64 {
    let edges = polygon.contours.iter().flat_map(|contour| {
        contour.iter().zip(contour.iter().cycle().skip(1)).map(|(from, to)| from.as_dvec3().cross(to.as_dvec3()))
    });
    0.5 * edges.sum::<DVec3>().dot(polygon.normal.as_dvec3())
}

fn corners(polygons: &[Polygon]) -> Vec<Vec<usize>> {
    polygons.iter().map(|polygon| polygon.contours.iter().map(Vec::len).collect()).collect()
}

/// Cells of a unit grid in the plane z = 0 as pairs of triangles without shared vertices, as exporters write flat faces.
fn cells(cells: impl IntoIterator<Item = (u32, u32)>) -> (Vec<Vec3>, Vec<u32>) {
    let mut positions = Vec::new();
    for (x, y) in cells {
        let corner = |dx, dy| Vec3::new((x + dx) as f32, (y + dy) as f32, 0.0);
        positions.extend([corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 0), corner(1, 1), corner(0, 1)]);
    }
    let indices = (0..positions.len() as u32).collect();
    (positions, indices)
}

fn grid(width: u32, height: u32) -> impl Iterator<Item = (u32, u32)> {
    (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)))
}

/// A strip of two unit cells along x whose far edge is lifted by `lift`.
fn bent(lift: f32) -> (Vec<Vec3>, Vec<u32>) {
    let (mut positions, indices) = cells(grid(2, 1));
    positions.iter_mut().filter(|position| position.x == 2.0).for_each(|position| position.z = lift);
    (positions, indices)
}

#[test]
fn a_divided_square_has_four_corners() {
    // Moved and turned, so that no coordinate is exact.
    let placed =
        Mat4::from_rotation_translation(glam::Quat::from_euler(glam::EulerRot::XYZ, 0.4, 1.1, -2.0), Vec3::splat(30.0));
    for placed in [Mat4::IDENTITY, placed] {
        let (positions, indices) = cells(grid(20, 13));
        let polygons = islands(&positions, &indices, placed);
        assert_eq!(corners(&polygons), [[4]]);
        assert!(polygons[0].normal.abs_diff_eq(placed.transform_vector3(Vec3::Z), 1e-6));
        // Positions are rounded to 4e-6 at a distance of 52.
        assert!((area(&polygons[0]) - 260.0).abs() < 1e-3, "{}", area(&polygons[0]));
    }
}

#[test]
fn a_box_is_six_lights_that_face_out() {
    let (face, _) = cells(grid(3, 3));
    let turns = [0.0, 1.0, 2.0, 3.0].map(|turn| Mat4::from_rotation_y(turn * FRAC_PI_2));
    let turns = turns.into_iter().chain([1.0, -1.0].map(|turn| Mat4::from_rotation_x(turn * FRAC_PI_2)));
    let positions: Vec<Vec3> = turns
        .flat_map(|turn| {
            face.iter().map(move |&p| turn.transform_point3(p - Vec3::new(1.5, 1.5, -1.5))).collect::<Vec<_>>()
        })
        .collect();
    let indices: Vec<u32> = (0..positions.len() as u32).collect();
    for (mirror, placed) in [(1.0, Mat4::IDENTITY), (-1.0, Mat4::from_scale(Vec3::new(-2.0, 1.0, 1.0)))] {
        let polygons = islands(&positions, &indices, placed);
        assert_eq!(corners(&polygons), [[4]; 6], "mirrored {mirror}");
        for polygon in &polygons {
            let middle: Vec3 = polygon.contours[0].iter().sum();
            assert!(polygon.normal.dot(middle) > 0.0 && area(polygon) > 0.0);
        }
    }
}

#[test]
fn outlines_may_be_concave_and_have_holes() {
    let (positions, indices) = cells(grid(3, 3).filter(|&(x, y)| x == 0 || y == 0));
    assert_eq!(corners(&islands(&positions, &indices, Mat4::IDENTITY)), [[6]]);
    let (positions, indices) = cells(grid(3, 3).filter(|&cell| cell != (1, 1)));
    let ring = islands(&positions, &indices, Mat4::IDENTITY);
    assert_eq!(corners(&ring), [[4, 4]]);
    assert_eq!(area(&ring[0]), 8.0);
    // The hole turns the other way: alone it takes area away.
    let hole = |contour: &Vec<Vec3>| Polygon { contours: vec![contour.clone()], normal: Vec3::Z };
    let mut areas: Vec<f64> = ring[0].contours.iter().map(|contour| area(&hole(contour))).collect();
    areas.sort_by(f64::total_cmp);
    assert_eq!(areas, [-1.0, 9.0]);
}

#[test]
fn what_bends_or_hangs_apart_is_two_polygons() {
    // Relative to the size of the strip, the square root of 5.
    let count = |relative: f32| {
        let (positions, indices) = bent(relative * 5f32.sqrt());
        islands(&positions, &indices, Mat4::IDENTITY).len()
    };
    assert_eq!([0.0, 5e-4, -5e-4, 5e-3, -5e-3, 0.5].map(count), [1, 1, 1, 2, 2, 2]);
    let (positions, indices) = cells([(0, 0), (2, 0), (3, 1)]);
    assert_eq!(corners(&islands(&positions, &indices, Mat4::IDENTITY)), [[4], [4], [4]]);
}

#[test]
fn uneven_parts_are_flat_within_the_tolerance() {
    let count = |relative: f32| {
        let (mut positions, indices) = cells(grid(100, 100));
        let mut random = Pcg64::seed_from_u64(4);
        // The same height for all vertices at a place.
        let heights: Vec<f32> = (0..101 * 101).map(|_| random.random_range(-1.0..1.0)).collect();
        for p in &mut positions {
            p.z = relative * 141.0 * heights[(p.x + 101.0 * p.y) as usize];
        }
        let mesh = Mesh { positions, indices, ..Mesh::default() };
        let instance = Instance { name: String::new(), mesh: 0, world_from_mesh: Mat4::IDENTITY };
        Topology::new(&mesh).polygons(&mesh, &instance, 256).map(|polygons| polygons.len())
    };
    assert_eq!([1e-5, 4e-4, 9e-4, 1.2e-3].map(count), [Some(1), Some(1), Some(1), None]);
}

#[test]
fn faces_back_to_back_light_both_ways() {
    let (positions, indices) = cells(grid(2, 2));
    let back = indices.chunks_exact(3).flat_map(|triangle| [triangle[0], triangle[2], triangle[1]]);
    let indices: Vec<u32> = indices.iter().copied().chain(back).collect();
    let polygons = islands(&positions, &indices, Mat4::IDENTITY);
    assert_eq!(corners(&polygons), [[4], [4]]);
    assert_eq!([polygons[0].normal, polygons[1].normal], [Vec3::Z, -Vec3::Z]);
}

#[test]
fn nearly_equal_positions_are_welded() {
    let (mut positions, indices) = cells(grid(4, 4));
    let mut random = Pcg64::seed_from_u64(1);
    // A tenth of the tolerance, that is of 1e-6 of the diagonal.
    positions.iter_mut().for_each(|position| *position += 5e-7 * Vec3::from_array(random.random()));
    assert_eq!(corners(&islands(&positions, &indices, Mat4::IDENTITY)), [[4]]);
}

#[test]
fn islands_have_the_area_of_their_triangles() {
    let mut random = Pcg64::seed_from_u64(2);
    for round in 0..200 {
        let kept: Vec<(u32, u32)> = grid(9, 7).filter(|_| random.random_bool(0.6)).collect();
        let (mut positions, indices) = cells(kept.iter().copied());
        // Every second one on a roof of three planes.
        if round % 2 == 1 {
            positions.iter_mut().for_each(|p| p.z = (p.x - 3.0).max(0.0) + 0.5 * (p.y - 4.0).max(0.0));
        }
        let triangles = positions.chunks_exact(3).map(|t| (t[1] - t[0]).cross(t[2] - t[0]).length() / 2.0);
        let expected = f64::from(triangles.sum::<f32>());
        let polygons = islands(&positions, &indices, Mat4::IDENTITY);
        let found: f64 = polygons.iter().map(area).sum();
        // Sums of f32 areas of about 1.
        assert!((found - expected).abs() < 1e-4, "round {round}: {found} for {expected}");
        let tallest = polygons.iter().flat_map(|p| &p.contours).map(Vec::len).max();
        assert!(tallest > Some(4), "round {round} tests nothing");
    }
}

#[test]
fn the_limit_counts_islands() {
    let (positions, indices) = cells((0..10).map(|x| (2 * x, 0)));
    let mesh = Mesh { positions, indices, ..Mesh::default() };
    let instance = Instance { name: String::new(), mesh: 0, world_from_mesh: Mat4::IDENTITY };
    let count = |limit| Topology::new(&mesh).polygons(&mesh, &instance, limit).map(|polygons| polygons.len());
    assert_eq!([9, 10, 11].map(count), [None, Some(10), Some(10)]);
}

#[test]
fn thin_triangles_and_crowded_edges_are_survived() {
    // A million triangles on one edge, half of them without an area.
    let rim = (0..500_000).map(|i| Vec3::new(0.5, (i as f32 * 1e-3).cos(), (i as f32 * 1e-3).sin()));
    let positions: Vec<Vec3> = [Vec3::ZERO, Vec3::X, 0.5 * Vec3::X].into_iter().chain(rim).collect();
    let indices = (3..positions.len() as u32).flat_map(|rim| [0, 1, rim, 0, 1, 2]).collect();
    let mesh = Mesh { positions, indices, ..Mesh::default() };
    let instance = Instance { name: String::new(), mesh: 0, world_from_mesh: Mat4::IDENTITY };
    assert!(Topology::new(&mesh).polygons(&mesh, &instance, 256).is_none());
}

#[test]
fn a_million_triangles_take_seconds() {
    let side = 708;
    let vertex = |index: u32| Vec3::new((index % (side + 1)) as f32, (index / (side + 1)) as f32, 0.0);
    let positions: Vec<Vec3> = (0..(side + 1) * (side + 1)).map(vertex).collect();
    let corner = |x: u32, y: u32| y * (side + 1) + x;
    let cell =
        |(x, y)| [(x, y), (x + 1, y), (x + 1, y + 1), (x, y), (x + 1, y + 1), (x, y + 1)].map(|(x, y)| corner(x, y));
    let indices: Vec<u32> = grid(side, side).flat_map(cell).collect();
    let start = Instant::now();
    assert_eq!(corners(&islands(&positions, &indices, Mat4::from_rotation_x(0.3))), [[4]]);
    // Two seconds on one old core: what this bound catches is a square of the number of triangles.
    assert!(start.elapsed() < Duration::from_secs(30), "{:?}", start.elapsed());
    println!("{:?}", start.elapsed());
}
