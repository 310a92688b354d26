//! EXT_mesh_gpu_instancing.

use std::f32::consts::FRAC_1_SQRT_2;
use std::time::{Duration, Instant};

use glam::{Mat4, Vec3};
use serde_json::{Value, json};

use super::builder::{Builder, picture};

/// The studio's node 0 or 2, the square or the lamp, at these accessors.
fn instanced(file: &mut Builder, node: usize, attributes: Value) {
    file.json["nodes"][node]["extensions"] = json!({ "EXT_mesh_gpu_instancing": { "attributes": attributes } });
    file.json["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
}

fn quaternions(file: &mut Builder, rotations: &[[f32; 4]]) -> usize {
    file.accessor(bytemuck::cast_slice(rotations), rotations.len(), 5126, "VEC4")
}

#[test]
fn each_instance_is_moved_turned_and_scaled_and_then_goes_with_the_node() {
    let mut file = Builder::studio();
    let translation = file.vectors(&[Vec3::ZERO, Vec3::X, Vec3::new(0.0, 2.0, -1.0)]);
    // None, a quarter turn about z whose quaternion is twice too long, and half a turn about x.
    let rotation = quaternions(&mut file, &[[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 2.0, 2.0], [1.0, 0.0, 0.0, 0.0]]);
    let scale = file.vectors(&[Vec3::ONE, Vec3::new(1.0, 3.0, 1.0), Vec3::splat(0.5)]);
    instanced(&mut file, 0, json!({ "TRANSLATION": translation, "ROTATION": rotation, "SCALE": scale, "_ID": 99 }));
    file.json["nodes"][0]["translation"] = json!([0, 0, 7]);
    let scene = file.read();
    assert!(scene.notices.is_empty(), "{:?}", scene.notices);
    assert_eq!((scene.instances.len(), scene.meshes.len()), (4, 2));
    // Where the square's corner (1, 1, 0) goes.
    let corner = |at: usize| scene.instances[at].world_from_mesh.transform_point3(Vec3::new(1.0, 1.0, 0.0));
    for (at, expected) in [[1.0, 1.0, 7.0], [-2.0, 1.0, 7.0], [0.5, 1.5, 6.0]].into_iter().enumerate() {
        assert!(corner(at).abs_diff_eq(Vec3::from(expected), 1e-6), "{at}: {}", corner(at));
    }
    assert!(scene.instances[..3].iter().all(|instance| instance.name == "square" && instance.mesh == 0));
}

#[test]
fn rotations_may_be_normalized_integers() {
    let turned = Mat4::from_rotation_z(std::f32::consts::FRAC_PI_2);
    let shorts = (FRAC_1_SQRT_2 * 32767.0).round() as i16;
    let bytes = (FRAC_1_SQRT_2 * 127.0).round() as i8;
    let shorts = [0, 0, shorts, shorts];
    let bytes = [0, 0, bytes, bytes];
    for (component, bytes) in [(5122, bytemuck::cast_slice(&shorts)), (5120, bytemuck::cast_slice(&bytes))] {
        let mut file = Builder::studio();
        let rotation = file.accessor(bytes, 1, component, "VEC4");
        file.json["accessors"][rotation]["normalized"] = json!(true);
        instanced(&mut file, 0, json!({ "ROTATION": rotation }));
        assert!(file.read().instances[0].world_from_mesh.abs_diff_eq(turned, 1e-6), "{component}");
    }
}

#[test]
fn instances_of_a_lamp_are_lights() {
    let mut file = Builder::studio();
    let translation = file.vectors(&[Vec3::ZERO, 3.0 * Vec3::X, Vec3::Y]);
    // The third is scaled to nothing.
    let scale = file.vectors(&[Vec3::ONE, Vec3::splat(2.0), Vec3::ZERO]);
    instanced(&mut file, 2, json!({ "TRANSLATION": translation, "SCALE": scale }));
    file.json["nodes"][2]["rotation"] = json!([0, 0, 0, 1]);
    let scene = file.read();
    assert_eq!(scene.notices, ["things scaled to nothing are not drawn: node 2 \"lamp\""]);
    assert_eq!(scene.lights.len(), 2);
    let least = |light: usize| scene.lights[light].polygons[0].contours[0].iter().copied().reduce(Vec3::min).unwrap();
    assert_eq!([least(0), least(1)], [Vec3::new(-1.0, -1.0, 3.0), Vec3::new(1.0, -2.0, 6.0)]);
    // As many as scenes may have corners for.
    let mut file = Builder::studio();
    let many: Vec<Vec3> = (0..3000).map(|at| 3.0 * at as f32 * Vec3::X).collect();
    let translation = file.vectors(&many);
    instanced(&mut file, 2, json!({ "TRANSLATION": translation }));
    let scene = file.read();
    assert_eq!((scene.instances.len(), scene.lights.len()), (3001, 2048));
    assert!(scene.notices[0].contains("past 8192 corners"), "{:?}", scene.notices);
}

#[test]
fn a_textures_mean_is_found_once_for_all_instances() {
    let mut file = Builder::textured_studio();
    let corners = file.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"].as_u64().unwrap();
    file.attribute(1, "TEXCOORD_0", corners as usize);
    let texture = file.texture(&picture(image::ImageFormat::Png, 512, 512));
    file.json["materials"][1]["emissiveTexture"] = json!({ "index": texture });
    let many: Vec<Vec3> = (0..2000).map(|at| 3.0 * at as f32 * Vec3::X).collect();
    let translation = file.vectors(&many);
    instanced(&mut file, 2, json!({ "TRANSLATION": translation }));
    let start = Instant::now();
    let scene = file.read();
    // Once takes a second where nothing is optimized; 2000 times would take half an hour.
    assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
    assert_eq!(scene.lights.len(), 2000);
    assert!(scene.lights.iter().all(|light| light.radiance.abs_diff_eq(scene.lights[0].radiance, 1e-5)));
}

#[test]
fn a_node_without_attributes_stands_once_and_one_without_a_mesh_nowhere() {
    let mut file = Builder::studio();
    instanced(&mut file, 0, json!({}));
    assert_eq!(file.read().instances.len(), 2);
    let translation = file.vectors(&[Vec3::ZERO; 5]);
    instanced(&mut file, 1, json!({ "TRANSLATION": translation }));
    assert_eq!(file.read().instances.len(), 2);
}

#[test]
fn bad_instances() {
    let place = "node 0 \"square\": EXT_mesh_gpu_instancing: ";
    let (two, three) = ([Vec3::ONE; 2], [Vec3::ONE; 3]);
    let mut file = Builder::studio();
    let [two, three] = [file.vectors(&two), file.vectors(&three)];
    let nowhere = quaternions(&mut file, &[[0.0, 0.0, 0.0, 1.0], [0.0; 4]]);
    let not_finite = file.vectors(&[Vec3::NAN]);
    let bytes = file.accessor(&[0; 4], 1, 5121, "VEC4");
    for (attributes, what) in [
        (json!({ "TRANSLATION": two, "SCALE": three }), "one has 2 elements and one 3"),
        (json!({ "ROTATION": nowhere }), "rotation 1 is a quaternion of length 0"),
        (json!({ "TRANSLATION": not_finite }), "element 0 is [NaN, NaN, NaN]"),
        (json!({ "TRANSLATION": 999 }), "there is no accessor 999"),
        (json!({ "ROTATION": bytes }), "must be Vec4 of component type 5126, 5120, 5122"),
        (json!({ "SCALE": nowhere }), "must be Vec3 of component type 5126"),
    ] {
        instanced(&mut file, 0, attributes);
        let error = file.error();
        assert!(error.contains(place) && error.contains(what), "{error}");
    }
    for attributes in [json!({ "TRANSLATION": "x" }), json!({ "TRANSLATION": -1 }), json!([])] {
        instanced(&mut file, 0, attributes);
        let error = file.error();
        assert!(error.contains("node 0 \"square\": extensions.EXT_mesh_gpu_instancing: attributes"), "{error}");
    }
}

/// The studio with an accessor of three floats that claims this many elements and has one.
fn claiming(count: u32) -> (Builder, usize) {
    let mut file = Builder::studio();
    let index = file.view(&[0; 4]);
    let value = file.view(&[0; 12]);
    let sparse = json!({
        "count": 1,
        "indices": { "bufferView": index, "componentType": 5125 },
        "values": { "bufferView": value },
    });
    let accessor = json!({ "count": count, "componentType": 5126, "type": "VEC3", "sparse": sparse });
    let accessor = file.push("accessors", accessor);
    (file, accessor)
}

#[test]
fn few_bytes_do_not_become_many_instances() {
    let (mut file, claim) = claiming(u32::MAX);
    instanced(&mut file, 0, json!({ "TRANSLATION": claim }));
    assert!(file.error().contains("4294967295 instances are more than are served"));
    // As many as are served would take more memory than so small a file may.
    let (mut file, claim) = claiming(1 << 19);
    instanced(&mut file, 0, json!({ "TRANSLATION": claim }));
    assert!(file.error().contains("instances share the same accessors"));
    // Those that are scaled to nothing are counted too, or a million nodes of a million would take forever.
    let (mut file, claim) = claiming(1 << 12);
    instanced(&mut file, 0, json!({ "SCALE": claim }));
    let node = file.json["nodes"][0].clone();
    file.json["nodes"] = json!(vec![node; 1 << 12]);
    file.json["scenes"] = json!([]);
    file.json.as_object_mut().unwrap().remove("scene");
    let error = file.error();
    assert!(error.contains("more than are served") || error.contains("share the same accessors"), "{error}");
}
