//! Valid files in every spelling: numbers, containers, URIs.

use std::fs;

use base64::Engine;
use base64::engine::general_purpose::{STANDARD, STANDARD_NO_PAD};
use glam::Mat4;
use image::ImageFormat;
use serde_json::{Value, json};

use super::builder::{Builder, check, glb, picture, read};
use crate::scene::gltf::Options;
use crate::scene::{Projection, PunctualKind, Scene};

/// What a scene holds.
fn contents(scene: &Scene) -> String {
    format!("{scene:?}")
}

/// A file with every kind of integer: indices, counts, offsets and codes.
fn full() -> Builder {
    let mut file = Builder::textured_studio();
    file.texture(&picture(ImageFormat::Png, 2, 2));
    let sampler = json!({ "magFilter": 9729, "minFilter": 9987, "wrapS": 33071, "wrapT": 33648 });
    let sampler = file.push("samplers", sampler);
    file.json["textures"][0]["sampler"] = json!(sampler);
    let transform = json!({ "texCoord": 0, "scale": [2, 2] });
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] =
        json!({ "index": 0, "texCoord": 0, "extensions": { "KHR_texture_transform": transform } });
    let (indices, values) = (file.view(&[1, 0, 0, 0]), file.view(&[0; 12]));
    file.json["accessors"][0]["byteOffset"] = json!(0);
    file.json["accessors"][0]["sparse"] = json!({
        "count": 1,
        "indices": { "bufferView": indices, "byteOffset": 0, "componentType": 5121 },
        "values": { "bufferView": values, "byteOffset": 0 },
    });
    file.json["bufferViews"][0]["byteStride"] = json!(12);
    file.json["bufferViews"][0]["target"] = json!(34962);
    file.json["meshes"][0]["primitives"][0]["mode"] = json!(4);
    let bound = file.accessor(bytemuck::bytes_of(&Mat4::IDENTITY.to_cols_array()), 1, 5126, "MAT4");
    let joint = file.push("nodes", json!({}));
    file.json["skins"] = json!([{ "joints": [joint], "skeleton": joint, "inverseBindMatrices": bound }]);
    file.json["nodes"][0]["skin"] = json!(0);
    let lamp = file.push("nodes", json!({ "extensions": { "KHR_lights_punctual": { "light": 0 } } }));
    file.push("nodes", json!({ "children": [joint, lamp] }));
    file.json["scenes"] = json!([{ "nodes": [0, 1, 2, lamp + 1] }]);
    file.json["scene"] = json!(0);
    file.json["extensions"] = json!({ "KHR_lights_punctual": { "lights": [{ "type": "point" }] } });
    file
}

/// Every integer with a decimal point.
fn decimal(value: &Value) -> Value {
    match value {
        Value::Number(number) => json!(number.as_f64()),
        Value::Array(list) => list.iter().map(decimal).collect(),
        Value::Object(members) => members.iter().map(|(key, value)| (key.clone(), decimal(value))).collect(),
        other => other.clone(),
    }
}

#[test]
fn integers_may_have_decimal_points_and_exponents() {
    let file = full();
    let plain = contents(&file.read());
    let decimals = decimal(&serde_json::from_slice(&file.gltf()).unwrap()).to_string();
    assert!(decimals.contains("5126.0") && !decimals.contains(":0,"));
    assert_eq!(contents(&read(decimals.as_bytes()).unwrap()), plain);
    // 4.0 as 4e0, and 5126.0 as 5126e0.
    let exponents = decimals.replace(".0,", "e0,").replace(".0}", "e0}").replace(".0]", "e0]");
    assert!(exponents.contains("5126e0"));
    assert_eq!(contents(&read(exponents.as_bytes()).unwrap()), plain);
}

#[test]
fn numbers_that_are_no_integers_stay_so() {
    for (count, what) in [("4.5", "4.5"), ("1e20", "1e+20"), ("-4.0", "-4")] {
        let text = String::from_utf8(Builder::studio().gltf()).unwrap();
        let error = read(text.replacen("\"count\":4", &format!("\"count\":{count}"), 1).as_bytes()).unwrap_err();
        assert!(error.contains("accessors[0].count") && error.contains(what), "{error}");
    }
    let wide =
        String::from_utf8(Builder::studio().gltf()).unwrap().replacen("\"buffer\":0", "\"buffer\":4294967296.0", 1);
    assert!(read(wide.as_bytes()).unwrap_err().contains("index 4294967296 is out of range"));
}

#[test]
fn ranges_are_those_of_the_files_numbers() {
    let mut file = Builder::studio();
    // As 32-bit floats each two are the same.
    let spot = json!({ "innerConeAngle": 0.08968102931976317, "outerConeAngle": 0.08968102931976318 });
    let light = json!({ "type": "spot", "range": 1e39, "spot": spot });
    file.json["extensions"] = json!({ "KHR_lights_punctual": { "lights": [light] } });
    file.json["nodes"][2] = json!({ "extensions": { "KHR_lights_punctual": { "light": 0 } } });
    file.json["cameras"][0]["perspective"] =
        json!({ "yfov": std::f64::consts::PI - 3e-9, "znear": 1, "zfar": 1.00000001 });
    let scene = file.read();
    assert!(scene.notices.is_empty(), "{:?}", scene.notices);
    let PunctualKind::Spot { range, inner, outer } = scene.punctual_lights[0].kind else { panic!() };
    assert_eq!((range, inner), (f32::INFINITY, outer));
    let Projection::Perspective { yfov, near, far } = scene.cameras[0].projection else { panic!() };
    assert!(near == 1.0 && far > near && (0.5 * yfov).tan() > 0.0);
}

#[test]
fn a_byte_order_mark_and_zeros_for_padding() {
    let file = full();
    let plain = contents(&file.read());
    assert_eq!(contents(&read(&[b"\xef\xbb\xbf", &file.gltf()[..]].concat()).unwrap()), plain);
    assert_eq!(contents(&read(&[&file.gltf()[..], &[0; 7]].concat()).unwrap()), plain);
    let mut json = file.json.to_string().into_bytes();
    json.resize((json.len() + 1).next_multiple_of(4), 0);
    assert_eq!(contents(&read(&glb(&json, &file.bytes)).unwrap()), plain);
    json.splice(..0, *b"\xef\xbb\xbf");
    assert_eq!(contents(&read(&glb(&json, &file.bytes)).unwrap()), plain);
}

#[test]
fn chunks_of_unknown_kinds() {
    let file = full();
    let (plain, good) = (contents(&file.read()), file.glb());
    let json_end = 20 + u32::from_le_bytes([good[12], good[13], good[14], good[15]]) as usize;
    let unknown = [&8u32.to_le_bytes()[..], b"NOTE", &[7; 8]].concat();
    for at in [json_end, good.len()] {
        let mut bytes = good.clone();
        bytes.splice(at..at, unknown.iter().copied());
        let length = bytes.len() as u32;
        bytes[8..12].copy_from_slice(&length.to_le_bytes());
        assert_eq!(contents(&read(&bytes).unwrap()), plain, "{at}");
        // What follows the length that the file states is ignored.
        bytes.extend([1, 2, 3]);
        assert_eq!(contents(&read(&bytes).unwrap()), plain, "{at}");
    }
}

#[test]
fn data_in_uris() {
    let file = full();
    let plain = contents(&file.read());
    let percent: String = file.bytes.iter().map(|byte| format!("%{byte:02x}")).collect();
    for uri in [
        format!("DATA:application/octet-stream;BASE64,{}", STANDARD.encode(&file.bytes)),
        format!("data:;base64,{}", STANDARD_NO_PAD.encode(&file.bytes)),
        format!("data:,{percent}"),
        format!("data:application/gltf-buffer;base64,{}", STANDARD.encode(&file.bytes).replace('=', "%3D")),
    ] {
        let mut json = file.json.clone();
        json["buffers"][0] = json!({ "uri": uri, "byteLength": file.bytes.len() });
        assert_eq!(contents(&read(json.to_string().as_bytes()).unwrap()), plain, "{}", &uri[..40]);
    }
}

#[test]
fn paths_with_dot_segments() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("maps")).unwrap();
    fs::create_dir(folder.path().join("scene")).unwrap();
    let file = full();
    fs::write(folder.path().join("scene/1:1.bin"), &file.bytes).unwrap();
    fs::write(folder.path().join("outside.bin"), &file.bytes).unwrap();
    let load = |uri: &str| {
        let mut json = file.json.clone();
        json["buffers"][0] = json!({ "uri": uri, "byteLength": file.bytes.len() });
        let path = folder.path().join("scene/scene.gltf");
        fs::write(&path, json.to_string()).unwrap();
        crate::scene::gltf::load(&path, &Options::default()).map_err(|error| error.to_string())
    };
    for uri in [
        "1:1.bin",
        "./1:1.bin",
        "maps/../1:1.bin",
        ".//1:1.bin",
        "maps//..//1:1.bin",
        "nowhere/deep/.././../1%3A1.bin",
        "%2E/1:1.bin?x=1#top",
    ] {
        check(&load(uri).unwrap_or_else(|error| panic!("{uri}: {error}")));
    }
    for uri in ["../outside.bin", "maps/../../outside.bin", "%2e%2E/outside.bin", "/1:1.bin", "//host/1:1.bin"] {
        assert!(load(uri).unwrap_err().contains("leads out of the scene's folder"), "{uri}");
    }
    for (uri, what) in [
        ("HTTP://host/1.bin", "has a scheme"),
        ("maps/..", "is a folder"),
        ("./", "is a folder"),
        ("?", "names no file"),
        ("maps/..%2f..%2foutside.bin", "names no file"),
    ] {
        assert!(load(uri).unwrap_err().contains(what), "{uri}");
    }
}

#[test]
fn elements_that_no_view_holds_are_zero() {
    let mut file = full();
    file.json["accessors"][1] = json!({ "count": 4, "componentType": 5126, "type": "VEC3" });
    let scene = file.read();
    assert_eq!(scene.notices[0], "normals of no length are replaced by those of the faces: mesh 0 primitive 0");
    assert_eq!(scene.meshes[0].normals, [glam::Vec3::Z; 4]);
    file.json["accessors"][0] = json!({ "count": 4, "componentType": 5126, "type": "VEC3" });
    file.json["scenes"] = json!([{ "nodes": [0, 1] }]);
    assert!(read(&file.glb()).unwrap_err().contains("no triangles to draw"));
}
