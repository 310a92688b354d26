//! Plates of the assets: the cloth and the dusty sculpture.

use super::plate::{Plate, Progress, Shot};
use crate::reference::Options;
use crate::scene::assets::{DRAPE, DUST};
use crate::scene::{Edits, Layering, MaterialEdits, Scene};
use glam::Vec3;
use std::collections::BTreeMap;

/// Colour of the cloth's sheen.
const COLOR: Vec3 = Vec3::new(0.6, 0.55, 0.5);

fn shot() -> Shot {
    Shot { size: [480, 270], samples: 48, exposure: 0.0, options: Options { max_bounces: 1, ..Options::default() } }
}

pub fn plates() -> Vec<Plate> {
    vec![cloth("none", None), cloth("low", Some(0.2)), cloth("high", Some(0.7)), dust()]
}

/// The cloth with a sheen of this alpha, or without sheen.
fn cloth(name: &str, alpha: Option<f32>) -> Plate {
    let says = alpha.map_or("no sheen".to_owned(), |alpha| format!("alpha {alpha}, C_sheen {COLOR}, layering gltf"));
    let make = move |progress: &Progress| {
        let scene = DRAPE.load()?;
        let velvet = named(&scene, "velvet");
        let edits = MaterialEdits {
            alpha: Some(alpha.unwrap_or(1.0)),
            sheen_color: Some(if alpha.is_some() { COLOR } else { Vec3::ZERO }),
            layering: Some(Layering::Gltf),
            base_color: Some(Vec3::new(0.05, 0.07, 0.12)),
            ..MaterialEdits::default()
        };
        let edits = Edits { materials: BTreeMap::from([(velvet, edits)]), ..Edits::default() };
        shot().take(&scene, &edits, progress)
    };
    let mut settings = vec![("scene", "drape.glb, velvet's base 0.05, 0.07, 0.12".to_owned()), ("sheen", says)];
    settings.extend(shot().settings());
    Plate { name: format!("cloth_{name}"), settings, make: Box::new(make) }
}

/// Dust on the sculpture, as the asset has it.
fn dust() -> Plate {
    const ALPHA: f32 = 0.85;
    let make = |progress: &Progress| {
        let scene = DUST.load()?;
        let dusty = named(&scene, "dusty");
        let edits = MaterialEdits { alpha: Some(ALPHA), ..MaterialEdits::default() };
        let edits = Edits { materials: BTreeMap::from([(dusty, edits)]), ..Edits::default() };
        shot().take(&scene, &edits, progress)
    };
    let mut settings = vec![("scene", "dust.glb".to_owned()), ("sheen", format!("alpha {ALPHA}, the asset's C_sheen"))];
    settings.extend(shot().settings());
    Plate { name: "dust".to_owned(), settings, make: Box::new(make) }
}

/// Index of the asset's material.
fn named(scene: &Scene, name: &str) -> usize {
    let found = scene.materials.iter().position(|material| material.name == name);
    found.unwrap_or_else(|| panic!("the asset has a material {name}"))
}
