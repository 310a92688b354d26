//! What hands do in the panel.

use super::alone;
use super::desk::{Desk, State, keys};
use super::places::{
    ALPHA_BOX, ALPHA_HIGH, ALPHA_KNOB, CLOTH, MOSS, NINE_ALPHAS, PANEL, PICTURE, SIZE, SWEEP, around, tile,
};

#[test]
fn hands_in_the_panel() {
    let _alone = alone();
    let mut desk = Desk::without_shadows(SIZE);
    desk.settle();
    assert!(untouched(&desk.state()));
    sliding(&mut desk);
    typing(&mut desk);
    preset(&mut desk);
    nine_alphas(&mut desk);
    sweep(&mut desk);
    desk.click(NINE_ALPHAS);
    desk.close();
}

fn untouched(state: &State) -> bool {
    state.get("alpha").is_none() && state.get("sheen-color").is_none()
}

/// A drag of alpha's slider is one change.
fn sliding(desk: &mut Desk) {
    let before = desk.settle();
    desk.drag(1, ALPHA_KNOB, ALPHA_HIGH);
    let alpha = desk.state().number("alpha");
    assert!((alpha - 0.8).abs() < 0.05, "{alpha}");
    let after = desk.settle();
    assert!(after.brightness(CLOTH) > 1.2 * before.brightness(CLOTH), "dust is brighter");
    desk.undo("a drag", untouched);
    desk.chord(&[keys::CONTROL, keys::SHIFT], u32::from('z'));
    assert_eq!(desk.state().number("alpha"), alpha);
    desk.undo("a drag", untouched);
}

/// A sum that is typed is what alpha becomes.
fn typing(desk: &mut Desk) {
    desk.click(ALPHA_BOX);
    desk.type_text("1/3+0.2");
    desk.chord(&[], keys::ENTER);
    let alpha = desk.state().number("alpha");
    assert!((alpha - (1.0 / 3.0 + 0.2)).abs() < 1e-6, "{alpha}");
    desk.undo("what was typed", untouched);
}

/// A chip sets both layers.
fn preset(desk: &mut Desk) {
    desk.click(MOSS);
    let state = desk.state();
    for key in ["alpha", "sheen-color", "base-color"] {
        assert!(state.get(key).is_some(), "{key}:\n{}", state.0);
    }
    desk.undo("a preset", untouched);
}

/// The sheet shows nine pictures, of which a click takes one; Esc goes back without.
fn nine_alphas(desk: &mut Desk) {
    let before = desk.settle();
    desk.click(NINE_ALPHAS);
    let sheet = desk.settle();
    let brightness: Vec<f64> = (0..9).map(|index| sheet.brightness(around(tile(index), 40))).collect();
    assert!(brightness.is_sorted() && brightness[8] > 1.5 * brightness[0], "{brightness:?}");
    desk.click(tile(7));
    assert_eq!(desk.state().number("alpha"), 0.875);
    desk.undo("an alpha of the sheet", untouched);
    desk.click(NINE_ALPHAS);
    // All of it: the device has other pictures then.
    assert!(desk.settle().differs(&before, PICTURE, 8) > 0.3);
    desk.chord(&[], keys::ESCAPE);
    let back = desk.settle();
    assert!(back.differs(&before, PICTURE, 8) < 0.01, "{}", back.differs(&before, PICTURE, 8));
    assert!(untouched(&desk.state()));
}

/// The sweep moves alpha until Esc; from its beginning to its end it is one change.
fn sweep(desk: &mut Desk) {
    let before = desk.settle();
    desk.click(SWEEP);
    let first = desk.until_state("swept alpha", |state| state.get("alpha").is_some()).number("alpha");
    desk.until_state("other alpha", |state| state.number("alpha") != first);
    desk.until_shown("other picture", |shot| shot.differs(&before, CLOTH, 8) > 0.1);
    desk.chord(&[], keys::ESCAPE);
    let last = desk.state().number("alpha");
    let after = desk.settle();
    assert_eq!(desk.state().number("alpha"), last);
    assert!(!after.shows(&before, PANEL));
    desk.undo("a sweep", untouched);
}
