// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
//! The scene that the program shows: a velvet cloth, a ring and a ball on a dusty floor, under three rectangle lights.

use bevy::camera::RenderTarget;
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::prelude::*;

use crate::cloth::cloth;
use crate::panel::panel;
use crate::sheen::{EXPOSURE_OF_ONE, RectLightTerms, Sheen, SheenMaterial, SheenTables};

/// Name, colour of the fibres, colour of what is below them.
const COLORS: [(&str, [f32; 3], [f32; 3]); 4] = [
    ("plum", [0.80, 0.45, 0.75], [0.06, 0.01, 0.06]),
    ("moss", [0.55, 0.75, 0.35], [0.02, 0.05, 0.01]),
    ("night", [0.40, 0.50, 0.90], [0.01, 0.01, 0.05]),
    ("white", [1.0, 1.0, 1.0], [0.05, 0.05, 0.05]),
];

/// What the keys change.
#[derive(Clone, Resource)]
pub struct Look {
    pub alpha: f32,
    pub color: usize,
    pub sheen: bool,
    pub terms: RectLightTerms,
}

impl Default for Look {
    fn default() -> Self {
        Self { alpha: 0.4, color: 0, sheen: true, terms: RectLightTerms::Velour }
    }
}

impl Look {
    pub fn next_color(&mut self) {
        self.color = (self.color + 1) % COLORS.len();
    }

    /// One line on what is seen, and one on the keys.
    pub fn text(&self) -> String {
        let name = COLORS[self.color].0;
        let sheen = if self.sheen { format!("sheen: alpha {:.2}, {name}", self.alpha) } else { "no sheen".into() };
        let terms = format!("base: {:?}'s terms", self.terms);
        format!("{sheen}; {terms}\nleft, right: alpha   C: colour   S: sheen   B: base   drag: turn")
    }

    fn sheen(&self, tables: &SheenTables) -> Sheen {
        let color = if self.sheen { linear(COLORS[self.color].1) } else { LinearRgba::BLACK };
        Sheen { terms: self.terms, ..tables.sheen(color, self.alpha) }
    }

    /// Gives all velvet this look.
    pub fn wear(&self, velvets: &Velvets, tables: &SheenTables, materials: &mut Assets<SheenMaterial>) {
        for (handle, fixed) in [(&velvets.cloth, None), (&velvets.floor, Some((LinearRgba::gray(0.25), 1.0)))] {
            let Some(mut material) = materials.get_mut(handle) else { continue };
            material.extension = self.sheen(tables);
            match fixed {
                Some((color, alpha)) if self.sheen => {
                    (material.extension.color, material.extension.alpha) = (color, alpha)
                }
                Some(_) => {}
                None => material.base.base_color = linear(COLORS[self.color].2).into(),
            }
        }
    }
}

/// The materials that a look changes.
#[derive(Resource)]
pub struct Velvets {
    cloth: Handle<SheenMaterial>,
    floor: Handle<SheenMaterial>,
}

fn linear([red, green, blue]: [f32; 3]) -> LinearRgba {
    LinearRgba::rgb(red, green, blue)
}

/// Where the camera is, seen from what it looks at.
#[derive(Clone, Component)]
pub struct Orbit {
    pub around: f32,
    pub above: f32,
    pub away: f32,
}

impl Orbit {
    pub fn transform(&self) -> Transform {
        let turn = Quat::from_euler(EulerRot::YXZ, self.around, -self.above, 0.0);
        let centre = Vec3::new(0.0, 0.68, 0.0);
        Transform::from_translation(centre + turn * (self.away * Vec3::Z)).looking_at(centre, Vec3::Y)
    }
}

/// Spawns all of it, with a camera that draws into `target`.
pub fn spawn(world: &mut World, target: RenderTarget) {
    things(world);
    lights(world);
    let orbit = Orbit { around: 0.35, above: 0.3, away: 3.7 };
    let place = orbit.transform();
    world.spawn((Camera3d::default(), target, EXPOSURE_OF_ONE, Tonemapping::AcesFitted, place, orbit));
    world.insert_resource(ClearColor(Color::BLACK));
    // Bevy's default is a radiance of 80.
    world.insert_resource(GlobalAmbientLight::NONE);
}

fn things(world: &mut World) {
    let tables = world.resource::<SheenTables>().clone();
    let sheen = tables.sheen(LinearRgba::BLACK, 0.0);
    let base = StandardMaterial { perceptual_roughness: 0.7, double_sided: true, cull_mode: None, ..default() };
    let floor = StandardMaterial { base_color: LinearRgba::gray(0.04).into(), perceptual_roughness: 0.5, ..default() };
    let mut materials = world.resource_mut::<Assets<SheenMaterial>>();
    let velvets = Velvets {
        cloth: materials.add(SheenMaterial { base, extension: sheen.clone() }),
        floor: materials.add(SheenMaterial { base: floor, extension: sheen }),
    };
    let look = Look::default();
    look.wear(&velvets, &tables, &mut materials);
    let mut meshes = world.resource_mut::<Assets<Mesh>>();
    let things = [
        (meshes.add(cloth()), &velvets.cloth, Transform::from_xyz(-0.15, 0.9, -0.3)),
        (meshes.add(Sphere::new(0.32).mesh().uv(96, 48)), &velvets.cloth, Transform::from_xyz(1.0, 0.32, 0.45)),
        (meshes.add(Torus::new(0.14, 0.42)), &velvets.cloth, Transform::from_xyz(-1.1, 0.14, 0.75)),
        (meshes.add(Plane3d::default().mesh().size(12.0, 12.0)), &velvets.floor, Transform::IDENTITY),
    ];
    let things = things.map(|(mesh, material, place)| (Mesh3d(mesh), MeshMaterial3d(material.clone()), place));
    world.spawn_batch(things);
    world.insert_resource(velvets);
    world.insert_resource(look);
}

fn lights(world: &mut World) {
    let panels = [
        (LinearRgba::rgb(22.0, 19.0, 16.0), Vec2::new(1.4, 1.4), Vec3::new(-2.2, 2.3, 2.2)),
        (LinearRgba::rgb(8.0, 12.0, 20.0), Vec2::new(0.8, 2.0), Vec3::new(1.9, 1.4, -1.7)),
        (LinearRgba::rgb(20.0, 17.0, 14.0), Vec2::new(1.8, 0.6), Vec3::new(-0.9, 2.6, -1.6)),
    ];
    for (radiance, size, place) in panels {
        let target = Vec3::new(0.0, 0.6, 0.0);
        panel(world, radiance, size, Transform::from_translation(place).looking_at(target, Vec3::Y));
    }
}
