//! Lobes in the plane of incidence: solved, walked, fitted.

use super::canvas::{Figure, digits};
use super::incidence::{FEWEST, curve, in_plane, pools, sector};
use super::polar::{self, Panel, Words};
use crate::physics::slab::Slab;
use crate::physics::transport::{Resolution, Transport};
use crate::physics::walk::{FirstFlight, Walk};
use crate::table::{Ltc, SheenTable};
use std::f64::consts::PI;

/// The figure's file name.
pub const NAME: &str = "lobes.svg";

/// Roughnesses, one for each row of panels, and cosines of `wi`, one for each column.
pub const ALPHAS: [f64; 4] = [0.1, 0.3, 0.6, 1.0];
pub const MUS: [f64; 3] = [0.1, 0.4, 0.8];

/// Paths of a walk, not counting those that pass unscattered. The walks' seeds are 1, 2, ... in the panels' order.
const PATHS: u64 = 1 << 21;
/// Where less light than this comes back, more paths are sent.
const DIM: f64 = 0.01;
const DIM_PATHS: u64 = 1 << 24;

const WORDS: Words = Words {
    title: "Lobes of the slab in the plane of incidence, f_r mu_o",
    solved: "solver (all orders)",
    counted: "random walk, ±1 standard error",
    fitted: "table's transformed cosine",
};

/// Bins of azimuths on either side of the plane of incidence that count as being in it.
const SECTOR: usize = 1;

/// How often [`lobes`] calls `step`.
pub const fn steps() -> usize {
    ALPHAS.len() * MUS.len()
}

/// Small multiples of the lobe f_r mu_o, alpha from 0.1 to 1 by mu from 0.1 to 0.8. `step` is called after each panel.
pub fn lobes(table: &SheenTable, step: impl Fn()) -> Figure {
    let mut panels = Vec::new();
    for alpha in ALPHAS {
        let transport = Transport::new(Slab::new(alpha), Resolution::default());
        for mu in MUS {
            panels.push(panel(table, &transport, [alpha, mu], panels.len() as u64 + 1));
            step();
        }
    }
    let caption = format!(
        "The lobe f_r mu_o, per steradian, is the radius, over the elevation of wo from the normal in degrees; right is towards wi (arrow). \
         The number below the outer circle is its radius: scales differ. Walk: 2^{} scattered paths a lobe, 2^{} where R < {DIM}, seeds 1 to {}; \
         an arc is a mean over its elevations and over azimuths within {:.1} degrees of the plane (the lobe's mean there is its value in the \
         plane to 0.2% of the largest), a bar is one standard error either way; fewer than {FEWEST} paths are not shown. Solver: {} azimuthal \
         modes. Table of checksum {:08x}.",
        PATHS.ilog2(),
        DIM_PATHS.ilog2(),
        panels.len(),
        sector(SECTOR) * 180.0 / PI,
        Resolution::default().modes,
        table.checksum()
    );
    let svg = polar::draw(&panels, MUS.len(), &WORDS, &caption);
    Figure { name: NAME, svg, caption }
}

fn panel(table: &SheenTable, transport: &Transport, [alpha, mu]: [f64; 2], seed: u64) -> Panel {
    let wi = in_plane(mu.acos());
    let [a, b, r] = table.lookup(alpha, mu);
    let ltc = Ltc::sheen(a, b);
    let albedo = transport.albedo(mu);
    let paths = if albedo < DIM { DIM_PATHS } else { PATHS };
    let walk = Walk { slab: *transport.slab(), mu, first_flight: FirstFlight::Scattered, paths, seed };
    let mut counted = pools(&walk.run(), walk.share(), SECTOR);
    counted.retain(|pool| pool.count >= FEWEST);
    Panel {
        title: format!("alpha {alpha}, mu {mu}: R = {}", digits(albedo)),
        wi: mu.acos(),
        solved: curve(|wo| transport.reflected(wi, wo)),
        fitted: curve(|wo| r * ltc.density(wo)),
        counted,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::incidence::sector_mean;

    #[test]
    fn the_sectors_means_are_the_planes_values_as_the_caption_says() {
        for alpha in ALPHAS {
            let transport = Transport::new(Slab::new(alpha), Resolution::default());
            for mu in MUS {
                let wi = in_plane(mu.acos());
                let lobe = |wo| transport.reflected(wi, wo);
                let curve = curve(lobe);
                let highest = curve.iter().fold(0.0, |highest: f64, [_, value]| highest.max(*value));
                for [elevation, value] in curve.into_iter().step_by(8) {
                    let off = sector_mean(lobe, in_plane(elevation), SECTOR) - value;
                    assert!(off.abs() < 2e-3 * highest, "alpha {alpha}, mu {mu}, elevation {elevation}: {off:e}");
                }
            }
        }
    }
}
