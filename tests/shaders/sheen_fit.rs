//! The sheen without a table, run on the device, against the table.

use crate::{device, files};
use glam::{DMat3, DVec3};
use velour::reference::polygon::form_factor;
use velour::table::SheenTable;

/// Alpha from which the formulas are made to be used: the table's third node.
const LOW: f64 = 3.0 / 31.0;

/// Nodes of the table, and the places midway between them.
const SIDE: usize = 63;

/// a, b, r at each point, by the device.
fn formulas(points: &[[f32; 2]]) -> Vec<[f64; 3]> {
    let source = files::source("sheen_fit.wgsl") + include_str!("sheen_fit.wgsl");
    let found: Vec<[f32; 4]> = device::run(&source, &[bytemuck::cast_slice(points)], None, points.len());
    let abr = |[a, b, r, rest]: [f32; 4]| {
        assert_eq!(rest, 0.0, "the matrix has another shape");
        [a, b, r].map(f64::from)
    };
    found.into_iter().map(abr).collect()
}

fn grid(side: usize) -> Vec<[f32; 2]> {
    let at = |k: usize| k as f32 / (side - 1) as f32;
    (0..side * side).map(|index| [at(index / side), at(index % side)]).collect()
}

/// The greatest and mean error of a, b, r over points of a range of alpha.
fn errors(points: &[[f32; 2]], range: std::ops::Range<f64>, lookup: impl Fn(f64, f64) -> [f64; 3]) -> [[f64; 2]; 3] {
    let mut errors = [[0.0_f64; 2]; 3];
    let mut count = 0.0;
    for ([alpha, mu], found) in points.iter().map(|point| point.map(f64::from)).zip(formulas(points)) {
        if range.contains(&(alpha + 1e-6)) {
            count += 1.0;
            for ((error, found), expected) in errors.iter_mut().zip(found).zip(lookup(alpha, mu)) {
                let apart = (found - expected).abs();
                *error = [error[0].max(apart), error[1] + apart];
            }
        }
    }
    errors.map(|[max, sum]| [max, sum / count])
}

#[test]
fn errors_are_those_that_the_header_states() {
    let table = SheenTable::embedded();
    let points = grid(SIDE);
    let held = errors(&points, LOW..2.0, |alpha, mu| table.lookup(alpha, mu));
    let below = errors(&points, 0.0..LOW, |alpha, mu| table.lookup(alpha, mu));
    println!("alpha >= 3/31: {held:.4?}; below: {below:.4?}");
    for ([max, mean], bounds) in held.into_iter().zip([[0.054, 0.005], [0.016, 0.003], [0.036, 0.002]]) {
        assert!(max < bounds[0] && mean < bounds[1], "{held:?}");
    }
    for ([max, _], bound) in below.into_iter().zip([0.14, 0.02, 0.45]) {
        assert!(max < bound, "{below:?}");
    }
    // The ruler notices exchanged axes.
    assert!(errors(&points, LOW..2.0, |alpha, mu| table.lookup(mu, alpha)).iter().all(|[max, _]| *max > 0.1));
}

/// What MaterialX's closed form attains against the table that it was made for, where that has a lobe, for alpha >= 3/31
/// (`scripts/fit_formula --published`).
const MATERIALX: [[f64; 2]; 3] = [[0.0901, 0.01739], [0.0651, 0.00758], [0.0443, 0.00339]];

#[test]
fn each_number_is_nearer_to_its_table_than_materialx_is_to_the_published_one() {
    let table = SheenTable::embedded();
    let ours = errors(&grid(32), LOW..2.0, |alpha, mu| table.lookup(alpha, mu));
    for (ours, theirs) in ours.into_iter().zip(MATERIALX) {
        assert!(ours[0] < theirs[0] && ours[1] < theirs[1], "{ours:?} is not below {theirs:?}");
    }
}

#[test]
fn numbers_are_in_range_and_smooth_everywhere() {
    let side = 701;
    let lobes = formulas(&grid(side));
    for [a, b, r] in &lobes {
        assert!(*a > 0.002 && *a < 1.0 && *b <= 0.0 && *b > -0.2 && (0.0..1.0).contains(r), "{a}, {b}, {r}");
    }
    // From alpha = 0.1 on no number is much steeper than the table, along either axis. b has its root at mu = 1, and begins to rise at
    // mu = 0, within a cell of the table, over which that is flatter.
    let table = SheenTable::embedded();
    let nodes: Vec<[f64; 3]> = (0..32 * 32).map(|at| table.cell(at / 32, at % 32)).collect();
    let (formulas, table) = (greatest_steps(&lobes, side, side / 10), greatest_steps(&nodes, 32, 3));
    let finer = 31.0 / (side - 1) as f64;
    for axis in 0..2 {
        for (k, factor) in [1.25, 2.5, 1.25].into_iter().enumerate() {
            let (found, most) = (formulas[axis][k], factor * finer * table[axis][k]);
            assert!(found > 0.0 && found < most, "number {k} along axis {axis}: {found} over {most}");
        }
    }
}

/// The greatest differences of a, b, r between neighbours along alpha, and along mu, from a row of alpha on.
fn greatest_steps(points: &[[f64; 3]], side: usize, first: usize) -> [[f64; 3]; 2] {
    let mut greatest = [[0.0_f64; 3]; 2];
    for (alpha, mu) in (first..side).flat_map(|alpha| (0..side).map(move |mu| (alpha, mu))) {
        for (axis, (next_alpha, next_mu)) in [(alpha + 1, mu), (alpha, mu + 1)].into_iter().enumerate() {
            if next_alpha < side && next_mu < side {
                let (here, next) = (points[side * alpha + mu], points[side * next_alpha + next_mu]);
                for k in 0..3 {
                    greatest[axis][k] = greatest[axis][k].max((here[k] - next[k]).abs());
                }
            }
        }
    }
    greatest
}

#[test]
fn what_lies_outside_is_clamped() {
    let outside = [[-1.0, 0.5], [2.0, 0.5], [0.5, -0.1], [0.5, 1.0000001], [1e30, -1e30]];
    let inside = outside.map(|point: [f32; 2]| point.map(|value| value.clamp(0.0, 1.0)));
    assert_eq!(formulas(&outside), formulas(&inside));
}

/// The radiance that a lobe reflects of a light of radiance 1.
fn lit([a, b, r]: [f64; 3], light: &[DVec3]) -> f64 {
    let m_inv = DMat3::from_cols_array(&[a, 0.0, 0.0, 0.0, a, 0.0, b, 0.0, 1.0]);
    r * form_factor(&[light.to_vec()], m_inv, true)
}

/// Rectangles over the surface in the frame of the view, which is towards x: overhead, in front, behind, to the side, a strip at the horizon.
fn lights() -> [Vec<DVec3>; 5] {
    let rectangle = |center: [f64; 3], u: [f64; 3], v: [f64; 3]| {
        let [center, u, v] = [center, u, v].map(DVec3::from_array);
        vec![center - u - v, center + u - v, center + u + v, center - u + v]
    };
    [
        rectangle([0.0, 0.0, 2.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
        rectangle([2.0, 0.0, 1.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.8]),
        rectangle([-2.0, 0.0, 1.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.8]),
        rectangle([0.0, 2.0, 1.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.8]),
        rectangle([-3.0, 0.0, 0.4], [0.0, 4.0, 0.0], [0.0, 0.0, 0.4]),
    ]
}

/// Mean error over mean radiance, for alpha >= 3/31 and five lights.
#[test]
fn pictures_differ_by_hundredths() {
    let table = SheenTable::embedded();
    let points: Vec<[f32; 2]> = grid(32).into_iter().filter(|[alpha, _]| f64::from(*alpha) + 1e-6 >= LOW).collect();
    let (mut error, mut sum, mut greatest) = (0.0, 0.0, 0.0_f64);
    for ([alpha, mu], formula) in points.iter().zip(formulas(&points)) {
        let table = table.lookup(f64::from(*alpha), f64::from(*mu));
        for light in &lights() {
            let (found, expected) = (lit(formula, light), lit(table, light));
            error += (found - expected).abs();
            sum += expected;
            greatest = greatest.max((found - expected).abs());
        }
    }
    println!(
        "relative {:.4}, greatest {greatest:.4}, mean radiance {:.4}",
        error / sum,
        sum / (5.0 * points.len() as f64)
    );
    assert!(error / sum < 0.02 && greatest < 0.015);
}
