//! Outlines against where the borders of squares are by the camera's definition.

use glam::{Mat4, Vec3};

use super::super::device::{self, Gpu};
use super::super::readback::Canvas;
use super::super::{Format, RadianceFormat, Rect, Renderer, Sample, Showing, View};
use crate::scene::{AlphaMode, Camera, Drawn, Edits, Instance, Material, Mesh, Projection, Scene};
use crate::table::SheenTable;

/// The output, and the picture's place in it.
const SIZE: [u32; 2] = [96, 80];
const PLACE: Rect = Rect { x: 10, y: 6, width: 64, height: 64 };

/// A rectangle of pixels of the picture: left, right, upper and lower edge.
type Pixels = [i32; 4];

/// Squares that cover these pixels of the picture exactly, each of a material of its own, the first nearest. The picture
/// shows 64 by 64 metres.
fn squares(pixels: &[Pixels]) -> Scene {
    let mesh = |(material, &[left, right, top, bottom]): (usize, &Pixels)| {
        let corners = [[left, bottom], [right, bottom], [right, top], [left, top]];
        let place = |[x, y]: [i32; 2]| Vec3::new((x - 32) as f32, (32 - y) as f32, -1.0 - material as f32);
        Mesh {
            positions: corners.map(place).to_vec(),
            normals: vec![Vec3::Z; 4],
            indices: vec![0, 1, 2, 0, 2, 3],
            material,
            ..Mesh::default()
        }
    };
    let instance = |mesh| Instance { name: String::new(), mesh, world_from_mesh: Mat4::IDENTITY };
    Scene {
        meshes: pixels.iter().enumerate().map(mesh).collect(),
        instances: (0..pixels.len()).map(instance).collect(),
        materials: vec![Material::matte("square", Vec3::splat(0.5)); pixels.len()],
        ..Scene::default()
    }
}

/// The output with the picture, and again with the outline of a material.
fn shown(gpu: &Gpu, scene: &Scene, material: usize) -> [Vec<u8>; 2] {
    let edits = Edits { ambient: Some(Vec3::ONE), shadows: Some(false), ..Edits::default() };
    let drawn = Drawn::new(scene, &edits);
    let radiance = RadianceFormat::display(&gpu.adapter, 1).unwrap();
    let output = wgpu::TextureFormat::Rgba8Unorm;
    let format = Format { radiance, output, measured: false };
    let mut renderer = Renderer::new(gpu, format, &SheenTable::embedded(), &drawn).unwrap();
    let projection = Projection::Orthographic { ymag: 32.0, near: 0.0, far: 10.0 };
    let camera = Camera { name: String::new(), world_from_camera: Mat4::IDENTITY, projection };
    let size = [PLACE.width, PLACE.height];
    let view = View::new(&camera, size, Rect::full(size));
    let settings = drawn.settings;
    let showing = Showing::Shown { exposure: 0.0, tone: settings.tone };
    [false, true].map(|outlined| {
        let canvas = Canvas::new(gpu, SIZE, output);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        renderer.draw(gpu, &mut encoder, size, (&view, &settings, showing), &Sample::FIRST);
        renderer.show(gpu, &mut encoder, (&canvas.view, PLACE), showing);
        if outlined {
            renderer.outline(gpu, &mut encoder, (&canvas.view, PLACE), &view, material);
        }
        gpu.block_on(canvas.read(gpu, encoder)).unwrap()
    })
}

/// What an outline does to each pixel of the output: 1 makes it light, -1 dark, 0 leaves it.
fn changes([plain, outlined]: [Vec<u8>; 2]) -> impl Fn(i32, i32) -> i32 {
    let stride = plain.len() / SIZE[1] as usize;
    move |x: i32, y: i32| {
        let at = y as usize * stride + 4 * x as usize;
        let (before, after) = (&plain[at..at + 3], &outlined[at..at + 3]);
        match after {
            after if after == before => 0,
            [230, 230, 230] => 1,
            [26, 26, 26] => -1,
            _ => panic!("{before:?} has become {after:?} at {x}, {y}"),
        }
    }
}

/// Pixels of the output that are within `grown` pixels of a rectangle of the picture.
fn within([left, right, top, bottom]: Pixels, grown: i32, [x, y]: [i32; 2]) -> bool {
    let (x, y) = (x - PLACE.x as i32, y - PLACE.y as i32);
    (left - grown..right + grown).contains(&x) && (top - grown..bottom + grown).contains(&y)
}

fn gpu() -> Gpu {
    pollster::block_on(device::open_offscreen(None)).expect("this test needs a device")
}

/// Checks that the outline of the first of these squares is that of the pixels `seen`.
fn check(gpu: &Gpu, scene: &Scene, material: usize, seen: Pixels) {
    let changed = changes(shown(gpu, scene, material));
    for at @ [x, y] in (0..SIZE[1] as i32).flat_map(|y| (0..SIZE[0] as i32).map(move |x| [x, y])) {
        let is_inside = within(seen, 0, at);
        // Where the picture ends there is no border.
        let inner = within(grown_to_the_edge(seen), -1, at);
        let expected = match (is_inside, inner, within(seen, 1, at) && within([0, 64, 0, 64], 0, at)) {
            (true, false, _) => 1,
            (false, _, true) => -1,
            _ => 0,
        };
        assert_eq!(changed(x, y), expected, "at {at:?}");
    }
}

/// The same with sides at the picture's edge moved beyond it.
fn grown_to_the_edge([left, right, top, bottom]: Pixels) -> Pixels {
    let low = |side: i32| if side == 0 { -9 } else { side };
    let high = |side: i32| if side == 64 { 73 } else { side };
    [low(left), high(right), low(top), high(bottom)]
}

#[test]
fn the_line_lies_along_the_border_and_nowhere_else() {
    let gpu = gpu();
    for pixels in [[10, 41, 20, 33], [0, 30, 5, 64], [31, 32, 8, 60]] {
        check(&gpu, &squares(&[pixels]), 0, pixels);
    }
    // Nothing is outlined that is not there.
    let scene = squares(&[[10, 41, 20, 33]]);
    let changed = changes(shown(&gpu, &scene, 7));
    assert!((0..80).all(|y| (0..96).all(|x| changed(x, y) == 0)));
}

#[test]
fn what_is_opaque_hides_and_what_is_blended_does_not() {
    let gpu = gpu();
    let (near, far) = ([0, 64, 0, 30], [12, 50, 20, 44]);
    let mut scene = squares(&[near, far]);
    check(&gpu, &scene, 1, [12, 50, 30, 44]);
    scene.materials[0].alpha_mode = AlphaMode::Blend;
    scene.materials[0].opacity = 0.5;
    check(&gpu, &scene, 1, far);
    // Itself it is outlined all the same.
    check(&gpu, &scene, 0, near);
}

#[test]
fn what_is_culled_is_not_outlined() {
    let gpu = gpu();
    let seen = [10, 41, 20, 33];
    let mut scene = squares(&[seen]);
    // Mirrored about the picture's middle, it still shows its front.
    scene.instances[0].world_from_mesh = Mat4::from_scale(Vec3::new(-1.0, 1.0, 1.0));
    check(&gpu, &scene, 0, [64 - 41, 64 - 10, 20, 33]);
    scene.meshes[0].indices.reverse();
    let changed = changes(shown(&gpu, &scene, 0));
    assert!((0..80).all(|y| (0..96).all(|x| changed(x, y) == 0)));
    scene.materials[0].double_sided = true;
    check(&gpu, &scene, 0, [64 - 41, 64 - 10, 20, 33]);
}
