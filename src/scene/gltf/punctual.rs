//! KHR_lights_punctual: lights without extent.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use glam::{DVec3, Vec3};
use gltf::json::Root;
use serde::Deserialize;

use super::nodes::{Placed, node_label};
use super::{Fault, assembly, cut, extensions};
use crate::scene::error::label;
use crate::scene::notices::Notices;
use crate::scene::{PunctualKind, PunctualLight};

const EXTENSION: &str = "KHR_lights_punctual";
/// The most lights that count: every shaded point visits each of them.
const LIGHTS_MAX: usize = 1024;

#[derive(Deserialize)]
struct Lights {
    lights: Vec<Light>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Light {
    name: Option<String>,
    #[serde(default = "white")]
    color: [f32; 3],
    #[serde(default = "one")]
    intensity: f32,
    r#type: String,
    range: Option<f64>,
    #[serde(default)]
    spot: Spot,
}

/// Angles as the file's numbers: they may differ by less than 32-bit floats tell apart.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase", default)]
struct Spot {
    inner_cone_angle: f64,
    outer_cone_angle: f64,
}

impl Default for Spot {
    fn default() -> Self {
        Self { inner_cone_angle: 0.0, outer_cone_angle: FRAC_PI_4 }
    }
}

impl Spot {
    fn read(&self, range: f32, place: &str, notices: &mut Notices) -> Result<PunctualKind, String> {
        let &Self { inner_cone_angle: inner, outer_cone_angle: outer } = self;
        // Half pi as 32-bit floats have it is a little more than half pi, and no less well meant.
        let ends = outer <= f64::from(FRAC_PI_2 as f32);
        if !(0.0 <= inner && inner <= outer && 0.0 < outer && ends) {
            let what = "give 0 <= innerConeAngle <= outerConeAngle <= pi / 2, of which the outer is above 0";
            return Err(format!("innerConeAngle is {inner} and outerConeAngle {outer}; {what}"));
        }
        if inner == outer {
            notices.add("a spot whose cones are equal has a hard edge", || place.to_owned());
        }
        Ok(PunctualKind::Spot { range, inner: inner as f32, outer: (outer as f32).max(f32::MIN_POSITIVE) })
    }
}

/// The default of colours.
pub fn white() -> [f32; 3] {
    [1.0; 3]
}

/// The default of factors.
pub fn one() -> f32 {
    1.0
}

/// Colour times intensity, or what is wrong with one of them.
pub fn radiance(color: [f32; 3], intensity: f32) -> Result<Vec3, String> {
    let is_light = |value: &f32| value.is_finite() && *value >= 0.0;
    if let Some(value) = color.iter().find(|value| !is_light(value)) {
        return Err(format!("color holds {value}; give finite numbers from 0 up"));
    }
    let radiance = Vec3::from(color) * intensity;
    if !is_light(&intensity) || !radiance.is_finite() {
        return Err(format!("intensity is {intensity}; give a finite number from 0 up"));
    }
    Ok(radiance)
}

impl Light {
    /// The light at the origin, or what is wrong with it.
    fn read(&self, place: &str, notices: &mut Notices) -> Result<PunctualLight, String> {
        let intensity = radiance(self.color, self.intensity)?;
        let range = match self.range {
            None => f32::INFINITY,
            Some(0.0) => {
                notices.add("a light's range of 0 is taken as none", || place.to_owned());
                f32::INFINITY
            }
            Some(range) if range < 0.0 => return Err(format!("range is {range}; give a number above 0")),
            Some(range) => (range as f32).max(f32::MIN_POSITIVE),
        };
        let kind = match self.r#type.as_str() {
            "point" => PunctualKind::Point { range },
            "directional" => PunctualKind::Directional,
            "spot" => self.spot.read(range, place, notices)?,
            _ => return Err("type is none of directional, point, spot; give one of them".to_owned()),
        };
        let name = cut(self.name.as_deref().unwrap_or_default());
        Ok(PunctualLight { name, kind, intensity, position: Vec3::ZERO, direction: Vec3::NEG_Z })
    }
}

/// The lights at the scene's visible nodes, each with its name in the file's list or, without one, its node's. All are
/// checked, whether placed or not.
pub fn read(root: &Root, placed: &[Placed], notices: &mut Notices) -> Result<Vec<PunctualLight>, Fault> {
    let Lights { lights } = extensions::of_root(root, EXTENSION)?.unwrap_or(Lights { lights: Vec::new() });
    let mut read = |(index, light): (usize, &Light)| {
        let place = format_args!("{EXTENSION}: {}", label("light", index, light.name.as_deref())).to_string();
        light.read(&place, notices).map_err(|what| Fault::at(&place, what))
    };
    let lights: Vec<PunctualLight> = lights.iter().enumerate().map(&mut read).collect::<Result<_, _>>()?;
    let of_nodes = extensions::lights_of_nodes(root, EXTENSION, lights.len())?;
    let mut found = Vec::new();
    for &Placed { node, world_from_node, .. } in placed.iter().filter(|place| place.is_visible) {
        let Some(light) = of_nodes[node].map(|light| &lights[light]).filter(|light| light.intensity != Vec3::ZERO)
        else {
            continue;
        };
        assembly::check_reach(world_from_node, [Vec3::ZERO]).map_err(|what| Fault::at(node_label(root, node), what))?;
        let direction = world_from_node.transform_vector3(DVec3::NEG_Z).try_normalize();
        if found.len() == LIGHTS_MAX {
            notices.add("punctual lights past 1024 light nothing", || node_label(root, node));
        } else if let Some(direction) = direction {
            let mut light = light.clone();
            if light.name.is_empty() {
                light.name = cut(root.nodes[node].name.as_deref().unwrap_or_default());
            }
            let position = world_from_node.translation.as_vec3();
            found.push(PunctualLight { position, direction: direction.as_vec3(), ..light });
        } else {
            notices.add("lights without a direction, scaled to nothing, are left out", || node_label(root, node));
        }
    }
    Ok(found)
}
