//! Images halved: each texel of the half is the mean of what it covers, and of colours that is the mean of their light.

use std::borrow::Cow;
use std::ops::{AddAssign, Mul};

use glam::{Vec3, Vec4};
use rayon::prelude::*;

use super::{TextureSlot, linear_from_srgb};
use crate::picture::srgb_from_linear;

/// What the bytes of an image stand for, and so what means are taken of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Encoding {
    /// Red, green and blue in sRGB: means are of linear light. Alpha is a number.
    Colors,
    /// Four numbers: means are of them as they are.
    Numbers,
    /// Unit normals, taken from [0, 255] to [-1, 1]: of a mean the direction is kept. Its length l, which says how much
    /// the normals differ, goes into alpha as 1 - sqrt(1 - l); where nothing has been averaged alpha is 255.
    Normals,
}

impl Encoding {
    /// That of the textures in a slot.
    pub fn of(slot: TextureSlot) -> Self {
        match slot {
            TextureSlot::Normal => Self::Normals,
            slot if slot.is_color() => Self::Colors,
            _ => Self::Numbers,
        }
    }

    /// What a texel adds to a mean; `linear` is [`Self::decoded`].
    pub(super) fn addend(self, [r, g, b, a]: [u8; 4], linear: &[f32; 256]) -> Vec4 {
        let [r, g, b] = [r, g, b].map(|byte| linear[usize::from(byte)]);
        match self {
            Self::Colors | Self::Numbers => Vec4::new(r, g, b, a.into()),
            Self::Normals => (length_from(a) * Vec3::new(r, g, b).normalize_or(Vec3::Z)).extend(0.0),
        }
    }

    /// What each byte stands for.
    pub(super) fn decoded(self) -> [f32; 256] {
        std::array::from_fn(|byte| self.decode(byte as u8))
    }

    fn decode(self, byte: u8) -> f32 {
        match self {
            Self::Colors => linear_from_srgb(byte),
            Self::Numbers => f32::from(byte),
            Self::Normals => f32::from(byte) / 127.5 - 1.0,
        }
    }

    /// The texel of a mean.
    pub(super) fn encode(self, mean: Vec4) -> [u8; 4] {
        let rounded = |value: f32| (value + 0.5) as u8;
        let (vector, alpha) = (mean.truncate(), mean.w);
        let (vector, alpha) = match self {
            Self::Colors => (vector.map(|linear| 255.0 * srgb_from_linear(linear)), alpha),
            Self::Numbers => (vector, alpha),
            Self::Normals => {
                let length = vector.length().min(1.0);
                (vector.normalize_or(Vec3::Z) * 127.5 + 127.5, 255.0 * (1.0 - (1.0 - length).sqrt()))
            }
        };
        vector.extend(alpha).to_array().map(rounded)
    }
}

/// The length of a mean of unit normals from the alpha that keeps it, finest near 1, where it tells most.
fn length_from(alpha: u8) -> f32 {
    let rest = 1.0 - f32::from(alpha) / 255.0;
    1.0 - rest * rest
}

/// An image at one of its sizes: itself, or a mipmap.
pub struct Level<'a> {
    /// Width and height in texels.
    pub size: [u32; 2],
    /// Rows from the top.
    pub texels: Cow<'a, [[u8; 4]]>,
}

impl Level<'_> {
    /// The next mipmap: half the size, rounded down but at least 1 texel a side, each texel the mean of the area that
    /// it covers.
    pub fn halved(&self, encoding: Encoding) -> Level<'static> {
        let linear = encoding.decoded();
        let addend = |at: usize| encoding.addend(self.texels[at], &linear);
        let (size, texels) = halved(self.size, addend, |mean| encoding.encode(mean));
        Level { size, texels: Cow::Owned(texels) }
    }
}

/// Half of an image's size, rounded down, but at least 1 texel.
pub(super) fn half_of(size: [u32; 2]) -> [u32; 2] {
    size.map(|side| (side / 2).max(1))
}

/// An image of [`half_of`] the size: each of its texels is made, by `encode`, of the mean of `linear` over the area
/// that it covers. `linear` is asked for texels by their index, in rows from the top.
pub(super) fn halved<L, T>(
    size: [u32; 2],
    linear: impl Fn(usize) -> L + Sync,
    encode: impl Fn(L) -> T + Sync,
) -> ([u32; 2], Vec<T>)
where
    L: Default + AddAssign + Mul<f32, Output = L>,
    T: Clone + Default + Send,
{
    let [width, height] = half_of(size);
    let columns: Vec<Span> = (0..width).map(|x| Span::new(x, width, size[0])).collect();
    let mean = |rows: Span, columns: Span| {
        let mut mean = L::default();
        for (y, row_weight) in rows.weights() {
            for (x, column_weight) in columns.weights() {
                mean += linear(y * size[0] as usize + x) * (row_weight * column_weight);
            }
        }
        mean
    };
    let mut texels = vec![T::default(); width as usize * height as usize];
    texels.par_chunks_mut(width as usize).zip(0..height).for_each(|(row, y)| {
        let rows = Span::new(y, height, size[1]);
        row.iter_mut().zip(&columns).for_each(|(texel, columns)| *texel = encode(mean(rows, *columns)));
    });
    ([width, height], texels)
}

/// What one of `count` texels covers of `of`: at most three.
#[derive(Clone, Copy)]
struct Span {
    first: usize,
    weights: [f32; 3],
    count: usize,
}

impl Span {
    fn new(index: u32, count: u32, of: u32) -> Self {
        let scale = of as f32 / count as f32;
        let (start, end) = (index as f32 * scale, (index + 1) as f32 * scale);
        let first = start as usize;
        let last = ((end - 1e-3) as usize).min(of as usize - 1);
        let mut weights = [0.0; 3];
        for (at, weight) in (first..=last).zip(&mut weights) {
            *weight = (end.min((at + 1) as f32) - start.max(at as f32)) / scale;
        }
        Self { first, weights, count: last + 1 - first }
    }

    fn weights(self) -> impl Iterator<Item = (usize, f32)> {
        (0..self.count.min(3)).map(move |k| (self.first + k, self.weights[k]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_are_means_over_the_area_in_linear_light() {
        let checker = |size: [u32; 2]| {
            let texel = |at: u32| [if (at % size[0] + at / size[0]).is_multiple_of(2) { 255 } else { 0 }; 4];
            Level { size, texels: (0..size[0] * size[1]).map(texel).collect() }
        };
        // Half the light is 188 in sRGB, 128 as a number; opacity is one.
        assert_eq!(checker([8, 4]).halved(Encoding::Colors).texels, vec![[188, 188, 188, 128]; 8]);
        assert_eq!(checker([8, 4]).halved(Encoding::Numbers).texels, vec![[128; 4]; 8]);
        let odd = Level { size: [3, 1], texels: vec![[30; 4], [60; 4], [90; 4]].into() }.halved(Encoding::Numbers);
        assert_eq!((odd.size, odd.texels.to_vec()), ([1, 1], vec![[60; 4]]));
        let five = Level { size: [5, 1], texels: vec![[0; 4], [0; 4], [100; 4], [0; 4], [0; 4]].into() }
            .halved(Encoding::Numbers);
        assert_eq!((five.size, five.texels.to_vec()), ([2, 1], vec![[20; 4]; 2]));
    }

    #[test]
    fn the_mean_survives_every_halving() {
        let texels: Vec<[u8; 4]> = (0..37 * 21).map(|at: u32| [(at * 97 % 256) as u8; 4]).collect();
        let mean = |level: &Level| {
            level.texels.iter().map(|texel| f64::from(texel[0])).sum::<f64>() / level.texels.len() as f64
        };
        let mut level = Level { size: [37, 21], texels: texels.into() };
        let whole = mean(&level);
        while level.size != [1, 1] {
            level = level.halved(Encoding::Numbers);
            assert!((mean(&level) - whole).abs() < 1.0, "{:?}", level.size);
        }
    }

    #[test]
    fn mipmaps_of_normals_keep_the_length_of_their_mean() {
        let lean = |x: f32| {
            let normal = Vec3::new(x, 0.0, 1.0).normalize() * 127.5 + 127.5;
            [normal.x.round() as u8, 128, normal.z.round() as u8, 255]
        };
        let mean = |level: &Level| {
            let [r, g, b, a] = level.texels[0];
            (Vec3::new(f32::from(r), f32::from(g), f32::from(b)) / 127.5 - 1.0, length_from(a))
        };
        let flat = Level { size: [2, 2], texels: vec![lean(0.4); 4].into() }.halved(Encoding::Normals);
        assert!(mean(&flat).1 > 0.9999, "nothing was averaged");
        let texels = vec![lean(1.0), lean(-1.0), lean(-1.0), lean(1.0), lean(1.0), lean(-1.0), lean(-1.0), lean(1.0)];
        let bumpy = Level { size: [4, 2], texels: texels.into() }.halved(Encoding::Normals);
        for level in [&bumpy, &bumpy.halved(Encoding::Normals)] {
            let (normal, length) = mean(level);
            assert!(normal.distance(Vec3::Z) < 0.01 && (length - 0.5_f32.sqrt()).abs() < 0.005, "{normal} {length}");
        }
    }
}
