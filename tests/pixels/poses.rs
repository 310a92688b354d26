//! Things that a file instances, hides, morphs or moves by joints look as those that stand where these stand.

use glam::{Mat4, Quat, Vec3};
use serde_json::{Value, json};
use velour::table::SheenTable;

use super::command::hold_file;
use super::compare::sheen_alone;
use super::run::small_stage;
use super::stage::{Stage, Thing, container, glow};

/// A floor, thing 0, under a lamp, thing 1, as a file to be changed.
struct File {
    json: Value,
    bytes: Vec<u8>,
}

impl File {
    fn new(stage: &Stage) -> Self {
        let (json, bytes) = stage.chunks();
        Self { json, bytes }
    }

    fn accessor(&mut self, floats: &[f32], count: usize, kind: &str, component: u32) -> usize {
        let bytes: &[u8] = bytemuck::cast_slice(floats);
        let view = json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        self.bytes.extend(bytes);
        self.json["buffers"][0]["byteLength"] = json!(self.bytes.len());
        self.json["bufferViews"].as_array_mut().unwrap().push(view);
        let accessors = self.json["accessors"].as_array_mut().unwrap();
        let accessor =
            json!({ "bufferView": accessors.len(), "componentType": component, "type": kind, "count": count });
        accessors.push(accessor);
        accessors.len() - 1
    }

    /// Adds a node to the scene.
    fn node(&mut self, node: Value) -> usize {
        let nodes = self.json["nodes"].as_array_mut().unwrap();
        nodes.push(node);
        let index = nodes.len() - 1;
        self.json["scenes"][0]["nodes"].as_array_mut().unwrap().push(json!(index));
        index
    }

    /// Binds the floor, which is thing 0, to two joints that take it to where these matrices do, by these weights.
    fn bind(&mut self, joints: [Mat4; 2], weights: [f32; 2]) {
        // Joints 0, 1, 0, 0 of each vertex, as bytes.
        let of_vertices = f32::from_le_bytes([0, 1, 0, 0]);
        let of_vertices = self.accessor(&[of_vertices; 4], 4, "VEC4", 5121);
        let weights = self.accessor(&[weights[0], weights[1], 0.0, 0.0].repeat(4), 4, "VEC4", 5126);
        let attributes = &mut self.json["meshes"][0]["primitives"][0]["attributes"];
        (attributes["JOINTS_0"], attributes["WEIGHTS_0"]) = (json!(of_vertices), json!(weights));
        let joints = joints.map(|matrix| self.node(json!({ "matrix": matrix.to_cols_array() })));
        self.json["skins"] = json!([{ "joints": joints }]);
        self.json["nodes"][0]["skin"] = json!(0);
    }

    fn looks_as(&self, stage: &Stage, flags: &str) {
        let glb = container(self.json.to_string().as_bytes(), &self.bytes);
        hold_file(glb, stage, flags, &SheenTable::embedded(), &sheen_alone());
    }
}

#[test]
fn three_lamps_from_one() {
    let stage = small_stage();
    let (offsets, scales) = ([-1.2 * Vec3::X, Vec3::ZERO, Vec3::new(0.9, -0.3, 0.2)], [1.0, 0.5, 0.8]);
    let rotations = [0.0f32, 0.7, -0.4].map(Quat::from_rotation_y);
    let mut file = File::new(&stage);
    let translation = file.accessor(bytemuck::cast_slice(&offsets), 3, "VEC3", 5126);
    let rotation = file.accessor(&rotations.map(|rotation| rotation.to_array()).concat(), 3, "VEC4", 5126);
    let scale = file.accessor(&scales.map(|scale| [scale; 3]).concat(), 3, "VEC3", 5126);
    let attributes = json!({ "TRANSLATION": translation, "ROTATION": rotation, "SCALE": scale });
    file.json["nodes"][1]["extensions"] = json!({ "EXT_mesh_gpu_instancing": { "attributes": attributes } });
    let mut three = Stage { things: vec![stage.things[0].clone()], ..stage.clone() };
    for (offset, (rotation, scale)) in offsets.into_iter().zip(rotations.into_iter().zip(scales)) {
        let instance = Mat4::from_scale_rotation_translation(Vec3::splat(scale), rotation, offset);
        let lamp = stage.things[1].clone();
        let placed = lamp.world_from_mesh * instance;
        three.things.push(lamp.placed(placed));
    }
    file.looks_as(&three, "");
}

#[test]
fn a_lamp_that_is_hidden_does_not_shine() {
    let stage = small_stage();
    let mut with_another = stage.clone();
    with_another.things.push(Thing::rectangle([0.4, 0.4], glow([9.0; 3])).placed(stage.things[1].world_from_mesh));
    let mut file = File::new(&with_another);
    file.json["nodes"][2]["extensions"] = json!({ "KHR_node_visibility": { "visible": false } });
    file.looks_as(&stage, "");
}

#[test]
fn joints_move_and_bend_or_the_one_nearest_the_root_moves_alone() {
    let stage = small_stage();
    let own = stage.things[0].world_from_mesh;
    // Their mean shears, stretches and turns, and the second mirrors by itself.
    let turned = Mat4::from_rotation_y(0.6) * Mat4::from_scale(Vec3::new(1.2, 1.0, 0.7));
    let joints = [turned * own, Mat4::from_translation(Vec3::new(0.1, 0.2, 0.1)) * own];
    for joints in [joints, joints.map(|joint| joint * Mat4::from_scale(Vec3::new(-1.0, 1.0, 1.0)))] {
        let mut file = File::new(&stage);
        file.bind(joints, [0.25, 0.75]);
        let moved = |world_from_mesh: Mat4| {
            let mut moved = stage.clone();
            moved.things[0].world_from_mesh = world_from_mesh;
            moved
        };
        file.looks_as(&moved(0.25 * joints[0] + 0.75 * joints[1]), "");
        file.looks_as(&moved(joints[0]), "--pose bind");
    }
}

#[test]
fn a_floor_is_morphed_unless_it_is_asked_for_as_it_was_modelled() {
    let stage = small_stage();
    let mut file = File::new(&stage);
    let raised = file.accessor(&[0.0, 0.0, 0.4].repeat(4), 4, "VEC3", 5126);
    file.json["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": raised }]);
    file.json["meshes"][0]["weights"] = json!([0.5]);
    let mut moved = stage.clone();
    moved.things[0].world_from_mesh *= Mat4::from_translation(0.2 * Vec3::Z);
    file.looks_as(&moved, "--pose file");
    file.looks_as(&stage, "--pose bind");
}
