//! The picture by Monte Carlo.
//!
//! Rays go through a hierarchy of boxes ([`crate::bvh`]); where they meet a surface, direct light is sampled on the
//! polygons and in the lobes, and both are weighed by multiple importance sampling. With shadows off and the lobes of
//! real time the expected picture is the one that `velour render --msaa 1` computes in closed form; the other models
//! and `--layering walk` show what that approximates.
//!
//! The same seed gives the same picture, to the last bit, on any number of threads.
//!
//! Files stand on floors: each uses only files of the floors below its own, and this one stands on top.
//!
//! | floor | files |
//! |---|---|
//! | paths | `path`: radiance along a ray, from surface to surface |
//! | layers | `stack`: a random walk through a layer of fibres and its base |
//! | scattering | `scatter`: direct light off the lobes of a surface, and the direction in which a path goes on |
//! | direct light | `direct`: what a point receives from the lights, and what stands in the way |
//! | scene | `context`: all that light meets, with settings and options; `lobes`: what a surface scatters at a point |
//! | models | `models`: the scattering models of each material |
//! | points | `surface`: materials at a point, in its frame; `chooser`: which light is sampled, and by which lobe |
//! | parts | `world`: surfaces as rays meet them; `lights`: polygons as points see them; `film`: means of samples |
//! | patterns | `patterned`: lights that show a pattern, and its texels |
//! | ground | `options`, `error`, `camera`, `uniforms`, `texels`, `luminance`: nothing of the others |

mod camera;
mod chooser;
mod context;
mod direct;
mod error;
mod film;
mod lights;
mod lobes;
mod luminance;
mod models;
mod options;
mod path;
mod patterned;
mod scatter;
mod stack;
mod surface;
mod texels;
mod uniforms;
mod world;

pub use error::ReferenceError;
pub use film::Picture;
pub use options::{Effort, Filter, Options, SpecularModel};

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use camera::View;
use context::Context;
use film::{Film, Means};
use glam::{DVec3, DVec4};
use path::Seen;
use rayon::prelude::*;
use uniforms::{Sample, Uniforms};

use crate::picture::{metered, metered_size};
use crate::scene::{Camera, Drawn};
use crate::table::SheenTable;

/// Batches that the samples are divided into, where there are enough of them: errors are estimated from the batches'
/// scatter.
const BATCHES: u64 = 32;
/// Most samples a pixel in a batch: a picture that is ended early is made of whole batches.
const BATCH_MOST: u64 = 16;
/// The samples of a picture that is metered: of 256 pixels along its longer side, whose noise averages out.
const METERED: Effort = Effort { samples: 4, seed: 0 };
/// Pixels that a thread renders at a time.
const TILE: usize = 256;

/// A scene ready to be rendered.
pub struct Reference<'a> {
    context: Context<'a>,
    rays: AtomicU64,
}

impl<'a> Reference<'a> {
    /// Most pixels of a picture.
    pub const PIXELS_MAX: u64 = 1 << 25;

    /// Refuses pictures of more pixels than [`Self::PIXELS_MAX`]; each takes some hundred bytes.
    pub fn check_size(size: [u32; 2]) -> Result<(), ReferenceError> {
        let fits = u64::from(size[0]) * u64::from(size[1]) <= Self::PIXELS_MAX;
        if fits { Ok(()) } else { Err(ReferenceError::Size { size, most: Self::PIXELS_MAX }) }
    }

    /// Builds the hierarchy over everything that is drawn.
    pub fn new(drawn: &'a Drawn, table: &SheenTable, options: Options) -> Result<Self, ReferenceError> {
        Ok(Self { context: Context::new(drawn, table, options)?, rays: AtomicU64::new(0) })
    }

    /// Triangles of all instances.
    pub fn triangles(&self) -> usize {
        self.context.world.triangles()
    }

    /// Rays that have been followed so far, those towards lights included.
    pub fn rays(&self) -> u64 {
        self.rays.load(Ordering::Relaxed)
    }

    /// Renders on the threads of the current rayon pool. `go_on` is told (done, all) steps of equal size after each,
    /// from any thread; once it says no, the picture is made of the whole batches that there are, at least one.
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
        let mut film = Film::new(size, self.context.world.has_unlit);
        for (index, count) in (0_u64..).zip(batches) {
            let tile = |tile: u64| {
                let is_needed = index == 0 || !stopped.load(Ordering::Relaxed);
                let range = tile * TILE as u64..pixels.min((tile + 1) * TILE as u64);
                let means =
                    if is_needed { self.means(&view, size[0], range, (seed, index, count)) } else { Means::default() };
                if !go_on(done.fetch_add(1, Ordering::Relaxed) + 1, all) {
                    stopped.store(true, Ordering::Relaxed);
                }
                means
            };
            let means: Vec<Means> = (0..tiles).into_par_iter().map(tile).collect();
            let is_whole = means.iter().map(|means| means.radiance.len()).sum::<usize>() as u64 == pixels;
            if is_whole {
                film.add(&means, count);
            }
            if stopped.load(Ordering::Relaxed) {
                break;
            }
        }
        Ok(film.finish())
    }

    /// The exposure value that metering takes for a picture of this size ([`metered`](crate::picture::metered)), as real
    /// time takes it: of what surfaces scatter of direct light without shadows, so that lamps in sight do not count;
    /// where they scatter nothing, of what they emit. None where nothing is lit. Unlit surfaces do not count. The rays
    /// are not counted either. `go_on` is as for `render`.
    pub fn meter(
        &mut self,
        camera: &Camera,
        size: [u32; 2],
        go_on: impl Fn(u64, u64) -> bool + Sync,
    ) -> Result<Option<f32>, ReferenceError> {
        let (settings, options, rays) = (self.context.settings, self.context.options, self.rays());
        self.context.options = Options { max_bounces: 0, shadows: false, filter: Filter::Box, ..options };
        let mut exposure = Ok(None);
        for emission in [false, settings.lobes.emission] {
            self.context.settings.lobes.emission = emission;
            let picture = self.render(camera, metered_size(size), METERED, &go_on);
            exposure = picture.map(|picture| metered(&picture.lit()));
            if !matches!(exposure, Ok(None)) {
                break;
            }
        }
        (self.context.settings, self.context.options, self.rays) = (settings, options, AtomicU64::new(rays));
        exposure
    }

    /// The means of a batch's samples over a range of pixels.
    fn means(
        &self,
        view: &View,
        width: u32,
        range: std::ops::Range<u64>,
        (seed, batch, count): (u64, u64, u64),
    ) -> Means {
        let mut rays = 0;
        let pixel = |pixel: u64| {
            let corner = [pixel % u64::from(width), pixel / u64::from(width)].map(|at| at as f64);
            let one = |index: u64| {
                let mut sample = Sample { uniforms: Uniforms::new(seed, pixel, batch, index as u32), rays: 0 };
                let [x, y, ..] = sample.uniforms.next();
                let [x, y] = if self.context.options.filter == Filter::Box { [x, y] } else { [0.5, 0.5] };
                let (ray, range) = view.ray([corner[0] + x, corner[1] + y]);
                let seen = path::seen(&self.context, &ray, range, &mut sample);
                rays += sample.rays;
                seen
            };
            let sum = |(radiance, unlit), seen: Seen| (radiance + seen.radiance, unlit + seen.unlit);
            (0..count).map(one).fold((DVec3::ZERO, DVec4::ZERO), sum)
        };
        let mut means = Means::default();
        for (radiance, unlit) in range.map(pixel) {
            means.radiance.push(radiance / count as f64);
            if self.context.world.has_unlit {
                means.unlit.push(unlit / count as f64);
            }
        }
        self.rays.fetch_add(rays, Ordering::Relaxed);
        means
    }
}

/// How many samples each batch has, in order: a power of two, which is stratified best, that makes about [`BATCHES`]
/// batches, or [`BATCH_MOST`]. The first ones are smaller, so that there is a picture soon.
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
