//! Good files, changed at random: each gives a whole scene or an error in one line, in no time.

use std::time::{Duration, Instant};

use glam::Vec3;
use image::ImageFormat;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;
use serde_json::{Value, json};

use super::builder::{Builder, glb, picture, read};
use super::{compressed, ktx2};

/// Reads `bytes`; `read` checks the scene. Tells whether there is one.
fn survives(bytes: &[u8]) -> bool {
    let start = Instant::now();
    let read = read(bytes);
    // A thousandth of a second is usual; the room is for machines that do other things beside.
    assert!(start.elapsed() < Duration::from_secs(10), "{:?}", start.elapsed());
    if let Err(error) = &read {
        assert_eq!(error.lines().count(), 1, "{error}");
        assert!(error.len() < 1000, "{error}");
    }
    read.is_ok()
}

#[test]
fn changed_bytes() {
    let mut random = Pcg32::seed_from_u64(1);
    let good = Builder::studio().glb();
    let mut read = 0;
    const ROUNDS: usize = 4000;
    for _ in 0..ROUNDS {
        let mut bytes = good.clone();
        for _ in 0..random.random_range(1..4) {
            let at = random.random_range(0..bytes.len());
            match random.random_range(0..4) {
                0 => bytes[at] ^= 1 << random.random_range(0..8),
                1 => bytes[at] = random.random(),
                2 => bytes.truncate(at + 1),
                _ => drop(bytes.splice(at..at, [random.random(), random.random()])),
            }
        }
        read += usize::from(survives(&bytes));
    }
    // Both ends are met.
    assert!(read > ROUNDS / 100 && read < ROUNDS / 2, "{read} of {ROUNDS} are read");
}

#[test]
fn changed_bytes_of_the_buffer() {
    let mut random = Pcg32::seed_from_u64(2);
    const ROUNDS: usize = 4000;
    for file in [Builder::studio(), workshop()] {
        let read = read_with_changed_buffer(&file, &mut random, ROUNDS);
        assert!(read > ROUNDS / 10 && read < ROUNDS, "{read} of {ROUNDS} are read");
    }
}

/// How many of so many copies of a file with changed buffers are read.
fn read_with_changed_buffer(file: &Builder, random: &mut Pcg32, rounds: usize) -> usize {
    let json = file.json.to_string();
    let mut read = 0;
    for _ in 0..rounds {
        let mut bytes = file.bytes.clone();
        for _ in 0..random.random_range(1..6) {
            let at = random.random_range(0..bytes.len());
            bytes[at] = random.random();
        }
        read += usize::from(survives(&glb(json.as_bytes(), &bytes)));
    }
    read
}

#[test]
fn changed_values() {
    let mut random = Pcg32::seed_from_u64(3);
    const ROUNDS: usize = 6000;
    for file in [Builder::studio(), workshop(), dressed()] {
        let read = read_with_changed_values(&file, &mut random, ROUNDS);
        assert!(read > ROUNDS / 100 && read < ROUNDS / 2, "{read} of {ROUNDS} are read");
    }
}

#[test]
fn changed_bytes_of_images() {
    let mut random = Pcg32::seed_from_u64(5);
    let file = dressed();
    let json = file.json.to_string();
    let views = &file.json["bufferViews"].as_array().unwrap()[5..];
    let mut read = 0;
    const ROUNDS: usize = 2000;
    for _ in 0..ROUNDS {
        let mut bytes = file.bytes.clone();
        let view = &views[random.random_range(0..views.len())];
        let [start, length] = ["byteOffset", "byteLength"].map(|key| view[key].as_u64().unwrap() as usize);
        for _ in 0..random.random_range(1..4) {
            bytes[start + random.random_range(0..length)] = random.random();
        }
        read += usize::from(survives(&glb(json.as_bytes(), &bytes)));
    }
    assert!(read > ROUNDS / 20 && read < ROUNDS, "{read} of {ROUNDS} are read");
}

#[test]
fn changed_bytes_of_compressed_data() {
    let mut random = Pcg32::seed_from_u64(6);
    const ROUNDS: usize = 2000;
    let [mipmapped, plain, etc1s] = ktx2::files().map(|file| ktx2::with_image(&file));
    for file in [compressed::packed_studio(), compressed::draco_studio(), mipmapped, plain, etc1s] {
        let read = read_with_changed_buffer(&file, &mut random, ROUNDS);
        assert!(read > ROUNDS / 20 && read < ROUNDS, "{read} of {ROUNDS} are read");
        let read = read_with_changed_values(&file, &mut random, ROUNDS);
        assert!(read > ROUNDS / 100 && read < ROUNDS / 2, "{read} of {ROUNDS} are read");
    }
}

/// The studio with every extension of materials, and images of every format.
fn dressed() -> Builder {
    let mut file = Builder::studio();
    for format in [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::WebP] {
        file.texture(&picture(format, 6, 5));
    }
    file.json["textures"][2] =
        json!({ "sampler": 0, "source": 0, "extensions": { "EXT_texture_webp": { "source": 2 } } });
    file.push("samplers", json!({ "magFilter": 9728, "minFilter": 9985, "wrapS": 33071, "wrapT": 33648 }));
    let transform = json!({ "offset": [0.5, 0.5], "rotation": 1.0, "scale": [2, 3], "texCoord": 1 });
    let info = |index: usize| json!({ "index": index, "extensions": { "KHR_texture_transform": transform } });
    let material = &mut file.json["materials"][0];
    material["pbrMetallicRoughness"]["baseColorTexture"] = info(0);
    material["normalTexture"] = json!({ "index": 1, "scale": 0.5 });
    material["occlusionTexture"] = json!({ "index": 0, "strength": 0.5, "texCoord": 1 });
    (material["alphaMode"], material["alphaCutoff"]) = (json!("MASK"), json!(0.25));
    material["extensions"] = json!({
        "KHR_materials_fuzz": { "fuzzFactor": 0.5, "fuzzTexture": info(1), "fuzzColorFactor": [1, 0.5, 0] },
        "KHR_materials_ior": { "ior": 1.4 },
        "KHR_materials_sheen": { "sheenColorFactor": [1, 0.5, 0], "sheenColorTexture": info(2) },
        "KHR_materials_specular": { "specularColorFactor": [2, 1, 1], "specularColorTexture": info(2) },
    });
    file.json["materials"][1]["emissiveTexture"] = info(2);
    file
}

/// How many of so many copies of a file with changed values are read.
fn read_with_changed_values(file: &Builder, random: &mut Pcg32, rounds: usize) -> usize {
    let mut pointers = Vec::new();
    collect(&file.json, String::new(), &mut pointers);
    let mut read = 0;
    for _ in 0..rounds {
        let mut json = file.json.clone();
        for _ in 0..random.random_range(1..3) {
            let pointer = &pointers[random.random_range(0..pointers.len())];
            change(&mut json, pointer, random);
        }
        read += usize::from(survives(&glb(json.to_string().as_bytes(), &file.bytes)));
    }
    read
}

/// The studio with a sheet that is quantized, sparse, coloured, mapped, morphed and skinned, two lamps that are
/// instances, and lights of every kind.
fn workshop() -> Builder {
    let mut file = Builder::studio();
    let positions: [i8; 16] = [-100, -100, 0, 0, 100, -100, 0, 0, 100, 100, 0, 0, -100, 100, 0, 0];
    let positions = file.accessor(bytemuck::cast_slice(&positions), 4, 5120, "VEC3");
    file.json["bufferViews"][positions]["byteStride"] = json!(4);
    file.json["accessors"][positions]["normalized"] = json!(true);
    let replaced = [file.accessor(&[1, 3], 2, 5121, "SCALAR"), file.accessor(&[90, 0, 5, 0, 90, 250], 2, 5120, "VEC3")];
    let indices = json!({ "bufferView": replaced[0], "componentType": 5121 });
    file.json["accessors"][positions]["sparse"] =
        json!({ "count": 2, "indices": indices, "values": { "bufferView": replaced[1] } });
    let normals = file.accessor(&[0, 0, 127].repeat(4), 4, 5120, "VEC3");
    let tangents = file.accessor(&[127, 0, 0, 127].repeat(4), 4, 5120, "VEC4");
    let coords = file.accessor(&[0, 0, 255, 0, 255, 255, 0, 255], 4, 5121, "VEC2");
    let colors = file.accessor(&[9, 99, 250].repeat(4), 4, 5121, "VEC3");
    file.json["accessors"][colors]["normalized"] = json!(true);
    let attributes = json!({
        "POSITION": positions, "NORMAL": normals, "TANGENT": tangents, "TEXCOORD_0": coords, "COLOR_0": colors,
    });
    let mesh = file.json["meshes"][0]["primitives"][0].as_object_mut().unwrap();
    mesh.insert("attributes".to_owned(), attributes);
    file.bind(0, &[[0, 1, 0, 0]; 4], &[[0.25, 0.75, 0.0, 0.0]; 4]);
    let joint = file.push("nodes", json!({ "translation": [0, 0.25, 0], "rotation": [0.0, 0.0, 0.6, 0.8] }));
    file.json["nodes"][0]["skin"] = json!(file.skin(&[1, joint], &[glam::Mat4::IDENTITY; 2]));
    let target =
        json!({ "POSITION": file.vectors(&[Vec3::Z; 4]), "NORMAL": file.vectors(&[Vec3::X; 4]), "COLOR_0": colors });
    file.json["meshes"][0]["primitives"][0]["targets"] = json!([{ "TEXCOORD_0": coords }, target]);
    (file.json["meshes"][0]["weights"], file.json["nodes"][0]["weights"]) = (json!([0.5, 0.0]), json!([0.0, 0.5]));
    let spot = json!({ "type": "spot", "range": 9, "spot": { "innerConeAngle": 0.1, "outerConeAngle": 0.7 } });
    let rect = json!({ "type": "rect", "size": 2, "color": [1, 1, 0], "rect": { "aspect": 2 } });
    file.json["extensions"] = json!({
        "KHR_lights_punctual": { "lights": [spot, { "type": "point" }, { "type": "directional", "intensity": 3 }] },
        "EXT_lights_area": { "lights": [rect, { "type": "disk", "intensity": 5 }] },
    });
    for (node, (punctual, area)) in [(0, 0), (1, 1), (2, 0)].into_iter().enumerate() {
        let lights = json!({ "KHR_lights_punctual": { "light": punctual }, "EXT_lights_area": { "light": area } });
        file.json["nodes"][node]["extensions"] = lights;
    }
    let [places, sizes] = [[Vec3::ZERO, Vec3::X], [Vec3::ONE, Vec3::splat(0.5)]].map(|vectors| file.vectors(&vectors));
    let turns = file.accessor(&[0, 0, 90, 90, 0, 127, 0, 0], 2, 5120, "VEC4");
    let instancing = json!({ "attributes": { "TRANSLATION": places, "ROTATION": turns, "SCALE": sizes } });
    file.json["nodes"][2]["extensions"]["EXT_mesh_gpu_instancing"] = instancing;
    file.json["nodes"][2]["extensions"]["KHR_node_visibility"] = json!({ "visible": true });
    file
}

#[test]
fn the_workshop_itself_is_read() {
    let scene = workshop().read();
    assert_eq!((scene.punctual_lights.len(), scene.lights.len(), scene.notices.len()), (3, 5, 0));
    assert!(!scene.meshes[0].colors.is_empty());
}
/// The JSON pointers of all values below the root.
fn collect(value: &Value, pointer: String, pointers: &mut Vec<String>) {
    match value {
        Value::Object(members) => {
            members.iter().for_each(|(key, member)| collect(member, format!("{pointer}/{key}"), pointers));
        }
        Value::Array(elements) => {
            elements.iter().enumerate().for_each(|(at, element)| collect(element, format!("{pointer}/{at}"), pointers));
        }
        _ => {}
    }
    if !pointer.is_empty() {
        pointers.push(pointer);
    }
}

/// Changes or removes the value at a pointer, if it is still there.
fn change(json: &mut Value, pointer: &str, random: &mut Pcg32) {
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    let wild = [-1.0, 0.5, 1.5, 1e-40, 1e20, 1e38, 1e39, -1e300][random.random_range(0..8)];
    let number: u64 = [0, 1, 2, 5, 255, u32::MAX.into(), 1 << 32, u64::MAX][random.random_range(0..8)];
    let new = match random.random_range(0..8) {
        0 => json!(wild),
        1 | 2 => json!(number),
        3 => json!("a\nword"),
        4 => json!(null),
        5 => json!([]),
        6 => json!({}),
        _ => match json.pointer_mut(parent) {
            Some(Value::Object(members)) => return drop(members.remove(key)),
            Some(Value::Array(elements)) => {
                // What was an object may be an array by now.
                let at = key.parse().unwrap_or(usize::MAX);
                return if at < elements.len() {
                    drop(elements.remove(at))
                };
            }
            _ => return,
        },
    };
    if let Some(value) = json.pointer_mut(pointer) {
        *value = new;
    }
}
