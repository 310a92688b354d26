//! Widgets that several parts of the panel have.

use egui::Ui;
use glam::Vec3;

/// A slider that changes nothing until it is touched: values from a file are not rounded, and what is typed into its
/// box stands as it was typed.
pub fn slider(ui: &mut Ui, slider: egui::Slider) {
    ui.add(slider.clamping(egui::SliderClamping::Edits));
}

/// A slider for a number in [0, 1].
pub fn share_slider(ui: &mut Ui, share: &mut f32) {
    slider(ui, egui::Slider::new(share, 0.0..=1.0).min_decimals(2));
}

/// A button that opens a colour picker on a linear Rec. 709 colour in [0, 1].
pub fn color_button(ui: &mut Ui, color: &mut Vec3) {
    let mut channels = color.to_array();
    if ui.color_edit_button_rgb(&mut channels).changed() {
        *color = Vec3::from_array(channels).clamp(Vec3::ZERO, Vec3::ONE);
    }
}

/// A radiance as users set it: its greatest channel, and its hue. The hue stays when the radiance goes to 0 and back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glow {
    pub strength: f32,
    /// The greatest channel is 1.
    pub hue: Vec3,
}

impl Glow {
    /// Of the radiance `strength` times `radiance`. The hue of black is white.
    pub fn new(radiance: Vec3, strength: Option<f32>) -> Self {
        let greatest = radiance.max_element();
        let hue = if greatest > 0.0 { radiance / greatest } else { Vec3::ONE };
        Self { strength: strength.unwrap_or(1.0) * greatest, hue }
    }

    /// The hue of the colour that a picker gives, which may be darker.
    pub fn set_color(&mut self, color: Vec3) {
        self.hue = Self::new(color, None).hue;
    }
}

/// A name of at most `most` characters, cut in its middle: what tells names apart is often at their ends.
pub fn short(name: &str, most: usize) -> String {
    let count = name.chars().count();
    if count <= most {
        return name.to_owned();
    }
    let (front, back) = (most / 2, most - most / 2 - 1);
    name.chars().take(front).chain(['…']).chain(name.chars().skip(count - back)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_glow_is_its_radiance_and_black_keeps_its_hue() {
        let radiance = Vec3::new(0.5, 2.0, 1.0);
        let glow = Glow::new(radiance, None);
        assert_eq!((glow.strength, glow.strength * glow.hue), (2.0, radiance));
        // As edits keep it: the hue, and its strength.
        let dark = Glow::new(glow.hue, Some(0.0));
        assert_eq!((dark.strength, dark.hue), (0.0, glow.hue));
        assert_eq!(Glow::new(dark.hue, Some(3.3)), Glow { strength: 3.3, hue: glow.hue });
        assert_eq!(Glow::new(Vec3::ZERO, None), Glow { strength: 0.0, hue: Vec3::ONE });
    }

    #[test]
    fn long_names_keep_both_ends() {
        assert_eq!(short("velvet", 6), "velvet");
        assert_eq!(short("velvet.001", 7), "vel…001");
        assert_eq!(short("grün-grün-grün", 5).chars().count(), 5);
    }
}
