//! The box in which the user says how a picture is to be saved.

use egui::{Align2, Button, Context, Id, Key, Label, Response, ScrollArea, TextEdit, Ui, vec2};

use super::super::native;
use super::super::widgets::{About, Touch, button, choice, control, count_box, list, refused, row};
use super::{LONGEST, MOST_SAMPLES, Saving, Settings, Wish};
use crate::picture::Format;

/// Sizes to choose from, beside the one that is shown.
const SIZES: [[u32; 2]; 3] = [[1280, 720], [1920, 1080], [3840, 2160]];
/// The width of what is typed, in points.
const WIDTH: f32 = 300.0;

/// What the box says.
pub struct Form {
    pub settings: Settings,
    pub name: String,
    /// What was typed and could not be taken.
    complaint: Option<String>,
    /// Whether the name has had the focus, which it gets first.
    is_begun: bool,
}

impl Form {
    /// As the last picture was saved, under a name that is free.
    pub fn new(last: &Settings) -> Self {
        let name = native::free_name(last).unwrap_or_default();
        Self { settings: last.clone(), name, complaint: None, is_begun: false }
    }
}

/// Shows the box, if it is open; the picture that is wanted once the user says so. `shown` is the size in which the window shows the
/// picture, in pixels.
pub fn show(context: &Context, saving: &mut Saving, shown: [u32; 2]) -> Option<Wish> {
    let (mut form, longest) = (saving.form.take()?, saving.longest());
    let mut is_open = true;
    let room = context.content_rect().size() - vec2(24.0, 60.0);
    let mut end = End::Stay;
    egui::Window::new("Save picture")
        .id(Id::unique("save picture"))
        .open(&mut is_open)
        .anchor(Align2::CENTER_CENTER, [0.0; 2])
        .auto_sized()
        .collapsible(false)
        .show(context, |ui| {
            ScrollArea::vertical().max_height(room.y.max(60.0)).show(ui, |ui| end = form.rows(ui, shown, longest));
        });
    if end == End::Save {
        saving.last = form.settings.clone();
        return Some(Wish { settings: form.settings, name: Some(form.name) });
    }
    saving.form = Some(form).filter(|_| is_open && end == End::Stay);
    None
}

/// What becomes of the box.
#[derive(Clone, Copy, PartialEq)]
enum End {
    Stay,
    Save,
    Cancel,
}

impl Form {
    fn rows(&mut self, ui: &mut Ui, shown: [u32; 2], longest: u32) -> End {
        ui.set_max_width(WIDTH + 110.0);
        let before = (self.settings.clone(), self.name.clone());
        self.size(ui, shown);
        let Settings { samples, format, .. } = &mut self.settings;
        let about = "Samples a pixel: more of them make shadows and edges smoother, and take as much longer. Without shadows there are \
                     four, whatever stands here.";
        let touch = row(ui, "samples", about, |ui| count_box(ui, about, *samples, 1..=MOST_SAMPLES));
        *samples = touch.value(*samples, Settings::default().samples);
        let formats = [
            (".png", Format::Png, "The picture as it is shown: exposed, through the tone curve, 8 bits a channel."),
            (
                ".exr",
                Format::Exr,
                "Linear radiance as it is, in 32-bit floats: neither exposed nor through a tone curve.",
            ),
        ];
        let touch = row(ui, "format", "What the file holds.", |ui| choice(ui, *format, &formats));
        *format = touch.value(*format, Format::Png);
        let left_by = self.place(ui);
        let is_changed = before != (self.settings.clone(), self.name.clone());
        self.complaint = refused(ui).or(self.complaint.take().filter(|_| !is_changed));
        let place = native::place(&self.settings, &self.name);
        let size = self.settings.size.unwrap_or(shown);
        let why_not = too_large(size, longest).or(place.as_ref().err().cloned());
        ui.add_space(4.0);
        self.say(ui, place.map(|place| place.display().to_string()).as_deref().unwrap_or_default(), why_not.as_deref());
        ui.add_space(4.0);
        ui.horizontal(|ui| {
            let about =
                About::unless("Draws the picture and saves it. The window can be used meanwhile.", why_not.as_deref());
            if button(ui, about, Button::new("Save")) || left_by == Some(Key::Enter) && why_not.is_none() {
                End::Save
            } else if button(ui, "Closes this box: nothing is saved (Esc).", Button::new("Cancel"))
                || left_by == Some(Key::Escape)
            {
                End::Cancel
            } else {
                End::Stay
            }
        })
        .inner
    }

    /// A size from a list, and its numbers.
    fn size(&mut self, ui: &mut Ui, shown: [u32; 2]) {
        let size = &mut self.settings.size;
        let text = |[width, height]: [u32; 2]| format!("{width} x {height}");
        let as_shown = format!("as shown, {}", text(shown));
        let names = SIZES.map(text);
        let mut sizes = vec![(as_shown.as_str(), None, "As many pixels as the picture has in the window.")];
        let listed = names.iter().zip(SIZES);
        sizes.extend(
            listed.map(|(name, size)| (name.as_str(), Some(size), "So many pixels, whatever the window's size.")),
        );
        let other = size.map(text).unwrap_or_default();
        if !sizes.iter().any(|(_, listed, _)| listed == size) {
            sizes.push((&other, *size, "The width and height below."));
        }
        let about = "How many pixels the picture has. The view from top to bottom stays the same, whatever the size.";
        let touch = row(ui, "picture size", about, |ui| {
            let room = vec2(WIDTH, ui.spacing().interact_size.y);
            ui.allocate_ui(room, |ui| list(ui, "size", about, *size, &sizes)).inner
        });
        *size = touch.value(*size, None);
        let [width, height] = size.unwrap_or(shown);
        let pixels = 1..=LONGEST;
        row(ui, "", "", |ui| {
            let about = "The picture's width in pixels.";
            let touch = count_box(ui, about, width, pixels.clone()).map(|width| [width, height]);
            ui.label("x");
            let about = "The picture's height in pixels.";
            touch.or(count_box(ui, about, height, pixels).map(|height| [width, height]))
        })
        .apply(size);
    }

    /// Folder and name; by which key the name was left, if it was.
    fn place(&mut self, ui: &mut Ui) -> Option<Key> {
        let about = "The folder that the picture is saved in; it is there already. Empty: the one that the program was started in.";
        let folder = self.settings.folder.clone().unwrap_or_default();
        let touch =
            row(ui, "folder", about, |ui| text_box(ui, about, &folder, &native::folder(None).display().to_string()).0);
        let folder = touch.value(folder, String::new());
        self.settings.folder = (!folder.is_empty()).then_some(folder);
        let about = "The file's name. What is there already is not written over: the next free name is taken.";
        let (touch, response) = row(ui, "name", about, |ui| text_box(ui, about, &self.name, ""));
        if !std::mem::replace(&mut self.is_begun, true) {
            response.request_focus();
        }
        let free = || native::free_name(&self.settings).unwrap_or_default();
        match touch {
            Touch::Reset => self.name = free(),
            touch => self.name = touch.value(self.name.clone(), String::new()),
        }
        let is_left_by = |key: &Key| response.lost_focus() && ui.input(|input| input.key_pressed(*key));
        [Key::Enter, Key::Escape].into_iter().find(is_left_by)
    }

    /// Where the picture will be, or why it cannot be saved.
    fn say(&self, ui: &mut Ui, place: &str, why_not: Option<&str>) {
        let said = match why_not {
            Some(why_not) => format!("can't: {why_not}"),
            None => format!("will be {place}"),
        };
        ui.add(Label::new(said).wrap());
        if let Some(complaint) = &self.complaint {
            ui.add(Label::new(complaint).wrap());
        }
    }
}

/// A box of a line of text, and what was done to it.
fn text_box(ui: &mut Ui, about: &str, text: &String, hint: &str) -> (Touch<String>, Response) {
    let mut own = None;
    let touch = control(ui, about, text, |ui, text| {
        let response = ui.add(TextEdit::singleline(text).hint_text(hint).desired_width(WIDTH));
        own = Some(response.clone());
        response
    });
    (touch, own.unwrap_or_else(|| ui.response()))
}

/// Why a size cannot be drawn; none where it can.
fn too_large(size: [u32; 2], longest: u32) -> Option<String> {
    let [width, height] = size;
    (width.max(height) > longest)
        .then(|| format!("{width} x {height} is too large: this device draws up to {longest} a side"))
}
