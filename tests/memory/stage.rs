//! A dusty floor and a plate over it under two lights, and the passes that draw them as a window does.

use glam::{Mat4, Vec3};
use velour::picture::ToneCurve;
use velour::renderer::{Format, Gpu, RadianceFormat, Rect, Renderer, Sample, Showing, View};
use velour::scene::{
    Camera, Drawn, Edits, Instance, Light, Material, Mesh, Polygon, Projection, Scene, Settings, Sheen,
};
use velour::table::SheenTable;

/// Of the output.
pub const SIZE: [u32; 2] = [64, 36];

pub struct Stage<'a> {
    scene: Scene,
    pub edits: Edits,
    pub settings: Settings,
    pub camera: Camera,
    gpu: &'a Gpu,
    renderer: Renderer,
    output: wgpu::TextureView,
    /// Of the picture, which is shown in all of the output.
    pub size: [u32; 2],
    /// The next sample's index.
    next: u32,
}

impl<'a> Stage<'a> {
    pub fn new(gpu: &'a Gpu, samples: u32, tone: ToneCurve, shadows: bool) -> Self {
        let (scene, edits) = (scene(), Edits { shadows: Some(shadows), ..Edits::default() });
        let settings = Settings { tone, ..edits.settings() };
        let radiance = RadianceFormat::display(&gpu.adapter, samples).expect("the device draws floats");
        let format = Format { radiance, output: wgpu::TextureFormat::Rgba8Unorm, measured: false };
        let renderer = Renderer::new(gpu, format, &SheenTable::embedded(), &Drawn::new(&scene, &edits)).unwrap();
        let output = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width: SIZE[0], height: SIZE[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: format.output,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        });
        let output = output.create_view(&Default::default());
        let camera = scene.cameras[0].clone();
        let mut stage = Self { scene, edits, settings, camera, gpu, renderer, output, size: SIZE, next: 0 };
        stage.update();
        assert_eq!(stage.renderer.has_shadows(&stage.settings), shadows);
        stage
    }

    /// Sends what the edits have made of the lights to the device.
    pub fn update(&mut self) {
        let drawn = Drawn::new(&self.scene, &self.edits);
        self.renderer.update(self.gpu, &drawn).unwrap();
        if let Some(blockers) = self.renderer.blockers(self.gpu, &drawn) {
            self.renderer.receive(self.gpu, blockers.build());
        }
    }

    /// A frame whose picture has changed.
    pub fn draw(&mut self) {
        self.next = 0;
        self.refine();
    }

    /// A frame that adds a sample to the last picture.
    pub fn refine(&mut self) {
        self.frame(true);
        self.next += 1;
    }

    /// A frame that shows the last picture again.
    pub fn show(&mut self) {
        self.frame(false);
    }

    fn frame(&mut self, draws: bool) {
        let showing = Showing::Shown { exposure: self.settings.exposure, tone: self.settings.tone };
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        if draws {
            let view = View::new(&self.camera, self.size, Rect::full(self.size));
            let sample = Sample { index: self.next, seed: 0, spread: true };
            self.renderer.draw(self.gpu, &mut encoder, self.size, (&view, &self.settings, showing), &sample);
        }
        self.renderer.show(self.gpu, &mut encoder, (&self.output, Rect::full(SIZE)), showing);
        self.gpu.queue.submit([encoder.finish()]);
        self.gpu.device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
    }
}

fn scene() -> Scene {
    let mut floor = Material::matte("floor", Vec3::splat(0.5));
    floor.specular = 1.0;
    floor.sheen = Some(Sheen::new(Vec3::ONE, 0.5));
    let lamp = Material { emission: Vec3::ONE, ..Material::matte("lamp", Vec3::ZERO) };
    // Lamps face the floor.
    let down = |x: f32| Mat4::from_translation(Vec3::new(x, 0.0, 2.0)) * Mat4::from_rotation_x(std::f32::consts::PI);
    let plate = Mat4::from_translation(Vec3::Z) * Mat4::from_scale(Vec3::splat(0.5));
    let places = [Mat4::from_scale(Vec3::splat(4.0)), down(-1.0), down(1.0), plate];
    let world_from_camera = Mat4::from_translation(Vec3::new(0.0, -3.0, 4.0)) * Mat4::from_rotation_x(0.64);
    Scene {
        meshes: vec![square(0), square(1)],
        instances: (0..).zip(places).map(|(index, world_from_mesh)| instance(index, world_from_mesh)).collect(),
        materials: vec![floor, lamp],
        lights: vec![light(1, places[1]), light(2, places[2])],
        cameras: vec![Camera {
            name: "camera".to_owned(),
            world_from_camera,
            projection: Projection::Perspective { yfov: 0.8, near: 0.1, far: 100.0 },
        }],
        ..Scene::default()
    }
}

const CORNERS: [Vec3; 4] =
    [Vec3::new(-0.5, -0.5, 0.0), Vec3::new(0.5, -0.5, 0.0), Vec3::new(0.5, 0.5, 0.0), Vec3::new(-0.5, 0.5, 0.0)];

fn square(material: usize) -> Mesh {
    Mesh {
        name: "square".to_owned(),
        positions: CORNERS.to_vec(),
        normals: vec![Vec3::Z; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        material,
        ..Mesh::default()
    }
}

/// The floor is the first, then come two lamps, then the plate.
fn instance(index: usize, world_from_mesh: Mat4) -> Instance {
    let mesh = usize::from(index == 1 || index == 2);
    Instance { name: format!("square {index}"), mesh, world_from_mesh }
}

fn light(instance: usize, world_from_mesh: Mat4) -> Light {
    let contour = CORNERS.iter().map(|corner| world_from_mesh.transform_point3(*corner)).collect();
    Light {
        name: format!("lamp {instance}"),
        radiance: Vec3::ONE,
        two_sided: false,
        polygons: vec![Polygon { contours: vec![contour], normal: Vec3::NEG_Z, pattern: None }],
        instance,
        ..Light::default()
    }
}
