//! Memory does not grow with the frames that are drawn: drivers keep what they compile, so that nothing may be compiled anew for a frame.
//!
//! A process of its own, where nobody else takes memory. What it takes is told by Linux.
#![cfg(target_os = "linux")]

mod stage;

use std::sync::{Mutex, PoisonError};

use glam::{Mat4, Vec3};
use stage::{SIZE, Stage};
use velour::picture::ToneCurve;
use velour::renderer::device;
use velour::scene::LightEdits;

/// Frames in which the device compiles what it draws, and caches fill.
const WARM_UP: usize = 20;
/// Frames after them.
const FRAMES: usize = 100;
/// Frames of a drag with the default tone curve.
const DRAG_FRAMES: usize = 1000;
/// Most that all of them may add to the memory, in kB: room for an allocator's whims. Measured: none. A tone curve picked by a uniform
/// takes 380 to 830 kB a frame on Mesa 22.3's lavapipe.
const MOST: usize = 2000;

const TONE_CURVES: [ToneCurve; 3] = [ToneCurve::None, ToneCurve::Neutral, ToneCurve::Agx];

/// Held by the test that runs.
static ALONE: Mutex<()> = Mutex::new(());

/// The memory that this process has written to, whether it is held or swapped out, in kB.
fn taken() -> usize {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let of = |name| {
        let line = status.lines().find_map(|line| line.strip_prefix(name)).expect("Linux tells it");
        line.trim().trim_end_matches(" kB").parse::<usize>().unwrap()
    };
    of("RssAnon:") + of("VmSwap:")
}

/// Runs frames until they have taken too much memory, or all have run: how much they have taken at most, in kB.
fn level(frames: usize, mut frame: impl FnMut(usize)) -> Result<usize, String> {
    (0..WARM_UP).for_each(&mut frame);
    let (first, mut most) = (taken(), 0);
    for index in 0..frames {
        frame(WARM_UP + index);
        let grown = taken().saturating_sub(first);
        if grown > MOST {
            return Err(format!("{grown} kB more after {} frames", index + 1));
        }
        most = most.max(grown);
    }
    Ok(most)
}

/// Whatever a pipeline drew first: some drivers decide then whether they compile anew for each value of a uniform.
#[test]
fn frames_take_no_memory() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let gpu = pollster::block_on(device::open_offscreen(None)).expect("this test needs a device");
    for samples in [1, 4] {
        for tone in TONE_CURVES {
            let mut stage = Stage::new(&gpu, samples, tone, false);
            let hold = |what: &str, held: Result<usize, String>| {
                held.unwrap_or_else(|said| panic!("{what}, {samples} samples, {tone:?} first: {said}"));
            };
            stage.draw();
            hold("the same picture shown again", level(FRAMES, |_| stage.show()));
            hold("the same view drawn again", level(FRAMES, |_| stage.draw()));
            let frames = if tone == ToneCurve::default() { DRAG_FRAMES } else { FRAMES };
            let drag = level(frames, |frame| {
                stage.camera.world_from_camera *= Mat4::from_rotation_z(0.01);
                if frame % 5 == 0 {
                    stage.settings.exposure += 0.1;
                    stage.settings.ambient += 0.01;
                    stage.settings.lobes.sheen ^= true;
                }
                if frame % 7 == 0 {
                    // There are two lights that shine, or one.
                    let light = LightEdits { strength: Some((frame % 2) as f32), ..LightEdits::default() };
                    stage.edits.lights.insert(0, light);
                    stage.update();
                }
                stage.draw();
            });
            hold("a drag while settings and lights change", drag);
            let tones = level(FRAMES, |frame| {
                stage.settings.tone = TONE_CURVES[frame % 3];
                stage.show();
            });
            hold("one tone curve after another", tones);
        }
    }
}

/// A picture with shadows that converges, over and over; while its exposure, a light's place or its size change.
#[test]
fn frames_with_shadows_take_no_memory() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let gpu = pollster::block_on(device::open_offscreen(None)).expect("this test needs a device");
    let mut stage = Stage::new(&gpu, 1, ToneCurve::default(), true);
    let hold = |what: &str, held: Result<usize, String>| {
        let grown = held.unwrap_or_else(|said| panic!("{what}: {said}"));
        println!("{what}: {grown} kB more at most, of {} kB", taken());
    };
    let still = level(DRAG_FRAMES, |frame| if frame % 100 == 0 { stage.draw() } else { stage.refine() });
    hold("a picture that converges", still);
    let exposed = level(DRAG_FRAMES, |frame| {
        stage.settings.exposure = 0.01 * (frame % 100) as f32;
        stage.refine();
    });
    hold("exposures", exposed);
    let lit = level(DRAG_FRAMES, |frame| {
        // It goes to and fro, and is put out now and then.
        let to = 0.01 * (frame % 50) as f32 * Vec3::X;
        let strength = Some(if frame % 10 == 0 { 0.0 } else { 1.0 });
        let position = Some(Vec3::new(-1.0, 0.0, 2.0) + to);
        stage.edits.lights.insert(0, LightEdits { position, strength, ..LightEdits::default() });
        stage.edits.lights_visible = Some(frame % 7 > 0);
        stage.update();
        stage.draw();
    });
    hold("a light that moves", lit);
    let turned = level(DRAG_FRAMES, |frame| {
        stage.camera.world_from_camera *= Mat4::from_rotation_z(0.01);
        stage.settings.lobes.sheen ^= frame % 5 == 0;
        stage.draw();
    });
    hold("a drag of the view", turned);
    let sizes = level(DRAG_FRAMES, |frame| {
        stage.size = SIZE.map(|side| side - (frame % 16) as u32);
        stage.draw();
    });
    hold("sizes", sizes);
}

#[test]
fn what_takes_memory_is_found() {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    assert!(level(FRAMES, |_| ()).is_ok());
    assert!(level(FRAMES, |_| _ = std::hint::black_box(vec![1_u8; 1 << 20].leak())).is_err());
}
