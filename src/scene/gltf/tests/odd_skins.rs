//! Skins that crush what they move, odd weights, and broken or hostile skins.

use glam::{Mat4, Vec3};
use serde_json::json;

use super::skins::{CORNERS, assert_near, posed, square, turned};

#[test]
fn what_joints_crush_has_normals_still() {
    let half_turn = json!({ "rotation": [0, 0, 1, 0] });
    // To a line, to points, and to a plane.
    for (joint, weights) in [
        (half_turn, [0.5, 0.5, 0.0, 0.0]),
        (json!({ "scale": [0, 0, 0] }), [0.0, 1.0, 0.0, 0.0]),
        (json!({ "scale": [1, 1, 0] }), [0.0, 1.0, 0.0, 0.0]),
        (json!({ "scale": [1e-30, 1e-30, 1e-30] }), [0.0, 1.0, 0.0, 0.0]),
    ] {
        let mut file = square([json!({}), joint], [Mat4::IDENTITY; 2], [1.0, 0.0]);
        // One corner is crushed. The others go with the first joint, so that there is a triangle left.
        let still = [1.0, 0.0, 0.0, 0.0];
        file.bind(0, &[[0, 1, 0, 0]; 4], &[still, weights, still, still]);
        let scene = file.read();
        // Each scene that is read has unit normals and finite positions; here they are on their side still.
        assert!(posed(&scene).1.normals.iter().all(|normal| normal.z > 0.999), "{:?}", posed(&scene).1.normals);
    }
}

#[test]
fn what_a_pose_leaves_nothing_of_is_said() {
    let joints = [json!({ "scale": [0, 0, 0] }), json!({ "translation": [0, 0, 2], "scale": [0, 0, 0] })];
    let scene = square(joints, [Mat4::IDENTITY; 2], [0.5, 0.5]).read();
    assert_eq!(scene.instances.len(), 1);
    assert_eq!(scene.notices, ["meshes that their pose leaves without area are not drawn: mesh 0 primitive 0"]);
}

#[test]
fn odd_weights_are_drawn_and_said() {
    let (joints, bound) = turned();
    for (weights, of_joints, kind) in [
        ([0.0; 4], [1, 0, 0, 0], "vertices to which no joint has a weight go with their first joint"),
        ([0.0, 2.0, -1.0, 0.0], [0, 1, 0, 0], "weights of joints below 0 are taken to be 0"),
        ([0.0, 2.0, 0.0, 0.0], [9, 1, 0, 0], "joints of no weight that the skin does not have are passed over"),
    ] {
        let mut file = square(joints.clone(), bound, [0.25, 0.75]);
        file.bind(0, &[of_joints; 4], &[weights; 4]);
        let scene = file.read();
        assert_eq!(scene.notices, [format!("{kind}: mesh 0 primitive 0")]);
        assert_near(&posed(&scene).2, &CORNERS.map(|at| Vec3::new(1.0 - at.y, at.x + 1.0, 0.0)));
    }
}

#[test]
fn bad_skins() {
    let (joints, bound) = turned();
    // Accessors: joints 5, weights 6, inverse bind matrices 7.
    for (pointer, value, what) in [
        ("/accessors/7/count", json!(1), "skin 0: has 2 joints and fewer inverseBindMatrices"),
        ("/accessors/7/type", json!("VEC4"), "skin 0: accessor 7: must be Mat4"),
        ("/skins/0/inverseBindMatrices", json!(99), "skin 0: there is no accessor 99"),
        ("/skins/0/joints/1", json!(99), "skin 0: there is no node 99"),
        ("/nodes/4/translation", json!([0, 0, 3e38]), "skin 0: joint 1 moves things by"),
        ("/nodes/4/children", json!([4]), "node 4: is its own ancestor"),
        ("/accessors/5/count", json!(3), "mesh 0 primitive 0: has 4 positions and 3 joints"),
        ("/accessors/6/count", json!(3), "mesh 0 primitive 0: has 4 positions and 3 weights"),
        ("/accessors/5/componentType", json!(5120), "accessor 5: must be Vec4 of component type 5121, 5123"),
        ("/accessors/6/componentType", json!(5125), "accessor 6: must be Vec4 of component type 5126, 5121, 5123"),
        ("/meshes/0/primitives/0/attributes/JOINTS_0", json!(99), "mesh 0 primitive 0: there is no accessor 99"),
    ] {
        let mut file = square(joints.clone(), bound, [0.25, 0.75]);
        file.set(pointer, value);
        let error = file.error();
        assert!(error.contains(what), "{error}");
    }
    for (accessor, offset, bytes, what) in [
        (5, 4, vec![2], "mesh 0 primitive 0: vertex 1 is bound to joint 2 of 2"),
        (5, 0, vec![255], "vertex 0 is bound to joint 255 of 2"),
        (6, 20, f32::NAN.to_le_bytes().to_vec(), "accessor 6: element 1 is [0.25, NaN, 0.0, 0.0]"),
        (6, 0, f32::INFINITY.to_le_bytes().to_vec(), "accessor 6: element 0"),
        (7, 8, f32::NAN.to_le_bytes().to_vec(), "skin 0: accessor 7: element 0"),
        (7, 0, 1e38f32.to_le_bytes().to_vec(), "skin 0: joint 0 moves things by 1.00e38"),
        (0, 0, 3e38f32.to_le_bytes().to_vec(), "mesh 0 primitive 0: vertex 0 is posed"),
    ] {
        let mut file = square(joints.clone(), bound, [0.25, 0.75]);
        file.poke(accessor, offset, &bytes);
        let error = file.error();
        assert!(error.contains(what), "{error}");
    }
}

#[test]
fn few_bytes_do_not_become_many_matrices() {
    let (joints, bound) = turned();
    // A joint takes two bytes of JSON, and its matrices a hundred times that.
    let mut file = square(joints, bound, [0.25, 0.75]);
    file.json["skins"] = json!(vec![json!({ "joints": vec![3; 100_000] }); 10]);
    let node = |skin: usize| json!({ "mesh": 0, "skin": skin });
    file.json["scenes"][0]["nodes"] = json!([]);
    for skin in 0..10 {
        let node = file.push("nodes", node(skin));
        file.json["scenes"][0]["nodes"].as_array_mut().unwrap().push(json!(node));
    }
    assert!(file.error().contains("share the same accessors"));
}
