//! From radiance to pictures that are looked at, and pictures of all shapes.

use glam::{Mat4, Vec2, Vec3};
use velour::picture::{DisplayImage, ToneCurve};
use velour::renderer::Offscreen;
use velour::scene::{AlphaMode, Edits, Scene};
use velour::table::SheenTable;

use super::compare::{GPU, SIZE, differences, linear, sheen_alone};
use super::run::unshadowed;
use super::stage::{Stage, Thing, facing, glow, looking, velvet};
use super::truth::Truth;

/// A velvet floor and a bright light that is drawn. Both lie within the picture: drivers cut what leaves it into more
/// triangles, along whose edges four samples are shaded in two places.
fn stage() -> Stage {
    let floor = Thing::rectangle([1.5, 1.5], velvet([0.9, 0.5, 0.2], 0.4)).placed(facing([0.0; 3], [0.0, 1.0, 0.0]));
    let light = Thing::rectangle([0.5, 0.3], glow([4.0, 3.0, 0.2])).placed(facing([0.7, 0.9, -0.8], [0.0, 0.3, 0.4]));
    Stage::new(vec![floor, light], looking([0.4, 1.9, 4.6], [0.1, 0.1, 0.0]))
}

fn shown(scene: &Scene, samples: u32, edits: &Edits, tone: ToneCurve, size: [u32; 2]) -> DisplayImage {
    let drawn = unshadowed(scene, &Edits { tone: Some(tone), ..edits.clone() });
    let mut renderer = Offscreen::for_display(&GPU, samples, &SheenTable::embedded(), &drawn).unwrap();
    GPU.block_on(renderer.display(&GPU, &scene.cameras[0], size, &drawn.settings)).unwrap()
}

/// The greatest difference of two pictures' channels, of 255.
fn greatest(left: &DisplayImage, right: &DisplayImage) -> u8 {
    assert_eq!([left.width, left.height], [right.width, right.height]);
    let channels = left.pixels.as_flattened().iter().zip(right.pixels.as_flattened());
    channels.map(|(left, right)| left.abs_diff(*right)).max().unwrap()
}

#[test]
fn what_is_shown_is_the_radiance_through_exposure_tone_and_srgb() {
    let scene = stage().scene();
    let radiance = linear(&scene, &SheenTable::embedded(), &Edits::default(), SIZE);
    for tone in [ToneCurve::None, ToneCurve::Neutral, ToneCurve::Agx] {
        for exposure in [-2.0, 0.0, 1.3, 6.0] {
            let edits = Edits { exposure: Some(exposure.into()), ..Edits::default() };
            let picture = shown(&scene, 1, &edits, tone, SIZE);
            // On its way radiance is kept in 11 bits: an error of a twentieth of a step, which may tip the rounding to
            // 8 bits.
            assert!(greatest(&picture, &radiance.display(exposure, tone)) <= 1, "{tone:?} {exposure}");
            assert!(greatest(&picture, &radiance.display(exposure + 0.1, tone)) > 1, "{tone:?} {exposure}");
        }
    }
}

#[test]
fn exposure_reaches_radiance_of_any_unit() {
    // Half floats hold neither: they store radiance after exposure.
    for (radiance, exposure) in [(5e5, -20.0), (1e-8, 26.0)] {
        let mut stage = stage();
        stage.things[1].material = glow([radiance; 3]);
        let scene = stage.scene();
        let edits = Edits { exposure: Some(exposure.into()), ..Edits::default() };
        let expected = linear(&scene, &SheenTable::embedded(), &Edits::default(), SIZE);
        let expected = expected.display(exposure, ToneCurve::None);
        let picture = shown(&scene, 1, &edits, ToneCurve::None, SIZE);
        assert!(greatest(&picture, &expected) <= 1, "{radiance} {exposure}");
        assert!(expected.pixels.as_flattened().iter().any(|channel| (100..250).contains(channel)));
    }
}

#[test]
fn a_light_does_not_shine_on_itself() {
    // Far from the origin a surface's points lie off its own plane by the rounding of large coordinates.
    for center in [[0.0; 3], [3.0, 2.0, 1.0], [30.0, 20.0, 10.0]] {
        let [x, y, z] = center;
        let mut lamp = Thing::rectangle([0.3, 0.3], glow([0.5; 3])).placed(facing(center, [x + 0.3, y + 0.5, z + 1.0]));
        (lamp.material.double_sided, lamp.material.base_color) = (true, glam::Vec3::ONE);
        let scene = Stage::new(vec![lamp], looking([x + 0.6, y + 0.4, z + 1.0], center)).scene();
        let picture = linear(&scene, &SheenTable::embedded(), &Edits::default(), SIZE);
        let lit = picture.pixels.iter().filter(|[red, ..]| *red > 0.0).count();
        assert!(lit > 1000, "{center:?}: {lit} pixels");
        assert!(picture.pixels.iter().all(|[red, ..]| *red == 0.0 || *red == 0.5), "{center:?}");
    }
}

#[test]
fn four_samples_smooth_the_edges_alone() {
    let (stage, edits, table) = (stage(), Edits::default(), SheenTable::embedded());
    let scene = stage.scene();
    let single = linear(&scene, &table, &edits, SIZE);
    let drawn = unshadowed(&scene, &edits);
    let mut renderer = Offscreen::for_linear(&GPU, 4, &table, &drawn).unwrap();
    let smooth = GPU.block_on(renderer.linear(&GPU, &scene.cameras[0], SIZE, &drawn.settings)).unwrap();
    let truth = Truth::new(&stage, &table, &edits, SIZE);
    let mut mixed = 0;
    for (index, (single, smooth)) in single.pixels.iter().zip(&smooth.pixels).enumerate() {
        let [x, y] = [index as u32 % SIZE[0], index as u32 / SIZE[0]].map(f64::from);
        // A sixteenth beyond the pixel: where corners may move to.
        let corners = [[-0.06, -0.06], [1.06, -0.06], [-0.06, 1.06], [1.06, 1.06], [0.5, 0.5]];
        let seen = corners.map(|[right, down]| truth.at([x + right, y + down]).map(|hit| (hit.thing, hit.triangle)));
        let close = |(left, right): (&f32, &f32)| (left - right).abs() <= 5e-4 * left.abs();
        let equal = single.iter().zip(smooth).all(close);
        if seen.iter().all(|triangle| *triangle == seen[4]) {
            // 5e-4: the 11 bits of half floats, where a device has no 32-bit ones of four samples.
            assert!(equal, "{x} {y}: {single:?} {smooth:?}");
        }
        mixed += usize::from(!equal);
    }
    // The light's outline alone crosses some 60 pixels.
    assert!(mixed > 40, "{mixed} pixels are mixed");
}

#[test]
fn pictures_past_a_tile_show_no_seam() {
    let (stage, edits, table) = (stage(), sheen_alone(), SheenTable::embedded());
    for size in [[2100, 30], [20, 2060]] {
        let picture = linear(&stage.scene(), &table, &edits, size);
        differences(&picture, &Truth::new(&stage, &table, &edits, size)).unwrap();
        let smooth = shown(&stage.scene(), 1, &edits, ToneCurve::Neutral, size);
        assert!(greatest(&smooth, &picture.display(0.0, ToneCurve::Neutral)) <= 1);
    }
}

#[test]
fn the_same_picture_comes_out_every_time() {
    let (scene, table) = (stage().scene(), SheenTable::embedded());
    let edits = Edits::default();
    let bits = |_| linear(&scene, &table, &edits, SIZE).pixels.concat().into_iter().map(f32::to_bits).collect();
    let [first, second]: [Vec<u32>; 2] = [0, 1].map(bits);
    assert_eq!(first, second);
    let [first, second] = [0, 1].map(|_| shown(&scene, 4, &edits, ToneCurve::Neutral, SIZE));
    assert_eq!(first, second);
}

/// Software drivers are given no more than 65,536 triangles in a pass: what is drawn in parts is what is drawn at once.
#[test]
fn many_triangles_are_drawn_in_parts_without_a_trace() {
    let floor = |parts: u32, blended: bool| {
        let mut scene = stage().scene();
        scene.materials[0].double_sided = true;
        if blended {
            (scene.materials[0].alpha_mode, scene.materials[0].opacity) = (AlphaMode::Blend, 0.5);
        }
        let mesh = &mut scene.meshes[0];
        let place = |at: u32| Vec2::new((at % (parts + 1)) as f32, (at / (parts + 1)) as f32) / parts as f32;
        mesh.positions = (0..(parts + 1) * (parts + 1)).map(|at| (3.0 * place(at) - 1.5).extend(0.0)).collect();
        mesh.normals = vec![Vec3::Z; mesh.positions.len()];
        let quad = |x: u32, y: u32| {
            let at = y * (parts + 1) + x;
            [at, at + 1, at + parts + 2, at, at + parts + 2, at + parts + 1]
        };
        mesh.indices = (0..parts).flat_map(|y| (0..parts).flat_map(move |x| quad(x, y))).collect();
        // More floors: at other heights, so that they hide each other.
        for height in [-0.4, 0.3] {
            let mut other = scene.instances[0].clone();
            other.world_from_mesh.w_axis.y += height;
            scene.instances.push(other);
        }
        linear(&scene, &SheenTable::embedded(), &Edits::default(), SIZE)
    };
    for blended in [false, true] {
        let (whole, parts) = (floor(1, blended), floor(220, blended));
        let differs = |(left, right): &(&[f32; 3], &[f32; 3])| {
            (0..3).any(|channel| (left[channel] - right[channel]).abs() > 1e-3 * (1.0 + left[channel]))
        };
        let count = whole.pixels.iter().zip(&parts.pixels).filter(differs).count();
        // At the floors' edges: 0 on lavapipe, 67 on SwiftShader, which shifts the corners of small triangles.
        assert!(count <= 150, "{count} pixels differ, blended {blended}: more than those at edges");
    }
}

/// Positions are interpolated relative to the camera: drivers err by a share of what they interpolate, most with
/// several samples a pixel.
#[test]
fn a_kilometre_from_the_origin_a_scene_looks_as_at_it() {
    let at = |offset: f32| {
        let mut scene = stage().scene();
        let place = Mat4::from_translation(Vec3::splat(offset));
        let polygons = scene.lights.iter_mut().flat_map(|light| &mut light.polygons);
        let corners = polygons.flat_map(|polygon| &mut polygon.contours).flatten();
        corners.for_each(|corner| *corner += Vec3::splat(offset));
        for instance in &mut scene.instances {
            instance.world_from_mesh = place * instance.world_from_mesh;
        }
        scene.cameras[0].world_from_camera = place * scene.cameras[0].world_from_camera;
        shown(&scene, 4, &Edits::default(), ToneCurve::None, SIZE)
    };
    let (near, far) = (at(0.0), at(1024.0));
    let differs = |(near, far): &(&[u8; 3], &[u8; 3])| (0..3).any(|channel| near[channel].abs_diff(far[channel]) > 10);
    let count = near.pixels.iter().zip(&far.pixels).filter(differs).count();
    assert!(count <= 20, "{count} pixels differ: more than some at edges");
}
