// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
//! One scene, for Bevy and as glTF: two balls on a floor under two rectangle lights, of which one reaches below the
//! floor's horizon.

use std::f32::consts::{FRAC_PI_2, PI, TAU};

use bevy::asset::RenderAssetUsages;
use bevy::camera::RenderTarget;
use bevy::core_pipeline::tonemapping::{DebandDither, Tonemapping};
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::prelude::*;
use velour_bevy::panel::panel;
use velour_bevy::sheen::{EXPOSURE_OF_ONE, Sheen, SheenMaterial};

pub struct Shape {
    pub positions: Vec<[f32; 3]>,
    pub normals: Vec<[f32; 3]>,
    pub indices: Vec<u16>,
}

pub struct Thing {
    pub name: &'static str,
    pub shape: Shape,
    pub place: Transform,
    pub base_color: [f32; 3],
    pub roughness: f32,
    pub metallic: f32,
    pub sheen_color: [f32; 3],
    pub alpha: f32,
}

/// Shines along its +z, as a rectangle of glTF does.
pub struct Light {
    pub name: &'static str,
    pub radiance: [f32; 3],
    pub size: [f32; 2],
    pub place: Transform,
}

pub const YFOV: f32 = 0.75;
pub const NEAR: f32 = 0.05;
pub const FAR: f32 = 50.0;

pub fn eye() -> Transform {
    Transform::from_xyz(0.0, 1.2, 3.2).with_rotation(Quat::from_rotation_x(-0.245))
}

pub fn things() -> [Thing; 3] {
    [
        Thing {
            name: "velvet",
            shape: ball(0.5, 64, 32),
            place: Transform::from_xyz(-0.6, 0.5, 0.0),
            base_color: [0.1, 0.02, 0.15],
            roughness: 0.5,
            metallic: 0.0,
            sheen_color: [0.9, 0.5, 0.3],
            alpha: 0.35,
        },
        Thing {
            name: "dusty brass",
            shape: ball(0.4, 64, 32),
            place: Transform::from_xyz(0.55, 0.4, 0.2),
            base_color: [0.8, 0.6, 0.3],
            roughness: 0.4,
            metallic: 1.0,
            sheen_color: [0.4, 0.5, 0.7],
            alpha: 0.8,
        },
        Thing {
            name: "floor",
            shape: rectangle([4.0, 4.0]),
            place: Transform::from_rotation(Quat::from_rotation_x(-FRAC_PI_2)),
            base_color: [0.3, 0.3, 0.32],
            roughness: 0.3,
            metallic: 0.0,
            sheen_color: [0.5, 0.45, 0.4],
            alpha: 0.6,
        },
    ]
}

pub fn lights() -> [Light; 2] {
    [
        Light {
            name: "warm",
            radiance: [12.0, 8.4, 4.8],
            size: [0.8, 0.5],
            place: Transform::from_xyz(-0.2, 1.7, 0.3).with_rotation(Quat::from_rotation_x(1.2)),
        },
        Light {
            name: "cool",
            radiance: [2.7, 5.4, 9.0],
            size: [0.6, 1.2],
            place: Transform::from_xyz(1.4, 0.3, -0.2).with_rotation(Quat::from_rotation_y(-1.2)),
        },
    ]
}

fn ball(radius: f32, columns: u16, rows: u16) -> Shape {
    let normals: Vec<[f32; 3]> = (0..=rows)
        .flat_map(|row| (0..=columns).map(move |column| (row, column)))
        .map(|(row, column)| {
            let (theta, phi) = (PI * f32::from(row) / f32::from(rows), TAU * f32::from(column) / f32::from(columns));
            [theta.sin() * phi.sin(), theta.cos(), theta.sin() * phi.cos()]
        })
        .collect();
    let positions = normals.iter().map(|normal| normal.map(|x| radius * x)).collect();
    let corners = (0..rows).flat_map(|row| (0..columns).map(move |column| row * (columns + 1) + column));
    let indices = corners.flat_map(|first| {
        let below = first + columns + 1;
        [first, below, below + 1, first, below + 1, first + 1]
    });
    Shape { positions, normals, indices: indices.collect() }
}

/// In the plane z = 0, seen from +z.
pub fn rectangle(size: [f32; 2]) -> Shape {
    let [x, y] = size.map(|side| side / 2.0);
    let positions = vec![[-x, -y, 0.0], [x, -y, 0.0], [x, y, 0.0], [-x, y, 0.0]];
    Shape { positions, normals: vec![[0.0, 0.0, 1.0]; 4], indices: vec![0, 1, 2, 0, 2, 3] }
}

/// Spawns it, with a camera whose picture is radiance; `sheen` makes the layer of a colour and an alpha.
pub fn spawn(world: &mut World, target: RenderTarget, sheen: impl Fn(LinearRgba, f32) -> Sheen) {
    for Thing { shape, place, base_color, roughness, metallic, sheen_color, alpha, .. } in things() {
        let mesh = Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
            .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, shape.positions)
            .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, shape.normals)
            .with_inserted_indices(Indices::U16(shape.indices));
        let mesh = world.resource_mut::<Assets<Mesh>>().add(mesh);
        let base_color = linear(base_color).into();
        let base = StandardMaterial { base_color, perceptual_roughness: roughness, metallic, ..default() };
        let material = SheenMaterial { base, extension: sheen(linear(sheen_color), alpha) };
        let material = world.resource_mut::<Assets<SheenMaterial>>().add(material);
        world.spawn((Mesh3d(mesh), MeshMaterial3d(material), place));
    }
    for Light { radiance, size, place, .. } in lights() {
        // Bevy's lights shine along -z.
        panel(world, linear(radiance), size.into(), place * Transform::from_rotation(Quat::from_rotation_y(PI)));
    }
    let lens = PerspectiveProjection { fov: YFOV, near: NEAR, far: FAR, ..default() };
    let lens = Projection::Perspective(lens);
    let plain = (EXPOSURE_OF_ONE, Tonemapping::None, DebandDither::Disabled, Msaa::Off);
    world.spawn((Camera3d::default(), target, plain, lens, eye()));
    world.insert_resource(ClearColor(Color::NONE));
    world.insert_resource(GlobalAmbientLight::NONE);
}

fn linear([red, green, blue]: [f32; 3]) -> LinearRgba {
    LinearRgba::rgb(red, green, blue)
}
