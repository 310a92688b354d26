//! Meshes that stand for polygon lights where they are drawn.

use glam::{Vec2, Vec3};

use super::{Material, Mesh, Scene};

/// Adds a mesh, with a black material of its own that glows with `emission`: the convex polygon of `corners` in the
/// plane z = 0, counter-clockwise seen from +z, the side to which it shines. Returns the mesh's index.
pub(super) fn add_mesh(scene: &mut Scene, name: &str, corners: &[Vec2], emission: Vec3) -> usize {
    scene.materials.push(Material { emission, ..Material::matte(name, Vec3::ZERO) });
    let fan = (2..corners.len() as u32).flat_map(|corner| [0, corner - 1, corner]);
    scene.meshes.push(Mesh {
        name: name.to_owned(),
        positions: corners.iter().map(|corner| corner.extend(0.0)).collect(),
        normals: vec![Vec3::Z; corners.len()],
        indices: fan.collect(),
        material: scene.materials.len() - 1,
        ..Mesh::default()
    });
    scene.meshes.len() - 1
}

/// A rectangle about the origin, counter-clockwise.
pub(super) fn rectangle(half_size: Vec2) -> [Vec2; 4] {
    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| half_size * Vec2::new(x, y))
}
