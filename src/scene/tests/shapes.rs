//! Meshes to take apart and to look at.

use glam::{DVec3, Mat4, Vec3};

use crate::scene::{Instance, Material, Mesh, Polygon, Scene};

/// The squares of side 1/`n` in the unit square that `keep` keeps, each of two triangles, at the heights of `height`.
pub fn grid(n: u32, keep: impl Fn(u32, u32) -> bool, height: impl Fn(f32, f32) -> f32) -> Mesh {
    let mut mesh = Mesh::default();
    for (i, j) in (0..=n).flat_map(|j| (0..=n).map(move |i| (i, j))) {
        let (x, y) = (i as f32 / n as f32, j as f32 / n as f32);
        mesh.positions.push(Vec3::new(x, y, height(x, y)));
    }
    for (i, j) in (0..n).flat_map(|j| (0..n).map(move |i| (i, j))).filter(|&(i, j)| keep(i, j)) {
        let corner = |i: u32, j: u32| j * (n + 1) + i;
        let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        mesh.indices.extend([a, b, c, a, c, d]);
    }
    mesh.normals = vec![Vec3::Z; mesh.positions.len()];
    mesh
}

/// A box from -1 to 1, whose faces share no vertices, turned outwards.
pub fn cube() -> Mesh {
    let mut mesh = Mesh::default();
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let normal = sign * Vec3::AXES[axis];
            let right = Vec3::AXES[(axis + 1) % 3];
            let up = normal.cross(right);
            let first = mesh.positions.len() as u32;
            mesh.positions.extend([-right - up, right - up, right + up, up - right].map(|corner| normal + corner));
            mesh.normals.extend([normal; 4]);
            mesh.indices.extend([0, 1, 2, 0, 2, 3].map(|corner| first + corner));
        }
    }
    mesh
}

/// A sphere of radius 1 of 4 n^2 triangles.
pub fn sphere(n: u32) -> Mesh {
    let mut mesh = grid(n, |_, _| true, |_, _| 0.0);
    for position in &mut mesh.positions {
        let (theta, phi) = (position.y * std::f32::consts::PI, position.x * std::f32::consts::TAU);
        *position = Vec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), -theta.cos());
    }
    mesh.normals = mesh.positions.clone();
    mesh
}

/// The mesh once, grey, as `world_from_mesh` places it.
pub fn scene(mesh: Mesh, world_from_mesh: Mat4) -> Scene {
    let material = Material::matte("", Vec3::ONE);
    Scene {
        meshes: vec![mesh],
        materials: vec![material],
        instances: vec![Instance { name: String::new(), mesh: 0, world_from_mesh }],
        ..Scene::default()
    }
}

/// The area that a polygon's outlines enclose, holes taken off.
pub fn area(polygon: &Polygon) -> f64 {
    let normal = polygon.normal.as_dvec3();
    let contours = polygon.contours.iter().map(|contour| {
        let next = contour.iter().cycle().skip(1);
        contour.iter().zip(next).map(|(a, b)| a.as_dvec3().cross(b.as_dvec3())).sum::<DVec3>()
    });
    0.5 * contours.sum::<DVec3>().dot(normal)
}
