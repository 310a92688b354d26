//! Small scenes: described once, then made as a `.glb` file, as a `Scene`, and as what the truth traces.

use glam::{Mat4, Vec3};
use serde_json::{Value, json};
use velour::scene::{Camera, Instance, Light, Material, Mesh, Polygon, Projection, PunctualLight, Scene, Sheen};

/// Things before a camera. What glows is a light.
#[derive(Clone)]
pub struct Stage {
    pub things: Vec<Thing>,
    pub world_from_camera: Mat4,
    pub projection: Projection,
    /// Lights without extent, which files do not get.
    pub punctual: Vec<PunctualLight>,
}

/// A mesh, its place and its look.
#[derive(Clone)]
pub struct Thing {
    pub positions: Vec<Vec3>,
    pub normals: Vec<Vec3>,
    pub triangles: Vec<[u32; 3]>,
    /// In the mesh's space, counter-clockwise around the area; needed only of what glows.
    pub contours: Vec<Vec<Vec3>>,
    pub world_from_mesh: Mat4,
    pub material: Material,
}

/// White and dull: no sheen, no light.
pub fn plain() -> Material {
    Material::matte("", Vec3::ONE)
}

/// With a sheen over a base of its own colour.
pub fn velvet(color: [f32; 3], roughness: f32) -> Material {
    Material { base_color: Vec3::new(0.3, 0.6, 0.9), sheen: Some(Sheen::new(color.into(), roughness)), ..plain() }
}

/// Black, and of this radiance.
pub fn glow(radiance: [f32; 3]) -> Material {
    Material { base_color: Vec3::ZERO, emission: radiance.into(), ..plain() }
}

impl Thing {
    /// A flat shape in the plane z = 0 that faces +z, from its corners and triangles; its outline is given apart.
    pub fn flat(corners: &[[f32; 2]], triangles: &[[u32; 3]], contours: &[&[usize]], material: Material) -> Self {
        let positions: Vec<Vec3> = corners.iter().map(|&[x, y]| Vec3::new(x, y, 0.0)).collect();
        let contours = contours.iter().map(|contour| contour.iter().map(|&corner| positions[corner]).collect());
        Self {
            normals: vec![Vec3::Z; positions.len()],
            triangles: triangles.to_vec(),
            contours: contours.collect(),
            positions,
            world_from_mesh: Mat4::IDENTITY,
            material,
        }
    }

    /// A rectangle of these half sides, likewise.
    pub fn rectangle(half: [f32; 2], material: Material) -> Self {
        let [x, y] = half;
        let corners = [[-x, -y], [x, -y], [x, y], [-x, y]];
        Self::flat(&corners, &[[0, 1, 2], [0, 2, 3]], &[&[0, 1, 2, 3]], material)
    }

    pub fn placed(mut self, world_from_mesh: Mat4) -> Self {
        self.world_from_mesh = world_from_mesh;
        self
    }

    pub fn glows(&self) -> bool {
        self.material.emission != Vec3::ZERO
    }
}

/// The place from which +z looks at `target`.
pub fn facing(eye: [f32; 3], target: [f32; 3]) -> Mat4 {
    let (eye, target) = (Vec3::from(eye), Vec3::from(target));
    let up = if (target - eye).cross(Vec3::Y).length() < 1e-3 { Vec3::Z } else { Vec3::Y };
    let back = (target - eye).normalize();
    let right = up.cross(back).normalize();
    Mat4::from_cols(right.extend(0.0), back.cross(right).extend(0.0), back.extend(0.0), eye.extend(1.0))
}

/// The place from which a camera, which looks along -z, sees `target` in its middle.
pub fn looking(eye: [f32; 3], target: [f32; 3]) -> Mat4 {
    let (from, to) = (Vec3::from(eye), Vec3::from(target));
    facing(eye, (2.0 * from - to).to_array())
}

impl Stage {
    pub fn new(things: Vec<Thing>, world_from_camera: Mat4) -> Self {
        let projection = Projection::Perspective { yfov: 0.8, near: 0.1, far: 100.0 };
        Self { things, world_from_camera, projection, punctual: Vec::new() }
    }

    /// The scene in the library's own types: no file is read between it and the picture.
    pub fn scene(&self) -> Scene {
        let things = self.things.iter().enumerate();
        let mesh = |(index, thing): (usize, &Thing)| Mesh {
            name: format!("thing {index}"),
            positions: thing.positions.clone(),
            normals: thing.normals.clone(),
            indices: thing.triangles.as_flattened().to_vec(),
            material: index,
            ..Mesh::default()
        };
        let instance = |(index, thing): (usize, &Thing)| Instance {
            name: format!("thing {index}"),
            mesh: index,
            world_from_mesh: thing.world_from_mesh,
        };
        let camera = Camera {
            name: "camera".to_owned(),
            world_from_camera: self.world_from_camera,
            projection: self.projection,
        };
        Scene {
            meshes: things.clone().map(mesh).collect(),
            instances: things.clone().map(instance).collect(),
            materials: self.things.iter().map(|thing| thing.material.clone()).collect(),
            lights: things.filter(|(_, thing)| thing.glows()).map(light).collect(),
            cameras: vec![camera],
            punctual_lights: self.punctual.clone(),
            ..Scene::default()
        }
    }

    /// The scene as a file.
    pub fn glb(&self) -> Vec<u8> {
        let (json, binary) = self.chunks();
        container(json.to_string().as_bytes(), &binary)
    }

    /// The chunks of the file, for tests that spoil them before they are put together.
    pub fn chunks(&self) -> (Value, Vec<u8>) {
        let mut file = File::default();
        let mut nodes: Vec<Value> =
            self.things.iter().map(|thing| json!({ "matrix": thing.world_from_mesh.to_cols_array() })).collect();
        for (index, thing) in self.things.iter().enumerate() {
            file.add(thing);
            nodes[index]["mesh"] = json!(index);
        }
        nodes.push(json!({ "camera": 0, "matrix": self.world_from_camera.to_cols_array() }));
        let camera = match self.projection {
            Projection::Perspective { yfov, near, far } => {
                json!({ "type": "perspective", "perspective": { "yfov": yfov, "znear": near, "zfar": far } })
            }
            Projection::Orthographic { ymag, near, far } => {
                let orthographic = json!({ "xmag": ymag, "ymag": ymag, "znear": near, "zfar": far });
                json!({ "type": "orthographic", "orthographic": orthographic })
            }
        };
        let root = json!({
            "asset": { "version": "2.0" },
            "extensionsUsed": [
                "KHR_materials_emissive_strength",
                "KHR_materials_fuzz",
                "KHR_materials_ior",
                "KHR_materials_sheen",
                "KHR_materials_specular",
            ],
            "scene": 0,
            "scenes": [{ "nodes": (0..nodes.len()).collect::<Vec<_>>() }],
            "nodes": nodes,
            "cameras": [camera],
            "materials": self.things.iter().map(|thing| material(&thing.material)).collect::<Vec<_>>(),
            "meshes": file.meshes,
            "accessors": file.accessors,
            "bufferViews": file.views,
            "buffers": [{ "byteLength": file.bytes.len() }],
        });
        (root, file.bytes)
    }
}

fn light((index, thing): (usize, &Thing)) -> Light {
    let place = |corner: &Vec3| thing.world_from_mesh.transform_point3(*corner);
    let mut contours: Vec<Vec<Vec3>> =
        thing.contours.iter().map(|contour| contour.iter().map(place).collect()).collect();
    let mirrored = thing.world_from_mesh.determinant() < 0.0;
    if mirrored {
        contours.iter_mut().for_each(|contour| contour.reverse());
    }
    let normal = thing.world_from_mesh.inverse().transpose().transform_vector3(Vec3::Z).normalize();
    Light {
        name: format!("thing {index}"),
        radiance: thing.material.emission,
        two_sided: thing.material.double_sided,
        polygons: vec![Polygon { contours, normal, pattern: None }],
        instance: index,
        ..Light::default()
    }
}

fn material(material: &Material) -> Value {
    let [r, g, b] = material.base_color.to_array();
    let strength = material.emission.max_element().max(1.0);
    let mut json = json!({
        "pbrMetallicRoughness": {
            "baseColorFactor": [r, g, b, 1.0],
            "metallicFactor": material.metallic,
            "roughnessFactor": material.roughness,
        },
        "emissiveFactor": (material.emission / strength).to_array(),
        "doubleSided": material.double_sided,
        "extensions": {
            "KHR_materials_emissive_strength": { "emissiveStrength": strength },
            "KHR_materials_ior": { "ior": material.ior },
            "KHR_materials_specular": {
                "specularFactor": material.specular,
                "specularColorFactor": material.specular_color.to_array(),
            },
        },
    });
    match material.sheen {
        Some(Sheen { color, roughness, weight: 1.0, .. }) => {
            json["extensions"]["KHR_materials_sheen"] =
                json!({ "sheenColorFactor": color.to_array(), "sheenRoughnessFactor": roughness });
        }
        Some(Sheen { color, roughness, weight, .. }) => {
            json["extensions"]["KHR_materials_fuzz"] = json!({
                "fuzzFactor": weight,
                "fuzzColorFactor": color.to_array(),
                "fuzzRoughnessFactor": roughness,
            });
        }
        None => {}
    }
    json
}

/// The parts of a file that grow with each mesh.
#[derive(Default)]
struct File {
    meshes: Vec<Value>,
    accessors: Vec<Value>,
    views: Vec<Value>,
    bytes: Vec<u8>,
}

impl File {
    fn add(&mut self, thing: &Thing) {
        let positions = self.accessor(bytemuck::cast_slice(&thing.positions), thing.positions.len(), "VEC3", 5126);
        let normals = self.accessor(bytemuck::cast_slice(&thing.normals), thing.normals.len(), "VEC3", 5126);
        let corners = thing.triangles.as_flattened();
        let indices = self.accessor(bytemuck::cast_slice(corners), corners.len(), "SCALAR", 5125);
        let attributes = json!({ "POSITION": positions, "NORMAL": normals });
        let material = self.meshes.len();
        self.meshes
            .push(json!({ "primitives": [{ "attributes": attributes, "indices": indices, "material": material }] }));
    }

    fn accessor(&mut self, bytes: &[u8], count: usize, kind: &str, component: u32) -> usize {
        self.views.push(json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() }));
        self.bytes.extend(bytes);
        let view = self.accessors.len();
        self.accessors.push(json!({ "bufferView": view, "componentType": component, "type": kind, "count": count }));
        view
    }
}

/// A `.glb` of these chunks.
pub fn container(json: &[u8], binary: &[u8]) -> Vec<u8> {
    let mut json = json.to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut binary = binary.to_vec();
    binary.resize(binary.len().next_multiple_of(4), 0);
    let word = |number: usize| (number as u32).to_le_bytes();
    let length = word(12 + 8 + json.len() + 8 + binary.len());
    [&b"glTF"[..], &word(2), &length, &word(json.len()), b"JSON", &json, &word(binary.len()), b"BIN\0", &binary[..]]
        .concat()
}
