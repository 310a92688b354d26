//! Shadows that are looked up in an earlier picture, against those that are traced in the present view.

use glam::{Mat4, Vec3};

use super::super::device;
use super::super::readback::Canvas;
use super::super::{Format, Gpu, RadianceFormat, Rect, Renderer, Sample, Showing, View};
use crate::scene::{Camera, Drawn, Edits, Instance, Light, Material, Mesh, Polygon, Projection, Scene};
use crate::table::SheenTable;

const SIZE: [u32; 2] = [96, 64];
/// Enough for shadows without noise.
const SAMPLES: u32 = 64;

/// A floor of 8 m, a plate of 1 m that hovers over its middle, and a lamp above that.
fn scene() -> Scene {
    let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]].map(|[x, y]| Vec3::new(x, y, 0.0));
    let square = |material| Mesh {
        positions: corners.to_vec(),
        normals: vec![Vec3::Z; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        material,
        ..Mesh::default()
    };
    let plate = Mat4::from_translation(0.5 * Vec3::Z);
    let instance = |mesh, world_from_mesh| Instance { name: String::new(), mesh, world_from_mesh };
    let lamp = corners.map(|corner| Vec3::new(corner.x, -corner.y, 3.0));
    let polygon = Polygon { contours: vec![lamp.to_vec()], normal: Vec3::NEG_Z, pattern: None };
    let emission = Material { emission: Vec3::splat(40.0), ..Material::matte("lamp", Vec3::ZERO) };
    let turned = Mat4::from_translation(3.0 * Vec3::Z) * Mat4::from_rotation_x(std::f32::consts::PI);
    Scene {
        meshes: vec![square(0), square(1), square(2)],
        instances: vec![instance(0, Mat4::from_scale(Vec3::splat(8.0))), instance(1, plate), instance(2, turned)],
        materials: vec![
            Material::matte("floor", Vec3::splat(0.6)),
            Material::matte("plate", Vec3::splat(0.3)),
            emission,
        ],
        lights: vec![Light { radiance: Vec3::splat(40.0), polygons: vec![polygon], instance: 2, ..Light::default() }],
        ..Scene::default()
    }
}

/// From 4 m away, turned about the scene's middle by so many radians.
fn camera(turned: f32, perspective: bool) -> Camera {
    let projection = match perspective {
        true => Projection::Perspective { yfov: 0.8, near: 0.1, far: f32::INFINITY },
        false => Projection::Orthographic { ymag: 1.7, near: 0.1, far: 20.0 },
    };
    let world_from_camera =
        Mat4::from_rotation_z(turned) * Mat4::from_rotation_x(0.8) * Mat4::from_translation(4.0 * Vec3::Z);
    Camera { name: String::new(), world_from_camera, projection }
}

struct Stage<'a> {
    gpu: &'a Gpu,
    renderer: Renderer,
    showing: Showing,
}

impl Stage<'_> {
    fn view(camera: &Camera) -> View {
        View::new(camera, SIZE, Rect::full(SIZE))
    }

    /// `spread`: all over the pixels, or at their centres, where what is looked up is drawn.
    fn trace(&mut self, drawn: &Drawn, camera: &Camera, size: [u32; 2], spread: bool) {
        for index in 0..SAMPLES {
            let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
            let frame = (&Self::view(camera), &drawn.settings, self.showing);
            let sample = Sample { index, seed: 0, spread };
            self.renderer.draw(self.gpu, &mut encoder, size, frame, &sample);
            self.gpu.queue.submit([encoder.finish()]);
        }
    }

    fn remember(&mut self, drawn: &Drawn, camera: &Camera) {
        assert!(self.renderer.remembers(&drawn.settings));
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let frame = (&Self::view(camera), &drawn.settings, self.showing);
        self.renderer.draw_remembering(self.gpu, &mut encoder, SIZE, frame);
        self.gpu.queue.submit([encoder.finish()]);
    }

    /// The green of what was drawn last, pixel by pixel.
    fn shown(&mut self) -> Vec<f64> {
        let canvas = Canvas::new(self.gpu, SIZE, wgpu::TextureFormat::Rgba8Unorm);
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        self.renderer.show(self.gpu, &mut encoder, (&canvas.view, Rect::full(SIZE)), self.showing);
        let bytes = self.gpu.block_on(canvas.read(self.gpu, encoder)).unwrap();
        let stride = bytes.len() / SIZE[1] as usize;
        bytes
            .chunks_exact(stride)
            .flat_map(|row| row[..4 * SIZE[0] as usize].chunks_exact(4))
            .map(|p| p[1].into())
            .collect()
    }
}

fn mean_difference(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| (one - other).abs()).sum::<f64>() / one.len() as f64
}

/// By how much what is looked up in a picture of this size differs from what is traced, and by how much what has no shadows does, in 256ths.
fn differences(gpu: &Gpu, size: [u32; 2], cameras: [&Camera; 2]) -> [f64; 2] {
    let (scene, edits) = (scene(), Edits::default());
    let drawn = Drawn::new(&scene, &edits);
    let radiance = RadianceFormat::display(&gpu.adapter, 1).unwrap();
    let format = Format { radiance, output: wgpu::TextureFormat::Rgba8Unorm, measured: false };
    let renderer = Renderer::new(gpu, format, &SheenTable::embedded(), &drawn).unwrap();
    let showing = Showing::Shown { exposure: 0.0, tone: drawn.settings.tone };
    let mut stage = Stage { gpu, renderer, showing };
    let dark = Edits { shadows: Some(false), ..Edits::default() };
    stage.trace(&Drawn::new(&scene, &dark), cameras[1], SIZE, false);
    let plain = stage.shown();
    let blockers = stage.renderer.blockers(gpu, &drawn).unwrap();
    stage.renderer.receive(gpu, blockers.build());
    stage.trace(&drawn, cameras[1], SIZE, false);
    let truth = stage.shown();
    stage.trace(&drawn, cameras[0], size, true);
    stage.remember(&drawn, cameras[1]);
    [mean_difference(&stage.shown(), &truth), mean_difference(&plain, &truth)]
}

/// What is left is at silhouettes, which are smooth where samples lie all over the pixels.
#[test]
fn shadows_are_found_where_they_are_in_another_view() {
    let gpu = pollster::block_on(device::open_offscreen(None)).expect("this test needs a device");
    let half = SIZE.map(|side| side / 2);
    for (perspective, turned, size, most) in
        [(true, 0.2, SIZE, 0.15), (true, -0.4, SIZE, 0.2), (true, 0.2, half, 0.22), (false, 0.2, SIZE, 0.2)]
    {
        let cameras = [camera(0.0, perspective), camera(turned, perspective)];
        let [found, plain] = differences(&gpu, size, cameras.each_ref());
        let share = found / plain;
        assert!(plain > 5.0 && share < most, "turned by {turned}, {size:?}: {share} of {plain} is wrong");
    }
}
