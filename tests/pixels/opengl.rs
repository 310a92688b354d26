//! An OpenGL adapter (Mesa's llvmpipe, which scripts/setup installs) beside the Vulkan driver, whose pictures other tests hold to the
//! truth. That there is none is a failure.

use std::process::Command;
use std::sync::LazyLock;

use serde_json::Value;
use velour::picture::{LinearImage, Picture};
use velour::renderer::{Gpu, Offscreen, RadianceFormat, device};
use velour::scene::{AlphaMode, Edits, Scene, TextureSlot};
use velour::table::SheenTable;

use super::compare::{GPU, SIZE};
use super::run::{Bench, unshadowed};
use super::textures::{floor, rich, textured};

/// What halves keep of a number: 11 binary digits, rounded either way.
const OF_HALVES: f32 = 1.0 / 1024.0;
/// Tolerance relative to a value, and to the picture's greatest: rounding in 32-bit floats, which the two drivers' compilers order
/// differently. Measured in 32 bits: 1.6e-8 of the default scene's mean, 5.5e-4 of one pixel.
const RELATIVE: f32 = 1e-4;
const OF_GREATEST: f32 = 1e-5;
/// The share of pixels that may be off: drivers may move edges. Measured on llvmpipe and lavapipe: none.
const MOST_OFF: f64 = 0.005;

/// The adapter as `velour info` prints it.
fn description() -> String {
    let info = Bench::new().run("info").stdout;
    let adapters = info.lines().filter_map(|line| line.strip_prefix("adapter: "));
    let opengl = adapters.into_iter().find(|adapter| adapter.contains("(Gl, "));
    opengl.unwrap_or_else(|| panic!("no OpenGL adapter, which scripts/setup installs, in {info}")).to_owned()
}

static GL: LazyLock<Gpu> = LazyLock::new(|| {
    let gpu = pollster::block_on(device::open_offscreen(Some(&description()))).unwrap();
    assert_eq!(gpu.adapter.get_info().backend, wgpu::Backend::Gl);
    assert_ne!(GPU.adapter.get_info().backend, wgpu::Backend::Gl, "the other adapter of these tests");
    gpu
});

/// How many pixels of the OpenGL adapter's picture are not the other's.
fn off(found: &[[f32; 3]], expected: &[[f32; 3]], bits: u32) -> usize {
    let greatest = expected.iter().flatten().copied().fold(0.0, f32::max);
    assert!(greatest > 0.0 && found.len() == expected.len());
    let relative = if bits == 16 { RELATIVE + OF_HALVES } else { RELATIVE };
    let is_near = |(found, expected): (&f32, &f32)| {
        (found - expected).abs() <= relative * expected.abs() + OF_GREATEST * greatest
    };
    let pixels = found.iter().zip(expected);
    pixels.filter(|(found, expected)| !found.iter().zip(expected.iter()).all(is_near)).count()
}

fn hold(found: &[[f32; 3]], expected: &[[f32; 3]], bits: u32, what: &str) {
    let (off, count) = (off(found, expected, bits), expected.len());
    println!("{what}: {off} of {count} pixels are off");
    assert!(off as f64 <= MOST_OFF * count as f64, "{what}: {off} of {count} pixels are off");
}

fn linear(gpu: &Gpu, scene: &Scene) -> (LinearImage, u32) {
    let drawn = unshadowed(scene, &Edits::default());
    let mut renderer = Offscreen::nearest_for_linear(gpu, 1, &SheenTable::embedded(), &drawn).unwrap();
    let picture = gpu.block_on(renderer.linear(gpu, &scene.cameras[0], SIZE, &drawn.settings)).unwrap();
    (picture, renderer.radiance().bits())
}

/// Sheen over metal and dielectric, with textures in most slots, and a normal map.
fn rich_scene() -> Scene {
    let mut scene = floor(rich());
    let texels = |low: u8| (0..64).map(|k: u8| [low + 2 * k, 250 - 3 * k, low + k, 200]).collect::<Vec<[u8; 4]>>();
    for slot in [
        TextureSlot::BaseColor,
        TextureSlot::MetallicRoughness,
        TextureSlot::Specular,
        TextureSlot::SheenColor,
        TextureSlot::SheenRoughness,
    ] {
        textured(&mut scene, slot, [8, 8], texels(10 * slot as u8));
    }
    textured(&mut scene, TextureSlot::Normal, [2, 2], [[128, 128, 255, 255], [150, 120, 250, 255]].repeat(2));
    scene
}

#[test]
fn textures_and_all_lobes() {
    let scene = rich_scene();
    let ((found, bits), (expected, _)) = (linear(&GL, &scene), linear(&GPU, &scene));
    hold(&found.pixels, &expected.pixels, bits, "a rich floor");
    let brighter: Vec<[f32; 3]> = found.pixels.iter().map(|pixel| pixel.map(|value| 1.003 * value)).collect();
    assert!(off(&brighter, &expected.pixels, bits) > brighter.len() / 10, "0.3% more light is not seen");
}

/// What is cut out by one sample a pixel is the same everywhere.
#[test]
fn cut_outs() {
    let mut scene = rich_scene();
    scene.materials[0].alpha_mode = AlphaMode::Mask { cutoff: 0.5 };
    let image = scene.materials[0].textures[TextureSlot::BaseColor as usize].unwrap().texture;
    scene.images[scene.textures[image].image].texels.iter_mut().step_by(3).for_each(|texel| texel[3] = 20);
    let ((found, bits), (expected, _)) = (linear(&GL, &scene), linear(&GPU, &scene));
    hold(&found.pixels, &expected.pixels, bits, "a rich floor with holes");
    let (whole, _) = linear(&GL, &rich_scene());
    assert!(off(&whole.pixels, &expected.pixels, bits) > whole.pixels.len() / 10, "the holes are not seen");
}

/// By the binary, which finds the adapter by what it prints; prior work's sheens need a table that is drawn.
#[test]
fn flags_that_change_the_pipelines() {
    let (bench, adapter) = (Bench::new(), description());
    let draw = |output: &str, flags: &str, adapter: Option<&str>| {
        let mut command = bench.command(&format!("render scene.glb -o {output} --size 96x64 --msaa 1 --json {flags}"));
        adapter.map(|adapter| command.args(["--adapter", adapter]));
        let output = command.output().unwrap();
        assert!(output.status.success(), "{flags}: {}", String::from_utf8_lossy(&output.stderr));
        serde_json::from_slice::<Value>(&output.stdout).unwrap()["backend"].clone()
    };
    let bits = RadianceFormat::nearest_linear(&GL.adapter, 1).unwrap().bits();
    for flags in [
        "",
        "--sheen-model burley",
        "--sheen-model conty-kulla",
        "--sheen-model neubelt-pettineo",
        "--sheen-model patry --ambient 0.2,0.3,0.4",
        "--layering reciprocal",
    ] {
        assert_eq!(draw("gl.exr", flags, Some(&adapter.to_uppercase())), "gl");
        assert_ne!(draw("other.exr", flags, None), "gl");
        let [found, expected] = ["gl.exr", "other.exr"].map(|name| Picture::load(&bench.path(name)).unwrap());
        hold(&found.pixels, &expected.pixels, bits, flags);
    }
    draw("gl.png", "", Some(&adapter));
    draw("other.png", "", None);
    let [found, expected] = ["gl.png", "other.png"].map(|name| Picture::load(&bench.path(name)).unwrap());
    let far = found.pixels.iter().flatten().zip(expected.pixels.iter().flatten());
    assert!(far.filter(|(found, expected)| (**found - **expected).abs() > 1.5 / 255.0).count() < 30);
}

/// A machine where OpenGL, by Mesa's software driver, is all there is.
fn opengl_alone(mut command: Command) -> Command {
    command.env("VK_DRIVER_FILES", "/nowhere/driver.json").env("VK_ICD_FILENAMES", "/nowhere/driver.json");
    command.env("LIBGL_ALWAYS_SOFTWARE", "1");
    command
}

#[test]
fn with_opengl_alone_each_command_gives_its_picture() {
    let bench = Bench::new();
    let run = |arguments: &str| {
        let output = opengl_alone(bench.command(arguments)).output().unwrap();
        let [stdout, stderr] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
        assert_eq!(output.status.code(), Some(0), "{arguments}: {stderr}");
        (stdout, stderr)
    };
    // What the adapter draws less than was asked for is one line.
    // With shadows all samples are drawn one by one.
    let cases = [("--shadows off", 4), ("", 1), ("--msaa 4", 1), ("--msaa 1", 1), ("--sheen-model burley --msaa 1", 1)];
    for (arguments, samples) in cases {
        for output in ["out.png", "out.exr"] {
            let (stdout, stderr) = run(&format!("render scene.glb -o {output} --size 48x32 --json {arguments}"));
            let figures: Value = serde_json::from_str(&stdout).unwrap();
            assert_eq!((&figures["backend"], &figures["msaa"]), (&"gl".into(), &1.into()), "{figures}");
            let short = samples == 4 || (output == "out.exr" && RadianceFormat::linear(&GL.adapter, 1).is_none());
            assert_eq!(stderr.lines().count(), usize::from(short), "{arguments}: {stderr}");
            assert_eq!(stderr.contains("1 of 4 samples"), samples == 4, "{stderr}");
            assert!(Picture::load(&bench.path(output)).unwrap().pixels.iter().flatten().any(|&value| value > 0.2));
        }
    }
    let (stdout, stderr) = run("");
    assert!(stdout.contains("velour.png") && stderr.is_empty(), "{stdout}{stderr}");
}

/// OpenGL 3.3, without storage buffers: the reference draws, and a line says why.
#[test]
fn adapters_that_can_draw_no_scene_are_told() {
    let bench = Bench::new();
    let old = |arguments: &str| {
        let mut command = opengl_alone(bench.command(arguments));
        command.env("MESA_GL_VERSION_OVERRIDE", "3.3");
        command.env("MESA_EXTENSION_OVERRIDE", "-GL_ARB_shader_storage_buffer_object");
        command
    };
    let hint = "vertex shaders have no storage buffers";
    let output = old("render scene.glb -o out.png --size 48x32").output().unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!((output.status.code(), stderr.lines().count()), (Some(0), 1), "{stderr}");
    assert!(stderr.contains(hint) && stderr.contains("the reference draws"), "{stderr}");
    bench.refused(&mut old("render scene.glb -o other.png --adapter llvmpipe"), 3, hint);
    let info = String::from_utf8(old("info").output().unwrap().stdout).unwrap();
    assert!(info.contains(hint), "{info}");
}

/// A device that has what `needed_limits` says, and no more.
#[test]
fn what_every_scene_needs_is_all_that_it_needs() {
    let limits = device::needed_limits();
    let descriptor = wgpu::DeviceDescriptor { required_limits: limits, ..Default::default() };
    let (device, queue) = pollster::block_on(GPU.adapter.request_device(&descriptor)).unwrap();
    let least = Gpu { adapter: GPU.adapter.clone(), device, queue };
    let picture = |gpu: &Gpu| {
        let (table, scene) = (SheenTable::embedded(), rich_scene());
        let drawn = unshadowed(&scene, &Edits::default());
        let mut renderer = Offscreen::for_display(gpu, 1, &table, &drawn).unwrap();
        gpu.block_on(renderer.display(gpu, &scene.cameras[0], SIZE, &drawn.settings)).unwrap()
    };
    assert_eq!(picture(&least), picture(&GPU));
}
