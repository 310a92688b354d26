//! A small window: the panel folds away, and frames are quick, so that many of them can be counted.

use super::alone;
use super::desk::Desk;
use super::plates::plates;
use super::shot::Area;

const SIZE: [u16; 2] = [480, 320];
/// Where frames are counted: only the picture.
const SMALLEST: [u16; 2] = [240, 160];
/// Where the panel is, once it is there, without what it says of the picture; and all that is left of the picture then.
const PANEL: Area = [184, 440, 40, 220];
const PICTURE: Area = [0, 176, 40, 320];
/// What of the picture is left in sight then.
const MIDDLE: Area = [150, 326, 40, 320];
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

/// It is folded away at first, can be brought back, scrolls, and goes away again.
fn fold(desk: &mut Desk) {
    let folded = desk.settle();
    desk.click(SHOW);
    let shown = desk.until_shown("panel", |shot| shot.differs(&folded, PANEL, 8) > 0.9);
    desk.move_to([300, 130]);
    // The picture is narrower then, and shows the same in the same size, half a pixel to the side at most.
    let beside = desk.settle().cut(PICTURE);
    let stretched = beside.differs(&folded.cut(MIDDLE), [0, 176, 0, 280], 16);
    assert!(stretched < 0.2, "{stretched} of the picture is not what it was");
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
