//! Meshes that stand for polygon lights where they are drawn.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use super::{LightShape, Material, Mesh, Scene};

/// A disk is lit and drawn as a regular polygon of so many sides whose area is the disk's; its outline is within 0.4%
/// of the radius of the circle. docs/accuracy.md has the errors of its form factors. 256 disks fit in a scene.
const DISK_SIDES: u16 = 32;

/// Adds a mesh, with a black material of its own that glows with `emission`: the convex polygon of `corners` in the
/// plane z = 0, counter-clockwise seen from +z, the side to which it shines. Returns the mesh's index.
pub(super) fn add_mesh(scene: &mut Scene, name: &str, corners: &[Vec2], emission: Vec3) -> usize {
    scene.materials.push(Material { emission, ..Material::matte(name, Vec3::ZERO) });
    scene.meshes.push(mesh(name, corners, scene.materials.len() - 1));
    scene.meshes.len() - 1
}

/// The convex polygon of `corners` in the plane z = 0, counter-clockwise seen from its front, +z.
pub(super) fn mesh(name: &str, corners: &[Vec2], material: usize) -> Mesh {
    let fan = (2..corners.len() as u32).flat_map(|corner| [0, corner - 1, corner]);
    Mesh {
        name: name.to_owned(),
        positions: corners.iter().map(|corner| corner.extend(0.0)).collect(),
        normals: vec![Vec3::Z; corners.len()],
        indices: fan.collect(),
        material,
        ..Mesh::default()
    }
}

/// A rectangle about the origin, counter-clockwise.
pub(super) fn rectangle(half_size: Vec2) -> [Vec2; 4] {
    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| half_size * Vec2::new(x, y))
}

/// A regular polygon about the origin with the area of a disk, counter-clockwise.
pub(super) fn disk(radius: f32) -> Vec<Vec2> {
    let angle = 2.0 * PI / f32::from(DISK_SIDES);
    let reach = radius * (angle / angle.sin()).sqrt();
    (0..DISK_SIDES).map(|side| reach * Vec2::from_angle(angle * f32::from(side))).collect()
}

/// A regular polygon whose corners are so far from the origin, the first of them upwards, counter-clockwise.
fn regular(reach: f32, sides: u16) -> Vec<Vec2> {
    let angle = |side: u16| PI * (0.5 + 2.0 * f32::from(side) / f32::from(sides));
    (0..sides).map(|side| reach * Vec2::from_angle(angle(side))).collect()
}

impl LightShape {
    /// Its corners in the plane z = 0, counter-clockwise; none of a copy.
    pub(super) fn corners(self) -> Option<Vec<Vec2>> {
        match self {
            Self::Rectangle => Some(rectangle(Vec2::splat(0.5)).to_vec()),
            Self::Disk => Some(disk(0.5)),
            Self::Polygon(sides) => Some(regular(0.5, sides)),
            Self::Copy(_) => None,
        }
    }
}
