//! Explicit fibres: they are planted and met as their documentation says, and their single scattering is the slab's.

use crate::direction;
use crate::statistics::{REJECTED, SIGNIFICANCE, assert_within, chi_square};
use glam::DVec3;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use velour::figures::fibres::{Axes, Ball, Fate, Fibre, Goniometer, Passage, Patch, Planting};
use velour::math::quadrature::gauss_legendre;
use velour::math::warp::{uniform, unit_sphere};
use velour::physics::sggx::Sggx;
use velour::physics::slab::{Slab, sigma_from_alpha};
use velour::physics::transport::{Resolution, Transport};

const SIGMAS: [f64; 6] = [1.0, 0.9999, 0.64, 0.16, 0.04, 0.001];

/// Fibres so thick that it would show if only thin ones had the slab's extinction.
fn planting(alpha: f64, diameter: f64) -> Planting {
    Planting { alpha, diameter, length: 0.7, seed: 5 }
}

#[test]
fn normals_of_the_fibres_are_those_of_the_flakes() {
    for sigma in SIGMAS {
        let (axes, medium) = (Axes::new(sigma), Sggx::new(sigma));
        for degrees in [0.0_f64, 1.0, 20.0, 45.0, 70.0, 85.0, 89.0, 90.0] {
            let (s, m_z) = degrees.to_radians().sin_cos();
            // c = s sin(t) removes the pole of the root; panels are narrow where p is steep.
            let edges = [0.0, 0.5, 0.8, 0.9, 0.97, 0.99, 0.997, 0.999, 0.9997, 1.0].map(|edge| FRAC_PI_2 * edge);
            let nodes = edges.windows(2).flat_map(|edge| gauss_legendre(40, edge[0], edge[1]));
            let integral: f64 = nodes.map(|(t, weight)| weight * axes.density((s * t.sin()).min(1.0))).sum();
            let (found, truth) = (axes.cover() / PI * integral, medium.flake_density(m_z));
            assert!((found / truth - 1.0).abs() < 1e-6, "sigma {sigma}, {degrees} degrees: {found}, {truth}");
        }
    }
}

#[test]
fn shares_below_are_the_densitys() {
    for sigma in SIGMAS {
        let axes = Axes::new(sigma);
        assert!((axes.share_below(1.0) - 1.0).abs() < 1e-14);
        let mut mean = 0.0;
        for c in [0.01, 0.3, 0.9, 0.99] {
            let [one, other] = [c - 1e-5, c + 1e-5].map(|c| axes.share_below(c));
            let slope = (other - one) / 2e-5 / 2.0;
            assert!((slope / axes.density(c) - 1.0).abs() < 1e-5, "sigma {sigma}, c {c}");
        }
        // With c = 1 - v^3 nodes are dense where the shares rise.
        for (v, weight) in gauss_legendre(80, 0.0, 1.0) {
            mean += 3.0 * v * v * weight * (1.0 - axes.share_below(1.0 - v.powi(3)));
        }
        assert!((mean - axes.mean_cosine()).abs() < 1e-4, "sigma {sigma}: {mean}, {}", axes.mean_cosine());
    }
}

/// The mean of some values, and its standard error.
fn mean(values: &[f64]) -> [f64; 2] {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let square = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / n;
    [mean, (square / n).sqrt()]
}

#[test]
fn the_sampled_fibres_are_seen_as_the_slab_sees_its_flakes() {
    for sigma in SIGMAS {
        let (axes, medium) = (Axes::new(sigma), Sggx::new(sigma));
        let mut rng = Pcg64::seed_from_u64(1);
        let sampled: Vec<DVec3> = (0..200_000).map(|_| axes.sample(&mut rng)).collect();
        for mu in [0.0, 0.3, 0.7, 0.95, 1.0] {
            let seen: Vec<f64> =
                sampled.iter().map(|axis| axes.cover() * direction(mu, 1.0).cross(*axis).length()).collect();
            let [seen, error] = mean(&seen);
            assert_within(seen, medium.extinction(mu), error, 4.0, &format!("sigma {sigma}, mu {mu}"));
        }
        // Each tenth of the distribution holds a tenth of the axes.
        let mut counts = [0; 10];
        sampled.iter().for_each(|axis| counts[((axes.share_below(axis.z.min(1.0)) * 10.0) as usize).min(9)] += 1);
        let p = chi_square(&counts, &[0.1; 10], 1e-12);
        assert!(p > SIGNIFICANCE, "sigma {sigma}: {counts:?}, p = {p:.1e}");
    }
}

/// The share of rays that a fibre stops within `reach`, and the number of rays. They have cosines to the normal of
/// -`mu` and `mu`, and start anywhere in the layer from where they cannot leave it.
fn stopped(patch: &Patch, mu: f64, reach: f64, seed: u64) -> (f64, f64) {
    let rays = 20_000;
    let mut rng = Pcg64::seed_from_u64(seed);
    let room = 1.0 - mu * reach;
    assert!(room > 0.0);
    let mut stops = || {
        let upwards = uniform(&mut rng) < 0.5;
        let z = room * uniform(&mut rng) + if upwards { 0.0 } else { mu * reach };
        let [x, y] = [(); 2].map(|()| patch.period() * uniform(&mut rng));
        let along = direction(if upwards { mu } else { -mu }, TAU * uniform(&mut rng));
        patch.first(DVec3::new(x, y, z), along).is_some_and(|hit| hit.distance < reach)
    };
    let stopped = (0..rays).filter(|_| stops()).count();
    (stopped as f64 / f64::from(rays), f64::from(rays))
}

/// How many standard errors rays are off the slab's extinction, in the worst of some directions.
fn extinction_off(patch: &Patch, slab: &Slab) -> f64 {
    let cells = [0.0, 0.3, 0.6, 0.9, 1.0].into_iter().flat_map(|mu| [(mu, 0.3), (mu, 0.9)]);
    let off = cells.enumerate().par_bridge().map(|(index, (mu, reach))| {
        let truth = -(-slab.medium().extinction(mu) * reach).exp_m1();
        let (share, rays) = stopped(patch, mu, reach, 20 + index as u64);
        (share - truth).abs() / (truth * (1.0 - truth) / rays).sqrt()
    });
    off.reduce(|| 0.0, f64::max)
}

/// So many more fibres than rays that the rays are nearly independent.
const FIBRES: usize = 100_000;

#[test]
fn extinction_is_the_slabs_for_thin_fibres_and_thick_ones() {
    for (alpha, diameter) in [(0.2, 0.01), (0.5, 0.01), (1.0, 0.01), (0.5, 0.15)] {
        let off = extinction_off(&Patch::new(&planting(alpha, diameter), FIBRES), &Slab::new(alpha));
        // Ten cells, each with a chance of 6e-5.
        assert!(off < 4.0, "alpha {alpha}, diameter {diameter}: {off:.1} standard errors");
    }
}

/// The patch of a planting, with its fibres changed.
fn changed(planting: &Planting, change: impl Fn(usize, Fibre) -> Option<Fibre>) -> Patch {
    let patch = Patch::new(planting, FIBRES);
    let inside = |fibre: &&Fibre| [fibre.middle.x, fibre.middle.y].iter().all(|x| (0.0..patch.period()).contains(x));
    let fibres = patch.forest().fibres().iter().filter(inside).enumerate();
    let fibres: Vec<Fibre> = fibres.filter_map(|(index, fibre)| change(index, *fibre)).collect();
    Patch::from_fibres(&fibres, planting.diameter / 2.0, patch.period(), 0.1)
}

#[test]
fn wrong_fibres_are_told() {
    let (planting, slab) = (planting(0.5, 0.01), Slab::new(0.5));
    let same = extinction_off(&changed(&planting, |_, fibre| Some(fibre)), &slab);
    assert!(same < 4.0, "{same}");
    let upright = extinction_off(&changed(&planting, |_, fibre| Some(Fibre { axis: DVec3::Z, ..fibre })), &slab);
    let sparse = extinction_off(&changed(&planting, |index, fibre| (index % 20 != 0).then_some(fibre)), &slab);
    let other = extinction_off(&Patch::new(&planting, FIBRES), &Slab::new(0.53));
    assert!(upright.min(sparse).min(other) > 5.0, "{upright} upright, {sparse} sparse, {other} of another slab");
}

const ELEVATIONS: usize = 24;
const AZIMUTHS: usize = 16;

/// The bin of a direction, by the cosine's cube root, fine at the horizon, and by the azimuth.
fn bin(w: DVec3) -> usize {
    let part = |x: f64, parts: usize| ((x * parts as f64) as usize).min(parts - 1);
    part((w.z.cbrt() + 1.0) / 2.0, ELEVATIONS) * AZIMUTHS + part(w.y.atan2(w.x).rem_euclid(TAU) / TAU, AZIMUTHS)
}

/// The integral over each bin of the phase function, for light that goes along `along`.
fn phase_shares(medium: &Sggx, along: DVec3) -> Vec<f64> {
    let share = |at: usize| {
        let (low, first) = ((at / AZIMUTHS) as f64, (at % AZIMUTHS) as f64 * TAU / AZIMUTHS as f64);
        let root = |k: f64| 2.0 * k / ELEVATIONS as f64 - 1.0;
        let mut share = 0.0;
        for (x, x_weight) in gauss_legendre(14, root(low), root(low + 1.0)) {
            for (phi, phi_weight) in gauss_legendre(10, first, first + TAU / AZIMUTHS as f64) {
                share += 3.0 * x * x * x_weight * phi_weight * medium.phase(-along, direction(x.powi(3), phi));
            }
        }
        share
    };
    (0..ELEVATIONS * AZIMUTHS).map(share).collect()
}

#[test]
fn light_is_scattered_once_as_by_the_flakes() {
    for (alpha, diameter, mu) in [(1.0, 0.01, 0.4), (0.7, 0.1, -0.7), (0.5, 0.01, 0.3), (0.5, 0.01, -0.9)] {
        let patch = Patch::new(&planting(alpha, diameter), FIBRES);
        let along = direction(mu, 0.1);
        let mut rng = Pcg64::seed_from_u64(3);
        let mut counts = vec![0; ELEVATIONS * AZIMUTHS];
        for _ in 0..40_000 {
            let [x, y, z] = [patch.period(), patch.period(), 1.0].map(|side| side * uniform(&mut rng));
            if let Some(hit) = patch.first(DVec3::new(x, y, z), along) {
                counts[bin(hit.mirrored(along))] += 1;
            }
        }
        let p = |alpha: f64| chi_square(&counts, &phase_shares(&Sggx::new(sigma_from_alpha(alpha)), along), 2e-3);
        assert!(p(alpha) > SIGNIFICANCE, "alpha {alpha}, mu {mu}: p = {:.1e}", p(alpha));
        assert!(p(alpha * 0.9) < REJECTED, "alpha {alpha}, mu {mu} is taken for another: p = {:.1e}", p(alpha * 0.9));
    }
}

#[test]
fn the_tree_finds_what_a_search_finds() {
    for (alpha, diameter) in [(0.1, 0.02), (0.5, 0.002), (1.0, 0.2)] {
        let patch = Patch::new(&planting(alpha, diameter), 2000);
        let ball = Ball::new(&Planting { length: 0.5, ..planting(alpha, 0.2) }, 1.0, 0.2);
        for (forest, size) in
            [(patch.forest(), DVec3::new(patch.period(), patch.period(), 1.0)), (ball.forest(), DVec3::ONE)]
        {
            let mut rng = Pcg64::seed_from_u64(9);
            let mut hits = 0;
            for k in 0..6000 {
                let origin = size * DVec3::from_array([(); 3].map(|()| uniform(&mut rng)));
                let mut along = unit_sphere(&mut rng);
                if k % 8 == 0 {
                    // Exactly or nearly parallel to planes of boxes.
                    along[k / 8 % 3] = [0.0, -0.0, 1e-9, -1e-9][k / 24 % 4];
                    along = along.normalize();
                }
                // The ball's tree finds nothing beyond its cube.
                let reach = (0..3).map(|axis| {
                    (if along[axis] > 0.0 { size[axis] - origin[axis] } else { -origin[axis] }) / along[axis]
                });
                let reach = reach.filter(|reach| reach.is_finite()).fold(f64::INFINITY, f64::min);
                let found = forest.first(origin, along, reach);
                assert_eq!(found, forest.first_of_all(origin, along, reach), "{origin} {along}");
                hits += usize::from(found.is_some());
            }
            assert!(hits > 600 && hits < 6000, "{hits} hits");
        }
    }
}

#[test]
fn sides_have_no_seam() {
    // With fibres longer than the patch is wide, too.
    for (count, length) in [(40, 0.5), (200, 0.7), (3, 3.0)] {
        let planting = Planting { alpha: 0.8, diameter: 0.1, length, seed: 4 };
        let patch = Patch::new(&planting, count);
        let period = patch.period();
        let inside = |fibre: &&Fibre| [fibre.middle.x, fibre.middle.y].iter().all(|x| (0.0..period).contains(x));
        let own: Vec<Fibre> = patch.forest().fibres().iter().filter(inside).copied().collect();
        assert_eq!(own.len(), count);
        let copies = (0..25).flat_map(|k| {
            let shift = DVec3::new(f64::from(k % 5), f64::from(k / 5), 0.0) * period;
            own.iter().map(move |fibre| Fibre { middle: fibre.middle + shift, ..*fibre })
        });
        let copies = Patch::from_fibres(&copies.collect::<Vec<_>>(), 0.05, 5.0 * period, 0.3);
        let mut rng = Pcg64::seed_from_u64(6);
        let (mut crossed, mut scattered) = (0, 0);
        for _ in 0..5000 {
            let origin = DVec3::new(period * uniform(&mut rng), period * uniform(&mut rng), uniform(&mut rng));
            let along = unit_sphere(&mut rng);
            let middle = origin + DVec3::new(2.0, 2.0, 0.0) * period;
            let [one, other] = [patch.first(origin, along), copies.first(middle, along)];
            assert_eq!(one.is_some(), other.is_some(), "{origin} {along}");
            if let (Some(one), Some(other)) = (one, other) {
                // Grazing hits lose digits: a distance is the root of a small number.
                assert!((one.distance - other.distance).abs() < 1e-6, "{origin} {along}: {one:?}, {other:?}");
                let to = origin + one.distance * along;
                crossed += usize::from([to.x, to.y].iter().any(|x| !(0.0..period).contains(x)));
            }
            let (one, other) = (patch.trace(origin, along), copies.trace(middle, along));
            let (Passage::Left { direction: one, scatterings }, Passage::Left { direction: other, scatterings: many }) =
                (one, other)
            else {
                panic!("a path is interrupted")
            };
            // Each mirror, having a small radius, enlarges round-off tenfold or more.
            if scatterings <= 4 {
                assert!(scatterings == many && (one - other).length() < 1e-3, "{origin} {along}: {one} {other}");
                scattered += usize::from(scatterings > 1);
            }
        }
        assert!(crossed > 300 && scattered > 300, "{crossed} of the rays cross a side, {scattered} scatter on");
    }
}

#[test]
fn every_path_leaves_and_counts_do_not_depend_on_threads() {
    let patch = Patch::new(&planting(0.4, 0.05), 20_000);
    let goniometer = Goniometer { mu: 0.3, paths: 5001, seed: 7 };
    let [one, three] = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads");
        pool.install(|| goniometer.measure(&patch))
    });
    assert_eq!(one, three);
    assert_eq!((one.paths(), one.interrupted), (5001, 0));
    let counts = &one.counts;
    assert_eq!(counts.reflected() + counts.transmitted() + counts.unscattered, 5001);
    assert!(one.scatterings > 5001 - counts.unscattered);
    assert_ne!(one, Goniometer { seed: 8, ..goniometer }.measure(&patch));
    let again = Patch::new(&planting(0.4, 0.05), 20_000);
    assert_eq!(one, goniometer.measure(&again));
}

#[test]
fn thin_fibres_reflect_as_the_slab_and_thick_ones_more() {
    let slab = Transport::new(Slab::new(1.0), Resolution { modes: 1, ..Default::default() });
    let goniometer = Goniometer { mu: 0.5, paths: 40_000, seed: 12 };
    let [thin, thick] = [0.003, 0.1].map(|diameter| {
        let patch = Patch::new(&planting(1.0, diameter), FIBRES);
        goniometer.measure(&patch).albedo()
    });
    assert_within(thin[0], slab.albedo(0.5), thin[1], 3.0, "thin fibres");
    // The ruler tells the two apart: light goes back by the way that it came, which is free.
    assert!((thick[0] - slab.albedo(0.5)) / thick[1] > 3.0, "{thick:?}, {}", slab.albedo(0.5));
}

#[test]
fn a_ball_is_planted_as_a_patch_is() {
    let (radius, thickness) = (2.0, 0.06);
    let planting = Planting { alpha: 1.0, diameter: 0.1, length: 0.7, seed: 2 };
    let ball = Ball::new(&planting, radius, thickness);
    let fibres = ball.forest().fibres();
    let area = 4.0 * PI * (radius / thickness + 0.5).powi(2);
    let axes = planting.axes();
    let reach = 1.0 + planting.length * axes.mean_cosine() + planting.diameter * axes.mean_sine();
    let expected = planting.number_density() * reach * area;
    assert!(fibres.len() > 200_000 && (fibres.len() as f64 / expected - 1.0).abs() < 0.02, "{}", fibres.len());
    let patch = Patch::new(&planting, 50_000);
    for mu in [0.4_f64, 0.9] {
        let mut rng = Pcg64::seed_from_u64(8);
        let rays = 10_000;
        let mut counts = [0_u64; 4];
        for _ in 0..rays {
            let normal = unit_sphere(&mut rng);
            let (tangent, _) = normal.any_orthonormal_pair();
            let wi = mu * normal + (1.0 - mu * mu).sqrt() * tangent;
            let fate = ball.trace((radius + thickness) * normal + wi, -wi);
            if let Fate::Left(exit) = fate {
                let distance = exit.origin.length();
                assert!(distance > radius - 1e-9 && distance < radius + thickness + 1e-9, "{exit:?}");
                assert!((exit.direction.length() - 1.0).abs() < 1e-12 && exit.scatterings > 0);
                // Going on from there, a ray meets nothing.
                let on = ball.trace(exit.origin + 1e-9 * exit.direction, exit.direction);
                assert_eq!(on, Fate::Missed, "{exit:?}");
            }
            counts[match fate {
                Fate::Missed => 0,
                Fate::Absorbed { .. } => 1,
                Fate::Left(_) => 2,
                Fate::Interrupted => 3,
            }] += 1;
        }
        assert_eq!(counts[3], 0);
        // A ray that is aimed at the ball does not miss it.
        assert_eq!(counts[0], 0, "{counts:?}");
        let share = counts[2] as f64 / f64::from(rays);
        let [flat, _] = Goniometer { mu, paths: 20_000, seed: 9 }.measure(&patch).albedo();
        // Light leaves a convex layer more easily: by twice its thickness in radii, 0.03, or less.
        assert!((-0.02..0.08).contains(&(share / flat - 1.0)), "mu {mu}: {share}, {flat}");
    }
    assert_eq!(ball.trace(DVec3::new(3.0, 0.0, 0.0), DVec3::X), Fate::Missed);
    assert_eq!(ball.trace(DVec3::new(3.0, 0.0, 0.0), DVec3::Y), Fate::Missed);
    assert_eq!(ball.trace(DVec3::new(-5.0, 2.2, 0.0), DVec3::X), Fate::Missed);
}
