// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
//! A picture without a window: `cargo run --release --example offscreen scene.glb picture.png`.

use velour::picture::DisplayImage;
use velour::renderer::{Offscreen, device::open_offscreen};
use velour::scene::{Edits, gltf};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let scene = arguments.next().unwrap_or_else(|| "assets/drape.glb".to_owned());
    let output = arguments.next().unwrap_or_else(|| "picture.png".to_owned());
    let scene = gltf::load(scene.as_ref(), &gltf::Options::default())?;
    let gpu = pollster::block_on(open_offscreen(None))?;
    // What a user would change: materials, lights, exposure; here nothing.
    let edits = Edits::default();
    let picture: DisplayImage = gpu.block_on(Offscreen::screenshot(&gpu, &scene, &edits, [1280, 720]))?;
    std::fs::write(&output, picture.to_png()?)?;
    println!("wrote {output}");
    Ok(())
}
