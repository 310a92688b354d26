//! What settings make of materials.

use std::collections::BTreeMap;

use glam::Vec3;

use crate::scene::{Layering, Material, Overrides, Settings, Sheen};

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
        let own_overrides = BTreeMap::from([(3, overrides)]);
        for settings in [
            Settings { overrides, ..Settings::default() },
            Settings { material_overrides: own_overrides, ..Settings::default() },
        ] {
            let found = settings.sheen_of(3, &material(own)).map(|look| look.sheen);
            assert_eq!(found, expected, "{alpha:?} {sheen_color:?} {own:?}");
        }
    }
}

#[test]
fn what_is_given_stands_whatever_the_material_has_there() {
    let fuzz = Sheen { weight: 0.5, ..Sheen::new(Vec3::X, 0.3) };
    let material = Material { sheen: Some(fuzz), ..Material::matte("", Vec3::ONE) };
    for (alpha, sheen_color) in [(None, None), (Some(0.7), None), (None, Some(Vec3::Y)), (Some(0.7), Some(Vec3::Y))] {
        let overrides = Overrides { alpha, sheen_color, ..Overrides::default() };
        let look = Settings { overrides, ..Settings::default() }.sheen_of(0, &material).unwrap();
        // A given colour covers all of the surface; textures of what is given do not count.
        assert_eq!(look.sheen.weight, if sheen_color.is_some() { 1.0 } else { 0.5 });
        assert_eq!((look.color_is_textured, look.roughness_is_textured), (sheen_color.is_none(), alpha.is_none()));
    }
}

#[test]
fn a_materials_own_overrides_go_before_those_of_all() {
    let all = Overrides { alpha: Some(0.1), layering: Some(Layering::None), ..Overrides::default() };
    let one = Overrides { alpha: Some(0.9), ..Overrides::default() };
    let settings = Settings { overrides: all, material_overrides: BTreeMap::from([(1, one)]), ..Settings::default() };
    let material = Material::matte("felt", Vec3::ONE);
    for (index, alpha) in [(0, 0.1), (1, 0.9), (2, 0.1)] {
        assert_eq!(settings.sheen_of(index, &material).unwrap().sheen.roughness, alpha);
        assert_eq!(settings.layering_of(index), Layering::None);
    }
}

#[test]
fn black_fibres_count_where_they_hide_the_base() {
    let fuzz = Sheen { weight: 0.5, ..Sheen::new(Vec3::ZERO, 0.3) };
    let material = |sheen| Material { sheen: Some(sheen), ..Material::matte("", Vec3::ONE) };
    assert!(Settings::default().sheen_of(0, &material(fuzz)).is_none());
    let overrides = Overrides { layering: Some(Layering::OpenPbr), ..Overrides::default() };
    let settings = Settings { overrides, ..Settings::default() };
    assert_eq!(settings.sheen_of(0, &material(fuzz)).unwrap().sheen, fuzz);
    assert!(settings.sheen_of(0, &material(Sheen { weight: 0.0, ..fuzz })).is_none());
}
