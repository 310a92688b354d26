//! Lobes of explicit fibres beside the slab's.

use super::comparison::{COLUMNS, Comparison, ROWS};
use super::goniometer::Goniometer;
use super::patch::Patch;
use super::planting::Planting;
use crate::figures::canvas::{Figure, digits};
use crate::figures::incidence::{Curve, FEWEST, curve, in_plane, pools, sector, sector_mean};
use crate::figures::polar::{self, Panel, Words};
use crate::physics::slab::Slab;
use crate::physics::transport::{Resolution, Transport};
use rayon::prelude::*;
use std::f64::consts::PI;

/// The figure's file name.
pub const NAME: &str = "fibres.svg";

/// Roughnesses, one for each row of panels, and cosines of `wi`, one for each column.
pub const ALPHAS: [f64; 4] = [0.2, 0.4, 0.7, 1.0];
pub const MUS: [f64; 3] = [0.2, 0.5, 0.9];
/// Diameters of fibres, in thicknesses of the layer; only the lobes of the first and of the last are drawn.
pub const DIAMETERS: [f64; 3] = [0.1, 0.03, 0.01];
/// Length of fibres, in thicknesses of the layer.
const LENGTH: f64 = 1.0;
const FIBRES: usize = 200_000;
const PATHS: u64 = 1 << 17;

/// Where less light than this comes back, there are too few paths for a lobe's distance.
const DIM: f64 = 0.01;
/// Bins of azimuths on either side of the plane of incidence over which lobes are averaged.
const SECTOR: usize = 4;

const WORDS: Words = Words {
    title: "Explicit fibres and the slab: lobes near the plane of incidence, f_r mu_o",
    solved: "slab, solved",
    counted: "thin fibres, ±1 standard error",
    fitted: "thick fibres",
};

/// How often [`fibres_figure`] calls `step`.
pub const fn steps() -> usize {
    ALPHAS.len() * DIAMETERS.len() * MUS.len()
}

/// Small multiples of the lobe f_r mu_o of explicit fibres and of the slab, alpha from 0.2 to 1 by mu from 0.2 to 0.9;
/// the caption says how far apart R and the lobes are for each diameter. `step` is called after each measurement, from
/// any of the working threads.
pub fn fibres_figure(step: impl Fn() + Sync) -> Figure {
    let rows: Vec<(Vec<Panel>, Vec<[Comparison; 3]>)> =
        (0..ALPHAS.len()).into_par_iter().map(|at| row(at, &step)).collect();
    let (panels, comparisons): (Vec<_>, Vec<_>) = rows.into_iter().unzip();
    let (panels, comparisons) = (panels.into_iter().flatten().collect::<Vec<_>>(), comparisons.concat());
    let [thick, .., thin] = DIAMETERS;
    let apart: Vec<String> = (0..DIAMETERS.len()).map(|at| apart(&comparisons, at)).collect();
    let caption = format!(
        "The lobe f_r mu_o, per steradian, is the radius, over the elevation of wo from the normal in degrees; right is towards wi (arrow). \
         The number below the outer circle is its radius: scales differ. All are means over azimuths within {:.1} degrees of the plane of incidence. \
         Fibres are mirrors of circular section, of the slab's density and directions, {LENGTH} long, of diameter {thin} (points) and {thick} (dashed) \
         where the layer is 1 thick; {FIBRES} in a patch that repeats itself, 2^{} paths a lobe, seeds 1 to {}, all orders, none cut short ({} were). \
         Fibres against slab where R > {DIM}, {}; lobes (relative L2) in {ROWS} x {COLUMNS} bins, the noise taken out, which was {:.3} on average.",
        sector(SECTOR) * 180.0 / PI,
        PATHS.ilog2(),
        steps(),
        comparisons.iter().flatten().map(|comparison| comparison.measured.interrupted).sum::<u64>(),
        apart.join("; "),
        mean(bright(&comparisons).map(|cell| cell[0].noise)),
    );
    let svg = polar::draw(&panels, MUS.len(), &WORDS, &caption);
    Figure { name: NAME, svg, caption }
}

/// One roughness: a panel for each mu, and the comparisons of all diameters.
fn row(at: usize, step: &(impl Fn() + Sync)) -> (Vec<Panel>, Vec<[Comparison; 3]>) {
    let alpha = ALPHAS[at];
    // Each measurement has its own seed, so that chance in one is independent of chance in the next.
    let mut seed = (at * DIAMETERS.len() * MUS.len()) as u64;
    let transport = Transport::new(Slab::new(alpha), Resolution::default());
    let columns = DIAMETERS.map(|diameter| {
        let patch = Patch::new(&Planting { alpha, diameter, length: LENGTH, seed: seed + 1 }, FIBRES);
        MUS.map(|mu| {
            seed += 1;
            let comparison = Comparison::new(&transport, &patch, &Goniometer { mu, paths: PATHS, seed });
            step();
            comparison
        })
    });
    let cells = (0..MUS.len()).map(|at| columns.each_ref().map(|column| column[at].clone()));
    let cells: Vec<[Comparison; 3]> = cells.collect();
    let panels = MUS.iter().zip(&cells).map(|(mu, cell)| panel(&transport, alpha, *mu, cell)).collect();
    (panels, cells)
}

fn panel(transport: &Transport, alpha: f64, mu: f64, cell: &[Comparison; 3]) -> Panel {
    let [thick, _, thin] = cell;
    let lobe = |comparison: &Comparison| {
        let mut pools = pools(&comparison.measured.counts, 1.0 / PATHS as f64, SECTOR);
        pools.retain(|pool| pool.count >= FEWEST);
        pools
    };
    let [found, error] = thin.albedo;
    let wi = in_plane(mu.acos());
    let dashed: Curve =
        lobe(thick).iter().map(|pool| [(pool.elevations[0] + pool.elevations[1]) / 2.0, pool.mean]).collect();
    Panel {
        title: format!(
            "alpha {alpha}, mu {mu}: R {}, fibres {} ± {}",
            digits(thin.solved),
            digits(found),
            digits(error)
        ),
        wi: mu.acos(),
        solved: curve(|wo| sector_mean(|wo| transport.reflected(wi, wo), wo, SECTOR)),
        fitted: dashed,
        counted: lobe(thin),
    }
}

/// The cells that reflect enough light.
fn bright(comparisons: &[[Comparison; 3]]) -> impl Iterator<Item = &[Comparison; 3]> {
    comparisons.iter().filter(|cell| cell[0].solved > DIM)
}

/// What the caption says about the diameter of index `at`.
fn apart(comparisons: &[[Comparison; 3]], at: usize) -> String {
    let relative = |cell: &[Comparison; 3]| cell[at].albedo[0] / cell[at].solved - 1.0;
    let error = |cell: &[Comparison; 3]| (cell[at].albedo[1] / cell[at].solved).powi(2);
    let cells = bright(comparisons).count() as f64;
    let error = bright(comparisons).map(error).sum::<f64>().sqrt() / cells;
    let off = mean(bright(comparisons).map(relative));
    let distance = mean(bright(comparisons).map(|cell| cell[at].distance));
    format!(
        "diameter {}: R {:+.1}% ± {:.1}%, lobes {distance:.3} apart on average",
        DIAMETERS[at],
        100.0 * off,
        100.0 * error
    )
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0), |(sum, count), value| (sum + value, count + 1));
    sum / f64::from(count)
}
