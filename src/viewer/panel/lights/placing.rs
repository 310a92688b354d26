//! Where a light stands, where it shines, and how large it is, by numbers.

use std::f32::consts::FRAC_PI_2;

use egui::Ui;
use glam::{EulerRot, Quat, Vec2, Vec3};

use super::super::super::widgets::{Touch, number_box, row};
use crate::scene::{FARTHEST, LightFrame};

/// Degrees that a drag over a point of the screen turns by.
const DEGREES: f32 = 0.5;

/// Several boxes in a row, each with its own text; which of them is touched, and how.
fn boxes<const COUNT: usize>(
    ui: &mut Ui,
    abouts: [&str; COUNT],
    shown: [f32; COUNT],
    range: std::ops::RangeInclusive<f32>,
    speed: f32,
) -> Touch<(usize, f32)> {
    ui.spacing_mut().item_spacing.x = 3.0;
    let mut touched = Touch::Nothing;
    for (index, about) in abouts.into_iter().enumerate() {
        let touch = number_box(ui, about, shown[index], range.clone(), speed);
        touched = touched.or(touch.map(|number| (index, number)));
    }
    touched
}

/// Three boxes, in metres; a drag of a point moves by `step`.
pub fn position_row(ui: &mut Ui, about: &str, position: Vec3, loaded: Vec3, step: f32) -> Touch<Vec3> {
    row(ui, "position", about, |ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        (0..3).fold(Touch::Nothing, |touched, axis| {
            let number = number_box(ui, about, position[axis], -FARTHEST..=FARTHEST, step);
            let mut moved = position;
            moved[axis] = number.value(position[axis], loaded[axis]);
            touched.or(match number {
                Touch::Nothing => Touch::Nothing,
                Touch::Reset if moved == loaded => Touch::Reset,
                Touch::Set(_) | Touch::Reset => Touch::Set(moved),
            })
        })
    })
}

/// Azimuth, elevation and roll of a rotation that takes z to where it shines, degrees.
fn angles(rotation: Quat) -> [f32; 3] {
    let (azimuth, down, roll) = rotation.to_euler(EulerRot::YXZ);
    // Whole degrees are shown as such.
    [azimuth, -down, roll].map(|angle| (1e3 * angle.to_degrees()).round() / 1e3 + 0.0)
}

fn rotation([azimuth, elevation, roll]: [f32; 3]) -> Quat {
    Quat::from_euler(EulerRot::YXZ, azimuth.to_radians(), -elevation.to_radians(), roll.to_radians()).normalize()
}

const ANGLES: [&str; 3] = [
    "Where the light shines: azimuth in degrees, 0 to the front, 90 to the right.",
    "Where the light shines: elevation in degrees, 90 straight up, -90 straight down.",
    "How the light is turned about its own axis, in degrees.",
];

/// Azimuth, elevation and roll; what comes of it is the turn from how the light was loaded.
pub fn rotation_rows(ui: &mut Ui, frame: &LightFrame, edit: Option<Quat>) -> Touch<Quat> {
    let now = frame.with(None, edit, None).rotation;
    let shown = angles(now);
    let about = "Where the light shines, and how it is turned about that: azimuth, elevation and roll in degrees.";
    let touch = row(ui, "direction", about, |ui| boxes(ui, ANGLES, shown, -360.0..=360.0, DEGREES));
    turned(touch, shown, angles(frame.rotation)).map(|to| (to * frame.rotation.inverse()).normalize())
}

/// Azimuth and elevation of a direction.
pub fn direction_row(ui: &mut Ui, direction: Vec3, loaded: Vec3) -> Touch<Vec3> {
    let level = |direction: Vec3| {
        let [azimuth, elevation] = [direction.x.atan2(direction.z), direction.y.clamp(-1.0, 1.0).asin()];
        [azimuth, elevation].map(|angle| (1e3 * angle.to_degrees()).round() / 1e3 + 0.0)
    };
    let shown = level(direction);
    let about = "Where the light shines: azimuth and elevation in degrees.";
    let touch = row(ui, "direction", about, |ui| boxes(ui, [ANGLES[0], ANGLES[1]], shown, -360.0..=360.0, DEGREES));
    let with_roll = |[azimuth, elevation]: [f32; 2]| [azimuth, elevation, 0.0];
    turned(touch, with_roll(shown), with_roll(level(loaded))).map(|to| (to * Vec3::Z).normalize())
}

/// The rotation after one of its angles has been touched.
fn turned(touch: Touch<(usize, f32)>, shown: [f32; 3], loaded: [f32; 3]) -> Touch<Quat> {
    match touch {
        Touch::Nothing => Touch::Nothing,
        Touch::Set((index, degrees)) => {
            let mut to = shown;
            to[index] = if index == 1 { degrees.clamp(-90.0, 90.0) } else { degrees };
            Touch::Set(rotation(to))
        }
        // The three of them are one: which of them is which hangs together.
        Touch::Reset if shown == loaded => Touch::Nothing,
        Touch::Reset => Touch::Reset,
    }
}

/// Width and height; one where both are the same by the light's shape.
pub fn size_row(ui: &mut Ui, frame: &LightFrame, edit: Option<Vec2>, step: f32) -> Touch<Vec2> {
    let size = frame.with(None, None, edit).size;
    let about = "How wide and how high the light is, along its own sides, in metres.";
    row(ui, "size", about, |ui| {
        let range = f32::MIN_POSITIVE..=FARTHEST;
        let touch = match frame.is_flat {
            true => {
                let abouts = ["How wide the light is, in metres.", "How high the light is, in metres."];
                boxes(ui, abouts, size.to_array(), range, step)
            }
            false => boxes(ui, ["How wide the light is, in metres; its shape stays."], [size.x], range, step),
        };
        match touch {
            Touch::Nothing => Touch::Nothing,
            Touch::Reset => Touch::Reset,
            Touch::Set((_, width)) if !frame.is_flat => Touch::Set(size * (width / size.x)),
            Touch::Set((index, length)) => {
                let mut to = size;
                to[index] = length;
                Touch::Set(to)
            }
        }
    })
}

/// The angles of a spot's cone, in degrees.
pub fn cone_row(ui: &mut Ui, shown: [f32; 2], edits: [&mut Option<f32>; 2]) {
    let about =
        "Up to which angle from its direction the spot is full, and from which on it gives no light, in degrees.";
    let abouts = [
        "Up to which angle from its direction the spot is full, in degrees.",
        "From which angle to its direction on the spot gives no light, in degrees.",
    ];
    let degrees = shown.map(f32::to_degrees);
    let touch = row(ui, "cone", about, |ui| boxes(ui, abouts, degrees, 0.0..=90.0, DEGREES));
    let [inner, outer] = edits;
    match touch {
        Touch::Nothing => {}
        Touch::Reset => (*inner, *outer) = (None, None),
        Touch::Set((0, degrees)) => *inner = Some(degrees.to_radians().clamp(0.0, shown[1])),
        Touch::Set((_, degrees)) => *outer = Some(degrees.to_radians().clamp(f32::MIN_POSITIVE, FRAC_PI_2)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_where_the_light_shines() {
        for (degrees, direction) in [
            ([0.0, 0.0, 0.0], Vec3::Z),
            ([90.0, 0.0, 30.0], Vec3::X),
            ([0.0, 90.0, 0.0], Vec3::Y),
            ([180.0, -45.0, 0.0], Vec3::new(0.0, -1.0, -1.0).normalize()),
        ] {
            assert!((rotation(degrees) * Vec3::Z).distance(direction) < 1e-6, "{degrees:?}");
        }
        for degrees in [[30.0, 20.0, -170.0], [-100.0, -89.0, 12.5]] {
            let found = angles(rotation(degrees));
            assert!((0..3).all(|axis| (found[axis] - degrees[axis]).abs() < 2e-3), "{found:?} {degrees:?}");
        }
        assert_eq!(angles(Quat::IDENTITY).map(f32::to_bits), [0; 3]);
    }
}
