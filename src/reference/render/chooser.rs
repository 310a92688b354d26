//! How polygons are sampled: by which lobe and, where there are many, on which polygon, in proportion to the light that
//! the lobe scatters from it to the view.
//!
//! A lobe that is a transformed cosine is sampled over a polygon with its own density, so that the estimate is exact
//! but for what stands in the way; for a lobe that only resembles one, the ratio of the two is left as noise. A polygon
//! that shows a pattern is sampled by the light that its texels send, too, and both are weighed as one mixture.

use glam::DVec3;
use smallvec::SmallVec;

use super::lights::{Lit, Seen};
use super::luminance::luminance;
use crate::table::Ltc;

/// The share of the samples on a light of a pattern that go to its texels.
const TEXELS: f64 = 0.5;

/// The transformed cosines that lights are sampled by, each with its colour.
pub(super) type Sampled = SmallVec<[(DVec3, Ltc); 4]>;

/// The lights that a point sees, by the lobes that they are sampled with.
pub(super) struct Chooser<'a> {
    lobes: Sampled,
    parts: SmallVec<[Part<'a>; 4]>,
    /// What all parts are worth: the sum over lobes of colour, radiance and share of the lobe.
    worth: f64,
    /// How many samples are taken: one on each part, or fewer, each on a part that is chosen.
    samples: usize,
}

/// A part of a light.
struct Part<'a> {
    seen: Seen<'a>,
    /// What each lobe is worth there.
    by_lobe: SmallVec<[f64; 4]>,
    worth: f64,
    /// The worth of the parts up to this one, as a share of that of all; not a number where none is worth anything.
    until: f64,
}

impl<'a> Chooser<'a> {
    /// Samples the parts of lights that are seen, by these lobes, with `most` samples at most.
    pub fn new(lobes: Sampled, seen: SmallVec<[Seen<'a>; 4]>, most: usize) -> Self {
        let mut sum = 0.0;
        let part = |seen: Seen<'a>| {
            let by_lobe: SmallVec<[f64; 4]> =
                lobes.iter().map(|(color, ltc)| worth(*color, seen.radiance()) * seen.share(ltc)).collect();
            let worth: f64 = by_lobe.iter().sum();
            sum += worth;
            Part { seen, by_lobe, worth, until: sum }
        };
        let mut parts: SmallVec<[Part; 4]> = seen.into_iter().map(part).collect();
        parts.iter_mut().for_each(|part| part.until /= sum);
        let samples = if sum > 0.0 { parts.len().min(most) } else { 0 };
        Self { lobes, parts, worth: sum, samples }
    }

    /// How many directions are to be sampled.
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// The lit direction `index` of [`Self::samples`], from three uniform numbers in \[0, 1); none on a part that sends
    /// nothing.
    pub fn sample(&self, index: usize, [choice, uniforms @ ..]: [f64; 3]) -> Option<Lit> {
        let (part, choice) = if self.samples == self.parts.len() {
            (self.parts.get(index)?, choice)
        } else {
            // Stratified: each sample has its own stretch of the parts.
            let at = (index as f64 + choice) / self.samples as f64;
            let found = self.parts.partition_point(|part| part.until <= at);
            let part = self.parts.get(found).or(self.parts.last())?;
            (part, ((part.until - at) * self.worth / part.worth).clamp(0.0, 1.0))
        };
        let by_texels = part.by_texels();
        if choice < by_texels {
            return part.seen.sample_texels(choice / by_texels, uniforms);
        }
        let mut rest = (choice - by_texels) / (1.0 - by_texels) * part.worth;
        let lobe = part.by_lobe.iter().position(|worth| {
            rest -= worth;
            rest < 0.0
        });
        // Rounding may lead past the last lobe, or to one that has no share.
        let lobe = lobe.or_else(|| part.by_lobe.iter().rposition(|worth| *worth > 0.0))?;
        part.seen.sample(&self.lobes[lobe].1, uniforms)
    }

    /// How many samples are expected per steradian in a direction on that part of a light.
    pub fn density(&self, lit: &Lit) -> f64 {
        if self.samples == 0 {
            return 0.0;
        }
        let density = |(color, ltc): &(DVec3, Ltc)| worth(*color, lit.mean) * ltc.density(lit.wo);
        let found: f64 = self.lobes.iter().map(density).sum();
        if self.samples < self.parts.len() && lit.by_texels.is_none() {
            return self.samples as f64 * found / self.worth;
        }
        let at = self.parts.binary_search_by_key(&lit.part, |part| part.seen.index());
        let Some(part) = at.ok().map(|at| &self.parts[at]).filter(|part| part.worth > 0.0) else { return 0.0 };
        let share = part.by_texels();
        let on_part = (1.0 - share) * found / part.worth + share * lit.by_texels.unwrap_or(0.0);
        let is_chosen = self.samples < self.parts.len();
        if is_chosen { on_part * self.samples as f64 * part.worth / self.worth } else { on_part }
    }

    /// The lights that lie in a direction, one behind the other.
    pub fn along(&self, wo: DVec3) -> impl Iterator<Item = Lit> + '_ {
        self.parts.iter().filter_map(move |part| part.seen.along(wo))
    }
}

impl Part<'_> {
    /// The share of its samples that go to texels.
    fn by_texels(&self) -> f64 {
        if self.seen.is_patterned() { TEXELS } else { 0.0 }
    }
}

/// How much a lobe's colour and a light's radiance are worth together.
fn worth(color: DVec3, radiance: DVec3) -> f64 {
    luminance(color * radiance)
}

#[cfg(test)]
mod tests {
    use super::super::lights::Lights;
    use super::*;
    use crate::scene::{Drawn, Edits, Instance, Light, Pattern, PatternImage, Polygon, Scene};
    use glam::{DMat3, Mat4, Vec3};
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64;
    use std::sync::Arc;

    /// Factors from 0 to 12.
    fn pattern(origin: [f32; 3], right: Vec3, up: Vec3, size: [u32; 2]) -> Pattern {
        let texel = |at: u32| Vec3::new((at * at % 5) as f32, (at % 3) as f32, if at == 4 { 12.0 } else { 0.3 });
        let image = Arc::new(PatternImage { size, texels: (0..size[0] * size[1]).map(texel).collect() });
        Pattern { origin: Vec3::from(origin), axes: [right, up], image }
    }

    /// A ring with a hole, an L, and a rectangle that reaches below the horizon, of different radiance; some of them
    /// with patterns.
    fn scene(is_patterned: bool) -> Scene {
        let plane = |corners: &[[f32; 2]], z: f32| corners.iter().map(|&[x, y]| Vec3::new(x, y, z)).collect::<Vec<_>>();
        let square = |half: f32| [[-half, half], [half, half], [half, -half], [-half, -half]];
        let hole: Vec<[f32; 2]> = square(0.4).into_iter().rev().collect();
        let letter = [[1.0, 0.0], [1.0, 0.8], [1.3, 0.8], [1.3, 0.3], [1.9, 0.3], [1.9, 0.0]];
        let upright = [[-1.0, -0.5], [-1.0, 0.6], [1.0, 0.6], [1.0, -0.5]].map(|[x, z]| Vec3::new(x, 1.5, z));
        let light = |contours: Vec<Vec<Vec3>>, normal, radiance| Light {
            name: String::new(),
            radiance,
            two_sided: false,
            polygons: vec![Polygon { contours, normal, pattern: None }],
            instance: 0,
            ..Light::default()
        };
        let mut lights = vec![
            light(vec![plane(&square(0.8), 1.0), plane(&hole, 1.0)], Vec3::NEG_Z, Vec3::new(3.0, 1.0, 0.5)),
            light(vec![plane(&letter, 0.7)], Vec3::NEG_Z, Vec3::new(0.5, 2.0, 1.0)),
            light(vec![upright.to_vec()], Vec3::NEG_Y, Vec3::new(1.0, 1.0, 4.0)),
        ];
        if is_patterned {
            lights[0].polygons[0].pattern = Some(pattern([-0.8, 0.8, 1.0], Vec3::X * 1.6, Vec3::Y * -1.6, [7, 5]));
            lights[2].polygons[0].pattern = Some(pattern([-1.2, 1.5, -0.5], Vec3::X * 2.2, Vec3::Z * 1.3, [3, 4]));
        }
        let lamp = Instance { name: String::new(), mesh: 0, world_from_mesh: Mat4::IDENTITY };
        Scene { lights, instances: vec![lamp], ..Scene::default() }
    }

    /// What the lights send into lobes, by samples on the lights and by samples of the lobes: two ways to one number.
    #[test]
    fn lights_and_lobes_find_the_same_light() {
        const SAMPLES: u32 = 40_000;
        for is_patterned in [false, true] {
            compare(&scene(is_patterned), is_patterned, SAMPLES);
        }
    }

    fn compare(scene: &Scene, is_patterned: bool, samples: u32) {
        let drawn = Drawn::new(scene, &Edits::default());
        let lights = Lights::new(&drawn);
        let mut rng = Pcg64::seed_from_u64(3);
        let up = [DVec3::Z, DVec3::new(0.3, -0.2, 0.9).normalize()];
        for (up, most) in up.into_iter().flat_map(|up| [(up, 1), (up, 3), (up, 100)]) {
            let lobes: [(DVec3, Ltc); 2] = [
                (DVec3::new(0.9, 0.4, 0.2), Ltc { a: 0.4, b: -0.5, c: 0.4 }),
                (DVec3::new(0.1, 0.5, 0.6), Ltc { a: 1.0, b: 0.0, c: 1.0 }),
            ];
            let point = DVec3::new(0.1, -0.2, 0.05);
            let chooser = Chooser::new(lobes.into_iter().collect(), lights.seen(point, DMat3::IDENTITY, up), most);
            let value = |wo: DVec3| lobes.iter().map(|(color, ltc)| *color * ltc.density(wo)).sum::<DVec3>();
            let mut sums = [DVec3::ZERO; 2];
            let mut squares = DVec3::ZERO;
            for _ in 0..samples {
                for index in 0..chooser.samples() {
                    let lit = chooser.sample(index, [rng.random(), rng.random(), rng.random()]);
                    // A texel may lie beside its part.
                    assert!(lit.is_some() || is_patterned);
                    let Some(lit) = lit else { continue };
                    assert!(lit.wo.z > 0.0 && up.dot(lit.wo) > -1e-9);
                    sums[0] += value(lit.wo) * lit.radiance / chooser.density(&lit);
                }
                // One sample of each lobe, weighted by its colour.
                for (color, ltc) in &lobes {
                    let wo = ltc.sample([rng.random(), rng.random()]);
                    let found: DVec3 = chooser.along(wo).map(|lit| *color * lit.radiance).sum();
                    sums[1] += found;
                    squares += found * found;
                }
            }
            let [by_lights, by_lobes] = sums.map(|sum| sum / f64::from(samples));
            let error = (squares / f64::from(samples)).map(f64::sqrt) / f64::from(samples).sqrt();
            assert!((by_lights - by_lobes).abs().cmple(4.0 * error).all(), "{by_lights} {by_lobes} {error}");
            assert!(by_lobes.cmpgt(20.0 * error).all(), "{by_lobes} is lost in {error}");
        }
    }
}
