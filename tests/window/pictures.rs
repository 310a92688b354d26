//! Pictures that are saved, and the command that makes the same.

use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use velour::picture::Picture;

use super::alone;
use super::desk::{Desk, keys};

const SIZE: [u16; 2] = [320, 200];

fn picture(path: &Path) -> Picture {
    Picture::load(path).unwrap()
}

/// Runs a command by a shell in a folder of its own; the picture that it leaves there.
fn run(command: &str, name: &str) -> Picture {
    let folder = tempfile::tempdir().unwrap();
    let programs = Path::new(env!("CARGO_BIN_EXE_velour")).parent().unwrap().to_owned();
    let path = std::env::join_paths([programs, "/usr/bin".into(), "/bin".into()]).unwrap();
    let done = Command::new("sh").args(["-c", command]).current_dir(&folder).env("PATH", path).output().unwrap();
    assert!(done.status.success(), "{command}\n{}", String::from_utf8_lossy(&done.stderr));
    picture(&folder.path().join(name))
}

fn copy(desk: &mut Desk) -> String {
    desk.chord(&[keys::CONTROL, keys::SHIFT], u32::from('c'));
    desk.until("a command on the clipboard", |desk| desk.clipboard())
}

/// With an exposure that is metered, in a folder whose name a shell would take apart.
#[test]
fn the_command_makes_the_picture_that_is_saved() {
    let _alone = alone();
    let folder = tempfile::tempdir().unwrap();
    let odd = folder.path().join("it's a \"$HOME\"\n-o");
    std::fs::create_dir(&odd).unwrap();
    let scene = odd.join("-drape.glb");
    std::fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/drape.glb"), &scene).unwrap();
    let state = folder.path().join("state.toml");
    std::fs::write(&state, "exposure = \"auto\"\n").unwrap();
    let words =
        ["view".as_ref(), "--rig=on".as_ref(), "--state".as_ref(), state.as_path(), "--".as_ref(), scene.as_path()];
    let mut desk = Desk::new(SIZE, &words);
    desk.settle();
    desk.drag(1, [100, 100], [150, 80]);
    desk.chord(&[], u32::from('p'));
    let path = desk.written("velour-001.png");
    let command = copy(&mut desk);
    println!("{command}");
    assert!(command.contains("--size=320x200") && command.contains("--rig=on"), "{command}");
    assert_eq!(run(&command, "velour.png"), picture(&path));

    // And so it is by the box, which has the focus on the name.
    desk.chord(&[keys::CONTROL, keys::SHIFT], u32::from('s'));
    desk.type_text("x");
    desk.chord(&[], keys::ENTER);
    assert_eq!(picture(&desk.written("velour-002x.png")), picture(&path));
    assert!(desk.folder.path().join("velour/picture.toml").is_file());
    desk.settle();
    desk.ask_to_close();
    assert!(desk.ended().success());
}

/// A large one of the scene that comes with the program, while the window is used; and one that is cancelled.
#[test]
fn large_pictures_are_saved_while_the_window_is_used() {
    let _alone = alone();
    let folder = tempfile::tempdir().unwrap();
    let remembered = folder.path().join("velour");
    std::fs::create_dir(&remembered).unwrap();
    let kept = "size = [2600, 1400]\nsamples = 4\nformat = \"exr\"\n";
    std::fs::write(remembered.join("picture.toml"), kept).unwrap();
    let mut desk = Desk::within(SIZE, &["view".as_ref()], &[("XDG_STATE_HOME", folder.path().as_os_str())]);
    let before = desk.settle();
    let command = copy(&mut desk);
    desk.chord(&[], u32::from('p'));
    let bar = |shot: &super::shot::Shot| shot.differs(&before, [10, 200, 150, 195], 16) > 0.5;
    desk.until_shown("a bar", bar);
    // It turns meanwhile.
    let cpu = desk.cpu();
    let start = Instant::now();
    desk.drag(1, [100, 60], [180, 60]);
    desk.until_shown("another view", |shot| shot.differs(&before, [60, 320, 0, 140], 16) > 0.1);
    println!("turned after {:?} while a picture is saved", start.elapsed());
    assert!(!desk.folder.path().join("velour-001.exr").exists(), "it was too quick");
    let path = desk.written("velour-001.exr");
    println!("saved after {:?}, {:?} of processor time", start.elapsed(), desk.cpu() - cpu);
    assert_eq!(run(&command, "velour.exr"), picture(&path));

    let turned = desk.settle();
    desk.chord(&[], u32::from('p'));
    desk.until_shown("a bar", |shot| shot.differs(&turned, [10, 200, 150, 195], 16) > 0.5);
    let start = Instant::now();
    // The bar's button.
    desk.click([165, 184]);
    desk.until_shown("no bar", |shot| shot.differs(&turned, [10, 200, 150, 195], 16) < 0.1);
    println!("cancelled after {:?}", start.elapsed());
    assert!(start.elapsed() < Duration::from_secs(10));
    desk.settle();
    let mut names: Vec<String> =
        desk.folder.path().read_dir().unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.retain(|name| name.starts_with("velour-") || name.starts_with(".velour"));
    assert_eq!(names, ["velour-001.exr"]);
    desk.ask_to_close();
    assert!(desk.ended().success());
}
