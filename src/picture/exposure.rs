//! How much a picture is exposed: by a number, or metered; and what to say of one that is past all that a screen shows.

use super::{DisplayImage, LinearImage};

/// The longer side, in pixels, of the picture that is metered.
const SIDE: u32 = 256;
/// What the mean is exposed to: a grey card's reflectance, which is the middle of what is seen between black and white.
const KEY: f64 = 0.18;
/// Shares of the picture that do not count, from the darkest and from the brightest on.
const OUTLIERS: f64 = 0.05;
/// Pixels this much darker than the brightest that count, 16 stops, are black.
const BLACK: f64 = 1.0 / 65536.0;
/// The least and the greatest exposure value that is taken, as `--exposure` has it.
const MOST: f64 = 100.0;
/// The greatest code that is black, and the least that is white.
const ENDS: [u8; 2] = [1, 252];
/// Shares of a picture that is black, and of what is not black in one that is past white. Along the edges of what is past
/// white its pixels are not; many small things have many edges.
const BLANK: [f64; 2] = [0.99, 0.9];
/// Stops that metering has to be away from a picture's exposure to be worth a word.
const WORTH: f32 = 3.0;

/// Exposure of a picture that is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exposure {
    /// In stops: radiance is multiplied by 2 to this power.
    Stops(f32),
    /// As [`metered`] in what is seen.
    Auto,
}

impl From<f32> for Exposure {
    fn from(stops: f32) -> Self {
        Self::Stops(stops)
    }
}

/// The size at which a picture of this size is metered: its shape, 256 pixels along the longer side.
pub fn metered_size(size: [u32; 2]) -> [u32; 2] {
    let longer = f64::from(size[0].max(size[1]));
    size.map(|side| (f64::from(side) * f64::from(SIDE) / longer).round().max(1.0) as u32)
}

/// The exposure value, in hundredths, that shows a linear picture's logarithmic mean luminance at 0.18; none where all is
/// black.
///
/// Each pixel weighs exp(-2 d^2), d its distance from the middle over that of the corners: 1 in the middle, 0.14 in the
/// corners. Black ones do not count, nor do the darkest 5% of the weight and the brightest 5%.
pub fn metered(image: &LinearImage) -> Option<f32> {
    let [width, height] = [image.width, image.height].map(f64::from);
    let corner = width.hypot(height);
    let place = |index: usize| [index as u32 % image.width, index as u32 / image.width].map(f64::from);
    let weigh = |(index, pixel): (usize, &[f32; 3])| {
        let [x, y] = place(index);
        let distance = (2.0 * x + 1.0 - width).hypot(2.0 * y + 1.0 - height) / corner;
        (luminance(pixel), (-2.0 * distance * distance).exp())
    };
    let lit = |(luminance, _): &(f64, f64)| *luminance > 0.0 && luminance.is_finite();
    let mut pixels: Vec<(f64, f64)> = image.pixels.iter().enumerate().map(weigh).filter(lit).collect();
    pixels.sort_unstable_by(|one, other| one.0.total_cmp(&other.0));
    let brightest = within(&pixels, 1.0 - OUTLIERS).last()?.0;
    pixels.retain(|(luminance, _)| *luminance >= BLACK * brightest);
    let (low, high) = (OUTLIERS * weight(&pixels), (1.0 - OUTLIERS) * weight(&pixels));
    let (mut before, mut sum, mut all) = (0.0, 0.0, 0.0);
    for (luminance, weight) in &pixels {
        // The part of a pixel's weight that lies between the two, so that equal pixels in another order change nothing.
        let part = ((before + weight).min(high) - f64::max(before, low)).max(0.0);
        before += weight;
        (sum, all) = (sum + part * luminance.log2(), all + part);
    }
    let stops = (KEY.log2() - sum / all).clamp(-MOST, MOST);
    Some((stops * 100.0).round() as f32 / 100.0)
}

/// The first of these pixels, up to this share of their weight; at least one.
fn within(pixels: &[(f64, f64)], share: f64) -> &[(f64, f64)] {
    let most = share * weight(pixels);
    let mut sum = 0.0;
    let past = pixels.iter().position(|(_, weight)| {
        sum += weight;
        sum > most
    });
    &pixels[..past.map_or(pixels.len(), |past| (past + 1).min(pixels.len()))]
}

fn weight(pixels: &[(f64, f64)]) -> f64 {
    pixels.iter().map(|(_, weight)| weight).sum()
}

/// Of Rec. 709.
fn luminance(pixel: &[f32; 3]) -> f64 {
    let [red, green, blue] = pixel.map(f64::from);
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}

/// Why a picture shows next to nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blank {
    /// At least 99% of it is black: codes 0 and 1 in each channel.
    Black,
    /// Of what is not black at least 90% is past white: the greatest channel's code is from 252 up.
    White,
}

impl Blank {
    /// Whether a picture shows next to nothing, and why.
    pub fn of(shown: &DisplayImage) -> Option<Self> {
        let greatest = |pixel: &[u8; 3]| pixel.iter().copied().fold(0, u8::max);
        let count =
            |holds: &dyn Fn(u8) -> bool| shown.pixels.iter().filter(|pixel| holds(greatest(pixel))).count() as f64;
        let (all, black) = (shown.pixels.len() as f64, count(&|code| code <= ENDS[0]));
        let is_white = || count(&|code| code >= ENDS[1]) >= BLANK[1] * (all - black);
        if black >= BLANK[0] * all { Some(Self::Black) } else { is_white().then_some(Self::White) }
    }

    /// A line that says so of a picture of this exposure, with what to try, given the exposure that metering takes; none
    /// where that would not change much: what is seen is small, or black and white by itself.
    pub fn advice(self, exposure: f32, metered: Option<f32>) -> Option<String> {
        let what = match (self, metered) {
            (Self::White, _) => "past white",
            (Self::Black, Some(_)) => "black",
            (Self::Black, None) => {
                return Some(
                    "the picture is black at any exposure, because nothing that is lit is in sight: try another --camera, \
                     --ambient 1,1,1 or --rig on"
                        .to_owned(),
                );
            }
        };
        let metered = metered.filter(|metered| match self {
            Self::White => *metered <= exposure - WORTH,
            Self::Black => *metered >= exposure + WORTH,
        })?;
        Some(format!("nearly all of the picture is {what}: try --exposure {metered:.1} or --exposure auto"))
    }
}
