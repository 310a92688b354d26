//! Materials to start from.

use std::sync::LazyLock;

use egui::{Button, Ui};

use super::super::widgets::{About, button};
use crate::scene::{Edits, MaterialEdits, Scene};

/// Each with its name, and a state file of the keys of all materials whose first line says what it is.
const TEXTS: [(&str, &str); 8] = [
    ("velvet", include_str!("../presets/velvet.toml")),
    ("peach skin", include_str!("../presets/peach-skin.toml")),
    ("suede", include_str!("../presets/suede.toml")),
    ("felt", include_str!("../presets/felt.toml")),
    ("moss", include_str!("../presets/moss.toml")),
    ("dusty plastic", include_str!("../presets/dusty-plastic.toml")),
    ("dusty metal", include_str!("../presets/dusty-metal.toml")),
    ("chalk", include_str!("../presets/chalk.toml")),
];

struct Preset {
    name: &'static str,
    about: &'static str,
    edits: MaterialEdits,
}

/// Read once.
static PRESETS: LazyLock<Vec<Preset>> = LazyLock::new(|| {
    let preset = |(name, text): (&'static str, &'static str)| {
        let about = text.lines().next().unwrap_or_default().trim_start_matches(['#', ' ']);
        // They are part of the program: a test reads them all.
        let edits = Edits::from_text(text, &Scene::default()).unwrap_or_default().every_material;
        Preset { name, about, edits }
    };
    TEXTS.map(preset).into()
});

impl Preset {
    /// Whether the material of these edits is this one.
    fn is_in_force(&self, edits: &MaterialEdits) -> bool {
        self.edits.or(*edits) == *edits
    }
}

/// A chip for each; `set` is what is in force of edits, `own` what a chip changes.
pub fn show(ui: &mut Ui, set: &MaterialEdits, why_not: Option<&str>, own: &mut MaterialEdits) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for preset in PRESETS.iter() {
            let chip = Button::new(preset.name).corner_radius(10.0).selected(preset.is_in_force(set));
            let about = format!("{} Sets both layers of this material.", preset.about);
            if button(ui, About::unless(&about, why_not), chip) {
                *own = preset.edits.or(*own);
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Keyed, Layering, SheenModel};
    use glam::Vec3;

    /// Hue in degrees, and how far a colour is from grey, in [0, 1].
    fn hue(color: Vec3) -> (f32, f32) {
        let (most, least) = (color.max_element(), color.min_element());
        let [r, g, b] = color.to_array();
        let sector = match most {
            most if most == r => (g - b) / (most - least),
            most if most == g => 2.0 + (b - r) / (most - least),
            _ => 4.0 + (r - g) / (most - least),
        };
        (60.0 * sector.rem_euclid(6.0), (most - least) / most)
    }

    #[test]
    fn each_says_all_of_its_material_in_two_hues() {
        for (preset, (name, text)) in PRESETS.iter().zip(TEXTS) {
            let edits = Edits::from_text(text, &Scene::default()).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert_eq!(edits, Edits { every_material: preset.edits, ..Edits::default() }, "{name} sets more");
            let keys: Vec<&str> = preset.edits.entries().into_iter().map(|(key, _)| key).collect();
            // An alpha that is set leaves nothing to the roughness map.
            let expected: Vec<&str> =
                MaterialEdits::KEYS.iter().copied().filter(|&key| key != "roughness-map").collect();
            assert_eq!(keys, expected, "{name}");
            assert_eq!(preset.edits.layering, Some(Layering::Gltf), "{name}");
            assert_eq!((preset.edits.sheen_model, preset.edits.sheen), (Some(SheenModel::Ltc), Some(true)), "{name}");
            let [(sheen, colorful), (base, deep)] =
                [preset.edits.sheen_color, preset.edits.base_color].map(|color| hue(color.unwrap()));
            let apart = (sheen - base + 180.0).rem_euclid(360.0) - 180.0;
            assert!(apart.abs() > 20.0, "{name}: hues of {sheen} and {base} degrees");
            assert!(colorful > 0.15 && deep > 0.3, "{name}: {colorful} {deep}");
            assert!(preset.about.len() > 20, "{name}: {}", preset.about);
        }
    }

    #[test]
    fn no_two_are_the_same() {
        for (index, one) in PRESETS.iter().enumerate() {
            assert!(PRESETS.iter().skip(index + 1).all(|other| !one.is_in_force(&other.edits)), "{}", one.name);
            assert!(one.is_in_force(&one.edits.or(MaterialEdits::default())));
        }
    }
}
