//! Mipmaps of textures that cut out: how much of what lies below a texel is there, and of which colour that is.

use std::borrow::Cow;

use glam::Vec4;
use rayon::prelude::*;

use super::mipmap::{Encoding, Level, halved};
use super::{Filter, Sampler};

/// What becomes of a base colour's texture where a material cuts out (`AlphaMode::Mask`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cutout {
    /// Multiplies the texture's alpha.
    pub opacity: f32,
    /// Where the product is less, nothing is there.
    pub cutoff: f32,
    /// How the texture goes on beyond its edges, and how it is magnified.
    pub sampler: Sampler,
}

/// Lines along which a square between four texels is measured: of what lies between all and nothing, to about 1e-3.
const LINES: usize = 8;

/// Added to each share as a weight of colours, so that those of which nothing is there have a mean too.
const TRACE: f32 = 1e-6;

impl Cutout {
    /// The image and all its mipmaps, down to a single texel. The alpha of each texel is the share of its area in which
    /// the image, magnified, is there, and its colour the mean over that area. Where nothing is there, colours are those of
    /// the mipmaps above, so that no others bleed in between texels.
    pub fn levels(&self, image: &Level) -> Vec<Level<'static>> {
        let finest = (0..image.texels.len()).into_par_iter().map(|at| self.seen(image, at));
        let (texels, of_finest): (Vec<[u8; 4]>, Vec<f32>) = finest.unzip();
        let mut levels = vec![Level { size: image.size, texels: texels.into() }];
        let mut shares = vec![of_finest];
        while levels[levels.len() - 1].size != [1, 1] {
            let (level, of_level) = half(&levels[levels.len() - 1], &shares[levels.len() - 1]);
            levels.push(level);
            shares.push(of_level);
        }
        for at in (0..levels.len() - 1).rev() {
            let (finer, coarser) = levels.split_at_mut(at + 1);
            fill(&mut finer[at], &shares[at], &coarser[0]);
        }
        levels
    }

    /// A texel of the finest level, and its share. Where a texel is cut out but for its borders, it has the colour of the
    /// most opaque of its neighbours, whose edge that is.
    fn seen(&self, image: &Level, at: usize) -> ([u8; 4], f32) {
        let [width, height] = image.size;
        let around = |axis: usize, at: usize, side: u32| {
            [-1, 0, 1].map(|step| self.sampler.wrap[axis].texel(at as i64 + step, side.into()))
        };
        let columns = around(0, at % width as usize, width);
        let rows = around(1, at / width as usize, height);
        let texels = rows.map(|row| columns.map(|column| image.texels[row * width as usize + column]));
        let excess = texels.map(|row| row.map(|texel| f32::from(texel[3]) / 255.0 * self.opacity - self.cutoff));
        let is_there = excess[1][1] >= 0.0;
        let most_opaque = texels.as_flattened().iter().max_by_key(|texel| texel[3]).unwrap_or(&texels[1][1]);
        let [red, green, blue, _] = if is_there { texels[1][1] } else { *most_opaque };
        let is_same = |excess: &f32| (*excess >= 0.0) == is_there;
        let share = match self.sampler.magnify {
            Filter::Linear if !excess.as_flattened().iter().all(is_same) => share(&excess),
            _ => f32::from(u8::from(is_there)),
        };
        ([red, green, blue, byte(share)], share)
    }
}

/// The share of the area of the middle one of nine texels in which a number, linear between their centres along rows and
/// along columns, is not negative.
fn share([above, beside, below]: &[[f32; 3]; 3]) -> f32 {
    let of = |row: &[f32; 3], column: usize| quarter([beside[1], beside[column]], [row[1], row[column]]);
    0.25 * (of(above, 0) + of(above, 2) + of(below, 0) + of(below, 2))
}

/// The share of the quarter next to the first of four corners of a square in which a number, linear between them along
/// rows and along columns, is not negative.
fn quarter(first: [f32; 2], second: [f32; 2]) -> f32 {
    // Each line runs along the way in which the number changes more.
    let slope = [first[1] - first[0] + second[1] - second[0], second[0] - first[0] + second[1] - first[1]];
    let (first, second) = match slope[0].abs() > slope[1].abs() {
        true => ([first[0], second[0]], [first[1], second[1]]),
        false => (first, second),
    };
    let along = |[from, to]: [f32; 2], share: f32| from + (to - from) * share;
    let line = |index: usize| {
        let at = 0.5 * (index as f32 + 0.5) / LINES as f32;
        let from = along(first, at);
        let to = 0.5 * (from + along(second, at));
        match (from >= 0.0, to >= 0.0) {
            (true, true) => 1.0,
            (true, false) => from / (from - to),
            (false, true) => to / (to - from),
            (false, false) => 0.0,
        }
    };
    (0..LINES).map(line).sum::<f32>() / LINES as f32
}

fn byte(share: f32) -> u8 {
    (255.0 * share + 0.5) as u8
}

/// The next mipmap, and the shares of its texels, by those of this one.
fn half(level: &Level, shares: &[f32]) -> (Level<'static>, Vec<f32>) {
    let linear = Encoding::Colors.decoded();
    let weighed = |at: usize| {
        let weight = shares[at] + TRACE;
        (weight * Encoding::Colors.addend(level.texels[at], &linear).truncate()).extend(weight)
    };
    let encoded = |sum: Vec4| {
        // What is left of nothing but traces is rounding.
        let share = if sum.w < 2.0 * TRACE { 0.0 } else { (sum.w - TRACE).min(1.0) };
        let [red, green, blue, _] = Encoding::Colors.encode(sum / sum.w);
        ([red, green, blue, byte(share)], share)
    };
    let (size, made) = halved(level.size, weighed, encoded);
    let (texels, shares): (Vec<[u8; 4]>, _) = made.into_iter().unzip();
    (Level { size, texels: Cow::Owned(texels) }, shares)
}

/// Gives texels of which nothing is there the colours of the mipmap above.
fn fill(level: &mut Level, shares: &[f32], above: &Level) {
    let width = level.size[0] as usize;
    let place = |at: usize, axis: usize| (at / 2).min(above.size[axis] as usize - 1);
    for (at, texel) in level.texels.to_mut().iter_mut().enumerate().filter(|(at, _)| shares[*at] == 0.0) {
        let [red, green, blue, _] = above.texels[place(at / width, 1) * above.size[0] as usize + place(at % width, 0)];
        *texel = [red, green, blue, texel[3]];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Wrap;

    const HALF: Cutout = Cutout { opacity: 1.0, cutoff: 0.5, sampler: Sampler::DEFAULT };

    fn image(size: [u32; 2], alpha: impl Fn(u32, u32) -> u8) -> Level<'static> {
        let texel = |at: u32| [200, 100, 50, alpha(at % size[0], at / size[0])];
        Level { size, texels: (0..size[0] * size[1]).map(texel).collect() }
    }

    fn shares(levels: &[Level]) -> Vec<f64> {
        let mean = |level: &Level| {
            level.texels.iter().map(|texel| f64::from(texel[3]) / 255.0).sum::<f64>() / level.texels.len() as f64
        };
        levels.iter().map(mean).collect()
    }

    /// One texel of four: between bilinear texels the area where x y >= 1/2, of each of its four corners, x and y from 1/2
    /// to 1: (1 - ln 2) / 2.
    #[test]
    fn single_texels_keep_the_area_that_is_seen_of_them() {
        let dots = || image([16, 16], |x, y| if x % 2 + y % 2 == 0 { 255 } else { 0 });
        let nearest = Cutout { sampler: Sampler { magnify: Filter::Nearest, ..Sampler::DEFAULT }, ..HALF };
        for (cutout, expected) in [(HALF, 0.5 * (1.0 - 2.0_f64.ln())), (nearest, 0.25)] {
            let levels = cutout.levels(&dots());
            assert_eq!(levels.iter().map(|level| level.size[0]).collect::<Vec<_>>(), [16, 8, 4, 2, 1]);
            for share in shares(&levels) {
                assert!((share - expected).abs() < 0.5 / 255.0 + 1e-3, "{share} of {expected}");
            }
        }
    }

    /// An edge through a ramp lies where the alpha is the cutoff; at the border the image goes on as its sampler says.
    #[test]
    fn ramps_are_cut_where_they_pass_the_cutoff() {
        let ramp = || image([64, 1], |x, _| (4 * x) as u8);
        let clamped = Sampler { wrap: [Wrap::Clamp; 2], ..Sampler::DEFAULT };
        for (opacity, cutoff) in [(1.0, 0.5), (0.8, 0.5), (1.0, 0.123), (0.5, 0.499), (0.3, 0.5), (1.0, 0.0)] {
            let cutout = Cutout { opacity, cutoff, sampler: clamped };
            // In texels: the centre of texel k is at k + 1/2.
            let edge = f64::from(cutoff) / f64::from(opacity) * 255.0 / 4.0 + 0.5;
            let expected = if edge > 63.5 {
                0.0
            } else if edge <= 0.5 {
                1.0
            } else {
                1.0 - edge / 64.0
            };
            for share in shares(&cutout.levels(&ramp())) {
                assert!((share - expected).abs() < 0.5 / 255.0 + 1e-4, "{opacity}, {cutoff}: {share} of {expected}");
            }
        }
        let steps = |wrap| Cutout { sampler: Sampler { wrap: [wrap; 2], ..Sampler::DEFAULT }, ..HALF };
        // Of one lit column the half towards the border is cut by what lies beyond it.
        let column = || image([4, 4], |x, _| if x == 0 { 255 } else { 64 });
        let edge = 1.0 - (127.5 - 64.0) / 191.0;
        for (wrap, expected) in [(Wrap::Repeat, 2.0 * edge / 4.0), (Wrap::Clamp, (0.5 + edge) / 4.0)] {
            let share = shares(&steps(wrap).levels(&column()))[2];
            assert!((share - expected).abs() < 0.5 / 255.0 + 1e-4, "{wrap:?}: {share} of {expected}");
        }
    }

    /// Bright where it is cut out, dark where it is there: no mipmap is brighter than what is there.
    #[test]
    fn colours_are_of_what_is_there() {
        let texel =
            |at: usize| if (at * at / 7 + at / 64).is_multiple_of(5) { [40, 90, 20, 255] } else { [255, 255, 255, 0] };
        let mut texels: Vec<[u8; 4]> = (0..64 * 64).map(texel).collect();
        // A part of which nothing is there.
        texels[..64 * 24].fill([255, 255, 255, 0]);
        let levels = HALF.levels(&Level { size: [64, 64], texels: texels.into() });
        for level in &levels {
            let far =
                |texel: &&[u8; 4]| texel[0].abs_diff(40).max(texel[1].abs_diff(90)).max(texel[2].abs_diff(20)) > 1;
            assert_eq!(level.texels.iter().find(far), None, "{:?}", level.size);
        }
        assert!(levels[0].texels[0][3] == 0 && levels[6].texels[0][3] > 0);
        // Where nothing is there at all, there are colours nevertheless.
        let nothing = HALF.levels(&image([8, 8], |_, _| 0));
        assert!(nothing.iter().all(|level| level.texels.iter().all(|texel| *texel == [200, 100, 50, 0])));
    }
}
