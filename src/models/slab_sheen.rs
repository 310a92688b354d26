//! The sheen of the slab itself.

use super::elevations::{Drawn, Elevations};
use super::{Bsdf, Sample, check_alpha, check_uniforms, cosine};
use crate::math::frame::AzimuthFrame;
use crate::math::quadrature::gauss_legendre;
use crate::math::{check_cosine, cube_root, near_cube_root};
use crate::physics::modes::Elevation;
use crate::physics::slab::Slab;
use crate::table::{SLAB_SIDE, SlabModes, SlabSlice, SlabTable, SlabWarp};
use glam::DVec3;
use std::f64::consts::PI;

/// Alpha below which the slab is taken to be empty: only directions within 1e-4 of the horizon would show a difference.
pub const EMPTY_BELOW_ALPHA: f64 = 1e-3;

/// Share of the lobe's first azimuthal mode that the azimuth's density is given: with more of it the peak is too sharp.
const FIRST_MODE_SHARE: f64 = 0.75;

/// Number, even, of places in the table's cell at the horizon at which the albedo is held, at squares of equal steps:
/// it goes with mu, which is the place to the power 3/2.
const FIRST_ALBEDOS: usize = 8;

/// Number of all places at which the albedo is held; in further cells these are the ends, where the table has kinks,
/// and the middle. It is quadratic in between.
const ALBEDOS: usize = FIRST_ALBEDOS + 2 * (SLAB_SIDE - 2) + 1;

/// How often the table's cell at the horizon is split, in ratios of 4, for the albedo's quadrature.
const HORIZON_SPLITS: i32 = 6;

/// The root that stands for the horizon's, which is 0.
const LEAST_ROOT: f64 = 1e-100;

/// The sheen of the slab of fibres: single scattering exactly, multiple scattering from a [`SlabTable`].
///
/// Against the solved slab a lobe is off by 0.2% in the mean and by less than 1% (relative L2, alpha >= 1/31 and R > 1e-3; at mu under
/// 1e-5 R is up to 3% too low), and reciprocal to round-off. Below alpha = .0094 it is as far off as
/// [`SlabTable::slice`] says.
///
/// A lobe is sampled by elevation, from a table made for it, then by azimuth, from a wrapped Cauchy density. Weights
/// are at most 1.3, and at most 1.7 R for alpha >= 1/31 and R > 1e-3; their standard deviation is under 0.2 R there.
/// Albedos equal the integrals of [`Bsdf::evaluate`] to a relative 5e-4 where R > 1e-3.
#[derive(Clone, Debug)]
pub struct SlabSheen {
    /// None where the slab is empty.
    lobe: Option<Lobe>,
}

#[derive(Clone, Debug)]
struct Lobe {
    slab: Slab,
    slice: SlabSlice,
    elevations: Elevations,
    /// Logarithms of the albedos.
    log_albedos: [f64; ALBEDOS],
}

impl SlabSheen {
    /// The sheen of roughness `alpha` in \[0, 1\], which is empty below [`EMPTY_BELOW_ALPHA`]; takes a millisecond.
    pub fn new(table: &SlabTable, alpha: f64) -> Self {
        check_alpha(alpha);
        let lobe = (alpha >= EMPTY_BELOW_ALPHA).then(|| Lobe::new(Slab::new(alpha), table.slice(alpha)));
        Self { lobe }
    }

    /// How `wi` and `wo` meet, unless one is below the horizon or the slab is empty.
    #[inline(always)]
    fn meeting(&self, wi: DVec3, wo: DVec3) -> Option<(&Lobe, Meeting)> {
        let (mu_i, mu_o) = (cosine(wi), cosine(wo));
        let lobe = self.lobe.as_ref()?;
        if mu_i < 0.0 || mu_o <= 0.0 {
            return None;
        }
        let (one, other) = (Place::of_cosine(lobe.slice.warp(), mu_i), Place::of_cosine(lobe.slice.warp(), mu_o));
        Some((lobe, Meeting::new(&lobe.slab, &lobe.slice, one, other)))
    }
}

impl Bsdf for SlabSheen {
    fn evaluate(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.meeting(wi, wo).map_or(0.0, |(lobe, meeting)| meeting.value(&lobe.slab, wi, wo))
    }

    fn sample(&self, wi: DVec3, uniforms: [f64; 2]) -> Option<Sample> {
        check_uniforms(uniforms);
        let mu_i = cosine(wi);
        let lobe = self.lobe.as_ref().filter(|_| mu_i >= 0.0)?;
        // What depends on nothing else comes first: it is computed while the rest, a long chain of roots and divisions,
        // waits.
        let frame = AzimuthFrame::of(wi);
        let tangent = WrappedCauchy::tangent(uniforms[1]);
        let warp = lobe.slice.warp();
        let one = Place::of_cosine(warp, mu_i);
        let Drawn { place, w, log_density } = lobe.elevations.sample(one.near, uniforms[0]);
        let (mu_o, log_slope) = warp.mu_and_log_slope(w);
        if mu_o == 0.0 {
            return None;
        }
        let other = Place { elevation: Elevation::from_cosine(mu_o), at: place, near: place };
        let meeting = Meeting::new(&lobe.slab, &lobe.slice, one, other);
        let azimuth = meeting.azimuth();
        let Turn { cos, sin, inverse_pdf } = azimuth.turn(tangent);
        let s = other.elevation.s;
        let wo = frame.outside(DVec3::new(s * cos, s * sin, mu_o));
        let elevation_pdf = log_density * log_slope;
        let weight = meeting.value(&lobe.slab, wi, wo) * (inverse_pdf / elevation_pdf);
        Some(Sample { wo, weight, pdf: elevation_pdf / inverse_pdf })
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        self.meeting(wi, wo).map_or(0.0, |(lobe, meeting)| {
            lobe.elevation_pdf(&meeting) * meeting.azimuth().pdf(meeting.cos_phi(wi, wo))
        })
    }

    fn albedo(&self, mu: f64) -> f64 {
        check_cosine(mu);
        self.lobe.as_ref().map_or(0.0, |lobe| lobe.albedo(mu))
    }
}

impl Lobe {
    fn new(slab: Slab, slice: SlabSlice) -> Self {
        let warp = *slice.warp();
        // The lobe's integral over azimuths, over y; at the horizon its limit.
        let density = |one: f64, other: f64| {
            let one = Place::of_root(&warp, one);
            let other = Place::of_root(&warp, other.max(LEAST_ROOT));
            Meeting::new(&slab, &slice, one, other).mean(&slab) * 2.0 * PI / warp.root_slope(other.elevation.mu)
        };
        let log_albedos = log_albedos(density);
        let elevations = Elevations::new(density);
        Self { slab, slice, elevations, log_albedos }
    }

    /// Density with which the elevation of `wo` is sampled, per unit of its cosine.
    #[inline]
    fn elevation_pdf(&self, Meeting { one, other, .. }: &Meeting) -> f64 {
        self.elevations.log_density(one.near, other.at) * self.slice.warp().log_slope(other.elevation.mu)
    }

    fn albedo(&self, mu: f64) -> f64 {
        let cell = self.slice.warp().place(mu) * (SLAB_SIDE - 1) as f64;
        let x = if cell < 1.0 { cell.sqrt() * FIRST_ALBEDOS as f64 } else { FIRST_ALBEDOS as f64 + 2.0 * (cell - 1.0) };
        let first = 2 * ((x / 2.0) as usize).min((ALBEDOS - 3) / 2);
        let t = (x - first as f64) / 2.0;
        let [low, middle, high] = [0, 1, 2].map(|step| self.log_albedos[first + step]);
        let log = (1.0 - t) * (1.0 - 2.0 * t) * low + 4.0 * t * (1.0 - t) * middle + t * (2.0 * t - 1.0) * high;
        log.exp().min(1.0)
    }
}

/// Where albedo `k` is held, in cells of the table.
fn albedo_cell(k: usize) -> f64 {
    let [k, first] = [k, FIRST_ALBEDOS].map(|k| k as f64);
    if k < first { (k / first).powi(2) } else { 1.0 + (k - first) / 2.0 }
}

/// Logarithms of the albedos: integrals over y of a lobe's `density`, which takes the roots of `wi` and `wo`.
fn log_albedos(density: impl Fn(f64, f64) -> f64) -> [f64; ALBEDOS] {
    // Gauss nodes between the places at which the table has kinks; in the first cell, where lobes of grazing light end
    // steeply, between ever nearer ones.
    let splits = (0..HORIZON_SPLITS).rev().map(|split| 0.25_f64.powi(split));
    let edges: Vec<f64> = [0.0].into_iter().chain(splits).chain((2..SLAB_SIDE).map(|k| k as f64)).collect();
    let root = |cell: f64| SlabWarp::root_from_place(cell / (SLAB_SIDE - 1) as f64);
    let rule: Vec<(f64, f64)> =
        edges.windows(2).flat_map(|pair| gauss_legendre(3, root(pair[0]), root(pair[1]))).collect();
    std::array::from_fn(|k| {
        let one = root(albedo_cell(k));
        rule.iter().map(|&(other, weight)| weight * density(one, other)).sum::<f64>().ln()
    })
}

/// An elevation, and where it is on the table's axis.
#[derive(Clone, Copy)]
struct Place {
    elevation: Elevation,
    /// See [`SlabWarp::place`].
    at: f64,
    /// The same to 1e-4: enough to choose a density.
    near: f64,
}

impl Place {
    #[inline]
    fn of_cosine(warp: &SlabWarp, mu: f64) -> Self {
        let w = warp.w(mu);
        Self { elevation: Elevation::from_cosine(mu), at: cube_root(w), near: near_cube_root(w) }
    }

    #[inline]
    fn of_root(warp: &SlabWarp, root: f64) -> Self {
        let at = cube_root(root * root);
        Self { elevation: Elevation::from_cosine(warp.mu(root)), at, near: at }
    }
}

/// Two elevations, and what is known of how light scatters between them.
struct Meeting {
    one: Place,
    other: Place,
    /// The product of the sines.
    across: f64,
    /// Modes 0 and 1 of the kernel.
    kernel: [f64; 2],
    /// Multiple scattering.
    modes: SlabModes,
}

impl Meeting {
    /// `one` is `wi`'s place, `other` that of `wo`, which is above the horizon.
    #[inline(always)]
    fn new(slab: &Slab, slice: &SlabSlice, one: Place, other: Place) -> Self {
        let mut kernel = [0.0; 2];
        slab.medium().kernel_modes(one.elevation, other.elevation.opposite(), &mut kernel);
        Self { one, other, across: one.elevation.s * other.elevation.s, kernel, modes: slice.at([one.at, other.at]) }
    }

    /// The factor by which kernels are multiplied to give f_r times the cosine of `other`.
    #[inline]
    fn scale(&self, slab: &Slab) -> f64 {
        slab.reflected_once(self.one.elevation, self.other.elevation) * self.other.elevation.mu
    }

    /// The lobe's mean over azimuths.
    fn mean(&self, slab: &Slab) -> f64 {
        self.scale(slab) * self.kernel[0] * self.modes.growth
    }

    /// The lobe.
    #[inline]
    fn value(&self, slab: &Slab, wi: DVec3, wo: DVec3) -> f64 {
        let over = self.modes.over_single(across_cosine(wi, wo), self.across * self.across);
        self.scale(slab) * (slab.medium().kernel(wi, wo) + self.kernel[0] * over)
    }

    /// The density with which azimuths are sampled.
    #[inline]
    fn azimuth(&self) -> WrappedCauchy {
        let [mean, first] = self.kernel;
        let whole = mean * self.modes.growth;
        // The density is over the angle from wi, the modes are over the angle from straight on: hence the minus sign.
        let first = -FIRST_MODE_SHARE * (first + mean * self.modes.first * self.across);
        WrappedCauchy { mean: whole, first: first.clamp(-0.9 * whole, 0.9 * whole) }
    }

    /// Cosine of the azimuth from `wi`; an arbitrary one where there is no azimuth.
    #[inline]
    fn cos_phi(&self, wi: DVec3, wo: DVec3) -> f64 {
        if self.across > 0.0 { (-across_cosine(wi, wo) / self.across).clamp(-1.0, 1.0) } else { 0.0 }
    }
}

/// The density (1 - g^2) / (2 pi (1 + g^2 - 2 g cos(phi))), whose first mode is g times its mean; |g| < 1.
struct WrappedCauchy {
    /// The mean, of any scale above 0.
    mean: f64,
    /// The first mode, g times the mean.
    first: f64,
}

impl WrappedCauchy {
    #[inline]
    fn pdf(&self, cos_phi: f64) -> f64 {
        let Self { mean, first } = self;
        (mean - first) * (mean + first) / (2.0 * PI * (mean * mean + first * first - 2.0 * mean * first * cos_phi))
    }

    /// The tangent of half of a uniform angle, from a uniform number.
    #[inline]
    fn tangent(uniform: f64) -> f64 {
        (PI * (uniform - 0.5)).tan()
    }

    /// The sampled angle, from the tangent of half of a uniform one: that tangent is scaled by (1 - g) / (1 + g).
    #[inline]
    fn turn(&self, tangent: f64) -> Turn {
        let (more, less) = (self.mean + self.first, self.mean - self.first);
        let (along, across) = (more, less * tangent);
        let inverse = 1.0 / (along * along + across * across);
        Turn {
            cos: (along * along - across * across) * inverse,
            sin: 2.0 * along * across * inverse,
            inverse_pdf: 2.0 * PI * more * less * (1.0 + tangent * tangent) * inverse,
        }
    }
}

/// A sampled angle.
struct Turn {
    cos: f64,
    sin: f64,
    /// One over the angle's density.
    inverse_pdf: f64,
}

/// c = s_i s_o cos(pi - phi).
#[inline]
fn across_cosine(wi: DVec3, wo: DVec3) -> f64 {
    -(wi.x * wo.x + wi.y * wo.y)
}
