//! What keys and mouse do, in one table: dispatch goes by it, and the list that ? opens shows it.

use std::collections::HashSet;
use std::f32::consts::FRAC_PI_2;

use egui::{Align2, Context, Event, Id, Key, ModifierNames, Modifiers, PointerButton, vec2};

use super::commands::Command;
use super::grab::Tool;

/// What the user does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Input {
    /// Presses a key, with these modifiers and no others.
    Press(Modifiers, Key),
    /// The same while no control has the focus, which such a key would change.
    Unfocused(Key),
    /// Holds a key down together with the right button: the one in the place that this key has on a US keyboard, whatever is
    /// written on it.
    Held(Key),
    /// Drags in the picture with at least these modifiers.
    Drag(Modifiers, PointerButton),
    /// Drags in the picture while this key is held, by its place as above.
    DragWith(Key),
    /// Turns the wheel or pinches over the picture.
    Wheel,
    Click,
    DoubleClick,
}

/// A line of the table.
#[derive(Debug)]
pub struct Row {
    pub input: Input,
    pub command: Command,
    /// What the command does, in the user's words.
    pub what: &'static str,
}

const fn row(input: Input, command: Command, what: &'static str) -> Row {
    Row { input, command, what }
}

const fn press(key: Key) -> Input {
    Input::Press(Modifiers::NONE, key)
}

const COMMAND_SHIFT: Modifiers = Modifiers { shift: true, ..Modifiers::COMMAND };
/// An arrow turns by 5 degrees: in view heights, of which one is half a turn.
const ARROW: f32 = 5.0 / 180.0;

const FLY: &str = "fly ahead, and look around; with Shift faster\n(keys by place: Z, Q, S, D on AZERTY)";

/// All of it.
pub const ROWS: &[Row] = &[
    row(Input::Drag(Modifiers::NONE, PointerButton::Primary), Command::Turn, "turn"),
    row(Input::Drag(Modifiers::SHIFT, PointerButton::Primary), Command::Pan, "pan"),
    row(Input::Drag(Modifiers::NONE, PointerButton::Middle), Command::Pan, "pan"),
    row(Input::Drag(Modifiers::NONE, PointerButton::Secondary), Command::Pan, "pan"),
    row(Input::Wheel, Command::Zoom, "zoom to the pointer"),
    row(Input::Drag(Modifiers::COMMAND, PointerButton::Middle), Command::Zoom, "zoom to the pointer"),
    row(Input::Drag(Modifiers::ALT, PointerButton::Secondary), Command::Zoom, "zoom to the pointer"),
    row(Input::Click, Command::Pick, "show the material in the panel"),
    row(Input::DoubleClick, Command::Centre, "centre on what is there"),
    row(press(Key::F), Command::Frame, "frame what was clicked, or all but the backdrop"),
    row(press(Key::Num1), Command::LookFrom([0.0, 0.0]), "from the front"),
    row(press(Key::Num3), Command::LookFrom([FRAC_PI_2, 0.0]), "from the side"),
    row(press(Key::Num7), Command::LookFrom([0.0, FRAC_PI_2]), "from above"),
    row(press(Key::Home), Command::Home, "the view as it was loaded"),
    row(Input::Unfocused(Key::ArrowLeft), Command::TurnBy([-ARROW, 0.0]), "turn"),
    row(Input::Unfocused(Key::ArrowRight), Command::TurnBy([ARROW, 0.0]), "turn"),
    row(Input::Unfocused(Key::ArrowUp), Command::TurnBy([0.0, -ARROW]), "turn"),
    row(Input::Unfocused(Key::ArrowDown), Command::TurnBy([0.0, ARROW]), "turn"),
    row(Input::Held(Key::W), Command::Fly([0.0, 0.0, 1.0]), FLY),
    row(Input::Held(Key::S), Command::Fly([0.0, 0.0, -1.0]), "fly back"),
    row(Input::Held(Key::A), Command::Fly([-1.0, 0.0, 0.0]), "fly left"),
    row(Input::Held(Key::D), Command::Fly([1.0, 0.0, 0.0]), "fly right"),
    row(Input::Held(Key::E), Command::Fly([0.0, 1.0, 0.0]), "fly up"),
    row(Input::Held(Key::Q), Command::Fly([0.0, -1.0, 0.0]), "fly down"),
    row(press(Key::G), Command::Grab(Tool::Move), "move the chosen light;\nthen X, Y, Z for an axis, or a number"),
    row(press(Key::R), Command::Grab(Tool::Turn), "turn it"),
    row(press(Key::S), Command::Grab(Tool::Scale), "scale it"),
    row(Input::DragWith(Key::L), Command::Aim, "put its reflection below the pointer"),
    row(Input::Press(Modifiers::SHIFT, Key::D), Command::DuplicateLight, "copy it, and move the copy"),
    row(press(Key::Delete), Command::DeleteLight, "delete it"),
    row(Input::Press(Modifiers::COMMAND, Key::Z), Command::Undo, "undo; the view stays"),
    row(Input::Press(COMMAND_SHIFT, Key::Z), Command::Redo, "redo"),
    row(Input::Press(Modifiers::COMMAND, Key::Y), Command::Redo, "redo"),
    row(Input::Press(Modifiers::COMMAND, Key::O), Command::Open, "open a scene"),
    row(Input::Press(Modifiers::COMMAND, Key::R), Command::Reload, "load the scene's file again"),
    row(Input::Press(Modifiers::COMMAND, Key::S), Command::SaveState, "save the state"),
    row(press(Key::P), Command::SavePicture, "save the picture, as the last one was saved"),
    row(Input::Press(COMMAND_SHIFT, Key::S), Command::SavePictureAs, "save the picture in another size or place"),
    row(Input::Press(COMMAND_SHIFT, Key::C), Command::CopyPicture, "copy the command that makes the picture"),
    row(press(Key::H), Command::Panel, "hide or show the panel"),
    row(press(Key::F11), Command::Fullscreen, "all of the screen"),
    row(press(Key::Questionmark), Command::Keys, "this list"),
    row(press(Key::Escape), Command::Close, "close what is open"),
];

impl Input {
    /// Whether a key that is pressed is this one.
    fn is_pressed(self, pressed: Key, modifiers: Modifiers, has_focus: bool) -> bool {
        match self {
            // On some keyboards it takes Shift, on others more.
            Self::Press(_, Key::Questionmark) => pressed == Key::Questionmark,
            Self::Press(wanted, key) => pressed == key && modifiers.matches_exact(wanted),
            Self::Unfocused(key) => pressed == key && modifiers.is_none() && !has_focus,
            Self::Held(_) | Self::Drag(..) | Self::DragWith(_) | Self::Wheel | Self::Click | Self::DoubleClick => false,
        }
    }

    /// In the user's words.
    pub fn text(self, is_mac: bool) -> String {
        let names = &ModifierNames::NAMES;
        let with = |modifiers: Modifiers, button: &str| match names.format(&modifiers, is_mac) {
            held if held.is_empty() => button.to_owned(),
            held => format!("{held}+{button}"),
        };
        match self {
            Self::Press(_, Key::Questionmark) => "?".to_owned(),
            Self::Press(modifiers, key) => with(modifiers, key.name()),
            Self::Unfocused(key) => key.name().to_owned(),
            Self::Held(key) => format!("right button+{}", key.name()),
            Self::Drag(modifiers, PointerButton::Primary) => with(modifiers, "drag"),
            Self::Drag(modifiers, PointerButton::Middle) => with(modifiers, "middle drag"),
            Self::Drag(modifiers, _) => with(modifiers, "right drag"),
            Self::DragWith(key) => format!("{}+drag", key.name()),
            Self::Wheel => "wheel, pinch".to_owned(),
            Self::Click => "click".to_owned(),
            Self::DoubleClick => "double-click".to_owned(),
        }
    }
}

/// The commands of the keys that have been pressed; none while a text is typed.
pub fn pressed(context: &Context) -> Vec<Command> {
    if context.text_edit_focused() {
        return Vec::new();
    }
    let has_focus = context.memory(|memory| memory.focused().is_some());
    let command = |event: &Event| match *event {
        Event::Key { key, pressed: true, repeat, modifiers, .. } => {
            let row = ROWS.iter().find(|row| row.input.is_pressed(key, modifiers, has_focus))?;
            (!repeat || row.command.repeats()).then_some(row.command)
        }
        _ => None,
    };
    context.input(|input| input.events.iter().filter_map(command).collect())
}

/// Brings the places of the keys that are held to where this pass's events leave them: egui itself keeps what is written on
/// them.
pub fn follow_held(context: &Context, held: &mut HashSet<Key>) {
    context.input(|input| {
        for event in &input.events {
            match *event {
                Event::Key { key, physical_key, pressed: true, .. } => _ = held.insert(physical_key.unwrap_or(key)),
                Event::Key { key, physical_key, pressed: false, .. } => _ = held.remove(&physical_key.unwrap_or(key)),
                // Nobody tells of what is released in another window.
                Event::WindowFocused(false) => held.clear(),
                _ => {}
            }
        }
    });
}

/// Where the keys that are held say to fly; none where they say nothing. With a modifier other than Shift they mean
/// something else.
pub fn flight(context: &Context, held: &HashSet<Key>) -> Option<[f32; 3]> {
    if context.text_edit_focused() || context.input(|input| input.modifiers.command) {
        return None;
    }
    let step = |row: &Row| match (row.input, row.command) {
        (Input::Held(key), Command::Fly(step)) => held.contains(&key).then_some(step),
        _ => None,
    };
    let add = |sum: [f32; 3], step: [f32; 3]| std::array::from_fn(|axis| sum[axis] + step[axis]);
    ROWS.iter().filter_map(step).reduce(add)
}

/// What dragging with a button does: of the rows whose modifiers are held, the one with most.
pub fn drag(button: PointerButton, held: Modifiers) -> Option<Command> {
    let count = |modifiers: Modifiers| {
        [modifiers.alt, modifiers.shift, modifiers.command].map(usize::from).iter().sum::<usize>()
    };
    let rows = ROWS.iter().filter_map(|row| match row.input {
        Input::Drag(wanted, of) if of == button && held.contains(wanted) => Some((count(wanted), row.command)),
        _ => None,
    });
    rows.max_by_key(|(count, _)| *count).map(|(_, command)| command)
}

/// The list over the picture; whether it stays open.
pub fn show(context: &Context) -> bool {
    let mut is_open = true;
    let is_mac = context.os().is_mac();
    let room = context.content_rect().size() - vec2(24.0, 60.0);
    egui::Window::new("Keys and mouse")
        .id(Id::unique("keys"))
        .open(&mut is_open)
        .anchor(Align2::CENTER_CENTER, [0.0; 2])
        .auto_sized()
        .collapsible(false)
        .show(context, |ui| {
            egui::ScrollArea::vertical().max_height(room.y.max(60.0)).show(ui, |ui| {
                egui::Grid::new("keys").num_columns(2).striped(true).show(ui, |ui| {
                    for rows in ROWS.chunk_by(|row, next| row.what == next.what) {
                        let inputs: Vec<String> = rows.iter().map(|row| row.input.text(is_mac)).collect();
                        ui.strong(inputs.join("\n"));
                        ui.label(rows[0].what);
                        ui.end_row();
                    }
                });
            });
        });
    is_open
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_does_two_things() {
        for (index, row) in ROWS.iter().enumerate() {
            for other in &ROWS[..index] {
                assert_ne!(row.input, other.input, "{} and {}", row.what, other.what);
                assert_ne!(row.input.text(false), other.input.text(false));
            }
        }
        let texts: Vec<String> = ROWS.iter().map(|row| row.input.text(false)).collect();
        for text in ["Ctrl+Shift+Z", "Shift+drag", "Ctrl+middle drag", "F11", "?", "Left", "right button+W"] {
            assert!(texts.iter().any(|listed| listed == text), "{text}: {texts:?}");
        }
    }

    #[test]
    fn drags_go_by_the_modifiers_that_are_held() {
        use PointerButton::{Extra1, Middle, Primary, Secondary};
        for (button, held, command) in [
            (Primary, Modifiers::NONE, Some(Command::Turn)),
            (Primary, Modifiers::ALT, Some(Command::Turn)),
            (Primary, Modifiers::SHIFT, Some(Command::Pan)),
            (Middle, Modifiers::NONE, Some(Command::Pan)),
            (Middle, Modifiers::SHIFT, Some(Command::Pan)),
            (Middle, Modifiers::CTRL | Modifiers::COMMAND, Some(Command::Zoom)),
            (Secondary, Modifiers::NONE, Some(Command::Pan)),
            (Secondary, Modifiers::ALT, Some(Command::Zoom)),
            (Extra1, Modifiers::NONE, None),
        ] {
            assert_eq!(drag(button, held), command, "{button:?} with {held:?}");
        }
    }
}
