//! The README's screenshot test, as it stands there, and that its bound tells pictures apart.

use velour::scene::MaterialEdits;

use super::compare::GPU;

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
