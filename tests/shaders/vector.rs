//! The vector of a light, whose component along any direction is the form factor of a surface that faces that way.

use crate::{device, files, polygons};
use glam::{DMat3, DVec3, Vec3, Vec4};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use velour::reference::polygon;

type Triangle = [Vec3; 3];

fn shaded(triangles: &[Triangle]) -> Vec<Vec4> {
    let source = [&files::source("ltc.wgsl"), include_str!("vector.wgsl")].concat();
    let vertices: Vec<Vec4> = triangles.iter().flatten().map(|vertex| vertex.extend(0.0)).collect();
    device::run(&source, &[bytemuck::cast_slice(&vertices)], None, triangles.len())
}

fn random_triangle(random: &mut Pcg64) -> Triangle {
    std::array::from_fn(|_| (polygons::log_uniform(random, 0.3, 3.0) * polygons::direction(random)).as_vec3())
}

#[test]
fn its_part_along_a_direction_is_the_form_factor_of_a_surface_facing_there() {
    let mut random = Pcg64::seed_from_u64(1);
    let (mut triangles, mut facing) = (Vec::new(), Vec::new());
    while triangles.len() < 20_000 {
        let (triangle, normal) = (random_triangle(&mut random), polygons::direction(&mut random));
        // Clipped at either horizon, it would be two different polygons.
        if triangle.iter().all(|vertex| vertex.z > 0.0 && vertex.as_dvec3().dot(normal) > 0.0) {
            triangles.push(triangle);
            facing.push(normal);
        }
    }
    for ((triangle, normal), found) in triangles.iter().zip(facing).zip(shaded(&triangles)) {
        let (x, y) = normal.any_orthonormal_pair();
        let in_frame = DMat3::from_cols(x, y, normal).transpose();
        let contour: Vec<DVec3> = triangle.iter().map(|vertex| in_frame * vertex.as_dvec3()).collect();
        let exact = polygon::form_factor(&[contour], DMat3::IDENTITY, true);
        let part = found.truncate().as_dvec3().dot(normal);
        assert!((part - exact).abs() < 1e-6, "{part} instead of {exact}: {triangle:?} along {normal}");
    }
}

#[test]
fn it_ends_at_the_horizon_and_its_height_is_the_diffuse_form_factor() {
    let mut random = Pcg64::seed_from_u64(2);
    // One corner above the horizon: the part above it is a triangle, too.
    let triangles: Vec<Triangle> = (0..20_000)
        .map(|_| {
            let mut triangle = random_triangle(&mut random).map(|vertex| vertex.with_z(-vertex.z.abs()));
            triangle[random.random_range(0..3)].z *= -1.0;
            triangle
        })
        .collect();
    let cut: Vec<Triangle> = triangles
        .iter()
        .map(|triangle| {
            let apex = triangle.iter().find(|vertex| vertex.z > 0.0).expect("one corner is above").as_dvec3();
            triangle.map(|vertex| match vertex.as_dvec3() {
                below if below.z < 0.0 => apex.lerp(below, apex.z / (apex.z - below.z)).with_z(0.0).as_vec3(),
                above => above.as_vec3(),
            })
        })
        .collect();
    for ((found, cut), triangle) in shaded(&triangles).iter().zip(shaded(&cut)).zip(&triangles) {
        assert!((found.z - found.w).abs() < 1e-6, "{found}: {triangle:?}");
        // The cut's own rounding, near an edge.
        assert!((found - cut).truncate().length() < 2e-5, "{found} instead of {cut}: {triangle:?}");
    }
}
