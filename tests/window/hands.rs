//! What hands do in the picture, and what keys do.

use std::f64::consts::FRAC_PI_2;

use super::alone;
use super::desk::{Desk, State, keys};
use super::places::{CLOTH, MATERIAL, ON_CLOTH, ON_FLOOR, PANEL, PICTURE, SIZE, around};
use super::shot::Shot;

#[test]
fn hands_and_keys_in_the_picture() {
    let _alone = alone();
    let mut desk = Desk::without_shadows(SIZE);
    let first = desk.settle();
    let loaded = desk.state();
    assert!(!loaded.has_view());
    desk.settle();
    turning(&mut desk);
    zooming(&mut desk);
    views(&mut desk);
    home(&mut desk, &first);
    picking(&mut desk);
    centring(&mut desk);
    hiding(&mut desk);
    listing(&mut desk);
    saving(&mut desk);
    // None of it is a change that could be taken back, and undoing leaves the view.
    assert_eq!(desk.state().0, loaded.0);
    desk.close();
}

/// Drags turn and pan. Undoing leaves the view as it is.
fn turning(desk: &mut Desk) {
    let [before, after] = [(); 2].map(|()| {
        desk.drag(1, ON_CLOTH, [580, 340]);
        desk.state()
    });
    // To the right and down: what is in front goes along.
    let turned = ["azimuth", "elevation"].map(|name| after.number(name) - before.number(name));
    assert!(turned[0] < -0.3 && turned[1] > 0.1, "{turned:?}");
    for button in [2, 3] {
        let before = desk.state();
        desk.drag(button, ON_CLOTH, [580, 340]);
        let after = desk.state();
        assert_ne!(before.numbers("target"), after.numbers("target"), "button {button}");
        assert_eq!(before.get("azimuth"), after.get("azimuth"));
    }
    let view = desk.state();
    desk.undo("nothing", |state| state.0 == view.0);
}

/// Where the eye is, metres.
fn eye(state: &State) -> [f64; 3] {
    let (target, distance) = (state.numbers("target"), state.number("distance"));
    let (azimuth, elevation) = (state.number("azimuth"), state.number("elevation"));
    let away = [elevation.cos() * azimuth.sin(), elevation.sin(), elevation.cos() * azimuth.cos()];
    std::array::from_fn(|axis| target[axis] + distance * away[axis])
}

/// The direction in which a place of the picture is seen, not normalised.
fn seen(state: &State, [x, y]: [i16; 2]) -> [f64; 3] {
    let (azimuth, elevation) = (state.number("azimuth"), state.number("elevation"));
    let half = (0.5 * state.number("yfov")).tan();
    let [width, height] = [PICTURE[1], PICTURE[3]].map(|side| side as f64);
    let right = half * (2.0 * f64::from(x) - width) / height;
    let up = half * (1.0 - 2.0 * f64::from(y) / height);
    let away = [elevation.cos() * azimuth.sin(), elevation.sin(), elevation.cos() * azimuth.cos()];
    let x_axis = [azimuth.cos(), 0.0, -azimuth.sin()];
    let y_axis = [-elevation.sin() * azimuth.sin(), elevation.cos(), -elevation.sin() * azimuth.cos()];
    std::array::from_fn(|axis| right * x_axis[axis] + up * y_axis[axis] - away[axis])
}

/// The wheel moves the eye along the ray through the pointer: what is there stays there.
fn zooming(desk: &mut Desk) {
    let at = [400, 200];
    desk.move_to(at);
    let before = desk.state();
    desk.wheel(true);
    // It glides.
    desk.settle();
    let after = desk.state();
    let (from, to, ray) = (eye(&before), eye(&after), seen(&before, at));
    let gone: [f64; 3] = std::array::from_fn(|axis| to[axis] - from[axis]);
    let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|axis| a[axis] * b[axis]).sum::<f64>();
    let cosine = dot(gone, ray) / (dot(gone, gone) * dot(ray, ray)).sqrt();
    // A pixel is 1/1500 here, and states are written in 32 bits.
    assert!(cosine > 1.0 - 1e-5, "{cosine}: {gone:?} along {ray:?}");
    assert!(dot(gone, gone).sqrt() > 0.05 * before.number("distance"), "{gone:?}");
}

/// Keys look from three sides, and frame what there is.
fn views(desk: &mut Desk) {
    for (key, azimuth, elevation) in [('1', 0.0, 0.0), ('3', FRAC_PI_2, 0.0), ('7', 0.0, FRAC_PI_2)] {
        desk.chord(&[], u32::from(key));
        let state = desk.state();
        for (name, expected) in [("azimuth", azimuth), ("elevation", elevation)] {
            let found = state.number(name);
            assert!((found - expected).abs() < 0.01, "{key}: {name} {found}");
        }
    }
    let before = desk.state();
    desk.chord(&[], u32::from('f'));
    let framed = desk.state();
    assert_ne!(before.numbers("target"), framed.numbers("target"));
    assert_eq!(before.get("elevation"), framed.get("elevation"));
}

/// Home brings back the view, and with it the picture.
fn home(desk: &mut Desk, first: &Shot) {
    let before = desk.settle();
    assert!(first.differs(&before, PICTURE, 8) > 0.3);
    desk.chord(&[], keys::HOME);
    let back = desk.settle();
    assert!(!desk.state().has_view());
    // With more samples, or fewer.
    assert!(first.differs(&back, PICTURE, 8) < 0.01, "{}", first.differs(&back, PICTURE, 8));
}

/// A click shows a thing's material, and its outline for a moment.
fn picking(desk: &mut Desk) {
    let before = desk.settle();
    desk.click(ON_FLOOR);
    let edge = around([875, 633], 25);
    let outlined = desk.until_shown("outline", |shot| !shot.shows(&before, edge));
    assert!(outlined.differs(&before, PICTURE, 30) > 1e-4);
    desk.until_shown("picture without it", |shot| shot.shows(&before, PICTURE));
    let floor = desk.settle();
    assert!(!floor.shows(&before, MATERIAL), "it is the material of another thing");
    desk.click(ON_CLOTH);
    desk.until_shown("first material", |shot| shot.shows(&before, MATERIAL));
    let back = desk.settle();
    assert!(back.shows(&before, PICTURE));
}

/// A double click brings what is there into the middle; Home takes it back.
fn centring(desk: &mut Desk) {
    desk.click(ON_CLOTH);
    desk.click(ON_CLOTH);
    let centred = desk.until_state("view that is centred", State::has_view);
    // Its eye still looks along the same direction.
    assert!(centred.number("distance") > 0.0);
    desk.chord(&[], keys::HOME);
    desk.until_state("view as loaded", |state| !state.has_view());
}

/// H gives the picture all of the window.
fn hiding(desk: &mut Desk) {
    let before = desk.settle();
    desk.chord(&[], u32::from('h'));
    let wide = desk.settle();
    assert!(wide.differs(&before, PANEL, 8) > 0.9, "{}", wide.differs(&before, PANEL, 8));
    desk.chord(&[], u32::from('h'));
    let back = desk.settle();
    assert!(back.shows(&before, PANEL));
    assert!(back.differs(&before, PICTURE, 8) < 0.01);
}

/// ? lists the keys, Esc closes the list.
fn listing(desk: &mut Desk) {
    let before = desk.settle();
    desk.chord(&[], u32::from('?'));
    let listed = desk.until_shown("list", |shot| shot.differs(&before, CLOTH, 8) > 0.3);
    assert!(listed.sharpness(CLOTH) > 1.5 * before.sharpness(CLOTH), "no text");
    desk.chord(&[], keys::ESCAPE);
    desk.until_shown("picture without it", |shot| shot.shows(&before, PICTURE));
}

/// P saves the picture, in the picture's size.
fn saving(desk: &mut Desk) {
    let shown = desk.settle();
    desk.chord(&[], u32::from('p'));
    let path = desk.written("velour-001.png");
    let saved = image::open(path).unwrap().into_rgb8();
    assert_eq!(saved.dimensions(), (980, 720));
    let pixels = saved.pixels().map(|pixel| pixel.0).collect();
    let saved = Shot::new(980, pixels);
    // It has samples of its own, and edges as smooth as can be.
    assert!(saved.differs(&shown, PICTURE, 16) < 0.05, "{}", saved.differs(&shown, PICTURE, 16));
    desk.settle();
}
