//! How far the table is from the solution, over (alpha, mu).

use super::canvas::Figure;
use super::color::Scale;
use super::field::{Field, Labels, draw};
use crate::fit::lobe::Lobes;
use crate::fit::{DIM, Errors};
use crate::physics::slab::Slab;
use crate::physics::transport::{Resolution, Transport};
use crate::table::{Ltc, SheenTable, centres};
use rayon::prelude::*;

pub const NAMES: [&str; 2] = ["error_lobe.svg", "error_r.svg"];

/// Cells a side of the lobes' errors. Not a multiple of the table's: off its nodes as well as near them.
pub const LOBE_CELLS: usize = 48;
/// Cells a side of r's errors.
pub const ALBEDO_CELLS: usize = 96;

/// How often [`errors`] calls `step`.
pub const fn steps() -> usize {
    LOBE_CELLS + ALBEDO_CELLS
}

/// The errors of `table`'s lobes and of its r, where R >= 1e-3. `step` is called after each row, from any of the
/// working threads.
pub fn errors(table: &SheenTable, step: impl Fn() + Sync) -> Vec<Figure> {
    vec![lobe_figure(table, &step), albedo_figure(table, &step)]
}

fn lobe_figure(table: &SheenTable, step: impl Fn() + Sync) -> Figure {
    let field = field(LOBE_CELLS, |alpha| {
        let lobes = Lobes::new(Transport::new(Slab::new(alpha), Resolution::default()));
        let row = row(LOBE_CELLS, |mu| lobe_error(table, &lobes, alpha, mu));
        step();
        row
    });
    let about = "Relative L2 distance over the hemisphere of the table's lobe, r times the transformed cosine, from the solver's f_r mu_o.";
    figure(table, NAMES[0], "Error of the table's lobe", about, &field, Scale::Log(1e-2..1.0))
}

fn albedo_figure(table: &SheenTable, step: impl Fn() + Sync) -> Figure {
    let field = field(ALBEDO_CELLS, |alpha| {
        let transport = Transport::new(Slab::new(alpha), Resolution { modes: 1, ..Default::default() });
        let row = row(ALBEDO_CELLS, |mu| albedo_error(table, &transport, alpha, mu));
        step();
        row
    });
    let about = "Relative error of r, interpolated in the table, against the solver's albedo R.";
    figure(table, NAMES[1], "Error of the table's r", about, &field, Scale::Log(1e-4..1.0))
}

/// The relative L2 error of a lobe; `None` where R is below [`DIM`].
fn lobe_error(table: &SheenTable, lobes: &Lobes, alpha: f64, mu: f64) -> Option<f64> {
    let albedo = lobes.transport.albedo(mu);
    if albedo < DIM {
        return None;
    }
    let (shape, hemisphere) = (lobes.shape(mu), &lobes.hemisphere);
    let [a, b, r] = table.lookup(alpha, mu);
    let ltc = Ltc::sheen(a, b);
    let off = |node: usize| r / albedo * ltc.density(hemisphere.nodes[node]) - shape[node];
    let square = hemisphere.integral(|node| off(node).powi(2));
    Some((square / hemisphere.integral(|node| shape[node].powi(2))).sqrt())
}

/// The relative error of r; `None` where R is below [`DIM`].
fn albedo_error(table: &SheenTable, transport: &Transport, alpha: f64, mu: f64) -> Option<f64> {
    let albedo = transport.albedo(mu);
    (albedo >= DIM).then(|| (table.lookup(alpha, mu)[2] / albedo - 1.0).abs())
}

fn row(n: usize, value: impl Fn(f64) -> Option<f64>) -> Vec<Option<f64>> {
    centres(n).into_iter().map(value).collect()
}

/// What `row` gives for the middle of each of `n` cells of alpha, on all threads.
fn field(n: usize, row: impl Fn(f64) -> Vec<Option<f64>> + Sync) -> Field {
    let rows: Vec<_> = centres(n).into_par_iter().map(&row).collect();
    Field::of_centers(n, rows.concat())
}

fn figure(table: &SheenTable, name: &'static str, title: &str, about: &str, field: &Field, scale: Scale) -> Figure {
    let seen: Vec<f64> = field.values.iter().copied().flatten().collect();
    let Errors { mean, median, max } = Errors::new(seen);
    let absent = format!("R < {DIM}");
    let caption = format!(
        "{about} At the middles of {n} x {n} cells; {absent} is left out. Mean {mean:.4}, median {median:.4}, largest {max:.3}. \
         The scale is logarithmic; what is past an end has the end's colour. Table of {} x {} nodes, checksum {:08x}.",
        table.size()[0],
        table.size()[1],
        table.checksum(),
        n = field.size[0],
    );
    let svg = draw(field, &scale, &Labels { title, absent: Some(&absent), caption: &caption });
    Figure { name, svg, caption }
}

#[cfg(test)]
mod tests {
    use super::super::parsed::Parsed;
    use super::*;
    use crate::fit::sheen::least_squares::{self, Free};

    const ALPHA: f64 = 0.6;
    const MU: f64 = 0.4;

    /// A table of the same lobe everywhere.
    fn constant(cell: [f64; 3]) -> SheenTable {
        SheenTable::new([2, 2], vec![cell; 4])
    }

    #[test]
    fn errors_are_those_of_known_tables() {
        let lobes = Lobes::new(Transport::new(Slab::new(ALPHA), Resolution::default()));
        let albedo = lobes.transport.albedo(MU);
        let shape = lobes.shape(MU);
        let Ltc { a, b, .. } = least_squares::fit(&shape, &lobes.hemisphere, Ltc::sheen(0.5, 0.0), Free::Both);
        let error = |cell| lobe_error(&constant(cell), &lobes, ALPHA, MU).expect("R is above DIM");
        let best = error([a, b, albedo]);
        let norm = lobes.hemisphere.integral(|node| shape[node].powi(2));
        let fitted = least_squares::squared_error(&shape, &lobes.hemisphere, Ltc::sheen(a, b));
        assert!((best - (fitted / norm).sqrt()).abs() < 1e-12, "{best}");
        assert!(best > 0.01 && best < 0.2, "{best}");
        for worse in [[a * 1.1, b, albedo], [a, b - 0.1, albedo], [a, b, albedo * 1.3], [a, b, albedo * 0.7]] {
            assert!(error(worse) > best, "{worse:?}");
        }
        // Nothing at all is as far off as the lobe is large.
        assert!((error([a, b, 0.0]) - 1.0).abs() < 1e-12);
        for factor in [0.9, 1.0, 1.25] {
            let error = albedo_error(&constant([a, b, albedo * factor]), &lobes.transport, ALPHA, MU);
            assert!((error.expect("R is above DIM") - f64::abs(factor - 1.0)).abs() < 1e-12, "{factor}: {error:?}");
        }
    }

    #[test]
    fn what_is_dim_is_left_out() {
        let transport = Transport::new(Slab::new(0.2), Resolution { modes: 1, ..Default::default() });
        let [bright, dim] = [0.1, 0.9].map(|mu| {
            let shown = albedo_error(&constant([0.5, 0.0, 0.5]), &transport, 0.2, mu).is_some();
            assert_eq!(shown, transport.albedo(mu) >= DIM, "mu {mu}");
            shown
        });
        assert!(bright && !dim);
    }

    #[test]
    fn a_field_is_computed_at_the_cells_middles() {
        let field = field(4, |alpha| row(4, |mu| Some(alpha + 100.0 * mu)));
        assert_eq!(field.values[0], Some(0.125 + 12.5));
        assert_eq!(field.values[1], Some(0.125 + 37.5));
        assert_eq!(field.values[15], Some(0.875 + 87.5));
    }

    #[test]
    fn statistics_are_said() {
        let values = vec![Some(0.5), Some(0.01), None, Some(0.03)];
        let field = Field::of_centers(2, values);
        let figure = figure(&constant([0.5, 0.0, 0.5]), NAMES[1], "A title", "About.", &field, Scale::Log(1e-2..1.0));
        assert!(figure.caption.contains("Mean 0.1800, median 0.0300, largest 0.500."), "{}", figure.caption);
        Parsed::new(&figure.svg).says("R < 0.001");
    }
}
