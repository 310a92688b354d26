//! One view at nine alphas.

use egui::TextureId;

use crate::scene::Edits;

/// How many pictures there are.
const COUNT: usize = 9;

/// The pictures of one view that differ in alpha alone.
pub struct Sheet {
    /// What all of them have in common: without the alpha in which they differ.
    pub edits: Edits,
    /// Their width and height in pixels, as they are laid out now; 0 before they are.
    pub size: [u32; 2],
    /// By index into [`Sheet::ALPHAS`]; none where there is no picture yet.
    pub pictures: [Option<Tile>; COUNT],
}

/// One of its pictures, as it was drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tile {
    pub texture: TextureId,
    /// Width and height in pixels.
    pub size: [u32; 2],
}

impl Sheet {
    pub const ALPHAS: [f32; COUNT] = [0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0];

    /// Of what these edits show at other alphas of `material`; without pictures.
    pub fn new(edits: &Edits, material: usize) -> Self {
        let mut edits = edits.clone();
        edits.materials.entry(material).or_default().alpha = None;
        Self { edits, size: [0; 2], pictures: [const { None }; COUNT] }
    }

    /// The first of which there is no picture of this size yet: one of another size is shown until there is.
    pub fn missing(&self) -> Option<usize> {
        self.pictures.iter().position(|tile| tile.is_none_or(|tile| tile.size != self.size))
    }

    /// What the picture of this index is drawn with, where alpha is that of `material`.
    pub fn edits_of(&self, index: usize, material: usize) -> Edits {
        let mut edits = self.edits.clone();
        edits.materials.entry(material).or_default().alpha = Some(Self::ALPHAS[index]);
        edits
    }

    /// The index of the picture whose alpha is nearest to this one.
    pub fn nearest(alpha: f32) -> usize {
        let distance = |index: &usize| (Self::ALPHAS[*index] - alpha).abs();
        (0..COUNT).min_by(|one, other| distance(one).total_cmp(&distance(other))).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::MaterialEdits;

    #[test]
    fn pictures_differ_in_the_alpha_of_one_material() {
        let other = MaterialEdits { alpha: Some(0.3), ..MaterialEdits::default() };
        let edits = Edits { materials: [(0, other), (1, other)].into(), ..Edits::default() };
        let sheet = Sheet::new(&edits, 1);
        for (index, alpha) in Sheet::ALPHAS.into_iter().enumerate() {
            let changed = sheet.edits_of(index, 1);
            assert_eq!(changed.of_material(1).alpha, Some(alpha));
            let back = Edits { materials: edits.materials.clone(), ..changed };
            assert_eq!(back, edits);
            assert_eq!(sheet.edits_of(index, 1).of_material(0), other);
        }
        // Whatever alpha is when it opens.
        let mut swept = edits.clone();
        swept.materials.entry(1).or_default().alpha = Some(0.9);
        assert_eq!(Sheet::new(&swept, 1).edits, sheet.edits);
        assert!(Sheet::ALPHAS.windows(2).all(|pair| pair[1] - pair[0] == 0.125));
    }

    #[test]
    fn the_nearest_is_at_most_half_a_step_away() {
        for alpha in [0.0, 0.03, 0.0625, 0.0626, 0.3, 0.44, 0.5, 0.95, 1.0] {
            let nearest = Sheet::ALPHAS[Sheet::nearest(alpha)];
            assert!((nearest - alpha).abs() <= 0.0625, "{nearest} for {alpha}");
        }
    }
}
