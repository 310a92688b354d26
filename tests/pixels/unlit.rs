//! Unlit surfaces come out as they are, whatever exposure and tone curve.

use glam::Vec3;
use velour::picture::{DisplayImage, ToneCurve};
use velour::reference::{Effort, Options, Reference};
use velour::renderer::Offscreen;
use velour::scene::{AlphaMode, Edits, Material, Projection, Scene};
use velour::table::SheenTable;

use super::compare::GPU;
use super::run::unshadowed;
use super::stage::{Stage, Thing, facing, glow, looking, plain};

/// Cells of a grid, along a side, and pixels of a cell, likewise.
const CELLS: usize = 16;
const CELL: usize = 4;
const SIZE: [u32; 2] = [(CELLS * CELL) as u32; 2];

/// IEC 61966-2-1: an 8-bit code as linear light.
fn linear(code: u8) -> f64 {
    let encoded = f64::from(code) / 255.0;
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// And linear light as a code.
fn code(linear: f64) -> f64 {
    255.0 * if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

fn unlit(color: Vec3) -> Material {
    Material { base_color: color, unlit: true, ..plain() }
}

/// Sheets before each other that fill the picture, the farthest first, under a lamp that is not in sight.
fn stage(mut things: Vec<Thing>) -> Stage {
    let lamp = Thing::rectangle([1.0, 1.0], glow([3.0; 3])).placed(facing([0.0, 40.0, 8.0], [0.0; 3]));
    things.push(lamp);
    let mut stage = Stage::new(things, looking([0.0, 0.0, 10.0], [0.0; 3]));
    stage.projection = Projection::Orthographic { ymag: CELLS as f32 / 2.0, near: 0.1, far: 100.0 };
    stage
}

fn sheet(z: f32, material: Material) -> Thing {
    Thing::rectangle([9.0, 9.0], material).placed(facing([0.0, 0.0, z], [0.0, 0.0, z + 1.0]))
}

/// The picture by the device, with one sample a pixel and with four, and by the reference.
fn shown(scene: &Scene, exposure: f32, tone: ToneCurve) -> [DisplayImage; 3] {
    let table = SheenTable::embedded();
    let drawn = unshadowed(scene, &Edits { exposure: Some(exposure.into()), tone: Some(tone), ..Edits::default() });
    let [single, smooth] = [1, 4].map(|samples| {
        let mut renderer = Offscreen::for_display(&GPU, samples, &table, &drawn).unwrap();
        GPU.block_on(renderer.display(&GPU, &scene.cameras[0], SIZE, &drawn.settings)).unwrap()
    });
    let reference = Reference::new(&drawn, &table, Options::default()).unwrap();
    let effort = Effort { samples: 4, seed: 0 };
    let traced = reference.render(&scene.cameras[0], SIZE, effort, |_, _| true).unwrap();
    [single, smooth, traced.display(exposure, tone)]
}

const CURVES: [ToneCurve; 3] = [ToneCurve::None, ToneCurve::Neutral, ToneCurve::Agx];

/// All greys, and the corners, edges and faces of the cube of colours: what is given is what is shown.
#[test]
fn colours_come_out_as_they_are() {
    let steps = [0, 128, 255];
    let saturated = steps.iter().flat_map(|r| steps.iter().flat_map(move |g| steps.map(|b| [*r, *g, b])));
    let greys = (0..=255).map(|grey| [grey; 3]);
    for codes in [greys.collect::<Vec<[u8; 3]>>(), saturated.collect()] {
        let cell = |(index, codes): (usize, &[u8; 3])| {
            let [x, y] = [index % CELLS, index / CELLS].map(|at| at as f32 - 7.5);
            let color = Vec3::from(codes.map(|code| linear(code) as f32));
            Thing::rectangle([0.5, 0.5], unlit(color)).placed(facing([x, -y, 0.0], [x, -y, 1.0]))
        };
        let scene = stage(codes.iter().enumerate().map(cell).collect()).scene();
        for (tone, exposure) in CURVES.into_iter().flat_map(|tone| [0.0, -9.4, 6.0].map(|exposure| (tone, exposure))) {
            for (way, picture) in shown(&scene, exposure, tone).iter().enumerate() {
                for (index, codes) in codes.iter().enumerate() {
                    let at = [index % CELLS, index / CELLS].map(|cell| cell * CELL + CELL / 2);
                    let found = picture.pixels[at[1] * SIZE[0] as usize + at[0]];
                    // Half floats have 11 binary digits, a tenth of a step of 8 bits.
                    let is_close = found.iter().zip(codes).all(|(found, code)| found.abs_diff(*code) <= 1);
                    assert!(is_close, "{way} {tone:?} {exposure} EV: {found:?} for {codes:?}");
                }
            }
        }
    }
}

/// Where they are blended, before something lit or behind it, each shows its share. Between its toe and its shoulder
/// Khronos' curve takes .04 off, so that the shares add up exactly.
#[test]
fn blended_colours_add_up_by_their_shares() {
    let blend = |material: Material| Material { alpha_mode: AlphaMode::Blend, opacity: 0.25, ..material };
    let (color, radiance) = (Vec3::new(0.6, 0.3, 0.5), [0.7, 0.4, 0.9]);
    for (far, near, unlit_share) in
        [(glow(radiance), blend(unlit(color)), 0.25), (unlit(color), blend(glow(radiance)), 0.75)]
    {
        let mut things = stage(vec![sheet(0.0, far), sheet(1.0, near)]);
        // The curtains glow, and light nothing.
        things.things.truncate(2);
        let mut scene = things.scene();
        scene.lights.clear();
        for (exposure, tone, offset) in
            [(0.0, ToneCurve::Neutral, 0.04), (-1.0, ToneCurve::Neutral, 0.04), (-1.0, ToneCurve::None, 0.0)]
        {
            for (way, picture) in shown(&scene, exposure, tone).iter().enumerate() {
                let found = picture.pixels[SIZE[0] as usize * 30 + 30];
                for channel in 0..3 {
                    let lit = f64::from(radiance[channel]) * f64::from(exposure).exp2() - offset;
                    let as_it_is = f64::from(color[channel]);
                    let expected = code(unlit_share * as_it_is + (1.0 - unlit_share) * lit);
                    let off = (f64::from(found[channel]) - expected).abs();
                    assert!(off < 1.0, "{way} {tone:?} {exposure}: {} is not {expected}", found[channel]);
                }
            }
        }
    }
}
