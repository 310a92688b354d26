//! Alpha: one large slider between fuzz and dust, with pictures of what lies between; a sweep, and a sheet of nine.

use egui::{Button, ColorImage, Image, Sense, TextureHandle, Ui, vec2};

use super::super::sheet::Sheet;
use super::super::state::State;
use super::super::sweep::Sweep;
use super::super::widgets::{About, Touch, button, number_box, slider};

/// Pictures of alphas, and where they come from: see `assets/README.md`.
const PICTURES: [(f32, &[u8]); 4] = [
    (0.2, include_bytes!("../../../assets/alpha_0.2.png")),
    (0.4, include_bytes!("../../../assets/alpha_0.4.png")),
    (0.65, include_bytes!("../../../assets/alpha_0.65.png")),
    (1.0, include_bytes!("../../../assets/alpha_1.0.png")),
];

/// The slider's height, in points: it is what people are to touch first.
const HEIGHT: f32 = 30.0;

/// Height over width of the pictures.
const ASPECT: f32 = 102.0 / 136.0;

/// What is done with alpha, where it is this now; nothing where something speaks against it.
pub fn show(ui: &mut Ui, alpha: f32, why_not: Option<&str>) -> Touch<f32> {
    let text = "Alpha, the roughness of the layer. Small: fuzz, seen as a bright rim where one looks along the surface. 1: dust, \
                which brightens it all over.";
    let about = About::unless(text, why_not);
    let typed = ui.horizontal(|ui| {
        ui.label(egui::RichText::new("alpha").strong()).on_hover_text(text);
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            number_box(ui, about, alpha, 0.0..=1.0, 0.003)
        })
        .inner
    });
    let slid = ui.scope(|ui| {
        ui.spacing_mut().interact_size.y = HEIGHT;
        ui.spacing_mut().slider_rail_height = 12.0;
        ui.spacing_mut().slider_width = ui.available_width();
        slider(ui, about, alpha, 0.0..=1.0, |slider| slider)
    });
    ui.horizontal(|ui| {
        ui.label("fuzz (a rim)");
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| ui.label("dust (all over)"));
    });
    let picked = pictures(ui, alpha, why_not);
    typed.inner.or(slid.inner).or(picked)
}

/// Four pictures; a click on one sets its alpha.
fn pictures(ui: &mut Ui, alpha: f32, why_not: Option<&str>) -> Touch<f32> {
    let textures = textures(ui);
    let gap = 4.0;
    let width = (ui.available_width() - gap * (PICTURES.len() - 1) as f32) / PICTURES.len() as f32;
    let mut touch = Touch::Nothing;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = gap;
        for ((shown, _), texture) in PICTURES.iter().zip(&textures) {
            let image = Image::new((texture.id(), texture.size_vec2()));
            let image = image
                .fit_to_exact_size(width * vec2(1.0, ASPECT))
                .corner_radius(3.0)
                .alt_text(format!("alpha {shown}"));
            let text = format!("What alpha {shown} looks like. Click to set it.");
            let about = About::unless(&text, why_not);
            let response = ui.add_enabled(why_not.is_none(), image.sense(Sense::click()));
            response.widget_info(|| {
                egui::WidgetInfo::labeled(egui::accesskit::Role::Button, why_not.is_none(), format!("alpha {shown}"))
            });
            if alpha == *shown || response.hovered() || response.has_focus() {
                let stroke = (2.0, ui.visuals().strong_text_color());
                ui.painter().rect_stroke(response.rect, 3.0, stroke, egui::StrokeKind::Inside);
            }
            if about.on(response, "").clicked() {
                touch = Touch::Set(*shown);
            }
        }
    });
    touch
}

/// The pictures on the device: they are decoded once.
fn textures(ui: &Ui) -> [TextureHandle; PICTURES.len()] {
    let id = egui::Id::unique("pictures of alpha");
    if let Some(textures) = ui.data(|data| data.get_temp(id)) {
        return textures;
    }
    let textures =
        PICTURES.map(|(alpha, png)| ui.ctx().load_texture(format!("alpha {alpha}"), decoded(png), Default::default()));
    ui.data_mut(|data| data.insert_temp(id, textures.clone()));
    textures
}

/// What a .png of the program's own holds: a test decodes them all.
fn decoded(png: &[u8]) -> ColorImage {
    let image = image::load_from_memory(png).unwrap_or_default().into_rgb8();
    ColorImage::from_rgb([image.width() as usize, image.height() as usize], &image)
}

/// Buttons that show alpha as it changes, and side by side.
pub fn show_buttons(ui: &mut Ui, state: &mut State, alpha: f32, why_not: Option<&str>) {
    ui.horizontal(|ui| {
        let about = "Moves alpha from fuzz to dust and back until you press this again, or Esc, or touch the slider.";
        let is_sweeping = state.sweep.is_some();
        let title = if is_sweeping { "stop sweeping" } else { "sweep alpha" };
        if button(ui, About::unless(about, why_not), Button::new(title).selected(is_sweeping)) {
            let set = state.edits.materials.get(&state.material).and_then(|own| own.alpha);
            let now = ui.input(|input| input.time);
            state.sweep = (!is_sweeping).then(|| Sweep::new(state.material, alpha, set, now));
            // It would hide what is swept.
            state.sheet = None;
            ui.ctx().request_repaint();
        }
        let about = "Shows the view at nine alphas side by side, to pick one.";
        let is_open = state.sheet.is_some();
        if button(ui, About::unless(about, why_not), Button::new("nine alphas").selected(is_open)) {
            state.sweep = None;
            state.sheet = (!is_open).then(|| Sheet::new(&state.edits, state.material));
        }
    });
}

/// Moves alpha on where it is being swept.
pub fn sweep(ui: &Ui, state: &mut State) {
    if state.sweep_on(ui.input(|input| input.time)) {
        ui.ctx().request_repaint();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pictures_are_there_and_grow_brighter() {
        let brightness = PICTURES.map(|(alpha, png)| {
            let image = decoded(png);
            assert_eq!(image.size, [136, 102], "alpha {alpha}");
            assert!(png.len() < 20_000, "{} bytes", png.len());
            image.pixels.iter().map(|pixel| f64::from(pixel.g())).sum::<f64>()
        });
        assert!(brightness.is_sorted() && PICTURES.is_sorted_by_key(|(alpha, _)| *alpha), "{brightness:?}");
    }
}
