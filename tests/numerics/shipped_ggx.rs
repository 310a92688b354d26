//! The specular base's table in `tables/`.

use glam::DVec3;
use half::f16;
use rayon::prelude::*;
use velour::fit::RESOLUTION;
use velour::fit::ggx;
use velour::fit::ggx::row::{QUADRATURE, albedo, distance, fit};
use velour::math::sine;
use velour::physics::microfacet::{Ggx, LEAST_ALPHA};
use velour::table::ggx::{GRAZING_MU, cosine};
use velour::table::{GgxTable, Ltc, centres, node};

/// L1 distance between the lobe at `mu` over its albedo and what is looked up.
fn error(table: &GgxTable, roughness: f64, mu: f64) -> f64 {
    let nodes = Ggx::from_roughness(roughness).quadrature(mu, QUADRATURE);
    distance(&nodes, albedo(&nodes), table.lookup(roughness, mu).ltc)
}

#[test]
fn the_table_is_what_the_code_makes() {
    let (table, report) = ggx::fit(RESOLUTION, |_, _| ());
    let shipped = GgxTable::embedded();
    assert!(shipped.half_steps(&table).is_some_and(|steps| steps <= 1), "velour fit makes another table");
    let text = include_str!("../../tables/ggx_ltc.csv");
    let header: Vec<&str> = text.lines().map_while(|line| line.strip_prefix("# ")).collect();
    assert_eq!(header, report.header(), "the errors at the head of the table");
    assert!(report.nodes.weighted < 0.093 && report.spread.shapes.weighted < 0.0925, "{report}");
    assert!(report.spread.albedo.mean < 0.0005 && report.spread.fresnel.mean < 0.0005, "{report}");
    assert!(report.spread.albedo.max < 0.03 && report.spread.fresnel.max < 0.03, "{report}");
    assert!(report.compared < 0.1235, "{report}");
    let page = include_str!("../../docs/accuracy.md");
    for figure in report.figures() {
        assert!(page.contains(&figure), "docs/accuracy.md does not say '{figure}'");
    }
}

#[test]
fn texture_holds_the_same_numbers() {
    assert_eq!(GgxTable::embedded().to_dds(), include_bytes!("../../tables/ggx_ltc.dds"));
}

#[test]
fn every_node_obeys_the_conventions() {
    let table = GgxTable::embedded();
    assert_eq!(table.size(), [RESOLUTION; 2]);
    for i in 0..RESOLUTION {
        for j in 0..RESOLUTION {
            let mu = cosine(node(j, RESOLUTION));
            let [u, _, s, albedo, fresnel] = table.cell(i, j);
            let aspect = mu.max(GRAZING_MU).powi(2) + u;
            assert!((9e-5..1.02).contains(&aspect), "node ({i}, {j}): a / c {aspect}");
            assert!((0.04..1.3).contains(&s), "node ({i}, {j}): s {s}");
            assert!(0.3 < albedo && albedo <= 1.0 && fresnel <= albedo, "node ({i}, {j}): {albedo}, {fresnel}");
        }
        let [u, v, ..] = table.cell(i, 0);
        assert_eq!([u, v], [0.0; 2], "round at mu = 1, roughness's node {i}");
    }
}

#[test]
fn halves_are_as_good() {
    let table = GgxTable::embedded();
    let halves = GgxTable::from_dds(include_bytes!("../../tables/ggx_ltc.dds")).expect("the shipped texture");
    for (one, other) in table.texels().as_flattened().iter().zip(halves.texels().as_flattened()) {
        assert!((f16::from_f32(*one).to_f32() - other).abs() < 1e-3 * other.abs() + 1e-7);
    }
    centres(12).par_iter().for_each(|&roughness| {
        for mu in centres(12).into_iter().map(cosine) {
            let [exact, rounded] = [&table, &halves].map(|table| error(table, roughness, mu));
            assert!(rounded < exact + 0.002, "roughness {roughness}, mu {mu}: {rounded}, {exact}");
        }
    });
}

#[test]
fn a_sharp_lobe_points_where_a_mirror_does() {
    let table = GgxTable::embedded();
    for roughness in [0.0_f64, 0.02, 0.05, 0.08] {
        let alpha = (roughness * roughness).max(LEAST_ALPHA);
        // Mostly between the nodes.
        for mu in (1..200).map(|k| f64::from(k) / 200.0).filter(|mu| *mu > 20.0 * alpha && *mu > GRAZING_MU) {
            let Ltc { a, b, c } = table.lookup(roughness, mu).ltc;
            // A narrow lobe's density is greatest where M^-1 wo is the axis.
            let peak = DVec3::new(-b / a, 0.0, 1.0).normalize();
            let off = peak.dot(DVec3::new(mu, 0.0, sine(mu)));
            assert!(off.abs() < 0.5 * alpha, "roughness {roughness}, mu {mu}: {off} off, {alpha} wide");
            // The facets' slopes are alpha wide, directions twice that; interpolation within a cell adds a sixteenth of
            // its bend.
            assert!((2.0 * alpha * c - 1.0).abs() < 0.07, "roughness {roughness}, mu {mu}: {}", 2.0 * alpha * c);
        }
    }
}

#[test]
fn nothing_is_lost_between_the_nodes() {
    // What is looked up against the matrix that is best at that very place.
    let table = GgxTable::embedded();
    let roughnesses: Vec<f64> = (0..9).map(|k| 0.02 + 0.119 * f64::from(k)).collect();
    let extra: Vec<f64> = roughnesses
        .par_iter()
        .flat_map_iter(|&roughness| {
            let mus = [0.97, 0.83, 0.61, 0.42, 0.23, 0.11, 0.05];
            let table = &table;
            mus.into_iter().map(move |mu| {
                let found = table.lookup(roughness, mu).ltc;
                let best = fit(Ggx::from_roughness(roughness), mu, [found; 2]).distance;
                let extra = error(table, roughness, mu) - best;
                assert!(extra > -1e-9, "roughness {roughness}, mu {mu}: the fit made it worse");
                extra
            })
        })
        .collect();
    let (mean, max) = (extra.iter().sum::<f64>() / extra.len() as f64, extra.iter().copied().fold(0.0, f64::max));
    println!("extra L1 between the nodes: mean {mean:.4}, max {max:.4}");
    assert!(mean < 0.004 && max < 0.03, "mean {mean}, max {max}");
}

#[test]
fn a_fit_is_a_minimum_and_recovers_what_it_may() {
    let (roughness, mu) = (0.45, 0.6);
    let table = GgxTable::embedded();
    let ggx = Ggx::from_roughness(roughness);
    let start = table.lookup(roughness, mu).ltc;
    let round = Ltc { a: 1.0, b: 0.0, c: 1.0 };
    let [near, far] = [start, round].map(|start| fit(ggx, mu, [start; 2]));
    let close = |one: f64, other: f64| (one - other).abs() < 1e-3 * (1.0 + other.abs());
    assert!(close(near.ltc.a, far.ltc.a) && close(near.ltc.b, far.ltc.b) && close(near.ltc.c, far.ltc.c), "{far:?}");
    let nodes = ggx.quadrature(mu, QUADRATURE);
    for factor in [0.99, 1.01] {
        let Ltc { a, b, c } = near.ltc;
        for wrong in [Ltc { a: a * factor, b, c }, Ltc { a, b: b * factor, c }, Ltc { a, b, c: c * factor }] {
            assert!(distance(&nodes, albedo(&nodes), wrong) > near.distance, "{wrong:?}");
        }
    }
}

#[test]
fn the_report_does_not_hang_on_its_quadrature() {
    let table = GgxTable::embedded();
    for (roughness, mu) in [(0.15, 0.01), (0.3, 0.05), (0.5, 0.5), (0.9, 0.02), (0.06, 0.3)] {
        let nodes = Ggx::from_roughness(roughness).quadrature(mu, [160, 160]);
        let fine = distance(&nodes, albedo(&nodes), table.lookup(roughness, mu).ltc);
        let found = error(&table, roughness, mu);
        assert!((found - fine).abs() < 0.003, "roughness {roughness}, mu {mu}: {found}, {fine}");
    }
}
