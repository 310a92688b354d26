//! The whole: what a polygon gives a surface with the three lobes, from positions in the world to form factors.

use super::flat::{Flat, flat};
use super::frame::local_from_world;
use super::function::Definition;
use super::lobes::GGX_LOOKUP;
use super::lookup::{ggx, mistaken_ggx, mistaken_sheen, sheen, sheen_error};
use super::mistake::Mistake;
use super::outline::{Edge, begin, edge_vector, next};
use super::walks::lobe;
use crate::reference::polygon;
use crate::table::Ltc;
use glam::{DMat3, DVec3};
use std::f64::consts::{PI, TAU};

/// Most corners of a row's light.
pub(super) const MOST: usize = 8;

flat!(
    /// A shaded point, its materials, and a light in the world.
    Scene {
        position: DVec3,
        normal: DVec3,
        view: DVec3,
        alpha: f64,
        roughness: f64,
        two_sided: f64,
        count: f64,
        corners: [DVec3; MOST],
    }
);

flat!(Factors { mu: f64, a: f64, b: f64, r: f64, diffuse: f64, specular: f64, sheen: f64 });

/// A point this near to a light's plane, as a share of its distance, is in it.
const IN_PLANE: f64 = 1e-9;
/// Error of the cosine.
const COSINE: f64 = 3e-7;
/// How far a corner in the shading frame may be off, as a share of its distance: some roundings of a matrix times a difference.
const PLACE: f64 = 3e-7;
/// By how much the frame may be turned, over the sine between normal and view.
const TURN: f64 = 4e-7;
/// What may be off by more than this is left open.
const FREE: f64 = 1e-3;
/// Error of a form factor of corners that are exact.
const WALK: f64 = 1e-6;

pub(super) const LIGHTS_FACTORS: Definition<Scene, Factors> = Definition {
    name: "lights_factors",
    output: "",
    answer: |scene| Seen::of(scene).factors(),
    tolerance,
    reason: "mu 4e-7; a, b, r what sheen_lobe's may be off by and what mu makes of them; form factors 1e-6 times c/a of the lobe, and what corners that are off by 3e-7 of \
             their distance in the shading frame, and a frame that is turned by 4e-7 over the sine between normal and view, and lookups that are off by their own errors, make of them. Where \
             view and normal coincide, the frame's x axis is any tangent: what depends on it is not compared.",
    mistaken: |scene, mistake| {
        Seen::by_mistake(scene, mistake).map(|(seen, forgets)| match forgets {
            true => seen.without_turn(),
            false => seen.factors(),
        })
    },
};

/// What is known of a scene once its lobes are looked up.
#[derive(Clone)]
struct Seen {
    mu: f64,
    sheen: [f64; 3],
    specular: Ltc,
    /// In the shading frame.
    contour: Vec<DVec3>,
    two_sided: bool,
}

impl Scene {
    fn corners(&self) -> &[DVec3] {
        &self.corners[..self.count as usize]
    }

    /// The cosine between normal and view.
    fn mu(&self) -> f64 {
        self.normal.dot(self.view).max(0.0)
    }

    fn middle(&self) -> DVec3 {
        self.corners().iter().sum::<DVec3>() / self.count
    }
}

impl Seen {
    fn of(scene: &Scene) -> Self {
        Self::within(scene, local_from_world(scene.normal, scene.view))
    }

    fn within(scene: &Scene, frame: DMat3) -> Self {
        let mu = scene.mu();
        Self {
            mu,
            sheen: sheen(scene.alpha, mu),
            specular: ggx(scene.roughness, mu).ltc,
            contour: scene.corners().iter().map(|corner| frame * (*corner - scene.position)).collect(),
            two_sided: scene.two_sided != 0.0,
        }
    }

    /// As it is seen where a mistake is made; and whether the turn is forgotten.
    fn by_mistake(scene: &Scene, mistake: Mistake) -> Option<(Self, bool)> {
        let mut seen = Self::of(scene);
        match mistake {
            Mistake::FrameTransposed => {
                seen = Self::within(scene, local_from_world(scene.normal, scene.view).transpose())
            }
            Mistake::FrameAboutLight => {
                seen = Self::within(scene, local_from_world(scene.normal, scene.middle() - scene.position));
            }
            Mistake::WindingReversed => seen.contour.reverse(),
            Mistake::MInvTransposed => [seen.sheen[1], seen.specular.b] = [0.0; 2],
            Mistake::TurnForgotten => {}
            Mistake::TableTransposed | Mistake::BSign | Mistake::AlphaSquared | Mistake::NoHalfTexel => {
                seen.sheen = mistaken_sheen(scene.alpha, seen.mu, mistake)?;
                seen.specular = mistaken_ggx(scene.roughness, seen.mu, mistake)?.ltc;
            }
        }
        Some((seen, mistake == Mistake::TurnForgotten))
    }

    /// The matrices of the three lobes.
    fn lobes(&self) -> [DMat3; 3] {
        let [a, b, _] = self.sheen;
        let Ltc { a: wide, b: lean, c } = self.specular;
        [DMat3::IDENTITY, lobe(a, b, a), lobe(wide, lean, c)]
    }

    fn factors(&self) -> Factors {
        let contours = [self.contour.clone()];
        self.with(self.lobes().map(|m_inv| polygon::form_factor(&contours, m_inv, self.two_sided)))
    }

    fn with(&self, [diffuse, sheen, specular]: [f64; 3]) -> Factors {
        let [a, b, r] = self.sheen;
        Factors { mu: self.mu, a, b, r, diffuse, sheen, specular }
    }

    /// The sums of the edges' parts above the horizon, which are not closed along it.
    fn without_turn(&self) -> Factors {
        let side = self.side();
        self.with(self.lobes().map(|m_inv| {
            let mut outline = begin(self.contour[self.contour.len() - 1]);
            let mut sum = 0.0;
            for corner in &self.contour {
                outline = next(&outline, *corner);
                sum += edge_vector(&Edge { outline, m_inv }).z;
            }
            (side * sum / TAU).clamp(0.0, 1.0)
        }))
    }

    /// 1 in front of the light, -1 behind a two-sided one, 0 where none of it arrives.
    fn side(&self) -> f64 {
        let about = self.contour[0];
        let next = self.contour.iter().cycle().skip(1);
        let area: DVec3 = self.contour.iter().zip(next).map(|(p, q)| (*p - about).cross(*q - about)).sum();
        let height = -area.normalize_or_zero().dot(about);
        let is_dark = height.abs() <= IN_PLANE * about.length() || (height < 0.0 && !self.two_sided);
        if is_dark { 0.0 } else { height.signum() }
    }
}

fn tolerance(scene: &Scene, exact: &Factors) -> Factors {
    let seen = Seen::of(scene);
    let [a, b, r] = sheen_error(scene.alpha, seen.mu);
    let mut off = Factors { mu: 1e-7, a, b, r, diffuse: WALK, sheen: WALK, specular: WALK };
    off.specular *= (seen.specular.c / seen.specular.a).max(1.0);
    // Where no light arrives nothing else counts: neither do corners that are moved out of their plane.
    let is_dark = seen.side() == 0.0;
    let mut add = |varied: Vec<Seen>| {
        let differences = varied.iter().map(|varied| difference(&varied.factors(), exact));
        let most = differences.reduce(|one, other| combined(one, other, f64::max));
        off = most.map_or(off, |most| combined(off, most, |a, b| a + b));
    };
    add(moved_cosine(scene));
    if !is_dark {
        add(turned(scene));
        add(moved_lookups(&seen, [a, b]));
        (0..seen.contour.len()).for_each(|k| (0..3).for_each(|axis| add(moved_corner(&seen, k, axis))));
    }
    off.each("", &mut |_, tolerance| {
        if *tolerance > FREE {
            *tolerance = f64::INFINITY;
        }
    });
    off
}

/// The same with the frame turned about the normal, as far as rounding does it; where view and normal coincide, anywhere.
fn turned(scene: &Scene) -> Vec<Seen> {
    let across = scene.view.reject_from_normalized(scene.normal.normalize()).length();
    let most = (TURN / across).min(0.5 * PI);
    let frame = local_from_world(scene.normal, scene.view);
    [-most, 0.5 * most, most].map(|by| Seen::within(scene, DMat3::from_rotation_z(by) * frame)).to_vec()
}

/// The same with its lobes looked up at cosines that are off.
fn moved_cosine(scene: &Scene) -> Vec<Seen> {
    let seen = Seen::of(scene);
    [-COSINE, COSINE]
        .map(|by| {
            let mu = (seen.mu + by).max(0.0);
            Seen { mu, sheen: sheen(scene.alpha, mu), specular: ggx(scene.roughness, mu).ltc, ..seen.clone() }
        })
        .to_vec()
}

/// The same with the lobes' numbers off.
fn moved_lookups(seen: &Seen, [a_off, b_off]: [f64; 2]) -> Vec<Seen> {
    let [a, b, r] = seen.sheen;
    let Ltc { a: wide, b: lean, c } = seen.specular;
    let signs = [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]];
    signs
        .map(|[s, t]| {
            let sheen = [a + s * a_off, b + t * b_off, r];
            let grown = 1.0 + 2.0 * s * c.sqrt() * GGX_LOOKUP;
            let [a, b, c] = [wide + s * c * GGX_LOOKUP, lean + t * c * GGX_LOOKUP, c].map(|entry| entry * grown);
            let specular = Ltc { a, b, c };
            Seen { sheen, specular, ..seen.clone() }
        })
        .to_vec()
}

/// The same with a corner off along an axis of the frame.
fn moved_corner(seen: &Seen, k: usize, axis: usize) -> Vec<Seen> {
    let by = PLACE * seen.contour[k].length();
    [-by, by]
        .map(|by| {
            let mut moved = seen.clone();
            moved.contour[k][axis] += by;
            moved
        })
        .to_vec()
}

fn difference(one: &Factors, other: &Factors) -> Factors {
    combined(*one, *other, |one, other| (one - other).abs())
}

fn combined(mut one: Factors, other: Factors, with: impl Fn(f64, f64) -> f64) -> Factors {
    let mut others = other.flat().into_iter();
    one.each("", &mut |_, number| *number = others.next().map_or(*number, |other| with(*number, other)));
    one
}
