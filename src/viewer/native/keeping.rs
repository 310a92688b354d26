//! Pictures that are saved: drawn and written one after another, each on a thread of its own, while the window goes on.

use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use super::super::health::Health;
use super::super::order::Shot;
use super::super::pace::Pace;
use super::super::saving::{Progress, Wish, extension};
use super::{Task, block_on_device, finish, folder, now, numbered_place, one_line, place, quietly, write};
use crate::file::check_writable;
use crate::picture::{Exposure, Format};
use crate::renderer::{Effort, Gpu, Offscreen, RenderError};
use crate::scene::Settings;
use crate::table::SheenTable;

/// Samples a pixel of what has no shadows, as `velour render` has them.
const MULTISAMPLES: u32 = 4;

/// What is to be saved.
pub struct Job {
    /// What the scene is called.
    pub name: String,
    pub shot: Shot,
    /// Its size is a number.
    pub wish: Wish,
}

/// What draws a picture.
#[derive(Clone)]
pub struct Means {
    pub gpu: Gpu,
    pub table: Arc<SheenTable>,
    pub health: Health,
}

/// Saves pictures.
#[derive(Default)]
pub struct Keeper {
    at: Option<At>,
    waiting: VecDeque<Job>,
}

/// The picture that is being saved.
struct At {
    told: Arc<Told>,
    task: Task<Result<String, String>>,
}

/// What the thread tells of itself, and is told.
struct Told {
    /// What the file will be called, once that is known.
    name: Mutex<String>,
    /// In millionths.
    share: AtomicU64,
    is_drawn: AtomicBool,
    is_stopped: AtomicBool,
}

impl Keeper {
    /// Saves this picture once those before it are.
    pub fn keep(&mut self, means: Means, job: Job) {
        self.waiting.push_back(job);
        self.go_on(means);
    }

    /// How far the picture is that is being saved.
    pub fn progress(&self) -> Option<Progress> {
        let told = &self.at.as_ref()?.told;
        let is_drawn = told.is_drawn.load(Ordering::Relaxed);
        Some(Progress {
            name: told.name.lock().unwrap_or_else(PoisonError::into_inner).clone(),
            doing: if is_drawn { "Writing" } else { "Drawing" },
            share: told.share.load(Ordering::Relaxed) as f32 / 1e6,
            waiting: self.waiting.len(),
        })
    }

    /// Ends the drawing of the one that is being saved.
    pub fn stop(&self) {
        self.at.iter().for_each(|at| at.told.is_stopped.store(true, Ordering::Relaxed));
    }

    /// What became of a picture; none while one is drawn. The next one is drawn by these means.
    pub fn heard(&mut self, means: impl FnOnce() -> Means) -> Option<String> {
        let at = self.at.take_if(|at| at.task.is_done())?;
        let name = at.told.name.lock().unwrap_or_else(PoisonError::into_inner).clone();
        self.go_on(means());
        // A panic has said what there is to say.
        let done = at.task.outcome().unwrap_or_else(|| Err("it could not be drawn".to_owned()));
        Some(done.unwrap_or_else(|why| format!("can't save {name}: {why}")))
    }

    /// Begins with the next one, if there is one and none is at work.
    fn go_on(&mut self, means: Means) {
        if self.at.is_some() {
            return;
        }
        let Some(job) = self.waiting.pop_front() else { return };
        let (is_drawn, is_stopped) = (AtomicBool::new(false), AtomicBool::new(false));
        let name = Mutex::new("the picture".to_owned());
        let told = Arc::new(Told { name, share: AtomicU64::new(0), is_drawn, is_stopped });
        let at = told.clone();
        self.at = Some(At { told, task: Task::start(move || save(&means, &job, &at)) });
    }
}

impl Drop for Keeper {
    /// Ends what is drawn, and waits: drivers do not like to be left in the middle of something.
    fn drop(&mut self) {
        self.stop();
        if let Some(at) = self.at.take() {
            at.task.outcome();
        }
    }
}

/// Draws a picture and writes it; says where, or why not.
fn save(Means { gpu, table, health }: &Means, job: &Job, told: &Told) -> Result<String, String> {
    let Wish { settings, name } = &job.wish;
    let free = || match name {
        Some(name) => place(settings, name),
        None => numbered_place(&folder(settings.folder.as_deref()), extension(settings.format)),
    };
    let path = free()?;
    *told.name.lock().unwrap_or_else(PoisonError::into_inner) = file_name(&path);
    // Before all the work.
    check_writable(&path).map_err(|error| error.to_string())?;
    let drawn = quietly(|| within_memory(gpu, || draw(gpu, table, job, told)));
    let drawn = drawn.unwrap_or_else(|why| Err(Failed::Because(why)));
    if let Some(why) = health.ailment() {
        return Err(format!("the graphics device was lost ({why})"));
    }
    let (bytes, notices) = match drawn {
        Ok(drawn) => drawn,
        Err(Failed::Stopped) => return Ok(format!("{} is not saved: it was cancelled", file_name(&path))),
        Err(Failed::Because(why)) => return Err(why),
    };
    if told.is_stopped.load(Ordering::Relaxed) {
        return Ok(format!("{} is not saved: it was cancelled", file_name(&path)));
    }
    let path = write(free, &bytes)?;
    Ok(format!("saved {}{notices}", path.display()))
}

fn file_name(path: &std::path::Path) -> String {
    path.file_name().map_or_else(PathBuf::new, PathBuf::from).display().to_string()
}

/// Why a picture was not drawn.
enum Failed {
    Stopped,
    Because(String),
}

impl From<RenderError> for Failed {
    fn from(error: RenderError) -> Self {
        match error {
            RenderError::Stopped => Self::Stopped,
            other => Self::Because(other.to_string()),
        }
    }
}

/// Does work for which the device may have too little memory.
fn within_memory<T>(gpu: &Gpu, work: impl FnOnce() -> Result<T, Failed>) -> Result<T, Failed> {
    // What does not come to be is used all the same.
    let scopes =
        [wgpu::ErrorFilter::Validation, wgpu::ErrorFilter::OutOfMemory].map(|kind| gpu.device.push_error_scope(kind));
    let done = work();
    let errors = scopes.into_iter().rev().map(|scope| block_on_device(gpu, scope.pop()));
    match errors.collect::<Vec<_>>().into_iter().flatten().next() {
        Some(wgpu::Error::OutOfMemory { .. }) => {
            Err(Failed::Because("the device has too little memory for it".to_owned()))
        }
        Some(error) => Err(Failed::Because(error.to_string())),
        None => done,
    }
}

/// The file's bytes, and what there is to say of the picture.
fn draw(gpu: &Gpu, table: &SheenTable, job: &Job, told: &Told) -> Result<(Vec<u8>, String), Failed> {
    let Job { shot, wish, .. } = job;
    let size = wish.settings.size.unwrap_or([1; 2]);
    let drawn = shot.drawn();
    let prepare = match wish.settings.format {
        Format::Png => Offscreen::nearest_for_display,
        Format::Exr => Offscreen::nearest_for_linear,
    };
    let mut renderer = prepare(gpu, MULTISAMPLES, table, &drawn)?;
    renderer.effort = Effort { samples: wish.settings.samples, seed: 0, spread: true };
    let mut settings = drawn.settings;
    let is_metered = shot.edits.exposure == Some(Exposure::Auto) && wish.settings.format == Format::Png;
    if is_metered {
        let metered = renderer.meter(gpu, &shot.camera, size, &settings);
        settings.exposure = block_on_device(gpu, metered)?.unwrap_or(0.0);
    }
    let mut watch = watch(gpu, told);
    let comment = comment(job, &settings);
    let bytes = match wish.settings.format {
        Format::Png => {
            let picture = renderer.display_watched(gpu, &shot.camera, size, &settings, &mut watch);
            let picture = block_on_device(gpu, picture)?;
            told.is_drawn.store(true, Ordering::Relaxed);
            picture.to_png_with_comment(&comment)
        }
        Format::Exr => {
            let picture = renderer.linear_watched(gpu, &shot.camera, size, &settings, &mut watch);
            let picture = block_on_device(gpu, picture)?;
            told.is_drawn.store(true, Ordering::Relaxed);
            picture.to_exr_with_comment(&comment)
        }
    };
    let metered = is_metered.then(|| format!("; exposure auto took {} EV", settings.exposure));
    let notice = renderer.notice().map(|notice| format!("; {notice}"));
    let bytes = bytes.map_err(|error| Failed::Because(error.to_string()))?;
    Ok((bytes, metered.into_iter().chain(notice).collect()))
}

/// Waits for the device after each step, tells how far the picture is, and makes steps so short that the window is drawn meanwhile.
fn watch<'a>(gpu: &'a Gpu, told: &'a Told) -> impl FnMut(crate::renderer::Progress) -> Option<u32> + 'a {
    let mut pace = Pace::new(true);
    let mut last = None;
    move |progress| {
        finish(gpu);
        let time = now();
        if let Some((rows, start)) = last {
            pace.rested(rows, time - start);
        }
        let share = 1_000_000 * progress.done / progress.all.max(1);
        told.share.store(share, Ordering::Relaxed);
        let rows = pace.rows(0, progress.height).len() as u32;
        last = Some((rows, time));
        (!told.is_stopped.load(Ordering::Relaxed)).then_some(rows)
    }
}

/// What is written into a picture: of what it is, and how to have it again.
fn comment(Job { name, shot, .. }: &Job, settings: &Settings) -> String {
    let state = shot.edits.to_text(&shot.scene);
    format!("velour view of {} at {} EV, with this state:\n{state}", one_line(name), settings.exposure)
}
