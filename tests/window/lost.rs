//! Devices that are lost.

use std::ffi::OsStr;
use std::path::Path;

use super::alone;
use super::desk::{Desk, keys};

/// Wide enough for the panel.
const SIZE: [u16; 2] = [800, 300];
/// The picture and the panel's messages in it.
const PICTURE: [usize; 4] = [0, 500, 0, 300];
const PANEL: [usize; 4] = [510, 790, 100, 290];

/// The drape without shadows, of which each picture is the same.
fn desk(folder: &Path, variables: &[(&str, &str)]) -> Desk {
    let state = folder.join("state.toml");
    std::fs::write(&state, "shadows = false\n").unwrap();
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/drape.glb");
    let variables: Vec<(&str, &OsStr)> = variables.iter().map(|(name, value)| (*name, OsStr::new(*value))).collect();
    Desk::within(SIZE, &["view".as_ref(), &scene, "--state".as_ref(), &state], &variables)
}

#[test]
fn another_device_draws_the_same() {
    let _alone = alone();
    let folder = tempfile::tempdir().unwrap();
    let mut desk = desk(folder.path(), &[]);
    let before = desk.settle();
    desk.close();
    for lose in ["0.3", "1.5", "5,2"] {
        let mut desk = self::desk(folder.path(), &[("VELOUR_LOSE_DEVICE", lose)]);
        let told = desk.until_shown("a message", |shot| {
            shot.differs(&before, PICTURE, 8) < 0.01 && shot.differs(&before, PANEL, 8) > 0.05
        });
        // It goes on: letters, pictures that egui keeps, and the view.
        desk.settle();
        desk.drag(1, [100, 100], [200, 100]);
        let turned = desk.settle();
        assert!(turned.differs(&told, PICTURE, 8) > 0.1);
        desk.chord(&[], keys::HOME);
        assert!(desk.settle().differs(&before, PICTURE, 8) < 0.01, "{lose}");
        assert!(desk.state().get("shadows") == Some("false"));
        desk.close();
    }
}

/// All devices are lost as soon as they are there.
#[test]
fn where_no_device_comes_back_it_ends_and_says_so() {
    let _alone = alone();
    let mut desk = Desk::started(SIZE, &["view".as_ref()], &[("VELOUR_LOSE_DEVICE", OsStr::new("0.3,1000"))]);
    let code = desk.ended().code();
    let said = desk.complaints();
    assert_eq!(code, Some(3), "{said}");
    assert!(said.starts_with("velour: the graphics device was lost") && said.lines().count() == 1, "{said}");
}

/// A picture that would take for ever.
#[test]
fn a_lost_device_ends_the_picture_that_it_draws() {
    let _alone = alone();
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("velour")).unwrap();
    let kept = "size = [4000, 4000]\nsamples = 1024\nformat = \"png\"\n";
    std::fs::write(folder.path().join("velour/picture.toml"), kept).unwrap();
    let variables = [("VELOUR_LOSE_DEVICE", "15"), ("XDG_STATE_HOME", folder.path().to_str().unwrap())];
    let variables = variables.map(|(name, value)| (name, OsStr::new(value)));
    let mut desk = Desk::within(SIZE, &["view".as_ref()], &variables);
    desk.until_shown("a picture", |shot| shot.brightness(PICTURE) > 20.0);
    desk.chord(&[], u32::from('p'));
    // While it is drawn the program has no rest.
    desk.settle();
    let names: Vec<String> =
        desk.folder.path().read_dir().unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    assert!(!names.iter().any(|name| name.contains("velour-001") || name.starts_with(".velour")), "{names:?}");
    desk.state();
    desk.close();
}
