// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
//! The scene as a glTF text file.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use bevy::prelude::*;
use serde_json::{Value, json};

use crate::scene::{self, Light, Shape, Thing};

const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;

pub fn gltf() -> String {
    let mut file = File::default();
    for Thing { name, shape, place, base_color: [r, g, b], roughness, metallic, sheen_color, alpha } in scene::things()
    {
        let material = json!({
            "name": name,
            "pbrMetallicRoughness": {
                "baseColorFactor": [r, g, b, 1.0], "roughnessFactor": roughness, "metallicFactor": metallic,
            },
            "extensions": {
                "KHR_materials_sheen": { "sheenColorFactor": sheen_color, "sheenRoughnessFactor": alpha },
            },
        });
        file.add(name, &shape, place, material);
    }
    for Light { name, radiance, size, place } in scene::lights() {
        let strength = radiance.into_iter().fold(0.0, f32::max);
        let material = json!({
            "name": name,
            "pbrMetallicRoughness": { "baseColorFactor": [0.0, 0.0, 0.0, 1.0] },
            "emissiveFactor": radiance.map(|channel| channel / strength),
            "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": strength } },
        });
        file.add(name, &scene::rectangle(size), place, material);
    }
    file.written()
}

#[derive(Default)]
struct File {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
    nodes: Vec<Value>,
}

impl File {
    fn add(&mut self, name: &str, shape: &Shape, place: Transform, material: Value) {
        let position = self.vectors(&shape.positions);
        let normal = self.vectors(&shape.normals);
        let bytes = shape.indices.iter().flat_map(|index| index.to_le_bytes()).collect();
        let indices = self.accessor(bytes, shape.indices.len(), UNSIGNED_SHORT, json!({ "type": "SCALAR" }));
        let index = self.nodes.len();
        self.meshes.push(json!({ "primitives": [{
            "attributes": { "POSITION": position, "NORMAL": normal }, "indices": indices, "material": index,
        }] }));
        self.materials.push(material);
        self.node(name, place, "mesh", index);
    }

    fn node(&mut self, name: &str, place: Transform, what: &str, index: usize) {
        let (translation, rotation) = (place.translation.to_array(), place.rotation.to_array());
        self.nodes.push(json!({ "name": name, what: index, "translation": translation, "rotation": rotation }));
    }

    fn vectors(&mut self, vectors: &[[f32; 3]]) -> usize {
        let bound = |pick: fn(f32, f32) -> f32| {
            let picked = |a: [f32; 3], b: &[f32; 3]| [pick(a[0], b[0]), pick(a[1], b[1]), pick(a[2], b[2])];
            vectors.iter().fold(vectors[0], picked)
        };
        let facts = json!({ "type": "VEC3", "min": bound(f32::min), "max": bound(f32::max) });
        let bytes = vectors.iter().flatten().flat_map(|number| number.to_le_bytes()).collect();
        self.accessor(bytes, vectors.len(), FLOAT, facts)
    }

    fn accessor(&mut self, bytes: Vec<u8>, count: usize, component: u32, mut facts: Value) -> usize {
        self.views.push(json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() }));
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        facts["bufferView"] = json!(self.views.len() - 1);
        facts["componentType"] = json!(component);
        facts["count"] = json!(count);
        self.accessors.push(facts);
        self.accessors.len() - 1
    }

    fn written(mut self) -> String {
        self.node("camera", scene::eye(), "camera", 0);
        let lens = json!({ "yfov": scene::YFOV, "znear": scene::NEAR, "zfar": scene::FAR });
        let uri = format!("data:application/octet-stream;base64,{}", STANDARD.encode(&self.bytes));
        let file = json!({
            "asset": { "version": "2.0" },
            "extensionsUsed": ["KHR_materials_sheen", "KHR_materials_emissive_strength"],
            "scene": 0,
            "scenes": [{ "nodes": (0..self.nodes.len()).collect::<Vec<_>>() }],
            "cameras": [{ "type": "perspective", "perspective": lens }],
            "nodes": self.nodes, "meshes": self.meshes, "materials": self.materials,
            "accessors": self.accessors, "bufferViews": self.views,
            "buffers": [{ "byteLength": self.bytes.len(), "uri": uri }],
        });
        file.to_string()
    }
}
