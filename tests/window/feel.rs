//! How it feels: it follows, is sharp when it rests, does nothing when nothing happens, and leaves nothing behind.

use std::path::Path;
use std::time::{Duration, Instant};

use super::alone;
use super::desk::Desk;

const SIZE: [u16; 2] = [1280, 720];
/// The cloth, in the picture of the default scene: left, right, top, bottom.
const CLOTH: [usize; 4] = [250, 700, 100, 600];

#[test]
fn it_opens_with_a_picture_and_then_does_nothing() {
    let _alone = alone();
    let mut desk = Desk::new(SIZE, &[]);
    let shot = desk.settle();
    assert!(shot.sharpness(CLOTH) > 0.5, "{}", shot.sharpness(CLOTH));
    assert_eq!(desk.title(), "Velour - drape.glb");
    let before = desk.cpu();
    std::thread::sleep(Duration::from_secs(3));
    assert!(desk.cpu() - before <= Duration::from_millis(10), "{:?} while nothing happens", desk.cpu() - before);
    assert!(desk.shot() == shot);
    // Over the picture there is nothing that lights up.
    let before = desk.cpu();
    for step in 0..100 {
        desk.move_to(200 + 4 * step, 300);
        std::thread::sleep(Duration::from_millis(20));
    }
    let took = desk.cpu() - before;
    assert!(took < Duration::from_secs(2), "{took:?} for a hundred moves");
    assert!(desk.close().success());
    assert_eq!(desk.complaints(), "");
}

#[test]
fn a_drag_is_followed_in_few_pixels_and_is_sharp_when_it_rests() {
    let _alone = alone();
    let mut desk = Desk::new(SIZE, &[]);
    let first = desk.settle();
    desk.move_to(300, 300);
    desk.press(1);
    let mut steps = Vec::new();
    for step in 1..=20 {
        let before = desk.cpu();
        desk.move_to(300 + 4 * step, 300);
        std::thread::sleep(Duration::from_millis(300));
        steps.push(desk.cpu() - before);
    }
    let moving = desk.shot();
    desk.release(1);
    let rested = desk.settle();
    steps.sort();
    println!("a step of the drag: {:?} of processor time in the median", steps[steps.len() / 2]);
    assert!(first.differs(&rested, CLOTH, 8) > 0.3, "it has not turned");
    let sharpness = [&first, &moving, &rested].map(|shot| shot.sharpness(CLOTH));
    println!("sharpness before, while it moves, and at rest: {sharpness:?}");
    assert!(sharpness[1] < 0.8 * sharpness[2] && sharpness[2] > 0.7 * sharpness[0], "{sharpness:?}");
    // The panel is not drawn in fewer pixels.
    let panel = [1015, 1280, 0, 300];
    assert!(moving.sharpness(panel) > 0.9 * first.sharpness(panel));
}

/// A small window, so that frames are quick.
#[test]
fn a_thousand_frames_leave_nothing_in_memory() {
    let _alone = alone();
    let mut desk = Desk::new([480, 320], &[]);
    desk.settle();
    let mut drag = |desk: &mut Desk, steps: i16| {
        desk.move_to(60, 150);
        desk.press(1);
        for step in 0..steps {
            desk.move_to(60 + (step * 7) % 100, 100 + (step * 3) % 100);
            std::thread::sleep(Duration::from_millis(60));
        }
        desk.release(1);
        desk.settle();
        desk.memory()
    };
    let first = drag(&mut desk, 100);
    let last = drag(&mut desk, 1000);
    println!("{first} kB after the first hundred frames, {last} kB after a thousand more");
    assert!(last < first + 6000, "{first} kB have become {last}");
}

#[test]
fn it_closes_whatever_it_is_at() {
    let _alone = alone();
    for delay in [0, 300, 1500] {
        let mut desk = Desk::new(SIZE, &[]);
        std::thread::sleep(Duration::from_millis(delay));
        let start = Instant::now();
        assert!(desk.close().success(), "after {delay} ms");
        assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
    }
}

#[test]
fn a_scene_that_cannot_be_loaded_opens_no_window() {
    let _alone = alone();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("broken.glb");
    std::fs::write(&path, "glTF").unwrap();
    for scene in [path.as_path(), Path::new("missing.glb")] {
        let mut desk = Desk::without_window([640, 480], &[Path::new("view"), scene]);
        assert_eq!(desk.ended().code(), Some(2));
        assert!(!desk.has_window());
        let said = desk.complaints();
        assert!(said.lines().count() == 1 && said.contains(scene.to_str().unwrap()), "{said}");
    }
}
