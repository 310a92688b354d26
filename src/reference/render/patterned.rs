//! Lights that show a pattern, sampled by what its texels bring.

use glam::DVec3;

use super::luminance::luminance;
use crate::scene::{Pattern, PatternGrid};

/// The texels of a convex part of a light, in proportion to the light that leaves them.
pub(super) struct Texels {
    pattern: Pattern,
    /// The cells that send anything, in order, each with the power of those up to it as a share of all.
    until: Vec<(usize, f64)>,
    /// For each texel, how often it is chosen for each square metre of its cell.
    densities: Vec<f64>,
}

/// Texels as a point sees them.
pub(super) struct SeenTexels<'a> {
    texels: &'a Texels,
    /// In the point's frame.
    grid: PatternGrid,
}

impl Texels {
    /// Of the part with these vertices; `radiance` is that of the light.
    pub fn new(pattern: &Pattern, radiance: DVec3, part: &[DVec3]) -> Self {
        let grid = pattern.grid(|point| point);
        let sent = |cell: usize| luminance(radiance * pattern.image.texels[cell].as_dvec3());
        let powers = grid.areas(part).into_iter().map(|(cell, area)| (cell, area * sent(cell)));
        let powers: Vec<(usize, f64)> = powers.filter(|(_, power)| *power > 0.0).collect();
        let whole: f64 = powers.iter().map(|(_, power)| power).sum();
        let mut densities = vec![0.0; pattern.image.texels.len()];
        let mut sum = 0.0;
        let until = |&(cell, power): &(usize, f64)| {
            densities[cell] = power / whole / grid.cell_area();
            sum += power;
            (cell, sum / whole)
        };
        let until = powers.iter().map(until).collect();
        Self { pattern: pattern.clone(), until, densities }
    }

    /// As seen from where `place` takes the world's points: a turn and a shift.
    pub fn seen(&self, place: impl Fn(DVec3) -> DVec3) -> SeenTexels<'_> {
        SeenTexels { texels: self, grid: self.pattern.grid(place) }
    }
}

impl SeenTexels<'_> {
    /// The factor of the light's radiance at a point of it, and how many samples are expected there per square metre.
    pub fn at(&self, point: DVec3) -> (DVec3, f64) {
        let cell = self.grid.cell(point);
        (self.texels.pattern.image.texels[cell].as_dvec3(), self.texels.densities[cell])
    }

    /// A point of a texel's cell, which may lie beside the part; none where no texel sends anything.
    pub fn sample(&self, choice: f64, uniforms: [f64; 2]) -> Option<DVec3> {
        let until = &self.texels.until;
        let found = until.partition_point(|(_, until)| *until <= choice);
        let (cell, _) = until.get(found).or(until.last())?;
        Some(self.grid.point(*cell, uniforms))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64;
    use std::sync::Arc;

    use crate::scene::PatternImage;

    /// Texels of a triangle that cuts through cells: each is found as often as its density says, and all together once.
    #[test]
    fn texels_are_found_as_often_as_their_densities_say() {
        const SAMPLES: u32 = 100_000;
        let texels = (0..12).map(|at| Vec3::new((at % 5) as f32, 0.5, (at % 3) as f32)).collect();
        let image = Arc::new(PatternImage { size: [4, 3], texels });
        let axes = [Vec3::new(4.0, 0.0, 0.0), Vec3::new(0.0, 0.0, -6.0)];
        let pattern = Pattern { origin: Vec3::new(1.0, 2.0, 3.0), axes, image };
        let part = [DVec3::new(1.0, 2.0, 3.0), DVec3::new(5.0, 2.0, 3.0), DVec3::new(3.0, 2.0, -3.0)];
        let texels = Texels::new(&pattern, DVec3::new(1.0, 2.0, 0.5), &part);
        let seen = texels.seen(|point| point);
        let whole: f64 = texels.densities.iter().map(|density| density * seen.grid.cell_area()).sum();
        assert!((whole - 1.0).abs() < 1e-12, "{whole}");
        let mut counts = [0u32; 12];
        let mut rng = Pcg64::seed_from_u64(2);
        for _ in 0..SAMPLES {
            let point = seen.sample(rng.random(), [rng.random(), rng.random()]).expect("it is bright");
            counts[seen.grid.cell(point)] += 1;
        }
        for (count, density) in counts.into_iter().zip(&texels.densities) {
            let share = density * seen.grid.cell_area();
            let deviation = (share * (1.0 - share) / f64::from(SAMPLES)).sqrt();
            // 4 standard errors: 12 comparisons are off once in 1300 sets of them.
            assert!((f64::from(count) / f64::from(SAMPLES) - share).abs() <= 4.0 * deviation, "{count} {share}");
        }
    }
}
