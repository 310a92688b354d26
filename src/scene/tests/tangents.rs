//! Tangents where a file has none.

use std::time::{Duration, Instant};

use glam::{Affine2, Vec2, Vec3, Vec4};

use super::shapes::{grid, sphere};
use crate::scene::{Mesh, tangents};

/// A mesh with texture coordinates by position, and tangents.
fn mapped(mut mesh: Mesh, coords: impl Fn(Vec3) -> Vec2) -> Mesh {
    mesh.tex_coords[1] = mesh.positions.iter().map(|&position| coords(position)).collect();
    mesh.colors = (0..mesh.positions.len()).map(|at| [at as u16; 4]).collect();
    tangents::compute(&mut mesh, 1, Affine2::IDENTITY);
    check(&mesh);
    mesh
}

fn check(mesh: &Mesh) {
    let count = mesh.positions.len();
    assert_eq!((mesh.normals.len(), mesh.tangents.len()), (count, count));
    assert_eq!((mesh.tex_coords[0].len(), mesh.tex_coords[1].len(), mesh.colors.len()), (0, count, count));
    for (tangent, normal) in mesh.tangents.iter().zip(&mesh.normals) {
        assert!(tangent.w.abs() == 1.0 && tangent.truncate().is_normalized(), "{tangent}");
        assert!(tangent.truncate().dot(*normal).abs() < 1e-6);
    }
}

fn square(n: u32) -> Mesh {
    grid(n, |_, _| true, |_, _| 0.0)
}

#[test]
fn a_transform_turns_the_tangents_as_turned_coordinates_do() {
    let transform = Affine2::from_scale_angle_translation(Vec2::new(-2.0, 1.0), 0.7, Vec2::new(0.3, 0.1));
    let own = |at: Vec3| Vec2::new(at.x, 1.0 - at.y);
    let mut transformed = square(3);
    transformed.tex_coords[1] = transformed.positions.iter().map(|&at| own(at)).collect();
    tangents::compute(&mut transformed, 1, transform);
    let turned = mapped(square(3), |at| transform.transform_point2(own(at)));
    for (found, expected) in transformed.tangents.iter().zip(&turned.tangents) {
        assert!(found.abs_diff_eq(*expected, 1e-6), "{found} {expected}");
        assert!(!found.abs_diff_eq(Vec4::new(1.0, 0.0, 0.0, 1.0), 0.1));
    }
}

#[test]
fn an_upright_picture_has_its_right_for_tangent_and_its_top_for_bitangent() {
    // v runs down in the image.
    let upright = mapped(square(3), |at| Vec2::new(at.x, 1.0 - at.y));
    assert_eq!(upright.tangents, [Vec4::new(1.0, 0.0, 0.0, 1.0); 16]);
    let mirrored = mapped(square(3), |at| Vec2::new(-at.x, 1.0 - at.y));
    assert_eq!(mirrored.tangents, [Vec4::new(-1.0, 0.0, 0.0, -1.0); 16]);
    let turned = mapped(square(3), |at| Vec2::new(at.y, at.x));
    assert_eq!(turned.tangents, [Vec4::new(0.0, 1.0, 0.0, 1.0); 16]);
}

#[test]
fn vertices_on_a_mirrored_seam_are_split() {
    let mesh = mapped(square(4), |at| Vec2::new((at.x - 0.5).abs(), 1.0 - at.y));
    assert_eq!(mesh.positions.len(), 25 + 5);
    for triangle in mesh.indices.as_chunks::<3>().0 {
        let side = triangle.map(|vertex| mesh.positions[vertex as usize].x).iter().sum::<f32>() - 1.5;
        for &vertex in triangle {
            assert_eq!(mesh.tangents[vertex as usize], Vec4::new(side.signum(), 0.0, 0.0, side.signum()));
        }
    }
    // What is split off keeps all that it had.
    let originals = square(4).positions;
    for (position, color) in mesh.positions.iter().zip(&mesh.colors) {
        assert_eq!(*position, originals[usize::from(color[0])]);
    }
}

#[test]
fn coordinates_that_give_no_direction_give_any() {
    for coords in [|_: Vec3| Vec2::ZERO, |at: Vec3| Vec2::splat(at.x), |at: Vec3| Vec2::new(1e38 * at.x, -3e38 * at.y)]
    {
        let mesh = mapped(square(3), coords);
        assert!(mesh.tangents.iter().all(|tangent| tangent.is_finite()));
    }
    let mut bare = square(3);
    tangents::compute(&mut bare, 0, Affine2::IDENTITY);
    assert_eq!(bare.tangents.len(), 16);
}

#[test]
fn a_sphere_has_its_parallels_for_tangents() {
    let mut mesh = sphere(40);
    mesh.tex_coords[1] = square(40).positions.iter().map(|at| Vec2::new(at.x, 1.0 - at.y)).collect();
    mesh.colors = vec![[0; 4]; mesh.positions.len()];
    tangents::compute(&mut mesh, 1, Affine2::IDENTITY);
    check(&mesh);
    for (tangent, normal) in mesh.tangents.iter().zip(&mesh.normals).filter(|(_, normal)| normal.z.abs() < 0.9) {
        let east = Vec3::Z.cross(*normal).normalize();
        assert!(tangent.truncate().dot(east) > 0.99 && tangent.w == 1.0, "{tangent} {east}");
    }
}

#[test]
fn a_files_tangents_near_the_normal_are_taken_as_far_as_they_are_perpendicular() {
    for (tangent, is_whole) in [(Vec3::new(0.01, 0.0, 1.0), true), (Vec3::Z, false), (Vec3::ZERO, false)] {
        let mut mesh = square(1);
        let own = [Vec4::X, tangent.extend(-1.0), Vec4::Y, Vec4::NEG_X];
        assert_eq!(tangents::adopt(&mut mesh, &own), is_whole, "{tangent}");
        let expected =
            [Vec4::X.with_w(1.0), Vec4::new(1.0, 0.0, 0.0, -1.0), Vec4::Y.with_w(1.0), Vec4::NEG_X.with_w(1.0)];
        assert_eq!(mesh.tangents, if is_whole { &expected[..] } else { &[] }, "{tangent}");
    }
}

#[test]
fn hubs_of_very_many_triangles_take_no_time_and_no_stack() {
    const RIM: u32 = 300_000;
    let mut mesh = Mesh { positions: vec![Vec3::ZERO], ..Mesh::default() };
    let rim = |at: u32| Vec2::from_angle(std::f32::consts::TAU * at as f32 / RIM as f32).extend(0.0);
    mesh.positions.extend((0..RIM).map(rim));
    mesh.indices.extend((0..RIM).flat_map(|at| [0, 1 + at, 1 + (at + 1) % RIM]));
    mesh.normals = vec![Vec3::Z; mesh.positions.len()];
    let start = Instant::now();
    let mesh = mapped(mesh, |at| Vec2::new(at.x, -at.y));
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
    assert!(mesh.tangents.iter().all(|tangent| tangent.distance(Vec4::new(1.0, 0.0, 0.0, 1.0)) < 0.02));
    // A million triangles on one edge, in both directions.
    let mut book = square(1);
    book.indices = [[0, 1, 2], [1, 0, 3]].concat().repeat(500_000);
    mapped(book, |at| Vec2::new(at.x, at.y * at.y));
}

#[test]
fn blocks_have_no_seams_where_a_map_is_even() {
    // More triangles than are worked on together.
    let mesh = mapped(square(200), |at| Vec2::new(at.x, 1.0 - at.y));
    assert!(mesh.indices.len() / 3 > 1 << 16);
    assert!(mesh.tangents.iter().all(|tangent| tangent.distance(Vec4::new(1.0, 0.0, 0.0, 1.0)) < 1e-4));
}
