//! Skins, posed by their joints.

use std::f32::consts::{FRAC_PI_2, TAU};

use glam::{DVec3, Mat4, Quat, Vec3, Vec4};
use serde_json::{Value, json};

use super::builder::Builder;
use crate::scene::{Instance, Mesh, Scene};

/// The corners of the square.
pub const CORNERS: [Vec3; 4] =
    [Vec3::new(-1.0, -1.0, 0.0), Vec3::new(1.0, -1.0, 0.0), Vec3::new(1.0, 1.0, 0.0), Vec3::new(-1.0, 1.0, 0.0)];

/// The studio's square at (7, 7, 7), all corners bound to two joints, which stand like this, by the same weights.
pub fn square(joints: [Value; 2], bound: [Mat4; 2], weights: [f32; 2]) -> Builder {
    let mut file = Builder::studio();
    file.bind(0, &[[0, 1, 0, 0]; 4], &[[weights[0], weights[1], 0.0, 0.0]; 4]);
    let joints = joints.map(|joint| file.push("nodes", joint));
    let skin = file.skin(&joints, &bound);
    file.json["nodes"][0]["skin"] = json!(skin);
    file.json["nodes"][0]["translation"] = json!([7, 7, 7]);
    file.json["scenes"][0]["nodes"].as_array_mut().unwrap().extend(joints.map(|joint| json!(joint)));
    file
}

/// The first instance, its mesh, and the mesh's corners in the world.
pub fn posed(scene: &Scene) -> (&Instance, &Mesh, Vec<Vec3>) {
    let instance = &scene.instances[0];
    let mesh = &scene.meshes[instance.mesh];
    let place = |&position: &Vec3| instance.world_from_mesh.transform_point3(position);
    (instance, mesh, mesh.positions.iter().map(place).collect())
}

pub fn assert_near(found: &[Vec3], expected: &[Vec3]) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!(found.abs_diff_eq(*expected, 2e-6), "{found} for {expected}");
    }
}

/// Joints of which the first is still, and the second has turned by a quarter about z where it is bound, at (0, 1, 0).
pub fn turned() -> ([Value; 2], [Mat4; 2]) {
    let rotation = Quat::from_rotation_z(FRAC_PI_2).to_array();
    let second = json!({ "translation": [0, 1, 0], "rotation": rotation });
    ([json!({}), second], [Mat4::IDENTITY, Mat4::from_translation(-Vec3::Y)])
}

/// A quarter of each corner, and three of where the turned joint takes it: (x, y) to (1 - y, x + 1).
fn quarter_turned() -> [Vec3; 4] {
    CORNERS.map(|at| 0.25 * at + 0.75 * Vec3::new(1.0 - at.y, at.x + 1.0, 0.0))
}

#[test]
fn positions_are_means_of_where_joints_take_them_by_weight() {
    let (joints, bound) = turned();
    // Whatever the weights sum to.
    for weights in [[0.25, 0.75], [0.5, 1.5], [1e-30, 3e-30], [1e38, 3e38]] {
        let scene = square(joints.clone(), bound, weights).read();
        assert!(scene.notices.is_empty(), "{:?}", scene.notices);
        assert_near(&posed(&scene).2, &quarter_turned());
    }
}

#[test]
fn weights_and_joints_of_every_component_type_and_set() {
    let (joints, bound) = turned();
    let words = |words: &[u16]| words.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<u8>>().repeat(4);
    // Shares of 255 and 65535 that are 1 to 3, but for the sum.
    let bytes = [51u8, 153, 0, 0].repeat(4);
    for (weights, component) in [(bytes, 5121), (words(&[13107, 39321, 0, 0]), 5123)] {
        let mut file = square(joints.clone(), bound, [1.0, 0.0]);
        let weights = file.accessor(&weights, 4, component, "VEC4");
        file.json["accessors"][weights]["normalized"] = json!(true);
        let indices = file.accessor(&words(&[0, 1, 0, 0]), 4, 5123, "VEC4");
        file.attribute(0, "WEIGHTS_0", weights);
        file.attribute(0, "JOINTS_0", indices);
        assert_near(&posed(&file.read()).2, &quarter_turned());
    }
    // Over three sets, of which the last has a joint twice.
    let mut file = square(joints, bound, [0.25, 0.0]);
    let of = |file: &mut Builder, joints: [u8; 4], weights: [f32; 4]| {
        let weights = file.accessor(bytemuck::cast_slice(&[weights; 4]), 4, 5126, "VEC4");
        [file.accessor(&joints.repeat(4), 4, 5121, "VEC4"), weights]
    };
    for (set, joints, weights) in [(1, [1, 0, 0, 0], [0.25, 0.0, 0.0, 0.0]), (2, [0, 0, 1, 1], [0.0, 0.0, 0.25, 0.25])]
    {
        let [joints, weights] = of(&mut file, joints, weights);
        file.attribute(0, &format!("JOINTS_{set}"), joints);
        file.attribute(0, &format!("WEIGHTS_{set}"), weights);
    }
    assert_near(&posed(&file.read()).2, &quarter_turned());
}

/// A tube about y of radius 1 from y = 0 to 2, in three rings of 16 vertices, with normals; bent at its middle ring, of
/// which both joints have half.
fn bent_tube() -> (Builder, Vec<f32>) {
    const SIDES: usize = 16;
    let angles: Vec<f32> = (0..SIDES).map(|side| TAU * side as f32 / SIDES as f32).collect();
    let ring = |height: f32| angles.iter().map(move |angle| Vec3::new(angle.cos(), height, angle.sin()));
    let positions: Vec<Vec3> = (0..3).flat_map(|height| ring(height as f32)).collect();
    let normals: Vec<Vec3> = (0..3).flat_map(|_| ring(0.0)).collect();
    let quad = |ring: usize, side: usize| {
        let [a, b] = [side, (side + 1) % SIDES].map(|side| (ring * SIDES + side) as u32);
        let [c, d] = [a, b].map(|below| below + SIDES as u32);
        [a, c, b, b, c, d]
    };
    let indices: Vec<u32> = (0..2).flat_map(|ring| (0..SIDES).flat_map(move |side| quad(ring, side))).collect();
    let mut file = Builder::new();
    let mesh = file.mesh(&positions, Some(&normals), &indices, None);
    let weights = [[1.0, 0.0, 0.0, 0.0], [0.5, 0.5, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0]];
    let weights: Vec<[f32; 4]> = weights.into_iter().flat_map(|weights| [weights; SIDES]).collect();
    file.bind(mesh, &[[0, 1, 0, 0]; 3 * SIDES], &weights);
    let (joints, bound) = turned();
    let joints = joints.map(|joint| file.push("nodes", joint));
    let skin = file.skin(&joints, &bound);
    file.push("nodes", json!({ "mesh": mesh, "skin": skin }));
    (file, angles)
}

#[test]
fn a_bent_tube() {
    let (file, angles) = bent_tube();
    let scene = file.read();
    let (_, mesh, places) = posed(&scene);
    for (at, angle) in angles.iter().enumerate() {
        let (cos, sin) = (angle.cos(), angle.sin());
        // The upper half lies along -x; the middle ring is the mean of itself and itself turned.
        let expected = [[cos, 0.0, sin], [0.5 * cos, 1.0 + 0.5 * cos, sin], [-1.0, 1.0 + cos, sin]].map(Vec3::from);
        // There the mean of the matrices turns by an eighth and shrinks x and y by the root of 2.
        let normals = [[cos, 0.0, sin], [cos, cos, sin], [0.0, cos, sin]].map(|normal| Vec3::from(normal).normalize());
        for ring in 0..3 {
            let vertex = ring * angles.len() + at;
            assert_near(&[places[vertex], mesh.normals[vertex]], &[expected[ring], normals[ring]]);
        }
    }
}

/// A patch of a sphere, by azimuth and elevation in steps of a hundredth of a radian, 9 by 9.
fn patch() -> (Vec<Vec3>, Vec<u32>) {
    let at = |step: u32| 0.01 * step as f32;
    let point = |step: u32| {
        let (azimuth, elevation) = (at(step % 9) + 0.3, at(step / 9) + 0.5);
        let (flat, y) = (elevation.cos(), elevation.sin());
        Vec3::new(flat * azimuth.sin(), y, flat * azimuth.cos())
    };
    let quad = |row: u32, column: u32| {
        let a = 9 * row + column;
        [a, a + 1, a + 10, a, a + 10, a + 9]
    };
    let indices = (0..8).flat_map(|row| (0..8).flat_map(move |column| quad(row, column)));
    ((0..81).map(point).collect(), indices.collect())
}

/// The patch on two joints that stretch, shear and turn it, and mirror it or not, under a bulb.
fn stretched(mirrored: f32) -> Scene {
    let (positions, indices) = patch();
    let mut file = Builder::new();
    let mesh = file.mesh(&positions, Some(&positions), &indices, None);
    let tangents: Vec<Vec4> = positions.iter().map(|at| Vec3::Y.cross(*at).normalize().extend(-1.0)).collect();
    let tangents = file.accessor(bytemuck::cast_slice(&tangents), tangents.len(), 5126, "VEC4");
    file.attribute(mesh, "TANGENT", tangents);
    let texture = file.texture(&super::builder::picture(image::ImageFormat::Png, 2, 2));
    let material = file.push("materials", json!({ "normalTexture": { "index": texture } }));
    file.json["meshes"][mesh]["primitives"][0]["material"] = json!(material);
    file.bind(mesh, &[[1, 0, 0, 0]; 81], &[[0.25, 0.75, 0.0, 0.0]; 81]);
    let rotation = Quat::from_euler(glam::EulerRot::XYZ, 0.4, -0.3, 0.8).to_array();
    let joints = [
        json!({ "scale": [mirrored * 2.0, 0.5, 1.0], "translation": [1, 2, 3] }),
        json!({ "scale": [mirrored, 3.0, 0.25], "rotation": rotation }),
    ];
    let joints = joints.map(|joint| file.push("nodes", joint));
    let skin = file.skin(&joints, &[Mat4::from_scale(Vec3::splat(0.5)), Mat4::from_translation(Vec3::X)]);
    file.push("nodes", json!({ "mesh": mesh, "skin": skin }));
    file.read()
}

#[test]
fn normals_and_tangents_follow_the_surface_whether_mirrored_or_not() {
    let plain = stretched(1.0);
    for (scene, is_mirrored) in [(&plain, false), (&stretched(-1.0), true)] {
        let (_, mesh, places) = posed(scene);
        for at in [10, 40, 70] {
            let normal = mesh.normals[at];
            let along: [Vec3; 2] = [places[at + 1] - places[at - 1], places[at + 9] - places[at - 9]];
            for difference in along {
                assert!(normal.dot(difference.normalize()).abs() < 1e-3, "{normal} {difference}");
            }
            // Azimuth, elevation and outside are a right-handed frame, unless they are mirrored.
            let outside = along[0].cross(along[1]) * if is_mirrored { -1.0 } else { 1.0 };
            assert!(normal.dot(outside) > 0.0);
            // The tangent runs along the azimuth, and the bitangent of w = -1 against the elevation.
            let tangent = mesh.tangents[at];
            assert!(tangent.truncate().dot(along[0].normalize()) > 0.999);
            let bitangent = tangent.w * normal.cross(tangent.truncate());
            assert!(bitangent.dot(along[1]) < 0.0, "{bitangent} {}", along[1]);
        }
        for triangle in mesh.indices.as_chunks::<3>().0 {
            let [a, b, c] = triangle.map(|corner| places[corner as usize]);
            assert!((b - a).cross(c - a).dot(mesh.normals[triangle[0] as usize]) > 0.0, "seen from its front");
        }
        assert!(!scene.instances[0].mirrors());
    }
}

#[test]
fn joints_that_mirror_do_as_a_node_that_mirrors() {
    let mirror = json!({ "scale": [-1, 1, 1] });
    let mut file = square(
        [mirror.clone(), json!({ "scale": [-1, 1, 1], "translation": [0, 0, 2] })],
        [Mat4::IDENTITY; 2],
        [0.5, 0.5],
    );
    let by_node = file.push("nodes", mirror);
    file.json["nodes"][by_node]["mesh"] = json!(0);
    file.json["nodes"][by_node]["translation"] = json!([0, 0, 1]);
    file.json["scenes"][0]["nodes"].as_array_mut().unwrap().push(json!(by_node));
    let scene = file.read();
    let faces = |instance: &Instance| {
        let mesh = &scene.meshes[instance.mesh];
        let triangles = mesh.indices.as_chunks::<3>().0.iter().map(|triangle| {
            let corners =
                triangle.map(|corner| instance.world_from_mesh.transform_point3(mesh.positions[corner as usize]));
            let front = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            (corners[0], front * if instance.mirrors() { -1.0 } else { 1.0 })
        });
        let normals = mesh.normals.iter().map(|normal| instance.world_from_normal() * *normal);
        (triangles.collect::<Vec<_>>(), normals.collect::<Vec<_>>())
    };
    let instances: Vec<&Instance> =
        scene.instances.iter().filter(|instance| scene.meshes[instance.mesh].name.contains("mesh 0")).collect();
    assert_eq!(instances.len(), 2);
    assert!(!instances[0].mirrors() && instances[1].mirrors());
    assert_eq!(faces(instances[0]), faces(instances[1]));
}

#[test]
fn joints_count_wherever_they_are() {
    let (joints, bound) = turned();
    // Not in the scene, below a node that is not there either.
    let mut file = square(joints, bound, [0.25, 0.75]);
    let [first, second] = [3, 4];
    file.json["nodes"][first]["children"] = json!([second]);
    let armature = file.push("nodes", json!({ "children": [first], "translation": [0, 0, 5] }));
    file.json["scenes"][0]["nodes"] = json!([0, 1, 2]);
    let raised = quarter_turned().map(|at| at + 5.0 * Vec3::Z);
    assert_near(&posed(&file.read()).2, &raised);
    // In the scene and hidden.
    file.json["scenes"][0]["nodes"] = json!([0, 1, 2, armature]);
    file.json["nodes"][armature]["extensions"] = json!({ "KHR_node_visibility": { "visible": false } });
    assert_near(&posed(&file.read()).2, &raised);
}

#[test]
fn skinned_meshes_are_precise_wherever_they_stand() {
    let (joints, bound) = turned();
    let near = square(joints.clone(), bound, [0.25, 0.75]).read();
    let mut file = square(joints, bound, [0.25, 0.75]);
    let far = [448_262.5, 5_411_932.5, 120.0];
    let armature = file.push("nodes", json!({ "translation": far, "children": [3, 4] }));
    file.json["scenes"][0]["nodes"] = json!([0, 1, 2, armature]);
    let far_scene = file.read();
    assert_eq!(posed(&far_scene).1.positions, posed(&near).1.positions);
    let place = |scene: &Scene| scene.origin + posed(scene).0.world_from_mesh.w_axis.truncate().as_dvec3();
    let moved = place(&far_scene) - place(&near);
    assert!(moved.abs_diff_eq(DVec3::from(far), 1e-6), "{moved}");
}

#[test]
fn joints_that_agree_move_the_mesh_as_it_is() {
    let raised = Mat4::from_translation(Vec3::Z);
    let joints = [json!({ "translation": [1, 0, 0] }), json!({ "translation": [0, 2, 0] })];
    for (off, is_shared) in [(0.0, true), (1e-5, true), (2e-3, false)] {
        let bound = [Vec3::X, Vec3::new(off, 2.0, 0.0)].map(|joint| raised * Mat4::from_translation(-joint));
        let mut file = square(joints.clone(), bound, [0.5, 0.5]);
        let plain = file.push("nodes", json!({ "mesh": 0 }));
        file.json["scenes"][0]["nodes"].as_array_mut().unwrap().push(json!(plain));
        let scene = file.read();
        assert!(scene.notices.is_empty(), "{:?}", scene.notices);
        assert_eq!(scene.instances[0].mesh == scene.instances[2].mesh, is_shared, "{off}");
        assert!(scene.instances[0].world_from_mesh.abs_diff_eq(raised, 2e-3));
        assert_eq!(scene.instances[2].world_from_mesh, Mat4::IDENTITY);
    }
    // The same skin at two nodes is one mesh.
    let (joints, bound) = turned();
    let mut file = square(joints, bound, [0.25, 0.75]);
    let again = file.push("nodes", json!({ "mesh": 0, "skin": 0 }));
    file.json["scenes"][0]["nodes"].as_array_mut().unwrap().push(json!(again));
    let scene = file.read();
    assert_eq!((scene.instances[0].mesh, scene.meshes.len()), (scene.instances[2].mesh, 2));
}

#[test]
fn a_mesh_without_joints_or_a_node_without_a_skin_stands_at_the_node() {
    let (joints, bound) = turned();
    let at_node = Mat4::from_translation(Vec3::splat(7.0));
    let mut file = square(joints.clone(), bound, [0.25, 0.75]);
    file.json["nodes"][0].as_object_mut().unwrap().remove("skin");
    let scene = file.read();
    assert_eq!((scene.instances[0].world_from_mesh, scene.notices.len()), (at_node, 0));
    assert_eq!(scene.meshes[0].positions, CORNERS);
    for missing in ["JOINTS_0", "WEIGHTS_0"] {
        let mut file = square(joints.clone(), bound, [0.25, 0.75]);
        file.json["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap().remove(missing);
        let scene = file.read();
        assert_eq!((scene.instances[0].world_from_mesh, &scene.meshes[0].positions[..]), (at_node, &CORNERS[..]));
        let kind = "meshes without joints and weights stand at their nodes, whatever the skin";
        assert_eq!(scene.notices, [format!("{kind}: node 0 \"square\"")]);
    }
    let mut file = square(joints, bound, [0.25, 0.75]);
    file.json["skins"][0]["joints"] = json!([]);
    assert_eq!(file.read().instances[0].world_from_mesh, at_node);
}

#[test]
fn instances_of_skinned_meshes_are_drawn_once() {
    let (joints, bound) = turned();
    let mut file = square(joints, bound, [0.25, 0.75]);
    let places = file.vectors(&[Vec3::ZERO, Vec3::X]);
    file.json["nodes"][0]["extensions"] =
        json!({ "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": places } } });
    let scene = file.read();
    assert_eq!(scene.instances.len(), 2);
    assert_eq!(scene.notices, ["meshes that joints move are drawn once, not at each instance: node 0 \"square\""]);
    assert_near(&posed(&scene).2, &quarter_turned());
}

#[test]
fn a_glowing_skin_lights_where_it_is_posed() {
    let mut file = Builder::studio();
    file.bind(1, &[[0, 1, 0, 0]; 4], &[[0.5, 0.5, 0.0, 0.0]; 4]);
    let joints =
        [json!({ "scale": [3, 1, 1] }), json!({ "translation": [0, 0, 4] })].map(|joint| file.push("nodes", joint));
    let skin = file.skin(&joints, &[Mat4::IDENTITY; 2]);
    file.json["nodes"][2]["skin"] = json!(skin);
    let scene = file.read();
    let contour = &scene.lights[0].polygons[0].contours[0];
    let (least, greatest) = (contour.iter().copied().reduce(Vec3::min), contour.iter().copied().reduce(Vec3::max));
    assert_near(&[least.unwrap(), greatest.unwrap()], &[Vec3::new(-2.0, -1.0, 5.0), Vec3::new(2.0, 1.0, 5.0)]);
    assert!(scene.lights[0].polygons[0].normal.abs_diff_eq(Vec3::NEG_Z, 1e-6));
}
