//! Planar islands and their outlines.

use std::time::{Duration, Instant};

use glam::{Mat3, Mat4, Quat, Vec2, Vec3};
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;

use super::shapes::{area, cube, grid, scene, sphere};
use crate::scene::islands::Topology;
use crate::scene::notices::Notices;
use crate::scene::{Instance, Mesh, Polygon, lights};

const FLAT: fn(f32, f32) -> f32 = |_, _| 0.0;
const ALL: fn(u32, u32) -> bool = |_, _| true;

fn polygons_at(mesh: &Mesh, world_from_mesh: Mat4) -> Vec<Polygon> {
    let instance = Instance { name: String::new(), mesh: 0, world_from_mesh };
    let islands = Topology::new(mesh).islands(mesh, &instance, 256).expect("too many islands");
    islands.into_iter().map(|island| island.polygon).collect()
}

fn polygons(mesh: &Mesh) -> Vec<Polygon> {
    polygons_at(mesh, Mat4::IDENTITY)
}

/// The corners of each polygon of one contour.
fn corners(polygons: &[Polygon]) -> Vec<usize> {
    polygons.iter().flat_map(|polygon| &polygon.contours).map(Vec::len).collect()
}

/// Any place: turned, stretched and far from the origin.
fn somewhere() -> Mat4 {
    let rotation = Quat::from_axis_angle(Vec3::new(1.0, -2.0, 0.5).normalize(), 1.1);
    Mat4::from_scale_rotation_translation(Vec3::new(0.7, 1.9, 1.3), rotation, Vec3::new(-40.0, 9.0, 77.0))
}

#[test]
fn a_divided_square_is_one_polygon_of_four_corners() {
    for n in [1, 2, 7, 64] {
        let mesh = grid(n, ALL, FLAT);
        assert_eq!(corners(&polygons(&mesh)), [4]);
        assert_eq!(corners(&polygons_at(&mesh, somewhere())), [4]);
        assert_eq!(polygons(&mesh)[0].normal, Vec3::Z);
    }
}

#[test]
fn a_square_whose_triangles_share_no_vertices_is_one_polygon() {
    let mut mesh = grid(5, ALL, FLAT);
    mesh.positions = mesh.indices.iter().map(|&index| mesh.positions[index as usize]).collect();
    mesh.indices = (0..mesh.positions.len() as u32).collect();
    // What rounding leaves of equal positions is not equal to the bit.
    let mut random = Pcg32::seed_from_u64(4);
    mesh.positions.iter_mut().for_each(|position| position.x += 1e-7 * random.random::<f32>());
    assert_eq!(corners(&polygons(&mesh)), [4]);
}

#[test]
fn a_box_is_six_polygons_that_face_outwards() {
    for world_from_mesh in [Mat4::IDENTITY, somewhere()] {
        let polygons = polygons_at(&cube(), world_from_mesh);
        assert_eq!(corners(&polygons), [4; 6]);
        let center = world_from_mesh.transform_point3(Vec3::ZERO);
        for polygon in &polygons {
            assert!(polygon.normal.dot(polygon.contours[0][0] - center) > 0.0);
            assert!(area(polygon) > 0.0);
        }
    }
}

#[test]
fn a_concave_shape_keeps_its_corners() {
    let polygons = polygons(&grid(4, |i, j| i < 2 || j < 2, FLAT));
    assert_eq!(corners(&polygons), [6]);
    assert!((area(&polygons[0]) - 0.75).abs() < 1e-7);
}

#[test]
fn a_hole_is_a_contour_wound_the_other_way() {
    let polygons = polygons(&grid(4, |i, j| !((1..3).contains(&i) && (1..3).contains(&j)), FLAT));
    assert_eq!(corners(&polygons), [4, 4]);
    let mut areas: Vec<f64> = polygons[0]
        .contours
        .iter()
        .map(|contour| area(&Polygon { contours: vec![contour.clone()], normal: polygons[0].normal, pattern: None }))
        .collect();
    areas.sort_by(f64::total_cmp);
    assert!((areas[0] + 0.25).abs() < 1e-7 && (areas[1] - 1.0).abs() < 1e-7, "{areas:?}");
}

#[test]
fn outlines_enclose_the_area_of_their_triangles() {
    let mut random = Pcg32::seed_from_u64(5);
    for _ in 0..200 {
        let kept: Vec<bool> = (0..64).map(|_| random.random_bool(0.6)).collect();
        let mesh = grid(8, |i, j| kept[(8 * j + i) as usize], FLAT);
        let polygons = polygons_at(&mesh, somewhere());
        let count = kept.iter().filter(|kept| **kept).count();
        let square =
            (somewhere().x_axis.as_dvec4().truncate()).cross(somewhere().y_axis.as_dvec4().truncate()).length() / 64.0;
        // Corners at 100 m are rounded to 8e-6 m, squares are 0.13 m wide and have up to 100 boundary edges.
        let sum: f64 = polygons.iter().map(area).sum();
        assert!((sum - square * count as f64).abs() < 1e-4, "{sum} {}", square * count as f64);
        for polygon in &polygons {
            for contour in &polygon.contours {
                let start = contour[0];
                assert!(contour.iter().all(|corner| (corner - start).dot(polygon.normal).abs() < 1e-4));
            }
        }
    }
}

#[test]
fn a_mirrored_light_shines_from_the_face_that_is_drawn() {
    let square = grid(2, ALL, FLAT);
    let cases = [
        (Vec3::new(-1.0, 1.0, 1.0), Vec3::Z),
        (Vec3::new(1.0, 1.0, -1.0), Vec3::NEG_Z),
        (Vec3::new(-1.0, -1.0, -1.0), Vec3::NEG_Z),
        (Vec3::new(-1.0, -1.0, 1.0), Vec3::Z),
    ];
    for (scale, normal) in cases {
        let polygons = polygons_at(&square, Mat4::from_scale(scale));
        assert_eq!(polygons[0].normal, normal);
        assert!((area(&polygons[0]) - 1.0).abs() < 1e-7);
        // The side that the mesh's normals, taken to the world, are on.
        let instance = Instance { name: String::new(), mesh: 0, world_from_mesh: Mat4::from_scale(scale) };
        assert!((instance.world_from_normal() * Vec3::Z).dot(normal) > 0.0);
    }
}

#[test]
fn squares_at_an_angle_are_two_polygons() {
    for degrees in [4.0f32, 30.0, 90.0, 150.0] {
        let slope = degrees.to_radians();
        let mut mesh = grid(2, ALL, FLAT);
        for position in mesh.positions.iter_mut().filter(|position| position.x > 0.5) {
            *position = Vec3::new(0.5 + 0.5 * slope.cos(), position.y, 0.5 * slope.sin());
        }
        let polygons = polygons(&mesh);
        assert_eq!(corners(&polygons), [4, 4], "{degrees}");
        assert!((polygons[0].normal.dot(polygons[1].normal) - slope.cos()).abs() < 1e-6);
    }
}

#[test]
fn squares_that_do_not_touch_are_two_polygons() {
    assert_eq!(corners(&polygons(&grid(5, |i, _| i != 2, FLAT))), [4, 4]);
    // Nor are those that touch in a corner one.
    assert_eq!(corners(&polygons(&grid(2, |i, j| i == j, FLAT))), [4, 4]);
}

#[test]
fn a_slight_bend_is_flat_and_a_larger_one_is_not() {
    // The size is the diagonal, 1.41 of the side; the bend is how far the middle is off the ends' plane.
    for (bend, count) in [(5e-4, 1), (5e-3, 2)] {
        let mesh = grid(2, ALL, |x, _| if x == 0.5 { bend * 2f32.sqrt() } else { 0.0 });
        let polygons = polygons(&mesh);
        assert_eq!(polygons.len(), count, "{bend}");
        let sum: f64 = polygons.iter().map(area).sum();
        assert!((sum - 1.0).abs() < 1e-3);
    }
}

#[test]
fn noise_within_the_tolerance_is_flat_however_steep() {
    let mut random = Pcg32::seed_from_u64(6);
    let mut mesh = grid(200, ALL, FLAT);
    mesh.positions.iter_mut().for_each(|position| position.z = 5e-4 * random.random::<f32>());
    // Neighbouring faces are up to 15 degrees apart. The outline follows the noise.
    assert_eq!(polygons(&mesh).len(), 1);
}

#[test]
fn thin_triangles_neither_light_nor_part_what_does() {
    let mut mesh = grid(1, ALL, FLAT);
    let first = mesh.positions.len() as u32;
    mesh.positions.extend([Vec3::new(3.0, 0.0, 0.0), Vec3::new(4.0, 0.0, 0.0), Vec3::new(3.5, 1e-8, 0.0)]);
    mesh.indices.splice(0..0, [first, first + 1, first + 2, first, first, first, 0, 1, 1]);
    assert_eq!(corners(&polygons(&mesh)), [4]);
}

#[test]
fn the_order_of_triangles_does_not_matter() {
    let mut random = Pcg32::seed_from_u64(7);
    let mut mesh = grid(6, |i, j| (i + 2 * j) % 5 != 0, FLAT);
    let key = |polygons: Vec<Polygon>| {
        let mut contours: Vec<Vec<[i32; 3]>> = polygons
            .iter()
            .flat_map(|polygon| &polygon.contours)
            .map(|contour| {
                let mut contour: Vec<[i32; 3]> =
                    contour.iter().map(|corner| (corner * 600.0).round().as_ivec3().to_array()).collect();
                let least = (0..contour.len()).min_by_key(|&at| contour[at]).unwrap();
                contour.rotate_left(least);
                contour
            })
            .collect();
        contours.sort();
        contours
    };
    let expected = key(polygons(&mesh));
    for _ in 0..20 {
        mesh.indices.as_chunks_mut::<3>().0.shuffle(&mut random);
        assert_eq!(key(polygons(&mesh)), expected);
    }
}

#[test]
fn scenes_of_any_size_have_the_same_islands() {
    for scale in [1e-9, 1e-4, 1.0, 1e5, 1e10] {
        let polygons = polygons_at(&cube(), Mat4::from_mat3(scale * Mat3::IDENTITY));
        assert_eq!(corners(&polygons), [4; 6], "{scale}");
        assert!(polygons.iter().all(|polygon| polygon.normal.is_normalized()));
    }
}

#[test]
fn a_million_triangles_take_seconds() {
    let start = Instant::now();
    let mesh = grid(708, ALL, FLAT);
    assert!(mesh.indices.len() > 3_000_000);
    assert_eq!(corners(&polygons(&mesh)), [4]);
    let (polygons, lines) = lit(sphere(708));
    assert!(polygons.is_empty());
    assert!(
        lines[0].starts_with("emitters of many flat parts past 262144 triangles glow but light nothing"),
        "{lines:?}"
    );
    let (polygons, lines) = lit(sphere(255));
    assert_eq!((polygons.len(), lines.len()), (256, 1));
    assert!(lines[0].starts_with("emitters of more flat parts than there is room for light by fewer"), "{lines:?}");
    // About 4 s; what is quadratic takes hours. The room is for machines that do other things beside.
    assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
}

/// The lights of a mesh that glows, and what is said of them.
fn lit(mesh: Mesh) -> (Vec<Polygon>, Vec<String>) {
    let mut glowing = scene(mesh, Mat4::IDENTITY);
    glowing.materials[0].emission = Vec3::ONE;
    let mut notices = Notices::default();
    lights::add_lights(&mut glowing, 0, &mut notices);
    (glowing.lights.into_iter().flat_map(|light| light.polygons).collect(), notices.into_lines().collect())
}

#[test]
fn triangles_that_coincide_light_once_and_those_back_to_back_to_both_sides() {
    let mut mesh = grid(2, ALL, FLAT);
    mesh.indices.extend(mesh.indices.clone());
    let turned: Vec<u32> = mesh.indices.as_chunks::<3>().0.iter().flat_map(|&[a, b, c]| [b, c, a]).collect();
    mesh.indices.extend(turned);
    assert_eq!(corners(&polygons(&mesh)), [4]);
    let back: Vec<u32> = mesh.indices.as_chunks::<3>().0.iter().flat_map(|&[a, b, c]| [a, c, b]).collect();
    mesh.indices.extend(back);
    let (polygons, notices) = lit(mesh);
    assert_eq!((corners(&polygons), notices.len()), (vec![4, 4], 0));
    assert_eq!(polygons[0].normal, -polygons[1].normal);
}

#[test]
fn an_emitter_that_crosses_itself_shines_once_where_it_overlaps() {
    // A strip that goes one and a quarter times around in its plane and comes out over itself, or past itself.
    for drift in [0.005, 0.05] {
        let mut mesh = Mesh::default();
        for step in 0..=40u32 {
            let arm = Vec2::from_angle(step as f32 * std::f32::consts::TAU / 31.3).extend(0.0);
            let inner = 1.0 + drift * step as f32;
            mesh.positions.extend([inner * arm, (inner + 0.5) * arm]);
        }
        mesh.normals = vec![Vec3::Z; mesh.positions.len()];
        mesh.indices = (0..40).flat_map(|step| [0, 1, 2, 2, 1, 3].map(|corner| 2 * step + corner)).collect();
        // The squares of a fine grid whose middles lie in any of the triangles.
        let triangles: Vec<[Vec2; 3]> = mesh
            .indices
            .as_chunks::<3>()
            .0
            .iter()
            .map(|triangle| triangle.map(|corner| mesh.positions[corner as usize].truncate()))
            .collect();
        let is_in = |at: Vec2, [a, b, c]: [Vec2; 3]| {
            [(a, b), (b, c), (c, a)].into_iter().all(|(p, q)| (q - p).perp_dot(at - p) >= 0.0)
        };
        const SIDE: u32 = 900;
        let cell = 8.0 / SIDE as f32;
        let middle = |i: u32| (i as f32 + 0.5) * cell - 4.0;
        let count = (0..SIDE * SIDE)
            .filter(|&at| {
                let at = Vec2::new(middle(at % SIDE), middle(at / SIDE));
                triangles.iter().any(|&triangle| is_in(at, triangle))
            })
            .count();
        let expected = count as f64 * f64::from(cell * cell);
        let (polygons, notices) = lit(mesh.clone());
        let found: f64 = polygons.iter().map(area).sum();
        assert!((found / expected - 1.0).abs() < 2e-3, "{drift}: {found} {expected}");
        assert_eq!(notices.len(), 0, "{drift} {notices:?}");
    }
}

#[test]
fn folded_and_shuffled_triangles_in_one_plane_give_finite_lights() {
    let mut random = Pcg32::seed_from_u64(9);
    for _ in 0..300 {
        let mut mesh = grid(3, ALL, FLAT);
        for _ in 0..6 {
            let (position, index) = (random.random_range(0..16), random.random_range(0..54));
            mesh.positions[position] = Vec3::new(random.random(), random.random(), 0.0);
            mesh.indices[index] = random.random_range(0..16);
        }
        for polygon in lit(mesh).0 {
            assert!(polygon.normal.is_normalized() && area(&polygon).is_finite());
        }
    }
}

#[test]
fn squares_all_light_as_long_as_their_corners_fit() {
    // 2025 have 8100 corners, and 2116 have 8464.
    let squares = |side: u32| lit(grid(2 * side, |i, j| i % 2 == 0 && j % 2 == 0, FLAT));
    let (polygons, notices) = squares(16);
    assert_eq!((corners(&polygons), notices.len()), (vec![4; 256], 0));
    let (polygons, notices) = squares(45);
    assert_eq!((corners(&polygons), notices.len()), (vec![4; 2025], 1));
    let (polygons, notices) = squares(46);
    assert_eq!((polygons.len(), notices.len()), (0, 2));
}
