use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use nv_flip::{DEFAULT_PIXELS_PER_DEGREE, FlipImageFloat, FlipImageRgb8};
use rayon::prelude::*;

use super::{DisplayImage, Format, Picture, srgb_from_linear};

/// Rows above and below a pixel on which its FLIP depends: the radius of the widest filter at
/// [`DEFAULT_PIXELS_PER_DEGREE`].
const HALO: u32 = 10;
/// Pixels that are worked on at a time, which limits the memory: each takes about 150 bytes.
const STRIP_PIXELS: u32 = 1 << 17;
/// The least rows of a strip: in a thinner one, the halo would cost more than the strip itself.
const STRIP_ROWS: u32 = 20;
/// The most exposures of HDR-FLIP: over more stops than this, they are taken farther apart.
const MOST_EXPOSURES: u32 = 32;

/// FLIP of each pixel: the difference that a person sees who flips between test and reference, from 0, none, to 1, the
/// greatest (Andersson et al. 2020, doi:10.1145/3406183), at 67 pixels a degree of visual angle (a screen 0.7 m wide of
/// 3840 pixels, seen from 0.7 m; the published default).
///
/// Two .png: LDR-FLIP of the shown values. Two .exr: HDR-FLIP (Andersson et al. 2021, doi:10.2312/egs.20211015): each
/// pixel's greatest LDR-FLIP over [`Exposures`], each through the ACES tone curve that is published with it, clamped,
/// in sRGB. Both work on values rounded to 8 bits a channel, because the crate `nv-flip` does: means of HDR-FLIP come
/// out within 0.003 of those of NVIDIA's program, which does not round, and differences of less than half a step of 8
/// bits at every exposure are not seen.
#[derive(Clone, Debug, PartialEq)]
pub struct FlipMap {
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// `width * height` numbers in [0, 1], rows from the top.
    pub errors: Vec<f32>,
    /// The exposures of HDR-FLIP; `None` for LDR-FLIP.
    pub exposures: Option<Exposures>,
}

/// Exposures in stops, at even steps; radiance is multiplied by 2 to their power. They go from the exposure that shows
/// the reference's greatest luminance at 0.85 to the one that shows its median there. There are as many as there are
/// stops between the two, but at least 2 and at most 32. The median is over pixels brighter than black, so that a black
/// background does not count. Where all of the reference is black, the test's luminances are used.
#[derive(Clone, Debug, PartialEq)]
pub struct Exposures {
    /// The exposure of the darkest picture.
    pub first: f64,
    /// The exposure of the brightest picture.
    pub last: f64,
    /// How many there are, both ends among them.
    pub count: u32,
}

impl Exposures {
    fn of(test: &Picture, reference: &Picture) -> Self {
        let mut lit = luminances(reference);
        if lit.is_empty() {
            lit = luminances(test);
        }
        lit.sort_unstable_by(f64::total_cmp);
        let Some(greatest) = lit.last() else { return Self { first: 0.0, last: 0.0, count: 1 } };
        let median = (lit[(lit.len() - 1) / 2] + lit[lit.len() / 2]) / 2.0;
        let [first, last] = [greatest, &median].map(|luminance| (aces_inverse(0.85) / luminance).log2());
        Self { first, last, count: ((last - first).ceil() as u32).clamp(2, MOST_EXPOSURES) }
    }

    /// All of them, the darkest picture's first.
    pub fn stops(&self) -> impl Iterator<Item = f64> + use<> {
        let step = (self.last - self.first) / f64::from(self.count.max(2) - 1);
        let first = self.first;
        (0..self.count).map(move |index| first + step * f64::from(index))
    }
}

/// Rec. 709 luminances above zero.
fn luminances(picture: &Picture) -> Vec<f64> {
    let luminance = |pixel: &[f32; 3]| {
        let [red, green, blue] = pixel.map(f64::from);
        0.2126 * red + 0.7152 * green + 0.0722 * blue
    };
    picture.pixels.iter().map(luminance).filter(|luminance| *luminance > 0.0).collect()
}

/// Numerator and denominator of the tone curve published with HDR-FLIP, in powers of x from the square down:
/// Narkowicz's (2015) fit of ACES, without its exposure of 0.6.
const ACES: [[f64; 3]; 2] = [[0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.0], [0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14]];

/// Radiance to [0, 1].
fn aces(radiance: f64) -> f64 {
    // The curve has reached 1 long before, and its squares stay finite.
    let x = radiance.clamp(0.0, 1e6);
    let [above, below] = ACES.map(|[square, linear, constant]| (square * x + linear) * x + constant);
    (above / below).min(1.0)
}

/// The radiance that comes out as `shown` in (0, 1): the greater root of the quadratic equation.
fn aces_inverse(shown: f64) -> f64 {
    let [square, linear, constant] = [0, 1, 2].map(|power| ACES[0][power] - shown * ACES[1][power]);
    let half = -0.5 * linear / square;
    half + (half * half - constant / square).sqrt()
}

impl FlipMap {
    /// Compares two pictures of the same kind and size, all of whose numbers are finite; panics where they are not.
    /// Calls `step` with the number of steps done and of all steps, from any thread.
    pub fn between(test: &Picture, reference: &Picture, step: &(dyn Fn(usize, usize) + Sync)) -> Self {
        test.assert_comparable(reference);
        let exposures = match reference.format {
            Format::Exr => Some(Exposures::of(test, reference)),
            Format::Png => None,
        };
        let stops: Vec<Option<f64>> =
            exposures.as_ref().map_or_else(|| vec![None], |exposures| exposures.stops().map(Some).collect());
        let strips = Strip::all([test.width, test.height]);
        let (done, all) = (AtomicUsize::new(0), strips.len() * stops.len());
        let one = |strip: &Strip| {
            let mut greatest = vec![0.0_f32; test.width as usize * strip.rows.len()];
            for stop in &stops {
                let errors = strip.flip(test, reference, *stop);
                greatest.iter_mut().zip(errors).for_each(|(greatest, error)| *greatest = greatest.max(error));
                step(done.fetch_add(1, Ordering::Relaxed) + 1, all);
            }
            greatest
        };
        let errors: Vec<Vec<f32>> = strips.par_iter().map(one).collect();
        Self { width: test.width, height: test.height, errors: errors.concat(), exposures }
    }

    /// The mean over the picture: the figure by which FLIP is published to compare pictures.
    pub fn mean(&self) -> f64 {
        self.errors.iter().map(|error| f64::from(*error)).sum::<f64>() / self.errors.len() as f64
    }

    /// The greatest of all pixels.
    pub fn greatest(&self) -> f32 {
        self.errors.iter().copied().fold(0.0, f32::max)
    }

    /// The map in FLIP's published colours (magma): black is 0, pale yellow 1.
    pub fn heat_map(&self) -> DisplayImage {
        let colored = FlipImageFloat::with_data(self.width, self.height, &self.errors)
            .apply_color_lut(&nv_flip::magma_lut())
            .to_vec();
        DisplayImage { width: self.width, height: self.height, pixels: colored.as_chunks().0.to_vec() }
    }
}

/// Rows that are worked on independently.
struct Strip {
    rows: Range<u32>,
    /// These rows, and those around them on which they depend.
    seen: Range<u32>,
}

impl Strip {
    fn all([width, height]: [u32; 2]) -> Vec<Self> {
        let step = (STRIP_PIXELS / width).max(STRIP_ROWS);
        let one = |start: u32| {
            let rows = start..(start + step).min(height);
            let seen = rows.start.saturating_sub(HALO)..(rows.end + HALO).min(height);
            Self { rows, seen }
        };
        (0..height).step_by(step as usize).map(one).collect()
    }

    /// LDR-FLIP of these rows, in [0, 1]; where the pictures are linear, at the exposure `stop`.
    fn flip(&self, test: &Picture, reference: &Picture, stop: Option<f64>) -> Vec<f32> {
        let [shown_test, shown_reference] = [test, reference].map(|picture| {
            let shown = shown(&picture.pixels[range(picture.width, &self.seen)], stop);
            FlipImageRgb8::with_data(picture.width, self.seen.len() as u32, shown.as_flattened())
        });
        let errors = nv_flip::flip(shown_reference, shown_test, DEFAULT_PIXELS_PER_DEGREE).to_vec();
        let rows = self.rows.start - self.seen.start..self.rows.end - self.seen.start;
        // Rounding in its powers may leave [0, 1].
        errors[range(test.width, &rows)].iter().map(|error| error.clamp(0.0, 1.0)).collect()
    }
}

/// The indices of the pixels in these rows.
fn range(width: u32, rows: &Range<u32>) -> Range<usize> {
    width as usize * rows.start as usize..width as usize * rows.end as usize
}

/// In 8 bits, as a screen shows them: values in [0, 1] as they are, radiance at an exposure.
fn shown(pixels: &[[f32; 3]], stop: Option<f64>) -> Vec<[u8; 3]> {
    let byte = |value: f32| (value * 255.0).round() as u8;
    match stop {
        None => pixels.iter().map(|pixel| pixel.map(byte)).collect(),
        Some(stop) => {
            let gain = stop.exp2();
            let channel = |radiance: f32| byte(srgb_from_linear(aces(f64::from(radiance) * gain) as f32));
            pixels.iter().map(|pixel| pixel.map(channel)).collect()
        }
    }
}

#[cfg(test)]
#[path = "flip_tests.rs"]
mod tests;
