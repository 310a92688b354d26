// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
//! A scene as the shader reads it: triangles in the world, what they are made of, and those that shine.

use glam::{Mat4, Vec3};
use velour::scene::{AlphaMode, Drawn, Instance, Layering, Projection, Scene, SheenModel};

use super::bvh::{self, Node};

#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Corner {
    position: [f32; 3],
    surface: u32,
    normal: [f32; 3],
    padding: u32,
}

/// What an instance is made of.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Surface {
    base_color: [f32; 3],
    metallic: f32,
    /// Of the dielectric base.
    f0: [f32; 3],
    f90: f32,
    sheen_color: [f32; 3],
    sheen_alpha: f32,
    emission: [f32; 3],
    roughness: f32,
    double_sided: u32,
    padding: [u32; 3],
}

#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Light {
    triangle: u32,
    share: f32,
}

/// A perspective camera, which looks along its -z.
pub struct Eye {
    pub world_from_camera: Mat4,
    pub yfov: f32,
    pub near: f32,
    pub far: f32,
}

pub struct TracedScene {
    pub nodes: Vec<Node>,
    /// Counter-clockwise seen from the front.
    pub triangles: Vec<[Corner; 3]>,
    pub surfaces: Vec<Surface>,
    pub lights: Vec<Light>,
    /// The sum over the lights of area times greatest channel.
    pub light_total: f32,
    /// The greatest coordinate in metres.
    pub reach: f32,
    pub eye: Eye,
}

impl TracedScene {
    /// The scene as `velour reference` draws it; or, in one line, what there is in it that this tracer does not draw.
    pub fn new(drawn: &Drawn) -> Result<Self, String> {
        let lacks = lacks(drawn);
        if !lacks.is_empty() {
            return Err(format!("not drawn here: {}; use `velour reference`", lacks.join("; ")));
        }
        let camera = &drawn.scene.cameras[0];
        let Projection::Perspective { yfov, near, far } = camera.projection else {
            return Err("not drawn here: an orthographic camera; use `velour reference`".to_owned());
        };
        let surfaces = (0..drawn.instances.len()).map(|index| surface(drawn, index)).collect::<Vec<_>>();
        let unordered: Vec<[Corner; 3]> =
            drawn.instances.iter().enumerate().flat_map(|(index, instance)| corners(drawn, index, instance)).collect();
        let positions: Vec<[Vec3; 3]> =
            unordered.iter().map(|corners| corners.map(|corner| corner.position.into())).collect();
        let (nodes, order) = bvh::build(&positions);
        let triangles: Vec<[Corner; 3]> = order.iter().map(|&index| unordered[index]).collect();
        let (lights, light_total) = lights(&triangles, &surfaces);
        if lights.is_empty() {
            return Err("nothing in the scene shines: give a material an emission".to_owned());
        }
        let reach = positions.iter().flatten().fold(0.0_f32, |most, corner| most.max(corner.abs().max_element()));
        let eye = Eye { world_from_camera: camera.world_from_camera, yfov, near, far };
        Ok(Self { nodes, triangles, surfaces, lights, light_total, reach, eye })
    }
}

/// What the tracer does not draw, each kind once.
fn lacks(drawn: &Drawn) -> Vec<&'static str> {
    let Scene { meshes, .. } = drawn.scene;
    let any = |holds: &dyn Fn(usize) -> bool| (0..drawn.instances.len()).any(holds);
    let material = |index| drawn.material_of(index);
    let sheen = |index| material(index).sheen;
    let is_curved = |index| drawn.emission(index) != Vec3::ZERO && drawn.light(index).is_none();
    let kinds = [
        ("textures", any(&|index| material(index).textures.iter().any(Option::is_some))),
        ("opacity", any(&|index| material(index).alpha_mode != AlphaMode::Opaque)),
        ("unlit materials", any(&|index| material(index).unlit)),
        (
            "another layering than KHR_materials_sheen's",
            any(&|at| sheen(at).is_some_and(|s| s.layering != Layering::Gltf)),
        ),
        ("another sheen than the transformed cosine", any(&|at| sheen(at).is_some_and(|s| s.model != SheenModel::Ltc))),
        ("vertex colours", meshes.iter().any(|mesh| !mesh.colors.is_empty())),
        ("lights without extent", !drawn.punctual_lights.is_empty()),
        ("light from everywhere", drawn.settings.ambient != Vec3::ZERO),
        ("emitters that are no lights to `velour reference`", any(&is_curved)),
        ("lights that lie within others", drawn.lights.iter().any(|light| !light.doubles.is_empty())),
    ];
    kinds.into_iter().filter(|(_, holds)| *holds).map(|(kind, _)| kind).collect()
}

fn surface(drawn: &Drawn, index: usize) -> Surface {
    let material = drawn.material_of(index);
    // A layer that is not there is black.
    let (sheen_color, sheen_alpha) =
        material.sheen.map_or((Vec3::ZERO, 0.0), |sheen| (sheen.weight * sheen.color, sheen.alpha()));
    Surface {
        base_color: material.base_color.to_array(),
        metallic: material.metallic,
        // A tint may take it above the reflectance at grazing angles.
        f0: material.dielectric_f0().min(Vec3::splat(material.specular)).to_array(),
        f90: material.specular,
        sheen_color: sheen_color.to_array(),
        sheen_alpha,
        emission: drawn.emission(index).to_array(),
        roughness: material.roughness,
        double_sided: drawn.is_double_sided(index).into(),
        padding: [0; 3],
    }
}

/// An instance's triangles in the world.
fn corners<'a>(drawn: &'a Drawn, index: usize, instance: &'a Instance) -> impl Iterator<Item = [Corner; 3]> + 'a {
    let mesh = drawn.mesh_of(index);
    let (world_from_normal, mirrors) = (instance.world_from_normal(), instance.mirrors());
    let corner = move |at: u32| Corner {
        position: instance.world_from_mesh.transform_point3(mesh.positions[at as usize]).to_array(),
        surface: index as u32,
        normal: (world_from_normal * mesh.normals[at as usize]).normalize_or(Vec3::Z).to_array(),
        padding: 0,
    };
    let triangles = mesh.indices.as_chunks::<3>().0.iter();
    triangles.map(move |&[a, b, c]| if mirrors { [a, c, b] } else { [a, b, c] }.map(corner))
}

/// The triangles that shine, each with the share of samples up to it, and the sum of area times greatest channel.
fn lights(triangles: &[[Corner; 3]], surfaces: &[Surface]) -> (Vec<Light>, f32) {
    let power = |corners: &[Corner; 3]| {
        let [a, b, c] = corners.map(|corner| Vec3::from(corner.position).as_dvec3());
        let greatest = Vec3::from(surfaces[corners[0].surface as usize].emission).max_element();
        0.5 * (b - a).cross(c - a).length() * f64::from(greatest)
    };
    let total: f64 = triangles.iter().map(power).sum();
    let mut sum = 0.0;
    let lit = triangles.iter().enumerate().filter(|(_, corners)| power(corners) > 0.0);
    let lights = lit.map(|(index, corners)| {
        sum += power(corners);
        Light { triangle: index as u32, share: (sum / total) as f32 }
    });
    (lights.collect(), total as f32)
}
