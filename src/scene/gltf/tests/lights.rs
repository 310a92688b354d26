//! Lights of extensions, and how many of them a scene bears.

use std::f32::consts::{FRAC_PI_4, PI};
use std::time::{Duration, Instant};

use glam::Vec3;
use serde_json::{Value, json};

use super::builder::{Builder, read};
use crate::scene::tests::shapes::area;
use crate::scene::{PunctualKind, Scene};

const PUNCTUAL: &str = "KHR_lights_punctual";
const AREA: &str = "EXT_lights_area";

/// The studio's square and camera, with a light of an extension at a node.
fn with_light(extension: &str, light: Value, node: Value) -> Builder {
    let mut file = Builder::studio();
    file.json["extensionsRequired"] = json!([extension]);
    file.json["extensions"] = json!({ extension: { "lights": [light] } });
    file.json["nodes"][2] = node;
    file.json["nodes"][2]["extensions"] = json!({ extension: { "light": 0 } });
    file
}

#[test]
fn punctual_lights_have_their_defaults_and_their_places() {
    let node = json!({ "name": "sun", "translation": [1, 2, 3] });
    let scene = with_light(PUNCTUAL, json!({ "type": "point" }), node).read();
    let [light] = &scene.punctual_lights[..] else { panic!("{:?}", scene.punctual_lights) };
    assert_eq!((light.name.as_str(), light.intensity, light.position), ("sun", Vec3::ONE, Vec3::new(1.0, 2.0, 3.0)));
    assert_eq!(light.kind, PunctualKind::Point { range: f32::INFINITY });
    // It lights the scene: no rig is added, and nothing is to be said.
    assert!(scene.lights.is_empty() && scene.notices.is_empty(), "{:?}", scene.notices);
    let half = 0.5f32.sqrt();
    // Turned a quarter about y, the light shines along -x; scales change neither that nor the intensity.
    let node = json!({ "rotation": [0, half, 0, half], "scale": [2, 3, 4] });
    let spot = json!({ "innerConeAngle": 0.25, "outerConeAngle": 0.5 });
    let spot =
        json!({ "name": "lamp", "type": "spot", "color": [1, 0.5, 0], "intensity": 8, "range": 9, "spot": spot });
    let light = &with_light(PUNCTUAL, spot, node.clone()).read().punctual_lights[0];
    assert_eq!((light.name.as_str(), light.intensity), ("lamp", Vec3::new(8.0, 4.0, 0.0)));
    assert!(light.direction.distance(Vec3::NEG_X) < 1e-6);
    assert_eq!(light.kind, PunctualKind::Spot { range: 9.0, inner: 0.25, outer: 0.5 });
    for (light, kind) in [
        (
            json!({ "type": "spot", "spot": {} }),
            PunctualKind::Spot { range: f32::INFINITY, inner: 0.0, outer: FRAC_PI_4 },
        ),
        (json!({ "type": "directional" }), PunctualKind::Directional),
    ] {
        assert_eq!(with_light(PUNCTUAL, light, node.clone()).read().punctual_lights[0].kind, kind);
    }
}

#[test]
fn lights_of_no_intensity_are_dropped() {
    for (extension, kind) in [(PUNCTUAL, "point"), (AREA, "rect")] {
        for light in [json!({ "type": kind, "intensity": 0 }), json!({ "type": kind, "color": [0, 0, 0] })] {
            let scene = with_light(extension, light, json!({})).read();
            assert!(scene.punctual_lights.is_empty());
            assert_eq!(scene.notices, ["nothing in the file lights the scene: key, fill and rim lights are added"]);
        }
    }
}

#[test]
fn bad_lights_are_refused_at_their_place() {
    let spot = |inner: f64, outer: f64| json!({ "innerConeAngle": inner, "outerConeAngle": outer });
    for (extension, kind, member, value, what) in [
        (PUNCTUAL, "point", "type", json!("sphere"), "none of directional, point, spot"),
        (PUNCTUAL, "point", "type", json!(null), "lights[0].type"),
        (PUNCTUAL, "point", "color", json!([1, 1]), "lights[0].color"),
        (PUNCTUAL, "point", "color", json!([1, -1, 1]), "color holds -1"),
        (PUNCTUAL, "point", "intensity", json!(-1), "intensity is -1"),
        (PUNCTUAL, "point", "intensity", json!(1e39), "intensity is inf"),
        (PUNCTUAL, "point", "intensity", json!("bright"), "lights[0].intensity"),
        (PUNCTUAL, "point", "range", json!(-1), "range is -1"),
        (PUNCTUAL, "spot", "spot", spot(0.5, 0.4), "innerConeAngle is 0.5 and outerConeAngle 0.4"),
        (PUNCTUAL, "spot", "spot", spot(0.0, 0.0), "innerConeAngle is 0 and outerConeAngle 0"),
        (PUNCTUAL, "spot", "spot", spot(-0.1, 0.5), "innerConeAngle is -0.1"),
        (PUNCTUAL, "spot", "spot", spot(0.0, 1.6), "outerConeAngle 1.6"),
        (AREA, "rect", "type", json!("sphere"), "neither rect nor disk"),
        (AREA, "rect", "type", json!(3), "lights[0].type"),
        (AREA, "rect", "intensity", json!(-1), "intensity is -1"),
        (AREA, "rect", "size", json!(0), "size is 0.0"),
        (AREA, "disk", "size", json!(-1), "size is -1.0"),
        (AREA, "rect", "rect", json!({ "aspect": 0 }), "rect.aspect is 0.0"),
        (AREA, "rect", "rect", json!({ "aspect": 1e39 }), "rect.aspect is 1e39"),
        (AREA, "rect", "rect", json!({ "aspect": "wide" }), "lights[0].rect.aspect"),
    ] {
        let mut light = json!({ "type": kind });
        light[member] = value;
        // Placed or not.
        let mut file = with_light(extension, light, json!({}));
        for _ in 0..2 {
            let error = read(&file.glb()).unwrap_err();
            assert!(error.contains(extension) && error.contains(what), "{error}");
            assert!(error.contains("; ") && error.lines().count() == 1, "{error}");
            file.json["nodes"][2] = json!({});
        }
    }
    for (extension, kind) in [(PUNCTUAL, "point"), (AREA, "rect")] {
        for (light, what) in
            [(json!(1), "there is no light 1"), (json!(-1), "light"), (json!(null), "light"), (json!(1e300), "light")]
        {
            let mut file = with_light(extension, json!({ "type": kind }), json!({}));
            file.json["nodes"][2]["extensions"][extension]["light"] = light;
            let error = read(&file.glb()).unwrap_err();
            assert!(error.contains("node 2") && error.contains(extension) && error.contains(what), "{error}");
        }
        let far = json!({ "translation": [1e30, 0, 0] });
        assert!(
            read(&with_light(extension, json!({ "type": kind }), far).glb()).unwrap_err().contains("node 2: reaches")
        );
    }
}

/// The one polygon of the only light.
fn polygon(scene: &Scene) -> &crate::scene::Polygon {
    assert_eq!((scene.lights.len(), scene.lights[0].polygons.len()), (1, 1));
    assert!(scene.notices.is_empty() && !scene.lights[0].two_sided, "{:?}", scene.notices);
    &scene.lights[0].polygons[0]
}

#[test]
fn a_rectangle_shines_to_its_nodes_minus_z_under_any_scale() {
    let light =
        json!({ "name": "softbox", "type": "rect", "color": [1, 0.5, 0], "size": 2, "rect": { "aspect": 1.5 } });
    let half = 0.5f32.sqrt();
    for scale in
        [[1.0, 1.0, 1.0], [-1.0, 1.0, 1.0], [1.0, 1.0, -1.0], [-1.0, -1.0, -1.0], [0.5, -2.0, 1.0], [0.0, 0.0, 3.0]]
    {
        let size = scale.iter().fold(0.0f32, |size, part: &f32| size.max(part.abs()));
        for (rotation, normal, up) in
            [([0.0, 0.0, 0.0, 1.0], Vec3::NEG_Z, Vec3::Y), ([half, 0.0, 0.0, half], Vec3::Y, Vec3::Z)]
        {
            let node = json!({ "translation": [0, 5, 0], "scale": scale, "rotation": rotation });
            let scene = with_light(AREA, light.clone(), node).read_without_rig();
            let light = &scene.lights[0];
            assert_eq!((light.name.as_str(), light.radiance), ("softbox", Vec3::new(1000.0, 500.0, 0.0)));
            let polygon = polygon(&scene);
            assert!(polygon.normal.distance(normal) < 1e-6, "{scale:?} {}", polygon.normal);
            assert!((area(polygon) - f64::from(6.0 * size * size)).abs() < 1e-5);
            for corner in &polygon.contours[0] {
                let arm = *corner - Vec3::new(0.0, 5.0, 0.0);
                assert!((arm.dot(up).abs() - size).abs() < 1e-5 && (arm.x.abs() - 1.5 * size).abs() < 1e-5, "{arm}");
            }
            // What is drawn for it is seen from where it shines.
            let instance = &scene.instances[light.instance];
            assert!((instance.world_from_normal() * scene.meshes[instance.mesh].normals[0]).dot(normal) > 0.0);
            assert!(!instance.mirrors());
        }
    }
}

#[test]
fn a_node_of_a_matrix_turns_its_light() {
    // A quarter about y, mirrored in y, stretched.
    let matrix = json!([0, 0, -2, 0, 0, -2, 0, 0, 2, 0, 0, 0, 0, 0, 0, 1]);
    let scene = with_light(AREA, json!({ "type": "rect" }), json!({ "matrix": matrix })).read_without_rig();
    assert!(polygon(&scene).normal.distance(Vec3::NEG_X) < 1e-6);
    assert!((area(polygon(&scene)) - 4.0).abs() < 1e-5);
}

#[test]
fn a_disk_is_a_polygon_of_its_area() {
    let scene =
        with_light(AREA, json!({ "type": "disk", "size": 3 }), json!({ "scale": [1, 1, 2] })).read_without_rig();
    let polygon = polygon(&scene);
    assert_eq!((polygon.contours[0].len(), polygon.normal), (32, Vec3::NEG_Z));
    assert!((area(polygon) / f64::from(9.0 * PI) - 1.0).abs() < 1e-6);
    for corner in &polygon.contours[0] {
        assert!((corner.length() / 3.0 - 1.0).abs() < 0.004);
    }
}

#[test]
fn lights_share_what_is_drawn_for_them_and_vanish_with_their_nodes() {
    let mut file = with_light(AREA, json!({ "type": "rect" }), json!({}));
    for x in 0..255 {
        let node = json!({ "translation": [2 * x, 0, 9], "extensions": { AREA: { "light": 0 } } });
        let node = file.push("nodes", node);
        file.json["scenes"][0]["nodes"].as_array_mut().unwrap().push(json!(node));
    }
    let scene = file.read();
    assert_eq!((scene.lights.len(), scene.meshes.len()), (256, 2));
    let scene = with_light(AREA, json!({ "type": "rect" }), json!({ "scale": [0, 0, 0] })).read();
    assert_eq!(scene.notices[0], "things scaled to nothing are not drawn: node 2");
    // A scene need hold nothing but lights.
    let mut file = with_light(AREA, json!({ "type": "rect" }), json!({}));
    file.json["scenes"][0]["nodes"] = json!([2]);
    assert_eq!(file.read().instances.len(), 1);
}

#[test]
fn very_many_lights_take_seconds_and_one_notice() {
    const COUNT: usize = 250_000;
    let square = Builder::square();
    let emissive = json!([{ "emissiveFactor": [1, 1, 1] }]);
    for (lights, node, lit, notice) in [
        (
            json!({ PUNCTUAL: { "lights": [{ "type": "point" }] } }),
            json!({ "extensions": { PUNCTUAL: { "light": 0 } } }),
            1024,
            "punctual lights past 1024",
        ),
        (
            json!({ AREA: { "lights": [{ "type": "rect" }] } }),
            json!({ "extensions": { AREA: { "light": 0 } } }),
            2048,
            "area lights past 2048",
        ),
        (
            json!({ AREA: { "lights": [{ "type": "disk" }] } }),
            json!({ "extensions": { AREA: { "light": 0 } } }),
            256,
            "area lights past 2048",
        ),
        (json!({}), json!({ "mesh": 0 }), 2048, "emitters past 8192 corners"),
    ] {
        let mut file = Builder { json: square.json.clone(), bytes: square.bytes.clone() };
        if node.get("mesh").is_some() {
            file.json["materials"] = emissive.clone();
        }
        file.json["extensions"] = lights;
        // Side by side: what lies in one place shines once.
        let placed = (0..COUNT).map(|index| {
            let mut node = node.clone();
            node["translation"] = json!([3.0 * (index + 1) as f64, 0.0, 0.0]);
            node
        });
        file.json["nodes"].as_array_mut().unwrap().extend(placed);
        let start = Instant::now();
        let scene = file.read_without_rig();
        // About 1 s; the room is for machines that do other things beside.
        assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
        assert_eq!(scene.lights.len() + scene.punctual_lights.len(), lit, "{notice}");
        let said: Vec<&String> = scene.notices.iter().filter(|line| line.starts_with(notice)).collect();
        assert_eq!(said.len(), 1, "{:?}", scene.notices);
    }
}
