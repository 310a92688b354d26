//! Textures on triangles that are seen edge-on.

use glam::{Mat4, Vec2, Vec3, Vec4};
use velour::renderer::Offscreen;
use velour::scene::{Camera, Drawn, Edits, Projection, TextureSlot};
use velour::table::SheenTable;

use super::compare::GPU;
use super::stage::plain;
use super::textures::{floor, textured};

/// Beside a triangle that is seen edge-on, texture coordinates change from pixel to pixel by millions of textures.
#[test]
fn textures_seen_edge_on_take_no_longer_than_others() {
    let mut scene = floor(plain());
    textured(&mut scene, TextureSlot::BaseColor, [256, 256], vec![[200, 100, 50, 255]; 256 * 256]);
    let mesh = &mut scene.meshes[0];
    (mesh.positions, mesh.tex_coords[0]) = (Vec::new(), Vec::new());
    for index in 0..20_000 {
        let [x, y, turn, off] =
            [0.819_173, 0.671_044, 0.549_700, 0.450_301].map(|step| (f64::from(index) * step).fract() as f32 - 0.5);
        let (way, across) = (Vec3::new(1.6 * x, 1.2 * y, -1.0), Vec2::from_angle(std::f32::consts::TAU * turn));
        let side = across.perp().extend(0.0);
        mesh.positions.extend([3.0 * way, 5.0 * way + 0.02 * off * across.extend(0.0), 4.0 * way + 0.02 * side]);
        mesh.tex_coords[0].extend([Vec2::ZERO, Vec2::X, Vec2::Y]);
    }
    let count = mesh.positions.len();
    mesh.tex_coords[1] = mesh.tex_coords[0].clone();
    (mesh.normals, mesh.tangents) = (vec![Vec3::Z; count], vec![Vec4::X + Vec4::W; count]);
    mesh.indices = (0..count as u32).collect();
    scene.materials[0].double_sided = true;
    scene.instances[0].world_from_mesh = Mat4::IDENTITY;
    let projection = Projection::Perspective { yfov: 1.0, near: 0.01, far: f32::INFINITY };
    scene.cameras = vec![Camera { name: String::new(), world_from_camera: Mat4::IDENTITY, projection }];
    // The driver cannot be stopped: past its time the test ends without it.
    let (done, wait) = std::sync::mpsc::channel();
    std::thread::spawn(move || {
        let drawn = Drawn::new(&scene, &Edits::default());
        let mut renderer = Offscreen::for_linear(&GPU, 4, &SheenTable::embedded(), &drawn).unwrap();
        let picture = GPU.block_on(renderer.linear(&GPU, &scene.cameras[0], [320, 240], &drawn.settings)).unwrap();
        done.send(picture).unwrap();
    });
    let picture = wait.recv_timeout(std::time::Duration::from_secs(120)).expect("the driver did not come back");
    assert!(picture.pixels.iter().flatten().all(|channel| channel.is_finite()));
}
