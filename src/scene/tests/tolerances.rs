//! What counts as flat, straight, welded and crossing: on both sides of each bound.

use glam::{Mat4, Quat, Vec3};

use super::shapes::{area, grid};
use crate::scene::islands::Topology;
use crate::scene::outline::crosses;
use crate::scene::{Instance, Mesh, Polygon};

const FLAT: fn(f32, f32) -> f32 = |_, _| 0.0;
const ALL: fn(u32, u32) -> bool = |_, _| true;

/// The islands of a mesh; none where there are more than 256.
fn polygons(mesh: &Mesh) -> Option<Vec<Polygon>> {
    let instance = Instance { name: String::new(), mesh: 0, world_from_mesh: Mat4::IDENTITY };
    let islands = Topology::new(mesh).islands(mesh, &instance, 256)?;
    Some(islands.into_iter().map(|island| island.polygon).collect())
}

fn corners(mesh: &Mesh) -> Vec<usize> {
    let polygons = polygons(mesh).expect("too many islands");
    polygons.iter().flat_map(|polygon| &polygon.contours).map(Vec::len).collect()
}

/// Every triangle with vertices of its own.
fn unwelded(mut mesh: Mesh) -> Mesh {
    mesh.positions = mesh.indices.iter().map(|&index| mesh.positions[index as usize]).collect();
    mesh.normals = vec![Vec3::Z; mesh.positions.len()];
    mesh.indices = (0..mesh.positions.len() as u32).collect();
    mesh
}

#[test]
fn a_gap_parts_islands_from_a_millionth_of_their_size_on() {
    for (gap, expected) in [(5e-7, &[4][..]), (5e-6, &[4, 4])] {
        let mut mesh = unwelded(grid(2, ALL, FLAT));
        // The triangles on the right, which are the second two of each four.
        for positions in mesh.positions.chunks_mut(12) {
            positions[6..].iter_mut().for_each(|position| position.x += gap);
        }
        assert_eq!(corners(&mesh), expected, "{gap}");
    }
}

#[test]
fn slivers_do_not_count_as_islands() {
    let mut mesh = grid(1, ALL, FLAT);
    for at in 0..300 {
        let first = mesh.positions.len() as u32;
        let start = Vec3::new(2.0, 0.01 * at as f32, 0.0);
        mesh.positions.extend([start, start + Vec3::X, start + Vec3::new(0.5, 1e-7, 0.0)]);
        mesh.indices.extend([first, first + 1, first + 2]);
    }
    assert_eq!(corners(&mesh), [4]);
}

#[test]
fn pleats_within_the_tolerance_are_flat_up_to_sixty_degrees() {
    // A strip of 500 squares, up and down in turn; its thickness is within 1e-3 of its length either way.
    for (degrees, is_one) in [(40.0f32, true), (55.0, true), (70.0, false)] {
        let height = (0.5 * degrees).to_radians().tan() / 500.0;
        let is_up = |x: f32| (x * 500.0).round() as u32 % 2 == 1;
        let mesh = grid(500, |_, j| j == 0, |x, _| if is_up(x) { height } else { 0.0 });
        let found = polygons(&mesh);
        assert_eq!(found.map(|polygons| polygons.len()), is_one.then_some(1), "{degrees}");
    }
}

#[test]
fn a_corner_is_kept_from_a_millionth_of_the_size_on() {
    for (bump, expected) in [(2e-7, 4), (2e-5, 5)] {
        let mut mesh = grid(2, ALL, FLAT);
        let middle = mesh.positions.iter_mut().find(|at| at.x == 1.0 && at.y == 0.5).unwrap();
        middle.x += bump;
        assert_eq!(corners(&mesh), [expected], "{bump}");
    }
}

#[test]
fn far_from_the_origin_rounding_makes_no_corners() {
    let place = Mat4::from_rotation_translation(Quat::from_rotation_z(0.7), Vec3::new(900.0, -700.0, 300.0));
    let mut mesh = grid(20, ALL, FLAT);
    // In the mesh itself: its positions are rounded to 6e-5, squares are 0.05 wide.
    mesh.positions.iter_mut().for_each(|position| *position = place.transform_point3(*position));
    assert_eq!(corners(&mesh), [4]);
    assert!((area(&polygons(&mesh).unwrap()[0]) - 1.0).abs() < 1e-3);
}

#[test]
fn outlines_cross_where_they_reach_past_each_other_by_more_than_rounding() {
    // A square whose top has a notch, down to a little below its bottom.
    for (below, expected) in [(-0.1, false), (3e-5, false), (1e-3, true), (0.1, true)] {
        let contour = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.5, -below], [0.0, 1.0]];
        let contour: Vec<Vec3> = contour.iter().map(|&[x, y]| Vec3::new(x, y, 0.0)).collect();
        assert_eq!(crosses(&[contour], Vec3::Z), expected, "{below}");
    }
}
