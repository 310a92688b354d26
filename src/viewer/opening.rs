//! The box over the picture by which a file is opened: a path is typed, or one of a list is taken.

use egui::text::{CCursor, CCursorRange};
use egui::{Align2, Area, Button, Id, Key, Modal, Modifiers, Rect, RichText, ScrollArea, TextEdit, Ui, vec2};

use super::listing::{Entry, Listing};
use super::native;
use super::request::Request;
use super::widgets::{About, button, short};

/// What is typed and chosen in the box.
#[derive(Clone, Debug, Default)]
pub struct Opening {
    typed: String,
    listing: Listing,
    /// What was listed last, or is to be.
    asked: Option<String>,
    /// The entry that Enter takes; none where it takes what is typed.
    chosen: Option<usize>,
    /// Whether that is to be brought into sight.
    is_moved: bool,
    /// Whether the cursor belongs at the end of what is typed.
    is_entered: bool,
}

/// What the box is wide and its list is high, in points, where there is room.
const WIDTH: f32 = 440.0;
const HEIGHT: f32 = 230.0;
/// Most characters of a name in the list.
const NAME_SHOWN: usize = 44;
const FOLDER_SHOWN: usize = 20;

impl Opening {
    /// Opens the box, or closes it.
    pub fn toggle(opening: &mut Option<Self>) {
        *opening = if opening.is_some() { None } else { Some(Self::default()) };
    }

    /// Takes a list, where it is the one that was asked for; whether it is.
    pub fn take(&mut self, listing: Listing) -> bool {
        let is_asked = self.asked.as_ref() == Some(&listing.typed);
        if is_asked {
            (self.listing, self.chosen) = (listing, None);
        }
        is_asked
    }

    /// Chooses the next entry, or the one before; beyond either end it is what is typed.
    fn choose(&mut self, is_down: bool) {
        let count = self.listing.entries.len();
        let next = match (self.chosen, is_down) {
            (None, true) => Some(0),
            (None, false) => count.checked_sub(1),
            (Some(index), true) => Some(index + 1),
            (Some(index), false) => index.checked_sub(1),
        };
        (self.chosen, self.is_moved) = (next.filter(|&index| index < count), true);
    }

    /// What comes of an entry that is taken: a folder is looked into.
    fn enter(&mut self, entry: &Entry) -> Option<Request> {
        if entry.is_folder {
            (self.typed, self.is_entered, self.chosen) = (native::entered(&entry.path), true, None);
            return None;
        }
        entry.is_there.then(|| Request::Open(entry.path.clone()))
    }

    /// What comes of Enter.
    fn accept(&mut self) -> Option<Request> {
        if let Some(entry) = self.chosen.and_then(|index| self.listing.entries.get(index)).cloned() {
            return self.enter(&entry);
        }
        let typed = self.typed.trim();
        (!typed.is_empty()).then(|| Request::Open(native::in_full(typed)))
    }
}

/// Shows the box while it is open. What it opens closes it.
pub fn show(ui: &Ui, picture: Rect, opening: &mut Option<Opening>) -> Option<Request> {
    let shown = opening.as_mut()?;
    let screen = ui.ctx().content_rect();
    // Where the picture is too narrow for it, the panel is no hindrance.
    let place = if picture.width() < WIDTH { screen } else { picture };
    let size = vec2(WIDTH, HEIGHT).min(place.size() - vec2(40.0, 130.0)).max(vec2(120.0, 40.0));
    let id = Id::unique("opening");
    let area = Area::new(id).kind(egui::UiKind::Modal).order(egui::Order::Foreground);
    let area = area.anchor(Align2::CENTER_CENTER, place.center() - screen.center()).interactable(true);
    let modal = Modal::new(id).area(area).backdrop_color(ui.visuals().extreme_bg_color.gamma_multiply(0.3));
    let modal = modal.show(ui.ctx(), |ui| {
        ui.set_width(size.x);
        contents(ui, size.y, shown)
    });
    let request = modal.inner.clone();
    let is_done = matches!(request, Some(Request::Open(_)));
    if is_done || modal.should_close() {
        *opening = None;
    }
    let asked = opening.as_mut().filter(|opening| opening.asked.as_ref() != Some(&opening.typed)).map(|opening| {
        opening.asked = Some(opening.typed.clone());
        Request::List(opening.typed.clone())
    });
    request.or(asked)
}

fn contents(ui: &mut Ui, height: f32, opening: &mut Opening) -> Option<Request> {
    ui.heading("Open a scene");
    let mut request = path(ui, opening);
    ui.add_space(2.0);
    let is_recent = opening.listing.typed.trim().is_empty();
    ui.weak(if is_recent { "opened before" } else { "in this folder" });
    ScrollArea::vertical().max_height(height).min_scrolled_height(height).auto_shrink(false).show(ui, |ui| {
        let listing = std::mem::take(&mut opening.listing);
        for (index, entry) in listing.entries.iter().enumerate() {
            let is_chosen = opening.chosen == Some(index);
            if is_chosen && std::mem::take(&mut opening.is_moved) {
                ui.scroll_to_cursor(None);
            }
            if row(ui, entry, is_chosen, is_recent) {
                request = opening.enter(entry);
            }
        }
        opening.listing = listing;
        if opening.listing.entries.is_empty() && opening.asked.is_some() {
            ui.weak(if is_recent { "none yet" } else { "nothing here begins so" });
        }
    });
    ui.separator();
    ui.horizontal(|ui| {
        let why_not = opening.typed.trim().is_empty().then_some("Type a path first, or take one of the list.");
        if button(ui, About::unless("Opens the file of this path (Enter).", why_not), Button::new("Open")) {
            request = opening.accept();
        }
        if button(ui, "Leaves the scene that is shown (Esc).", Button::new("Cancel")) {
            ui.close();
        }
    });
    request
}

/// The text field; it has the focus at first, and after a folder has been entered.
fn path(ui: &mut Ui, opening: &mut Opening) -> Option<Request> {
    let id = Id::unique("path to open");
    let has_focus = ui.memory(|memory| memory.has_focus(id));
    if has_focus {
        let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        for (key, is_down) in [(Key::ArrowDown, true), (Key::ArrowUp, false)] {
            if pressed(key) {
                opening.choose(is_down);
            }
        }
    }
    let field = TextEdit::singleline(&mut opening.typed).id(id).desired_width(f32::INFINITY);
    let mut field = field.hint_text("path of a .glb, a .gltf, or a state").show(ui);
    let about =
        "The path of a file to open: from the current folder, from / or from ~. Up and Down choose from the list.";
    let response = field.response.response.on_hover_text(about);
    let is_first = opening.asked.is_none();
    if response.changed() {
        opening.chosen = None;
    }
    let mut request = None;
    if response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)) {
        request = opening.accept();
        // What opens nothing is typed on.
        opening.is_entered |= request.is_none();
    }
    if std::mem::take(&mut opening.is_entered) || is_first {
        response.request_focus();
        let end = CCursor::new(opening.typed.chars().count());
        field.state.cursor.set_char_range(Some(CCursorRange::one(end)));
        field.state.store(ui.ctx(), id);
    }
    request
}

/// An entry of the list; whether it has been clicked.
fn row(ui: &mut Ui, entry: &Entry, is_chosen: bool, is_recent: bool) -> bool {
    let part = |name: Option<&std::ffi::OsStr>| native::one_line(&name.unwrap_or_default().to_string_lossy());
    let name = part(entry.path.file_name()) + if entry.is_folder { "/" } else { "" };
    let folder =
        if is_recent { part(entry.path.parent().and_then(|folder| folder.file_name())) } else { String::new() };
    let row = Button::selectable(is_chosen, short(&name, NAME_SHOWN));
    let row =
        row.right_text(RichText::new(short(&folder, FOLDER_SHOWN)).weak()).min_size(vec2(ui.available_width(), 0.0));
    let path = native::one_line(&entry.path.display().to_string());
    let gone = format!("{path}\nThis file is not there any more.");
    button(ui, About::unless(&path, (!entry.is_there).then_some(gone.as_str())), row)
}
