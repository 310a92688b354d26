//! What all controls of the panel have in common: they say what they are for, why they cannot be used where they cannot,
//! and go back to what was loaded.

use egui::{Id, Response, Ui};

/// What a control is for, in a sentence or two that show where the pointer rests on it; and why it cannot be used, where
/// that is so.
#[derive(Clone, Copy)]
pub struct About<'a> {
    pub text: &'a str,
    pub why_not: Option<&'a str>,
}

impl<'a> From<&'a str> for About<'a> {
    fn from(text: &'a str) -> Self {
        Self { text, why_not: None }
    }
}

impl<'a> About<'a> {
    /// Of a control that can only be used where nothing speaks against it.
    pub fn unless(text: &'a str, why_not: Option<&'a str>) -> Self {
        Self { text, why_not }
    }

    /// Shows it where the pointer rests on the control.
    pub fn on(self, response: Response, more: &str) -> Response {
        match self.why_not {
            None => response.on_hover_text(format!("{}{more}", self.text)),
            Some(why_not) => response.on_disabled_hover_text(why_not),
        }
    }
}

/// What the user has done to a control.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Touch<T> {
    Nothing,
    Set(T),
    /// Put back to the value as it was loaded.
    Reset,
}

impl<T> Touch<T> {
    /// This, or what was done to another control of the same value.
    pub fn or(self, other: Self) -> Self {
        if let Self::Nothing = self { other } else { self }
    }

    pub fn map<U>(self, of: impl FnOnce(T) -> U) -> Touch<U> {
        match self {
            Self::Nothing => Touch::Nothing,
            Self::Set(value) => Touch::Set(of(value)),
            Self::Reset => Touch::Reset,
        }
    }

    /// Does it to an edit. What is put back is no edit any more.
    pub fn apply(self, edit: &mut Option<T>) {
        match self {
            Self::Nothing => {}
            Self::Set(value) => *edit = Some(value),
            Self::Reset => *edit = None,
        }
    }

    /// The value that it makes of another; `loaded` is the one to go back to.
    pub fn value(self, before: T, loaded: T) -> T {
        match self {
            Self::Nothing => before,
            Self::Set(value) => value,
            Self::Reset => loaded,
        }
    }
}

/// What puts a control back.
#[derive(Clone, Copy, PartialEq)]
enum Gesture {
    /// A click with Ctrl (on a Mac with the command key).
    CtrlClick,
    /// That, or a double click.
    DoubleClick,
}

/// A control of a value, which Ctrl-click puts back.
pub fn control<'a, T: Clone + PartialEq>(
    ui: &mut Ui,
    about: impl Into<About<'a>>,
    value: &T,
    add: impl FnOnce(&mut Ui, &mut T) -> Response,
) -> Touch<T> {
    touch(ui, about.into(), value, Gesture::CtrlClick, add)
}

/// A control on which a double click has no other meaning, so that this puts it back, too.
pub fn double_click_control<'a, T: Clone + PartialEq>(
    ui: &mut Ui,
    about: impl Into<About<'a>>,
    value: &T,
    add: impl FnOnce(&mut Ui, &mut T) -> Response,
) -> Touch<T> {
    touch(ui, about.into(), value, Gesture::DoubleClick, add)
}

fn touch<T: Clone + PartialEq>(
    ui: &mut Ui,
    about: About,
    value: &T,
    gesture: Gesture,
    add: impl FnOnce(&mut Ui, &mut T) -> Response,
) -> Touch<T> {
    let mut after = value.clone();
    let response = ui.add_enabled_ui(about.why_not.is_none(), |ui| add(ui, &mut after)).inner;
    let response = about.on(
        response,
        match gesture {
            Gesture::CtrlClick => "\nCtrl-click: as it was loaded.",
            Gesture::DoubleClick => "\nDouble-click or Ctrl-click: as it was loaded.",
        },
    );
    let is_ctrl = ui.input(|input| input.modifiers.ctrl || input.modifiers.command);
    let is_reset = response.clicked() && is_ctrl || response.double_clicked() && gesture == Gesture::DoubleClick;
    if is_reset {
        // The click has opened what a click opens.
        response.surrender_focus();
        egui::Popup::close_all(ui.ctx());
        return Touch::Reset;
    }
    // The press that begins such a click moves sliders.
    let is_pressed_with_ctrl = is_ctrl && response.is_pointer_button_down_on();
    if after == *value || is_pressed_with_ctrl || is_ctrl && response.clicked() {
        return Touch::Nothing;
    }
    Touch::Set(after)
}

/// A button; whether it has been pressed.
pub fn button<'a>(ui: &mut Ui, about: impl Into<About<'a>>, button: egui::Button) -> bool {
    let about = about.into();
    about.on(ui.add_enabled(about.why_not.is_none(), button), "").clicked()
}

/// What was typed and cannot be taken, for the panel to say.
pub fn refuse(ui: &Ui, what: String) {
    ui.data_mut(|data| data.insert_temp(Id::unique("refused"), what));
    ui.ctx().request_repaint();
}

/// What was refused since the last call.
pub fn refused(ui: &Ui) -> Option<String> {
    ui.data_mut(|data| data.remove_temp(Id::unique("refused")))
}
