//! Means of emissive textures.

use glam::{Affine2, Mat4, Vec2, Vec3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;

use super::shapes::{grid, scene};
use crate::scene::emission::Radiances;
use crate::scene::{Image, Sampler, Scene, Texture, TextureSlot, TextureUse, Wrap};

fn radiance(scene: &Scene, instance: usize) -> Vec3 {
    Radiances::new(scene).of(instance)
}

/// The inverse of sRGB's curve, by hand.
fn linear(code: u8) -> f64 {
    let encoded = f64::from(code) / 255.0;
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// A square of `cells` by `cells` squares that shows all of an image once.
fn emitter(cells: u32, size: [u32; 2], texel: impl FnMut(usize) -> [u8; 4]) -> Scene {
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

fn used(scene: &mut Scene) -> &mut TextureUse {
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
    let mut radiances = Radiances::new(&scene);
    for (instance, share) in [0.5, 0.75, 0.2].into_iter().enumerate() {
        assert!((radiances.of(instance).x - 4.0 * share).abs() < 1e-5, "{instance}");
        assert!(radiances.is_bright(instance));
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
