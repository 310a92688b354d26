//! What is read of accessors and vertex attributes.

use glam::{Affine2, Vec2, Vec3, Vec4};
use serde_json::{Value, json};

use super::builder::{Builder, check_attributes};
use crate::scene::gltf::accessor::Accessors;
use crate::scene::gltf::primitives::{Reader, Shape};
use crate::scene::gltf::{buffers, container};
use crate::scene::notices::Notices;
use crate::scene::{Material, Mesh, TextureSlot, TextureUse};

/// White, with textures in some slots that take some set of coordinates each.
pub fn textured(uses: &[(TextureSlot, usize)]) -> Material {
    let mut material = Material::matte("", Vec3::ONE);
    for &(slot, tex_coord) in uses {
        let texture = TextureUse { texture: 0, tex_coord, uv_from_tex_coord: Affine2::IDENTITY };
        material.textures[slot as usize] = Some(texture);
    }
    material
}

/// The first primitive of a file as a material needs it, and what is said of it.
pub fn mesh_of(file: &Builder, material: &Material) -> Result<(Mesh, Vec<String>), String> {
    shaped(file, material, &[])
}

/// The same, its morph targets at these weights.
pub fn shaped(file: &Builder, material: &Material, weights: &[f32]) -> Result<(Mesh, Vec<String>), String> {
    let glb = file.glb();
    let mut notices = Notices::default();
    let document = container::parse(&glb, &mut notices).map_err(|fault| fault.to_string())?;
    let buffers = buffers::load(&document, None).map_err(|fault| fault.to_string())?;
    let accessors = Accessors { root: &document.root, buffers: &buffers };
    accessors.check().map_err(|fault| fault.to_string())?;
    let primitive = &document.root.meshes[0].primitives[0];
    let shape = Shape { weights, joints: None };
    let shaped = Reader::new(accessors).read(primitive, material, "cloth".to_owned(), shape, &mut notices);
    let mesh = shaped.map_err(|fault| fault.to_string())?.expect("nothing to draw").mesh;
    check_attributes(&mesh, material);
    Ok((mesh, notices.into_lines().collect()))
}

/// One triangle whose attribute `name` has elements of `kind` in `bytes`.
fn triangle_with(name: &str, bytes: &[u8], component: u32, kind: &str, normalized: bool) -> Builder {
    let mut file = Builder::new();
    file.mesh(&[Vec3::ZERO, Vec3::X, Vec3::Y], Some(&[Vec3::Z; 3]), &[0, 1, 2], None);
    let accessor = file.accessor(bytes, 3, component, kind);
    file.json["accessors"][accessor]["normalized"] = json!(normalized);
    file.json["meshes"][0]["primitives"][0]["attributes"][name] = json!(accessor);
    file
}

#[test]
fn positions_of_every_component_type() {
    let matte = Material::matte("", Vec3::ONE);
    // Three corners of three components, each in the low bytes of a stride of 4 or 8.
    let corners: [[i32; 3]; 3] = [[0, 0, 0], [100, 0, 5], [0, 127, -128]];
    for (component, width, scale, least) in
        [(5120, 1, 127.0, -1.0), (5121, 1, 255.0, 0.0), (5122, 2, 32767.0, -1.0), (5123, 2, 65535.0, 0.0)]
    {
        let is_signed = component % 2 == 0;
        let corners = corners.map(|corner| corner.map(|part| if is_signed { part } else { part.abs() }));
        let mut bytes = Vec::new();
        for corner in corners {
            corner.iter().for_each(|part| bytes.extend(&part.to_le_bytes()[..width]));
            bytes.resize(bytes.len().next_multiple_of(4), 0);
        }
        for normalized in [false, true] {
            let mut file = triangle_with("POSITION", &bytes, component, "VEC3", normalized);
            let view = file.json["bufferViews"].as_array().unwrap().len() - 1;
            file.json["bufferViews"][view]["byteStride"] = json!(if width == 1 { 4 } else { 8 });
            let number = |part: i32| if normalized { (part as f32 / scale).max(least) } else { part as f32 };
            let expected = corners.map(|corner| Vec3::from(corner.map(number)));
            assert_eq!(mesh_of(&file, &matte).unwrap().0.positions, expected, "{component} {normalized}");
        }
    }
}

#[test]
fn normals_may_be_quantized() {
    let matte = Material::matte("", Vec3::ONE);
    for (component, bytes) in
        [(5120, [0i8, 0, 127].map(|part| part as u8).to_vec()), (5122, vec![0, 0, 0, 0, 255, 127])]
    {
        let file = triangle_with("NORMAL", &bytes.repeat(3), component, "VEC3", true);
        assert_eq!(mesh_of(&file, &matte).unwrap().0.normals, [Vec3::Z; 3]);
    }
    let error = mesh_of(&triangle_with("NORMAL", &[0; 9], 5121, "VEC3", true), &matte).unwrap_err();
    assert!(error.contains("accessor 3: must be Vec3 of component type 5126, 5120, 5122"), "{error}");
}

#[test]
fn texture_coordinates_are_kept_where_a_texture_takes_them() {
    let floats: Vec<u8> = bytemuck::cast_slice(&[0.0f32, 0.5, 2.0, -1.0, 1.0, 1.0]).to_vec();
    let shorts: Vec<u8> = [0u16, 65535, 13107, 0, 0, 0].iter().flat_map(|part| part.to_le_bytes()).collect();
    let (v, t) = (Vec2::new(0.0, 0.5), Vec2::new(2.0, -1.0));
    for (bytes, component, normalized, expected) in [
        (floats, 5126, false, [v, t, Vec2::ONE]),
        (shorts.clone(), 5123, true, [Vec2::Y, Vec2::new(0.2, 0.0), Vec2::ZERO]),
        (shorts, 5123, false, [Vec2::new(0.0, 65535.0), Vec2::new(13107.0, 0.0), Vec2::ZERO]),
        (vec![0, 255, 51, 0, 0, 0], 5121, true, [Vec2::Y, Vec2::new(0.2, 0.0), Vec2::ZERO]),
        (vec![0, 255, 129, 0, 0, 0], 5120, true, [Vec2::new(0.0, -1.0 / 127.0), Vec2::NEG_X, Vec2::ZERO]),
    ] {
        let mut file = triangle_with("TEXCOORD_1", &bytes, component, "VEC2", normalized);
        let material = textured(&[(TextureSlot::BaseColor, 1)]);
        let (mesh, notices) = mesh_of(&file, &material).unwrap();
        assert_eq!((mesh.tex_coords[1].as_slice(), mesh.tex_coords[0].len()), (&expected[..], 0));
        assert!(notices.is_empty());
        assert!(mesh_of(&file, &textured(&[])).unwrap().0.tex_coords[1].is_empty());
        let both = textured(&[(TextureSlot::BaseColor, 1), (TextureSlot::Emission, 0)]);
        let notice =
            "texture coordinates that a material needs and the mesh lacks are taken to be 0: TEXCOORD_0 of cloth";
        assert_eq!(mesh_of(&file, &both).unwrap().1, [notice]);
        file.json["accessors"][3]["count"] = json!(2);
        let error = mesh_of(&file, &material).unwrap_err();
        assert_eq!(error, "has 3 positions and 2 texture coordinates; export it again");
    }
}

#[test]
fn colors_are_kept_unless_they_are_white() {
    let floats = |colors: &[f32]| bytemuck::cast_slice(colors).to_vec();
    let half = [0.5, 2.0, -1.0, 0.25].map(|part: f32| (part.clamp(0.0, 1.0) * 65535.0).round() as u16);
    let half_opaque = [half[0], half[1], half[2], 65535];
    for (bytes, component, kind, expected) in [
        (floats(&[0.5f32, 2.0, -1.0, 0.25].repeat(3)), 5126, "VEC4", vec![half; 3]),
        (floats(&[0.5f32, 2.0, -1.0].repeat(3)), 5126, "VEC3", vec![half_opaque; 3]),
        ([255, 0, 51, 255].repeat(3), 5121, "VEC4", vec![[65535, 0, 13107, 65535]; 3]),
        ([1, 2, 3, 4, 0, 0].repeat(3), 5123, "VEC3", vec![[513, 1027, 0, 65535]; 3]),
        (vec![255; 9], 5121, "VEC3", vec![]),
        (vec![255; 24], 5123, "VEC4", vec![]),
    ] {
        let file = triangle_with("COLOR_0", &bytes, component, kind, component != 5126);
        assert_eq!(mesh_of(&file, &textured(&[])).unwrap().0.colors, expected, "{component} {kind}");
    }
    let error = mesh_of(&triangle_with("COLOR_0", &[0; 6], 5121, "VEC2", true), &textured(&[])).unwrap_err();
    assert!(error.contains("must be Vec4 of component type 5126, 5121, 5123"), "{error}");
    let file = triangle_with("COLOR_1", &[0; 9], 5121, "VEC3", true);
    assert_eq!(mesh_of(&file, &textured(&[])).unwrap().1, ["vertex attributes that are not drawn: COLOR_1 of cloth"]);
}

/// A square whose positions are sparse: elements 1 and 3 are replaced, of a view or of zeros.
fn sparse_square(with_view: bool, width: usize) -> Builder {
    let corners = [[0.0, 0.0], [9.0, 9.0], [1.0, 1.0], [9.0, 9.0]].map(|[x, y]| Vec3::new(x, y, 0.0));
    let mut file = Builder::new();
    file.mesh(&corners, None, &[0, 1, 2, 0, 2, 3], None);
    let indices: Vec<u8> = [1u32, 3].iter().flat_map(|index| index.to_le_bytes()[..width].to_vec()).collect();
    let component = [5121, 5123, 0, 5125][width - 1];
    let views = [file.accessor(&indices, 2, component, "SCALAR"), file.vectors(&[Vec3::X, Vec3::Y])];
    let sparse_indices = json!({ "bufferView": views[0], "componentType": component });
    file.json["accessors"][0]["sparse"] =
        json!({ "count": 2, "indices": sparse_indices, "values": { "bufferView": views[1] } });
    if !with_view {
        file.json["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    }
    file.push("nodes", json!({ "mesh": 0 }));
    file
}

#[test]
fn sparse_elements_stand_in_for_others() {
    for width in [1, 2, 4] {
        let mesh = &sparse_square(true, width).read().meshes[0];
        assert_eq!(mesh.positions[..3], [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0)]);
        assert_eq!(mesh.positions[5], Vec3::Y);
        // Of zeros, only the replaced ones are left: no triangle has an area.
        let mut file = sparse_square(false, width);
        assert!(super::builder::read(&file.glb()).unwrap_err().contains("no triangles"));
        let indices = file.accessor(&[0, 1, 3], 3, 5121, "SCALAR");
        file.set("/meshes/0/primitives/0/indices", json!(indices));
        assert_eq!(file.read().meshes[0].positions, [Vec3::ZERO, Vec3::X, Vec3::Y]);
    }
}

#[test]
fn bad_sparse_elements() {
    let place = "accessor 0";
    for (pointer, value, what) in [
        ("count", json!(0), "count is 0, of 4"),
        ("count", json!(5), "count is 5, of 4"),
        ("count", json!(3), "3 elements do not lie in bufferView"),
        ("count", json!(4_000_000_000_u32), "count is 4000000000"),
        ("indices/bufferView", json!(99), "no bufferView 99"),
        ("indices/byteOffset", json!(u64::MAX), "do not lie"),
        ("indices/componentType", json!(5126), "componentType"),
        ("indices/componentType", json!(5123), "do not lie"),
        ("values/bufferView", json!(99), "no bufferView 99"),
        ("values/byteOffset", json!(4), "do not lie"),
    ] {
        let mut file = sparse_square(true, 1);
        file.set(&format!("/accessors/0/sparse/{pointer}"), value);
        let error = super::builder::read(&file.glb()).unwrap_err();
        assert!(error.contains(place) && error.contains(what) && error.lines().count() == 1, "{error}");
    }
    for (indices, what) in
        [([1, 1], "sparse index 1 is 1"), ([3, 1], "sparse index 1 is 1"), ([1, 4], "sparse index 1 is 4")]
    {
        let mut file = sparse_square(true, 1);
        file.poke(2, 0, &indices);
        let error = super::builder::read(&file.glb()).unwrap_err();
        assert!(error.contains(place) && error.contains(what), "{error}");
    }
    // Without bytes of its own an accessor may claim any number of elements; they are refused before they are made.
    let mut file = sparse_square(false, 1);
    file.set("/accessors/0/count", json!(4_000_000_000_u32));
    file.json["meshes"][0]["primitives"][0].as_object_mut().unwrap().remove("indices");
    assert!(super::builder::read(&file.glb()).unwrap_err().contains("share the same accessors"));
}

#[test]
fn sparse_indices_shared_by_a_million_accessors_are_not_looked_at_a_million_times() {
    let mut file = sparse_square(true, 1);
    let count = 1 << 20;
    let indices: Vec<u32> = (0..count).collect();
    let indices = file.accessor(bytemuck::cast_slice(&indices), count as usize, 5125, "SCALAR");
    let sparse = json!({
        "count": count,
        "indices": { "bufferView": indices, "componentType": 5125 },
        "values": { "bufferView": indices },
    });
    let accessor = json!({ "count": count, "componentType": 5121, "type": "SCALAR", "sparse": sparse });
    file.json["accessors"] = Value::Array(vec![accessor; 10_000]);
    assert!(super::builder::read(&file.glb()).unwrap_err().contains("share the same sparse indices"));
}

#[test]
fn a_files_tangents_are_made_perpendicular_and_unit() {
    let material = textured(&[(TextureSlot::Normal, 0)]);
    let file = |tangents: &[Vec4]| triangle_with("TANGENT", bytemuck::cast_slice(tangents), 5126, "VEC4", false);
    let own = [Vec4::new(3.0, 0.0, 4.0, -0.5), Vec4::new(0.0, 1.0, 0.0, 1.0), Vec4::new(-2.0, 0.0, 0.0, -1.0)];
    let (mesh, _) = mesh_of(&file(&own), &material).unwrap();
    let expected = [Vec4::new(1.0, 0.0, 0.0, -1.0), Vec4::new(0.0, 1.0, 0.0, 1.0), Vec4::new(-1.0, 0.0, 0.0, -1.0)];
    assert_eq!(mesh.tangents, expected);
    // They are not read where nothing is normal-mapped, nor where the normals are not the file's own.
    assert!(mesh_of(&file(&own), &textured(&[])).unwrap().0.tangents.is_empty());
    let mut flat = file(&[Vec4::NAN; 3]);
    flat.json["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap().remove("NORMAL");
    assert!(mesh_of(&flat, &material).is_ok());
    for bad in [Vec4::ZERO, Vec4::Z] {
        let (_, notices) = mesh_of(&file(&[own[0], own[1], bad]), &material).unwrap();
        assert!(notices.contains(&"tangents of no length or along the normal are computed anew: cloth".to_owned()));
    }
    assert!(mesh_of(&file(&[own[0], own[1], Vec4::NAN]), &material).unwrap_err().contains("element 2"));
    let quantized: [i8; 12] = [127, 0, 0, 127, 0, 127, 0, -127, -127, 0, 0, 127];
    let file = triangle_with("TANGENT", bytemuck::cast_slice(&quantized), 5120, "VEC4", true);
    let expected = [Vec4::new(1.0, 0.0, 0.0, 1.0), Vec4::new(0.0, 1.0, 0.0, -1.0), Vec4::new(-1.0, 0.0, 0.0, 1.0)];
    assert_eq!(mesh_of(&file, &material).unwrap().0.tangents, expected);
}

#[test]
fn flat_faces_have_their_attributes_with_them() {
    let mut file = Builder::new();
    let corners = [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y];
    file.mesh(&corners, None, &[0, 1, 2, 0, 2, 3], None);
    let coords: Vec<Vec2> = corners.iter().map(|corner| Vec2::new(corner.x, 1.0 - corner.y)).collect();
    let coords = file.accessor(bytemuck::cast_slice(&coords), 4, 5126, "VEC2");
    let colors = file.accessor(&[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11], 4, 5121, "VEC3");
    let attributes = &mut file.json["meshes"][0]["primitives"][0]["attributes"];
    (attributes["TEXCOORD_0"], attributes["COLOR_0"]) = (json!(coords), json!(colors));
    let (mesh, _) = mesh_of(&file, &textured(&[(TextureSlot::Normal, 0)])).unwrap();
    assert_eq!(mesh.indices, [0, 1, 2, 3, 4, 5]);
    for (at, corner) in [0, 1, 2, 0, 2, 3].into_iter().enumerate() {
        assert_eq!(mesh.positions[at], corners[corner]);
        assert_eq!(mesh.tex_coords[0][at], Vec2::new(corners[corner].x, 1.0 - corners[corner].y));
        assert_eq!(mesh.colors[at][0], 257 * 3 * corner as u16);
        assert_eq!(mesh.tangents[at], Vec4::new(1.0, 0.0, 0.0, 1.0));
    }
}
