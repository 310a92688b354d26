//! The order against rays: what a ray meets farther off is painted before what it meets nearer.

use std::collections::HashMap;
use std::f32::consts::TAU;

use glam::{DMat4, DVec3, DVec4, Mat4, Quat, Vec3, Vec4};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use super::{PAIRS_MAX, PaintOrder, Painted, PlacedMesh};
use crate::renderer::view::{Rect, View};
use crate::scene::{Camera, Projection};

#[derive(Clone)]
struct Solid {
    positions: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    world_from_mesh: Mat4,
    double_sided: bool,
}

impl Solid {
    fn new(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Self {
        Self { positions, triangles, world_from_mesh: Mat4::IDENTITY, double_sided: true }
    }

    /// Triangles that share no corners.
    fn loose(triangles: impl IntoIterator<Item = [Vec3; 3]>) -> Self {
        let positions: Vec<Vec3> = triangles.into_iter().flatten().collect();
        let count = positions.len() as u32 / 3;
        Self::new(positions, (0..count).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect())
    }

    /// A square of half side `half` in the plane z = 0, facing +z.
    fn pane(half: f32) -> Self {
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let corners = corners.map(|[x, y]| half * Vec3::new(x, y, 0.0));
        Self::new(corners.to_vec(), vec![[0, 1, 2], [0, 2, 3]])
    }

    fn ball(radius: f32) -> Self {
        const COLUMNS: u32 = 16;
        const ROWS: u32 = 8;
        let at = |row: u32, column: u32| {
            let (polar, azimuth) = (0.5 * TAU * row as f32 / ROWS as f32, TAU * column as f32 / COLUMNS as f32);
            radius * Vec3::new(polar.sin() * azimuth.sin(), polar.cos(), polar.sin() * azimuth.cos())
        };
        let positions = (0..=ROWS).flat_map(|row| (0..=COLUMNS).map(move |column| at(row, column))).collect();
        let quad = |row: u32, column: u32| {
            let [a, b] = [row, row + 1].map(|row| row * (COLUMNS + 1) + column);
            // None at the poles has no area.
            let upper = (row > 0).then_some([a, b, a + 1]);
            upper.into_iter().chain((row + 1 < ROWS).then_some([a + 1, b, b + 1]))
        };
        Self::new(positions, (0..ROWS).flat_map(|row| (0..COLUMNS).flat_map(move |at| quad(row, at))).collect())
    }

    fn placed(self, world_from_mesh: Mat4) -> Self {
        Self { world_from_mesh, ..self }
    }

    fn single_sided(self) -> Self {
        Self { double_sided: false, ..self }
    }

    fn borrowed(&self) -> PlacedMesh<'_> {
        PlacedMesh {
            positions: &self.positions,
            triangles: &self.triangles,
            world_from_mesh: self.world_from_mesh,
            double_sided: self.double_sided,
        }
    }

    /// How far along the ray each triangle is met, by solving for distance and weights. The front is where the mesh's
    /// own normal points, carried over by the inverse transpose.
    fn hits(&self, origin: DVec3, direction: DVec3) -> Vec<(u32, f64)> {
        let world_from_mesh = self.world_from_mesh.as_dmat4();
        let hit = |(index, triangle): (usize, &[u32; 3])| {
            let mesh = triangle.map(|corner| self.positions[corner as usize].as_dvec3());
            let [a, b, c] = mesh.map(|corner| world_from_mesh.transform_point3(corner));
            let matrix = glam::DMat3::from_cols(b - a, c - a, -direction);
            let solved = matrix.inverse() * (origin - a);
            let normal = (mesh[1] - mesh[0]).cross(mesh[2] - mesh[0]);
            let normal = world_from_mesh.inverse().transpose().transform_vector3(normal);
            let is_front = normal.dot(direction) < 0.0;
            let is_met = solved.x > 0.0 && solved.y > 0.0 && solved.x + solved.y < 1.0;
            (is_met && (is_front || self.double_sided)).then_some((index as u32, solved.z))
        };
        self.triangles.iter().enumerate().filter_map(hit).collect()
    }
}

const NEAR: f32 = 0.1;

fn projections() -> [Projection; 3] {
    [
        Projection::Perspective { yfov: 0.9, near: NEAR, far: f32::INFINITY },
        Projection::Perspective { yfov: 0.9, near: NEAR, far: 50.0 },
        Projection::Orthographic { ymag: 2.5, near: NEAR, far: 50.0 },
    ]
}

fn camera(eye: Vec3, projection: Projection) -> Camera {
    let back = eye.normalize();
    let right = Vec3::Y.cross(back).normalize();
    let world_from_camera =
        Mat4::from_cols(right.extend(0.0), back.cross(right).extend(0.0), back.extend(0.0), eye.extend(1.0));
    Camera { name: String::new(), world_from_camera, projection }
}

fn view(camera: &Camera) -> View {
    View::new(camera, [200, 150], Rect::full([200, 150]))
}

fn order(solids: &[Solid], view: &View) -> PaintOrder {
    let meshes: Vec<PlacedMesh> = solids.iter().map(Solid::borrowed).collect();
    PaintOrder::new(&meshes, view)
}

/// The ray of a point of the picture: where it starts at the near plane, and its direction.
fn ray(view: &View, at: [f64; 2]) -> [DVec3; 2] {
    let world_from_clip: DMat4 = view.clip_from_world.as_dmat4().inverse();
    let point = |depth: f64| {
        let point = world_from_clip * DVec4::new(at[0], at[1], depth, 1.0);
        point.truncate() / point.w
    };
    let [start, end] = [point(1.0), point(0.5)];
    [start, (end - start).normalize()]
}

/// Follows `rays` rays through the picture; returns how many had two hits or more.
fn hold(solids: &[Solid], camera: &Camera, rays: usize) -> usize {
    let view = view(camera);
    let order = order(solids, &view);
    assert!(order.is_exact);
    let place = |(at, painted): (usize, &Painted)| ((painted.mesh, painted.triangle), at);
    let places: HashMap<(u32, u32), usize> = order.triangles.iter().enumerate().map(place).collect();
    assert_eq!(places.len(), order.triangles.len(), "each triangle once");
    let mut rng = Pcg64::seed_from_u64(7);
    let mut deep = 0;
    for _ in 0..rays {
        let [origin, direction] = ray(&view, std::array::from_fn(|_| rng.random_range(-0.999..0.999)));
        let mut hits: Vec<(f64, usize)> = Vec::new();
        for (mesh, solid) in (0..).zip(solids) {
            for (triangle, distance) in solid.hits(origin, direction) {
                if distance > 0.0 {
                    hits.push((distance, places[&(mesh, triangle)]));
                }
            }
        }
        hits.sort_by(|one, other| other.0.total_cmp(&one.0));
        deep += usize::from(hits.len() > 1);
        for pair in hits.windows(2).filter(|pair| pair[0].0 - pair[1].0 > 1e-5) {
            assert!(pair[0].1 < pair[1].1, "{camera:?}: {pair:?} along {origin} + t {direction}");
        }
    }
    deep
}

/// Panes between which no triangle reaches, and triangles of all sizes between them, each in a cell of its own: planes
/// separate everything, so that there is an order for every eye.
fn cells() -> Vec<Solid> {
    let mut rng = Pcg64::seed_from_u64(1);
    let mut layers = Vec::new();
    for layer in 0..6 {
        let z = layer as f32 - 2.5;
        layers.push(Solid::pane(3.0).placed(Mat4::from_translation(Vec3::Z * (z - 0.5))));
        let count = [1, 2, 5, 9, 3, 7][layer];
        let side = 4.0 / count as f32;
        let mut cell = |index: usize| {
            let low = Vec3::new((index % count) as f32 * side - 2.0, (index / count) as f32 * side - 2.0, z - 0.45);
            [(); 3].map(|()| low + Vec3::new(side, side, 0.9) * Vec3::from_array([(); 3].map(|()| rng.random())))
        };
        layers.push(Solid::loose((0..count * count).map(&mut cell)));
    }
    // Not in the order in which an eye sees them.
    for index in (1..layers.len()).rev() {
        layers.swap(index, rng.random_range(0..=index));
    }
    layers
}

#[test]
fn triangles_of_all_sizes_are_in_the_order_of_every_ray() {
    let scene = cells();
    for projection in projections() {
        for eye in [Vec3::new(0.3, 0.4, 6.0), Vec3::new(-5.0, 1.0, -2.0), Vec3::new(0.1, 4.0, 1.2)] {
            let deep = hold(&scene, &camera(eye, projection), 300);
            assert!(deep > 100, "{deep}");
        }
    }
}

#[test]
fn nested_balls_and_a_floor_under_the_eye() {
    // The floor reaches behind the eye, and the inner balls are smaller than its triangles.
    let turned = Mat4::from_rotation_x(-0.25 * TAU);
    let floor = Solid::pane(20.0).placed(Mat4::from_translation(Vec3::NEG_Y) * turned);
    let mirror = Mat4::from_scale(Vec3::new(-1.0, 1.2, 0.9)) * Mat4::from_rotation_y(0.4);
    let scene = [
        Solid::ball(0.9).single_sided(),
        Solid::ball(0.6).placed(mirror),
        floor,
        Solid::ball(0.3).placed(mirror).single_sided(),
        Solid::pane(0.9).placed(Mat4::from_translation(1.3 * Vec3::NEG_Z)),
    ];
    for projection in projections() {
        for eye in [Vec3::new(0.5, 1.0, 3.0), Vec3::new(2.0, -0.3, -2.0), Vec3::new(0.0, 0.01, 0.05)] {
            let deep = hold(&scene, &camera(eye, projection), 300);
            assert!(deep > 20, "{deep}");
        }
    }
}

/// Where a sort by the middles of triangles is wrong: the ball's are nearer than the floor's, or farther.
#[test]
fn a_large_triangle_beside_a_small_one() {
    let large = [Vec3::new(-1.0, -0.2, 2.0), Vec3::new(1.0, -0.2, 2.0), Vec3::new(0.0, -0.2, -40.0)];
    for (height, expected) in [(-0.1, [0, 1]), (-0.3, [1, 0])] {
        for z in [-5.0, 1.0] {
            let at = Vec3::new(0.0, height, z);
            let small = [Vec3::ZERO, 0.05 * Vec3::X, 0.05 * Vec3::Z].map(|offset| at + offset);
            let eye = camera(3.0 * Vec3::Z, projections()[0]);
            let order = order(&[Solid::loose([large]), Solid::loose([small])], &view(&eye));
            assert_eq!(order.triangles.iter().map(|painted| painted.mesh).collect::<Vec<_>>(), expected, "{at}");
        }
    }
}

#[test]
fn what_lies_in_one_plane_keeps_its_order() {
    let place = Mat4::from_rotation_translation(Quat::from_rotation_y(0.7), Vec3::new(0.1, 0.2, 0.3));
    let layers = [0.4, 1.5, 1.5, 0.02].map(|half| Solid::pane(half).placed(place));
    for eye in [Vec3::new(1.0, 0.5, 4.0), Vec3::new(-2.0, 0.5, -3.0)] {
        let order = order(&layers, &view(&camera(eye, projections()[0])));
        let meshes: Vec<u32> = order.triangles.iter().map(|painted| painted.mesh).collect();
        assert_eq!(meshes, [0, 0, 1, 1, 2, 2, 3, 3]);
    }
}

#[test]
fn each_mesh_is_painted_in_one_go_where_it_can_be() {
    let beside = |x: f32| Solid::ball(0.5).placed(Mat4::from_translation(x * Vec3::X));
    let nested = [Solid::ball(0.9), Solid::ball(0.6)];
    let eye = camera(Vec3::new(0.0, 0.5, 5.0), projections()[0]);
    for (scene, runs) in [(&[beside(-1.2), beside(0.0), beside(1.2)][..], 3), (&nested[..], 3)] {
        let order = order(scene, &view(&eye));
        assert_eq!(order.triangles.chunk_by(|one, next| one.mesh == next.mesh).count(), runs);
    }
}

/// Three bars that lie on each other in a circle have no order; what lies behind and before them has.
#[test]
fn circles_touch_nothing_else() {
    let bar = |index: u32| {
        let turned = Quat::from_rotation_z(TAU * index as f32 / 3.0);
        let corners = [[-2.0, -0.7, -0.3], [-2.0, -0.5, -0.3], [2.0, -0.6, 0.3]];
        corners.map(|corner| turned * Vec3::from_array(corner))
    };
    let pane = |z: f32| Solid::pane(2.0).placed(Mat4::from_translation(z * Vec3::Z));
    let circle = Solid::loose((0..3).map(bar));
    let scene = [pane(1.0), circle.clone(), pane(-1.0), circle.placed(Mat4::from_translation(2.0 * Vec3::NEG_Z))];
    let eye = camera(6.0 * Vec3::Z, projections()[2]);
    let order = order(&scene, &view(&eye));
    let meshes: Vec<u32> = order.triangles.iter().map(|painted| painted.mesh).collect();
    assert_eq!(meshes, [3, 3, 3, 2, 2, 1, 1, 1, 0, 0]);
}

#[test]
fn what_has_no_area_and_what_is_out_of_sight_is_left_out() {
    let eye = camera(Vec3::new(0.0, 0.0, 3.0), projections()[0]);
    let nowhere = [
        [Vec3::ZERO; 3],
        [Vec3::ZERO, Vec3::X, 2.0 * Vec3::X],
        // Edge-on, behind the eye, through it, beside the picture.
        [Vec3::ZERO, Vec3::Z, Vec3::NEG_Z],
        [Vec3::new(0.0, 0.0, 4.0), Vec3::new(1.0, 0.0, 4.0), Vec3::new(0.0, 1.0, 5.0)],
        [Vec3::new(0.0, 0.0, 3.0), Vec3::new(0.0, 0.0, 5.0), Vec3::new(0.0, 0.0, 4.0)],
        [Vec3::new(50.0, 0.0, 0.0), Vec3::new(51.0, 0.0, 0.0), Vec3::new(50.0, 1.0, 0.0)],
    ];
    assert_eq!(order(&[Solid::loose(nowhere)], &view(&eye)).triangles, []);
    assert_eq!(order(&[], &view(&eye)).triangles, []);
    let backwards = Solid::pane(1.0).single_sided().placed(Mat4::from_rotation_y(0.5 * TAU));
    assert_eq!(order(&[backwards], &view(&eye)).triangles, []);
    // A corner in the plane of the eye.
    let across = [Vec3::new(-1.0, -1.0, 3.0), Vec3::new(1.0, -1.0, 0.0), Vec3::new(0.0, -1.0, -9.0)];
    assert_eq!(order(&[Solid::loose([across])], &view(&eye)).triangles.len(), 1);
}

#[test]
fn past_the_bound_triangles_are_sorted_by_their_middles() {
    let count = (2.0 * PAIRS_MAX as f64).sqrt() as u32 + 2;
    let layer = |index: u32| {
        let z = Vec3::Z * (index * 7919 % count) as f32 / count as f32;
        [Vec3::ZERO, Vec3::X, Vec3::Y].map(|corner| corner + z)
    };
    let order = order(&[Solid::loose((0..count).map(layer))], &view(&camera(5.0 * Vec3::Z, projections()[0])));
    assert!(!order.is_exact);
    assert_eq!(order.triangles.len(), count as usize);
    let depths: Vec<f32> = order.triangles.iter().map(|painted| layer(painted.triangle)[0].z).collect();
    assert!(depths.is_sorted());
}

#[test]
fn a_tile_has_the_order_of_what_it_shows() {
    let scene = cells();
    let camera = camera(Vec3::new(0.3, 0.4, 6.0), projections()[0]);
    let whole = order(&scene, &view(&camera)).triangles.len();
    let tile = View::new(&camera, [200, 150], Rect { x: 0, y: 0, width: 50, height: 50 });
    let order = order(&scene, &tile);
    assert!(order.is_exact && order.triangles.len() < whole / 2);
    assert_eq!(tile.eye, Vec4::new(0.3, 0.4, 6.0, 1.0));
}
