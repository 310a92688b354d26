//! Files that are dropped on the window.

use std::path::Path;

use super::alone;
use super::desk::Desk;
use super::plates::plates;

const SIZE: [u16; 2] = [240, 160];

/// A scene, the changes of one, and what cannot be opened; and in the end nothing of all the scenes is left in memory.
#[test]
fn files_are_dropped_on_the_window() {
    let _alone = alone();
    let folder = tempfile::tempdir().unwrap();
    let scene = plates(folder.path());
    let mut desk = Desk::without_shadows(SIZE);
    let drape = desk.settle();
    let is_titled =
        |desk: &mut Desk, title: &str| desk.until("its title", |desk| (desk.title() == title).then_some(()));
    is_titled(&mut desk, "Velour - drape.glb");
    let all = [0, 240, 0, 160];

    // What is not there leaves what is.
    desk.drop_file(&scene.with_file_name("plates.bin"));
    desk.settle();
    assert_eq!(desk.title(), "Velour - drape.glb");

    // The scene comes without the changes that were made of the other.
    desk.drop_file(&scene);
    is_titled(&mut desk, "Velour - plates.gltf");
    let plates = desk.settle();
    assert!(plates.differs(&drape, all, 8) > 0.3);
    assert!(desk.state().get("shadows").is_none());

    let changes = folder.path().join("changes.toml");
    std::fs::write(&changes, "exposure = 3\n").unwrap();
    let dragged = desk.drag_file(&changes);
    desk.until_shown("what comes of it", |shot| shot.differs(&plates, all, 8) > 0.9);
    dragged.drop();
    desk.until_state("changes", |state| state.get("exposure") == Some("3"));
    let bright = desk.settle();
    assert!(bright.brightness(all) > plates.brightness(all));
    desk.undo("the changes of a file", |state| state.get("exposure").is_none());
    refused(&mut desk, folder.path());
    remember(&mut desk, &scene);
    desk.ask_to_close();
    assert!(desk.ended().success());
}

/// What the loader takes and the device has no room for gives way to what was there, changes and all.
fn refused(desk: &mut Desk, folder: &Path) {
    const COUNT: usize = 1_000_000;
    desk.move_to([120, 80]);
    desk.press(1);
    desk.move_to([140, 90]);
    desk.release(1);
    let (before, state) = (desk.settle(), desk.state().0);
    let bytes = 36 + 12 * COUNT;
    let mut buffer = bytemuck::cast_slice(&[-1.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]).to_vec();
    buffer.resize(bytes, 0);
    std::fs::write(folder.join("many.bin"), buffer).unwrap();
    let path = folder.join("many.gltf");
    let scene = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "extensionsUsed": ["EXT_mesh_gpu_instancing"],
            "nodes": [{{"mesh": 0, "extensions": {{"EXT_mesh_gpu_instancing": {{"attributes": {{"TRANSLATION": 1}}}}}}}}],
            "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
            "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1, 0, 0], "max": [1, 1, 0]}},
                {{"bufferView": 1, "componentType": 5126, "count": {COUNT}, "type": "VEC3"}}],
            "bufferViews": [{{"buffer": 0, "byteLength": 36}}, {{"buffer": 0, "byteOffset": 36, "byteLength": {}}}],
            "buffers": [{{"uri": "many.bin", "byteLength": {bytes}}}]}}"#,
        12 * COUNT
    );
    std::fs::write(&path, scene).unwrap();
    desk.drop_file(&path);
    desk.until("the other scene", |desk| desk.title().starts_with("Velour - many.gltf").then_some(()));
    desk.until("this one", |desk| (desk.title() == "Velour - plates.gltf").then_some(()));
    assert!(desk.settle().differs(&before, [0, 240, 0, 160], 8) < 0.01);
    assert_eq!(desk.state().0, state);
}

/// Ten scenes one after another, twice.
fn remember(desk: &mut Desk, scene: &Path) {
    let drape = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/drape.glb");
    let mut open = |scenes: usize| {
        for index in 0..scenes {
            let path = if index % 2 == 0 { &drape } else { scene };
            desk.drop_file(path);
            let title = format!("Velour - {}", path.file_name().unwrap().display());
            desk.until("its title", |desk| (desk.title() == title).then_some(()));
            desk.settle();
        }
        desk.memory()
    };
    let (first, after) = (open(4), open(10));
    println!("{first} kB after four scenes, {after} kB after ten more");
    assert!(after < first + 20_000, "{first} kB have become {after}");
}
