//! Textures on triangles that are seen edge-on, and in many copies across a pixel.

use glam::{Affine2, Mat4, Vec2, Vec3, Vec4};
use velour::renderer::Offscreen;
use velour::scene::{AlphaMode, Camera, Edits, Material, Projection, TextureSlot};
use velour::table::SheenTable;

use super::compare::{GPU, SIZE, linear};
use super::run::unshadowed;
use super::stage::{looking, plain};
use super::textures::{floor, textured};

/// Beside a triangle that is seen edge-on, texture coordinates change from pixel to pixel by millions of textures.
#[test]
fn textures_seen_edge_on_take_no_longer_than_others() {
    seen_edge_on(AlphaMode::Opaque);
}

#[test]
fn cut_out_textures_seen_edge_on_take_no_longer_than_others() {
    seen_edge_on(AlphaMode::Mask { cutoff: 0.5 });
}

fn seen_edge_on(alpha_mode: AlphaMode) {
    let mut scene = floor(Material { alpha_mode, ..plain() });
    textured(
        &mut scene,
        TextureSlot::BaseColor,
        [256, 256],
        [[200, 100, 50, 255], [200, 100, 50, 0]].repeat(128 * 256),
    );
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
        let drawn = unshadowed(&scene, &Edits::default());
        let mut renderer = Offscreen::for_linear(&GPU, 4, &SheenTable::embedded(), &drawn).unwrap();
        let picture = GPU.block_on(renderer.linear(&GPU, &scene.cameras[0], [320, 240], &drawn.settings)).unwrap();
        done.send(picture).unwrap();
    });
    let picture = wait.recv_timeout(std::time::Duration::from_secs(120)).expect("the driver did not come back");
    assert!(picture.pixels.iter().flatten().all(|channel| channel.is_finite()));
}

/// A column of four is white: a quarter of it is left where many copies lie across a pixel, wherever in them its centre.
#[test]
fn many_copies_across_a_pixel_are_their_mean() {
    let edits = Edits { lights_visible: Some(false), ..Edits::default() };
    let seen = |copies: f32, columns: [u8; 4]| {
        let mut scene = floor(plain());
        let texels = columns.map(|code| [code, code, code, 255]).repeat(4);
        textured(&mut scene, TextureSlot::BaseColor, [4, 4], texels);
        // The floor of three metres has one copy, and the picture shows two metres of it.
        let scale = copies * 3.0 * SIZE[1] as f32 / 2.0;
        scene.materials[0].textures[TextureSlot::BaseColor as usize].as_mut().unwrap().uv_from_tex_coord =
            Affine2::from_scale(Vec2::splat(scale));
        scene.cameras[0].projection = Projection::Orthographic { ymag: 1.0, near: 0.1, far: 10.0 };
        scene.cameras[0].world_from_camera = looking([0.0, 2.0, 1e-3], [0.0; 3]);
        linear(&scene, &SheenTable::embedded(), &edits, SIZE)
    };
    for copies in [15.0, 17.0, 20.0, 32.0, 33.0, 1000.0] {
        let (striped, white) = (seen(copies, [255, 0, 0, 0]), seen(copies, [255; 4]));
        for (striped, white) in striped.pixels.iter().zip(&white.pixels) {
            assert!(white[0] > 0.0 && (striped[0] / white[0] - 0.25).abs() < 0.005, "{copies}: {striped:?} {white:?}");
        }
    }
}
