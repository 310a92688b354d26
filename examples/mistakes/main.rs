//! Pictures of the mistakes that are made when the shaders are carried over, each planted in their text:
//! `cargo run --release --example mistakes docs/mistakes` makes those of docs/integration.md.

mod device;
mod planted;

use std::path::Path;

use velour::picture::{LinearImage, ToneCurve};
use velour::renderer::device::open_offscreen;

/// As in shell.wgsl.
const SIZE: [u32; 2] = [360, 240];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).ok_or("give the folder of the pictures")?;
    std::fs::create_dir_all(&folder)?;
    let gpu = pollster::block_on(open_offscreen(None))?;
    let right = device::draw(&gpu, &planted::source(&[]), SIZE);
    save(&folder, "right", &right)?;
    for (name, edits) in planted::MISTAKES {
        let wrong = device::draw(&gpu, &planted::source(edits), SIZE);
        let apart: f64 = wrong.pixels.iter().zip(&right.pixels).map(|(wrong, right)| difference(wrong, right)).sum();
        let radiance: f64 = right.pixels.iter().map(|right| difference(right, &[0.0; 3])).sum();
        println!("{name}: {:.1}% of the picture's radiance", 100.0 * apart / radiance);
        save(&folder, name, &wrong)?;
    }
    Ok(())
}

fn difference(one: &[f32; 3], other: &[f32; 3]) -> f64 {
    one.iter().zip(other).map(|(one, other)| f64::from((one - other).abs())).sum()
}

fn save(folder: &str, name: &str, picture: &LinearImage) -> Result<(), Box<dyn std::error::Error>> {
    let shown = picture.display(1.5, ToneCurve::Neutral);
    Ok(std::fs::write(Path::new(folder).join(name).with_extension("png"), shown.to_png()?)?)
}
