//! Ten million polygons by the shipped file on a device, against the reference in `f64`, which is fed the same `f32`.

use crate::polygons::{self, Case, Space, Stand};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

const CASES: usize = 10_000_000;
/// Cases that are on the device at a time.
const BATCH: usize = 200_000;
/// Cases that share a seed.
const RUN: usize = 1000;

/// Anything that has troubled area lights: points far from them, over them and beside them, thin lights, all sizes, a
/// hair above the surface, a hair from an edge; with a lobe of the sheen or of the specular base.
fn adversary(random: &mut Pcg64) -> Case {
    loop {
        let specular = random.random();
        // A narrow lobe at a grazing angle enlarges the rounding of what is too near, by at most c / a.
        let hair = if specular { 1e-5 } else { 1e-6 };
        let mut near = |low, high| polygons::log_uniform(random, low, high);
        let wide = near(0.1, 1.0);
        let (stand, thinness) = match near(1.0, 64.0).log2() as u32 {
            0 => (Stand::Away(near(0.3, 1e3)), wide),
            1 => (Stand::Over(near(1e-3, 1.0)), wide),
            2 => (Stand::Over(near(2e-6, 1e-3)), wide),
            3 => (Stand::BesideEdge(near(1e-3, 1.0)), wide),
            4 => (Stand::BesideEdge(near(hair, 1e-3)), wide),
            _ => (Stand::Away(near(0.3, 10.0)), near(1e-5, 0.1)),
        };
        let (size, alpha) = (near(1e-3, 1e4), near(1e-3, 1.0));
        let outline = polygons::outline(random, thinness);
        let stand = polygons::stand(random, &outline, stand);
        let mut case = polygons::place(random, &outline, stand, size, Space::Local);
        if specular {
            case.m_inv = polygons::specular_lobe(random, alpha);
        }
        // Points that the shader takes for being in the light's plane have a test of their own.
        if case.height() > 6e-7 {
            return case;
        }
    }
}

/// Greatest and mean errors of the diffuse lobe, of the sheen and of the specular base.
#[derive(Clone, Copy, Debug, Default)]
struct Errors {
    greatest: [f64; 3],
    sum: [f64; 3],
    count: [usize; 3],
}

impl Errors {
    fn of(case: &Case, found: [f32; 2]) -> Self {
        let mut errors = Self::default();
        let lobe = if case.m_inv.x_axis.x == case.m_inv.y_axis.y { 1 } else { 2 };
        for ((exact, found), lobe) in case.exact().into_iter().zip(found).zip([0, lobe]) {
            assert!((0.0..=1.0).contains(&found), "{found} for {case:?}");
            let error = (f64::from(found) - exact).abs();
            (errors.greatest[lobe], errors.sum[lobe], errors.count[lobe]) = (error, error, 1);
        }
        errors
    }

    fn and(self, other: Self) -> Self {
        Self {
            greatest: std::array::from_fn(|lobe| self.greatest[lobe].max(other.greatest[lobe])),
            sum: std::array::from_fn(|lobe| self.sum[lobe] + other.sum[lobe]),
            count: std::array::from_fn(|lobe| self.count[lobe] + other.count[lobe]),
        }
    }
}

#[test]
fn ten_million_polygons_are_within_the_stated_errors() {
    let mut errors = Errors::default();
    for batch in 0..CASES / BATCH {
        let seeds = batch * BATCH / RUN..(batch + 1) * BATCH / RUN;
        let cases: Vec<Case> = seeds
            .into_par_iter()
            .flat_map_iter(|seed| {
                let mut random = Pcg64::seed_from_u64(seed as u64);
                (0..RUN).map(move |_| adversary(&mut random))
            })
            .collect();
        let found = polygons::shaded(&cases);
        let of = |(case, &found)| Errors::of(case, found);
        errors = errors.and(cases.par_iter().zip(&found).map(of).reduce(Errors::default, Errors::and));
    }
    let mean: [f64; 3] = std::array::from_fn(|lobe| errors.sum[lobe] / errors.count[lobe] as f64);
    let shown = |errors: [f64; 3]| errors.map(|error| format!("{error:.1e}")).join(" ");
    println!("diffuse, sheen, specular: greatest {}, mean {}", shown(errors.greatest), shown(mean));
    assert!(errors.greatest.iter().all(|&error| error <= 1e-4) && mean.iter().all(|&error| error <= 1e-6));
}
