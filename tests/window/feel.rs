//! How it feels: it follows, is sharp when it rests, and does nothing when nothing happens.

use std::path::Path;
use std::time::Duration;

use super::alone;
use super::desk::Desk;
use super::places::{CLOTH, PANEL, PICTURE, SIZE};

#[test]
fn it_opens_with_a_picture_then_does_nothing_and_follows_a_drag() {
    let _alone = alone();
    let mut desk = Desk::new(SIZE, &[]);
    let first = desk.settle();
    assert!(first.sharpness(CLOTH) > 0.5, "{}", first.sharpness(CLOTH));
    assert_eq!(desk.title(), "Velour - drape.glb");
    idle(&desk);
    assert!(desk.shot() == first);
    drag(&mut desk);
    desk.close();
}

/// Over the picture there is nothing that lights up.
fn idle(desk: &Desk) {
    assert!(desk.is_idle_for(Duration::from_secs(3)), "it is busy with nothing");
    let before = desk.cpu();
    for step in 0..100 {
        desk.move_to([200 + 4 * step, 300]);
        std::thread::sleep(Duration::from_millis(20));
    }
    let took = desk.cpu() - before;
    println!("{took:?} of processor time for a hundred moves");
    // So many pictures would take more than ten times as much.
    assert!(took < Duration::from_secs(4), "{took:?} for a hundred moves");
}

/// What is dragged is drawn in few pixels, and sharp when it rests.
fn drag(desk: &mut Desk) {
    desk.move_to([300, 300]);
    let first = desk.settle();
    desk.press(1);
    let mut last = first.clone();
    let mut sharpness = Vec::new();
    for step in 1..=12 {
        // The first step is more than what a click may wander.
        desk.move_to([300 + 8 * step, 300]);
        last = desk.until_shown("picture of what is dragged", |shot| !shot.shows(&last, CLOTH));
        sharpness.push(last.sharpness(CLOTH));
    }
    // Only the last of it is sure to have been drawn while it moved: what pauses becomes sharp.
    sharpness.sort_by(f64::total_cmp);
    let moving = sharpness[sharpness.len() / 2];
    assert!(last.shows(&first, PANEL), "the panel has changed");
    desk.release(1);
    let rested = desk.settle();
    assert!(first.differs(&rested, CLOTH, 8) > 0.3, "it has not turned");
    let [before, after] = [&first, &rested].map(|shot| shot.sharpness(CLOTH));
    println!("sharpness before, while it moves, and at rest: {before} {moving} {after}");
    assert!(moving < 0.8 * after && after > 0.5 * before, "{before} {moving} {after}");
    assert!(rested.shows(&first, PANEL), "the panel has changed");
    assert!(!rested.shows(&first, PICTURE));
}

#[test]
fn it_closes_whatever_it_is_at() {
    let _alone = alone();
    for delay in [0, 300, 1500] {
        let mut desk = Desk::new(SIZE, &[]);
        std::thread::sleep(Duration::from_millis(delay));
        desk.close();
    }
    // In the midst of a drag.
    let mut desk = Desk::new(SIZE, &[]);
    desk.move_to([300, 300]);
    desk.press(1);
    desk.move_to([330, 300]);
    desk.close();
}

#[test]
fn a_scene_that_cannot_be_loaded_opens_no_window() {
    let _alone = alone();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("broken.glb");
    std::fs::write(&path, "glTF").unwrap();
    for scene in [path.as_path(), Path::new("missing.glb")] {
        let mut desk = Desk::without_window([640, 480], &[Path::new("view"), scene]);
        let (code, has_had_window) = desk.ended_without_window();
        assert_eq!((code, has_had_window), (Some(2), false));
        let said = desk.complaints();
        assert!(said.lines().count() == 1 && said.contains(scene.to_str().unwrap()), "{said}");
    }
}
