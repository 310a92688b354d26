//! What settings make of materials.

use glam::Vec3;

use crate::scene::{Material, Settings, Sheen};

#[test]
fn settings_give_every_material_a_sheen() {
    let red = Sheen { color: Vec3::X, roughness: 0.25 };
    let black = Sheen { color: Vec3::ZERO, roughness: 0.25 };
    let material = |sheen| Material {
        name: String::new(),
        base_color: Vec3::ONE,
        sheen,
        emission: Vec3::ZERO,
        double_sided: false,
    };
    let cases = [
        (None, None, Some(red), Some(red)),
        (None, None, Some(black), None),
        (None, None, None, None),
        (Some(0.75), None, Some(red), Some(Sheen { roughness: 0.75, ..red })),
        (Some(0.0), None, Some(red), Some(Sheen { roughness: 0.0, ..red })),
        (None, Some(Vec3::Y), Some(red), Some(Sheen { color: Vec3::Y, ..red })),
        (Some(0.75), None, None, Some(Sheen { color: Vec3::ONE, roughness: 0.75 })),
        (Some(0.75), None, Some(black), Some(Sheen { color: Vec3::ONE, roughness: 0.75 })),
        (None, Some(Vec3::Y), None, Some(Sheen { color: Vec3::Y, roughness: 0.5 })),
        (None, Some(Vec3::ZERO), Some(red), Some(Sheen { color: Vec3::ZERO, roughness: 0.25 })),
    ];
    for (alpha, sheen_color, own, expected) in cases {
        let settings = Settings { alpha, sheen_color, ..Settings::default() };
        assert_eq!(settings.sheen_of(&material(own)), expected, "{alpha:?} {sheen_color:?} {own:?}");
    }
}
