//! The sweep and the sheet among other things that are done: what undo, redo, Esc and each other make of them.

use super::*;
use crate::viewer::sheet::{Sheet, Tile};

const CTRL: Modifiers = Modifiers { ctrl: true, ..Modifiers::COMMAND };
const CTRL_SHIFT: Modifiers = Modifiers { shift: true, ..CTRL };

fn alpha(window: &Window) -> Option<f32> {
    window.state.edits.of_material(0).alpha
}

fn press(window: &mut Window, modifiers: Modifiers, key: Key) {
    window.modifiers = modifiers;
    window.press(key);
    window.modifiers = Modifiers::NONE;
    window.pass(vec![]);
}

fn press_button(window: &mut Window, name: &str) {
    let at = window.place(Role::Button, name).center();
    window.click(at);
    window.pass(vec![]);
}

/// Types an alpha, and sweeps it for a while.
fn swept() -> Window {
    let mut window = Window::new(scene(1.0));
    let number = window.in_row("alpha", Role::SpinButton)[0];
    window.type_into(number, "0.7");
    press_button(&mut window, "sweep alpha");
    for _ in 0..5 {
        window.wait(0.3);
    }
    assert!(window.state.sweep.is_some() && alpha(&window) != Some(0.7));
    window
}

#[test]
fn a_sweep_is_one_step() {
    for stop in [
        |window: &mut Window| press_button(window, "stop sweeping"),
        |window: &mut Window| press(window, Modifiers::NONE, Key::Escape),
    ] {
        let mut window = swept();
        stop(&mut window);
        assert!(window.state.sweep.is_none());
        let left = alpha(&window);
        press(&mut window, CTRL, Key::Z);
        assert_eq!(alpha(&window), Some(0.7));
        press(&mut window, CTRL, Key::Z);
        assert_eq!(alpha(&window), None);
        assert!(!window.state.can_undo());
        press(&mut window, CTRL_SHIFT, Key::Z);
        press(&mut window, CTRL_SHIFT, Key::Z);
        assert_eq!(alpha(&window), left);
        // It does not go on by itself.
        window.wait(1.0);
        assert_eq!((alpha(&window), window.state.can_redo()), (left, false));
    }
}

#[test]
fn undo_ends_a_sweep_and_takes_it_back() {
    for undo in [|window: &mut Window| press(window, CTRL, Key::Z), |window: &mut Window| press_button(window, "Undo")]
    {
        let mut window = swept();
        undo(&mut window);
        assert!(window.state.sweep.is_none());
        assert_eq!(alpha(&window), Some(0.7));
        window.wait(1.0);
        assert_eq!(alpha(&window), Some(0.7));
        // Where it was ended is done again.
        assert!(window.state.can_redo());
        window.state.redo();
        assert!(alpha(&window).is_some_and(|alpha| alpha != 0.7));
    }
}

/// A sweep is a new change, after which nothing is done again.
#[test]
fn redo_leaves_a_sweep_alone() {
    let mut window = Window::new(scene(1.0));
    let number = window.in_row("metallic", Role::SpinButton)[0];
    window.type_into(number, "0.7");
    press(&mut window, CTRL, Key::Z);
    press_button(&mut window, "sweep alpha");
    window.wait(0.3);
    let redo = window.place(Role::Button, "Redo").center();
    assert!(window.hover_text(redo).is_some_and(|text| text.contains("nothing to redo")));
    press(&mut window, CTRL_SHIFT, Key::Z);
    assert!(window.state.sweep.is_some());
    press(&mut window, Modifiers::NONE, Key::Escape);
    press(&mut window, CTRL_SHIFT, Key::Z);
    assert_eq!(window.state.edits.of_material(0).metallic, None);
    press(&mut window, CTRL, Key::Z);
    assert_eq!((window.state.edits.clone(), window.state.can_undo()), (Edits::default(), false));
}

#[test]
fn esc_closes_the_sheet_and_keeps_what_was_done() {
    let mut window = swept();
    press_button(&mut window, "nine alphas");
    // It shows what is there: nothing moves below it.
    assert!(window.state.sheet.is_some() && window.state.sweep.is_none());
    let number = window.in_row("metallic", Role::SpinButton)[0];
    window.type_into(number, "0.3");
    let before = window.state.edits.clone();
    assert_eq!(before.of_material(0).metallic, Some(0.3));
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.state.sheet.is_none());
    assert_eq!(window.state.edits, before);
    // Each of them can still be undone: the number, the sweep, the alpha before it.
    for expected in [Some(0.3), None, None] {
        assert_eq!(window.state.edits.of_material(0).metallic, expected);
        press(&mut window, CTRL, Key::Z);
    }
    assert_eq!((window.state.edits.clone(), window.state.can_undo()), (Edits::default(), false));
}

#[test]
fn what_is_undone_below_the_sheet_is_seen_in_it() {
    let mut window = Window::new(scene(1.0));
    for row in ["alpha", "metallic"] {
        let number = window.in_row(row, Role::SpinButton)[0];
        window.type_into(number, "0.7");
    }
    press_button(&mut window, "nine alphas");
    let drawn =
        window.context.load_texture("test", egui::ColorImage::filled([2, 2], egui::Color32::WHITE), Default::default());
    let draw = |window: &mut Window| {
        let sheet = window.state.sheet.as_mut().unwrap();
        sheet.pictures.fill(Some(Tile { texture: drawn.id(), size: sheet.size }));
    };
    let missing = |window: &Window| window.state.sheet.as_ref().unwrap().missing();
    draw(&mut window);
    press(&mut window, CTRL, Key::Z);
    // Its pictures were of another metal.
    assert_eq!((window.state.edits.of_material(0).metallic, missing(&window)), (None, Some(0)));
    draw(&mut window);
    press(&mut window, CTRL, Key::Z);
    // Alpha is what they differ in: they stay.
    assert_eq!((alpha(&window), missing(&window)), (None, None));
    // The one that is taken is a step of its own, from what is there now.
    let picture = window.layout.picture;
    window.click(picture.left_top() + picture.size() / 2.0);
    window.pass(vec![]);
    assert_eq!((alpha(&window), window.state.sheet.is_none()), (Some(Sheet::ALPHAS[4]), true));
    assert_eq!(window.state.edits.of_material(0).metallic, None);
    press(&mut window, CTRL, Key::Z);
    assert_eq!((window.state.edits.clone(), window.state.can_undo()), (Edits::default(), false));
}

#[test]
fn the_sheet_makes_way_for_a_sweep() {
    let mut window = Window::new(scene(1.0));
    press_button(&mut window, "nine alphas");
    press_button(&mut window, "sweep alpha");
    assert!(window.state.sheet.is_none() && window.state.sweep.is_some());
}

/// Pictures stand apart by a gap: what is done there is not done to what lies below, either.
#[test]
fn nothing_below_the_sheet_hears_of_the_pointer() {
    let mut window = Window::new(scene(1.0));
    press_button(&mut window, "nine alphas");
    let picture = window.layout.picture;
    let gap = picture.left_top() + picture.size() / 3.0;
    for button in [PointerButton::Primary, PointerButton::Middle, PointerButton::Secondary] {
        assert_eq!(window.drag(button, gap, gap + vec2(50.0, 90.0)), Change::None, "{button:?}");
    }
    window.click(gap);
    window.pass(vec![Event::Zoom(1.5)]);
    assert!(window.state.sheet.is_some());
    assert_eq!((window.state.edits.clone(), window.state.outlined), (Edits::default(), None));
}

/// The sheet's picture of this alpha; the panel has pictures, too.
fn cell(window: &Window, alpha: f32) -> &Node {
    let name = format!("alpha {alpha}");
    let named = window.nodes.iter().filter(|node| node.role() == Role::Button && node.label() == Some(&name));
    let is_over_picture = |node: &&Node| place(node).is_some_and(|at| window.layout.picture.contains_rect(at));
    named.into_iter().find(is_over_picture).unwrap()
}

fn marked(window: &Window) -> Vec<f32> {
    let is_marked = |alpha: &f32| cell(window, *alpha).toggled() == Some(egui::accesskit::Toggled::True);
    Sheet::ALPHAS.into_iter().filter(is_marked).collect()
}

#[test]
fn the_picture_nearest_to_the_alpha_in_force_is_marked() {
    // As the file has it, 0.3, and as it is set.
    for (set, nearest) in [(None, 0.25), (Some(0.5), 0.5), (Some(0.98), 1.0), (Some(0.06), 0.0)] {
        let mut window = Window::new(scene(1.0));
        window.state.edits.materials.entry(0).or_default().alpha = set;
        press_button(&mut window, "nine alphas");
        assert_eq!(marked(&window), [nearest], "{set:?}");
        let mut says = |alpha: f32| {
            let at = place(cell(&window, alpha)).unwrap().center();
            window.hover_text(at).unwrap()
        };
        let (text, other) = (says(nearest), says(0.75));
        let is_told = match set {
            Some(0.5) => text.contains("is the alpha now"),
            set => {
                text.contains(&format!("now, {}.", set.unwrap_or(0.3))) && text.contains(&format!("alpha {nearest}"))
            }
        };
        assert!(is_told, "{text}");
        assert!(other.contains("take alpha 0.75") && !other.contains("now"), "{other}");
    }
    // What the panel does meanwhile moves the mark.
    let mut window = Window::new(scene(1.0));
    press_button(&mut window, "nine alphas");
    let number = window.in_row("alpha", Role::SpinButton)[0];
    window.type_into(number, "0.7");
    window.pass(vec![]);
    assert_eq!(marked(&window), [0.75]);
    // A material without a sheen has no alpha.
    let switch = window.place(Role::CheckBox, "has a sheen").center();
    window.click(switch);
    window.pass(vec![]);
    assert_eq!(marked(&window), [0.0; 0]);
}

/// The old ones are shown until the new ones are there.
#[test]
fn pictures_are_drawn_anew_where_the_window_changes_its_size() {
    let mut window = Window::new(scene(1.0));
    press_button(&mut window, "nine alphas");
    let sheet = |window: &Window| window.state.sheet.as_ref().map(|sheet| (sheet.size, sheet.pictures)).unwrap();
    let size = sheet(&window).0;
    // A third of the picture, but for gaps and a caption.
    let third = window.layout.picture.size() / 3.0;
    assert!((third.x - 8.0 - size[0] as f32).abs() < 1.0 && (third.y - 28.0 - size[1] as f32).abs() < 1.0, "{size:?}");
    let drawn = Tile { texture: egui::TextureId::User(7), size };
    window.state.sheet.as_mut().unwrap().pictures.fill(Some(drawn));
    window.pass(vec![]);
    assert_eq!(window.state.sheet.as_ref().unwrap().missing(), None);
    window.size -= vec2(200.0, 300.0);
    window.rest(2);
    let missing: Vec<usize> = std::iter::from_fn(|| {
        let sheet = window.state.sheet.as_mut().unwrap();
        let index = sheet.missing()?;
        assert_eq!(sheet.pictures[index], Some(drawn));
        assert!(sheet.size[0] < size[0] && sheet.size[1] < size[1]);
        sheet.pictures[index] = Some(Tile { size: sheet.size, ..drawn });
        Some(index)
    })
    .collect();
    assert_eq!(missing, (0..9).collect::<Vec<_>>());
}
