//! Lights for files that have none to see by: a key, a fill and a rim light, as in a photographer's studio.

use glam::{Mat3, Mat4, Vec2, Vec3};

use super::notices::Notices;
use super::{
    Added, AddedLight, Camera, Instance, LightEdits, LightShape, Projection, Scene, emitter, lighting, lights,
};

/// Radiance of a white diffuse surface that faces the key, fill or rim light.
const KEY_LEVEL: f32 = 0.7;
const FILL_LEVEL: f32 = 0.2;
const RIM_LEVEL: f32 = 0.9;
/// Distance of the lights from the subject's middle, in its radii: out of the frame of a camera that frames the
/// subject.
const DISTANCE: f32 = 3.5;

/// Width over height of the widest pictures in which no light of the rig is seen; wider ones may show one.
const ASPECT: f32 = 2.0;
/// How many sizes of the rig are tried to find one that the camera does not see.
const SIZES: usize = 6;

/// One rectangle of the rig. It faces the subject.
struct Panel {
    name: &'static str,
    /// The direction in which it stands from the subject, in the camera's frame: right, up, towards the camera.
    direction: Vec3,
    /// Half its width and height, in the subject's radii.
    half_size: [f32; 2],
    /// The radiance that it alone gives a white diffuse surface which faces it from the subject's middle.
    level: f32,
}

const PANELS: [Panel; 3] = [
    Panel { name: "key", direction: Vec3::new(-0.75, 0.55, 0.6), half_size: [1.0, 1.0], level: KEY_LEVEL },
    Panel { name: "fill", direction: Vec3::new(0.95, 0.1, 0.5), half_size: [0.8, 1.4], level: FILL_LEVEL },
    Panel { name: "rim", direction: Vec3::new(0.35, 0.95, -0.35), half_size: [1.2, 0.4], level: RIM_LEVEL },
];

impl Panel {
    /// Of its front, by the form factor of a small rectangle that faces a surface: its area over pi times the distance squared.
    fn radiance(&self) -> f32 {
        let form_factor = 4.0 * self.half_size[0] * self.half_size[1] / (std::f32::consts::PI * DISTANCE * DISTANCE);
        self.level / form_factor
    }

    /// Places it for a subject of `radius` about `center`: takes a square of two metres a side in the plane z = 0,
    /// which glows towards +z, to the world.
    fn world_from_mesh(&self, camera: &Camera, center: Vec3, radius: f32) -> Mat4 {
        let world_from_camera = Mat3::from_mat4(camera.world_from_camera);
        let front = world_from_camera * -self.direction.normalize();
        // Its own x stays level in the camera's view.
        let right = (world_from_camera * Vec3::Y).cross(front).normalize();
        let axes = Mat3::from_cols(right * self.half_size[0], front.cross(right) * self.half_size[1], front);
        Mat4::from_translation(center - DISTANCE * radius * front) * Mat4::from_mat3(axes * radius)
    }
}

/// Adds the rig where nothing lights the scene, or too faintly to see the subject by.
pub(super) fn add_where_dark(scene: &mut Scene, notices: &mut Notices) {
    let added = || "key, fill and rim lights are added".to_owned();
    if scene.lights.is_empty() && scene.punctual_lights.is_empty() {
        notices.add("nothing in the file lights the scene", added);
    } else if !lighting::shows_subject(scene) {
        notices.add("what glows in the file is too faint to see the subject by", added);
    } else {
        return;
    }
    add(scene, notices);
}

/// Adds the rig around the subject, as the first camera sees it.
pub(super) fn add(scene: &mut Scene, notices: &mut Notices) {
    let Some(placed) = placed(scene) else { return };
    let (first, first_light) = (scene.instances.len(), scene.lights.len());
    for (panel, world_from_mesh) in PANELS.iter().zip(placed) {
        add_panel(scene, panel, world_from_mesh);
    }
    lights::add_lights(scene, first, notices);
    scene.rig = first_light..scene.lights.len();
}

impl Scene {
    /// The lights of a rig around the subject, as the first camera sees it, for a scene that has been loaded without one; none without
    /// a camera.
    pub fn studio_rig(&self) -> Vec<AddedLight> {
        let of_panel = |(panel, world_from_mesh): (&Panel, Mat4)| {
            let (scale, rotation, position) = world_from_mesh.to_scale_rotation_translation();
            let changes = LightEdits {
                radiance: Some(Vec3::splat(panel.radiance())),
                position: Some(position),
                rotation: Some(rotation),
                // A panel measures two metres before it is placed.
                size: Some(2.0 * scale.truncate()),
                ..LightEdits::default()
            };
            Added { name: format!("{} light", panel.name), shape: LightShape::Rectangle, changes }
        };
        placed(self).map(|placed| PANELS.iter().zip(placed).map(of_panel).collect()).unwrap_or_default()
    }
}

/// Where the panels stand.
fn placed(scene: &Scene) -> Option<[Mat4; PANELS.len()]> {
    let camera = scene.cameras.first()?;
    let subject = scene.subject();
    let (center, radius) = (subject.center(), subject.radius());
    // Farther away and larger by the same factor it lights the subject alike, and at last it leaves the frame.
    let sizes = std::iter::successors(Some(radius), |size| Some(2.0 * size)).take(SIZES);
    let placed = sizes.map(|size| PANELS.each_ref().map(|panel| panel.world_from_mesh(camera, center, size)));
    let unseen = |placed: &[Mat4; PANELS.len()]| !placed.iter().any(|&panel| shows(camera, panel));
    let placed: Vec<_> = placed.collect();
    Some(*placed.iter().find(|placed| unseen(placed)).unwrap_or(&placed[0]))
}

/// Whether any part of a panel's face may be in the frame.
fn shows(camera: &Camera, world_from_mesh: Mat4) -> bool {
    let camera_from_mesh = camera.world_from_camera.inverse() * world_from_mesh;
    let (front, middle) = (camera_from_mesh.z_axis.truncate(), camera_from_mesh.w_axis.truncate());
    // Half the frame's height at a point, and the direction from the panel to the camera.
    let (half_height, to_camera): (&dyn Fn(Vec3) -> f32, Vec3) = match camera.projection {
        Projection::Perspective { yfov, .. } => (&move |point: Vec3| -point.z * (0.5 * yfov).tan(), -middle),
        Projection::Orthographic { ymag, .. } => (&move |_| ymag, Vec3::Z),
    };
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let corners = corners.map(|(x, y)| camera_from_mesh.transform_point3(Vec3::new(x, y, 0.0)));
    let sides = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y];
    let is_past = |side: Vec3| {
        let stretch = side.abs().dot(Vec3::new(ASPECT, 1.0, 1.0));
        corners.iter().all(|&corner| side.dot(corner) > stretch * half_height(corner))
    };
    let is_behind = corners.iter().all(|corner| corner.z >= 0.0);
    front.dot(to_camera) > 0.0 && !is_behind && !sides.into_iter().any(is_past)
}

fn add_panel(scene: &mut Scene, panel: &Panel, world_from_mesh: Mat4) {
    let name = format!("default {} light", panel.name);
    let emission = Vec3::splat(panel.radiance());
    let mesh = emitter::add_mesh(scene, &name, &emitter::rectangle(Vec2::ONE), emission);
    scene.instances.push(Instance { name, mesh, world_from_mesh });
}
