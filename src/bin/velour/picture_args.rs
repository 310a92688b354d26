//! The flags that all ways of rendering share, and their ranges.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use glam::Vec3;
use velour::picture::ToneCurve;
use velour::scene::{Layering, Lobes, RoughnessMap, SheenModel};

use crate::overrides::{self, Assignment};

/// What to draw, of which scene, and where to.
#[derive(Args)]
pub struct PictureArgs {
    /// glTF 2.0 scene, .glb or .gltf
    pub scene: PathBuf,
    /// The picture: .png (exposure, tone curve, sRGB) or .exr (linear radiance, 32-bit float)
    #[arg(short, long, value_name = "OUT.{png,exr}")]
    pub output: PathBuf,
    /// Pixels, width x height; the camera's vertical field of view is kept whatever the aspect
    #[arg(long, default_value = "1280x720", value_name = "WxH", value_parser = size, allow_hyphen_values = true)]
    pub size: [u32; 2],
    /// A camera of the scene, by name or by index [default: the first]
    #[arg(long, value_name = "NAME|INDEX")]
    pub camera: Option<String>,
    /// Gives every material a sheen of this alpha, in [0,1]
    #[arg(long, value_name = "A", value_parser = overrides::share, allow_negative_numbers = true)]
    pub alpha: Option<f32>,
    /// Gives every material a sheen of this colour, linear Rec. 709, each in [0,1]
    #[arg(long, value_name = "R,G,B", value_parser = overrides::color, allow_hyphen_values = true)]
    pub sheen_color: Option<Vec3>,
    /// Changes one material, by name or index: keys alpha, sheen-color, roughness-map, sheen-model, layering;
    /// repeatable
    #[arg(long, value_name = "MATERIAL.KEY=VALUE", value_parser = overrides::assignment)]
    pub set: Vec<Assignment>,
    /// How much of the base is left under a sheen; manual=S leaves the share S in [0,1]; walk follows light through
    /// fibres and base, whatever the sheen's model (with `velour reference` only) [default: gltf]
    #[arg(long, value_name = "gltf|openpbr|reciprocal|manual=S|none|walk", value_parser = overrides::layering)]
    pub layering: Option<Layering>,
    /// The sheen's alpha for a roughness x: identity is x, square x^2, sqrt its square root [default: identity]
    #[arg(long, value_name = "identity|square|sqrt", value_parser = overrides::roughness_map)]
    pub roughness_map: Option<RoughnessMap>,
    /// The sheen's lobe: ltc, the fitted transformed cosine; the slab that it is fitted to, or a walk through it path
    /// by path (both with `velour reference` only); or a model of earlier work, to compare with: in real time it is
    /// summed over 128 points or more on each polygon light [default: ltc]
    #[arg(long, value_name = "ltc|slab|walk|burley|conty-kulla|neubelt-pettineo|patry", value_parser = overrides::sheen_model)]
    pub sheen_model: Option<SheenModel>,
    /// Another table with our columns, .csv or .dds
    #[arg(long, value_name = "FILE")]
    pub sheen_table: Option<PathBuf>,
    /// What is summed, of sheen, diffuse, specular and emission
    #[arg(long, default_value = "sheen,diffuse,specular,emission", value_name = "LIST", value_parser = lobes)]
    pub lobes: Lobes,
    /// Emitters that light the scene are drawn
    #[arg(long, default_value = "on", value_enum, value_name = "on|off")]
    pub lights_visible: Switch,
    /// Radiance that arrives from everywhere, linear Rec. 709, each >= 0
    #[arg(long, default_value = "0,0,0", value_name = "R,G,B", value_parser = radiance, allow_hyphen_values = true)]
    pub ambient: Vec3,
    /// Exposure value of a .png: radiance is multiplied by 2^EV
    #[arg(long, default_value_t = 0.0, value_name = "EV", value_parser = exposure, allow_negative_numbers = true)]
    pub exposure: f32,
    /// Tone curve of a .png: none clamps, neutral is Khronos PBR Neutral, agx is Blender's AgX
    #[arg(long, default_value = "neutral", value_enum, value_name = "NAME")]
    pub tonemap: Tonemap,
    /// Prints figures for machines on stdout
    #[arg(long)]
    pub json: bool,
}

#[derive(Clone, Copy, ValueEnum, PartialEq)]
pub enum Switch {
    On,
    Off,
}

#[derive(Clone, Copy, ValueEnum)]
pub enum Tonemap {
    None,
    Neutral,
    Agx,
}

impl From<Tonemap> for ToneCurve {
    fn from(tonemap: Tonemap) -> Self {
        match tonemap {
            Tonemap::None => Self::None,
            Tonemap::Neutral => Self::Neutral,
            Tonemap::Agx => Self::Agx,
        }
    }
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let parse = |side: &str| side.parse::<u32>().ok().filter(|side| *side > 0);
    let sides = text.split_once(['x', 'X']).and_then(|(width, height)| Some([parse(width)?, parse(height)?]));
    sides.ok_or_else(|| "give two whole numbers of at least 1, say 1280x720".to_owned())
}

fn radiance(text: &str) -> Result<Vec3, String> {
    let wrong = || "give three finite numbers from 0 up, say 0.1,0.1,0.2".to_owned();
    overrides::triple(text).filter(|radiance| radiance.cmpge(Vec3::ZERO).all()).ok_or_else(wrong)
}

/// Past 100 stops either way a float has nothing left to show.
fn exposure(text: &str) -> Result<f32, String> {
    overrides::number(text).filter(|value| value.abs() <= 100.0).ok_or_else(|| "give a number in [-100,100]".to_owned())
}

fn lobes(text: &str) -> Result<Lobes, String> {
    let mut lobes = Lobes { sheen: false, diffuse: false, specular: false, emission: false };
    for name in text.split(',') {
        match name.trim() {
            "sheen" => lobes.sheen = true,
            "diffuse" => lobes.diffuse = true,
            "specular" => lobes.specular = true,
            "emission" => lobes.emission = true,
            _ => return Err("give a list of sheen, diffuse, specular and emission, say sheen,diffuse".to_owned()),
        }
    }
    Ok(lobes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_in_range_are_taken() {
        assert_eq!(size("640x360"), Ok([640, 360]));
        assert_eq!(radiance("0, 0.5,30"), Ok(Vec3::new(0.0, 0.5, 30.0)));
        assert_eq!(exposure("-2.5"), Ok(-2.5));
        assert_eq!(lobes("sheen"), Ok(Lobes { sheen: true, diffuse: false, specular: false, emission: false }));
    }

    #[test]
    fn values_out_of_range_are_refused() {
        for text in ["", "0x1", "1x0", "1x", "x", "1x2x3", "-1x1", "99999999999x1", "1.5x2"] {
            assert!(size(text).is_err(), "{text}");
        }
        for text in ["", "1,1", "1,1,1,1", ",,", "1,1,-0.1", "nan,0,0", "1,inf,0", "1e40,0,0"] {
            assert!(radiance(text).is_err(), "{text}");
        }
        for text in ["nan", "inf", "101", "x"] {
            assert!(exposure(text).is_err(), "{text}");
        }
        for text in ["", "shadow", "sheen,", "all"] {
            assert!(lobes(text).is_err(), "{text}");
        }
    }
}
