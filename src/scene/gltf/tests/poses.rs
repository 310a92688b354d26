//! Meshes as they were modelled.

use glam::{Mat4, Vec3};
use serde_json::json;

use super::builder::{Builder, read_as};
use crate::scene::Scene;
use crate::scene::gltf::{Options, Pose};

fn bind(file: &Builder) -> Scene {
    read_as(&file.glb(), &Options { pose: Pose::Bind, ..Options::default() }).unwrap()
}

#[test]
fn names_are_read_and_written() {
    for (name, pose) in Pose::NAMES {
        assert_eq!((name.parse(), pose.to_string().as_str()), (Ok(pose), name));
    }
    assert_eq!("Bind".parse::<Pose>(), Err("give file or bind".to_owned()));
    assert_eq!(Options::default().pose, Pose::File);
}

#[test]
fn no_target_is_added() {
    let mut file = Builder::studio();
    let target = file.vectors(&[Vec3::Z; 4]);
    file.json["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": target }]);
    file.json["nodes"][0]["weights"] = json!([1]);
    assert_eq!(file.read().meshes[0].positions[0].z, 1.0);
    let scene = bind(&file);
    assert_eq!((scene.meshes[0].positions[0].z, scene.notices.len()), (0.0, 0));
}

#[test]
fn a_skin_moves_its_mesh_as_one_with_the_joint_nearest_the_root() {
    let mut file = Builder::studio();
    file.bind(0, &[[0, 1, 0, 0]; 4], &[[0.5, 0.5, 0.0, 0.0]; 4]);
    // Modelled in centimetres; the hand comes first in the list, and the hip is above it.
    let hand = file.push("nodes", json!({ "translation": [60, 0, 9] }));
    let hip = file.push("nodes", json!({ "translation": [0, 100, 0], "children": [hand] }));
    let armature = file.push("nodes", json!({ "scale": [0.01, 0.01, 0.01], "children": [hip] }));
    file.json["scenes"][0]["nodes"].as_array_mut().unwrap().push(json!(armature));
    let skin =
        file.skin(&[hand, hip], &[Vec3::new(60.0, 90.0, 0.0), 90.0 * Vec3::Y].map(|at| Mat4::from_translation(-at)));
    file.json["nodes"][0]["skin"] = json!(skin);
    file.json["nodes"][0]["translation"] = json!([7, 7, 7]);
    let expected = Mat4::from_translation(0.1 * Vec3::Y) * Mat4::from_scale(Vec3::splat(0.01));
    let scene = bind(&file);
    assert!(scene.instances[0].world_from_mesh.abs_diff_eq(expected, 1e-6), "{}", scene.instances[0].world_from_mesh);
    assert_eq!(scene.meshes[0].positions[2], Vec3::new(1.0, 1.0, 0.0));
    // Of the file's pose it has half: the hand is raised by 9 cm.
    let scene = file.read();
    assert!((scene.instances[0].world_from_mesh.w_axis.z - 0.045).abs() < 1e-6);
}
