// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
//! A cloth that hangs over a ball, in folds.

use std::f32::consts::{FRAC_PI_2, TAU};

use bevy::asset::RenderAssetUsages;
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::prelude::*;

const BALL: f32 = 0.55;
/// From the ball's top to the hem.
const LENGTH: f32 = 1.75;
const FOLDS: f32 = 9.0;
/// How deep the folds are at the hem.
const DEPTH: f32 = 0.16;
/// How much wider the cloth grows over the square of the length that hangs down.
const FLARE: f32 = 0.25;
const COLUMNS: u32 = 360;
const ROWS: u32 = 120;

/// The cloth; the ball's centre is the origin. It is seen from both sides.
pub fn cloth() -> Mesh {
    let nodes = || (0..=ROWS).flat_map(|row| (0..=COLUMNS).map(move |column| at(row, column)));
    let positions: Vec<_> = nodes().map(|(along, around)| point(along, around)).collect();
    let normals: Vec<_> = nodes().map(|(along, around)| normal(along, around)).collect();
    let corners = (0..ROWS).flat_map(|row| (0..COLUMNS).map(move |column| row * (COLUMNS + 1) + column));
    let indices = corners.flat_map(|first| {
        let below = first + COLUMNS + 1;
        [first, below + 1, below, first, first + 1, below + 1]
    });
    Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
        .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, normals)
        .with_inserted_indices(Indices::U32(indices.collect()))
}

fn at(row: u32, column: u32) -> (f32, f32) {
    (LENGTH * row as f32 / ROWS as f32, TAU * column as f32 / COLUMNS as f32)
}

/// The point at a length from the top, in the direction of an angle.
fn point(along: f32, around: f32) -> Vec3 {
    let cap = BALL * FRAC_PI_2;
    let (radius, y) = if along < cap {
        let (sine, cosine) = (along / BALL).sin_cos();
        (BALL * sine, BALL * cosine)
    } else {
        (BALL + FLARE * (along - cap).powi(2), cap - along)
    };
    let hanging = ((along - 0.4 * cap) / (LENGTH - 0.4 * cap)).clamp(0.0, 1.0);
    let fold = DEPTH * hanging.powi(2) * (FOLDS * around + 1.3 * (2.0 * around).sin()).cos();
    Vec3::new((radius + fold) * around.cos(), y, (radius + fold) * around.sin())
}

/// By differences; at the top, where all angles meet, straight up.
fn normal(along: f32, around: f32) -> Vec3 {
    const STEP: f32 = 1e-3;
    let down = point(along + STEP, around) - point((along - STEP).max(0.0), around);
    let across = point(along, around + STEP) - point(along, around - STEP);
    across.cross(down).try_normalize().unwrap_or(Vec3::Y)
}
