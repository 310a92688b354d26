//! The sphere of explicit fibres under a window.

use super::plate::{PlateError, Progress};
use super::stage::{EYE, YFOV};
use crate::figures::fibres::{Ball, Fate, Planting};
use crate::math::warp::uniform;
use crate::physics::walk::stream;
use crate::picture::{DisplayImage, LinearImage, ToneCurve};
use glam::{DVec3, Vec3};
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// The layer's thickness in units of the sphere's radius, which is 1 with the layer; then the fibres' sizes in
/// thicknesses.
const THICKNESS: f64 = 0.05;
const DIAMETER: f64 = 0.03;
const LENGTH: f64 = 1.0;
const SEED: u64 = 1;

/// What lights the ball, and how many paths are spent.
pub struct Lit {
    /// The window's middle, and its two half sides.
    pub window: [Vec3; 3],
    pub radiance: f32,
    /// Paths per pixel.
    pub samples: u64,
}

/// What the fibres are, for a plate's settings.
pub fn says(alpha: f64) -> String {
    format!(
        "mirrors around the normal as alpha {alpha} has them, in a layer {THICKNESS} thick, {DIAMETER} of that in diameter, \
         {LENGTH} long, all orders of scattering, on a black ball; seed {SEED}"
    )
}

/// The ball of at least 200,000 fibres.
fn planted(alpha: f64) -> Ball {
    Ball::new(&Planting { alpha, diameter: DIAMETER, length: LENGTH, seed: SEED }, 1.0 - THICKNESS, THICKNESS)
}

/// Renders a ball seen from +z: paths from the camera are mirrored until they leave, and then see the window or miss
/// it.
pub fn picture(alpha: f64, lit: &Lit, side: u32, progress: &Progress) -> Result<DisplayImage, PlateError> {
    let ball = planted(alpha);
    let (done, stopped) = (AtomicU64::new(0), AtomicBool::new(false));
    let row = |y: u32| -> Vec<[f32; 3]> {
        let pixel = |x: u32| {
            let mut rng = stream(SEED, u64::from(y * side + x));
            let mut sum = 0;
            for _ in 0..lit.samples {
                let at = [x, y].map(|at| 2.0 * (f64::from(at) + uniform(&mut rng)) / f64::from(side) - 1.0);
                sum += u64::from(sees(&ball, lit, at));
            }
            [(sum as f64 / lit.samples as f64) as f32 * lit.radiance; 3]
        };
        let row = if stopped.load(Ordering::Relaxed) { Vec::new() } else { (0..side).map(pixel).collect() };
        if !progress(done.fetch_add(1, Ordering::Relaxed) + 1, side.into()) {
            stopped.store(true, Ordering::Relaxed);
        }
        row
    };
    let rows: Vec<Vec<[f32; 3]>> = (0..side).into_par_iter().map(row).collect();
    if stopped.load(Ordering::Relaxed) {
        return Err(PlateError::Interrupted);
    }
    let image = LinearImage { width: side, height: side, pixels: rows.concat() };
    Ok(image.display(0.0, ToneCurve::Neutral))
}

/// Whether the path through a point of the picture ends at the window. The point is in [-1, 1] from left to right and
/// from top to bottom.
fn sees(ball: &Ball, lit: &Lit, [x, y]: [f64; 2]) -> bool {
    let extent = (0.5 * f64::from(YFOV)).tan();
    let eye = DVec3::Z * f64::from(EYE);
    let Fate::Left(exit) = ball.trace(eye, DVec3::new(x * extent, -y * extent, -1.0).normalize()) else { return false };
    let [middle, right, up] = lit.window.map(|vector| vector.as_dvec3());
    let normal = right.cross(up);
    let distance = (middle - exit.origin).dot(normal) / exit.direction.dot(normal);
    let at = exit.origin + distance * exit.direction - middle;
    let within = |side: DVec3| (at.dot(side) / side.length_squared()).abs() <= 1.0;
    distance > 0.0 && exit.direction.dot(normal) < 0.0 && within(right) && within(up)
}
