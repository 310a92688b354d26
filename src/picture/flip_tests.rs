use super::*;
use crate::picture::LinearImage;

fn flip(test: &Picture, reference: &Picture) -> FlipMap {
    FlipMap::between(test, reference, &|_, _| {})
}

fn uniform(color: [u8; 3]) -> Picture {
    (&DisplayImage { width: 8, height: 6, pixels: vec![color; 48] }).into()
}

fn linear([width, height]: [u32; 2], radiance: impl Fn(u32, u32) -> [f64; 3]) -> Picture {
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let pixels = pixels.map(|(x, y)| radiance(x, y).map(|channel| channel as f32)).collect();
    LinearImage { width, height, pixels }.into()
}

/// Ten stops of texture, and a disk.
fn textured() -> Picture {
    linear([60, 40], |x, y| {
        let [x, y] = [x, y].map(f64::from);
        let base = ((x - 30.0) / 6.0).exp2() * (1.0 + 0.5 * (y * 0.7).sin()) + 0.01;
        let disk = if (x - 40.0).powi(2) + (y - 18.0).powi(2) < 64.0 { 4.0 } else { 0.0 };
        [base + disk, base * 0.6 + disk * 0.2, base * 0.3]
    })
}

fn changed(picture: &Picture, change: impl Fn(usize, [f32; 3]) -> [f32; 3]) -> Picture {
    let pixels = picture.pixels.iter().enumerate().map(|(index, pixel)| change(index, *pixel)).collect();
    Picture { pixels, ..picture.clone() }
}

/// The pixel on the left in each pixel's place; in the first column the one at the row's other end.
fn shifted(picture: &Picture) -> Picture {
    let width = picture.width as usize;
    changed(picture, |index, _| picture.pixels[if index % width == 0 { index + width - 1 } else { index - 1 }])
}

/// The Hunt-adjusted colour (Andersson et al. 2020, section 4.1) of an sRGB colour, in `f64` by the textbook: Rec.
/// 709's primaries, CIELAB of 1976.
fn hunt([red, green, blue]: [u8; 3]) -> [f64; 3] {
    let linear = |byte: u8| {
        let shown = f64::from(byte) / 255.0;
        if shown <= 0.04045 { shown / 12.92 } else { ((shown + 0.055) / 1.055).powf(2.4) }
    };
    let [red, green, blue] = [red, green, blue].map(linear);
    let x = (0.4124 * red + 0.3576 * green + 0.1805 * blue) / 0.9505;
    let y = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
    let z = (0.0193 * red + 0.1192 * green + 0.9505 * blue) / 1.089;
    let root = |t: f64| if t > (6.0_f64 / 29.0).powi(3) { t.cbrt() } else { t * 841.0 / 108.0 + 4.0 / 29.0 };
    let lightness = 116.0 * root(y) - 16.0;
    [lightness, 5.0 * lightness * (root(x) - root(y)), 2.0 * lightness * (root(y) - root(z))]
}

/// FLIP of one uniform colour against another: no filter changes them, there are no features, and what is left is their
/// HyAB distance to the power of 0.7 over that of green and blue, by the two lines through (0.4, 0.95) (section 4.1).
fn flip_of_colors(left: [u8; 3], right: [u8; 3]) -> f64 {
    let distance = |left, right| {
        let [left, right] = [hunt(left), hunt(right)];
        ((left[0] - right[0]).abs() + (left[1] - right[1]).hypot(left[2] - right[2])).powf(0.7)
    };
    let share = distance(left, right) / distance([0, 255, 0], [0, 0, 255]);
    if share < 0.4 { share * 0.95 / 0.4 } else { 0.95 + (share - 0.4) / 0.6 * 0.05 }
}

/// 5e-4: the textbook's matrices have four digits.
#[test]
fn uniform_colors_differ_as_the_formula_says() {
    let [black, white] = [[0; 3], [255; 3]];
    for (test, reference, value) in [
        (black, white, Some(0.967_388)),
        (white, black, Some(0.967_388)),
        ([255, 0, 0], [0, 255, 0], Some(0.986_665)),
        ([0, 255, 0], [0, 0, 255], Some(1.0)),
        ([129; 3], [128; 3], Some(0.029_863)),
        ([190, 120, 50], [200, 100, 50], Some(0.307_517)),
        ([12, 200, 99], [11, 190, 150], None),
    ] {
        let map = flip(&uniform(test), &uniform(reference));
        let formula = flip_of_colors(test, reference);
        assert!((map.mean() - formula).abs() < 5e-4, "{test:?} {reference:?}: {} {formula}", map.mean());
        // By NVIDIA's program, version 1.7; measured: within 3.3e-5.
        assert!(value.is_none_or(|value| (map.mean() - value).abs() < 1e-4), "{test:?} {reference:?}: {}", map.mean());
        assert!(map.errors.iter().all(|error| (error - map.greatest()).abs() < 1e-6));
        assert_eq!(map.exposures, None);
    }
}

/// Means of the same pictures by NVIDIA's program (flip-evaluator 1.7), which keeps what is here rounded to 8 bits: the
/// greatest over exposures of a small difference comes out greater by up to 0.0021.
#[test]
fn hdr_flip_is_that_of_the_published_program() {
    let reference = textured();
    let noisy = |index: usize, channel: usize, value: f32| {
        (f64::from(value) * (1.0 + 0.1 * ((3 * index + channel) as f64 * 1.7).sin())) as f32
    };
    for (name, test, mean) in [
        ("bias of 1%", changed(&reference, |_, pixel| pixel.map(|channel| channel * 1.01)), 0.029_306),
        ("shift by a pixel", shifted(&reference), 0.233_999),
        ("channels swapped", changed(&reference, |_, [red, green, blue]| [blue, green, red]), 0.723_786),
        ("noise", changed(&reference, |i, [r, g, b]| [noisy(i, 0, r), noisy(i, 1, g), noisy(i, 2, b)]), 0.022_919),
        ("black", changed(&reference, |_, _| [0.0; 3]), 0.966_148),
    ] {
        let map = flip(&test, &reference);
        assert!((map.mean() - mean).abs() < 3e-3, "{name}: {} instead of {mean}", map.mean());
        let exposures = map.exposures.unwrap();
        assert!((exposures.first + 3.740_666).abs() < 1e-4, "{exposures:?}");
        // Its median is not the mean of the two middle ones.
        assert!((exposures.last - 1.785_087).abs() < 1e-3 && exposures.count == 6, "{exposures:?}");
    }
}

#[test]
fn equal_pictures_have_none() {
    let shown: Picture = (&DisplayImage { width: 3, height: 2, pixels: vec![[7, 80, 255]; 6] }).into();
    for picture in [textured(), linear([5, 4], |_, _| [0.0; 3]), linear([1, 1], |_, _| [-1.0; 3]), shown] {
        let map = flip(&picture, &picture);
        assert_eq!((map.mean(), map.greatest()), (0.0, 0.0));
        assert_eq!(map.errors.len(), picture.pixels.len());
    }
}

/// Each strip and its halo give what the whole does, to the bit; with a halo one row thinner they don't.
#[test]
fn strips_are_as_the_whole() {
    let size = [6000, 90];
    let wild = |x: u32, y: u32| (x.wrapping_mul(2_654_435_761) ^ y.wrapping_mul(40_503).rotate_left(7)) >> 24;
    let picture = |shift: u32| -> Picture {
        let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [wild(x, y) as u8, (x / 9) as u8, y as u8]));
        let pixels = pixels.map(|[red, green, blue]| [red, green.wrapping_add(shift as u8), blue]).collect();
        (&DisplayImage { width: size[0], height: size[1], pixels }).into()
    };
    let [test, reference] = [picture(0), picture(40)];
    assert!(Strip::all(size).len() > 3);
    let whole = Strip { rows: 0..size[1], seen: 0..size[1] }.flip(&test, &reference, None);
    assert_eq!(flip(&test, &reference).errors, whole);
    let thin = Strip { rows: 30..60, seen: 30 - HALO + 1..60 + HALO - 1 }.flip(&test, &reference, None);
    assert_ne!(thin, &whole[range(size[0], &(30..60))]);
}

#[test]
fn steps_are_told() {
    let told = std::sync::Mutex::new(Vec::new());
    FlipMap::between(&textured(), &textured(), &|done, all| told.lock().unwrap().push((done, all)));
    assert_eq!(told.into_inner().unwrap(), [(1, 6), (2, 6), (3, 6), (4, 6), (5, 6), (6, 6)]);
}

#[test]
fn exposures_at_the_ends() {
    // The curve's inverse, to the digits that HDR-FLIP's program has.
    assert!((aces_inverse(0.85) - 2.118_9).abs() < 1e-3 && (aces(aces_inverse(0.85)) - 0.85).abs() < 1e-12);
    let grey = |value: f64| linear([4, 4], move |_, _| [value; 3]);
    let of = |test: &Picture, reference: &Picture| Exposures::of(test, reference);
    let one = of(&grey(0.0), &grey(1.0));
    assert_eq!((one.first, one.count), (one.last, 2));
    // A black or negative background does not count, nor does the test where the reference is lit.
    for around in [0.0, -3.0] {
        let spot = linear([4, 4], move |x, y| if (x, y) == (1, 2) { [1.0; 3] } else { [around; 3] });
        assert_eq!(of(&grey(9.0), &spot), one);
        assert_eq!(of(&spot, &grey(around)), one);
    }
    assert_eq!(of(&grey(0.0), &grey(0.0)), Exposures { first: 0.0, last: 0.0, count: 1 });
    // All of a float's range: many stops, still finite and no more than so many.
    let extremes = linear([4, 4], |x, _| [if x == 0 { f64::from(f32::MAX) } else { f64::from(f32::from_bits(1)) }; 3]);
    let exposures = of(&grey(0.0), &extremes);
    assert_eq!(exposures.stops().count(), 32);
    assert!(exposures.stops().all(f64::is_finite) && (exposures.last - exposures.first - 277.0).abs() < 0.1);
    assert!((exposures.stops().last().unwrap() - exposures.last).abs() < 1e-9);
    assert!(flip(&grey(1.0), &extremes).mean() > 0.9);
}

#[test]
fn heat_is_black_where_nothing_differs_and_bright_where_much_does() {
    let black = linear([40, 30], |_, _| [0.0; 3]);
    let half = linear([40, 30], |x, _| [f64::from(u32::from(x >= 20)); 3]);
    let heat = flip(&black, &half).heat_map();
    assert_eq!((heat.width, heat.height, heat.pixels.len()), (40, 30, 1200));
    for y in 0..30 {
        // Magma's ends (its first and near its last entry), past the reach of the filters.
        assert_eq!(heat.pixels[40 * y + 5], [0, 0, 4]);
        let [red, green, blue] = heat.pixels[40 * y + 35];
        assert!(red > 240 && green > 200 && blue > 150, "{:?}", heat.pixels[40 * y + 35]);
    }
}
