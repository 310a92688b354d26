//! Both scenes of our own, small, against pictures kept in `tests/golden/`: a guard against change, no proof of
//! anything.
//!
//! After a change that is intended, `VELOUR_BLESS=1 cargo test --test pixels golden` writes the pictures anew: look at
//! them, and commit them by themselves.

use std::path::{Path, PathBuf};

use velour::picture::DisplayImage;
use velour::renderer::Offscreen;
use velour::scene::{Edits, gltf};

use super::compare::GPU;

const SIZE: [u32; 2] = [192, 108];

/// Pairs: how many pixels may differ by more than this step, of 255. Drivers move corners to grids of their own, and in
/// a small picture of 30,000 triangles most pixels lie on seams between triangles: SwiftShader and lavapipe differ by
/// more than 2 in 932 pixels of the drape and 259 of the dusty form, by more than 16 in 217 and 17, and by 89 and 118
/// at most.
const MOST: [(u8, usize); 3] = [(2, 1200), (16, 300), (128, 0)];

pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn golden(name: &str) -> PathBuf {
    root().join("tests/golden").join(name).with_extension("png")
}

fn render(name: &str) -> DisplayImage {
    let scene = gltf::load(&root().join("assets").join(name).with_extension("glb"), &gltf::Options::default()).unwrap();
    GPU.block_on(Offscreen::screenshot(&GPU, &scene, &Edits::default(), SIZE)).unwrap()
}

/// How two pictures differ, where that is more than drivers do.
fn compare(left: &DisplayImage, right: &DisplayImage) -> Result<(), String> {
    if [left.width, left.height] != [right.width, right.height] {
        return Err("the sizes differ".to_owned());
    }
    let difference = |(left, right): (&[u8; 3], &[u8; 3])| (0..3).map(|i| left[i].abs_diff(right[i])).max();
    let differences: Vec<u8> = left.pixels.iter().zip(&right.pixels).filter_map(difference).collect();
    for (step, most) in MOST {
        let count = differences.iter().filter(|difference| **difference > step).count();
        if count > most {
            return Err(format!("{count} pixels differ by more than {step} of 255, where {most} may"));
        }
    }
    Ok(())
}

fn hold(name: &str) {
    let picture = render(name);
    assert_eq!(picture, render(name), "{name}: not the same from run to run");
    let path = golden(name);
    if std::env::var_os("VELOUR_BLESS").is_some() {
        std::fs::write(&path, picture.to_png().unwrap()).unwrap();
        return;
    }
    let bytes = std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let kept = DisplayImage::from_png(&bytes).unwrap();
    if let Err(said) = compare(&picture, &kept) {
        let found = std::env::temp_dir().join(format!("velour-{name}.png"));
        std::fs::write(&found, picture.to_png().unwrap()).unwrap();
        panic!("{name}: {said}; compare {} with {}", found.display(), path.display());
    }
}

#[test]
fn the_drape_is_as_it_was() {
    hold("drape");
}

#[test]
fn the_dusty_form_is_as_it_was() {
    hold("dust");
}

#[test]
fn changed_pictures_are_rejected() {
    let picture = render("drape");
    compare(&picture, &picture).unwrap();
    let changed = |change: &dyn Fn(&mut Vec<[u8; 3]>)| {
        let mut other = picture.clone();
        change(&mut other.pixels);
        compare(&picture, &other).is_err()
    };
    assert!(changed(&|pixels| pixels.rotate_right(1)));
    assert!(changed(&|pixels| pixels.rotate_right(SIZE[0] as usize)));
    assert!(changed(&|pixels| pixels.reverse()));
    assert!(changed(&|pixels| pixels.iter_mut().flatten().for_each(|channel| *channel = channel.saturating_add(3))));
    assert!(changed(&|pixels| pixels.iter_mut().for_each(|[r, _, b]| std::mem::swap(r, b))));
    assert!(changed(&|pixels| pixels.iter_mut().flatten().for_each(|channel| *channel -= *channel / 16)));
    assert!(changed(&|pixels| pixels[SIZE[0] as usize * 54 + 96] = [255, 0, 255]));
    assert!(
        changed(&|pixels| pixels[..2000].fill([0; 3])) || picture.pixels[..2000].iter().all(|pixel| *pixel == [0; 3])
    );
    assert!(!changed(&|pixels| pixels[0][0] ^= 1), "one step of one pixel is rounding");
}
