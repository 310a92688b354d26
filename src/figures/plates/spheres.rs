//! Plates of one sphere under one window.

use super::ball::{self, Lit};
use super::plate::{Plate, PlateError, Progress, Shot};
use super::stage::{DISTANCE, EYE, HALF, RADIANCE, YFOV, window};
use crate::picture::DisplayImage;
use crate::reference::Options;
use crate::scene::{
    Camera, Edits, Instance, Layering, Light, Material, MaterialEdits, Mesh, Polygon, Projection, Scene, Sheen,
    SheenModel,
};
use glam::{Mat4, Vec3};
use std::f32::consts::{PI, TAU};

/// Angles between the directions to the window and to the camera, degrees.
pub(super) const ANGLES: [f32; 3] = [0.0, 90.0, 130.0];
/// Roughness in the comparison with prior work.
pub(super) const ALPHA: f32 = 0.5;
/// Roughnesses of the sweep.
pub(super) const ALPHAS: [f32; 6] = [0.1, 0.25, 0.4, 0.55, 0.75, 1.0];
/// Roughnesses of the other comparisons.
pub(super) const LAYER_ALPHAS: [f32; 3] = [0.25, 0.5, 1.0];

fn sphere() -> Mesh {
    const ROWS: u32 = 96;
    const COLUMNS: u32 = 192;
    let at = |row: u32, column: u32| {
        let (polar, azimuth) = (PI * row as f32 / ROWS as f32, TAU * column as f32 / COLUMNS as f32);
        Vec3::new(polar.sin() * azimuth.sin(), polar.cos(), polar.sin() * azimuth.cos())
    };
    let normals: Vec<Vec3> = (0..=ROWS).flat_map(|row| (0..=COLUMNS).map(move |column| at(row, column))).collect();
    let cell = |row: u32, column: u32| {
        let (a, b) = (row * (COLUMNS + 1) + column, (row + 1) * (COLUMNS + 1) + column);
        [a, b, b + 1, a, b + 1, a + 1]
    };
    let indices = (0..ROWS).flat_map(|row| (0..COLUMNS).flat_map(move |column| cell(row, column))).collect();
    Mesh { name: "sphere".to_owned(), positions: normals.clone(), normals, indices, ..Mesh::default() }
}

/// A sphere of this material, the window at an angle in degrees, and the camera.
fn scene(material: Material, degrees: f32) -> Scene {
    let [middle, right, up] = window(degrees.to_radians());
    let corners = vec![middle - right - up, middle + right - up, middle + right + up, middle - right + up];
    let emission = Vec3::splat(RADIANCE);
    let back = -middle.normalize();
    let window = Mesh {
        name: "window".to_owned(),
        positions: corners.clone(),
        normals: vec![back; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        material: 1,
        ..Mesh::default()
    };
    let instance = |mesh: usize| Instance { name: String::new(), mesh, world_from_mesh: Mat4::IDENTITY };
    let light = Light {
        name: "window".to_owned(),
        radiance: emission,
        two_sided: false,
        polygons: vec![Polygon { contours: vec![corners], normal: back, pattern: None }],
        instance: 1,
        ..Light::default()
    };
    Scene {
        meshes: vec![sphere(), window],
        instances: vec![instance(0), instance(1)],
        materials: vec![material, Material { emission, ..Material::matte("window", Vec3::ZERO) }],
        lights: vec![light],
        cameras: vec![Camera {
            name: "camera".to_owned(),
            world_from_camera: Mat4::from_translation(EYE * Vec3::Z),
            projection: Projection::Perspective { yfov: YFOV, near: 0.1, far: f32::INFINITY },
        }],
        ..Scene::default()
    }
}

/// White fibres over a base of this colour.
fn fuzzy(alpha: f32, base: Vec3) -> Material {
    Material { sheen: Some(Sheen::new(Vec3::ONE, alpha)), ..Material::matte("sphere", base) }
}

fn look(model: SheenModel, layering: Layering) -> Edits {
    let every_material =
        MaterialEdits { sheen_model: Some(model), layering: Some(layering), ..MaterialEdits::default() };
    Edits { every_material, lights_visible: Some(false), ..Edits::default() }
}

fn shot(side: u32, samples: u64, exposure: f32) -> Shot {
    Shot { size: [side; 2], samples, exposure, options: Options::default() }
}

fn says(degrees: f32, base: Vec3) -> String {
    format!(
        "sphere of radius 1, base {}; window of {}x{} m at {DISTANCE} m, {degrees} degrees from the camera, radiance {RADIANCE}",
        base.x,
        2.0 * HALF,
        2.0 * HALF
    )
}

/// A plate of the sphere.
fn plate(name: String, (material, degrees): (Material, f32), edits: Edits, shot: Shot) -> Plate {
    let alpha = material.sheen.map_or(0.0, |sheen| sheen.alpha());
    let MaterialEdits { sheen_model, layering, .. } = edits.every_material;
    let (model, layering) = (sheen_model.unwrap_or_default(), layering.unwrap_or_default());
    let mut lines = vec![
        ("scene", says(degrees, material.base_color)),
        ("sheen", format!("{}, alpha {alpha}, C_sheen 1; layering {layering:?}", model.name()).to_lowercase()),
    ];
    lines.extend(shot.settings());
    let make = move |progress: &Progress| shot.take(&scene(material.clone(), degrees), &edits, progress);
    Plate { name, settings: lines, make: Box::new(make) }
}

/// The paper's figure 2: rows are models, columns angles.
pub fn prior_work() -> Vec<Plate> {
    let mut plates = Vec::new();
    for degrees in ANGLES {
        for model in [
            SheenModel::Ltc,
            SheenModel::Burley,
            SheenModel::NeubeltPettineo,
            SheenModel::ContyKulla,
            SheenModel::Patry,
        ] {
            let name = format!("sphere_{}_{degrees}", model.name());
            let material = (fuzzy(ALPHA, Vec3::ZERO), degrees);
            plates.push(plate(name, material, look(model, Layering::Gltf), shot(128, 32, 0.0)));
        }
        plates.push(fibres(degrees));
    }
    plates
}

/// The same of explicit fibres.
fn fibres(degrees: f32) -> Plate {
    const SIDE: u32 = 128;
    let lit = Lit { window: window(degrees.to_radians()), radiance: RADIANCE, samples: 384 };
    let mut settings = vec![("scene", says(degrees, Vec3::ZERO)), ("fibres", ball::says(ALPHA.into()))];
    settings.push(("size", format!("{SIDE}x{SIDE}")));
    settings.push(("samples", lit.samples.to_string()));
    let make = move |progress: &Progress| -> Result<DisplayImage, PlateError> {
        ball::picture(ALPHA.into(), &lit, SIDE, progress)
    };
    Plate { name: format!("sphere_fibres_{degrees}"), settings, make: Box::new(make) }
}

/// All models over roughness, lit from the side.
pub fn sweep() -> Vec<Plate> {
    let models =
        [SheenModel::Ltc, SheenModel::Slab, SheenModel::NeubeltPettineo, SheenModel::ContyKulla, SheenModel::Patry];
    let cell = |model: SheenModel, alpha: f32| {
        let name = format!("sweep_{}_{alpha}", model.name());
        plate(name, (fuzzy(alpha, Vec3::ZERO), 60.0), look(model, Layering::Gltf), shot(96, 32, 0.0))
    };
    models.into_iter().flat_map(|model| ALPHAS.map(|alpha| cell(model, alpha))).collect()
}

/// The fit, the slab and the walk; and the layering rules over a white and a grey base against the walk through both.
pub fn layers() -> Vec<Plate> {
    let of_one_slab = LAYER_ALPHAS.into_iter().flat_map(|alpha| {
        [SheenModel::Ltc, SheenModel::Slab, SheenModel::Walk].map(|model| {
            let name = format!("layers_{}_{alpha}", model.name());
            let samples = if model == SheenModel::Walk { 256 } else { 32 };
            plate(name, (fuzzy(alpha, Vec3::ZERO), 60.0), look(model, Layering::Gltf), shot(128, samples, 0.0))
        })
    });
    let rules = [
        ("gltf", Layering::Gltf),
        ("openpbr", Layering::OpenPbr),
        ("reciprocal", Layering::Reciprocal),
        ("none", Layering::None),
        ("stack", Layering::Walk),
    ];
    let over_a_base = LAYER_ALPHAS.into_iter().flat_map(|alpha| {
        rules.map(|(rule, layering)| {
            let name = format!("rules_{rule}_{alpha}");
            let samples = if layering == Layering::Walk { 256 } else { 32 };
            let material = (fuzzy(alpha, Vec3::splat(0.5)), 60.0);
            plate(name, material, look(SheenModel::Slab, layering), shot(128, samples, 0.0))
        })
    });
    of_one_slab.chain(over_a_base).collect()
}
