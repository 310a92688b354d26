//! KHR_node_visibility.

use serde_json::json;

use super::builder::{Builder, read};
use crate::scene::Scene;

/// The studio, whose lamp, light and camera hang below one another: a stand, the lamp, the light, the tripod.
fn stand() -> Builder {
    let mut file = Builder::studio();
    file.json["extensions"] = json!({
        "KHR_lights_punctual": { "lights": [{ "type": "point" }] },
        "EXT_lights_area": { "lights": [{ "type": "rect" }] },
    });
    let lights = json!({ "KHR_lights_punctual": { "light": 0 }, "EXT_lights_area": { "light": 0 } });
    let light = file.push("nodes", json!({ "name": "light", "extensions": lights, "children": [1] }));
    file.json["nodes"][2]["children"] = json!([light]);
    let stand = file.push("nodes", json!({ "name": "stand", "children": [2] }));
    file.json["scenes"][0]["nodes"] = json!([0, stand]);
    file.json["extensionsRequired"] = json!(["KHR_node_visibility"]);
    file
}

fn show(file: &mut Builder, node: usize, is_visible: bool) {
    file.json["nodes"][node]["extensions"]["KHR_node_visibility"] = json!({ "visible": is_visible });
}

/// How much of the stand there is: instances, area lights, punctual lights; whether its camera is there.
fn found(scene: &Scene) -> ([usize; 3], bool) {
    let counts = [scene.instances.len(), scene.lights.len(), scene.punctual_lights.len()];
    (counts, scene.cameras[0].name == "eye")
}

#[test]
fn a_hidden_node_hides_all_below_it_but_cameras() {
    let whole = ([3, 2, 1], true);
    assert_eq!(found(&stand().read()), whole);
    for (hidden, left) in [
        // The stand, with the lamp and both lights below it: three lights of the default rig take their place.
        (4, ([4, 3, 0], true)),
        (2, ([4, 3, 0], true)),
        // The lights alone.
        (3, ([2, 1, 0], true)),
        // The node of the camera, and the square.
        (1, whole),
        (0, ([2, 2, 1], true)),
    ] {
        let mut file = stand();
        show(&mut file, hidden, false);
        let scene = file.read();
        assert_eq!(found(&scene), left, "node {hidden}");
        // What is below says in vain that it is visible.
        (0..5).filter(|&node| node != hidden).for_each(|node| show(&mut file, node, true));
        assert_eq!(found(&file.read()), left, "node {hidden}");
    }
}

#[test]
fn nothing_said_is_visible_and_what_is_said_is_a_boolean() {
    let mut file = stand();
    file.json["nodes"][4]["extensions"] = json!({ "KHR_node_visibility": {} });
    assert_eq!(found(&file.read()), ([3, 2, 1], true));
    for value in [json!(0), json!("no"), json!(null), json!([])] {
        file.json["nodes"][4]["extensions"]["KHR_node_visibility"]["visible"] = value;
        let error = file.error();
        assert!(error.contains("node 4 \"stand\": extensions.KHR_node_visibility: visible: invalid type"), "{error}");
    }
}

#[test]
fn what_is_hidden_counts_for_nothing() {
    let mut file = Builder::square();
    let far = file.push("nodes", json!({ "mesh": 0, "translation": [500, 0, 0] }));
    let without = Builder::square().read();
    show(&mut file, far, false);
    let scene = file.read();
    assert_eq!((scene.bounds(), scene.subject()), (without.bounds(), without.subject()));
    assert_eq!(scene.cameras[0].world_from_camera, without.cameras[0].world_from_camera);
    show(&mut file, 0, false);
    assert!(read(&file.glb()).unwrap_err().contains("no triangles to draw"));
}
