//! What is blended lies over what is behind it, in whatever order the file has it.

use glam::{DVec3, Mat4, Vec3, Vec3Swizzles};
use velour::renderer::Offscreen;
use velour::scene::{AlphaMode, Camera, Edits, Material, Projection, Scene};
use velour::table::SheenTable;

use super::compare::{GPU, linear};
use super::run::unshadowed;
use super::stage::{Stage, Thing, facing, looking, plain};

const SIZE: [u32; 2] = [65, 65];

fn perspective() -> Projection {
    Projection::Perspective { yfov: 0.8, near: 0.1, far: 100.0 }
}

fn orthographic() -> Projection {
    Projection::Orthographic { ymag: 1.3, near: 0.1, far: 100.0 }
}

fn glass(color: [f32; 3], opacity: f32, double_sided: bool) -> Material {
    let base_color = Vec3::from(color);
    Material { base_color, opacity, double_sided, alpha_mode: AlphaMode::Blend, unlit: true, ..plain() }
}

/// Several things as one mesh, of the first one's material.
fn joined(things: impl IntoIterator<Item = Thing>) -> Thing {
    let join = |mut joined: Thing, thing: Thing| {
        let first = joined.positions.len() as u32;
        joined.positions.extend(thing.positions.iter().map(|corner| thing.world_from_mesh.transform_point3(*corner)));
        joined.normals.extend(thing.normals.iter().map(|normal| thing.world_from_mesh.transform_vector3(*normal)));
        joined.triangles.extend(thing.triangles.iter().map(|triangle| triangle.map(|corner| first + corner)));
        joined
    };
    let mut things = things.into_iter();
    let first = things.next().expect("something to join");
    let start = Thing { positions: vec![], normals: vec![], triangles: vec![], ..first.clone() };
    std::iter::once(first).chain(things).fold(start, join).placed(Mat4::IDENTITY)
}

/// An octahedron that is subdivided, of this radius.
fn ball(radius: f32, material: Material) -> Thing {
    const STEPS: usize = 4;
    let mut triangles: Vec<[Vec3; 3]> = Vec::new();
    for x in [1.0, -1.0] {
        for y in [1.0, -1.0] {
            for z in [1.0_f32, -1.0] {
                let [a, b, c] = [x * Vec3::X, y * Vec3::Y, z * Vec3::Z];
                triangles.push(if x * y * z > 0.0 { [a, b, c] } else { [a, c, b] });
            }
        }
    }
    for _ in 0..STEPS - 2 {
        let split = |[a, b, c]: [Vec3; 3]| {
            let [ab, bc, ca] = [(a + b).normalize(), (b + c).normalize(), (c + a).normalize()];
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        triangles = triangles.into_iter().flat_map(split).collect();
    }
    let positions: Vec<Vec3> = triangles.as_flattened().iter().map(|corner| radius * *corner).collect();
    Thing {
        normals: triangles.as_flattened().to_vec(),
        triangles: (0..triangles.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect(),
        contours: Vec::new(),
        positions,
        world_from_mesh: Mat4::IDENTITY,
        material,
    }
}

/// What a ray through the middle of each pixel meets, one over the other: exact intersections, sorted by distance. None
/// where an edge is near.
fn expected(scene: &Scene, camera: &Camera) -> Vec<Option<DVec3>> {
    let world_from_camera = camera.world_from_camera.as_dmat4();
    let ray = |x: u32, y: u32| {
        let [right, up] = [2.0 * f64::from(x) - 64.0, 64.0 - 2.0 * f64::from(y)].map(|at| at / 65.0);
        let (origin, direction) = match camera.projection {
            Projection::Perspective { yfov, .. } => {
                let half = (0.5 * f64::from(yfov)).tan();
                (DVec3::ZERO, DVec3::new(half * right, half * up, -1.0))
            }
            Projection::Orthographic { ymag, .. } => (f64::from(ymag) * DVec3::new(right, up, 0.0), DVec3::NEG_Z),
        };
        [world_from_camera.transform_point3(origin), world_from_camera.transform_vector3(direction)]
    };
    let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y]));
    pixels.map(|[x, y]| over(scene, ray(x, y))).collect()
}

fn over(scene: &Scene, [origin, direction]: [DVec3; 2]) -> Option<DVec3> {
    let mut hits: Vec<(f64, DVec3, f64)> = Vec::new();
    for instance in &scene.instances {
        let mesh = &scene.meshes[instance.mesh];
        let material = &scene.materials[mesh.material];
        let world_from_mesh = instance.world_from_mesh.as_dmat4();
        for triangle in mesh.indices.chunks(3) {
            let own = [0, 1, 2].map(|corner| mesh.positions[triangle[corner] as usize].as_dvec3());
            let [a, b, c] = own.map(|corner| world_from_mesh.transform_point3(corner));
            let solved = glam::DMat3::from_cols(b - a, c - a, -direction).inverse() * (origin - a);
            let inside = solved.x.min(solved.y).min(1.0 - solved.x - solved.y);
            if inside.abs() < 0.03 {
                return None;
            }
            let normal =
                world_from_mesh.inverse().transpose().transform_vector3((own[1] - own[0]).cross(own[2] - own[0]));
            if inside > 0.0 && (material.double_sided || normal.dot(direction) < 0.0) {
                hits.push((solved.z, material.base_color.as_dvec3(), f64::from(material.opacity)));
            }
        }
    }
    hits.sort_by(|one, other| other.0.total_cmp(&one.0));
    Some(hits.into_iter().fold(DVec3::ZERO, |behind, (_, color, opacity)| behind.lerp(color, opacity)))
}

/// Holds a scene's picture from each camera against rays, drawn by one renderer; with a pixel for each ray.
fn hold(scene: &mut Scene, cameras: &[Camera]) {
    scene.cameras = cameras.to_vec();
    let drawn = unshadowed(scene, &Edits::default());
    let mut renderer = Offscreen::for_linear(&GPU, 1, &SheenTable::embedded(), &drawn).unwrap();
    for camera in cameras {
        let picture = GPU.block_on(renderer.linear(&GPU, camera, SIZE, &drawn.settings)).unwrap();
        assert_eq!(renderer.notice(), None);
        let mut compared = 0;
        for (pixel, expected) in picture.pixels.iter().zip(expected(scene, camera)) {
            let Some(expected) = expected else { continue };
            let difference = (Vec3::from(*pixel).as_dvec3() - expected).abs().max_element();
            assert!(difference < 1e-5, "{pixel:?} is not {expected}: {camera:?}");
            compared += usize::from(expected != DVec3::ZERO);
        }
        assert!(compared > 300, "{compared} pixels compared");
    }
}

fn camera(eye: [f32; 3], projection: Projection) -> Camera {
    Camera { name: String::new(), world_from_camera: looking(eye, [0.0; 3]), projection }
}

fn cameras() -> [Camera; 4] {
    let eyes = [[0.2, 0.3, 3.0], [-2.0, 0.4, -2.1]];
    let [front, back] = eyes.map(|eye| [perspective(), orthographic()].map(|projection| camera(eye, projection)));
    [front[0].clone(), back[0].clone(), back[1].clone(), front[1].clone()]
}

/// Panes of one colour each lie over each other: .5 of red, .25 of green, .125 of blue, and the same seen from behind.
#[test]
fn panes_of_one_mesh_lie_over_each_other() {
    // Colours by vertex, so that one mesh has three of them; the nearest comes first in the file.
    let pane =
        |z: f32| Thing::rectangle([1.0, 1.0], glass([1.0; 3], 0.5, true)).placed(Mat4::from_translation(z * Vec3::Z));
    let stage = Stage::new(vec![joined([0.5, 0.0, -0.5].map(pane))], Mat4::IDENTITY);
    let mut scene = stage.scene();
    let color =
        |vertex: usize| std::array::from_fn(|channel| if channel == vertex / 4 || channel == 3 { 65535 } else { 0 });
    scene.meshes[0].colors = (0..12).map(color).collect();
    let near_first = Vec3::new(0.5, 0.25, 0.125);
    for (eye, expected) in [([0.0, 0.0, 3.0], near_first), ([0.0, 0.0, -3.0], near_first.zyx())] {
        for projection in [perspective(), orthographic()] {
            scene.cameras = vec![camera(eye, projection)];
            let picture = linear(&scene, &SheenTable::embedded(), &Edits::default(), SIZE);
            let pixel = Vec3::from(picture.pixels[32 * 65 + 20]);
            assert!(pixel.abs_diff_eq(expected, 1e-5), "{pixel} is not {expected}");
        }
    }
}
#[test]
fn nested_glass_is_blended_along_every_ray() {
    let mirrored = Mat4::from_scale(Vec3::new(-1.0, 1.1, 0.9)) * Mat4::from_rotation_y(0.5);
    let things = vec![
        ball(0.9, glass([1.0, 0.2, 0.1], 0.3, true)),
        ball(0.25, glass([0.1, 0.9, 0.2], 0.6, false)).placed(mirrored),
        // One mesh of two balls, the outer one first.
        joined([0.7, 0.4].map(|radius| ball(radius, glass([0.2, 0.3, 1.0], 0.5, false)))).placed(mirrored),
        // A floor that reaches under the eye: its middle is nearer than the balls that stand before it.
        Thing::rectangle([4.0, 4.0], glass([0.7, 0.7, 0.1], 0.4, true))
            .placed(Mat4::from_translation(Vec3::new(0.0, -1.0, 2.0)) * facing([0.0; 3], [0.0, 1.0, 0.0])),
    ];
    hold(&mut Stage::new(things, Mat4::IDENTITY).scene(), &cameras());
}

/// A lamp that is glass and is moved through a pane: what is behind what changes with the edit.
#[test]
fn what_is_moved_is_sorted_anew() {
    let pane = Thing::rectangle([0.9, 0.9], glass([0.1, 0.2, 0.9], 0.5, true));
    let panes = [0.4, -0.4].map(|z| pane.clone().placed(Mat4::from_translation(z * Vec3::Z)));
    let mut scene = Stage::new(panes.to_vec(), Mat4::IDENTITY).scene();
    scene.materials[1].base_color = Vec3::new(0.9, 0.3, 0.1);
    let view = camera([0.1, 0.2, 3.0], perspective());
    scene.cameras = vec![view.clone()];
    let edits = Edits::default();
    let mut renderer = Offscreen::for_linear(&GPU, 1, &SheenTable::embedded(), &unshadowed(&scene, &edits)).unwrap();
    for z in [-0.4, 0.9, 0.1] {
        let mut drawn = unshadowed(&scene, &edits);
        drawn.instances.to_mut()[1].world_from_mesh = Mat4::from_translation(z * Vec3::Z);
        // What was opaque may be blended, and the other way round.
        drawn.materials[0].alpha_mode = if z == 0.1 { AlphaMode::Opaque } else { AlphaMode::Blend };
        renderer.update(&GPU, &drawn).unwrap();
        let picture = GPU.block_on(renderer.linear(&GPU, &view, SIZE, &drawn.settings)).unwrap();
        let [own, moved] = [0, 1].map(|index| scene.materials[index].base_color);
        let expected = match z {
            -0.4 => (0.5 * moved).lerp(own, 0.5),
            0.9 => (0.5 * own).lerp(moved, 0.5),
            // Behind what is opaque.
            _ => own,
        };
        let pixel = Vec3::from(picture.pixels[32 * 65 + 30]);
        assert!(pixel.abs_diff_eq(expected, 1e-5), "{z}: {pixel} is not {expected}");
    }
}
