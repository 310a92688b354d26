//! Compressed geometry: meshopt's views and Draco's primitives, whole and broken.
//!
//! The streams were made once, of the numbers that the tests expect: meshopt's by the encoder of the npm package
//! meshoptimizer 1.3 (level 2, and level 3 for version 1; 8 and 16 bits where filters have less precision than that),
//! Draco's by that of draco3d 1.5 (speed 5; positions of 14 bits, normals of 10, texture coordinates of 12).

use glam::{Vec2, Vec3};
use serde_json::{Value, json};

use super::builder::{Builder, from_base64, picture, read};
use crate::scene::Mesh;
use crate::scene::gltf::decoded::Decoded;
use crate::scene::gltf::{buffers, container, meshopt};
use crate::scene::notices::Notices;

/// The corners of the builder's square, in its order.
const CORNERS: [[f32; 3]; 4] = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
const INDICES: [u32; 6] = [0, 1, 2, 0, 2, 3];

const CORNERS_0: &str = "oAAAAAEzAAAA//8AAAABDAAAAP8AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAIC/AACAvwAAAAA=";
const CORNERS_1: &str = "oerqqgD/AP8AAP8AAAAAAAAAAAAAAACAvwAAgL8AAAAAAAAA";
const TRIANGLES: &str = "4fAAAHaHVmd4qYZliWiYAWkAAA==";
const SEQUENCE: &str = "0QAEBAYIBAAAAAA=";

/// What a view shows of which `stream` says how it is compressed to `bytes`, of `count` times `stride`.
fn shown(name: &str, stream: Value, bytes: &[u8]) -> Result<Vec<u8>, String> {
    let [count, stride] = ["count", "byteStride"].map(|key| stream[key].as_u64().unwrap());
    let mut file = Builder::new();
    file.view(bytes);
    let (length, mut stream) = (count * stride, stream);
    (stream["buffer"], stream["byteLength"]) = (json!(0), json!(bytes.len()));
    let buffer = file.push("buffers", json!({ "byteLength": length }));
    let view = json!({ "buffer": buffer, "byteLength": length, "extensions": { name: stream } });
    let view = file.push("bufferViews", view);
    let glb = file.glb();
    let mut document = container::parse(&glb, &mut Notices::default()).unwrap();
    let mut buffers = buffers::load(&document, None).unwrap();
    let decode = meshopt::decode(&mut Decoded::new(&mut document.root, &mut buffers));
    decode.map_err(|fault| fault.to_string())?;
    Ok(buffers::view(&document.root, &buffers, view).unwrap().to_vec())
}

fn bytes_of<T: bytemuck::NoUninit>(numbers: &[T]) -> Vec<u8> {
    bytemuck::cast_slice(numbers).to_vec()
}

#[test]
fn streams_of_every_mode() {
    let corners = bytes_of(&CORNERS);
    let ramp: Vec<u8> = (0..40u8).flat_map(|i| [i.wrapping_mul(i), 7, i.wrapping_mul(37), u8::from(i > 20)]).collect();
    let narrow = bytes_of(&INDICES.map(|index| index as u16));
    let ramp_0 = "oB8AAgYKDhIWGh4iJiouMjY6PkJGSk5SVlpeYmZqbnJ2ev//AAB+goaKjpKWmgAfAEpKSkpKSkpKSkpKSkpKSkpKSkpKSkpKSkpK\
     SkpKSkr//wAASkpKSkpKSkoEACAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAABwAA";
    let ramp_1 = "oTsAAgYKDhIWGh4iJiouMjY6PkJGSk5SVlpeYmZqbnJ2en6ChoqOkpaaAEpKSkpKSkpKSkpKSkpKSkpKSkpKSkpKSkpKSkpKSkpK\
     SkpKSkpKSgQgAAIAAAAAAAAAAAAAAAAAAAAAAAAAAAcAAAA=";
    for (mode, count, stride, stream, expected) in [
        ("ATTRIBUTES", 4, 12, CORNERS_0, &corners),
        ("ATTRIBUTES", 4, 12, CORNERS_1, &corners),
        ("ATTRIBUTES", 40, 4, ramp_0, &ramp),
        ("ATTRIBUTES", 40, 4, ramp_1, &ramp),
        ("TRIANGLES", 6, 2, TRIANGLES, &narrow),
        ("TRIANGLES", 6, 4, TRIANGLES, &bytes_of(&INDICES)),
        ("INDICES", 6, 2, SEQUENCE, &narrow),
        ("INDICES", 6, 4, SEQUENCE, &bytes_of(&INDICES)),
    ] {
        for name in ["EXT_meshopt_compression", "KHR_meshopt_compression"] {
            let stream_of = json!({ "mode": mode, "count": count, "byteStride": stride });
            assert_eq!(&shown(name, stream_of, &from_base64(stream)).unwrap(), expected, "{mode} {stride}");
        }
    }
}

/// What was decoded is one step at most from these numbers, in [-1, 1], as integers of which `most` is 1.
fn assert_near(decoded: &[f32], exact: &[f32], most: f32) {
    assert_eq!(decoded.len(), exact.len());
    for (decoded, exact) in decoded.iter().zip(exact) {
        assert!((decoded - exact * most).abs() <= 1.0, "{decoded} for {}", exact * most);
    }
}

#[test]
fn filters_undo_what_encoders_do() {
    let shown = |filter: &str, count: usize, stride: usize, stream: &str| {
        let stream_of = json!({ "mode": "ATTRIBUTES", "count": count, "byteStride": stride, "filter": filter });
        shown("KHR_meshopt_compression", stream_of, &from_base64(stream)).unwrap()
    };
    let signed_8 = |bytes: Vec<u8>| bytes.into_iter().map(|byte| f32::from(byte.cast_signed())).collect::<Vec<_>>();
    let word = |pair: &[u8; 2]| u16::from_le_bytes(*pair);
    let words = |bytes: Vec<u8>| bytes.as_chunks().0.iter().map(word).collect::<Vec<_>>();
    let signed_16 = |bytes| words(bytes).into_iter().map(|word| f32::from(word.cast_signed())).collect::<Vec<_>>();
    let axes = [
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, -1.0, 0.0],
        [-0.6, 0.0, 0.8, 0.0],
    ];
    let stream = "oAEzwAAA/f6WAT/AAAD+/f79AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAfwB/AA==";
    assert_near(&signed_8(shown("OCTAHEDRAL", 5, 4, stream)), axes.as_flattened(), 127.0);
    let stream = "oAEhwAAATAEzwAAA/f6UARmAAAABP8AAAP79/v0AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA/38AAP9/AAA=";
    assert_near(&signed_16(shown("OCTAHEDRAL", 5, 8, stream)), axes.as_flattened(), 32767.0);
    let turns = [[0.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 0.0], [0.5; 4], [0.6, 0.0, 0.8, 0.0]];
    let stream = "oAEPAAAA+/wBDwAAALSzAQ8AAAD7NAEPAAAAtCQBDwAAAPv8AQ8AAAC0swEzAAAABQQAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA\
     AAAAAAAA/38=";
    assert_near(&signed_16(shown("QUATERNION", 4, 8, stream)), turns.as_flattened(), 32767.0);
    let colors = [[1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [1.0, 1.0, 1.0, 0.5], [0.2, 0.4, 0.6, 0.0]];
    let stream = "oAE/AAAAfv/OATMAAAD9ZQE8AAAAg/0BDwAAAH1/AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAEB/wf8=";
    let decoded: Vec<f32> = shown("COLOR", 4, 4, stream).into_iter().map(f32::from).collect();
    assert_near(&decoded, colors.as_flattened(), 255.0);
    let stream = "oAETAAAAzgE/AAAAfv/OASMAAABlATMAAAD9ZwE4AAAAAwE8AAAAgf0BCAAAAAEPAAAAfX8AAAAAAAAAAAAAAAAAAAAAAAAAAAAA\
     AAAAQP9/AcD//w==";
    let decoded: Vec<f32> = words(shown("COLOR", 4, 8, stream)).into_iter().map(f32::from).collect();
    assert_near(&decoded, colors.as_flattened(), 65535.0);
    // Powers of two and short sums of them are exact.
    let numbers: [f32; 6] = [-1.0, 0.5, 0.0, 0.0009765625, 1024.0, 3.140625];
    let stream = "oAEwAAAABAABMAAAAEABMAAAABQAAAEwAAAAIAEwAAAAFAEwAAAAQAEwAAAAMgABMAAAABQAAAAAAAAAAAAAAAAAAAAAAAAAAAAA\
     4OsAABDrAAAA6w==";
    assert_eq!(shown("EXPONENTIAL", 2, 12, stream), bytes_of(&numbers));
}

/// The studio whose square's positions and indices are compressed, with a buffer without data in their place.
pub fn packed_studio() -> Builder {
    let mut file = Builder::studio();
    let attributes = json!({ "mode": "ATTRIBUTES", "count": 4, "byteStride": 12 });
    let triangles = json!({ "mode": "TRIANGLES", "count": 6, "byteStride": 4 });
    let mark = json!({ "EXT_meshopt_compression": { "fallback": true } });
    let stand_in = file.push("buffers", json!({ "byteLength": 72, "extensions": mark }));
    for (view, start, length, mut stream, bytes) in
        [(0, 0, 48, attributes, CORNERS_0), (2, 48, 24, triangles, TRIANGLES)]
    {
        let bytes = from_base64(bytes);
        (stream["buffer"], stream["byteOffset"], stream["byteLength"]) =
            (json!(0), json!(file.bytes.len()), json!(bytes.len()));
        // The view that this adds goes at once.
        file.view(&bytes);
        file.json["bufferViews"].as_array_mut().unwrap().pop();
        let extensions = json!({ "EXT_meshopt_compression": stream });
        file.json["bufferViews"][view] =
            json!({ "buffer": stand_in, "byteOffset": start, "byteLength": length, "extensions": extensions });
    }
    file.json["extensionsRequired"] = json!(["EXT_meshopt_compression"]);
    file
}

#[test]
fn compressed_views_are_read_like_others() {
    let plain = Builder::studio().read();
    let mut file = packed_studio();
    let packed = file.read();
    assert_eq!(packed.notices, [""; 0]);
    assert_eq!(packed.meshes[0].positions, plain.meshes[0].positions);
    assert_eq!(packed.meshes[0].indices, plain.meshes[0].indices);
    assert_eq!(packed.lights.len(), plain.lights.len());
    // What the other buffer holds, and whether it is there, does not count.
    file.json["buffers"][1] = json!({ "byteLength": 72, "uri": "gone.bin" });
    assert_eq!(file.read().meshes[0].positions, plain.meshes[0].positions);
    // But for a view that is not compressed.
    file.json["bufferViews"][1]["buffer"] = json!(1);
    assert!(read(&file.glb()).unwrap_err().contains("buffer 1: its URI 'gone.bin' names a file"));
    file.json["buffers"][1] = json!({ "byteLength": 72 });
    assert!(read(&file.glb()).unwrap_err().contains("buffer 1: has no uri"));
}

#[test]
fn broken_views_are_named() {
    let error = |change: &dyn Fn(&mut Value, &mut Value)| {
        let mut file = packed_studio();
        let mut view = file.json["bufferViews"][0].take();
        let mut stream = view["extensions"]["EXT_meshopt_compression"].take();
        change(&mut view, &mut stream);
        view["extensions"]["EXT_meshopt_compression"] = stream;
        file.json["bufferViews"][0] = view;
        let error = read(&file.glb()).expect_err("this is read");
        assert!(error.contains("bufferView 0: ") && error.lines().count() == 1, "{error}");
        error
    };
    for (key, value, what) in [
        ("count", json!(5), "5 elements of 12 bytes are not the 48 bytes of the view"),
        ("byteStride", json!(8), "4 elements of 8 bytes"),
        ("byteOffset", json!(1 << 20), "do not lie in buffer 0"),
        ("byteLength", json!(u64::MAX), "do not lie in buffer 0"),
        ("buffer", json!(7), "do not lie in buffer 7"),
        ("mode", json!("TRIANGLES"), "is broken"),
        ("mode", json!("POINTS"), "POINTS"),
        ("filter", json!("COLOR"), "COLOR filter needs"),
        ("filter", json!("BLUR"), "BLUR"),
        ("mode", json!(null), "EXT_meshopt_compression: mode"),
        ("count", json!(-1), "EXT_meshopt_compression: count"),
    ] {
        let error = error(&|_, stream| stream[key] = value.clone());
        assert!(error.contains(what), "{key}: {error}");
    }
    for length in 0..from_base64(CORNERS_0).len() {
        assert!(error(&|_, stream| stream["byteLength"] = json!(length)).contains("is broken"), "{length}");
    }
    // Elements that are all the same take next to nothing: 4 GiB of them are refused before they are made.
    let error = error(&|view, stream| {
        (view["byteLength"], stream["count"], stream["byteStride"]) = (json!(1u64 << 32), json!(1 << 24), json!(256));
    });
    assert!(error.contains("more than 64 times as long as the file; check it, or"), "{error}");
}

const EDGEBREAKER: &str = "\
     RFJBQ08CAgEBAAAABAIDAgAAAR//ARH/ARH/ARH/AREE/wAAAAAAAQAAAgAAAQAJAwAAAgEBCQMAAQMBAwkCAAICAQICBAADAQEB\
     AQADAwEwARADACiCmAAAAAAA/z8AAAAAgL8AAIC/AAAAAAAAAEAOAAMBAAoDATAbARADAByCAP4D/wMAAP8BAAAKAQEBAAMDASAB\
     IAMA8IOmAAAAAAD/DwAAAAAAAAAAAAAAAIA/DAEBAQAJAwEQARATASADAFCRKWHGvFyGFrAMAAAAAAD/AAAA";
const SEQUENTIAL: &str = "\
     RFJBQ08CAgEAAAACBAEAAQIAAgMBBAAJAwAAAQkDAAEDCQIAAgICBAADAgMCAQABAQADAwEwARADADSCiAQAAAAA/z8AAAADAQAK\
     AwEwGwEQAwAcggD+A/8DAAD/AQAAAAEBAAMDASABIAMAIISGAgAAAAD/DwAAAAEBAAkDARABIBMBEAMAkJBpgGHGvFwGAAAAAP8A\
     AAAAAIC/AACAvwAAAAAAAABADgoAAAAAAAAAAAAAgD8M";

/// The studio with a square from Draco.
pub fn draco_studio() -> Builder {
    studio_of(&from_base64(EDGEBREAKER))
}

/// The studio whose square, textured and with a colour for each corner, is a Draco stream; its accessors have no data.
fn studio_of(stream: &[u8]) -> Builder {
    let mut file = Builder::studio();
    file.texture(&picture(image::ImageFormat::Png, 2, 2));
    file.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = json!({ "index": 0 });
    let view = file.view(stream);
    let mut attributes = json!({});
    for (name, component, kind) in
        [("POSITION", 5126, "VEC3"), ("NORMAL", 5126, "VEC3"), ("TEXCOORD_0", 5126, "VEC2"), ("COLOR_0", 5121, "VEC4")]
    {
        let accessor = json!({ "count": 4, "componentType": component, "type": kind, "normalized": component == 5121 });
        attributes[name] = json!(file.push("accessors", accessor));
    }
    let indices = file.push("accessors", json!({ "count": 6, "componentType": 5125, "type": "SCALAR" }));
    let numbers = json!({ "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2, "COLOR_0": 3 });
    let draco = json!({ "KHR_draco_mesh_compression": { "bufferView": view, "attributes": numbers } });
    file.json["meshes"][0]["primitives"][0] =
        json!({ "attributes": attributes, "indices": indices, "material": 0, "extensions": draco });
    file.json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
    file
}

/// The builder's square in two triangles that face +z, in whatever order its corners are.
fn assert_square(mesh: &Mesh) {
    assert_eq!((mesh.positions.len(), mesh.indices.len()), (4, 6));
    let mut area = Vec3::ZERO;
    for triangle in mesh.indices.as_chunks::<3>().0 {
        let [a, b, c] = triangle.map(|corner| mesh.positions[corner as usize]);
        area += (b - a).cross(c - a) / 2.0;
    }
    assert!(area.abs_diff_eq(Vec3::Z * 4.0, 1e-3), "{area}");
    for (vertex, &position) in mesh.positions.iter().enumerate() {
        let corner = CORNERS.iter().position(|&corner| position.abs_diff_eq(corner.into(), 1e-4)).unwrap();
        assert!(mesh.normals[vertex].abs_diff_eq(Vec3::Z, 1e-3));
        let coords = Vec2::new(position.x + 1.0, 1.0 - position.y) / 2.0;
        assert!(mesh.tex_coords[0][vertex].abs_diff_eq(coords, 1e-3));
        let colors = [[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255], [51, 102, 153, 204]];
        assert_eq!(mesh.colors[vertex], colors[corner].map(|part: u16| part * 257));
    }
}

#[test]
fn draco_streams_become_primitives() {
    for stream in [EDGEBREAKER, SEQUENTIAL] {
        let mut file = studio_of(&from_base64(stream));
        let scene = file.read();
        assert_eq!(scene.notices, [""; 0]);
        assert_square(&scene.meshes[0]);
        // Primitives may share a stream, and be strips, whose triangles are in it.
        let mut strip = file.json["meshes"][0]["primitives"][0].clone();
        strip["mode"] = json!(5);
        file.json["meshes"][0]["primitives"].as_array_mut().unwrap().push(strip);
        let scene = file.read();
        scene.meshes[..2].iter().for_each(assert_square);
        // An attribute outside the stream is read as ever, and one that differs in number is found out.
        let primitive = &mut file.json["meshes"][0]["primitives"][0];
        primitive["extensions"]["KHR_draco_mesh_compression"]["attributes"].as_object_mut().unwrap().remove("COLOR_0");
        let colors = file.accessor(&[0, 255, 0, 0].repeat(4), 4, 5121, "VEC4");
        file.json["accessors"][colors]["normalized"] = json!(true);
        file.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(colors);
        assert_eq!(file.read().meshes[0].colors, [[0, 65535, 0, 0]; 4]);
        file.json["accessors"][colors]["count"] = json!(3);
        assert!(read(&file.glb()).unwrap_err().contains("has 4 positions and 3 colors"));
    }
}

#[test]
fn broken_draco_streams_are_named() {
    let error = |file: &Builder| {
        let error = read(&file.glb()).expect_err("this is read");
        assert!(error.contains("mesh 0 primitive 0: ") && error.lines().count() == 1, "{error}");
        error
    };
    let extension = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
    for (member, value, what) in [
        ("/bufferView", json!(99), "there is no bufferView 99"),
        ("/bufferView", json!(0), "its Draco data is broken"),
        ("/attributes/NORMAL", json!(9), "NORMAL: there is no attribute 9"),
        ("/attributes/NORMAL", json!(-1), "KHR_draco_mesh_compression: attributes"),
        ("/attributes", json!(null), "KHR_draco_mesh_compression: attributes"),
        ("", json!([]), "must be an object"),
    ] {
        let mut file = studio_of(&from_base64(EDGEBREAKER));
        file.set(&format!("{extension}{member}"), value);
        let error = error(&file);
        assert!(error.contains(what), "{member}: {error}");
    }
    for stream in [EDGEBREAKER, SEQUENTIAL].map(from_base64) {
        for length in 1..stream.len() {
            assert!(error(&studio_of(&stream[..length])).contains("its Draco data is broken"), "{length}");
        }
    }
    // Two triangles that claim to be 2^27: `connectivity` follows the head of 11 bytes.
    let claim = [&from_base64(SEQUENTIAL)[..11], &[0x80, 0x80, 0x80, 0x40, 4], &from_base64(SEQUENTIAL)[13..]].concat();
    let error = error(&studio_of(&claim));
    assert!(error.contains("times as long as the file") || error.contains("is broken"), "{error}");
}

#[test]
fn indices_past_the_files_lists_do_not_reach_what_is_decoded() {
    for (list, member, what) in
        [("bufferViews", "buffer", "there is no buffer"), ("accessors", "bufferView", "there is no bufferView")]
    {
        let mut file = packed_studio();
        let target = if member == "buffer" { "buffers" } else { "bufferViews" };
        let past = file.json[target].as_array().unwrap().len();
        let last = file.json[list].as_array().unwrap().len() - 1;
        file.json[list][last][member] = json!(past);
        let error = read(&file.glb()).expect_err("this is read");
        assert!(error.contains(what), "{error}");
    }
}
