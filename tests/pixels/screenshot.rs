//! The bound of the README's screenshot test, which stands in `examples/screenshot_test.rs`, tells pictures apart.

use velour::picture::{FlipMap, Picture};
use velour::renderer::Offscreen;
use velour::scene::{Edits, MaterialEdits, gltf};

use super::compare::GPU;

/// An alpha of 0.42 in place of 0.4.
#[test]
fn a_slightly_rougher_drape_is_told_apart() {
    let scene = gltf::load("assets/drape.glb".as_ref(), &gltf::Options::default()).unwrap();
    let velvet = scene.materials.iter().position(|material| material.name == "velvet").unwrap();
    let rougher = MaterialEdits { alpha: Some(0.42), ..MaterialEdits::default() };
    let edits = Edits { materials: [(velvet, rougher)].into(), ..Edits::default() };
    let picture = GPU.block_on(Offscreen::screenshot(&GPU, &scene, &edits, [192, 108])).unwrap();
    let golden = Picture::load("tests/golden/drape.png".as_ref()).unwrap();
    let flip = FlipMap::between(&Picture::from(&picture), &golden, &|_, _| ()).mean();
    assert!(flip > 0.01, "{flip}");
}
