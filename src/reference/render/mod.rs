//! The picture by Monte Carlo.
//!
//! Rays go through a hierarchy of boxes ([`crate::bvh`]); where they meet a surface, light is looked for on the polygons and in the lobes, and
//! weighed by multiple importance sampling. With shadows off and the lobes of real time the expected picture is the one that
//! `velour render --msaa 1` computes in closed form; the other models and `--layering walk` show what that approximates.
//!
//! The same seed gives the same picture, to the last bit, on any number of threads.

mod camera;
mod chooser;
mod convex;
mod film;
mod lights;
mod lobes;
mod models;
mod path;
mod stack;
mod surface;
mod texels;
mod uniforms;
mod world;

pub use film::Picture;

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use camera::View;
use film::Film;
use glam::DVec3;
use lights::Lights;
use models::Models;
use path::{Light, Sample};
use rayon::prelude::*;
use uniforms::Uniforms;
use world::World;

use crate::scene::{Camera, Scene, Settings};
use crate::table::SheenTable;

/// Batches of samples that are made where there are enough: from their scatter errors are estimated.
const BATCHES: u64 = 32;
/// Most samples of a batch: a picture that is asked to end is made of whole batches.
const BATCH_MOST: u64 = 16;
/// Pixels that a thread takes at a time.
const TILE: usize = 256;

/// A reference picture could not be made.
#[derive(Debug, thiserror::Error)]
pub enum ReferenceError {
    #[error(
        "the scene's instances have {triangles} triangles in all, past the {most} that the reference holds: draw fewer instances"
    )]
    Triangles { triangles: usize, most: usize },
    #[error("a picture of {}x{} pixels is past what the reference holds: use at most {most} pixels", size[0], size[1])]
    Size { size: [u32; 2], most: u64 },
}

/// What counts beside the settings that all ways of rendering share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Surfaces that light meets between a light and the one that is seen: 0 is direct light.
    pub max_bounces: u32,
    /// Surfaces stand in each other's light.
    pub shadows: bool,
    pub filter: Filter,
    pub specular: SpecularModel,
}

impl Default for Options {
    fn default() -> Self {
        Self { max_bounces: 0, shadows: true, filter: Filter::Box, specular: SpecularModel::Ltc }
    }
}

/// Where a pixel's samples lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filter {
    /// All over the pixel.
    Box,
    /// At its centre, where `velour render --msaa 1` takes its value.
    Centre,
}

/// What the lobe of the specular base is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpecularModel {
    /// The transformed cosine of real time.
    Ltc,
    /// GGX microfacets themselves.
    Ggx,
}

/// How much is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Samples a pixel, at least 1.
    pub samples: u64,
    pub seed: u64,
}

/// A scene ready to be rendered.
pub struct Reference<'a> {
    light: Light<'a>,
    rays: AtomicU64,
}

impl<'a> Reference<'a> {
    /// Most pixels of a picture.
    pub const PIXELS_MAX: u64 = 1 << 25;

    /// Whether a picture of this size is rendered: some hundred bytes a pixel.
    pub fn check_size(size: [u32; 2]) -> Result<(), ReferenceError> {
        let fits = u64::from(size[0]) * u64::from(size[1]) <= Self::PIXELS_MAX;
        if fits { Ok(()) } else { Err(ReferenceError::Size { size, most: Self::PIXELS_MAX }) }
    }

    /// Builds the hierarchy over all that is drawn.
    pub fn new(
        scene: &'a Scene,
        settings: &'a Settings,
        table: &SheenTable,
        options: Options,
    ) -> Result<Self, ReferenceError> {
        let light = Light {
            world: World::new(scene, settings)?,
            lights: Lights::new(scene),
            models: Models::new(scene, settings, table, options.specular),
            settings,
            options,
        };
        Ok(Self { light, rays: AtomicU64::new(0) })
    }

    /// Triangles of all instances.
    pub fn triangles(&self) -> usize {
        self.light.world.triangles()
    }

    /// Rays that have been followed so far, those towards lights included.
    pub fn rays(&self) -> u64 {
        self.rays.load(Ordering::Relaxed)
    }

    /// Renders on the threads of the current rayon pool. `go_on` is told (done, all) steps of equal size after each, from any thread; once it says no, the
    /// picture is what whole batches there are, but at least one.
    pub fn render(
        &self,
        camera: &Camera,
        size: [u32; 2],
        Effort { samples, seed }: Effort,
        go_on: impl Fn(u64, u64) -> bool + Sync,
    ) -> Result<Picture, ReferenceError> {
        assert!(samples >= 1, "a pixel has samples: {samples}");
        Self::check_size(size)?;
        let pixels = u64::from(size[0]) * u64::from(size[1]);
        let view = View::new(camera, size);
        let (batches, tiles) = (batches(samples), pixels.div_ceil(TILE as u64));
        let all = batches.clone().count() as u64 * tiles;
        let (done, stopped) = (AtomicU64::new(0), AtomicBool::new(false));
        let mut film = Film::new(size);
        for (index, count) in (0_u64..).zip(batches) {
            let tile = |tile: u64| {
                let is_needed = index == 0 || !stopped.load(Ordering::Relaxed);
                let range = tile * TILE as u64..pixels.min((tile + 1) * TILE as u64);
                let means =
                    if is_needed { self.means(&view, size[0], range, (seed, index, count)) } else { Vec::new() };
                if !go_on(done.fetch_add(1, Ordering::Relaxed) + 1, all) {
                    stopped.store(true, Ordering::Relaxed);
                }
                means
            };
            let means: Vec<Vec<DVec3>> = (0..tiles).into_par_iter().map(tile).collect();
            let is_whole = means.iter().map(Vec::len).sum::<usize>() as u64 == pixels;
            if is_whole {
                film.add(means.into_iter().flatten(), count);
            }
            if stopped.load(Ordering::Relaxed) {
                break;
            }
        }
        Ok(film.finish())
    }

    /// The means of a batch's samples over a range of pixels.
    fn means(
        &self,
        view: &View,
        width: u32,
        range: std::ops::Range<u64>,
        (seed, batch, count): (u64, u64, u64),
    ) -> Vec<DVec3> {
        let mut rays = 0;
        let pixel = |pixel: u64| {
            let corner = [pixel % u64::from(width), pixel / u64::from(width)].map(|at| at as f64);
            let one = |index: u64| {
                let mut sample = Sample { uniforms: Uniforms::new(seed, pixel, batch, index as u32), rays: 0 };
                let [x, y, ..] = sample.uniforms.next();
                let [x, y] = if self.light.options.filter == Filter::Box { [x, y] } else { [0.5, 0.5] };
                let (ray, range) = view.ray([corner[0] + x, corner[1] + y]);
                let radiance = self.light.radiance(&ray, range, &mut sample);
                rays += sample.rays;
                radiance
            };
            (0..count).map(one).sum::<DVec3>() / count as f64
        };
        let means = range.map(pixel).collect();
        self.rays.fetch_add(rays, Ordering::Relaxed);
        means
    }
}

/// Samples of each batch, one after another: of as many as make [`BATCHES`], up to [`BATCH_MOST`], in powers of two, which spread best. The first are
/// smaller, so that there is a picture soon.
fn batches(samples: u64) -> impl Iterator<Item = u64> + Clone {
    let usual = 1_u64 << (samples / BATCHES).clamp(1, BATCH_MOST).ilog2();
    let mut left = samples;
    let sizes = (0_u32..).map(move |index| usual.min(1 << index.saturating_sub(1).min(32)));
    sizes.map_while(move |size| {
        let size = size.min(left);
        left -= size;
        (size > 0).then_some(size)
    })
}

/// Rec. 709.
fn luminance(color: DVec3) -> f64 {
    color.dot(DVec3::new(0.2126, 0.7152, 0.0722))
}
