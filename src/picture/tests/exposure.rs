//! Metering by closed forms, and what is said of pictures that show next to nothing.

use super::{Blank, DisplayImage, LinearImage, metered, metered_size};

fn image(width: u32, height: u32, pixel: impl Fn(u32, u32) -> f32) -> LinearImage {
    let at = |index: u32| [pixel(index % width, index / width); 3];
    LinearImage { width, height, pixels: (0..width * height).map(at).collect() }
}

/// Half a hundredth is rounding.
fn assert_close(image: &LinearImage, expected: f64) {
    let found = f64::from(metered(image).unwrap());
    assert!((found - expected).abs() < 0.0051, "{found} is not {expected}");
}

#[test]
fn a_constant_comes_out_at_the_key() {
    for grey in [0.18_f32, 1.0, 3e-9, 1000.0, 1e28] {
        assert_close(&image(7, 5, |_, _| grey), (0.18 / f64::from(grey)).log2());
    }
    assert_close(&image(1, 1, |_, _| 0.72), -2.0);
    // The range of the flag.
    assert_eq!(metered(&image(1, 1, |_, _| 1e36)), Some(-100.0));
    // Rec. 709's luminance of a colour.
    let red = LinearImage { width: 1, height: 1, pixels: vec![[0.18 / 0.2126, 0.0, 0.0]] };
    assert_close(&red, 0.0);
}

#[test]
fn two_values_come_out_at_their_geometric_mean() {
    // In columns that mirror each other, so that both have the same weight; and the same share is cut from each.
    assert_close(&image(32, 20, |x, _| if x < 16 { 0.09 } else { 0.36 }), 0.0);
    assert_close(&image(32, 20, |x, _| if x < 16 { 2.0 } else { 8.0 }), (0.18_f64 / 4.0).log2());
}

/// With weights w and 1 - w before the cut, of twenty parts one falls off either end.
#[test]
fn the_middle_weighs_more() {
    let (width, height) = (40_u32, 30_u32);
    let is_middle = |x: u32, y: u32| (10..30).contains(&x) && (8..22).contains(&y);
    let (mut middle, mut all) = (0.0, 0.0);
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let [dx, dy] = [f64::from(x) - 19.5, f64::from(y) - 14.5];
        let weight = (-2.0 * (dx * dx + dy * dy) / (20.0 * 20.0 + 15.0 * 15.0)).exp();
        all += weight;
        middle += if is_middle(x, y) { weight } else { 0.0 };
    }
    let share = (middle / all - 0.05) / 0.9;
    assert!(share > 20.0 * 14.0 / 1200.0 + 0.1, "{share} is more than its share of the area");
    let scene = image(width, height, |x, y| if is_middle(x, y) { 4.0 } else { 1.0 });
    assert_close(&scene, 0.18_f64.log2() - 2.0 * share);
}

#[test]
fn neither_outliers_nor_black_count() {
    let grey = |x: u32, y: u32| if (x + y).is_multiple_of(2) { 0.5 } else { 0.25 };
    let plain = f64::from(metered(&image(64, 64, grey)).unwrap());
    // 2% of the pixels are a lamp, or nearly black: what is cut is of the outliers, and less of the rest.
    for odd in [1e9_f32, 1e-3] {
        let scene = image(64, 64, |x, y| if x * y % 50 == 7 { odd } else { grey(x, y) });
        let found = f64::from(metered(&scene).unwrap());
        assert!((found - plain).abs() < 0.05, "{odd}: {found} {plain}");
    }
    // Most of it is background, and what is there is lit to 0.5.
    for background in [0.0, 1e-8] {
        assert_close(&image(64, 64, |x, y| if x < 20 && y < 20 { 0.5 } else { background }), (0.36_f64).log2());
    }
    for black in [0.0, f32::NAN, -1.0] {
        assert_eq!(metered(&image(8, 8, |_, _| black)), None);
    }
}

#[test]
fn pictures_are_metered_small_and_in_their_shape() {
    assert_eq!(metered_size([1280, 720]), [256, 144]);
    assert_eq!(metered_size([16, 32]), [128, 256]);
    assert_eq!(metered_size([20_000, 1]), [256, 1]);
}

/// A picture of 1000 pixels: how many are of which colour; the rest is black.
fn shown(parts: &[(usize, [u8; 3])]) -> DisplayImage {
    let mut pixels: Vec<[u8; 3]> = parts.iter().flat_map(|&(count, code)| vec![code; count]).collect();
    pixels.resize(1000, [0, 1, 0]);
    DisplayImage { width: 100, height: 10, pixels }
}

#[test]
fn pictures_that_show_next_to_nothing_are_known() {
    let grey = [0, 100, 0];
    for (parts, expected) in [
        (&[][..], Some(Blank::Black)),
        (&[(10, grey)], Some(Blank::Black)),
        (&[(11, grey)], None),
        (&[(10, [255; 3])], Some(Blank::Black)),
        (&[(11, [255; 3])], Some(Blank::White)),
        (&[(1000, [252, 254, 255])], Some(Blank::White)),
        (&[(500, [255; 3]), (100, [90, 0, 252])], Some(Blank::White)),
        (&[(540, [255; 3]), (60, grey)], Some(Blank::White)),
        (&[(539, [255; 3]), (61, grey)], None),
        (&[(1000, [251; 3])], None),
        (&[(1000, [2, 1, 1])], None),
    ] {
        assert_eq!(Blank::of(&shown(parts)), expected, "{parts:?}");
    }
}

#[test]
fn advice_names_what_helps_and_is_silent_where_nothing_does() {
    let advice = |blank: Blank, exposure, metered| blank.advice(exposure, metered).unwrap_or_default();
    assert_eq!(
        advice(Blank::White, 0.0, Some(-9.46)),
        "nearly all of the picture is past white: try --exposure -9.5 or --exposure auto"
    );
    assert_eq!(
        advice(Blank::Black, -2.0, Some(4.0)),
        "nearly all of the picture is black: try --exposure 4.0 or --exposure auto"
    );
    assert!(advice(Blank::Black, 0.0, None).contains("at any exposure"));
    for (blank, exposure, metered) in [
        (Blank::White, 0.0, Some(-2.9)),
        (Blank::White, 0.0, None),
        (Blank::Black, 1.0, Some(3.9)),
        (Blank::Black, 9.0, Some(1.0)),
    ] {
        assert_eq!(advice(blank, exposure, metered), "", "{blank:?} {exposure} {metered:?}");
    }
}
