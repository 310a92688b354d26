//! The picture of the scene: what of it is drawn when, from the first coarse pixels to the last sample.

use std::sync::Arc;

use glam::Vec3;

use super::change::Change;
use super::frame_time::FrameTimes;
use super::native::{self, Task};
use super::order::{Left, Report, Shot};
use super::resting::{Can, Resting, Step};
use crate::picture::Blank;
use crate::renderer::{Built, Format, Gpu, Rect, RenderError, Renderer, SAMPLES, Sample, Showing, View};
use crate::scene::{Camera, Scene, Settings};
use crate::table::SheenTable;

/// Triangles that are sorted for shadows within a frame; more are on a thread of their own.
const QUICK: usize = 10_000;

/// The first of a picture's samples.
const SAMPLE: Sample = Sample { index: 0, seed: 0, spread: true };

/// A scene on the device, and how far its picture has come.
pub(super) struct Picture {
    scene: Arc<Scene>,
    renderer: Renderer,
    /// Its width and height in pixels.
    size: [u32; 2],
    /// What of a change has not been drawn yet.
    undrawn: Change,
    resting: Resting,
    /// Times of coarse frames, or of all where none are.
    times: FrameTimes,
    /// What is built for shadows.
    building: Option<Task<Built>>,
    /// Whether the first picture has been looked at.
    is_checked: bool,
    /// Whether the device has what another picture was drawn with.
    is_foreign: bool,
    /// Whether anything has been drawn.
    is_begun: bool,
    /// Whose shadows can be looked up; none where lights or things have moved since.
    remembered: Option<Camera>,
    /// The middle of what is lit, metres.
    center: Vec3,
}

/// How far an eye may move for shadows to be looked up where they were seen from there, as a share of its distance from what is seen, and
/// how far it may turn, in radians: beyond that too much is seen that was hidden.
const NEAR: [f32; 2] = [0.2, 0.3];

/// Whether two cameras see nearly the same.
fn is_near(camera: &Camera, other: &Camera, center: Vec3) -> bool {
    let [eye, other_eye] = [camera, other].map(|camera| camera.world_from_camera.w_axis.truncate());
    let [back, other_back] = [camera, other].map(|camera| camera.world_from_camera.z_axis.truncate());
    let moved = eye.distance(other_eye) / other_eye.distance(center).max(f32::MIN_POSITIVE);
    moved < NEAR[0] && back.angle_between(other_back) < NEAR[1]
}

impl Picture {
    pub fn new(gpu: &Gpu, format: Format, table: &SheenTable, shot: &Shot) -> Result<Self, RenderError> {
        Ok(Self {
            scene: shot.scene.clone(),
            renderer: Renderer::new(gpu, format, table, &shot.drawn())?,
            size: [0; 2],
            undrawn: Change::Lights,
            resting: Resting::new(gpu.is_software()),
            times: FrameTimes::default(),
            building: None,
            is_checked: false,
            is_foreign: false,
            is_begun: false,
            remembered: None,
            center: shot.scene.subject().center(),
        })
    }

    /// Whether it is one of the scene that is to be shown.
    pub fn is_of(&self, shot: &Shot) -> bool {
        Arc::ptr_eq(&self.scene, &shot.scene)
    }

    /// Takes in what has changed. To be called before anything else is done for an order.
    pub fn receive(&mut self, gpu: &Gpu, shot: &Shot, size: [u32; 2]) -> Result<(), RenderError> {
        let change = if std::mem::take(&mut self.is_foreign) { Change::Lights } else { shot.change };
        if change >= Change::Materials {
            self.renderer.update(gpu, &shot.drawn())?;
        }
        if change == Change::Lights {
            self.remembered = None;
        }
        let resized = if size == self.size { Change::None } else { Change::Drawn };
        self.size = size;
        self.undrawn = self.undrawn.max(change).max(resized);
        Ok(())
    }

    /// Why the next step will take long, where it is known that it will.
    pub fn about_to(&self, shot: &Shot) -> Option<&'static str> {
        let lacks = self.renderer.lacks_pipelines(&shot.settings, &SAMPLE);
        (lacks && !self.resting_after(shot).is_finished()).then_some("compiling shaders")
    }

    /// Draws the next step, if there is one, and waits for the device. Returns whether there is more to show than before.
    pub fn advance(&mut self, gpu: &Gpu, shot: &Shot, report: &mut Report) -> Result<bool, RenderError> {
        self.expose(gpu, shot, report)?;
        let exposure = report.metered.unwrap_or(shot.settings.exposure);
        Ok(self.build_shadows(gpu, shot) && self.draw(gpu, shot, exposure, report))
    }

    /// Says how things stand.
    pub fn tell(&self, shot: &Shot, report: &mut Report) {
        report.samples = self.has_shadows(shot).then(|| {
            let samples = self.renderer.samples();
            [samples, self.resting.until(samples).max(samples)]
        });
        report.notice = self.renderer.notice().map(str::to_owned);
        report.left = match self.resting.is_finished() {
            _ if self.is_foreign => Left::More,
            _ if self.building.is_some() => Left::Built,
            true => Left::Nothing,
            false if self.resting.is_coarse() => Left::Rest,
            false => Left::More,
        };
    }

    /// Shows what has been drawn; false where nothing has.
    pub fn show(
        &mut self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        output: (&wgpu::TextureView, Rect),
        (shot, metered): (&Shot, Option<f32>),
    ) -> bool {
        if !self.is_begun {
            return false;
        }
        let exposure = metered.unwrap_or(shot.settings.exposure);
        self.renderer.show(gpu, encoder, output, Showing::Shown { exposure, tone: shot.settings.tone });
        if let Some(material) = shot.outlined {
            let view = View::new(&shot.camera, self.size, Rect::full(self.size));
            self.renderer.outline(gpu, encoder, output, &view, material);
        }
        true
    }

    /// Draws another picture of the scene, of this size and with as many samples as it takes to look finished, and shows it in all of
    /// the output.
    pub fn aside(
        &mut self,
        gpu: &Gpu,
        (output, size): (&wgpu::TextureView, [u32; 2]),
        shot: &Shot,
    ) -> Result<(), RenderError> {
        self.is_foreign = true;
        self.renderer.update(gpu, &shot.drawn())?;
        let view = View::new(&shot.camera, size, Rect::full(size));
        let showing = Showing::Shown { exposure: shot.settings.exposure, tone: shot.settings.tone };
        let begin = || gpu.device.create_command_encoder(&Default::default());
        let mut encoder = begin();
        for index in 0..if self.has_shadows(shot) { SAMPLES } else { 1 } {
            let sample = Sample { index, ..SAMPLE };
            self.renderer.draw(gpu, &mut encoder, size, (&view, &shot.settings, showing), &sample);
            // What is written for a sample counts for all that is submitted with it.
            gpu.queue.submit([std::mem::replace(&mut encoder, begin()).finish()]);
        }
        self.renderer.show(gpu, &mut encoder, (output, Rect::full(size)), showing);
        gpu.queue.submit([encoder.finish()]);
        native::finish(gpu);
        Ok(())
    }

    fn has_shadows(&self, shot: &Shot) -> bool {
        self.renderer.has_shadows(&shot.settings)
    }

    /// How far the picture has come, where what has changed is counted.
    fn resting_after(&self, shot: &Shot) -> Resting {
        let mut resting = self.resting.clone();
        let least = if self.has_shadows(shot) { Change::Drawn } else { Change::Exposed };
        if self.undrawn >= least {
            resting.moved();
        }
        resting
    }

    fn draw(&mut self, gpu: &Gpu, shot: &Shot, exposure: f32, report: &mut Report) -> bool {
        self.resting = self.resting_after(shot);
        self.undrawn = Change::None;
        let is_near = self.remembered.as_ref().is_some_and(|camera| is_near(&shot.camera, camera, self.center));
        let can = Can { shadow: self.has_shadows(shot), remember: is_near && self.renderer.remembers(&shot.settings) };
        let height = self.size[1];
        let step = self.resting.step(height, &can);
        if step == Step::Enough {
            return false;
        }
        let (made, start) = (self.renderer.made(), native::now());
        self.encode(gpu, shot, exposure, &step);
        native::finish(gpu);
        let time = (made == self.renderer.made()).then(|| start.elapsed());
        self.resting.drawn(&step, (height, &can), time);
        let is_whole = |rows: &std::ops::Range<u32>| *rows == (0..height);
        let is_first = match &step {
            Step::Coarse(_) => true,
            Step::Remember(divisor) => *divisor > 1,
            Step::Rows(index, rows) => *index == 0 && is_whole(rows),
            Step::Enough => false,
        };
        if matches!(&step, Step::Coarse(_)) || matches!(&step, Step::Rows(0, rows) if rows.end == height) {
            self.remembered = Some(shot.camera.clone());
        }
        if let Some(time) = time.filter(|_| is_first) {
            self.times.add(time);
            report.frame_time = self.times.median();
        }
        !matches!(step, Step::Rows(_, rows) if rows.end < height)
    }

    /// Has the device draw a step.
    fn encode(&mut self, gpu: &Gpu, shot: &Shot, exposure: f32, step: &Step) {
        self.is_begun = true;
        let full = self.size;
        let view = View::new(&shot.camera, full, Rect::full(full));
        let showing = Showing::Shown { exposure, tone: shot.settings.tone };
        let frame = (&view, &shot.settings, showing);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let fewer = |divisor: u32| full.map(|side| side.div_ceil(divisor));
        match step {
            Step::Coarse(divisor) => self.renderer.draw(gpu, &mut encoder, fewer(*divisor), frame, &SAMPLE),
            Step::Remember(divisor) => self.renderer.draw_remembering(gpu, &mut encoder, fewer(*divisor), frame),
            Step::Rows(index, rows) => {
                let sample = Sample { index: *index, ..SAMPLE };
                self.renderer.draw_rows(gpu, &mut encoder, full, frame, &sample, rows.clone());
            }
            Step::Enough => {}
        }
        gpu.queue.submit([encoder.finish()]);
    }

    /// Sees to what shadows take, and whether the picture may be drawn: where it is built on a thread of its own the first picture
    /// comes without shadows, others once it is there.
    fn build_shadows(&mut self, gpu: &Gpu, shot: &Shot) -> bool {
        if let Some(task) = self.building.take_if(|task| task.is_done())
            && let Some(built) = task.outcome()
        {
            self.renderer.receive(gpu, built);
            self.undrawn = Change::Lights;
        }
        // At rest nothing can have become stale.
        if self.building.is_none()
            && self.undrawn >= Change::Drawn
            && let Some(blockers) = self.renderer.blockers(gpu, &shot.drawn())
        {
            if blockers.triangles() > QUICK {
                self.building = Some(Task::start(|| blockers.build()));
            } else {
                self.renderer.receive(gpu, blockers.build());
            }
        }
        self.building.is_none() || !self.has_shadows(shot)
    }

    /// Meters where that is asked for; and looks, once, whether the first picture shows anything.
    fn expose(&mut self, gpu: &Gpu, shot: &Shot, report: &mut Report) -> Result<(), RenderError> {
        let Shot { camera, settings, .. } = shot;
        if shot.meter {
            let metered = self.renderer.meter(gpu, camera, self.size, settings);
            report.metered = Some(native::block_on_device(gpu, metered)?.unwrap_or(0.0));
            self.undrawn = self.undrawn.max(Change::Exposed);
        }
        if std::mem::replace(&mut self.is_checked, true) {
            return Ok(());
        }
        let exposure = report.metered.unwrap_or(settings.exposure);
        let exposed = Settings { exposure, ..*settings };
        let seen = self.renderer.glance(gpu, camera, self.size, &exposed);
        let seen = native::block_on_device(gpu, seen)?.display(0.0, settings.tone);
        if let Some(blank) = Blank::of(&seen) {
            let metered = self.renderer.meter(gpu, camera, self.size, settings);
            report.advice = blank.advice(exposure, native::block_on_device(gpu, metered)?);
        }
        Ok(())
    }
}
