//! Lights for files without any: a key, a fill and a rim light, as in a photographer's studio.

use glam::{Mat3, Mat4, Vec3};

use super::notices::Notices;
use super::{Camera, Instance, Material, Mesh, Projection, Scene, framing};

/// Radiance of a white diffuse surface that faces the key light.
const KEY_LEVEL: f32 = 0.9;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Bounds, lights};

    /// A unit cube's corners, seen by a camera.
    fn scene(projection: Projection, eye: Vec3) -> Scene {
        let bounds = Bounds { min: Vec3::splat(-0.5), max: Vec3::splat(0.5) };
        let indices = (2..8).flat_map(|last| [last - 2, last - 1, last]).collect();
        let mesh = Mesh { positions: bounds.corners().to_vec(), normals: vec![Vec3::Z; 8], indices, ..Mesh::default() };
        Scene {
            meshes: vec![mesh],
            instances: vec![Instance { name: String::new(), mesh: 0, world_from_mesh: Mat4::IDENTITY }],
            materials: vec![Material::default()],
            cameras: vec![Camera { name: String::new(), world_from_camera: Mat4::from_translation(eye), projection }],
            ..Scene::default()
        }
    }

    fn lit(projection: Projection, eye: Vec3) -> Scene {
        let mut scene = scene(projection, eye);
        add_rig(&mut scene, &mut Notices::default());
        lights::add_lights(&mut scene, &mut Notices::default());
        scene
    }

    const PORTRAIT: Projection = Projection::Perspective { yfov: 0.6, near: 0.1, far: f32::INFINITY };

    #[test]
    fn panels_face_the_subject_from_out_of_the_frame() {
        let scene = lit(PORTRAIT, Vec3::new(0.0, 0.0, 3.2));
        assert_eq!(scene.lights.len(), 3);
        for light in &scene.lights {
            let [polygon] = &light.polygons[..] else { panic!("{light:?}") };
            let middle = polygon.contours[0].iter().sum::<Vec3>() / 4.0;
            assert!(polygon.normal.dot(-middle.normalize()) > 0.999 && polygon.contours[0].len() == 4);
            assert!(!sees(&scene.cameras[0], scene.instances[light.instance].world_from_mesh), "{}", light.name);
        }
    }

    #[test]
    fn a_rim_in_the_frame_is_left_out() {
        let wide = Projection::Perspective { yfov: 2.0, near: 0.1, far: f32::INFINITY };
        assert_eq!(lit(wide, Vec3::new(0.0, 0.0, 3.2)).lights.len(), 2);
        let flat = |ymag| Projection::Orthographic { ymag, near: 0.0, far: 100.0 };
        assert_eq!(lit(flat(1.0), Vec3::new(0.0, 0.0, 5.0)).lights.len(), 3);
        assert_eq!(lit(flat(10.0), Vec3::new(0.0, 0.0, 5.0)).lights.len(), 2);
    }

    #[test]
    fn a_white_surface_that_faces_the_key_is_not_too_bright() {
        let scene = lit(PORTRAIT, Vec3::new(0.0, 0.0, 3.2));
        let center = |light: &crate::scene::Light| light.polygons[0].contours[0].iter().sum::<Vec3>() / 4.0;
        let normal = center(&scene.lights[0]).normalize();
        // By brute force: squares small enough to be points.
        let radiance = |light: &crate::scene::Light| {
            let polygon = &light.polygons[0];
            let [a, b, _, d] = polygon.contours[0][..] else { panic!("{polygon:?}") };
            let cell = (b - a).cross(d - a).length() / 1e4;
            let points =
                (0..10_000).map(|i| a + (b - a) * ((i % 100) as f32 / 100.0) + (d - a) * ((i / 100) as f32 / 100.0));
            let form_factor = points.map(|point| {
                let away = point.normalize();
                let cosines = away.dot(normal).max(0.0) * (-away).dot(polygon.normal).max(0.0);
                cosines * cell / (std::f32::consts::PI * point.length_squared())
            });
            light.radiance.x * form_factor.sum::<f32>()
        };
        let radiance: f32 = scene.lights.iter().map(radiance).sum();
        assert!((0.75..0.85).contains(&radiance), "{radiance}");
    }

    #[test]
    fn what_glows_is_light_enough() {
        let mut scene = scene(PORTRAIT, Vec3::Z);
        scene.materials[0].emission = Vec3::X;
        add_rig(&mut scene, &mut Notices::default());
        assert_eq!(scene.instances.len(), 1);
    }
}
