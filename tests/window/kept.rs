//! What outlives the program, and what comes of files that change.

use std::path::Path;
use std::time::Duration;

use super::alone;
use super::desk::{Desk, keys};
use super::places::{ALPHA_HIGH, ALPHA_KNOB, CLOTH, MOSS, PICTURE, SIZE};
use super::plates::plates;
use super::shot::Shot;

/// Where changes of the last time are offered, in the strip at the panel's bottom.
const BRING_BACK: [i16; 2] = [1050, 628];
const DECLINE: [i16; 2] = [998, 628];

/// Longer than the least time between two writes.
const WRITTEN: Duration = Duration::from_millis(2500);

/// Longer than a folder takes to be listed.
const LISTED: Duration = Duration::from_secs(2);

fn kept(desk: &Desk) -> Vec<String> {
    let entries = std::fs::read_dir(desk.folder.path().join("velour")).into_iter().flatten().flatten();
    let kept = entries.filter(|entry| entry.file_name().to_string_lossy().starts_with("kept-"));
    kept.map(|entry| std::fs::read_to_string(entry.path()).unwrap()).collect()
}

/// Killed in the midst of work the program brings back what was done.
/// Closes the window where files were loaded that lack something, which is said each time.
fn close(desk: &mut Desk) {
    desk.ask_to_close();
    assert_eq!(desk.ended().code(), Some(0));
    let complaints = desk.complaints();
    let is_known = |line: &str| line.contains("no camera in the file") || line.contains("nothing in the file lights");
    assert!(complaints.lines().all(is_known), "{complaints}");
}

#[test]
fn changes_outlive_the_program() {
    let _alone = alone();
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/drape.glb");
    let mut desk = Desk::without_shadows(SIZE);
    desk.drag(1, ALPHA_KNOB, ALPHA_HIGH);
    std::thread::sleep(WRITTEN);
    let alpha = desk.state().number("alpha");
    let view: [&Path; 2] = ["view".as_ref(), &scene];
    desk.kill_and_start(&view);
    let before = desk.settle();
    // They are offered, and forced on nobody.
    assert!(desk.state().get("alpha").is_none());
    desk.click(BRING_BACK);
    let state = desk.until_state("last changes", |state| state.get("alpha").is_some());
    assert_eq!((state.number("alpha"), state.get("shadows")), (alpha, Some("false")));
    assert!(desk.settle().brightness(CLOTH) > 1.1 * before.brightness(CLOTH), "dust is brighter");
    desk.undo("what was brought back", |state| state.get("alpha").is_none());
    // What is taken back is forgotten.
    desk.until("forgetting", |desk| kept(desk).is_empty().then_some(()));
    desk.click(MOSS);
    desk.close();
    // An end in order keeps what was done right before it, too.
    assert!(kept(&desk).iter().any(|text| text.contains("base-color")), "{:?}", kept(&desk));
    desk.kill_and_start(&view);
    desk.settle();
    desk.click(DECLINE);
    desk.until("forgetting", |desk| kept(desk).is_empty().then_some(()));
    assert!(desk.state().get("base-color").is_none());
    desk.close();
}

/// Whatever lies where changes are kept, the program starts.
#[test]
fn nothing_that_is_kept_stops_a_start() {
    let _alone = alone();
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/drape.glb");
    let mut desk = Desk::without_shadows(SIZE);
    desk.click(MOSS);
    desk.until("changes", |desk| (!kept(desk).is_empty()).then_some(()));
    let folder = desk.folder.path().join("velour");
    let file = std::fs::read_dir(&folder).unwrap().flatten().find(|entry| entry.file_name() != "recent.toml").unwrap();
    for hostile in [vec![0xff; 1000], vec![b'['; 1 << 20], b"alpha = 7".to_vec()] {
        std::fs::write(file.path(), hostile).unwrap();
        std::fs::write(folder.join("recent.toml"), [0; 100]).unwrap();
        desk.kill_and_start(&["view".as_ref(), &scene]);
        desk.settle();
        desk.click(BRING_BACK);
        desk.settle();
        assert!(desk.state().get("base-color").is_none());
    }
    desk.close();
}

/// A path is typed, a list is chosen from, and what was opened before is listed first, all by keys.
#[test]
fn scenes_are_opened_by_keys() {
    let _alone = alone();
    let mut desk = Desk::without_shadows(SIZE);
    let drape = desk.settle();
    let folder = desk.folder.path().join("scenes");
    std::fs::create_dir(&folder).unwrap();
    plates(&folder);
    let is_titled = |desk: &mut Desk, name: &str| {
        let title = format!("Velour - {name}");
        desk.until(&title, |desk| (desk.title() == title).then_some(()));
        desk.settle();
    };
    let open = |desk: &mut Desk, typed: &str| {
        desk.chord(&[keys::CONTROL], u32::from('o'));
        desk.type_text(typed);
        // The cursor blinks: it does not rest.
        std::thread::sleep(LISTED);
    };
    // What is typed is no key of the picture, and Esc leaves all as it is.
    open(&mut desk, "h1f");
    desk.chord(&[], keys::ESCAPE);
    assert_eq!(desk.settle().differs(&drape, [0, 1280, 0, 640], 8), 0.0);
    assert!(!desk.state().has_view());
    open(&mut desk, "scenes/none.glb");
    desk.chord(&[], keys::ENTER);
    desk.settle();
    assert_eq!(desk.title(), "Velour - drape.glb");
    open(&mut desk, "scenes/plates.gltf");
    desk.chord(&[], keys::ENTER);
    is_titled(&mut desk, "plates.gltf");
    // The second of those that were opened before.
    open(&mut desk, "");
    desk.chord(&[], keys::DOWN);
    desk.chord(&[], keys::DOWN);
    desk.chord(&[], keys::ENTER);
    is_titled(&mut desk, "drape.glb");
    // A folder that is looked into, and what lies in it.
    open(&mut desk, "sc");
    for _ in 0..2 {
        desk.chord(&[], keys::DOWN);
        desk.chord(&[], keys::ENTER);
        std::thread::sleep(LISTED);
    }
    is_titled(&mut desk, "plates.gltf");
    close(&mut desk);
}

/// A file that changes is loaded again, with what was changed of it; and not while it is half written.
#[test]
fn files_that_change_are_loaded_again() {
    let _alone = alone();
    let folder = tempfile::tempdir().unwrap();
    let scene = plates(folder.path());
    let state = folder.path().join("state.toml");
    std::fs::write(&state, "shadows = false\n").unwrap();
    let mut desk = Desk::new(SIZE, &["view".as_ref(), &scene, "--state".as_ref(), &state]);
    desk.settle();
    // Its notices take a row.
    desk.click([ALPHA_HIGH[0], ALPHA_HIGH[1] + 24]);
    let alpha = desk.until_state("alpha", |state| state.get("alpha").is_some()).number("alpha");
    let before = desk.settle();
    let text = std::fs::read_to_string(&scene).unwrap();
    std::fs::write(&scene, &text[..text.len() / 2]).unwrap();
    std::thread::sleep(WRITTEN);
    assert!(desk.settle().differs(&before, PICTURE, 8) < 0.01, "what is there stays");
    std::fs::write(&scene, text.replace("\"sheenColorFactor\": [1, 0.5, 0.4]", "\"sheenColorFactor\": [0, 0.1, 1]"))
        .unwrap();
    let other = |desk: &mut Desk, before: &Shot| {
        desk.until_shown("another picture", |shot| shot.differs(before, PICTURE, 8) > 0.02);
        assert_eq!(desk.state().number("alpha"), alpha);
        desk.settle()
    };
    let blue = other(&mut desk, &before);
    // What it names counts, too.
    let buffer = folder.path().join("plates.bin");
    let mut bytes = std::fs::read(&buffer).unwrap();
    bytes[72..].fill(0);
    std::fs::write(&buffer, bytes).unwrap();
    other(&mut desk, &blue);
    desk.undo("alpha", |state| state.get("alpha").is_none());
    close(&mut desk);
}
