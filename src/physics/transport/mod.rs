//! The slab solved without noise: every order of scattering, in milliseconds.
//!
//! # The problem
//!
//! Light of radiance L crosses a layer that looks the same from every azimuth. Along a direction of cosine mu it loses sigma_t(mu) of
//! itself per unit length, and gains what the kernel K = sigma_t x phase sends there from all others:
//!
//! ```text
//! mu dL/dz = -sigma_t(mu) L(mu, phi) + integral of K(mu, mu', phi - phi') L(mu', phi') d mu' d phi'.
//! ```
//!
//! 1. **Azimuth.** The kernel's Fourier modes K_m are known in closed form ([`modes`](super::modes)); each mode of L has an equation of
//!    its own, with 2 pi K_m(mu, mu') in place of K. Mode 0 alone carries energy.
//! 2. **Elevation.** `mesh` has panels of Gauss nodes, narrow near the horizon where light scatters often. `rates` turns the
//!    integral over mu' into matrices, `onwards` P for mu' on the same side of the horizon and `back` Q for the other. The kernel is a
//!    peak, about sigma wide, on a tail; where panels are wider than that, quadrature at nodes (Nystrom's method) would miss it, so that
//!    near a node polynomials are integrated against the kernel itself (product integration). Per unit of depth a node then loses
//!    sigma_t / mu and gets back P_ii / mu, passes on P_ij / mu and throws back Q_ij / mu. Nothing is absorbed: for mode 0 all rates of a
//!    node sum to sigma_t, and the difference (sigma_t - P_ii) / mu is formed as the sum of all others, mostly positive
//!    terms. Light that the peak leaves at its own node thus counts as not scattered at all, and energy is conserved to
//!    round-off.
//! 3. **Depth.** `doubling` builds the layer from thin ones, in a form in which nothing cancels.
//! 4. **What the matrices say.** Entry (i, j) of R is exact in mu_i and an average over mu_o against the polynomial of node j: sums over j
//!    are accurate to the mesh's order, and with them the albedo. Where panels are wider than the kernel's peak, single entries are
//!    not: a panel's polynomials end abruptly, and the peak blurs these ends. There (the wide panels) entries are replaced by their best
//!    approximation by polynomials of degree 10 in the logarithm of the angle, which have no ends (`smooth`).
//! 5. **Single scattering** is known exactly, and is taken out of R in the same discrete form in which R contains it.
//!    The rest, divided by mode 0 of single scattering, varies slowly in both cosines: it is interpolated. The entries
//!    (i, j) and (j, i) are equal but for the error of (4): both are replaced by the one whose exact cosine is the
//!    larger, so that reciprocity holds to round-off.
//!
//! Sources: Chandrasekhar 1960 (the equation); van de Hulst 1980 (doubling); Atkinson 1997 (Nystrom's method, product integration).

mod doubling;
mod mesh;
mod rates;
mod smooth;

pub use rates::MOST_MODES;

use super::modes::Elevation;
use super::slab::Slab;
use crate::math::{check_cosine, fourier::cosine_sum, sine};
use doubling::Layer;
use glam::DVec3;
use mesh::{Mesh, Stencil};
use nalgebra::DMatrix;
use rates::{Rates, rates};
use std::f64::consts::PI;

/// Least alpha that is solved: the nodes grow with alpha^(-2/3), to a thousand here.
pub const LEAST_ALPHA: f64 = 5e-4;

/// How finely the slab is solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Azimuthal modes, in \[1, [`MOST_MODES`]\]. One is enough for albedos; four leave out 3e-4 of a lobe or less
    /// (relative L2, alpha >= 2/31).
    pub modes: usize,
    /// How many times narrower than usual the panels are, in \[0.25, 16\]. The solver's time grows with its cube.
    pub refinement: f64,
    /// A cosine in \[0, 1\] around which panels are narrow enough for the transmitted lobe of light that comes from there: a sharp ridge
    /// along its own elevation. Without it that ridge is blurred to the panel's width; reflected lobes don't need it.
    pub ridge: Option<f64>,
}

impl Default for Resolution {
    fn default() -> Self {
        Self { modes: 4, refinement: 1.0, ridge: None }
    }
}

/// How a slab reflects and transmits light from any direction.
#[derive(Clone, Debug)]
pub struct Transport {
    slab: Slab,
    mesh: Mesh,
    /// At the nodes: albedo over that of single scattering.
    albedo: Vec<f64>,
    /// Per mode, over pairs of nodes: multiple scattering over mode 0 of single scattering.
    reflected: Vec<DMatrix<f64>>,
    /// Per mode, over pairs of nodes: multiple scattering's transmitted radiance per unit of incident flux.
    transmitted: Vec<DMatrix<f64>>,
}

impl Transport {
    /// Solves the slab, of alpha >= [`LEAST_ALPHA`]. Takes some milliseconds per mode for alpha > .2, a tenth of a
    /// second at 1/31, 20 s at .001. Meshes are made for a thickness of 1; up to 100, two of them agree to 1e-9 in R
    /// (alpha = .5). Panics where `slab` or `resolution` is outside its range.
    ///
    /// Against finer meshes, R is off by 2e-4 of itself or less, and lobes (relative L2) by 3e-4 for alpha >= 2/31 and mu >= 1e-3. At the
    /// horizon itself lobes are off by 5e-3: where both cosines go to 0 they have no common limit.
    pub fn new(slab: Slab, resolution: Resolution) -> Self {
        let Resolution { modes, refinement, ridge } = resolution;
        let alpha = slab.medium().sigma().sqrt();
        assert!(alpha >= LEAST_ALPHA, "alpha is at least {LEAST_ALPHA} to be solved: {alpha}");
        assert!((0.25..=16.0).contains(&refinement), "refinement is in [0.25, 16]: {refinement}");
        assert!(ridge.is_none_or(|mu| (0.0..=1.0).contains(&mu)), "a ridge's cosine is in [0, 1]: {ridge:?}");
        let mesh = Mesh::new(slab.medium().sigma(), refinement, ridge.map(f64::asin));
        let rates = rates(slab.medium(), &mesh, modes);
        let mut solution = Self { slab, mesh, albedo: vec![], reflected: vec![], transmitted: vec![] };
        let projection = smooth::projection(&solution.mesh);
        for (mode, rates) in rates.iter().enumerate() {
            solution.solve(mode, rates, projection.as_ref());
        }
        solution
    }

    fn solve(&mut self, mode: usize, rates: &Rates, projection: Option<&DMatrix<f64>>) {
        let layer = layer(&self.slab, &self.mesh, mode, rates);
        if mode == 0 {
            let single = self.mesh.nodes.iter().map(|node| self.slab.single_scattering_albedo(node.mu));
            self.albedo = layer.reflected.row_iter().zip(single).map(|(row, single)| row.sum() / single).collect();
        }
        let (slab, mesh) = (&self.slab, &self.mesh);
        let n = mesh.len();
        // From the share that goes out at a node to radiance there.
        let spread = |j: usize| 1.0 / (2.0 * PI * mesh.weights[j] * mesh.nodes[j].mu);
        let ratio = DMatrix::from_fn(n, n, |i, j| {
            let [one, other] = [i, j].map(|k| mesh.nodes[k]);
            let single = rates.back[(i, j)] * slab.reflected_once(one, other) * other.mu;
            (layer.reflected[(i, j)] - single) * spread(j) / slab.single_scattering_mode_0(one, other)
        });
        self.reflected.push(smooth::symmetric(projection, ratio));
        self.transmitted.push(DMatrix::from_fn(n, n, |i, j| {
            let [one, other] = [i, j].map(|k| mesh.nodes[k]);
            let scattered = if i == j { slab.scattered(one.mu) } else { 0.0 };
            let single = rates.onwards[(i, j)] * slab.transmitted_once(one, other) * other.mu;
            (layer.change[(i, j)] + scattered - single) * spread(j)
        }));
    }

    /// How many azimuthal modes are known.
    pub fn modes(&self) -> usize {
        self.reflected.len()
    }

    /// The slab that is solved.
    pub fn slab(&self) -> &Slab {
        &self.slab
    }

    /// The share R of light of cosine `mu` in \[0, 1\] that leaves by the top. At `mu` = 0 it is the limit, as far as
    /// the mesh resolves it.
    pub fn albedo(&self, mu: f64) -> f64 {
        check_cosine(mu);
        self.mesh.stencil(mu).interpolate(|node| self.albedo[node]) * self.slab.single_scattering_albedo(mu)
    }

    /// The share of light of cosine `mu` in \[0, 1\] that leaves below after one or more scatterings: what is neither unscattered nor
    /// reflected, as nothing is absorbed.
    pub fn transmittance(&self, mu: f64) -> f64 {
        self.slab.scattered(mu) - self.albedo(mu)
    }

    /// The reflected lobe f_r(wi, wo) mu_o, per steradian, all orders. `wi` and `wo` are unit, z >= 0, pointing away.
    pub fn reflected(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.slab.single_scattering(wi, wo) + self.multiple_reflected(wi, wo)
    }

    /// Two and more scatterings' part of [`Self::reflected`].
    pub fn multiple_reflected(&self, wi: DVec3, wo: DVec3) -> f64 {
        let mut modes = [0.0; MOST_MODES];
        let modes = &mut modes[..self.reflected.len()];
        self.multiple_modes(wi.z, wo.z, modes);
        // Propagation azimuths: light from wi goes along -wi.
        cosine_sum(modes, -cos_azimuth(wi, wo)) * wo.z
    }

    /// The azimuthal modes of f_r of two and more scatterings, symmetric in its arguments in \[0, 1\]: f_r is the sum over m of
    /// (1 if m = 0, else 2) `modes[m]` cos(m (pi - phi)), phi = 0 towards `wi`. 0 where both cosines are 0. Panics
    /// where more modes are asked for than [`Self::modes`].
    pub fn multiple_modes(&self, mu_i: f64, mu_o: f64, modes: &mut [f64]) {
        check_cosine(mu_i);
        check_cosine(mu_o);
        assert!(modes.len() <= self.reflected.len(), "{} modes are known: {}", self.reflected.len(), modes.len());
        let single = self.slab.single_scattering_mode_0(Elevation::from_cosine(mu_i), Elevation::from_cosine(mu_o));
        let [from, to] = [mu_i, mu_o].map(|mu| self.mesh.stencil(mu));
        for (mode, matrix) in modes.iter_mut().zip(&self.reflected) {
            *mode = if single > 0.0 { single * bilinear(matrix, &from, &to) } else { 0.0 };
        }
    }

    /// The transmitted lobe, per steradian, all orders except the unscattered light: radiance times cosine, below, per
    /// unit of flux from `wi`. Both directions are unit and point away from the slab, `wi` with z >= 0 and `wo` with
    /// z <= 0. See [`Resolution::ridge`].
    pub fn transmitted(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.slab.single_transmission(wi, wo) + self.multiple_transmitted(wi, wo)
    }

    /// Two and more scatterings' part of [`Self::transmitted`].
    pub fn multiple_transmitted(&self, wi: DVec3, wo: DVec3) -> f64 {
        check_cosine(wi.z);
        check_cosine(-wo.z);
        let [from, to] = [wi.z, -wo.z].map(|mu| self.mesh.stencil(mu));
        let mut modes = [0.0; MOST_MODES];
        let modes = &mut modes[..self.transmitted.len()];
        for (mode, matrix) in modes.iter_mut().zip(&self.transmitted) {
            *mode = bilinear(matrix, &from, &to);
        }
        cosine_sum(modes, -cos_azimuth(wi, wo)) * -wo.z
    }

    /// The mesh's cosines in (0, 1), ascending, and their weights for integrals over the cosine: the lobes of this slab
    /// integrate well on them.
    pub fn cosines(&self) -> impl Iterator<Item = (f64, f64)> {
        self.mesh.nodes.iter().map(|node| node.mu).zip(self.mesh.weights.iter().copied())
    }
}

/// The layer of one mode from its rates.
fn layer(slab: &Slab, mesh: &Mesh, mode: usize, rates: &Rates) -> Layer {
    let n = mesh.len();
    let per_length = |i: usize| slab.thickness() / mesh.nodes[i].mu;
    let gain = DMatrix::from_fn(n, n, |i, j| rates.back[(i, j)] * per_length(i));
    let mut loss = DMatrix::from_fn(n, n, |i, j| if i == j { 0.0 } else { -rates.onwards[(i, j)] * per_length(i) });
    for i in 0..n {
        loss[(i, i)] = if mode == 0 {
            // Nothing is absorbed: what the kernel does not leave at the node, it sends elsewhere.
            gain.row(i).sum() - loss.row(i).sum()
        } else {
            (slab.medium().extinction_at(mesh.nodes[i]) - rates.onwards[(i, i)]) * per_length(i)
        };
    }
    Layer::new(&loss, &gain)
}

fn bilinear(matrix: &DMatrix<f64>, from: &Stencil, to: &Stencil) -> f64 {
    to.interpolate(|j| from.interpolate(|i| matrix[(i, j)]))
}

/// Cosine of the azimuth between two directions; 1 where one of them is the normal.
fn cos_azimuth(one: DVec3, other: DVec3) -> f64 {
    let across = sine(one.z.clamp(-1.0, 1.0)) * sine(other.z.clamp(-1.0, 1.0));
    if across > 0.0 { ((one.x * other.x + one.y * other.y) / across).clamp(-1.0, 1.0) } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_comes_in_at_a_node_goes_out() {
        for alpha in [1.0, 0.3, 0.1, 1.0 / 31.0, 0.01] {
            for thickness in [1e-3, 1.0, 30.0] {
                let slab = Slab::new(alpha).with_thickness(thickness);
                let mesh = Mesh::new(slab.medium().sigma(), 0.5, None);
                let rates = rates(slab.medium(), &mesh, 2);
                // R + T = 1 for each node; the second mode, which carries no energy, is another matter.
                let [kept, second] = [0, 1].map(|mode| {
                    let layer = layer(&slab, &mesh, mode, &rates[mode]);
                    let rows = layer.reflected.row_iter().zip(layer.change.row_iter());
                    rows.map(|(reflected, change)| (reflected.sum() + change.sum()).abs()).fold(0.0, f64::max)
                });
                assert!(kept < 1e-10, "alpha {alpha}, thickness {thickness}: {kept:e}");
                assert!(second > 1e-4, "alpha {alpha}, thickness {thickness}: {second:e}");
            }
        }
    }

    #[test]
    fn rates_sum_to_the_extinction() {
        // The diagonal relies on the sum over all nodes, which product integration gets right by itself.
        for alpha in [1.0, 0.3, 0.1, 1.0 / 31.0] {
            let slab = Slab::new(alpha);
            let mesh = Mesh::new(slab.medium().sigma(), 1.0, None);
            let rates = &rates(slab.medium(), &mesh, 1)[0];
            for (i, node) in mesh.nodes.iter().enumerate() {
                let sum = rates.onwards.row(i).sum() + rates.back.row(i).sum();
                let extinction = slab.medium().extinction_at(*node);
                assert!((sum / extinction - 1.0).abs() < 1e-5, "alpha {alpha}, mu {}: {sum}, {extinction}", node.mu);
            }
        }
    }
}
