//! glTF files in memory.

use std::io::Cursor;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::{Mat4, Vec3};
use image::{DynamicImage, ImageFormat, Rgb, RgbImage};
use serde_json::{Value, json};

use crate::scene::gltf::{Options, Rig, from_slice};
use crate::scene::{Material, Mesh, PunctualKind, Scene, TextureSlot};

/// A file under construction: JSON, and the bytes of its one buffer.
pub struct Builder {
    pub json: Value,
    pub bytes: Vec<u8>,
}

impl Builder {
    /// A file with nothing in it.
    pub fn new() -> Self {
        let mut json = json!({ "asset": { "version": "2.0" } });
        for list in [
            "buffers",
            "bufferViews",
            "accessors",
            "materials",
            "meshes",
            "nodes",
            "cameras",
            "images",
            "textures",
            "samplers",
        ] {
            json[list] = json!([]);
        }
        json["buffers"] = json!([{ "byteLength": 0 }]);
        Self { json, bytes: Vec::new() }
    }

    /// One square of two metres in the plane z = 0, with normals, indices, a material and a node.
    pub fn square() -> Self {
        let mut file = Self::new();
        let positions = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| Vec3::new(x, y, 0.0));
        let material =
            file.push("materials", json!({ "name": "felt", "pbrMetallicRoughness": { "metallicFactor": 0 } }));
        let mesh = file.mesh(&positions, Some(&[Vec3::Z; 4]), &[0, 1, 2, 0, 2, 3], Some(material));
        file.push("nodes", json!({ "name": "square", "mesh": mesh }));
        file
    }

    /// The square with a sheen, a camera that sees it and a lamp above: nothing is left to add, and nothing to note.
    pub fn studio() -> Self {
        let mut file = Self::square();
        let sheen = json!({ "sheenColorFactor": [1.0, 0.5, 0.25], "sheenRoughnessFactor": 0.5 });
        file.json["materials"][0]["extensions"] = json!({ "KHR_materials_sheen": sheen });
        let perspective = json!({ "yfov": 0.8, "znear": 0.1, "zfar": 100.0 });
        file.push("cameras", json!({ "name": "eye", "type": "perspective", "perspective": perspective }));
        file.push("nodes", json!({ "name": "tripod", "camera": 0, "translation": [0.0, 0.0, 5.0] }));
        let corners = [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]].map(|[x, y]| Vec3::new(x, y, 3.0));
        let strength = json!({ "KHR_materials_emissive_strength": { "emissiveStrength": 4.0 } });
        let metal = json!({ "metallicFactor": 0 });
        let mut glowing = json!({ "name": "glow", "pbrMetallicRoughness": metal, "extensions": strength });
        glowing["emissiveFactor"] = json!([1.0, 1.0, 1.0]);
        let material = file.push("materials", glowing);
        let mesh = file.mesh(&corners, None, &[0, 1, 2, 0, 2, 3], Some(material));
        file.json["meshes"][mesh]["name"] = json!("bulb");
        let rotation = [0.0, 0.0, 0.6, 0.8];
        file.push("nodes", json!({ "name": "lamp", "mesh": mesh, "rotation": rotation, "scale": [1.0, 1.0, 1.0] }));
        file.json["scenes"] = json!([{ "nodes": [0, 1, 2] }]);
        file.json["scene"] = json!(0);
        file
    }

    /// The studio, both sets of whose square's texture coordinates run from 0 to 1.
    pub fn textured_studio() -> Self {
        let mut file = Self::studio();
        let corners: [[f32; 2]; 4] = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
        for set in ["TEXCOORD_0", "TEXCOORD_1"] {
            let accessor = file.accessor(bytemuck::cast_slice(&corners), 4, 5126, "VEC2");
            file.json["meshes"][0]["primitives"][0]["attributes"][set] = json!(accessor);
        }
        file
    }

    /// Sets the member or element at a JSON pointer, whose parent there must be, or is made as an object.
    pub fn set(&mut self, pointer: &str, value: Value) {
        let mut place = &mut self.json;
        for key in pointer.split('/').skip(1) {
            place = match place {
                Value::Array(elements) => &mut elements[key.parse::<usize>().unwrap()],
                _ => &mut place[key],
            };
        }
        *place = value;
    }

    /// Overwrites the bytes of an accessor's element.
    pub fn poke(&mut self, accessor: usize, offset: usize, bytes: &[u8]) {
        let view = self.json["accessors"][accessor]["bufferView"].as_u64().unwrap() as usize;
        let start = self.json["bufferViews"][view]["byteOffset"].as_u64().unwrap() as usize + offset;
        self.bytes[start..start + bytes.len()].copy_from_slice(bytes);
    }

    /// Adds to one of the root's lists; gives the index.
    pub fn push(&mut self, list: &str, value: Value) -> usize {
        let list = self.json[list].as_array_mut().unwrap();
        list.push(value);
        list.len() - 1
    }

    /// Adds a view of `bytes`.
    pub fn view(&mut self, bytes: &[u8]) -> usize {
        let offset = self.bytes.len();
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.json["buffers"][0]["byteLength"] = json!(self.bytes.len());
        let view = json!({ "buffer": 0, "byteOffset": offset, "byteLength": bytes.len() });
        self.push("bufferViews", view)
    }

    /// Adds an accessor over `bytes` in a view of its own.
    pub fn accessor(&mut self, bytes: &[u8], count: usize, component: u32, kind: &str) -> usize {
        let view = self.view(bytes);
        let accessor = json!({ "bufferView": view, "count": count, "componentType": component, "type": kind });
        self.push("accessors", accessor)
    }

    /// Adds a texture that shows an image of these bytes.
    pub fn texture(&mut self, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        let image = self.push("images", json!({ "bufferView": view, "mimeType": "image/png" }));
        self.push("textures", json!({ "source": image }))
    }

    pub fn vectors(&mut self, vectors: &[Vec3]) -> usize {
        self.accessor(bytemuck::cast_slice(vectors), vectors.len(), 5126, "VEC3")
    }

    /// Adds a mesh of one primitive with 32-bit indices.
    pub fn mesh(
        &mut self,
        positions: &[Vec3],
        normals: Option<&[Vec3]>,
        indices: &[u32],
        material: Option<usize>,
    ) -> usize {
        let mut primitive = json!({ "attributes": { "POSITION": self.vectors(positions) } });
        if let Some(normals) = normals {
            primitive["attributes"]["NORMAL"] = json!(self.vectors(normals));
        }
        primitive["indices"] = json!(self.accessor(bytemuck::cast_slice(indices), indices.len(), 5125, "SCALAR"));
        if let Some(material) = material {
            primitive["material"] = json!(material);
        }
        self.push("meshes", json!({ "primitives": [primitive] }))
    }

    /// Gives a mesh's first primitive an attribute.
    pub fn attribute(&mut self, mesh: usize, name: &str, accessor: usize) {
        self.json["meshes"][mesh]["primitives"][0]["attributes"][name] = json!(accessor);
    }

    /// Binds the vertices of a mesh's first primitive to joints.
    pub fn bind(&mut self, mesh: usize, joints: &[[u8; 4]], weights: &[[f32; 4]]) {
        let joints = self.accessor(joints.as_flattened(), joints.len(), 5121, "VEC4");
        let weights = self.accessor(bytemuck::cast_slice(weights), weights.len(), 5126, "VEC4");
        self.attribute(mesh, "JOINTS_0", joints);
        self.attribute(mesh, "WEIGHTS_0", weights);
    }

    /// Adds a skin.
    pub fn skin(&mut self, joints: &[usize], bound: &[Mat4]) -> usize {
        let bound: Vec<f32> = bound.iter().flat_map(Mat4::to_cols_array).collect();
        let bound = self.accessor(bytemuck::cast_slice(&bound), bound.len() / 16, 5126, "MAT4");
        if self.json["skins"].is_null() {
            self.json["skins"] = json!([]);
        }
        self.push("skins", json!({ "joints": joints, "inverseBindMatrices": bound }))
    }

    /// The file as a .glb.
    pub fn glb(&self) -> Vec<u8> {
        glb(self.json.to_string().as_bytes(), &self.bytes)
    }

    /// The file as a .gltf with its buffer in a data URI.
    pub fn gltf(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        let data = STANDARD.encode(&self.bytes);
        json["buffers"][0]["uri"] = json!(format!("data:application/octet-stream;base64,{data}"));
        json.to_string().into_bytes()
    }

    pub fn read(&self) -> Scene {
        read(&self.glb()).unwrap()
    }

    /// The scene without the rig, whatever lights it.
    pub fn read_without_rig(&self) -> Scene {
        read_as(&self.glb(), &Options { rig: Rig::Off, ..Options::default() }).unwrap()
    }

    /// The one line that is said of the file, which must be broken.
    pub fn error(&self) -> String {
        let error = read(&self.glb()).expect_err("this is read");
        assert_eq!(error.lines().count(), 1, "{error}");
        error
    }
}

/// The bytes of an image file of this size: a red that grows to the right, a green that grows downwards, some blue.
pub fn picture(format: ImageFormat, width: u32, height: u32) -> Vec<u8> {
    let texel = |x: u32, y: u32| Rgb([(255 * x / width) as u8, (255 * y / height) as u8, 100]);
    encoded(RgbImage::from_fn(width, height, texel).into(), format)
}

/// The bytes of an image file.
pub fn encoded(image: DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

/// The bytes that a text spells.
pub fn from_base64(text: &str) -> Vec<u8> {
    STANDARD.decode(text).unwrap()
}

/// Reads a file; what is read must be whole.
pub fn read(bytes: &[u8]) -> Result<Scene, String> {
    read_as(bytes, &Options::default())
}

/// Reads a file in another way; what is read must be whole.
pub fn read_as(bytes: &[u8], options: &Options) -> Result<Scene, String> {
    let scene = from_slice(bytes, "test.glb", options).map_err(|error| error.to_string())?;
    check(&scene);
    Ok(scene)
}

/// A .glb of these chunks.
pub fn glb(json: &[u8], binary: &[u8]) -> Vec<u8> {
    let pad = |bytes: &[u8], with: u8| {
        let mut bytes = bytes.to_vec();
        bytes.resize(bytes.len().next_multiple_of(4), with);
        bytes
    };
    let (json, binary) = (pad(json, b' '), pad(binary, 0));
    let length = 12 + 8 + json.len() + 8 + binary.len();
    let word = |number: usize| (number as u32).to_le_bytes();
    [b"glTF", &word(2)[..], &word(length), &word(json.len()), b"JSON", &json, &word(binary.len()), b"BIN\0", &binary]
        .concat()
}

/// What holds of a mesh's attributes.
pub fn check_attributes(mesh: &Mesh, material: &Material) {
    let is_whole = |length: usize| length == 0 || length == mesh.positions.len();
    assert!(mesh.tex_coords.iter().all(|coords| is_whole(coords.len())) && is_whole(mesh.colors.len()));
    assert!(mesh.tex_coords.iter().flatten().all(|coords| coords.is_finite()));
    let is_mapped = material.texture(TextureSlot::Normal).is_some();
    // Those that a texture without an image asked for stay.
    assert!(is_whole(mesh.tangents.len()) && (!is_mapped || !mesh.tangents.is_empty()));
    for (tangent, normal) in mesh.tangents.iter().zip(&mesh.normals) {
        assert!(tangent.w.abs() == 1.0 && tangent.truncate().is_normalized(), "{tangent}");
        assert!(tangent.truncate().dot(*normal).abs() < 1e-5, "{tangent} {normal}");
    }
}

/// What holds of every scene that loading gives.
pub fn check(scene: &Scene) {
    assert!(!scene.cameras.is_empty() && !scene.instances.is_empty());
    for mesh in &scene.meshes {
        assert!(mesh.material < scene.materials.len());
        assert!(!mesh.indices.is_empty() && mesh.indices.len() % 3 == 0);
        assert_eq!(mesh.positions.len(), mesh.normals.len());
        assert!(mesh.indices.iter().all(|&index| (index as usize) < mesh.positions.len()));
        assert!(mesh.positions.iter().all(|position| position.is_finite()));
        assert!(mesh.normals.iter().all(|normal| normal.is_normalized()), "{:?}", mesh.normals);
        check_attributes(mesh, &scene.materials[mesh.material]);
    }
    for light in &scene.punctual_lights {
        assert!(light.position.is_finite() && light.direction.is_normalized());
        assert!(light.intensity.is_finite() && light.intensity.min_element() >= 0.0 && light.intensity != Vec3::ZERO);
        match light.kind {
            PunctualKind::Point { range } => assert!(range > 0.0),
            PunctualKind::Spot { range, inner, outer } => {
                assert!(
                    range > 0.0
                        && 0.0 <= inner
                        && inner <= outer
                        && 0.0 < outer
                        && outer <= std::f32::consts::FRAC_PI_2
                );
            }
            PunctualKind::Directional => {}
        }
    }
    for instance in &scene.instances {
        assert!(instance.mesh < scene.meshes.len());
        assert!(instance.world_from_mesh.is_finite() && instance.world_from_normal().is_finite());
    }
    for material in &scene.materials {
        assert!(material.base_color.is_finite() && material.emission.is_finite());
        for texture in material.textures.iter().flatten() {
            assert!(texture.texture < scene.textures.len() && texture.tex_coord < 2);
            assert!(texture.uv_from_tex_coord.is_finite());
        }
    }
    for texture in &scene.textures {
        assert!(texture.image < scene.images.len());
    }
    for image in &scene.images {
        assert!(image.texels.len() == image.width as usize * image.height as usize && !image.texels.is_empty());
    }
    for light in &scene.lights {
        assert!(light.instance < scene.instances.len() && light.radiance.is_finite() && !light.polygons.is_empty());
        for polygon in &light.polygons {
            assert!(polygon.normal.is_normalized() && !polygon.contours.is_empty());
            assert!(polygon.contours.iter().all(|contour| contour.len() >= 3));
            assert!(polygon.contours.iter().flatten().all(|corner| corner.is_finite()));
        }
    }
    for camera in &scene.cameras {
        assert!(camera.world_from_camera.is_finite());
        assert!((camera.world_from_camera.determinant() - 1.0).abs() < 1e-4);
    }
    for notice in &scene.notices {
        assert_eq!(notice.lines().count(), 1);
    }
}
