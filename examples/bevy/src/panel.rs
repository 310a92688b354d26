// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
//! A rectangle light that is seen.

use bevy::prelude::*;

use crate::sheen::rect_light_intensity;

/// No surface is so far from a light that its range dims it.
const RANGE: f32 = 1e4;

/// A light of a radiance, and a rectangle that glows as bright; both shine along -z of the entity.
pub fn panel(world: &mut World, radiance: LinearRgba, size: Vec2, transform: Transform) {
    let mesh = world.resource_mut::<Assets<Mesh>>().add(Rectangle::from_size(size));
    let glow = StandardMaterial { base_color: radiance.into(), unlit: true, ..default() };
    let material = world.resource_mut::<Assets<StandardMaterial>>().add(glow);
    let intensity = rect_light_intensity(1.0, size.x, size.y);
    let light = RectLight { color: radiance.into(), intensity, range: RANGE, width: size.x, height: size.y };
    // A rectangle's front is its +z.
    let turned = Transform::from_rotation(Quat::from_rotation_y(std::f32::consts::PI));
    world.spawn((light, transform, children![(Mesh3d(mesh), MeshMaterial3d(material), turned)]));
}
