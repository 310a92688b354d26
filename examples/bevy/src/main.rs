// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
//! A window on the velvet scene, or with `--picture FILE.png` one picture of it without a window.

use std::process::ExitCode;

use bevy::asset::RenderAssetUsages;
use bevy::camera::RenderTarget;
use bevy::input::mouse::AccumulatedMouseMotion;
use bevy::prelude::*;
use bevy::render::render_resource::{Extent3d, TextureDimension, TextureFormat};
use velour_bevy::headless::Headless;
use velour_bevy::sheen::{RectLightTerms, SheenMaterial, SheenPlugin, SheenTables};
use velour_bevy::velvet::{self, Look, Orbit, Velvets};

const PICTURE: UVec2 = UVec2::new(1280, 720);
/// Turns a second, until a drag stops it, in radians.
const SLOW: f32 = 0.15;
/// Radians a pixel of a drag.
const DRAG: f32 = 0.006;
/// Change of alpha a second.
const GLIDE: f32 = 0.4;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match arguments[..] {
        [] => window(),
        ["--picture", path] => picture(path),
        _ => Err("usage: velour-bevy [--picture FILE.png]".into()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::from(2)
        }
    }
}

fn picture(path: &str) -> Result<(), String> {
    let mut headless = Headless::new(PICTURE, TextureFormat::Rgba8UnormSrgb);
    let target = headless.target();
    velvet::spawn(headless.app.world_mut(), target);
    let bytes = headless.picture().ok_or("the graphics device gave no picture back")?;
    let size = Extent3d { width: PICTURE.x, height: PICTURE.y, depth_or_array_layers: 1 };
    let format = TextureFormat::Rgba8UnormSrgb;
    let image = Image::new(size, TextureDimension::D2, bytes, format, RenderAssetUsages::MAIN_WORLD);
    let image = image.try_into_dynamic().map_err(|error| error.to_string())?;
    image.to_rgb8().save(path).map_err(|error| format!("{path}: {error}"))
}

fn window() -> Result<(), String> {
    let is_unseen = |name: &str| std::env::var_os(name).is_none_or(|value| value.is_empty());
    if cfg!(target_os = "linux") && is_unseen("DISPLAY") && is_unseen("WAYLAND_DISPLAY") {
        return Err("there is no display: `cargo run -- --picture velvet.png` draws without one".into());
    }
    let window = Window { title: "Velour in Bevy".into(), ..default() };
    App::new()
        .add_plugins(DefaultPlugins.set(WindowPlugin { primary_window: Some(window), ..default() }))
        .add_plugins(SheenPlugin)
        .add_systems(Startup, setup)
        .add_systems(Update, (turn, change, tell).chain())
        .run();
    Ok(())
}

fn setup(world: &mut World) {
    velvet::spawn(world, RenderTarget::default());
    let place = Node { position_type: PositionType::Absolute, top: px(12), left: px(12), ..default() };
    world.spawn((Text::default(), TextFont { font_size: FontSize::Px(16.0), ..default() }, place));
}

fn turn(
    time: Res<Time>,
    buttons: Res<ButtonInput<MouseButton>>,
    mouse: Res<AccumulatedMouseMotion>,
    mut was_dragged: Local<bool>,
    mut cameras: Query<(&mut Orbit, &mut Transform)>,
) {
    let is_dragged = buttons.pressed(MouseButton::Left);
    *was_dragged |= is_dragged;
    for (mut orbit, mut transform) in &mut cameras {
        if is_dragged {
            orbit.around -= DRAG * mouse.delta.x;
            orbit.above = (orbit.above + DRAG * mouse.delta.y).clamp(0.02, 1.5);
        } else if !*was_dragged {
            orbit.around += SLOW * time.delta_secs();
        }
        *transform = orbit.transform();
    }
}

fn change(
    time: Res<Time>,
    keys: Res<ButtonInput<KeyCode>>,
    tables: Res<SheenTables>,
    velvets: Res<Velvets>,
    mut look: ResMut<Look>,
    mut materials: ResMut<Assets<SheenMaterial>>,
) {
    let steps = f32::from(i8::from(keys.pressed(KeyCode::ArrowRight)) - i8::from(keys.pressed(KeyCode::ArrowLeft)));
    if steps != 0.0 {
        look.alpha = (look.alpha + GLIDE * time.delta_secs() * steps).clamp(0.0, 1.0);
    }
    if keys.just_pressed(KeyCode::KeyC) {
        look.next_color();
    }
    if keys.just_pressed(KeyCode::KeyS) {
        look.sheen = !look.sheen;
    }
    if keys.just_pressed(KeyCode::KeyB) {
        look.terms = match look.terms {
            RectLightTerms::Velour => RectLightTerms::Bevy,
            RectLightTerms::Bevy => RectLightTerms::Velour,
        };
    }
    if look.is_changed() {
        look.wear(&velvets, &tables, &mut materials);
    }
}

fn tell(look: Res<Look>, mut texts: Query<&mut Text>) {
    if look.is_changed() {
        texts.iter_mut().for_each(|mut text| text.0 = look.text());
    }
}
