//! What overlaps in one plane shines once.

use glam::{Mat3, Mat4, Quat, Vec2, Vec3};

use super::shapes::{area, grid, scene};
use crate::scene::notices::Notices;
use crate::scene::{Instance, Light, Scene, lights};

/// Unit squares that glow, the first at the origin, placed by transforms; each is of its own material, two-sided or not.
fn squares(places: &[(Mat4, bool)]) -> Scene {
    let mut squares = scene(grid(1, |_, _| true, |_, _| 0.0), Mat4::IDENTITY);
    let (mesh, material) = (squares.meshes[0].clone(), squares.materials[0].clone());
    (squares.meshes, squares.materials, squares.instances) = Default::default();
    for (index, &(world_from_mesh, double_sided)) in places.iter().enumerate() {
        let emission = Vec3::splat(1.0 + index as f32);
        squares.materials.push(crate::scene::Material { emission, double_sided, ..material.clone() });
        squares.meshes.push(crate::scene::Mesh { material: index, ..mesh.clone() });
        squares.instances.push(Instance { name: index.to_string(), mesh: index, world_from_mesh });
    }
    lights::add_lights(&mut squares, 0, &mut Notices::default());
    squares
}

/// Each light's name and its area.
fn areas(scene: &Scene) -> Vec<(&str, f64)> {
    let area = |light: &Light| light.polygons.iter().map(area).sum();
    scene.lights.iter().map(|light| (light.name.as_str(), area(light))).collect()
}

fn assert_areas(scene: &Scene, expected: &[(&str, f64)]) {
    let found = areas(scene);
    let agrees = |(left, right): (&(&str, f64), &(&str, f64))| left.0 == right.0 && (left.1 - right.1).abs() < 1e-5;
    assert!(found.len() == expected.len() && found.iter().zip(expected).all(agrees), "{found:?} {expected:?}");
}

fn moved(x: f32, y: f32) -> Mat4 {
    Mat4::from_translation(Vec3::new(x, y, 0.0))
}

/// In any place, turned anyhow, large and small.
fn places() -> [Mat4; 4] {
    let turned = Mat4::from_quat(Quat::from_euler(glam::EulerRot::XYZ, 0.4, 1.1, -2.0));
    [
        Mat4::IDENTITY,
        turned,
        Mat4::from_translation(Vec3::new(300.0, -20.0, 55.0)) * turned,
        turned * Mat4::from_mat3(Mat3::from_diagonal(Vec3::splat(100.0))),
    ]
}

#[test]
fn the_first_keeps_what_two_share() {
    for place in places() {
        let unit = place.x_axis.truncate().length_squared();
        let scene = squares(&[(place, false), (place * moved(0.5, 0.0), false)]);
        let scaled: Vec<(&str, f64)> =
            areas(&scene).into_iter().map(|(name, area)| (name, area / f64::from(unit))).collect();
        assert!((scaled[0].1 - 1.0).abs() < 1e-4 && (scaled[1].1 - 0.5).abs() < 1e-4, "{place} {scaled:?}");
        // The corners that are left are those that there were, to the bit.
        let corner = (place * moved(0.5, 0.0)).transform_point3(Vec3::new(1.0, 1.0, 0.0));
        let contours = &scene.lights[1].polygons[0].contours;
        assert!(contours.iter().flatten().any(|vertex| vertex.distance(corner) <= 1e-6 * corner.length()), "{place}");
    }
}

#[test]
fn a_hole_is_left_where_a_small_one_lies_within_a_large_one() {
    let small = moved(0.25, 0.25) * Mat4::from_scale(Vec3::splat(0.5));
    let scene = squares(&[(small, false), (Mat4::IDENTITY, false)]);
    assert_areas(&scene, &[("0", 0.25), ("1", 0.75)]);
    assert_eq!(scene.lights[1].polygons[0].contours.len(), 2);
    // The other way round nothing is left of the small one, and its emitter goes with the large one.
    let scene = squares(&[(Mat4::IDENTITY, false), (small, false)]);
    assert_areas(&scene, &[("0", 1.0)]);
    assert_eq!(scene.lights[0].emitters().collect::<Vec<usize>>(), [0, 1]);
    let drawn = crate::scene::Drawn::new(&scene, &crate::scene::Edits::default());
    assert_eq!([0, 1].map(|instance| drawn.emission(instance)), [Vec3::ONE; 2]);
}

#[test]
fn what_shines_elsewhere_or_apart_is_left_alone() {
    let turned = Mat4::from_quat(Quat::from_rotation_y(std::f32::consts::PI));
    let tilted = Mat4::from_quat(Quat::from_rotation_x(0.01));
    for other in [
        moved(1.0, 0.0),
        moved(0.0, -1.0),
        moved(1.0, 0.0) * turned,
        Mat4::from_translation(Vec3::new(0.0, 0.0, 1e-3)),
        Mat4::from_translation(Vec3::new(0.0, 0.0, -1e-3)),
        tilted,
    ] {
        let scene = squares(&[(Mat4::IDENTITY, false), (other, false)]);
        assert_areas(&scene, &[("0", 1.0), ("1", 1.0)]);
        assert!(scene.lights.iter().all(|light| light.polygons[0].contours[0].len() == 4));
    }
}

#[test]
fn what_shines_to_both_sides_takes_both() {
    let turned = moved(1.0, 0.0) * Mat4::from_quat(Quat::from_rotation_y(std::f32::consts::PI));
    assert_areas(&squares(&[(moved(0.5, 0.0), false), (Mat4::IDENTITY, true)]), &[("0", 0.5), ("1", 1.0)]);
    assert_areas(&squares(&[(Mat4::IDENTITY, true), (turned, false)]), &[("0", 1.0)]);
    assert_areas(&squares(&[(Mat4::IDENTITY, true), (moved(0.25, 0.0), true)]), &[("0", 1.0), ("1", 0.25)]);
}

/// A square twice in one mesh, once along each diagonal: its triangles overlap by halves.
#[test]
fn doubled_faces_of_one_mesh_shine_once() {
    let mut doubled = scene(grid(1, |_, _| true, |_, _| 0.0), Mat4::IDENTITY);
    let mesh = &mut doubled.meshes[0];
    let [a, b, c, d] = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y]
        .map(|corner| mesh.positions.iter().position(|position| position.truncate() == corner).unwrap() as u32);
    mesh.indices.extend([a, b, d, b, c, d]);
    doubled.materials[0].emission = Vec3::ONE;
    lights::add_lights(&mut doubled, 0, &mut Notices::default());
    assert!((areas(&doubled)[0].1 - 1.0).abs() < 1e-6, "{:?}", areas(&doubled));
}
