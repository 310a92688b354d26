// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
//! A test that compares a scene with a picture that is kept: `cargo test --example screenshot_test`.
//!
//! `velour render assets/drape.glb -o tests/golden/drape.png --size 192x108` makes the picture.

#![cfg_attr(not(test), allow(unused_imports, reason = "the test uses them"))]

use velour::picture::{FlipMap, Picture};
use velour::renderer::{Offscreen, device::open_offscreen};
use velour::scene::{Edits, gltf};

#[test]
fn the_drape_looks_as_it_did() -> Result<(), Box<dyn std::error::Error>> {
    let scene = gltf::load("assets/drape.glb".as_ref(), &gltf::Options::default())?;
    let gpu = pollster::block_on(open_offscreen(None))?;
    let picture = gpu.block_on(Offscreen::screenshot(&gpu, &scene, &Edits::default(), [192, 108]))?;
    let golden = Picture::load("tests/golden/drape.png".as_ref())?;
    assert!(FlipMap::between(&Picture::from(&picture), &golden, &|_, _| ()).mean() < 0.01);
    Ok(())
}

fn main() {
    println!("this is a test: `cargo test --example screenshot_test`");
}
