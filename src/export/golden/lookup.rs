//! Lookups in the shipped tables, right and wrong.

use super::mistake::Mistake;
use crate::table::ggx::{GRAZING_MU, LEAST_ASPECT};
use crate::table::{GgxLobe, GgxTable, Ltc, SheenTable};
use std::sync::LazyLock;

/// The table as other engines have it: halves.
static SHEEN: LazyLock<SheenTable> = LazyLock::new(|| {
    let shipped = SheenTable::from_dds(include_bytes!("../../../tables/sheen_ltc.dds"));
    shipped.expect("the shipped table is built in and tests read it")
});
static GGX: LazyLock<GgxTable> = LazyLock::new(|| {
    let shipped = GgxTable::from_dds(include_bytes!("../../../tables/ggx_ltc.dds"));
    shipped.expect("the shipped table is built in and tests read it")
});

/// Error of what lies between two nodes, of numbers up to 1.
const NUMBER: f64 = 4e-7;
/// Error of both weights together: alpha and mu times 31 are rounded.
const WEIGHT: f64 = 3e-6;

/// `[a, b, r]` of the sheen.
pub(super) fn sheen(alpha: f64, mu: f64) -> [f64; 3] {
    SHEEN.lookup(alpha, mu)
}

/// How far `[a, b, r]` may be off: roundings of numbers up to 1, and a weight's error of what differs between the nodes around.
pub(super) fn sheen_error(alpha: f64, mu: f64) -> [f64; 3] {
    let [width, height] = SHEEN.size();
    let around = |x: f64, count: usize| {
        let at = x.clamp(0.0, 1.0) * (count - 1) as f64;
        // At a node rounding may lead into the cell beside it.
        (at - 1e-3).max(0.0) as usize..=((at + 1e-3) as usize + 1).min(count - 1)
    };
    let cells: Vec<[f64; 3]> =
        around(alpha, width).flat_map(|x| around(mu, height).map(move |y| SHEEN.cell(x, y))).collect();
    std::array::from_fn(|k| {
        let (least, most) =
            cells.iter().fold((f64::MAX, f64::MIN), |(least, most), cell| (least.min(cell[k]), most.max(cell[k])));
        NUMBER + WEIGHT * (most - least)
    })
}

/// The specular base's lobe.
pub(super) fn ggx(roughness: f64, mu: f64) -> GgxLobe {
    GGX.lookup(roughness, mu)
}

/// `[a, b, r]` where a mistake is made in the lookup or in what is taken from it.
pub(super) fn mistaken_sheen(alpha: f64, mu: f64, mistake: Mistake) -> Option<[f64; 3]> {
    let [a, b, r] = sheen(alpha, mu);
    let [width, height] = SHEEN.size();
    match mistake {
        Mistake::TableTransposed => Some(sheen(mu, alpha)),
        Mistake::AlphaSquared => Some(sheen(alpha * alpha, mu)),
        Mistake::BSign => Some([a, -b, r]),
        Mistake::NoHalfTexel => {
            let at = [sampled(alpha, width), sampled(mu, height)];
            Some(between([width, height], at, |x, y| SHEEN.cell(x, y)))
        }
        _ => None,
    }
}

/// The specular base's lobe, likewise.
pub(super) fn mistaken_ggx(roughness: f64, mu: f64, mistake: Mistake) -> Option<GgxLobe> {
    let right = ggx(roughness, mu);
    let [width, height] = GGX.size();
    let t = (1.0 - mu.clamp(0.0, 1.0)).sqrt();
    match mistake {
        Mistake::TableTransposed => {
            let at = [t * (width - 1) as f64, roughness.clamp(0.0, 1.0) * (height - 1) as f64];
            Some(lobe_of(between([width, height], at, |x, y| GGX.cell(x, y)), mu))
        }
        Mistake::AlphaSquared => Some(ggx(roughness * roughness, mu)),
        Mistake::BSign => Some(GgxLobe { ltc: Ltc { b: -right.ltc.b, ..right.ltc }, ..right }),
        Mistake::NoHalfTexel => {
            // Both halves are one texture, whose rows are filtered across the seam.
            let size = [width, 2 * height];
            let texel = |x: usize, y: usize| match (y < height, GGX.cell(x, y % height)) {
                (true, [u, v, s, ..]) => [u, v, s],
                (false, [.., albedo, fresnel]) => [albedo, fresnel, 0.0],
            };
            let x = sampled(roughness, width);
            let half = |part: f64| between(size, [x, sampled(0.5 * (t + part), 2 * height)], texel);
            let ([u, v, s], [albedo, fresnel, _]) = (half(0.0), half(1.0));
            Some(lobe_of([u, v, s, albedo, fresnel], mu))
        }
        _ => None,
    }
}

/// The lobe of a texel's numbers.
fn lobe_of([u, v, s, albedo, fresnel]: [f64; 5], mu: f64) -> GgxLobe {
    let m = mu.clamp(GRAZING_MU, 1.0);
    let c = s.powi(-2);
    let ltc = Ltc { a: c * (m * m + u).max(LEAST_ASPECT), b: c * (m * (1.0 - m * m).sqrt() + v), c };
    GgxLobe { ltc, albedo, fresnel }
}

/// Where a sampler that is given `u` in \[0, 1\] reads `n` texels, their centres at whole numbers; it clamps at the edges.
fn sampled(u: f64, n: usize) -> f64 {
    (u.clamp(0.0, 1.0) * n as f64 - 0.5).clamp(0.0, (n - 1) as f64)
}

/// Bilinear between texels.
fn between<const N: usize>(size: [usize; 2], at: [f64; 2], texel: impl Fn(usize, usize) -> [f64; N]) -> [f64; N] {
    let [(x, s), (y, t)] = [0, 1].map(|axis| {
        let low = (at[axis] as usize).min(size[axis] - 2);
        (low, at[axis] - low as f64)
    });
    let mix = |from: [f64; N], to: [f64; N], share: f64| std::array::from_fn(|k| from[k] + share * (to[k] - from[k]));
    mix(mix(texel(x, y), texel(x + 1, y), s), mix(texel(x, y + 1), texel(x + 1, y + 1), s), t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_follow_what_differs_between_nodes() {
        // Of r beside mu = 0, where it leaps, and where it is flat.
        let ([.., steep], [.., flat]) = (sheen_error(0.09, 0.03), sheen_error(0.9, 0.9));
        assert!(steep > 1e-6 && steep <= NUMBER + WEIGHT, "{steep}");
        assert!(flat > NUMBER && flat < 7e-7, "{flat}");
        // At a node the cells on both sides count.
        let at = sheen_error(10.0 / 31.0, 20.0 / 31.0);
        for (x, y) in [(9.5, 19.5), (10.5, 19.5), (9.5, 20.5), (10.5, 20.5)] {
            let beside = sheen_error(x / 31.0, y / 31.0);
            assert!(at.iter().zip(beside).all(|(at, beside)| *at >= beside));
        }
    }

    #[test]
    fn wrong_lookups_are_the_right_ones_where_the_mistake_is_undone() {
        for (roughness, mu) in [(0.3, 0.2), (0.71, 0.93), (0.05, 0.5)] {
            let t = f64::sqrt(1.0 - mu);
            let numbers = between([32, 32], [31.0 * roughness, 31.0 * t], |x, y| GGX.cell(x, y));
            let (made, right) = (lobe_of(numbers, mu), ggx(roughness, mu));
            for (made, right) in [(made.ltc.a, right.ltc.a), (made.ltc.b, right.ltc.b), (made.ltc.c, right.ltc.c)] {
                assert!((made - right).abs() < 1e-12 * right.abs(), "{made} {right}");
            }
            // A sampler that is told of the half texel.
            let told = |x: f64| (31.0 * x + 0.5) / 32.0;
            let found = mistaken_sheen(told(roughness), told(mu), Mistake::NoHalfTexel).unwrap();
            for (found, right) in found.into_iter().zip(sheen(roughness, mu)) {
                assert!((found - right).abs() < 1e-12, "{found} {right}");
            }
        }
    }
}
