//! All pairs of polygons that overlap in the picture, and which of each is painted first.
//!
//! The picture is cut into strips, about as high as the polygons are on average, so that these take part in two or so
//! each; in a strip, the polygons' boxes are swept from left to right.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::PAIRS_MAX;
use super::overlap::{First, compare};
use super::polygon::Polygon;

/// The polygon that is painted first, and the one after it.
pub type Constraint = [u32; 2];

/// The most pairs of boxes that are looked at, whether they overlap or not: each takes a sixteenth of the time.
const LOOKS_MAX: usize = 16 * PAIRS_MAX;

/// The most strips.
const STRIPS_MAX: f64 = 65536.0;

/// A box around a polygon, rounded outwards.
#[derive(Clone, Copy)]
struct Entry {
    min: [f32; 2],
    max: [f32; 2],
    polygon: u32,
}

impl Entry {
    fn new((index, polygon): (usize, &Polygon)) -> Self {
        let [min, max] = polygon.bounds().map(|corner| [corner.x as f32, corner.y as f32]);
        Self { min: min.map(f32::next_down), max: max.map(f32::next_up), polygon: index as u32 }
    }
}

/// Where y falls, of so many strips.
fn strip(y: f32, strips: f64) -> usize {
    ((0.5 * f64::from(y) + 0.5) * strips).clamp(0.0, strips - 1.0) as usize
}

/// The constraints, one for each pair that overlaps, in several lists; none where there are too many.
pub fn find(polygons: &[Polygon]) -> Option<Vec<Vec<Constraint>>> {
    let entries: Vec<Entry> = polygons.par_iter().enumerate().map(Entry::new).collect();
    let heights: f64 = entries.iter().map(|entry| f64::from(0.5 * (entry.max[1] - entry.min[1]))).sum();
    let strips = (entries.len() as f64 / heights).clamp(1.0, STRIPS_MAX).floor();
    let mut buckets: Vec<Vec<Entry>> = vec![Vec::new(); strips as usize];
    for entry in entries {
        let [first, last] = [entry.min, entry.max].map(|corner| strip(corner[1], strips));
        buckets[first..=last].iter_mut().for_each(|bucket| bucket.push(entry));
    }
    buckets.par_iter_mut().for_each(|bucket| {
        bucket.sort_unstable_by(|one, other| one.min[0].total_cmp(&other.min[0]).then(one.polygon.cmp(&other.polygon)));
    });
    // To count first costs little, and where there are too many that is all.
    let budget = Budget::default();
    let strip_of = |y: f32| strip(y, strips);
    let count = |(index, bucket): (usize, &Vec<Entry>)| {
        pairs(bucket, |y| strip_of(y) == index).try_for_each(|(looks, pairs)| budget.spend(looks, pairs.count()))
    };
    buckets.par_iter().enumerate().try_for_each(count)?;
    let compare = |(index, bucket): (usize, &Vec<Entry>)| {
        let pairs = pairs(bucket, |y| strip_of(y) == index).flat_map(|(_, pairs)| pairs);
        pairs.filter_map(|[one, other]| constraint(polygons, one, other)).collect()
    };
    Some(buckets.par_iter().enumerate().map(compare).collect())
}

/// For each box of a strip, from left to right: how many start to the right of its left side and to the left of its
/// right one, and the pairs that it makes with those of them that it overlaps. A pair is met in each strip that both are
/// in; it counts in the lowest, which is `own`.
fn pairs<'a>(
    bucket: &'a [Entry],
    own: impl Fn(f32) -> bool + Copy + 'a,
) -> impl Iterator<Item = (usize, impl Iterator<Item = [u32; 2]> + 'a)> {
    (0..bucket.len()).map(move |at| {
        let (one, rest) = (&bucket[at], &bucket[at + 1..]);
        let near = &rest[..rest.partition_point(|other| other.min[0] < one.max[0])];
        let meets = move |other: &&Entry| {
            let low = one.min[1].max(other.min[1]);
            low < one.max[1].min(other.max[1]) && own(low)
        };
        (near.len(), near.iter().filter(meets).map(|other| [one.polygon, other.polygon]))
    })
}

fn constraint(polygons: &[Polygon], one: u32, other: u32) -> Option<Constraint> {
    let [one, other] = [one.min(other), one.max(other)];
    match compare(&polygons[one as usize], &polygons[other as usize]) {
        First::One => Some([one, other]),
        First::Other => Some([other, one]),
        First::Either => None,
    }
}

/// What all strips together have looked at and found.
#[derive(Default)]
struct Budget {
    looks: AtomicUsize,
    pairs: AtomicUsize,
}

impl Budget {
    /// Counts more of it; none where that is too much. Whether some strip gets none depends on the sums alone.
    fn spend(&self, looks: usize, pairs: usize) -> Option<()> {
        let add = |sum: &AtomicUsize, more| sum.fetch_add(more, Ordering::Relaxed) + more;
        let (looks, pairs) = (add(&self.looks, looks), add(&self.pairs, pairs));
        (looks <= LOOKS_MAX && pairs <= PAIRS_MAX).then_some(())
    }
}
