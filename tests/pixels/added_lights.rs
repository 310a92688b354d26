//! Lights that are added, turned, scaled, turned off or given a second face by a state draw what a file with such lights draws.

use glam::{Mat4, Quat, Vec3};
use velour::picture::Picture;

use super::run::Bench;
use super::stage::{Stage, Thing, facing, glow, looking, velvet};

const EYE: [f32; 3] = [0.9, 1.1, -0.7];
const RADIANCE: [f32; 3] = [4.0, 3.0, 2.0];
const HALF: [f32; 2] = [0.5, 0.3];

/// A velvet floor, something that casts a shadow on it, and these lights.
fn stage(lights: &[Thing]) -> Stage {
    let floor = Thing::rectangle([1.5, 1.5], velvet([0.9, 0.5, 0.2], 0.4)).placed(facing([0.0; 3], [0.0, 1.0, 0.0]));
    let mut screen = Thing::rectangle([0.2, 0.2], velvet([0.2, 0.5, 0.9], 0.7)).placed(facing([0.3, 0.3, -0.2], EYE));
    screen.material.double_sided = true;
    Stage::new([vec![floor, screen], lights.to_vec()].concat(), looking([0.4, 1.1, 2.6], [0.0, 0.3, 0.0]))
}

fn panel(place: Mat4) -> Thing {
    Thing::rectangle(HALF, glow(RADIANCE)).placed(place)
}

/// What a command draws of a file with a state.
fn picture(bench: &Bench, command: &str, file: &str, state: &str) -> Picture {
    bench.put("state.toml", state);
    bench.run(&format!("{command} {file} -o out.exr --size 96x64 --rig off --state state.toml"));
    Picture::load(&bench.path("out.exr")).unwrap()
}

/// The share of pixels that differ by more than a share of the brightest channel of both; edges fall on either side of a pixel's middle.
fn differing(one: &Picture, other: &Picture) -> f64 {
    let most = one.pixels.iter().flatten().fold(0.0f32, |most, channel| most.max(*channel));
    assert!(most > 0.5, "nothing is lit");
    let differs = |(a, b): (&[f32; 3], &[f32; 3])| (0..3).any(|channel| (a[channel] - b[channel]).abs() > 1e-4 * most);
    one.pixels.iter().zip(&other.pixels).filter(|pair| differs(*pair)).count() as f64 / one.pixels.len() as f64
}

/// Rotation and position of a light that shines from `EYE` to the origin, as a state has them.
fn placed(place: Mat4) -> String {
    let (_, rotation, position) = place.to_scale_rotation_translation();
    format!("position = {:?}\nrotation = {:?}\n", position.to_array(), rotation.to_array())
}

/// How far a picture is off: by the share of pixels where it goes by no chance, else, as points of a light are counted from its first
/// corner, which may be another one, by the mean.
fn off(command: &str, one: &Picture, other: &Picture) -> f64 {
    if command.contains("shadows off") {
        return differing(one, other);
    }
    let mean = |picture: &Picture| picture.pixels.iter().flatten().map(|channel| f64::from(*channel)).sum::<f64>();
    (mean(other) / mean(one) - 1.0).abs()
}

/// Both without shadows, in closed form; with them, by the same rays; and as paths find it.
const COMMANDS: [&str; 3] =
    ["render --msaa 1 --shadows off", "render --msaa 1 --spp 2", "reference --filter centre --spp 2"];

#[test]
fn an_added_light_is_one_that_the_file_has() {
    let bench = Bench::new();
    let place = facing(EYE, [0.0; 3]);
    bench.put("lit.glb", stage(&[panel(place)]).glb());
    bench.put("dark.glb", stage(&[]).glb());
    let shape =
        format!("[[added-light]]\nshape = 'rectangle'\nsize = [1, 0.6]\nradiance = {RADIANCE:?}\n{}", placed(place));
    for command in COMMANDS {
        let expected = picture(&bench, command, "lit.glb", "");
        let found = picture(&bench, command, "dark.glb", &shape);
        let is = off(command, &expected, &found);
        assert!(is < 0.004, "{command}: {is}");
        // The ruler: a tenth more light.
        let brighter = shape.replace("radiance", "strength = 1.1\nradiance");
        assert!(off(command, &expected, &picture(&bench, command, "dark.glb", &brighter)) > 0.02, "{command}");
    }
}

#[test]
fn a_light_that_is_turned_moved_and_scaled_is_one_that_stands_there() {
    let bench = Bench::new();
    let place = facing(EYE, [0.0; 3]);
    bench.put("there.glb", stage(&[panel(place)]).glb());
    let turn = Quat::from_axis_angle(Vec3::new(0.3, -0.7, 0.2).normalize(), 2.1);
    // Half as wide and twice as high, elsewhere, turned away.
    let before = Mat4::from_rotation_translation(turn.inverse(), Vec3::new(-0.4, 0.9, 0.8))
        * Mat4::from_quat(place.to_scale_rotation_translation().1)
        * Mat4::from_scale(Vec3::new(0.5, 2.0, 1.0));
    bench.put("before.glb", stage(&[panel(before)]).glb());
    // Its own x is its longest edge, which was its height.
    let rotation = turn.to_array();
    let state = format!("[[light]]\nindex = 0\nposition = {EYE:?}\nrotation = {rotation:?}\nsize = [0.6, 1]\n");
    for command in COMMANDS {
        let expected = picture(&bench, command, "there.glb", "");
        let found = picture(&bench, command, "before.glb", &state);
        let is = off(command, &expected, &found);
        assert!(is < 0.004, "{command}: {is}");
        assert!(differing(&expected, &picture(&bench, command, "before.glb", "")) > 0.3, "{command}");
    }
}

#[test]
fn a_light_that_is_off_or_taken_away_is_not_there() {
    let bench = Bench::new();
    let [first, second] = [EYE, [-0.8, 1.3, 0.4]].map(|eye| panel(facing(eye, [0.0; 3])));
    bench.put("both.glb", stage(&[first.clone(), second]).glb());
    bench.put("one.glb", stage(&[first]).glb());
    for command in COMMANDS {
        let expected = picture(&bench, command, "one.glb", "");
        for state in ["index = 1\non = false", "index = 1\nremoved = true", "index = 0\nsolo = true"] {
            let found = picture(&bench, command, "both.glb", &format!("[[light]]\n{state}\n"));
            assert!(differing(&expected, &found) == 0.0, "{command} {state}: {}", differing(&expected, &found));
        }
        assert!(differing(&expected, &picture(&bench, command, "both.glb", "")) > 0.3, "{command}");
    }
}

#[test]
fn a_second_face_shines_and_is_seen() {
    let bench = Bench::new();
    // Between eye and floor, turned away from both.
    let place = facing([0.1, 0.7, 0.9], [0.2, 1.4, -1.0]);
    let single = panel(place);
    let mut double = single.clone();
    double.material.double_sided = true;
    bench.put("single.glb", stage(&[single, panel(facing(EYE, [0.0; 3]))]).glb());
    bench.put("double.glb", stage(&[double, panel(facing(EYE, [0.0; 3]))]).glb());
    for command in COMMANDS {
        let expected = picture(&bench, command, "double.glb", "");
        let found = picture(&bench, command, "single.glb", "[[light]]\nindex = 0\ntwo-sided = true\n");
        assert!(differing(&expected, &found) == 0.0, "{command}: {}", differing(&expected, &found));
        let back = picture(&bench, command, "double.glb", "[[light]]\nindex = 0\ntwo-sided = false\n");
        assert!(differing(&picture(&bench, command, "single.glb", ""), &back) == 0.0, "{command}");
        assert!(differing(&expected, &back) > 0.1, "{command}");
    }
}
