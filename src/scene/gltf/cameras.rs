//! Cameras: where they stand, and their projections, with all ranges checked.

use glam::{DAffine3, DMat3, DMat4, Mat4, Vec3};
use gltf::json::camera::{Orthographic, Perspective, Type};
use gltf::json::validation::Checked::Valid;
use gltf::json::{self, Root};

use super::nodes::{Placed, node_label};
use super::{Fault, assembly};
use crate::scene::error::label;
use crate::scene::notices::Notices;
use crate::scene::{Camera, Projection};

/// The cameras at the scene's nodes, in the order of the file's list of cameras. Each has its name in that list or,
/// without one, its node's. All are checked, whether placed or not.
pub fn read(root: &Root, placed: &[Placed], notices: &mut Notices) -> Result<Vec<Camera>, Fault> {
    let projections = projections(root)?;
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

fn projections(root: &Root) -> Result<Vec<Projection>, Fault> {
    let read = |(index, camera): (usize, &json::Camera)| {
        projection(camera).map_err(|what| Fault::at(label("camera", index, camera.name.as_deref()), what))
    };
    root.cameras.iter().enumerate().map(read).collect()
}

fn projection(camera: &json::Camera) -> Result<Projection, String> {
    match (camera.type_, &camera.perspective, &camera.orthographic) {
        (Valid(Type::Perspective), Some(perspective), _) => read_perspective(perspective),
        (Valid(Type::Orthographic), _, Some(orthographic)) => read_orthographic(orthographic),
        (Valid(kind), _, _) => Err(format!("is of type {kind:?} and has no such projection; export the file again")),
        _ => Err("its type is neither perspective nor orthographic; give one of them".to_owned()),
    }
}

fn read_perspective(perspective: &Perspective) -> Result<Projection, String> {
    let &Perspective { yfov, znear, zfar, aspect_ratio, .. } = perspective;
    if !(yfov > 0.0 && yfov < std::f32::consts::PI) {
        return Err(format!("yfov is {yfov}; give an angle between 0 and pi"));
    }
    positive("znear", znear)?;
    positive("aspectRatio", aspect_ratio.unwrap_or(1.0))?;
    beyond(zfar.unwrap_or(f32::MAX), znear)?;
    Ok(Projection::Perspective { yfov, near: znear, far: zfar.unwrap_or(f32::INFINITY) })
}

fn read_orthographic(orthographic: &Orthographic) -> Result<Projection, String> {
    let &Orthographic { xmag, ymag, znear, zfar, .. } = orthographic;
    positive("xmag", xmag)?;
    positive("ymag", ymag)?;
    if !(znear >= 0.0 && znear.is_finite()) {
        return Err(format!("znear is {znear}; give a finite number from 0 up"));
    }
    beyond(zfar, znear)?;
    Ok(Projection::Orthographic { ymag, near: znear, far: zfar })
}

fn positive(name: &str, value: f32) -> Result<(), String> {
    let wrong = || format!("{name} is {value}; give a finite number above 0");
    (value > 0.0 && value.is_finite()).then_some(()).ok_or_else(wrong)
}

fn beyond(zfar: f32, znear: f32) -> Result<(), String> {
    let wrong = || format!("zfar is {zfar} and znear is {znear}; give a finite zfar beyond znear");
    (zfar > znear && zfar.is_finite()).then_some(()).ok_or_else(wrong)
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
