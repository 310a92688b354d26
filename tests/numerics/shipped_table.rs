//! The table in `tables/`.

use velour::fit::lobe::Lobes;
use velour::fit::sheen::least_squares::{Free, LEAST_A, fit, squared_error};
use velour::fit::sheen::{self, GRAZING_MU};
use velour::fit::{DIM, Errors};
use velour::physics::slab::Slab;
use velour::physics::transport::{Resolution, Transport};
use velour::physics::walk::{FirstFlight, Walk};
use velour::table::{Ltc, SheenTable};

use crate::statistics::assert_within;

const NODES: usize = 32;

/// Nodes (alpha, mu) over the whole table, corners among them, with R from 2e-4 to 0.8.
const SOME: [(usize, usize); 10] =
    [(31, 31), (31, 0), (20, 12), (16, 31), (16, 3), (10, 24), (8, 10), (4, 4), (3, 1), (1, 0)];

fn solve(i: usize) -> Transport {
    Transport::new(Slab::new(i as f64 / 31.0), Resolution::default())
}

#[test]
fn every_node_is_invertible_and_obeys_the_conventions() {
    let table = SheenTable::embedded();
    assert_eq!(table.size(), [NODES; 2]);
    for i in 0..NODES {
        for j in 0..NODES {
            let [a, b, r] = table.cell(i, j);
            assert!((LEAST_A..=1.0).contains(&a), "node ({i}, {j}): a {a}");
            assert!(b <= 0.0 && b > -0.25, "node ({i}, {j}): b {b}");
            assert!(r <= 1.0 && (r > 0.0) == (i > 0), "node ({i}, {j}): r {r}");
        }
        assert_eq!(table.cell(i, NODES - 1)[1], 0.0, "b at mu = 1, alpha's node {i}");
        let [a, b, _] = table.cell(1, i);
        assert_eq!(table.cell(0, i), [a, b, 0.0], "alpha = 0, mu's node {i}");
    }
}

#[test]
fn texture_holds_the_same_numbers() {
    let bytes = include_bytes!("../../tables/sheen_ltc.dds");
    assert_eq!(SheenTable::embedded().to_dds(), bytes);
}

#[test]
fn header_tells_how_it_was_made() {
    let text = include_str!("../../tables/sheen_ltc.csv");
    assert!(text.lines().any(|line| line == "# Made by: velour fit"), "the command");
    assert!(text.lines().any(|line| line.starts_with("# Relative L2 error of the lobe")), "the errors");
}

/// The largest distance of a node's value from the mean of its two neighbours', along alpha or mu, over the nodes with
/// alpha > 0 where all three have r above `least_r`, and which are not below node `corner` along both axes.
fn bumpiness(table: &SheenTable, least_r: f64, corner: usize, value: impl Fn([f64; 3]) -> f64) -> f64 {
    let mut largest = 0.0_f64;
    for k in 1..NODES {
        for middle in 2..NODES - 1 {
            let around = [middle - 1, middle, middle + 1];
            for cells in [around.map(|i| table.cell(i, k)), around.map(|j| table.cell(k, j))] {
                let outside = k >= corner || middle >= corner;
                if outside && cells.iter().all(|[_, _, r]| *r > least_r) {
                    let [before, at, after] = cells.map(&value);
                    largest = largest.max((at - (before + after) / 2.0).abs());
                }
            }
        }
    }
    largest
}

/// Largest [`bumpiness`] of ln(a), b, r where r > 1e-3, which is due to the lobe's own bend at (2/31, 2/31). At the
/// corner, the fit makes r uneven.
const SMOOTH: [f64; 3] = [0.12, 0.025, 0.05];
const CORNER_OF_R: usize = 5;

/// The same for all nodes. ln(a) bends sharply at (1/31, 2/31), where the lobe goes dark one node from the horizon.
const SMOOTH_IN_THE_DARK: [f64; 3] = [0.2, 0.025, 0.05];

fn bumpinesses(table: &SheenTable, least_r: f64) -> [f64; 3] {
    [
        bumpiness(table, least_r, 0, |[a, _, _]| a.ln()),
        bumpiness(table, least_r, 0, |[_, b, _]| b),
        bumpiness(table, least_r, CORNER_OF_R, |[_, _, r]| r),
    ]
}

#[test]
fn nodes_are_smooth_with_their_neighbours() {
    let table = SheenTable::embedded();
    for (least_r, limits) in [(1e-3, SMOOTH), (0.0, SMOOTH_IN_THE_DARK)] {
        let found = bumpinesses(&table, least_r);
        assert!(found.iter().zip(limits).all(|(found, limit)| *found < limit), "r > {least_r}: {found:?}");
    }
}

#[test]
fn a_node_out_of_line_is_told() {
    let table = SheenTable::embedded();
    let [a, b, r] = table.cell(12, 9);
    for wrong in [[a * 1.3, b, r], [a, b - 0.04, r], [a, b, r + 0.1]] {
        let mut cells = table.cells().to_vec();
        cells[12 * NODES + 9] = wrong;
        let found = bumpinesses(&SheenTable::new([NODES; 2], cells), 1e-3);
        assert!(found.iter().zip(SMOOTH).any(|(found, limit)| *found > limit), "{wrong:?}: {found:?}");
    }
}

#[test]
fn the_table_is_what_the_code_makes() {
    let (table, report) = sheen::fit(NODES, |_, _| ());
    let shipped = SheenTable::embedded();
    // On one machine all bits are the same; others round matrix products differently, but hardly in the header's four
    // digits.
    assert!(shipped.half_steps(&table).is_some_and(|steps| steps <= 1), "velour fit makes another table");
    let text = include_str!("../../tables/sheen_ltc.csv");
    let header: Vec<&str> = text.lines().map_while(|line| line.strip_prefix("# ")).collect();
    assert_eq!(header, report.header(), "the errors at the head of the table");
    let Errors { mean, median, max } = report.lobe;
    assert!(mean < 0.0930 && median < 0.0725 && max < 0.351 && report.weighted < 0.1, "{report}");
    assert!(report.centres.mean < 0.0065 && report.centres.max < 0.4, "{report}");
    assert!(report.spread.mean < 0.0065 && report.spread.max < 0.9, "{report}");
    let page = include_str!("../../docs/accuracy.md");
    for figure in report.figures().into_iter().chain([format!("{} nodes with R > {DIM}", report.nodes)]) {
        assert!(page.contains(&figure), "docs/accuracy.md does not say '{figure}'");
    }
}

#[test]
fn r_leaves_the_albedo_where_that_rises_steeply() {
    let table = SheenTable::embedded();
    // The smallest and the largest r / R at nodes with R > 1e-3 and mu > 0.
    let ratios = |i: usize| {
        let solution = solve(i);
        let pairs = (1..NODES).map(|j| (table.cell(i, j)[2], solution.albedo(j as f64 / 31.0)));
        let ratios = pairs.filter(|(_, albedo)| *albedo > DIM).map(|(r, albedo)| r / albedo);
        ratios.fold((f64::INFINITY, 0.0_f64), |(least, most), ratio| (least.min(ratio), most.max(ratio)))
    };
    for (i, least) in [(2, 0.15), (3, 0.4), (4, 0.6), (5, 0.75), (6, 0.8), (7, 0.85), (16, 0.94), (31, 0.99)] {
        let (low, high) = ratios(i);
        assert!(low > least && high < 1.15, "alpha {i}/31: r / R from {low} to {high}");
        assert!(i > 5 || low < least + 0.12, "alpha {i}/31: r is not bent for what lies between: {low}");
    }
    let (r, albedo) = (table.cell(1, 0)[2], solve(1).albedo(0.0));
    assert!(r < 0.2 * albedo, "at the corner {r} is not {albedo}");
}

#[test]
fn albedos_agree_with_fresh_walks() {
    // At points between the nodes where bilinear interpolation is good; each has a bound of its own on what that
    // misses.
    let table = SheenTable::embedded();
    for (alpha, mu, bend) in
        [(0.95, 0.55, 1e-3), (0.62, 0.37, 2e-3), (0.45, 0.21, 4e-3), (0.33, 0.11, 6e-3), (0.25, 0.4, 6e-3)]
    {
        let walk = Walk { slab: Slab::new(alpha), mu, first_flight: FirstFlight::Scattered, paths: 200_000, seed: 77 };
        let more = walk.run().reflected_more.total() as f64;
        let albedo = walk.slab.single_scattering_albedo(mu) + more * walk.share();
        let error = (walk.share() * more.sqrt()).hypot(bend * albedo / 3.0);
        assert_within(table.lookup(alpha, mu)[2], albedo, error, 3.0, &format!("r at ({alpha}, {mu})"));
    }
}

#[test]
fn matrices_are_the_best_for_their_lobes() {
    let table = SheenTable::embedded();
    for (i, j) in SOME {
        let lobes = Lobes::new(solve(i));
        let mu = (j as f64 / 31.0).max(GRAZING_MU);
        let shape = lobes.shape(mu);
        let [a, b, _] = table.cell(i, j);
        let shipped = Ltc::sheen(a, b);
        let free = if mu == 1.0 { Free::OnlyA } else { Free::Both };
        let error = |ltc| squared_error(&shape, &lobes.hemisphere, ltc);
        let start = Ltc::sheen(0.3, if mu == 1.0 { 0.0 } else { -0.05 });
        let least = error(fit(&shape, &lobes.hemisphere, start, free));
        assert!(error(shipped) < least * (1.0 + 1e-6), "node ({i}, {j}): {shipped:?} is not the best");
        let wrong = Ltc::sheen(a * 1.02, b);
        assert!(error(wrong) > least * (1.0 + 1e-6), "node ({i}, {j}): {wrong:?} passes");
    }
}

#[test]
fn half_steps_count() {
    let table = SheenTable::embedded();
    let mut cells = table.cells().to_vec();
    cells[100][1] *= 1.003;
    let steps = table.half_steps(&SheenTable::new([NODES; 2], cells)).expect("the same size");
    assert!((2..=4).contains(&steps), "0.3% is some three steps of 2^-10: {steps}");
    assert_eq!(table.half_steps(&SheenTable::new([2; 2], vec![[1.0, 0.0, 0.0]; 4])), None);
}
