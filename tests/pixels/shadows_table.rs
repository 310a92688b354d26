//! How far shadows in real time are from the reference, by the number of samples: the table of docs/accuracy.md.

use velour::picture::{FlipMap, Format, LinearImage, Picture};
use velour::reference::Filter;
use velour::renderer::Effort;
use velour::scene::Edits;
use velour::scene::assets::{Asset, DRAPE, DUST};

use super::compare::GPU;
use super::obstacles::{self, Case};
use super::shadows::{apart, offscreen, traced};

const SIZE: [u32; 2] = [160, 90];
const SAMPLES: [u32; 5] = [1, 4, 16, 64, 256];

fn asset(name: &'static str, asset: &Asset) -> Case {
    Case { name, scene: asset.load().unwrap(), edits: Edits::default() }
}

/// HDR-FLIP, its mean.
fn flip(test: &LinearImage, truth: &LinearImage) -> f64 {
    let picture = |image: &LinearImage| Picture {
        format: Format::Exr,
        width: image.width,
        height: image.height,
        pixels: image.pixels.clone(),
    };
    FlipMap::between(&picture(test), &picture(truth), &|_, _| ()).mean()
}

/// Prints a row a scene: relative mean absolute errors in %, the reference's own taken off in squares, for each number of samples; the
/// slope of their logarithms from 16 to 256; FLIP at 1 and 256.
#[test]
#[ignore = "takes a quarter of an hour"]
fn errors_by_the_number_of_samples() {
    let mut slopes = Vec::new();
    println!("| scene | 1 | 4 | 16 | 64 | 256 | slope | FLIP at 1 | FLIP at 256 |");
    println!("|---|---|---|---|---|---|---|---|---|");
    for case in [asset("drape", &DRAPE), asset("dust", &DUST)].into_iter().chain(obstacles::all()) {
        let is_dear = case.scene.lights.len() > 8;
        let truth = traced(&case, SIZE, Filter::Box, if is_dear { 64 } else { 512 });
        let mut renderer = offscreen(&case, false, Effort { samples: 1, seed: 1, spread: true });
        let pictures = SAMPLES.map(|samples| {
            renderer.effort.samples = samples;
            let (camera, settings) = (&case.scene.cameras[0], case.edits.settings());
            GPU.block_on(renderer.linear(&GPU, camera, SIZE, &settings)).unwrap()
        });
        let errors = pictures.each_ref().map(|picture| apart(picture, &truth)[0]);
        let slope = (errors[4] / errors[2]).log2() / 4.0;
        let shares = errors.map(|error| format!("{:.2}", 100.0 * error)).join(" | ");
        let [first, last] = [&pictures[0], &pictures[4]].map(|picture| flip(picture, &truth.radiance));
        println!("| {} | {shares} | {slope:.2} | {first:.4} | {last:.4} |", case.name);
        slopes.push(slope);
    }
    assert!(slopes.iter().all(|slope| *slope < -0.45), "{slopes:?}");
}
