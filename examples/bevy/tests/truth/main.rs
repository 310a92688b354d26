// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
//! Bevy with our shaders against `velour render`, in linear radiance. VELOUR says where velour is; else it is looked
//! for in the repository's target folder.

mod gltf;
mod scene;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use bevy::prelude::*;
use bevy::render::render_resource::TextureFormat;
use image::{ImageBuffer, Rgb};
use velour_bevy::headless::Headless;
use velour_bevy::sheen::{RectLightTerms, Sheen, SheenTables, table};

const SIZE: UVec2 = UVec2::new(256, 192);
/// A pixel agrees where no channel differs by more than this, times its radiance where that is above 1.
const GREATEST: f32 = 1e-3;
/// Pixels that may not: those at silhouettes, where the two programs' roundings choose another triangle.
const OUTLIERS: usize = 20;
/// Greatest mean difference of what is lit, over its mean radiance.
const MEAN: f32 = 2e-4;

type Picture = ImageBuffer<Rgb<f32>, Vec<f32>>;

#[derive(Debug)]
struct Difference {
    greatest: f32,
    outliers: usize,
    mean: f32,
    /// Over all but the outliers.
    greatest_inside: f32,
}

impl Difference {
    fn agrees(&self) -> bool {
        self.outliers <= OUTLIERS && self.mean <= MEAN
    }
}

fn out(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(name)
}

fn velour() -> PathBuf {
    let target = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target");
    let built = ["release/velour", "debug/velour"].map(|name| target.join(name));
    let found = std::env::var_os("VELOUR").map(PathBuf::from).into_iter().chain(built).find(|path| path.exists());
    found.expect("no velour to compare with: run `cargo build --release` in the repository, or set VELOUR")
}

/// What velour renders of the scene.
fn rendered(name: &str, flags: &[&str]) -> Picture {
    let (scene, picture) = (out(&format!("{name}.gltf")), out(&format!("{name}.exr")));
    fs::write(&scene, gltf::gltf()).unwrap();
    let size = format!("{}x{}", SIZE.x, SIZE.y);
    let mut command = Command::new(velour());
    command.arg("render").arg(scene).arg("-o").arg(&picture);
    command.args(["--size", &size, "--msaa", "1", "--shadows", "off"]).args(flags);
    let status = command.status().unwrap();
    assert!(status.success(), "velour render: {status}");
    image::open(picture).unwrap().into_rgb32f()
}

fn truth() -> &'static Picture {
    static TRUTH: OnceLock<Picture> = OnceLock::new();
    TRUTH.get_or_init(|| rendered("velour", &[]))
}

/// What Bevy draws; `change` is what a test does to each layer.
fn drawn(name: &str, change: impl Fn(&mut Sheen, &mut Assets<Image>)) -> Picture {
    let mut headless = Headless::new(SIZE, TextureFormat::Rgba32Float);
    let target = headless.target();
    let world = headless.app.world_mut();
    let tables = world.resource::<SheenTables>().clone();
    world.resource_scope(|world, mut images: Mut<Assets<Image>>| {
        let images = std::cell::RefCell::new(&mut *images);
        scene::spawn(world, target, |color, alpha| {
            let mut sheen = tables.sheen(color, alpha);
            change(&mut sheen, &mut images.borrow_mut());
            sheen
        });
    });
    let bytes = headless.picture().expect("the device gives the picture back");
    let numbers = bytes.chunks_exact(4).map(|bytes| f32::from_le_bytes(bytes.try_into().unwrap()));
    let numbers: Vec<f32> = numbers.enumerate().filter(|(at, _)| at % 4 != 3).map(|(_, number)| number).collect();
    let picture = Picture::from_raw(SIZE.x, SIZE.y, numbers).unwrap();
    picture.save(out(&format!("{name}.exr"))).unwrap();
    picture
}

fn difference(name: &str, picture: &Picture) -> Difference {
    let mut found = Difference { greatest: 0.0, outliers: 0, mean: 0.0, greatest_inside: 0.0 };
    let (mut sum, mut radiance) = (0.0, 0.0);
    let glows = |wanted: &Rgb<f32>| scene::lights().iter().any(|light| (wanted[0] - light.radiance[0]).abs() < 1e-3);
    for (pixel, wanted) in picture.pixels().zip(truth().pixels()) {
        let errors = [0, 1, 2].map(|channel| (pixel[channel] - wanted[channel]).abs());
        assert!(errors.iter().all(|error| error.is_finite()));
        if !glows(wanted) {
            sum += errors.iter().sum::<f32>();
            radiance += wanted.0.iter().sum::<f32>();
        }
        let scaled =
            [0, 1, 2].map(|channel| errors[channel] / wanted[channel].max(1.0)).into_iter().fold(0.0, f32::max);
        found.greatest = found.greatest.max(scaled);
        if scaled > GREATEST {
            found.outliers += 1;
        } else {
            found.greatest_inside = found.greatest_inside.max(scaled);
        }
    }
    found.mean = sum / radiance;
    println!("{name}: {found:?}");
    found
}

#[test]
fn bevy_draws_what_velour_renders() {
    let found = difference("bevy", &drawn("bevy", |_, _| {}));
    assert!(found.agrees(), "{found:?}");
}

#[test]
fn a_wrong_sign_in_the_table_is_found_out() {
    let picture = drawn("wrong_sign", |sheen, images| {
        let mut wrong = table(include_bytes!("../../../../tables/sheen_ltc.dds"));
        // b is the second half of a texel's four; its sign is the top bit.
        wrong.data.iter_mut().flatten().skip(3).step_by(8).for_each(|byte| *byte ^= 0x80);
        sheen.sheen_table = images.add(wrong);
    });
    let found = difference("wrong sign", &picture);
    assert!(!found.agrees() && found.outliers > 1000, "{found:?}");
}

#[test]
fn bevys_own_terms_below_the_sheen_are_another_picture() {
    let picture = drawn("bevys_terms", |sheen, _| sheen.terms = RectLightTerms::Bevy);
    let found = difference("Bevy's terms", &picture);
    assert!(!found.agrees() && found.mean < 0.3, "{found:?}");
}

/// The base is Bevy's, which velour does not draw; so the sheen is told from it. It takes one share of all channels of
/// the base, and adds to red what it is, to blue nothing: over.r below.b - over.b below.r = sheen.r below.b.
#[test]
fn the_sheen_over_bevys_terms_is_that_of_velour() {
    let in_color = |name, color| drawn(name, |sheen, _| (sheen.terms, sheen.color) = (RectLightTerms::Bevy, color));
    let over = in_color("sheen_over_bevys_terms", LinearRgba::rgb(0.9, 0.5, 0.0));
    let below = in_color("bevys_terms_alone", LinearRgba::BLACK);
    let sheen = rendered("velours_sheen", &["--lobes", "sheen", "--sheen-color", "0.9,0.5,0"]);
    let (mut seen, mut outliers, mut greatest) = (0, 0, 0.0_f32);
    for ((over, below), sheen) in over.pixels().zip(below.pixels()).zip(sheen.pixels()) {
        let error = (over[0] * below[2] - over[2] * below[0] - sheen[0] * below[2]).abs() / below[2].max(1e-3);
        seen += usize::from(sheen[0].min(below[2]) > 10.0 * GREATEST);
        outliers += usize::from(error > GREATEST);
        greatest = greatest.max(error);
    }
    println!("sheen over Bevy's terms: greatest {greatest}, {outliers} outliers, {seen} seen");
    assert!(outliers <= OUTLIERS && seen > 10_000, "{outliers} outliers, {seen} seen");
}
