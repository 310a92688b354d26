//! Broken containers, JSON and numbers.

use serde_json::json;

use super::builder::{Builder, glb, read};

/// The one line that is said of `bytes`.
fn error(bytes: &[u8]) -> String {
    let error = read(bytes).expect_err("this is read");
    assert_eq!(error.lines().count(), 1, "{error}");
    error
}

#[test]
fn files_that_are_not_gltf() {
    for (bytes, what) in [
        (&b""[..], "empty"),
        (b"solid cube", "not a glTF file"),
        (b"\x89PNG\r\n\x1a\n", "not a glTF file"),
        (b"\xff\xfe\x00", "not a glTF file"),
        (b"[]", "no object"),
        (b"7", "no object"),
        (b"{}", "no asset"),
        (b"{\"asset\":", "JSON is broken"),
        (b"{\"asset\":{\"version\":\"2.0\"},\"scene\":1e999}", "JSON is broken"),
        (b"{\"asset\":{\"version\":\"2.0\"}}", "no triangles"),
        (b"glTF", "cut short (4 bytes of 12)"),
    ] {
        let error = error(bytes);
        assert!(error.contains(what), "{error}");
    }
}

#[test]
fn a_cut_file_is_an_error_wherever_the_cut_is() {
    let bytes = Builder::studio().glb();
    for length in 0..bytes.len() {
        let error = error(&bytes[..length]);
        assert!(length < 12 || error.contains("cut short"), "{length}: {error}");
    }
    let text = Builder::studio().gltf();
    for length in (0..text.len()).step_by(7) {
        error(&text[..length]);
    }
}

#[test]
fn containers_that_lie() {
    let good = Builder::studio().glb();
    let json_length = u32::from_le_bytes([good[12], good[13], good[14], good[15]]) as usize;
    let binary = 20 + json_length;
    for (at, word, what) in [
        (4, 1, "version 1"),
        (4, 3, "version 3"),
        (8, 4, "4 bytes long"),
        (8, 19, "JSON chunk is cut short"),
        (8, u32::MAX, "cut short"),
        (12, u32::MAX - 3, "JSON chunk is cut short"),
        (12, json_length as u32 - 1, "no multiple of 4"),
        (16, 0x004e4942, "'BIN\\x00'"),
        (binary, u32::MAX - 3, "BIN chunk is cut short"),
        (binary, 0, "buffer 0"),
        (binary + 4, 7, "buffer 0: has no uri"),
    ] {
        let mut bytes = good.clone();
        bytes[at..at + 4].copy_from_slice(&u32::to_le_bytes(word));
        let error = error(&bytes);
        assert!(error.contains(what), "{at}: {error}");
    }
    assert!(error(&glb(b"{\"asset\":", &[])).contains("JSON is broken"));
}

#[test]
fn json_deeper_than_any_stack() {
    let deep = |open: &str, close: &str| {
        let body = open.repeat(1_000_000) + &close.repeat(1_000_000);
        format!("{{\"asset\":{{\"version\":\"2.0\",\"extras\":{body}}}}}")
    };
    for text in [deep("[", "]"), deep("{\"a\":", "}"), "[".repeat(1_000_000)] {
        assert!(error(text.as_bytes()).contains("recursion limit"));
    }
}

#[test]
fn chains_of_nodes_deeper_than_any_stack() {
    const DEPTH: usize = 1_000_000;
    let mut file = Builder::square();
    file.json["nodes"] = json!("CHAIN");
    file.json["scenes"] = json!([{ "nodes": [0] }]);
    let json = file.json.to_string();
    let read_chain = |scale: f32, last: &str| {
        let link = |node: usize| format!("{{\"scale\":[{scale},{scale},{scale}],\"children\":[{}]}},", node + 1);
        let chain: String = (0..DEPTH).map(link).collect();
        read(&glb(json.replace("\"CHAIN\"", &format!("[{chain}{last}]")).as_bytes(), &file.bytes))
    };
    let scene = read_chain(1.0, "{\"mesh\":0}").unwrap();
    assert_eq!(scene.instances[0].world_from_mesh, glam::Mat4::IDENTITY);
    assert!(read_chain(1.0, "{\"mesh\":0,\"children\":[0]}").unwrap_err().contains("cycle"));
    let far = read_chain(2.0, "{\"name\":\"end\",\"mesh\":0}").unwrap_err();
    assert!(far.contains("node 1000000 \"end\": reaches"), "{far}");
}

#[test]
fn more_than_a_file_may_hold() {
    let mut file = Builder::square();
    file.json["materials"] = json!(vec![json!({}); (1 << 20) + 1]);
    assert!(error(&file.glb()).contains("materials: 1048577 entries"));
    // Each primitive is small; together they ask for the same triangles over and over.
    let mut file = Builder::new();
    let indices: Vec<u32> = (0..30_000).map(|index| index % 3).collect();
    let corners = [glam::Vec3::ZERO, glam::Vec3::X, glam::Vec3::Y];
    file.mesh(&corners, None, &indices, None);
    let primitive = file.json["meshes"][0]["primitives"][0].clone();
    file.json["meshes"][0]["primitives"] = json!(vec![primitive; 10_000]);
    file.push("nodes", json!({ "mesh": 0 }));
    assert!(error(&file.glb()).contains("share the same accessors"));
    // What a buffer without data claims to hold does not make that more.
    let mark = json!({ "EXT_meshopt_compression": { "fallback": true } });
    file.push("buffers", json!({ "byteLength": 1u64 << 50, "extensions": mark }));
    assert!(error(&file.glb()).contains("share the same accessors"));
}

#[test]
fn numbers_that_are_none() {
    // Accessors of the studio: positions, normals and indices of the square, then positions and indices of the lamp.
    for (accessor, value, place) in [
        (0, f32::NAN, "mesh 0 primitive 0: accessor 0: element 1"),
        (0, f32::INFINITY, "accessor 0: element 1"),
        (1, f32::NAN, "mesh 0 primitive 0: accessor 1: element 1"),
        (1, f32::NEG_INFINITY, "accessor 1: element 1"),
        (3, f32::NAN, "mesh 1 \"bulb\" primitive 0: accessor 3: element 1"),
    ] {
        let mut file = Builder::studio();
        file.poke(accessor, 16, &value.to_le_bytes());
        let error = error(&file.glb());
        assert!(error.contains(place) && error.contains("finite"), "{error}");
    }
    for (accessor, place) in [(2, "mesh 0 primitive 0"), (4, "mesh 1 \"bulb\" primitive 0")] {
        for index in [4, u32::MAX] {
            let mut file = Builder::studio();
            file.poke(accessor, 20, &index.to_le_bytes());
            let error = error(&file.glb());
            assert!(error.contains(place) && error.contains(&format!("index 5 is {index}")), "{error}");
        }
    }
    let mut file = Builder::studio();
    file.poke(3, 12, &3e38f32.to_le_bytes());
    assert!(error(&file.glb()).contains("node 2 \"lamp\": reaches"));
}

#[test]
fn odd_files_that_are_read() {
    let mut file = Builder::studio();
    // Normals of no length and of huge length, a triangle without area, unused corners.
    file.poke(1, 0, &[0; 12]);
    file.poke(1, 12, bytemuck::cast_slice(&[3e38f32; 3]));
    file.poke(2, 12, bytemuck::cast_slice(&[1u32, 1, 2]));
    let scene = file.read();
    assert_eq!(scene.meshes[0].indices.len(), 3);
    assert_eq!(scene.notices, ["normals of no length are replaced by those of the faces: mesh 0 primitive 0"]);
    for scale in [[0.0, 1.0, 1.0], [1.0, 0.0, 0.0], [0.0; 3], [1e-30, 1.0, 1.0]] {
        let mut file = Builder::studio();
        file.set("/nodes/0/scale", json!(scale));
        let scene = file.read();
        assert_eq!(scene.notices, ["things scaled to nothing are not drawn: node 0 \"square\""]);
        file.set("/nodes/2/scale", json!(scale));
        assert!(error(&file.glb()).contains("no triangles"));
    }
    let mut file = Builder::studio();
    file.set("/nodes/1/scale", json!([1, 1, 0]));
    let scene = file.read();
    assert_eq!(scene.cameras[0].name, "framing");
    assert_eq!(scene.notices.len(), 2);
}
