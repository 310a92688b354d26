//! Which light is looked for, and by which lobe: in proportion to what they send to the view together.
//!
//! A lobe that is a transformed cosine is sampled over a polygon with its own density, so that its estimate is exact but for what
//! stands in the way; a lobe that only resembles one is left with the ratio of both.

use glam::DVec3;
use smallvec::SmallVec;

use super::lights::{Lit, Seen, worth};
use crate::table::SpecularLtc;

/// Lobes that lights are sampled by, each of a colour.
pub(super) type Sampled = SmallVec<[(DVec3, SpecularLtc); 4]>;

/// A lobe and a part of a light.
struct Choice {
    lobe: usize,
    seen: usize,
    /// The sum of these up to this one, over that of all.
    until: f64,
}

/// The lights that a point sees, by the lobes that they are sampled with.
pub(super) struct Chooser<'a> {
    lobes: Sampled,
    seen: SmallVec<[Seen<'a>; 4]>,
    choices: SmallVec<[Choice; 12]>,
    /// The sum of all choices' worth: of colour, radiance and share of the lobe.
    worth: f64,
}

impl<'a> Chooser<'a> {
    /// Of lobes, each of a colour.
    pub fn new(lobes: Sampled, seen: SmallVec<[Seen<'a>; 4]>) -> Self {
        let mut choices: SmallVec<[Choice; 12]> = SmallVec::with_capacity(lobes.len() * seen.len());
        let mut sum = 0.0;
        for (at, part) in seen.iter().enumerate() {
            for (lobe, (color, ltc)) in lobes.iter().enumerate() {
                let worth = worth(*color, part.radiance()) * part.share(ltc);
                if worth > 0.0 {
                    sum += worth;
                    choices.push(Choice { lobe, seen: at, until: sum });
                }
            }
        }
        choices.iter_mut().for_each(|choice| choice.until /= sum);
        Self { lobes, seen, choices, worth: sum }
    }

    /// A lit direction from three uniform numbers in \[0, 1).
    pub fn sample(&self, choice: f64, uniforms: [f64; 2]) -> Option<Lit> {
        let at = self.choices.partition_point(|one| one.until <= choice);
        let Choice { lobe, seen, .. } = self.choices.get(at).or(self.choices.last())?;
        self.seen[*seen].sample(&self.lobes[*lobe].1, uniforms)
    }

    /// The density with which [`Self::sample`] finds a direction on that part of a light, per steradian.
    pub fn pdf(&self, lit: &Lit) -> f64 {
        if self.choices.is_empty() {
            return 0.0;
        }
        let density = |(color, ltc): &(DVec3, SpecularLtc)| worth(*color, lit.radiance) * ltc.density(lit.wo);
        self.lobes.iter().map(density).sum::<f64>() / self.worth
    }

    /// What a direction meets of the lights, one behind the other.
    pub fn along(&self, wo: DVec3) -> impl Iterator<Item = Lit> + '_ {
        self.seen.iter().filter_map(move |seen| seen.along(wo))
    }
}
