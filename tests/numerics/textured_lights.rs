//! Lights of textured emitters by the reference, against the exact form factors of what their texels are.

use std::io::Cursor;

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use glam::{DMat3, DMat4, DQuat, DVec2, DVec3, Mat4, Vec3};
use serde_json::{Value, json};
use velour::reference::polygon::form_factor;
use velour::reference::{Effort, Filter, Options, Reference, SpecularModel};
use velour::scene::{Camera, Drawn, Edits, Light, LightEdits, Projection, Scene, gltf};
use velour::table::SheenTable;

const RED: [u8; 4] = [255, 0, 0, 255];
const GREEN: [u8; 4] = [0, 255, 0, 255];
const BLUE: [u8; 4] = [0, 0, 255, 255];
const BLACK: [u8; 4] = [0, 0, 0, 255];
const CLEAR: [u8; 4] = [0; 4];
/// Of the emitter where its texture is white.
const EMISSION: f64 = 3.0;
/// Points of the floor.
const POINTS: [[f64; 2]; 4] = [[0.1, 0.3], [-0.9, 0.4], [0.8, 1.1], [0.2, 0.05]];
/// How many standard errors a channel may be off: of 300 comparisons one is in 50 sets of them.
const ERRORS: f64 = 4.0;

/// A window in the plane z = 0 above a white, matte floor in y = 0, and what stands where in the file.
struct Window {
    corners: Vec<[f32; 2]>,
    uv: Vec<[f32; 2]>,
    indices: Vec<u16>,
    /// Columns, and texels from the first row.
    image: (usize, Vec<[u8; 4]>),
    material: Value,
    node: Value,
}

impl Window {
    /// 1.6 wide and 1 high, 0.2 above the floor, with all of an image.
    fn new(columns: usize, texels: &[[u8; 4]]) -> Self {
        Self {
            corners: vec![[-0.8, 0.2], [0.8, 0.2], [0.8, 1.2], [-0.8, 1.2]],
            uv: vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]],
            indices: vec![0, 1, 2, 0, 2, 3],
            image: (columns, texels.to_vec()),
            material: json!({ "emissiveTexture": { "index": 0 } }),
            node: json!({ "mesh": 0 }),
        }
    }

    fn scene(&self) -> Scene {
        let mut bytes = Vec::new();
        let mut views = Vec::new();
        let mut add = |part: &[u8]| {
            views.push(json!({ "buffer": 0, "byteOffset": bytes.len(), "byteLength": part.len() }));
            bytes.extend(part);
            bytes.resize(bytes.len().next_multiple_of(4), 0);
        };
        let floats = |values: &[f32]| values.iter().flat_map(|value| value.to_le_bytes()).collect::<Vec<u8>>();
        let places: Vec<f32> = self.corners.iter().flat_map(|&[x, y]| [x, y, 0.0]).collect();
        let floor = [[-3.0, 0.0, 3.0], [3.0, 0.0, 3.0], [3.0, 0.0, -3.0], [-3.0, 0.0, -3.0f32]];
        add(&floats(&places));
        add(&floats(self.uv.as_flattened()));
        add(&self.indices.iter().flat_map(|index| index.to_le_bytes()).collect::<Vec<u8>>());
        add(&floats(floor.as_flattened()));
        add(&[0u16, 1, 2, 0, 2, 3].iter().flat_map(|index| index.to_le_bytes()).collect::<Vec<u8>>());
        let bounds = |axis: usize| self.corners.iter().map(move |corner| corner[axis]);
        let low = [0, 1].map(|axis| bounds(axis).fold(f32::INFINITY, f32::min));
        let high = [0, 1].map(|axis| bounds(axis).fold(f32::NEG_INFINITY, f32::max));
        let uri = |kind: &str, bytes: &[u8]| format!("data:{kind};base64,{}", BASE64_STANDARD.encode(bytes));
        let (columns, texels) = &self.image;
        let rows = texels.len() / columns;
        let picture = image::RgbaImage::from_raw(*columns as u32, rows as u32, texels.as_flattened().to_vec()).unwrap();
        let mut png = Cursor::new(Vec::new());
        picture.write_to(&mut png, image::ImageFormat::Png).unwrap();
        let matte = json!({ "KHR_materials_specular": { "specularFactor": 0 } });
        let mut glass = self.material.clone();
        glass["emissiveFactor"] = json!([1, 1, 1]);
        glass["extensions"] = json!({ "KHR_materials_emissive_strength": { "emissiveStrength": EMISSION } });
        let file = json!({
            "asset": { "version": "2.0" },
            "nodes": [self.node, { "mesh": 1 }],
            "meshes": [
                { "primitives": [{ "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "indices": 2, "material": 0 }] },
                { "primitives": [{ "attributes": { "POSITION": 3 }, "indices": 4, "material": 1 }] },
            ],
            "materials": [glass, {
                "pbrMetallicRoughness": { "metallicFactor": 0 }, "extensions": matte
            }],
            "accessors": [
                { "bufferView": 0, "componentType": 5126, "count": self.corners.len(), "type": "VEC3",
                  "min": [low[0], low[1], 0], "max": [high[0], high[1], 0] },
                { "bufferView": 1, "componentType": 5126, "count": self.uv.len(), "type": "VEC2" },
                { "bufferView": 2, "componentType": 5123, "count": self.indices.len(), "type": "SCALAR" },
                { "bufferView": 3, "componentType": 5126, "count": 4, "type": "VEC3",
                  "min": [-3, 0, -3], "max": [3, 0, 3] },
                { "bufferView": 4, "componentType": 5123, "count": 6, "type": "SCALAR" },
            ],
            "bufferViews": views,
            "buffers": [{ "byteLength": bytes.len(), "uri": uri("application/octet-stream", &bytes) }],
            "images": [{ "uri": uri("image/png", png.get_ref()) }],
            "textures": [{ "source": 0, "sampler": 0 }],
            "samplers": [{ "wrapS": 33071, "wrapT": 33071 }],
        });
        gltf::from_slice(file.to_string().as_bytes(), "window", &Default::default()).unwrap()
    }

    /// The texels as evenly lit quads, by the radiance of each.
    fn quads(&self) -> Vec<([DVec2; 4], DVec3)> {
        let (columns, texels) = &self.image;
        let side = DVec2::new(1.6 / *columns as f64, 1.0 / (texels.len() / columns) as f64);
        let quad = |(index, texel): (usize, &[u8; 4])| {
            let at = DVec2::new((index % columns) as f64, (index / columns) as f64 + 1.0);
            let low = DVec2::new(-0.8, 1.2) + DVec2::new(at.x, -at.y) * side;
            let color = DVec3::from([0, 1, 2].map(|channel| f64::from(u8::from(texel[channel] > 0))));
            ([low, low + side.with_y(0.0), low + side, low + side.with_x(0.0)], EMISSION * color)
        };
        texels.iter().enumerate().map(quad).collect()
    }
}

/// What a point of the floor receives of such quads in a plane z = 0, as `place` puts that.
fn expected(quads: &[([DVec2; 4], DVec3)], place: DMat4, [x, z]: [f64; 2]) -> DVec3 {
    let point = DVec3::new(x, 0.0, z);
    let local_from_world = DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y).transpose();
    let lit = |(corners, radiance): &([DVec2; 4], DVec3)| {
        let seen = corners.map(|corner| local_from_world * (place.transform_point3(corner.extend(0.0)) - point));
        form_factor(&[seen.to_vec()], DMat3::IDENTITY, true) * *radiance
    };
    quads.iter().map(lit).sum()
}

/// The radiance of the point of the floor that a camera above it sees, with its standard error.
fn found(scene: &Scene, edits: &Edits, [x, z]: [f64; 2]) -> [DVec3; 2] {
    let eye = Mat4::from_cols(
        Vec3::X.extend(0.0),
        Vec3::NEG_Z.extend(0.0),
        Vec3::Y.extend(0.0),
        Vec3::new(x as f32, 5.0, z as f32).extend(1.0),
    );
    let camera = Camera {
        name: String::new(),
        world_from_camera: eye,
        projection: Projection::Perspective { yfov: 0.1, near: 0.1, far: 100.0 },
    };
    let options = Options { max_bounces: 0, shadows: true, filter: Filter::Centre, specular: SpecularModel::Ltc };
    let drawn = Drawn::new(scene, edits);
    let reference = Reference::new(&drawn, &SheenTable::embedded(), options).unwrap();
    let picture = reference.render(&camera, [1, 1], Effort { samples: 2048, seed: 1 }, |_, _| true).unwrap();
    [&picture.radiance, &picture.errors].map(|image| Vec3::from(image.pixels[0]).as_dvec3())
}

/// Holds every point of the floor to what the quads send; a relative `tolerance` is what else may be off.
fn check(scene: &Scene, edits: &Edits, quads: &[([DVec2; 4], DVec3)], place: DMat4, tolerance: f64) {
    for at in POINTS {
        let [found, error] = found(scene, edits, at);
        let expected = expected(quads, place, at);
        let allowed = ERRORS * error + (tolerance + 1e-5) * expected + 1e-7;
        assert!((found - expected).abs().cmple(allowed).all(), "{at:?}: {found}, not {expected} within {error}");
        assert!(error.cmple(0.1 * expected + 1e-9).all(), "{at:?}: {expected} is lost in {error}");
    }
}

fn check_window(window: &Window, place: DMat4) {
    check(&window.scene(), &Edits::default(), &window.quads(), place, 0.0);
}

fn only(scene: &Scene) -> &Light {
    let [light] = &scene.lights[..] else { panic!("{:?}", scene.lights) };
    light
}

/// Each place in a window: as it is, turned about, mirrored and stretched, and seen from behind.
fn places() -> Vec<(Value, DMat4)> {
    let node = |scale: DVec3, turn: DQuat, shift: DVec3| {
        let (scale_of, turn_of) = (scale.to_array(), turn.to_array());
        let node = json!({ "mesh": 0, "scale": scale_of, "rotation": turn_of, "translation": shift.to_array() });
        (node, DMat4::from_scale_rotation_translation(scale, turn, shift))
    };
    vec![
        node(DVec3::ONE, DQuat::IDENTITY, DVec3::ZERO),
        node(DVec3::new(1.5, 0.7, 2.0), DQuat::from_rotation_y(0.4), DVec3::new(0.1, 0.2, -0.6)),
        node(DVec3::new(-1.0, 1.0, 1.0), DQuat::IDENTITY, DVec3::ZERO),
        node(DVec3::ONE, DQuat::from_rotation_y(std::f64::consts::PI), DVec3::ZERO),
    ]
}

#[test]
fn a_window_lights_as_its_panes_do() {
    let bright: Vec<[u8; 4]> = (0..64).map(|at| if at == 21 { [255; 4] } else { BLACK }).collect();
    for (columns, texels) in [(2, vec![RED, GREEN]), (1, vec![RED, BLUE, GREEN]), (8, bright)] {
        for (node, place) in places() {
            let mut window = Window::new(columns, &texels);
            window.material["doubleSided"] = json!(true);
            window.node = node;
            check_window(&window, place);
        }
    }
}

/// A turned image lies on the window as its own grid does.
#[test]
fn a_turned_texture_lights_as_it_lies() {
    let texels: Vec<[u8; 4]> =
        (0..64).map(|at| [BLACK, RED, GREEN][usize::from(at == 27) + 2 * usize::from(at == 36)]).collect();
    let mut window = Window::new(8, &texels);
    let (sin, cos) = 0.5f64.sin_cos();
    // About the middle, and as large along both sides: 1.6 m are the image's whole width.
    let uv = |[x, y]: [f32; 2]| {
        let (x, y) = (f64::from(x) / 1.6, (0.7 - f64::from(y)) / 1.6);
        [(0.5 + cos * x - sin * y) as f32, (0.5 + sin * x + cos * y) as f32]
    };
    window.uv = window.corners.iter().map(|&corner| uv(corner)).collect();
    let place = |u: f64, v: f64| {
        let (u, v) = (1.6 * (u - 0.5), 1.6 * (v - 0.5));
        DVec2::new(cos * u + sin * v, 0.7 - (cos * v - sin * u))
    };
    let quad = |index: u32, radiance: DVec3| {
        let (u, v) = (f64::from(index % 8) / 8.0, f64::from(index / 8) / 8.0);
        ([place(u, v), place(u + 0.125, v), place(u + 0.125, v + 0.125), place(u, v + 0.125)], EMISSION * radiance)
    };
    let quads = [quad(27, DVec3::X), quad(36, DVec3::Y)];
    let scene = window.scene();
    check(&scene, &Edits::default(), &quads, DMat4::IDENTITY, 0.0);
    // The same by KHR_texture_transform.
    window.uv = window.corners.iter().map(|&[x, y]| [0.5 + x / 1.6, 0.5 + (0.7 - y) / 1.6]).collect();
    let offset = [0.5 - 0.5 * (cos - sin), 0.5 - 0.5 * (sin + cos)];
    // glTF turns the other way round.
    let transform = json!({ "rotation": -0.5, "offset": offset });
    window.material["emissiveTexture"]["extensions"] = json!({ "KHR_texture_transform": transform });
    check(&window.scene(), &Edits::default(), &quads, DMat4::IDENTITY, 0.0);
}

/// Two halves that each show an image of their own way, and a sheared one: sampled anew, right to a cell's width.
#[test]
fn what_has_no_grid_of_its_own_is_sampled() {
    let mut window = Window::new(2, &[RED, GREEN]);
    window.corners.extend([[0.0, 0.2], [0.0, 1.2]]);
    // The left half is red, and the right one runs from green to red.
    window.uv = vec![[0.1, 0.0], [1.6, 0.0], [1.6, 0.0], [0.1, 0.0], [0.2, 0.0], [0.2, 1.0]];
    window.indices = vec![0, 4, 5, 0, 5, 3, 4, 1, 2, 4, 2, 5];
    let scene = window.scene();
    let pattern = only(&scene).polygons[0].pattern.as_ref().unwrap();
    assert!(pattern.image.size[0] >= 64, "{:?}", pattern.image.size);
    let strip = |left: f64, right: f64, radiance: DVec3| {
        let corner = |x: f64, y: f64| DVec2::new(x, y);
        ([corner(left, 0.2), corner(right, 0.2), corner(right, 1.2), corner(left, 1.2)], EMISSION * radiance)
    };
    // Between the texels' centres, at u = 0.25 and 0.75, the right half is interpolated.
    let strips = (0..400).map(|at| {
        let (left, right) = (f64::from(at) / 500.0, f64::from(at + 1) / 500.0);
        let green = ((0.2 + 1.4 * (left + right) / 1.6 - 0.25) / 0.5).clamp(0.0, 1.0);
        strip(left, right, DVec3::new(1.0 - green, green, 0.0))
    });
    let quads: Vec<_> = strips.chain([strip(-0.8, 0.0, DVec3::X)]).collect();
    check(&scene, &Edits::default(), &quads, DMat4::IDENTITY, 2e-3);
}

/// Where the mask is clear nothing shines, and where a blended window is half clear, half of it does.
#[test]
fn opacity_counts_in_a_pattern() {
    for (mode, alpha, share) in [("MASK", 200, 1.0), ("BLEND", 51, 0.2), ("OPAQUE", 51, 1.0)] {
        let [mut red, mut green] = [RED, GREEN];
        (red[3], green[3]) = (alpha, alpha);
        let mut window = Window::new(4, &[red, CLEAR, green, CLEAR, green, green, CLEAR, red]);
        window.material["alphaMode"] = json!(mode);
        window.material["pbrMetallicRoughness"] = json!({ "baseColorTexture": { "index": 0 } });
        let mut quads = window.quads();
        quads.iter_mut().for_each(|(_, radiance)| *radiance *= share);
        check(&window.scene(), &Edits::default(), &quads, DMat4::IDENTITY, 1e-5);
    }
}

#[test]
fn a_pattern_has_the_texels_of_the_image() {
    let texels: Vec<[u8; 4]> = (0..35).map(|at: u32| [(7 * at % 256) as u8, (at * at % 251) as u8, 0, 255]).collect();
    let scene = Window::new(7, &texels).scene();
    let light = only(&scene);
    let pattern = light.polygons[0].pattern.as_ref().unwrap();
    assert_eq!(pattern.image.size, [7, 5]);
    let sum: Vec3 = pattern.image.texels.iter().sum();
    assert!((sum / 35.0).truncate().abs_diff_eq(glam::Vec2::ONE, 1e-6), "{}", sum / 35.0);
    for (texel, factor) in texels.iter().zip(&pattern.image.texels) {
        let linear = |channel: usize| velour::scene::linear_from_srgb(texel[channel]) * EMISSION as f32;
        let found = light.radiance * *factor;
        assert!((found.x - linear(0)).abs() < 1e-6 && (found.y - linear(1)).abs() < 1e-6, "{found}");
    }
    // Rows run down from the first corner.
    assert!(pattern.origin.abs_diff_eq(Vec3::new(-0.8, 1.2, 0.0), 1e-6));
    assert!(pattern.axes[1].abs_diff_eq(Vec3::new(0.0, -1.0, 0.0), 1e-6), "{:?}", pattern.axes);
}

#[test]
fn an_even_texture_leaves_no_pattern() {
    let mut window = Window::new(2, &[[255; 4]; 6]);
    let textured = window.scene();
    window.material = json!({});
    let plain = window.scene();
    assert_eq!(format!("{:?}", textured.lights), format!("{:?}", plain.lights));
    assert!(only(&plain).polygons[0].pattern.is_none());
    let mut window = Window::new(2, &[[90, 20, 0, 255]; 6]);
    window.uv[1] = [7.3, -0.4];
    assert!(only(&window.scene()).polygons[0].pattern.is_none());
}

/// A light that an edit moves takes its pattern along, and one that is made brighter keeps it.
#[test]
fn a_pattern_moves_with_its_light() {
    let window = Window::new(2, &[RED, GREEN]);
    let scene = window.scene();
    let shift = Vec3::new(0.3, 0.5, -0.25);
    let edit =
        LightEdits { position: Some(only(&scene).position() + shift), strength: Some(2.0), ..LightEdits::default() };
    let edits = Edits { lights: [(0, edit)].into(), ..Edits::default() };
    let mut quads = window.quads();
    let ratio = Drawn::new(&scene, &edits).lights[0].radiance.as_dvec3() / only(&scene).radiance.as_dvec3();
    quads.iter_mut().for_each(|(_, radiance)| *radiance *= ratio.x);
    assert!(ratio.x > 1.0);
    check(&scene, &edits, &quads, DMat4::from_translation(shift.as_dvec3()), 1e-6);
}
