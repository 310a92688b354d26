//! What settings make of materials.

use std::collections::BTreeMap;

use glam::Vec3;

use crate::scene::{Material, Overrides, Settings, Sheen};

#[test]
fn settings_give_every_material_a_sheen() {
    let red = Sheen::new(Vec3::X, 0.25);
    let black = Sheen::new(Vec3::ZERO, 0.25);
    let material = |sheen| Material { sheen, ..Material::matte("felt", Vec3::ONE) };
    let cases = [
        (None, None, Some(red), Some(red)),
        (None, None, Some(black), None),
        (None, None, None, None),
        (Some(0.75), None, Some(red), Some(Sheen { roughness: 0.75, ..red })),
        (Some(0.0), None, Some(red), Some(Sheen { roughness: 0.0, ..red })),
        (None, Some(Vec3::Y), Some(red), Some(Sheen { color: Vec3::Y, ..red })),
        (Some(0.75), None, None, Some(Sheen::new(Vec3::ONE, 0.75))),
        (Some(0.75), None, Some(black), Some(Sheen::new(Vec3::ONE, 0.75))),
        (None, Some(Vec3::Y), None, Some(Sheen::new(Vec3::Y, 0.5))),
        (None, Some(Vec3::ZERO), Some(red), Some(Sheen::new(Vec3::ZERO, 0.25))),
    ];
    for (alpha, sheen_color, own, expected) in cases {
        let overrides = Overrides { alpha, sheen_color, ..Overrides::default() };
        let named = BTreeMap::from([("felt".to_owned(), overrides)]);
        for settings in [
            Settings { overrides, ..Settings::default() },
            Settings { material_overrides: named, ..Settings::default() },
        ] {
            let found = settings.sheen_of(&material(own)).map(|look| look.sheen);
            assert_eq!(found, expected, "{alpha:?} {sheen_color:?} {own:?}");
        }
    }
}
