//! Means of emissive textures.

use glam::{Affine2, Mat4, Vec2, Vec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;

use super::shapes::{grid, scene};
use crate::scene::emission::Glows;
use crate::scene::notices::Notices;
use crate::scene::{AlphaMode, Filter, Image, Sampler, Scene, Texture, TextureSlot, TextureUse, Wrap, lights};

fn radiance(scene: &Scene, instance: usize) -> Vec3 {
    scene.materials[0].emission * Glows::new(scene).of(instance).emission.as_vec3()
}

/// The inverse of sRGB's curve, by hand.
fn linear(code: u8) -> f64 {
    let encoded = f64::from(code) / 255.0;
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// A square of `cells` by `cells` squares that shows all of an image once.
pub fn emitter(cells: u32, size: [u32; 2], texel: impl FnMut(usize) -> [u8; 4]) -> Scene {
    let mut scene = scene(grid(cells, |_, _| true, |_, _| 0.0), Mat4::IDENTITY);
    let mesh = &mut scene.meshes[0];
    mesh.tex_coords[0] = mesh.positions.iter().map(|position| position.truncate()).collect();
    let texels = (0..(size[0] * size[1]) as usize).map(texel).collect();
    scene.images = vec![Image { name: String::new(), width: size[0], height: size[1], texels }];
    scene.textures = vec![Texture { image: 0, sampler: Sampler::DEFAULT }];
    scene.materials[0].emission = Vec3::new(4.0, 2.0, 1.0);
    let used = TextureUse { texture: 0, tex_coord: 0, uv_from_tex_coord: Affine2::IDENTITY };
    scene.materials[0].textures[TextureSlot::Emission as usize] = Some(used);
    scene
}

pub fn used(scene: &mut Scene) -> &mut TextureUse {
    scene.materials[0].textures[TextureSlot::Emission as usize].as_mut().unwrap()
}

#[test]
fn an_even_texture_is_a_factor() {
    for cells in [1, 7] {
        let mut scene = emitter(cells, [3, 5], |_| [255, 188, 0, 7]);
        let expected = Vec3::new(4.0, 2.0 * linear(188) as f32, 0.0);
        for transform in [Affine2::IDENTITY, Affine2::from_scale(Vec2::splat(1e30)), Affine2::from_scale(Vec2::ZERO)] {
            used(&mut scene).uv_from_tex_coord = transform;
            assert!(radiance(&scene, 0).abs_diff_eq(expected, 1e-5), "{cells} {transform}");
        }
    }
    let mut scene = emitter(1, [1, 1], |_| [255; 4]);
    scene.materials[0].textures = Default::default();
    assert_eq!(radiance(&scene, 0), Vec3::new(4.0, 2.0, 1.0));
}

#[test]
fn noise_comes_out_as_its_mean() {
    let mut random = Pcg32::seed_from_u64(1);
    for size in [[16, 16], [64, 64], [200, 37], [1024, 1024], [2048, 1500]] {
        for cells in [1, 9] {
            let mut sum = [0.0; 3];
            let scene = emitter(cells, size, |_| {
                let texel: [u8; 4] = random.random();
                (0..3).for_each(|channel| sum[channel] += linear(texel[channel]));
                texel
            });
            let mean = Vec3::from(sum.map(|sum| (sum / f64::from(size[0] * size[1])) as f32));
            let found = radiance(&scene, 0) / scene.materials[0].emission;
            let off = (found - mean).abs().max_element();
            assert!(off < 5e-4, "{size:?} {cells}: {found} {mean}");
        }
    }
}

#[test]
fn only_what_the_emitter_shows_counts() {
    // Black on the left, white on the right.
    let mut scene = emitter(2, [64, 64], |index| [if index % 64 < 32 { 0 } else { 255 }; 4]);
    let mut mean = |scale: Vec2, offset: Vec2, wrap: Wrap| {
        used(&mut scene).uv_from_tex_coord = Affine2::from_scale_angle_translation(scale, 0.0, offset);
        scene.textures[0].sampler.wrap = [wrap; 2];
        radiance(&scene, 0).x / 4.0
    };
    let half = Vec2::new(0.5, 1.0);
    for (scale, offset, wrap, expected) in [
        (half, Vec2::ZERO, Wrap::Clamp, 0.0),
        (half, Vec2::new(0.5, 0.0), Wrap::Clamp, 1.0),
        (half, Vec2::new(0.25, 0.0), Wrap::Repeat, 0.5),
        (half, Vec2::new(1.5, 0.0), Wrap::Repeat, 1.0),
        (half, Vec2::new(1.5, 0.0), Wrap::Mirror, 0.0),
        (Vec2::new(2.0, 1.0), Vec2::ZERO, Wrap::Clamp, 0.75),
        (Vec2::new(-3.0, 1.0), Vec2::ZERO, Wrap::Mirror, 0.5),
        (Vec2::splat(300.0), Vec2::ZERO, Wrap::Repeat, 0.5),
    ] {
        let found = mean(scale, offset, wrap);
        // Where black meets white the filter spreads a texel.
        assert!((found - expected).abs() < 0.01, "{scale} {offset} {wrap:?}: {found}");
    }
}

#[test]
fn triangles_count_by_their_area_in_the_world() {
    // Two triangles, a white one three times as large as the black one.
    let mut scene = emitter(1, [2, 1], |index| [if index == 0 { 255 } else { 0 }; 4]);
    let mesh = &mut scene.meshes[0];
    mesh.positions = [[0.0, 0.0], [3.0, 0.0], [0.0, 1.0], [5.0, 0.0], [6.0, 0.0], [5.0, 1.0]]
        .map(|[x, y]| Vec3::new(x, y, 0.0))
        .to_vec();
    mesh.tex_coords[0] = [[Vec2::new(0.25, 0.5); 3], [Vec2::new(0.75, 0.5); 3]].concat();
    mesh.indices = (0..6).collect();
    assert_eq!(radiance(&scene, 0), 0.75 * scene.materials[0].emission);
    // A turn and an even scale change nothing.
    scene.instances[0].world_from_mesh = Mat4::from_rotation_x(1.0) * Mat4::from_scale(Vec3::splat(1e-9));
    assert!((radiance(&scene, 0).x - 3.0).abs() < 1e-5);
}

#[test]
fn each_instance_has_the_mean_over_its_own_area() {
    // A white triangle in the plane z = 0, and a black one in y = 0.
    let mut scene = emitter(1, [2, 1], |index| [if index == 0 { 255 } else { 0 }; 4]);
    let mesh = &mut scene.meshes[0];
    mesh.positions = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ZERO, Vec3::X, Vec3::Z].to_vec();
    mesh.tex_coords[0] = [[Vec2::new(0.25, 0.5); 3], [Vec2::new(0.75, 0.5); 3]].concat();
    mesh.indices = (0..6).collect();
    scene.instances.extend([scene.instances[0].clone(), scene.instances[0].clone()]);
    scene.instances[1].world_from_mesh = Mat4::from_scale(Vec3::new(1.0, 3.0, 1.0));
    scene.instances[2].world_from_mesh = Mat4::from_scale(Vec3::new(1.0, 1.0, 4.0));
    let mut glows = Glows::new(&scene);
    for (instance, share) in [0.5, 0.75, 0.2].into_iter().enumerate() {
        assert!((glows.of(instance).emission.x - share).abs() < 1e-5, "{instance}");
        assert!(glows.is_bright(instance));
    }
}

#[test]
fn odd_coordinates_give_finite_means() {
    for odd in [f32::NAN, f32::INFINITY, f32::MAX, -1e20] {
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            let mut scene = emitter(3, [4, 4], |index| [16 * index as u8; 4]);
            scene.textures[0].sampler.wrap = [wrap; 2];
            scene.meshes[0].tex_coords[0][5] = Vec2::new(odd, 0.5);
            let found = radiance(&scene, 0);
            assert!(found.is_finite() && found.min_element() >= 0.0, "{odd} {wrap:?}: {found}");
            scene.meshes[0].tex_coords[0].clear();
            assert!(radiance(&scene, 0).is_finite());
        }
    }
}

/// Alpha of the base colour's texture: 0 on the left half, `alpha` on the right.
fn cut(scene: &mut Scene, alpha: u8, mode: AlphaMode) {
    let texels = (0..64 * 64).map(|index| [9, 99, 200, if index % 64 < 32 { 0 } else { alpha }]).collect();
    scene.images.push(Image { name: String::new(), width: 64, height: 64, texels });
    let sampler = Sampler { magnify: Filter::Nearest, ..Sampler::DEFAULT };
    scene.textures.push(Texture { image: 1, sampler });
    let used = TextureUse { texture: 1, tex_coord: 0, uv_from_tex_coord: Affine2::IDENTITY };
    scene.materials[0].textures[TextureSlot::BaseColor as usize] = Some(used);
    scene.materials[0].alpha_mode = mode;
}

#[test]
fn what_is_cut_out_or_transparent_does_not_shine() {
    let (mask, blend) = (AlphaMode::Mask { cutoff: 0.5 }, AlphaMode::Blend);
    for textured in [true, false] {
        // White where there is a texture.
        let seen = |alpha: u8, mode: AlphaMode, opacity: f32| {
            let mut scene = emitter(3, [2, 2], |_| [255; 4]);
            cut(&mut scene, alpha, mode);
            scene.materials[0].opacity = opacity;
            if !textured {
                scene.materials[0].textures[TextureSlot::Emission as usize] = None;
            }
            Glows::new(&scene).of(0)
        };
        for (alpha, mode, opacity, expected, area) in [
            (255, AlphaMode::Opaque, 0.3, 1.0, 1.0),
            (255, mask, 1.0, 0.5, 0.5),
            (200, mask, 1.0, 0.5, 0.5),
            (100, mask, 1.0, 0.0, 0.0),
            (200, mask, 0.5, 0.0, 0.0),
            (255, blend, 1.0, 0.5, 0.5),
            (51, blend, 1.0, 0.1, 0.5),
            (51, blend, 0.5, 0.05, 0.5),
        ] {
            let found = seen(alpha, mode, opacity);
            assert!((found.emission - expected).abs().max_element() < 1e-3, "{alpha} {mode:?} {opacity}: {found:?}");
            assert!((found.area - area).abs() < 2e-3, "{alpha} {mode:?} {opacity}: {found:?}");
            assert_eq!(found.glowing, found.area);
        }
    }
}

/// Without textures, by the factor and by what vertices say: over a triangle, alpha runs from 0 to 1 along x.
#[test]
fn opacity_counts_without_textures() {
    for (mode, expected) in [(AlphaMode::Blend, 0.5), (AlphaMode::Mask { cutoff: 0.25 }, 0.75)] {
        let mut scene = emitter(4, [1, 1], |_| [255; 4]);
        scene.materials[0].textures = Default::default();
        scene.materials[0].alpha_mode = mode;
        let mesh = &mut scene.meshes[0];
        mesh.colors = mesh.positions.iter().map(|position| [0, 0, 0, (65535.0 * position.x) as u16]).collect();
        let found = Glows::new(&scene).of(0).emission.x;
        assert!((found - expected).abs() < 1e-3, "{mode:?}: {found}");
        scene.meshes[0].colors.clear();
        scene.materials[0].opacity = 0.125;
        let found = Glows::new(&scene).of(0).emission.x;
        assert_eq!(found, if mode == AlphaMode::Blend { 0.125 } else { 0.0 });
    }
}

/// All of a square shows the middle of the white texel beside a black one, or is between the two by a quarter.
#[test]
fn textures_are_looked_up_as_they_are_shown() {
    let mut scene = emitter(2, [2, 1], |index| [if index == 0 { 0 } else { 255 }; 4]);
    scene.textures[0].sampler.wrap = [Wrap::Clamp; 2];
    used(&mut scene).uv_from_tex_coord =
        Affine2::from_scale_angle_translation(Vec2::new(0.5, 1.0), 0.0, Vec2::new(0.5, 0.0));
    for (filter, expected) in [(Filter::Nearest, 1.0), (Filter::Linear, 0.875)] {
        scene.textures[0].sampler.magnify = filter;
        let found = Glows::new(&scene).of(0);
        assert!((found.emission.x - expected).abs() < 1e-4, "{filter:?}: {found:?}");
    }
}

#[test]
fn a_label_on_a_thing_is_told_from_a_lamp() {
    for (columns, glowing) in [(64, 1.0), (40, 0.625), (4, 0.0625)] {
        let mut scene = emitter(2, [64, 64], |index| [if index % 64 < columns { 9 } else { 0 }; 4]);
        scene.textures[0].sampler.magnify = Filter::Nearest;
        let seen = Glows::new(&scene).of(0);
        assert!((seen.glowing - glowing).abs() < 1e-3 && seen.area == 1.0, "{columns}: {seen:?}");
        scene.materials[0].emission = Vec3::ONE;
        lights::add_lights(&mut scene, 0, &mut Notices::default());
        assert_eq!(scene.lights[0].is_lamp(), columns > 32, "{columns}: {}", scene.lights[0].glowing_share);
    }
}
