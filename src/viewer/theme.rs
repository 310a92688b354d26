//! How the user interface looks: grey, so that no colour beside the picture tints how its colours are judged.

use egui::style::{Selection, WidgetVisuals, Widgets};
use egui::{Color32, Context, FontFamily, FontId, Stroke, TextStyle, Theme, Visuals};

/// The panel's own grey: dark enough for pictures to shine, light enough for black to be seen as darker.
const PANEL: u8 = 46;

/// Gives a context this look, whatever the system prefers.
pub fn apply(context: &Context) {
    context.set_theme(Theme::Dark);
    context.all_styles_mut(|style| {
        style.visuals = visuals();
        style.spacing.item_spacing = egui::vec2(6.0, 4.0);
        style.spacing.button_padding = egui::vec2(6.0, 2.0);
        style.spacing.interact_size.y = 20.0;
        style.spacing.tooltip_width = 300.0;
        // Beside what scrolls, not over it.
        style.spacing.scroll.floating_allocated_width = 6.0;
        style.spacing.combo_height = 260.0;
        style.text_styles.insert(TextStyle::Heading, FontId::new(16.0, FontFamily::Proportional));
    });
}

fn grey(level: u8) -> Color32 {
    Color32::from_gray(level)
}

/// One state of a widget: its fill, what frames it, and what is written on it.
fn widget(fill: u8, frame: (f32, u8), text: (f32, u8)) -> WidgetVisuals {
    let stroke = |(width, level)| Stroke::new(width, grey(level));
    WidgetVisuals {
        bg_fill: grey(fill),
        weak_bg_fill: grey(fill),
        bg_stroke: stroke(frame),
        corner_radius: 4.into(),
        fg_stroke: stroke(text),
        expansion: 0.0,
    }
}

fn visuals() -> Visuals {
    let dark = Visuals::dark();
    let mut visuals = Visuals {
        widgets: Widgets {
            noninteractive: widget(PANEL, (1.0, 74), (1.0, 190)),
            inactive: widget(78, (0.0, 78), (1.0, 222)),
            hovered: widget(98, (1.0, 150), (1.5, 250)),
            // What has the focus looks like this, too.
            active: widget(112, (2.0, 255), (2.0, 255)),
            open: widget(64, (1.0, 120), (1.0, 235)),
        },
        selection: Selection { bg_fill: grey(205), stroke: Stroke::new(1.5, grey(16)) },
        hyperlink_color: grey(235),
        faint_bg_color: grey(PANEL + 8),
        extreme_bg_color: grey(24),
        code_bg_color: grey(64),
        warn_fg_color: grey(255),
        error_fg_color: grey(255),
        window_fill: grey(54),
        window_stroke: Stroke::new(1.0, grey(96)),
        panel_fill: grey(PANEL),
        slider_trailing_fill: true,
        collapsing_header_frame: false,
        disabled_alpha: 0.45,
        ..dark
    };
    visuals.text_cursor.stroke.color = grey(255);
    visuals.ime_composition.active_underline_stroke.color = grey(255);
    visuals.ime_composition.inactive_underline_stroke.color = grey(160);
    visuals
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All colours in what `Debug` prints of a value: whatever fields there are.
    fn colors(text: &str) -> Vec<[u8; 4]> {
        let of = |rest: &str| {
            let digits: Vec<&str> = rest.get(..11).map_or(vec![], |digits| digits.split('_').collect());
            [0, 1, 2, 3].map(|channel| u8::from_str_radix(digits[channel], 16).unwrap())
        };
        text.split('#').skip(1).map(of).collect()
    }

    #[test]
    fn every_colour_is_grey() {
        let context = Context::default();
        // The ruler: egui's own look is not.
        let is_grey = |[r, g, b, _]: &[u8; 4]| r == g && g == b;
        assert!(!colors(&format!("{:?}", Visuals::dark())).iter().all(is_grey));
        apply(&context);
        for theme in [Theme::Dark, Theme::Light] {
            let text = format!("{:?}", context.style_of(theme).visuals);
            let colors = colors(&text);
            assert!(colors.len() > 25, "{} colours in {text}", colors.len());
            assert!(colors.iter().all(is_grey), "{colors:?}");
        }
    }

    /// Contrast by WCAG 2.
    fn contrast(one: Color32, other: Color32) -> f32 {
        let light = |color: Color32| egui::Rgba::from(color).g() + 0.05;
        (light(one) / light(other)).max(light(other) / light(one))
    }

    #[test]
    fn what_is_written_can_be_read_and_focus_be_seen() {
        let visuals = visuals();
        let widgets = &visuals.widgets;
        for (text, ground) in [
            (visuals.text_color(), visuals.panel_fill),
            (visuals.selection.stroke.color, visuals.selection.bg_fill),
            (widgets.inactive.text_color(), widgets.inactive.weak_bg_fill),
            (widgets.hovered.text_color(), widgets.hovered.weak_bg_fill),
            (widgets.active.text_color(), widgets.active.weak_bg_fill),
        ] {
            assert!(contrast(text, ground) > 4.5, "{text:?} on {ground:?}: {}", contrast(text, ground));
        }
        assert!(contrast(widgets.active.bg_stroke.color, visuals.panel_fill) > 7.0);
        // Selected from not selected.
        assert!(contrast(visuals.selection.bg_fill, widgets.inactive.weak_bg_fill) > 3.0);
    }
}
