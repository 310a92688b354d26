//! Lights for files without any: a key, a fill and a rim light, as in a photographer's studio.

use glam::{Mat3, Mat4, Vec3};

use super::notices::Notices;
use super::{Camera, Instance, Material, Mesh, Projection, Scene, framing};

/// Radiance of a white diffuse surface that faces the key light.
const KEY_LEVEL: f32 = 0.7;
const FILL_LEVEL: f32 = 0.15;
const RIM_LEVEL: f32 = 0.9;
/// From the subject's middle, in its radii: out of the frame of a camera that frames the subject.
const DISTANCE: f32 = 3.5;

/// One rectangle of the rig. It faces the subject.
struct Panel {
    name: &'static str,
    /// Where it stands seen from the subject, in the camera's frame: right, up, towards the camera.
    direction: Vec3,
    /// Half its width and height, in the subject's radii.
    half_size: [f32; 2],
    /// Radiance that it alone gives a white diffuse surface in the subject's middle that faces it.
    level: f32,
}

const PANELS: [Panel; 3] = [
    Panel { name: "key", direction: Vec3::new(-0.75, 0.55, 0.6), half_size: [1.0, 1.0], level: KEY_LEVEL },
    Panel { name: "fill", direction: Vec3::new(0.95, 0.1, 0.5), half_size: [0.8, 1.4], level: FILL_LEVEL },
    Panel { name: "rim", direction: Vec3::new(0.35, 0.85, -0.45), half_size: [1.2, 0.4], level: RIM_LEVEL },
];

const CORNERS: [Vec3; 4] =
    [Vec3::new(-1.0, -1.0, 0.0), Vec3::new(1.0, -1.0, 0.0), Vec3::new(1.0, 1.0, 0.0), Vec3::new(-1.0, 1.0, 0.0)];

/// Adds the rig around what the first camera shows, where nothing in the scene glows. A rim light that this camera would
/// see is left out.
pub(super) fn add_rig(scene: &mut Scene, notices: &mut Notices) {
    let glows = |instance: &Instance| scene.materials[scene.meshes[instance.mesh].material].emission != Vec3::ZERO;
    let (false, Some(camera)) = (scene.instances.iter().any(glows), scene.cameras.first().cloned()) else { return };
    let world_from_camera = Mat3::from_mat4(camera.world_from_camera);
    let subject = scene.subject();
    let (center, radius) = (subject.center(), framing::radius(&subject));
    for panel in &PANELS {
        let back = world_from_camera * -panel.direction.normalize();
        // Its own x stays level in the camera's view; its z, the side that glows, faces the subject.
        let right = (world_from_camera * Vec3::Y).cross(back).normalize();
        let axes = Mat3::from_cols(right * panel.half_size[0], back.cross(right) * panel.half_size[1], back);
        let world_from_mesh =
            Mat4::from_translation(center - DISTANCE * radius * back) * Mat4::from_mat3(axes * radius);
        if panel.direction.z > 0.0 || !sees(&camera, world_from_mesh) {
            add_panel(scene, panel, world_from_mesh);
        }
    }
    notices.add("no light in the file", || "key, fill and rim lights are added".to_owned());
}

/// Whether a picture up to twice as wide as high may show a corner of a panel.
fn sees(camera: &Camera, world_from_mesh: Mat4) -> bool {
    let camera_from_mesh = camera.world_from_camera.inverse() * world_from_mesh;
    CORNERS.iter().any(|&corner| {
        let corner = camera_from_mesh.transform_point3(corner);
        let half_height = match camera.projection {
            Projection::Perspective { yfov, .. } => -corner.z * (0.5 * yfov).tan(),
            Projection::Orthographic { ymag, .. } => ymag,
        };
        corner.z < 0.0 && corner.y.abs() < half_height && corner.x.abs() < 2.0 * half_height
    })
}

fn add_panel(scene: &mut Scene, panel: &Panel, world_from_mesh: Mat4) {
    let name = || format!("default {} light", panel.name);
    // The form factor of a small rectangle that faces a surface: its area over pi times the distance squared.
    let form_factor = 4.0 * panel.half_size[0] * panel.half_size[1] / (std::f32::consts::PI * DISTANCE * DISTANCE);
    let emission = Vec3::splat(panel.level / form_factor);
    scene.materials.push(Material { name: name(), base_color: Vec3::ZERO, sheen: None, emission, double_sided: false });
    scene.meshes.push(Mesh {
        name: name(),
        positions: CORNERS.to_vec(),
        normals: vec![Vec3::Z; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        material: scene.materials.len() - 1,
    });
    scene.instances.push(Instance { name: name(), mesh: scene.meshes.len() - 1, world_from_mesh });
}
