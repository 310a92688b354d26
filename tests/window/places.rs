//! Where things are in a window of 1280 x 720.

use super::shot::Area;

pub const SIZE: [u16; 2] = [1280, 720];

/// All of the picture, without the panel.
pub const PICTURE: Area = [0, 980, 0, 720];
/// What of it the cloth of the default scene takes.
pub const CLOTH: Area = [250, 700, 100, 600];
/// A part of the cloth, and of the floor.
pub const ON_CLOTH: [i16; 2] = [480, 300];
pub const ON_FLOOR: [i16; 2] = [60, 660];

/// The panel's upper part: nothing in it says how far the picture is.
pub const PANEL: Area = [984, 1280, 0, 560];
/// The name of the material that is shown.
pub const MATERIAL: Area = [989, 1266, 66, 83];

// The panel's controls.
pub const MOSS: [i16; 2] = [1224, 98];
pub const ALPHA_BOX: [i16; 2] = [1238, 150];
/// The knob of alpha's slider at 0.4, as the default scene has it, and at about 0.8.
pub const ALPHA_KNOB: [i16; 2] = [1102, 179];
pub const ALPHA_HIGH: [i16; 2] = [1208, 179];
pub const SWEEP: [i16; 2] = [1031, 286];
pub const NINE_ALPHAS: [i16; 2] = [1117, 286];

/// The middle of one of nine pictures side by side.
pub fn tile(index: i16) -> [i16; 2] {
    [163 + 326 * (index % 3), 110 + 240 * (index / 3)]
}

/// What lies around a place.
pub fn around([x, y]: [i16; 2], by: usize) -> Area {
    let [x, y] = [x, y].map(|side| usize::try_from(side).unwrap());
    [x - by, x + by, y - by, y + by]
}
