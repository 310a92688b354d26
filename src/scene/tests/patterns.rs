//! Patterns of textured emitters.

use glam::{Affine2, DVec3, Mat4, Vec2, Vec3};

use super::emission::{emitter, used};
use crate::scene::notices::Notices;
use crate::scene::{Light, Scene, Wrap, lights};

/// The light of a scene's only emitter.
fn light(mut scene: Scene) -> Light {
    lights::add_lights(&mut scene, 0, &mut Notices::default());
    assert_eq!(scene.lights.len(), 1);
    scene.lights.remove(0)
}

/// The mean of the factors over all polygons.
fn mean(light: &Light) -> DVec3 {
    let (mut sum, mut whole) = (DVec3::ZERO, 0.0);
    for polygon in &light.polygons {
        for part in polygon.convex_parts() {
            let Some(pattern) = &polygon.pattern else { continue };
            let areas = pattern.grid(|point| point).areas(&part);
            sum += areas.iter().map(|&(cell, area)| area * pattern.image.texels[cell].as_dvec3()).sum::<DVec3>();
            whole += areas.iter().map(|(_, area)| area).sum::<f64>();
        }
    }
    sum / whole
}

fn noise(index: usize) -> [u8; 4] {
    let code = |prime: usize| (index * prime % 253) as u8;
    [code(97), code(31), code(59), 255]
}

#[test]
fn the_mean_is_1_however_a_texture_lies() {
    let turned =
        |angle: f32, scale: f32| Affine2::from_scale_angle_translation(Vec2::splat(scale), angle, Vec2::splat(0.2));
    let sheared = Affine2::from_cols(Vec2::new(1.0, 0.3), Vec2::new(0.1, 0.8), Vec2::ZERO);
    // Where the image's own grid is kept, it is wide enough for what the square shows of it.
    for (transform, columns) in [
        (Affine2::IDENTITY, Some(24)),
        (Affine2::from_scale(Vec2::new(3.0, 1.0)), Some(72)),
        (Affine2::from_scale(Vec2::new(-0.5, 1.0)), Some(12)),
        (Affine2::from_scale(Vec2::new(100.0, 1.0)), Some(480)),
        (turned(std::f32::consts::FRAC_PI_2, 1.0), Some(25)),
        (turned(0.7, 1.3), None),
        (sheared, Some(64)),
    ] {
        for cells in [1, 5] {
            for wrap in [Wrap::Repeat, Wrap::Mirror] {
                let mut scene = emitter(cells, [24, 16], noise);
                scene.instances[0].world_from_mesh =
                    Mat4::from_rotation_x(0.7) * Mat4::from_scale(Vec3::new(1.0, 2.0 / 3.0, 1.0));
                used(&mut scene).uv_from_tex_coord = transform;
                scene.textures[0].sampler.wrap = [wrap; 2];
                let light = light(scene);
                let pattern = light.polygons[0].pattern.as_ref().expect("noise is no even light");
                assert!(
                    columns.is_none_or(|columns| columns == pattern.image.size[0]),
                    "{transform}: {:?}",
                    pattern.image.size
                );
                assert!((mean(&light) - 1.0).abs().max_element() < 1e-5, "{transform}: {}", mean(&light));
                let [right, down] = pattern.axes.map(Vec3::normalize);
                assert!(right.dot(down).abs() < 2e-4 && right.dot(light.polygons[0].normal).abs() < 1e-5);
            }
        }
    }
}

/// Four texels become one, whose factor is their mean.
#[test]
fn large_images_are_averaged() {
    let light = light(emitter(1, [1024, 700], noise));
    let pattern = light.polygons[0].pattern.as_ref().expect("a pattern");
    assert_eq!(pattern.image.size, [512, 350]);
    let linear = |index: usize| crate::scene::linear_from_srgb(noise(index)[0]);
    let expected = (linear(0) + linear(1) + linear(1024) + linear(1025)) / 4.0;
    // The emission's red is 4, and the first row of the image lies at y = 0.
    let found = pattern.image.texels[0].x * light.radiance.x / 4.0;
    assert!((found - expected).abs() < 1e-5, "{found} {expected}");
}

/// Two squares that are even, but not alike, have a texel each; of the light's radiance, which is their mean.
#[test]
fn parts_of_one_emitter_are_told_apart() {
    let mut scene = emitter(1, [2, 1], |index| if index == 0 { [255, 0, 0, 255] } else { [0, 255, 0, 255] });
    let mesh = &mut scene.meshes[0];
    mesh.positions.extend(mesh.positions.clone().iter().map(|position| 2.0 * Vec3::X + 0.5 * *position + Vec3::Z));
    mesh.indices.extend(mesh.indices.clone().iter().map(|corner| corner + 4));
    mesh.normals = vec![Vec3::Z; 8];
    mesh.tex_coords[0] = [[Vec2::new(0.25, 0.5); 4], [Vec2::new(0.75, 0.5); 4]].concat();
    let light = light(scene);
    let radiance = |at: usize| {
        let polygon = &light.polygons[at];
        light.radiance.as_dvec3() * polygon.factor(polygon.contours[0][0].as_dvec3())
    };
    assert!(radiance(0).distance(DVec3::X * 4.0) < 1e-5 && radiance(1).distance(DVec3::Y * 2.0) < 1e-5);
    assert_eq!(light.polygons[0].pattern.as_ref().expect("a texel").image.size, [1, 1]);
    assert!((light.radiance.x - 3.2).abs() < 1e-5, "{}", light.radiance);
}

/// What is left of an emitter that another overlaps keeps what it shows.
#[test]
fn what_is_left_of_a_polygon_keeps_its_pattern() {
    let mut scene = emitter(1, [4, 4], noise);
    let moved =
        crate::scene::Instance { world_from_mesh: Mat4::from_translation(Vec3::X * 0.5), ..scene.instances[0].clone() };
    scene.instances.push(moved);
    lights::add_lights(&mut scene, 0, &mut Notices::default());
    let [first, second] = &scene.lights[..] else { panic!("{:?}", scene.lights.len()) };
    let [first, second] = [first, second].map(|light| &light.polygons[0]);
    let corner = DVec3::new(1.1, 0.1, 0.0);
    assert!(second.contours[0].iter().all(|vertex| vertex.x > 0.999));
    assert_eq!(second.factor(corner), first.factor(corner - DVec3::X * 0.5));
}

#[test]
fn odd_coordinates_give_finite_patterns() {
    for odd in [f32::NAN, f32::MAX] {
        let mut scene = emitter(3, [4, 4], noise);
        scene.meshes[0].tex_coords[0][5] = Vec2::new(odd, 0.5);
        let light = light(scene);
        let factors = light.polygons[0].pattern.iter().flat_map(|pattern| &pattern.image.texels);
        assert!(factors.copied().all(|factor| factor.is_finite() && factor.min_element() >= 0.0), "{odd}");
    }
}
