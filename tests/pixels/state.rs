//! `--state FILE`: what the viewer saves, beside the flags that say the same.

use std::fs;

use velour::picture::Picture;
use velour::scene::{CameraEdit, Edits, LightEdits, MaterialEdits, Orbit, gltf};

use super::run::Bench;

/// A picture of the scene with these flags; its file also says which flags they were.
fn picture(bench: &Bench, command: &str, flags: &str) -> Picture {
    bench.run(&format!("{command} scene.glb -o out.exr --size 64x40 {flags}"));
    Picture::load(&bench.path("out.exr")).unwrap()
}

#[test]
fn a_state_is_the_flags_that_say_the_same() {
    let bench = Bench::new();
    let state = "exposure = 1\nlobes = 'sheen,diffuse'\nlights-visible = false\nambient = [0.1, 0.2, 0.3]\nalpha = 0.7\n\
        layering = 'manual=0.5'\n[[material]]\nindex = 0\nsheen-color = [0.2, 0.4, 1]\nroughness = 0.3\n";
    bench.put("state.toml", state);
    let flags = "--exposure 1 --lobes sheen,diffuse --lights-visible off --ambient 0.1,0.2,0.3 --alpha 0.7 \
        --layering manual=0.5 --set 0.sheen-color=0.2,0.4,1 --set 0.roughness=0.3";
    for command in ["render", "reference --spp 1"] {
        let plain = picture(&bench, command, "");
        let stated = picture(&bench, command, "--state state.toml");
        assert_eq!(stated, picture(&bench, command, flags), "{command}");
        assert_ne!(stated, plain);
        // Flags win, those for all materials too.
        let changed = "--sheen-color 1,1,1 --ambient 0,0,0 --lights-visible on";
        let rest = "--exposure 1 --lobes sheen,diffuse --alpha 0.7 --layering manual=0.5 --set 0.roughness=0.3";
        let expected = picture(&bench, command, &format!("{rest} {changed}"));
        assert_eq!(picture(&bench, command, &format!("--state state.toml {changed}")), expected, "{command}");
    }
}

/// What is saved, read back and drawn is what was drawn: view, lights and all.
#[test]
fn what_the_viewer_saves_is_what_it_showed() {
    use velour::picture::LinearImage;
    use velour::renderer::Offscreen;
    use velour::scene::Drawn;
    use velour::table::SheenTable;

    let bench = Bench::new();
    let scene = gltf::load(&bench.path("scene.glb"), &gltf::Options::default()).unwrap();
    let mut orbit = Orbit::new(&scene.cameras[0], scene.subject().center());
    orbit.turn([0.21, -0.04].into());
    orbit.zoom(orbit.target, 1.13, &(1e-4..=1e4));
    let light = LightEdits {
        radiance: Some([1.0, 0.7, 0.3].into()),
        strength: Some(7.77),
        position: Some(scene.lights[0].position() + glam::Vec3::new(0.1, 0.3, -0.2)),
        ..LightEdits::default()
    };
    let velvet = MaterialEdits { alpha: Some(1.0 / 3.0), metallic: Some(0.1), ..MaterialEdits::default() };
    let edits = Edits {
        camera: Some(CameraEdit::Orbit(orbit)),
        materials: [(0, velvet)].into(),
        lights: [(0, light)].into(),
        ambient: Some([0.3, 0.2, 0.1].into()),
        ambient_strength: Some(0.123),
        ..Edits::default()
    };
    bench.put("state.toml", edits.to_text(&scene));
    let shown: LinearImage = {
        let gpu = &super::compare::GPU;
        let drawn = Drawn::new(&scene, &edits);
        let mut renderer = Offscreen::for_linear(gpu, 4, &SheenTable::embedded(), &drawn).unwrap();
        gpu.block_on(renderer.linear(gpu, &edits.camera(&scene), [64, 40], &drawn.settings)).unwrap()
    };
    assert_eq!(picture(&bench, "render", "--state state.toml"), shown.clone().into());
    assert_ne!(picture(&bench, "render", "--state state.toml --camera 0"), shown.into());
}

#[test]
fn the_documented_state_is_taken() {
    let bench = Bench::new();
    let root = super::golden::root();
    let page = fs::read_to_string(root.join("docs/scenes.md")).unwrap();
    let (_, state) = page.split_once("```toml\n").unwrap();
    bench.put("state.toml", state.split_once("```").unwrap().0);
    bench.put("scene.glb", fs::read(root.join("assets/drape.glb")).unwrap());
    let plain = picture(&bench, "render", "");
    assert_ne!(picture(&bench, "render", "--state state.toml"), plain);
}

#[test]
fn states_that_cannot_be_taken_end_in_one_line() {
    let bench = Bench::new();
    bench.put("range.toml", "exposure = 1\nalpha = 2\n");
    bench.put("stranger.toml", "[[material]]\nname = 'silk'\nalpha = 0.5\n");
    bench.put("picture.toml", [0x89, b'P', b'N', b'G', 0xff, 0, 1]);
    bench.put("walk.toml", "layering = 'walk'\n");
    bench.put("slab.toml", "[[material]]\nindex = 0\nsheen-model = 'slab'\n");
    bench.put("marked.toml", "\u{feff}exposure = 1\r\n# with a mark, and other ends of lines\r\n");
    for (file, hint) in [
        ("range.toml", "--state range.toml: line 2, alpha: give a number in [0,1]"),
        ("stranger.toml", "line 2, name of a material: the scene has no such material; it has 0"),
        ("picture.toml", "--state picture.toml: is no text"),
        ("missing.toml", "--state missing.toml: cannot be read"),
        ("walk.toml", "takes a path tracer"),
        ("slab.toml", "takes a path tracer"),
    ] {
        bench.refused(&mut bench.command(&format!("render scene.glb -o out.png --state {file}")), 2, hint);
        bench.refused(&mut bench.command(&format!("view scene.glb --state {file}")), 2, hint);
    }
    picture(&bench, "render", "--state marked.toml");
    // It does not end.
    #[cfg(unix)]
    bench.refused(&mut bench.command("render scene.glb -o out.png --state /dev/zero"), 2, "more than 16777216 bytes");
}
