//! A small window: the panel folds away, and frames are quick, so that many of them can be counted.

use std::path::{Path, PathBuf};

use super::alone;
use super::desk::Desk;
use super::shot::Area;

const SIZE: [u16; 2] = [480, 320];
/// Where frames are counted: only the picture.
const SMALLEST: [u16; 2] = [240, 160];
/// Where the panel is, once it is there, without what it says of the picture; and all that is left of the picture then.
const PANEL: Area = [184, 440, 40, 220];
const PICTURE: Area = [0, 176, 0, 320];
/// The button that folds it, at the picture's edge.
const SHOW: [i16; 2] = [463, 14];
const HIDE: [i16; 2] = [163, 14];

#[test]
fn in_a_small_window_the_panel_folds() {
    let _alone = alone();
    let mut desk = Desk::without_shadows(SIZE);
    fold(&mut desk);
    desk.close();
}

#[test]
fn a_thousand_frames_leave_nothing_in_memory() {
    let _alone = alone();
    let folder = tempfile::tempdir().unwrap();
    let mut desk = Desk::new(SMALLEST, &[&plates(folder.path())]);
    remember(&mut desk);
    // The loader has something to say about such a file.
    desk.ask_to_close();
    assert!(desk.ended().success());
}

/// A plate over a larger one, of felt, in the light of the rig, with shadows: few triangles, so that frames are quick.
fn plates(folder: &Path) -> PathBuf {
    let plate = |size: f32, height: f32| {
        let corner = |x: f32, z: f32| [size * x, height, size * z];
        let [a, b, c, d] = [corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)];
        [a, b, c, a, c, d]
    };
    let positions = [plate(1.0, 0.0), plate(0.5, 0.4)].concat();
    std::fs::write(folder.join("plates.bin"), bytemuck::cast_slice::<_, u8>(&positions)).unwrap();
    let path = folder.join("plates.gltf");
    std::fs::write(
        &path,
        r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "extensionsUsed": ["KHR_materials_sheen"],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
            "materials": [{"name": "felt", "doubleSided": true,
                "extensions": {"KHR_materials_sheen": {"sheenColorFactor": [1, 0.5, 0.4], "sheenRoughnessFactor": 0.5}}}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 12, "type": "VEC3", "min": [-1, 0, -1], "max": [1, 0.4, 1]}],
            "bufferViews": [{"buffer": 0, "byteLength": 144}], "buffers": [{"uri": "plates.bin", "byteLength": 144}]}"#,
    )
    .unwrap();
    path
}

/// It is folded away at first, can be brought back, scrolls, and goes away again.
fn fold(desk: &mut Desk) {
    let folded = desk.settle();
    desk.click(SHOW);
    let shown = desk.until_shown("panel", |shot| shot.differs(&folded, PANEL, 8) > 0.9);
    desk.move_to([300, 130]);
    desk.settle();
    for _ in 0..5 {
        desk.wheel(false);
    }
    let scrolled = desk.settle();
    assert!(scrolled.differs(&shown, PANEL, 8) > 0.05, "it does not scroll");
    desk.click(HIDE);
    desk.until_shown("picture alone", |shot| shot.differs(&folded, PANEL, 16) < 0.05);
    let again = desk.settle();
    assert!(again.differs(&folded, PICTURE, 16) < 0.05);
}

/// Each frame of a drag is waited for.
fn remember(desk: &mut Desk) {
    let all = [0, 200, 0, 160];
    let mut last = desk.settle();
    let mut drag = |desk: &mut Desk, frames: i16| {
        desk.move_to([60, 80]);
        desk.press(1);
        for frame in 0..frames {
            desk.move_to([60 + (frame * 7) % 100, 30 + (frame * 3) % 100]);
            last = desk.until_shown("frame", |shot| !shot.shows(&last, all));
        }
        desk.release(1);
        last = desk.settle();
        desk.memory()
    };
    let first = drag(desk, 100);
    let after = drag(desk, 1000);
    println!("{first} kB after the first hundred frames, {after} kB after a thousand more");
    assert!(after < first + 6000, "{first} kB have become {after}");
}
