//! Cameras: where they stand, and their projections, with all ranges checked.

use std::f64::consts::PI;

use glam::{DAffine3, DMat3, DMat4, Mat4, Vec3};
use gltf::json::camera::Type;
use gltf::json::validation::Checked::Valid;
use gltf::json::{self, Root};

use super::exact::{Exact, Orthographic, Perspective};
use super::nodes::{Placed, node_label};
use super::{Fault, assembly, exact};
use crate::scene::error::label;
use crate::scene::notices::Notices;
use crate::scene::{Camera, Projection};

/// The widest view in radians: less than pi by several steps of 32-bit floats, so that its half has a tangent.
const YFOV_MAX: f32 = PI as f32 - 1e-6;
/// The greatest distances of near and far planes in metres: nothing stands there, and their product fits in 32 bits.
const NEAR_MAX: f32 = 1e15;
const FAR_MAX: f32 = 1e16;

/// The cameras at the scene's nodes, in the order of the file's list of cameras. Each has its name in that list or,
/// without one, its node's. All are checked, whether placed or not.
pub fn read(root: &Root, exact: &Exact, placed: &[Placed], notices: &mut Notices) -> Result<Vec<Camera>, Fault> {
    let projections = projections(root, exact)?;
    let mut cameras = Vec::new();
    for &Placed { node: index, world_from_node, .. } in placed {
        let node = &root.nodes[index];
        let Some(camera) = node.camera.map(|camera| camera.value()) else { continue };
        assembly::check_reach(world_from_node, [Vec3::ZERO])
            .map_err(|what| Fault::at(node_label(root, index), what))?;
        let name = root.cameras[camera].name.as_ref().or(node.name.as_ref());
        match world_from_camera(world_from_node) {
            None => {
                notices.add("cameras without a direction, scaled to nothing, are left out", || node_label(root, index))
            }
            Some(world_from_camera) => {
                let name = super::cut(name.map_or("", String::as_str));
                cameras.push((camera, Camera { name, world_from_camera, projection: projections[camera] }));
            }
        }
    }
    cameras.sort_by_key(|(index, _)| *index);
    Ok(cameras.into_iter().map(|(_, camera)| camera).collect())
}

fn projections(root: &Root, exact: &Exact) -> Result<Vec<Projection>, Fault> {
    let read = |(index, (camera, exact)): (usize, (&json::Camera, &exact::Camera))| {
        let projection = match (camera.type_, &exact.perspective, &exact.orthographic) {
            (Valid(Type::Perspective), Some(perspective), _) => read_perspective(perspective),
            (Valid(Type::Orthographic), _, Some(orthographic)) => read_orthographic(orthographic),
            (Valid(kind), ..) => Err(format!("is of type {kind:?} and has no such projection; export the file again")),
            _ => Err("its type is neither perspective nor orthographic; give one of them".to_owned()),
        };
        projection.map_err(|what| Fault::at(label("camera", index, camera.name.as_deref()), what))
    };
    root.cameras.iter().zip(&exact.cameras).enumerate().map(read).collect()
}

fn read_perspective(perspective: &Perspective) -> Result<Projection, String> {
    let &Perspective { yfov, znear, zfar, aspect_ratio } = perspective;
    if !(yfov > 0.0 && yfov < PI) {
        return Err(format!("yfov is {yfov}; give an angle between 0 and pi"));
    }
    positive("znear", znear)?;
    positive("aspectRatio", aspect_ratio.unwrap_or(1.0))?;
    let (near, far) = planes(znear, zfar, f32::MIN_POSITIVE)?;
    let yfov = (yfov as f32).clamp(f32::MIN_POSITIVE, YFOV_MAX);
    Ok(Projection::Perspective { yfov, near, far })
}

fn read_orthographic(orthographic: &Orthographic) -> Result<Projection, String> {
    let &Orthographic { xmag, ymag, znear, zfar } = orthographic;
    positive("xmag", xmag)?;
    positive("ymag", ymag)?;
    if znear < 0.0 {
        return Err(format!("znear is {znear}; give a number from 0 up"));
    }
    let (near, far) = planes(znear, Some(zfar), 0.0)?;
    Ok(Projection::Orthographic { ymag: (ymag as f32).clamp(f32::MIN_POSITIVE, f32::MAX), near, far })
}

fn positive(name: &str, value: f64) -> Result<(), String> {
    (value > 0.0).then_some(()).ok_or_else(|| format!("{name} is {value}; give a number above 0"))
}

/// The planes between which something is shown. The file's numbers may be so near each other that in 32 bits they are
/// the same, but the farther one must stay beyond the other.
fn planes(znear: f64, zfar: Option<f64>, least: f32) -> Result<(f32, f32), String> {
    let near = (znear as f32).clamp(least, NEAR_MAX);
    match zfar {
        None => Ok((near, f32::INFINITY)),
        Some(zfar) if zfar > znear => Ok((near, (zfar as f32).clamp(near.next_up(), FAR_MAX))),
        Some(zfar) => Err(format!("zfar is {zfar} and znear is {znear}; give a zfar beyond znear")),
    }
}

/// A node's transform without scale, shear and mirroring: its -z is kept, and its y made perpendicular to that. `None`
/// where a scale of zero leaves no direction.
fn world_from_camera(world_from_node: DAffine3) -> Option<Mat4> {
    let axes = world_from_node.matrix3;
    let back = axes.z_axis.try_normalize()?;
    let up = axes.y_axis.try_normalize()?;
    let up = (up - back * up.dot(back)).try_normalize()?;
    let rotation = DMat3::from_cols(up.cross(back), up, back);
    Some(DMat4::from(DAffine3::from_mat3_translation(rotation, world_from_node.translation)).as_mat4())
}
