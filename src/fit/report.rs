use super::Cell;
use std::fmt;

/// Albedo above which a cell counts in the report: fainter lobes are not seen.
const SEEN: f64 = 1e-3;

/// How well a table's transformed cosines stand for the lobes, over the cells with R > 1e-3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// Nodes that were fitted, alpha = 0 left out.
    pub cells: usize,
    /// Nodes with R > 1e-3.
    pub seen: usize,
    /// Nodes at which a neighbour stands in for the lobe's shape.
    pub stand_ins: usize,
    /// Relative L2 error of the lobe: the root of the hemisphere's integral of (lobe - r D)^2 over that of lobe^2.
    pub mean: f64,
    pub median: f64,
    pub max: f64,
    /// The mean, each cell weighted by its R.
    pub weighted: f64,
    /// Greatest and mean standard error of r, over r: the walk's noise.
    pub albedo_error_max: f64,
    pub albedo_error_mean: f64,
}

impl Report {
    pub(super) fn new(rows: &[Vec<Cell>]) -> Self {
        let cells: Vec<&Cell> = rows.iter().flatten().collect();
        let seen: Vec<&Cell> = cells.iter().copied().filter(|cell| cell.albedo > SEEN).collect();
        let mut errors: Vec<f64> = seen.iter().filter_map(|cell| cell.error).collect();
        errors.sort_by(f64::total_cmp);
        let mean = |values: &mut dyn Iterator<Item = f64>| {
            let (sum, count) = values.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
            sum / f64::max(count, 1.0)
        };
        let fitted = || seen.iter().filter_map(|cell| Some((cell.albedo, cell.error?)));
        let albedos: f64 = fitted().map(|(albedo, _)| albedo).sum();
        Self {
            cells: cells.len(),
            seen: seen.len(),
            stand_ins: cells.iter().filter(|cell| cell.error.is_none()).count(),
            mean: mean(&mut errors.iter().copied()),
            median: errors.get(errors.len() / 2).copied().unwrap_or(0.0),
            max: errors.last().copied().unwrap_or(0.0),
            weighted: fitted().map(|(albedo, error)| albedo * error).sum::<f64>() / albedos.max(f64::MIN_POSITIVE),
            albedo_error_max: seen.iter().map(|cell| cell.albedo_error).fold(0.0, f64::max),
            albedo_error_mean: mean(&mut seen.iter().map(|cell| cell.albedo_error)),
        }
    }
}

/// Lines for a terminal, or for the head of a table's file.
impl fmt::Display for Report {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        let Self { cells, seen, stand_ins, .. } = self;
        writeln!(formatter, "{seen} of {cells} cells have R > {SEEN:.0e}; errors are over these")?;
        writeln!(
            formatter,
            "relative L2 error of the lobe: mean {:.4}, median {:.4}, max {:.4}, weighted by R {:.4}",
            self.mean, self.median, self.max, self.weighted
        )?;
        writeln!(
            formatter,
            "standard error of r, relative: mean {:.1e}, max {:.1e}",
            self.albedo_error_mean, self.albedo_error_max
        )?;
        write!(formatter, "in {stand_ins} cells, all of them faint, a neighbour stands in for the orders from 2 on")
    }
}
