//! The lobes of the tables and their layering: `sheen.wgsl` and `ggx.wgsl`.

use super::flat::flat;
use super::function::{Definition, Function, Row, none};
use super::lookup::{ggx, mistaken_ggx, mistaken_sheen, sheen, sheen_error};
use super::mistake::Mistake;
use super::outline::ROUNDING;
use super::walks::lobe;
use crate::models::Schlick;
use crate::table::GgxLobe;
use glam::{DMat3, DVec3};

flat!(SheenPoint { alpha: f64, mu: f64 });
flat!(SheenLobe { m_inv: DMat3, albedo: f64 });
flat!(Layered { sheen_color: DVec3, albedo: f64 });
flat!(Covered { weight: f64, albedo: f64 });
flat!(GgxPoint { roughness: f64, mu: f64 });
flat!(SpecularLobe { m_inv: DMat3, albedo: f64, fresnel: f64 });
flat!(Reflecting { lobe: SpecularLobe, f0: DVec3, f90: DVec3 });
flat!(Specular { albedo: DVec3 });

/// Error of the specular base's shares, of a / c, b / c and 1 / sqrt(c).
pub(super) const GGX_LOOKUP: f64 = 8e-7;

const SHEEN: Definition<SheenPoint, SheenLobe> = Definition {
    name: "sheen_lobe",
    output: "",
    answer: |point| sheen_lobe(sheen(point.alpha, point.mu)),
    tolerance: |point, _| {
        let [a, b, r] = sheen_error(point.alpha, point.mu);
        let mut m_inv = every(1e-7);
        [m_inv.x_axis.x, m_inv.y_axis.y, m_inv.z_axis.x] = [a, a, b];
        SheenLobe { m_inv, albedo: r }
    },
    reason: "4e-7, some roundings of numbers up to 1, and 3e-6 of the difference between the nodes around: weights carry the rounding of alpha and \
             mu times 31. A sampler with weights of 8 bits is off by up to 4e-3 of that difference.",
    mistaken: |point, mistake| match mistake {
        Mistake::MInvTransposed => {
            let lobe = sheen_lobe(sheen(point.alpha, point.mu));
            Some(SheenLobe { m_inv: lobe.m_inv.transpose(), ..lobe })
        }
        other => mistaken_sheen(point.alpha, point.mu, other).map(sheen_lobe),
    },
};

const SHEEN_BASE: Definition<Layered, f64> = Definition {
    name: "sheen_base_weight",
    output: "weight",
    answer: |layered| 1.0 - layered.sheen_color.max_element() * layered.albedo,
    tolerance: |_, _| 3e-7,
    reason: WEIGHT_REASON,
    mistaken: none,
};

const SHEEN_BASE_OPENPBR: Definition<Covered, f64> = Definition {
    name: "sheen_base_weight_openpbr",
    output: "weight",
    answer: |covered| 1.0 - covered.weight * covered.albedo,
    tolerance: |_, _| 3e-7,
    reason: WEIGHT_REASON,
    mistaken: none,
};

const WEIGHT_REASON: &str = "3e-7, some roundings of numbers up to 1.";

const GGX: Definition<GgxPoint, SpecularLobe> = Definition {
    name: "ggx_lobe",
    output: "",
    answer: |point| ggx_lobe(ggx(point.roughness, point.mu)),
    tolerance: |_, lobe| ggx_tolerance(lobe),
    reason: "8e-7, twice the shader's stated error, of albedo, fresnel, a/c, b/c and 1/sqrt(c), and what that makes of a, b and c; and two \
             roundings.",
    mistaken: |point, mistake| match mistake {
        Mistake::MInvTransposed => {
            let lobe = ggx_lobe(ggx(point.roughness, point.mu));
            Some(SpecularLobe { m_inv: lobe.m_inv.transpose(), ..lobe })
        }
        other => mistaken_ggx(point.roughness, point.mu, other).map(ggx_lobe),
    },
};

const GGX_ALBEDO: Definition<Reflecting, DVec3> = Definition {
    name: "ggx_albedo",
    output: "albedo",
    answer: |reflecting| {
        let SpecularLobe { albedo, fresnel, .. } = reflecting.lobe;
        // Never more than 1, but for the rounding of what is given.
        DVec3::from(
            Schlick::channels(reflecting.f0, reflecting.f90).map(|schlick| schlick.albedo(albedo, fresnel).min(1.0)),
        )
    },
    tolerance: |_, _| DVec3::splat(1e-6),
    reason: "1e-6, some roundings of numbers up to 1 over an albedo.",
    mistaken: none,
};

const GGX_BASE: Definition<Specular, f64> = Definition {
    name: "ggx_base_weight",
    output: "weight",
    answer: |specular| (1.0 - specular.albedo.max_element()).max(0.0),
    tolerance: |_, _| 3e-7,
    reason: WEIGHT_REASON,
    mistaken: none,
};

pub(super) fn sheen_lobe([a, b, r]: [f64; 3]) -> SheenLobe {
    SheenLobe { m_inv: lobe(a, b, a), albedo: r }
}

fn ggx_lobe(GgxLobe { ltc, albedo, fresnel }: GgxLobe) -> SpecularLobe {
    SpecularLobe { m_inv: lobe(ltc.a, ltc.b, ltc.c), albedo, fresnel }
}

/// The same number in each entry.
fn every(number: f64) -> DMat3 {
    DMat3::from_cols_array(&[number; 9])
}

fn ggx_tolerance(exact: &SpecularLobe) -> SpecularLobe {
    let [a, b, c] = [exact.m_inv.x_axis.x, exact.m_inv.z_axis.x, exact.m_inv.y_axis.y];
    // c is the width's power -2: off by twice its share.
    let scale = 2.0 * GGX_LOOKUP * c.sqrt();
    let off = |entry: f64| c * GGX_LOOKUP + entry.abs() * (scale + ROUNDING);
    let mut m_inv = every(1e-7);
    [m_inv.x_axis.x, m_inv.z_axis.x, m_inv.y_axis.y] = [off(a), off(b), c * (scale + ROUNDING)];
    SpecularLobe { m_inv, albedo: GGX_LOOKUP, fresnel: GGX_LOOKUP }
}

/// Places in the unit square, named.
pub(super) const PLACES: [(&str, [f64; 2]); 24] = [
    ("between nodes", [0.5, 0.3]),
    ("between nodes", [0.31, 0.87]),
    ("between nodes", [0.77, 0.62]),
    ("between nodes", [0.9, 0.12]),
    ("between nodes", [0.18, 0.45]),
    ("between nodes", [0.63, 0.97]),
    ("between nodes", [0.04, 0.71]),
    ("dust under a grazing view", [0.97, 0.05]),
    ("fuzz under a grazing view", [0.09, 0.03]),
    ("fuzz from above", [0.12, 0.99]),
    ("in the middle of a cell", [10.5 / 31.0, 20.5 / 31.0]),
    ("a node", [10.0 / 31.0, 20.0 / 31.0]),
    ("a node", [23.0 / 31.0, 4.0 / 31.0]),
    ("a node in the last cells", [30.0 / 31.0, 30.0 / 31.0]),
    ("on the diagonal", [0.4, 0.4]),
    ("alpha 0", [0.0, 0.35]),
    ("alpha 1", [1.0, 0.35]),
    ("mu 0", [0.45, 0.0]),
    ("mu 1", [0.45, 1.0]),
    ("alpha 0 and mu 0", [0.0, 0.0]),
    ("alpha 0 and mu 1", [0.0, 1.0]),
    ("alpha 1 and mu 0", [1.0, 0.0]),
    ("alpha 1 and mu 1", [1.0, 1.0]),
    ("out of range: clamped", [1.25, -0.5]),
];

pub(super) fn sheens(index: usize) -> (Function, Vec<Row>) {
    SHEEN.rows(index, PLACES.map(|(case, [alpha, mu])| (case, SheenPoint { alpha, mu })))
}

pub(super) fn ggxs(index: usize) -> (Function, Vec<Row>) {
    let named = |case: &'static str| match case {
        "dust under a grazing view" => "rough under a grazing view",
        "fuzz under a grazing view" => "nearly a mirror under a grazing view",
        "fuzz from above" => "nearly a mirror from above",
        "alpha 0" => "roughness 0",
        "alpha 1" => "roughness 1",
        "alpha 0 and mu 0" => "roughness 0 and mu 0",
        "alpha 0 and mu 1" => "roughness 0 and mu 1",
        "alpha 1 and mu 0" => "roughness 1 and mu 0",
        "alpha 1 and mu 1" => "roughness 1 and mu 1",
        other => other,
    };
    GGX.rows(index, PLACES.map(|(case, [roughness, mu])| (named(case), GgxPoint { roughness, mu })))
}

pub(super) fn sheen_bases(index: usize) -> (Function, Vec<Row>) {
    let layered = |color: [f64; 3], albedo: f64| Layered { sheen_color: color.into(), albedo };
    SHEEN_BASE.rows(
        index,
        [
            ("red is the strongest", layered([0.9, 0.4, 0.1], 0.6)),
            ("green is the strongest", layered([0.2, 0.7, 0.3], 0.35)),
            ("blue is the strongest", layered([0.1, 0.2, 0.8], 0.9)),
            ("white", layered([1.0, 1.0, 1.0], 0.25)),
            ("black", layered([0.0, 0.0, 0.0], 0.5)),
            ("no albedo", layered([0.5, 0.6, 0.7], 0.0)),
        ],
    )
}

pub(super) fn sheen_bases_openpbr(index: usize) -> (Function, Vec<Row>) {
    let covered = |weight: f64, albedo: f64| Covered { weight, albedo };
    SHEEN_BASE_OPENPBR.rows(
        index,
        [
            ("half covered", covered(0.5, 0.6)),
            ("wholly covered", covered(1.0, 0.35)),
            ("not covered", covered(0.0, 0.9)),
            ("no albedo", covered(0.7, 0.0)),
        ],
    )
}

pub(super) fn ggx_albedos(index: usize) -> (Function, Vec<Row>) {
    let reflecting = |albedo: f64, fresnel: f64, f0: [f64; 3], f90: f64| {
        let lobe = SpecularLobe { m_inv: lobe(1.25, 0.9, 1.75), albedo, fresnel };
        Reflecting { lobe, f0: f0.into(), f90: DVec3::splat(f90) }
    };
    GGX_ALBEDO.rows(
        index,
        [
            ("dielectric", reflecting(0.9, 0.05, [0.04, 0.04, 0.04], 1.0)),
            ("dielectric at grazing angles", reflecting(0.75, 0.5, [0.04, 0.05, 0.06], 1.0)),
            ("copper", reflecting(0.85, 0.1, [0.95, 0.64, 0.54], 1.0)),
            ("rough metal", reflecting(0.5, 0.02, [0.9, 0.7, 0.3], 1.0)),
            ("perfect mirror", reflecting(0.6, 0.1, [1.0, 1.0, 1.0], 1.0)),
            ("no reflectance", reflecting(0.8, 0.1, [0.0, 0.0, 0.0], 0.0)),
            ("dark at grazing angles", reflecting(0.8, 0.3, [0.2, 0.5, 0.8], 0.25)),
        ],
    )
}

pub(super) fn ggx_bases(index: usize) -> (Function, Vec<Row>) {
    let specular = |albedo: [f64; 3]| Specular { albedo: albedo.into() };
    GGX_BASE.rows(
        index,
        [
            ("red is the strongest", specular([0.8, 0.4, 0.2])),
            ("green is the strongest", specular([0.1, 0.3, 0.2])),
            ("blue is the strongest", specular([0.04, 0.05, 0.06])),
            ("all of it is reflected", specular([1.0, 1.0, 1.0])),
            ("nothing is reflected", specular([0.0, 0.0, 0.0])),
        ],
    )
}
