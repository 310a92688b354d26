//! Images of textured lights and their mipmaps.

use std::iter::successors;

use glam::{DVec3, Vec3};

use crate::scene::Pattern;

/// What a texel of a level shows.
#[derive(Clone, Copy, Default)]
pub(super) struct Texel {
    /// Over what of the polygon lies in it.
    pub mean: DVec3,
    /// Of that, square metres.
    pub area: f64,
}

/// The sizes of an image's levels, down to a single texel.
fn sizes(finest: [u32; 2]) -> impl Iterator<Item = [u32; 2]> {
    successors(Some(finest), |size| (*size != [1, 1]).then(|| size.map(|count| count.div_ceil(2))))
}

/// An image and its mipmaps: means over the polygon of these convex parts alone, so that what is beside it does not
/// darken its edges. Texels in which nothing of it lies have the mean of the coarser one around them.
pub(super) fn levels(parts: &[Vec<DVec3>], pattern: &Pattern) -> Vec<Vec<Texel>> {
    let sizes: Vec<[u32; 2]> = sizes(pattern.image.size).collect();
    let of = |value: &Vec3| Texel { mean: value.as_dvec3(), area: 0.0 };
    let mut finest: Vec<Texel> = pattern.image.texels.iter().map(of).collect();
    let grid = pattern.grid(|point| point);
    for (cell, area) in parts.iter().flat_map(|part| grid.areas(part)) {
        finest[cell].area += area;
    }
    let mut levels = vec![finest];
    for pair in sizes.windows(2) {
        let coarser = coarser(&levels[levels.len() - 1], [pair[0], pair[1]]);
        levels.push(coarser);
    }
    for level in (1..levels.len()).rev() {
        let (finer, coarser) = levels.split_at_mut(level);
        let columns = [sizes[level - 1], sizes[level]].map(|[columns, _]| columns as usize);
        for (at, texel) in finer[level - 1].iter_mut().enumerate().filter(|(_, texel)| texel.area == 0.0) {
            let (column, row) = (at % columns[0], at / columns[0]);
            texel.mean = coarser[0][row / 2 * columns[1] + column / 2].mean;
        }
    }
    levels
}

/// The next level, given the sizes of both.
fn coarser(finer: &[Texel], [[columns, rows], [wide, high]]: [[u32; 2]; 2]) -> Vec<Texel> {
    let mut texels = vec![Texel::default(); (wide * high) as usize];
    for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
        let Texel { mean, area } = finer[(row * columns + column) as usize];
        let sum = &mut texels[(row / 2 * wide + column / 2) as usize];
        *sum = Texel { mean: sum.mean + area * mean, area: sum.area + area };
    }
    for texel in texels.iter_mut().filter(|texel| texel.area > 0.0) {
        texel.mean /= texel.area;
    }
    texels
}
