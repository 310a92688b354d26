//! A picture that is shown over more or fewer pixels than it has.

use glam::{Mat4, Vec3};

use super::super::device::{self, Gpu};
use super::super::readback::Canvas;
use super::super::{Format, RadianceFormat, Rect, Renderer, Sample, Showing, View};
use crate::scene::{Camera, Drawn, Edits, Instance, Material, Mesh, Projection, Scene};
use crate::table::SheenTable;

/// What is drawn, the output, and the picture's place in it.
const DRAWN: [u32; 2] = [12, 8];
const SIZE: [u32; 2] = [60, 40];
const PLACE: Rect = Rect { x: 5, y: 3, width: 50, height: 29 };

const OUTPUT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Triangles of several greys, over and beside each other.
fn scene() -> Scene {
    let mesh = |material: usize| {
        let turn = Mat4::from_rotation_z(material as f32);
        let corners = [[-3.0, -2.0, 0.0], [2.5, -1.0, 0.0], [0.3, 2.8, 0.0]].map(Vec3::from);
        Mesh {
            positions: corners.map(|corner| turn.transform_point3(corner) - (material + 1) as f32 * Vec3::Z).to_vec(),
            normals: vec![Vec3::Z; 3],
            indices: vec![0, 1, 2],
            material,
            ..Mesh::default()
        }
    };
    let instance = |mesh| Instance { name: String::new(), mesh, world_from_mesh: Mat4::IDENTITY };
    let grey = |material| Material::matte("grey", Vec3::splat(0.9 - 0.25 * material as f32));
    Scene {
        meshes: (0..4).map(mesh).collect(),
        instances: (0..4).map(instance).collect(),
        materials: (0..4).map(grey).collect(),
        ..Scene::default()
    }
}

/// The red of the output's pixels with the picture in this place, row by row.
fn shown(gpu: &Gpu, renderer: &mut Renderer, size: [u32; 2], place: Rect, showing: Showing) -> Vec<Vec<f64>> {
    let canvas = Canvas::new(gpu, size, OUTPUT);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    renderer.show(gpu, &mut encoder, (&canvas.view, place), showing);
    let bytes = gpu.block_on(canvas.read(gpu, encoder)).unwrap();
    let rows = bytes.chunks_exact(bytes.len() / size[1] as usize);
    rows.map(|row| row[..4 * size[0] as usize].chunks_exact(4).map(|pixel| pixel[0].into()).collect()).collect()
}

/// What lies between the pixels' middles at a place in pixels; beyond the outermost ones these go on.
fn between(pixels: &[Vec<f64>], x: f64, y: f64) -> f64 {
    let parts = |at: f64, count: usize| {
        let at = (at - 0.5).clamp(0.0, (count - 1) as f64);
        (at as usize, (at as usize + 1).min(count - 1), at.fract())
    };
    let ((left, right, across), (upper, lower, down)) = (parts(x, pixels[0].len()), parts(y, pixels.len()));
    let row = |y: usize| pixels[y][left] + across * (pixels[y][right] - pixels[y][left]);
    row(upper) + down * (row(lower) - row(upper))
}

#[test]
fn a_coarse_picture_is_interpolated_in_its_place() {
    let gpu = pollster::block_on(device::open_offscreen(None)).expect("this test needs a device");
    let scene = scene();
    let edits = Edits { ambient: Some(Vec3::splat(0.8)), shadows: Some(false), ..Edits::default() };
    let drawn = Drawn::new(&scene, &edits);
    let projection = Projection::Orthographic { ymag: 2.0, near: 0.0, far: 10.0 };
    let camera = Camera { name: String::new(), world_from_camera: Mat4::IDENTITY, projection };
    let view = View::new(&camera, SIZE, Rect::full(SIZE));
    let showing = Showing::Shown { exposure: 0.0, tone: drawn.settings.tone };
    for samples in [1, 4] {
        let radiance = RadianceFormat::display(&gpu.adapter, samples);
        // Not every adapter has four samples a pixel.
        let Some(radiance) = radiance.or_else(|| (samples == 1).then(|| panic!("no format"))) else { continue };
        let format = Format { radiance, output: OUTPUT, measured: false };
        let mut renderer = Renderer::new(&gpu, format, &SheenTable::embedded(), &drawn).unwrap();
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        renderer.draw(&gpu, &mut encoder, DRAWN, (&view, &drawn.settings, showing), &Sample::FIRST);
        gpu.queue.submit([encoder.finish()]);
        let coarse = shown(&gpu, &mut renderer, DRAWN, Rect::full(DRAWN), showing);
        let greys: std::collections::BTreeSet<u8> = coarse.iter().flatten().map(|&grey| grey as u8).collect();
        assert!(greys.len() >= 4, "{samples}: the picture says little: {greys:?}");
        for (y, row) in shown(&gpu, &mut renderer, SIZE, PLACE, showing).iter().enumerate() {
            for (x, &found) in row.iter().enumerate() {
                let at = |pixel: usize, first: u32, count: u32| {
                    let within = (pixel as f64 + 0.5 - f64::from(first)) / f64::from(count);
                    (0.0..1.0).contains(&within).then_some(within)
                };
                let place = at(x, PLACE.x, PLACE.width).zip(at(y, PLACE.y, PLACE.height));
                let [width, height] = DRAWN.map(f64::from);
                let expected = place.map_or(0.0, |(across, down)| between(&coarse, across * width, down * height));
                // Samplers know places to a 256th of a pixel.
                assert!((found - expected).abs() <= 2.0, "{samples}, {x}, {y}: {found}, not {expected}");
            }
        }
    }
}
