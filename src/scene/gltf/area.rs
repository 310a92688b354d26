//! EXT_lights_area (the draft of 2026): rectangles and disks that shine to one side.

use glam::{DAffine3, DMat3, DMat4, DVec3, Vec2, Vec3};
use gltf::json::Root;
use serde::Deserialize;

use super::nodes::{Placed, node_label};
use super::punctual::{radiance, white};
use super::{Fault, assembly, cut, extensions};
use crate::scene::error::label;
use crate::scene::notices::Notices;
use crate::scene::{Instance, Scene, emitter};

const EXTENSION: &str = "EXT_lights_area";
/// The most lights that are drawn: as many rectangles as a scene's corners allow.
const LIGHTS_MAX: usize = 2048;

#[derive(Deserialize)]
struct Lights {
    lights: Vec<Light>,
}

#[derive(Deserialize)]
struct Light {
    name: Option<String>,
    #[serde(default = "white")]
    color: [f32; 3],
    #[serde(default = "thousand")]
    intensity: f32,
    r#type: String,
    #[serde(default = "unit")]
    size: f64,
    #[serde(default)]
    rect: Rect,
}

#[derive(Deserialize)]
struct Rect {
    #[serde(default = "unit")]
    aspect: f64,
}

impl Default for Rect {
    fn default() -> Self {
        Self { aspect: unit() }
    }
}

/// The default of sizes and aspects.
fn unit() -> f64 {
    1.0
}

fn thousand() -> f32 {
    1000.0
}

/// What a light looks like before a node places it.
struct Emitter {
    name: String,
    corners: Vec<Vec2>,
    radiance: Vec3,
    /// Index into the scene's meshes, once one is placed.
    mesh: Option<usize>,
}

impl Light {
    fn read(&self) -> Result<Emitter, String> {
        let radiance = radiance(self.color, self.intensity)?;
        let positive = |name: &str, value: f64| {
            let wrong = || format!("{name} is {value:?}; give a number above 0 that 32-bit floats can hold");
            let is_held = value > 0.0 && (value as f32).is_finite();
            is_held.then_some((value as f32).max(f32::MIN_POSITIVE)).ok_or_else(wrong)
        };
        let half = 0.5 * positive("size", self.size)?;
        let corners = match self.r#type.as_str() {
            "rect" => {
                positive("rect.aspect", self.rect.aspect)?;
                let width = positive("the rectangle's width", self.size * self.rect.aspect)? * 0.5;
                emitter::rectangle(Vec2::new(width, half)).to_vec()
            }
            "disk" => emitter::disk(half),
            _ => return Err("type is neither rect nor disk; give one of them".to_owned()),
        };
        let name = cut(self.name.as_deref().unwrap_or_default());
        Ok(Emitter { name, corners, radiance, mesh: None })
    }
}

/// Adds an emitter for each light at the scene's visible nodes. All lights are checked, whether placed or not.
pub fn add(root: &Root, placed: &[Placed], scene: &mut Scene, notices: &mut Notices) -> Result<(), Fault> {
    let Lights { lights } = extensions::of_root(root, EXTENSION)?.unwrap_or(Lights { lights: Vec::new() });
    let read = |(index, light): (usize, &Light)| {
        let place = format_args!("{EXTENSION}: {}", label("light", index, light.name.as_deref())).to_string();
        light.read().map_err(|what| Fault::at(place, what))
    };
    let mut emitters: Vec<Emitter> = lights.iter().enumerate().map(read).collect::<Result<_, _>>()?;
    let of_nodes = extensions::lights_of_nodes(root, EXTENSION, emitters.len())?;
    let mut count = 0;
    for place in placed.iter().filter(|place| place.is_visible) {
        let Some(emitter) = of_nodes[place.node].map(|light| &mut emitters[light]) else { continue };
        if emitter.radiance == Vec3::ZERO {
            continue;
        }
        let node = || node_label(root, place.node);
        let world_from_mesh = world_from_mesh(place);
        let corners =
            emitter::rectangle(emitter.corners.iter().fold(Vec2::ZERO, |reach, corner| reach.max(corner.abs())));
        assembly::check_reach(world_from_mesh, corners.map(|corner| corner.extend(0.0)))
            .map_err(|what| Fault::at(node(), what))?;
        if assembly::is_singular(world_from_mesh) {
            notices.add("things scaled to nothing are not drawn", node);
            continue;
        }
        if count == LIGHTS_MAX {
            notices.add("area lights past 2048 are left out", node);
            continue;
        }
        count += 1;
        let name = match emitter.name.as_str() {
            "" => cut(root.nodes[place.node].name.as_deref().unwrap_or_default()),
            name => name.to_owned(),
        };
        let mesh = emitter
            .mesh
            .get_or_insert_with(|| emitter::add_mesh(scene, &emitter.name, &emitter.corners, emitter.radiance));
        let world_from_mesh = DMat4::from(world_from_mesh).as_mat4();
        scene.instances.push(Instance { name, mesh: *mesh, world_from_mesh });
    }
    Ok(())
}

/// Places a polygon that shines towards its +z at a node: turned to shine towards the node's -z, and scaled by the
/// longest of the node's axes. A scale never mirrors it: the extension takes scales to be uniform and positive.
fn world_from_mesh(place: &Placed) -> DAffine3 {
    let axes = place.world_from_node.matrix3;
    let scale = axes.x_axis.length().max(axes.y_axis.length()).max(axes.z_axis.length());
    let turned = DMat3::from_diagonal(DVec3::new(-1.0, 1.0, -1.0));
    let linear = DMat3::from_quat(place.rotation) * turned * scale;
    DAffine3::from_mat3_translation(linear, place.world_from_node.translation)
}
