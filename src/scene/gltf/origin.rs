//! The origin of a scene of its own: scenes may stand millions of metres from the origin of their file, by coordinates of
//! the Earth say, where 32-bit floats are decimetres apart. So nodes are placed in `f64`, and what is left of that in
//! `f32` is counted from near the scene's subject.

use glam::{DMat4, DVec3};

use super::assembly::Placement;
use super::nodes::Nodes;
use crate::scene::notices::Notices;
use crate::scene::{Bounds, Instance, Scene};

/// A scene whose subject is this near to the file's origin, in its own radii, keeps that origin.
const NEAR: f64 = 16.0;
/// The least radius in metres.
const RADIUS_MIN: f64 = 1e-12;

/// Gives the scene its origin, places its instances about it, and makes the nodes count from there.
pub fn set(scene: &mut Scene, placements: Vec<Placement>, nodes: &mut Nodes, notices: &mut Notices) {
    scene.origin = of(scene, &placements);
    if scene.origin != DVec3::ZERO {
        let kind = "the scene stands far from the origin of its file, so that positions are counted from another";
        notices.add(kind, || format!("{} m", scene.origin));
    }
    nodes.count_from(scene.origin);
    scene.instances.extend(placements.into_iter().map(|Placement { name, mesh, mut world_from_mesh }| {
        world_from_mesh.translation -= scene.origin;
        Instance { name, mesh, world_from_mesh: DMat4::from(world_from_mesh).as_mat4() }
    }));
}

/// Near the middle of the subject, or where the file has it. On a grid of about the subject's size, so that the numbers
/// are short and small changes of the subject do not move it.
fn of(scene: &Scene, placements: &[Placement]) -> DVec3 {
    let meshes: Vec<Bounds> = scene.meshes.iter().map(|mesh| Bounds::of_points(&mesh.positions)).collect();
    let is_lit = |placement: &&Placement| !scene.materials[scene.meshes[placement.mesh].material].is_lamp();
    let corners = |placement: &Placement| {
        let world_from_mesh = placement.world_from_mesh;
        meshes[placement.mesh].corners().map(|corner| world_from_mesh.transform_point3(corner.as_dvec3()))
    };
    let widened = |bounds: Option<(DVec3, DVec3)>, corner: DVec3| {
        let (min, max) = bounds.unwrap_or((corner, corner));
        Some((min.min(corner), max.max(corner)))
    };
    let lit = placements.iter().filter(is_lit).flat_map(corners).fold(None, widened);
    let Some((min, max)) = lit.or_else(|| placements.iter().flat_map(corners).fold(None, widened)) else {
        return DVec3::ZERO;
    };
    let (middle, radius) = (min.midpoint(max), (0.5 * min.distance(max)).max(RADIUS_MIN));
    if middle.abs().max_element() <= NEAR * radius {
        return DVec3::ZERO;
    }
    let step = radius.log2().ceil().exp2();
    // Adding zero makes 0 of -0.
    (middle / step).round() * step + DVec3::ZERO
}
