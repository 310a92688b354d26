//! The table in `tables/`.

use velour::fit::hemisphere::Hemisphere;
use velour::fit::least_squares::{Free, LEAST_A, fit, squared_error};
use velour::fit::lobe::{LobeSolver, WalkSolver};
use velour::fit::ltc::Ltc;
use velour::fit::{GRAZING_MU, Options};
use velour::physics::slab::Slab;
use velour::table::LtcTable;

use crate::statistics::assert_within;

const NODES: usize = 32;

/// Nodes (alpha, mu) over the whole table, corners among them, with R from 2e-4 to 0.8.
const SOME: [(usize, usize); 10] =
    [(31, 31), (31, 0), (20, 12), (16, 31), (16, 3), (10, 24), (8, 10), (4, 4), (3, 1), (1, 0)];

#[test]
fn every_node_is_invertible_and_obeys_the_conventions() {
    let table = LtcTable::embedded();
    assert_eq!(table.size(), [NODES; 2]);
    for i in 0..NODES {
        for j in 0..NODES {
            let [a, b, r] = table.cell(i, j);
            assert!((LEAST_A..=1.0).contains(&a), "node ({i}, {j}): a {a}");
            assert!(b <= 0.0 && b > -0.25, "node ({i}, {j}): b {b}");
            assert!(r < 0.85 && (r > 0.0) == (i > 0), "node ({i}, {j}): r {r}");
        }
        assert_eq!(table.cell(i, NODES - 1)[1], 0.0, "b at mu = 1, alpha's node {i}");
        let [a, b, _] = table.cell(1, i);
        assert_eq!(table.cell(0, i), [a, b, 0.0], "alpha = 0, mu's node {i}");
    }
}

#[test]
fn texture_holds_the_same_numbers() {
    let bytes = include_bytes!("../../tables/sheen_ltc.dds");
    assert_eq!(LtcTable::embedded().to_dds(), bytes);
}

#[test]
fn header_tells_how_it_was_made() {
    let text = include_str!("../../tables/sheen_ltc.csv");
    assert!(text.lines().any(|line| line == "# Made by: velour fit"), "the command");
    assert!(text.lines().any(|line| line.starts_with("# Relative L2 error of the lobe")), "the errors");
}

/// The largest distance of a node's value from the middle of its two neighbours, along alpha or mu, over the nodes with
/// alpha > 0 where all three have r above `least_r`.
fn bumpiness(table: &LtcTable, least_r: f64, value: impl Fn([f64; 3]) -> f64) -> f64 {
    let mut largest = 0.0_f64;
    for k in 1..NODES {
        for middle in 2..NODES - 1 {
            let around = [middle - 1, middle, middle + 1];
            for cells in [around.map(|i| table.cell(i, k)), around.map(|j| table.cell(k, j))] {
                if cells.iter().all(|[_, _, r]| *r > least_r) {
                    let [before, at, after] = cells.map(&value);
                    largest = largest.max((at - (before + after) / 2.0).abs());
                }
            }
        }
    }
    largest
}

/// Largest [`bumpiness`] of ln(a), b, r where r > 1e-3. What there is of it is the lobe's own turn at (2/31, 2/31); noise is
/// a tenth of that in ln(a) and r, and most of it in b, which hardly matters where the lobe is nearly round.
const SMOOTH: [f64; 3] = [0.2, 0.03, 0.08];

/// The same for all nodes. At (1/31, 2/31) ln(a) bends sharply, where the lobe goes dark one node from the horizon; b has the
/// noise of the dimmest lobes that are fitted, which darker nodes copy.
const SMOOTH_IN_THE_DARK: [f64; 3] = [0.45, 0.05, 0.08];

fn bumpinesses(table: &LtcTable, least_r: f64) -> [f64; 3] {
    [
        bumpiness(table, least_r, |[a, _, _]| a.ln()),
        bumpiness(table, least_r, |[_, b, _]| b),
        bumpiness(table, least_r, |[_, _, r]| r),
    ]
}

#[test]
fn nodes_are_smooth_with_their_neighbours() {
    let table = LtcTable::embedded();
    for (least_r, limits) in [(1e-3, SMOOTH), (0.0, SMOOTH_IN_THE_DARK)] {
        let found = bumpinesses(&table, least_r);
        assert!(found.iter().zip(limits).all(|(found, limit)| *found < limit), "r > {least_r}: {found:?}");
    }
}

#[test]
fn a_node_out_of_line_is_told() {
    let table = LtcTable::embedded();
    let [a, b, r] = table.cell(12, 9);
    for wrong in [[a * 1.3, b, r], [a, b - 0.04, r], [a, b, r + 0.1]] {
        let mut cells = table.cells().to_vec();
        cells[12 * NODES + 9] = wrong;
        let found = bumpinesses(&LtcTable::new([NODES; 2], cells), 1e-3);
        assert!(found.iter().zip(SMOOTH).any(|(found, limit)| *found > limit), "{wrong:?}: {found:?}");
    }
}

#[test]
fn albedos_agree_with_fresh_walks() {
    let table = LtcTable::embedded();
    let (hemisphere, options) = (Hemisphere::default(), Options::default());
    for (i, j) in SOME {
        let [alpha, mu] = [i, j].map(|k| k as f64 / (NODES - 1) as f64);
        let paths = 100_000;
        let fresh = WalkSolver { paths, seed: 77 }.solve(Slab::new(alpha), mu.max(GRAZING_MU), &hemisphere);
        // The table's own noise is smaller by the square root of its paths.
        let error = fresh.albedo_error * (1.0 + paths as f64 / options.paths as f64).sqrt();
        assert_within(table.cell(i, j)[2], fresh.albedo, error, 3.0, &format!("r of node ({i}, {j})"));
    }
}

#[test]
fn matrices_are_the_best_for_fresh_lobes() {
    let table = LtcTable::embedded();
    let hemisphere = Hemisphere::default();
    for (i, j) in SOME {
        let [alpha, mu] = [i, j].map(|k| k as f64 / (NODES - 1) as f64);
        let lobe = WalkSolver { paths: 200_000, seed: 78 }.solve(Slab::new(alpha), mu.max(GRAZING_MU), &hemisphere);
        let shape: Vec<f64> = lobe.values.iter().map(|value| value / lobe.albedo).collect();
        let [a, b, _] = table.cell(i, j);
        let shipped = Ltc { a, b };
        let free = if mu == 1.0 { Free::OnlyA } else { Free::Both };
        let best = fit(&shape, &hemisphere, shipped, free);
        let norm = hemisphere.integral(|node| shape[node] * shape[node]);
        let least = squared_error(&shape, &hemisphere, best);
        let excess = |ltc| (squared_error(&shape, &hemisphere, ltc) - least) / norm;
        // The fresh lobe's noise moves its own minimum by that much, and a tenth more of a lies further off.
        let limit = 5e-4;
        assert!(excess(shipped) < limit, "node ({i}, {j}): {shipped:?}, {best:?}: {:.1e}", excess(shipped));
        let wrong = Ltc { a: a * 1.1, b };
        assert!(excess(wrong) > limit, "node ({i}, {j}): {wrong:?} passes: {:.1e}", excess(wrong));
    }
}
