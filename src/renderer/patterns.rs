//! Patterns of textured lights as the shaders read them.

use std::borrow::Cow;
use std::collections::HashMap;

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3};

use super::levels::levels;
use super::pieces::{Piece, pieces};
use crate::scene::{Drawn, Pattern, Polygon};

/// `PatternsSheet` of `patterns.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(super) struct GpuSheet {
    origin: Vec3,
    first_texel: u32,
    row: Vec3,
    columns: u32,
    column: Vec3,
    rows: u32,
}

/// A polygon that shines, or a piece of one that is textured.
pub(super) struct Shown<'a> {
    pub polygon: Cow<'a, Polygon>,
    /// Of the light's radiance.
    pub factor: Vec3,
    /// `EmittersPolygon::pattern` and `pattern_texels` of `emitters.wgsl`.
    pub pattern: u32,
    pub texels: f32,
    /// Of the points on the polygon.
    pub share: f64,
}

/// `PATTERNS_NONE` of `patterns.wgsl`.
const NONE: u32 = u32::MAX;

/// The most pieces of all textured polygons of a scene, each of which takes as long as a light; and where all are even, so that
/// no sample has to make up for what is not.
const PIECES: usize = 16;
const EVEN_PIECES: usize = 64;

/// What the textured lights of a scene show, as often as it is drawn.
pub(super) struct Patterns {
    /// By light and polygon: what a polygon's image is cut into depends on both.
    held: HashMap<[usize; 2], Held>,
    texels: Vec<f32>,
    /// The most pieces of each, and where all are even.
    most: [usize; 2],
}

struct Held {
    first_texel: u32,
    pieces: Vec<Piece>,
}

impl Patterns {
    /// Of a scene, still without any.
    pub fn new(drawn: &Drawn) -> Self {
        let polygons = drawn.scene.lights.iter().flat_map(|light| &light.polygons);
        let is_varied = |pattern: &Pattern| pattern.image.size != [1, 1];
        let count = polygons.filter(|polygon| polygon.pattern.as_ref().is_some_and(is_varied)).count();
        let most = [PIECES, EVEN_PIECES].map(|pieces| (pieces / count.max(1)).max(1));
        Self { held: HashMap::new(), texels: Vec::new(), most }
    }

    /// All texels of all levels, three numbers each.
    pub fn texels(&self) -> &[f32] {
        &self.texels
    }

    /// A polygon, the same in each picture for these indices but for where it is, or its pieces, of which those that are not
    /// even go by a sheet that is added to the others.
    pub fn shown<'a>(
        &mut self,
        indices: [usize; 2],
        polygon: &'a Polygon,
        sheets: &mut Vec<GpuSheet>,
    ) -> Vec<Shown<'a>> {
        let Some(pattern) = &polygon.pattern else {
            let polygon = Cow::Borrowed(polygon);
            return vec![Shown { polygon, factor: Vec3::ONE, pattern: NONE, texels: 0.0, share: 1.0 }];
        };
        let Held { first_texel, ref pieces, .. } = *self.of(indices, polygon, pattern);
        let ([row, column], [columns, rows]) = (pattern.axes, pattern.image.size);
        let number = sheets.len() as u32;
        let grid = pattern.grid(|point| point);
        let outline: Vec<DVec3> = polygon.contours[0].iter().map(|vertex| vertex.as_dvec3()).collect();
        let shown = |piece: &Piece| {
            let polygon = if pieces.len() == 1 {
                Cow::Borrowed(polygon)
            } else {
                let contour = grid.clipped(&outline, piece.low, piece.high);
                let contours = vec![contour.into_iter().map(|vertex| vertex.as_vec3()).collect()];
                Cow::Owned(Polygon { contours, normal: polygon.normal, pattern: None })
            };
            let share = 1.0 / pieces.len() as f64;
            match piece.even {
                Some(even) => Shown { polygon, factor: even.as_vec3(), pattern: NONE, texels: 0.0, share },
                None => Shown { polygon, factor: Vec3::ONE, pattern: number, texels: piece.texels(), share },
            }
        };
        let mut shown: Vec<Shown> = pieces.iter().map(shown).collect();
        shown.retain(|shown| shown.factor != Vec3::ZERO && shown.polygon.contours[0].len() > 2);
        if shown.iter().any(|shown| shown.pattern != NONE) {
            sheets.push(GpuSheet { origin: pattern.origin, first_texel, row, columns, column, rows });
        }
        shown
    }

    /// What is held of a polygon's image, which is taken in where it is new.
    fn of(&mut self, indices: [usize; 2], polygon: &Polygon, pattern: &Pattern) -> &Held {
        self.held.entry(indices).or_insert_with(|| {
            let parts = polygon.convex_parts();
            let levels = levels(&parts, pattern);
            // Others stay whole.
            let is_convex = polygon.contours.len() == 1 && parts.len() == 1;
            let [few, many] = if is_convex { self.most } else { [1; 2] };
            let cut = |most: usize| pieces(&levels[0], pattern.image.size, most);
            let even = cut(many);
            let pieces = if even.iter().all(|piece| piece.even.is_some()) { even } else { cut(few) };
            let first_texel = self.texels.len() as u32 / 3;
            self.texels.extend(levels.iter().flatten().flat_map(|texel| texel.mean.as_vec3().to_array()));
            Held { first_texel, pieces }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::layout::{differences, members};
    use std::sync::Arc;

    use super::super::shader::SURFACES_WGSL;
    use super::*;
    use crate::scene::PatternImage;

    #[test]
    fn sheets_stand_as_the_shader_reads_them() {
        let members = members!(GpuSheet { origin, first_texel, row, columns, column, rows });
        assert_eq!(differences(SURFACES_WGSL, "PatternsSheet", size_of::<GpuSheet>(), members), [""; 0]);
    }

    /// An outline in the plane z = 0 before a 3 x 2 image of squares, which is black in the last column.
    fn polygon(outline: &[[f32; 2]]) -> Polygon {
        let contours = vec![outline.iter().map(|&[x, y]| Vec3::new(x, y, 0.0)).collect()];
        let texels = [1.0, 3.0, 0.0, 5.0, 7.0, 0.0].map(Vec3::splat).to_vec();
        let image = Arc::new(PatternImage { size: [3, 2], texels });
        let axes = [3.0 * Vec3::X, 2.0 * Vec3::Y];
        Polygon { contours, normal: Vec3::Z, pattern: Some(Pattern { origin: Vec3::ZERO, axes, image }) }
    }

    fn patterns(most: usize) -> Patterns {
        Patterns { held: HashMap::new(), texels: Vec::new(), most: [1, most] }
    }

    /// Of the triangle 1 lies in the first cell, and 1/2 in each of its neighbours. A square of the first cell on the same image has
    /// levels of its own.
    #[test]
    fn levels_are_means_over_the_polygon() {
        let triangle = polygon(&[[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]]);
        let pattern = triangle.pattern.clone();
        let square = Polygon { pattern, ..polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]) };
        let (mut patterns, mut sheets) = (patterns(1), Vec::new());
        for (index, number) in [(4, 0), (4, 1), (7, 2)] {
            let [shown] = &patterns.shown([0, index], &triangle, &mut sheets)[..] else { panic!("there is one") };
            assert_eq!((shown.pattern, shown.factor, shown.texels), (number, Vec3::ONE, 6.0));
        }
        assert_eq!([0, 1, 2].map(|index: usize| sheets[index].first_texel), [0, 0, 6 + 2 + 1]);
        let [shown] = &patterns.shown([0, 5], &square, &mut sheets)[..] else { panic!("there is one") };
        assert_eq!((shown.pattern, shown.factor), (NONE, Vec3::ONE));
        patterns.texels.truncate(2 * 3 * (6 + 2 + 1));
        let texels: Vec<f32> = patterns.texels().iter().copied().step_by(3).collect();
        let mean = (1.0 + 0.5 * 3.0 + 0.5 * 5.0) / 2.0;
        let expected = [1.0, 3.0, mean, 5.0, mean, mean, mean, mean, mean];
        assert_eq!(texels.len(), 2 * expected.len());
        for (found, expected) in texels.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6, "{texels:?}");
        }
    }

    /// A polygon of which some is beside the image: each piece shines as its cell does, and all add up to it.
    #[test]
    fn pieces_are_parts_of_the_polygon() {
        let whole = polygon(&[[-1.0, 0.0], [2.5, 0.0], [2.5, 2.0], [-1.0, 1.5]]);
        let (mut patterns, mut sheets) = (patterns(16), Vec::new());
        let pieces = patterns.shown([0, 0], &whole, &mut sheets);
        assert!(sheets.is_empty() && pieces.len() == 4, "{} sheets, {} pieces", sheets.len(), pieces.len());
        let area = |polygon: &Polygon| {
            let corners = &polygon.contours[0];
            corners.windows(2).map(|pair| 0.5 * pair[0].cross(pair[1]).z).sum::<f32>()
                + 0.5 * corners[corners.len() - 1].cross(corners[0]).z
        };
        let mut lit: Vec<(f32, f32)> = pieces.iter().map(|piece| (piece.factor.x, area(&piece.polygon))).collect();
        lit.sort_by(|one, other| one.0.total_cmp(&other.0));
        // The upper side is y = (x + 1) / 7 + 1.5.
        let expected = [(1.0, 2.0), (3.0, 1.0), (5.0, 2.0 * 0.5 + 2.0 / 7.0), (7.0, 0.5 + 2.5 / 7.0)];
        for (found, expected) in lit.iter().zip(expected) {
            assert!(found.0 == expected.0 && (found.1 - expected.1).abs() < 1e-6, "{lit:?}");
        }
    }
}
