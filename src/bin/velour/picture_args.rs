//! The flags that all ways of rendering share.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use glam::Vec3;
use velour::picture::{Exposure, ToneCurve};
use velour::scene::{Edits, Layering, Lobes, MaterialEdits, RoughnessMap, SheenModel, Value};

use crate::assignment::{Assignment, assignment};
use crate::loading::Loading;
use crate::state::is_stdin;

/// What to draw, of which scene, and where to.
#[derive(Args)]
pub struct PictureArgs {
    /// glTF 2.0 scene, .glb or .gltf [default: a velvet drape]
    pub scene: Option<PathBuf>,
    /// The picture: .png (exposure, tone curve, sRGB) or .exr (linear radiance, 32-bit float)
    #[arg(short, long, value_name = "OUT.{png,exr}")]
    pub output: PathBuf,
    /// Pixels, width x height; the camera's vertical field of view is kept whatever the aspect
    #[arg(long, default_value = "1280x720", value_name = "WxH", value_parser = size, allow_hyphen_values = true)]
    pub size: [u32; 2],
    #[command(flatten)]
    pub loading: Loading,
    /// What the viewer has saved: view, picture, materials, lights; flags win over it. - reads it from standard input
    #[arg(long, value_name = "FILE")]
    pub state: Option<PathBuf>,
    /// A camera of the scene, by name or by index [default: the first]
    #[arg(long, value_name = "NAME|INDEX")]
    pub camera: Option<String>,
    /// The alpha, in [0,1], of every material that has a sheen, whatever its roughness map; where none has a sheen, all get a
    /// white one
    #[arg(long, value_name = "A", value_parser = read(Value::share), allow_negative_numbers = true)]
    pub alpha: Option<f32>,
    /// The colour, linear Rec. 709, each in [0,1], of every material that has a sheen; where none has a sheen, all get one of
    /// alpha 0.5
    #[arg(long, value_name = "R,G,B", value_parser = read(Value::color), allow_hyphen_values = true)]
    pub sheen_color: Option<Vec3>,
    /// Changes one material, by name or index: keys alpha, sheen-color and sheen-weight (which give it a sheen if it has
    /// none), sheen (on or off), roughness-map, sheen-model, layering, and base-color, metallic, roughness of the base;
    /// repeatable
    #[arg(long, value_name = "MATERIAL.KEY=VALUE", value_parser = assignment)]
    pub set: Vec<Assignment>,
    /// How much of the base is left under a sheen; manual=S leaves the share S in [0,1]; walk follows light through
    /// fibres and base, whatever the sheen's model (with `velour reference` only) [default: gltf]
    #[arg(long, value_name = "gltf|openpbr|reciprocal|manual=S|none|walk", value_parser = read(Value::layering))]
    pub layering: Option<Layering>,
    /// The sheen's alpha for a roughness x of the file: identity is x, square x^2, sqrt its square root [default: identity]
    #[arg(long, value_name = "identity|square|sqrt", value_parser = read(Value::roughness_map))]
    pub roughness_map: Option<RoughnessMap>,
    /// The sheen's lobe: ltc, the fitted transformed cosine; the slab that it is fitted to, or a walk through it path
    /// by path (both with `velour reference` only); or a model of earlier work, to compare with: in real time it is
    /// summed over 128 points or more on each polygon light [default: ltc]
    #[arg(long, value_name = "ltc|slab|walk|burley|conty-kulla|neubelt-pettineo|patry", value_parser = read(Value::sheen_model))]
    pub sheen_model: Option<SheenModel>,
    /// Another table with our columns, .csv or .dds
    #[arg(long, value_name = "FILE")]
    pub sheen_table: Option<PathBuf>,
    /// What is summed, of sheen, diffuse, specular and emission; or none [default: all]
    #[arg(long, value_name = "LIST", value_parser = read(Value::lobes))]
    pub lobes: Option<Lobes>,
    /// Lamps are drawn: emitters that light the scene and of whose surface at least half glows [default: on]
    #[arg(long, value_enum, value_name = "on|off")]
    pub lights_visible: Option<Switch>,
    /// Surfaces stand in the way of light [default: on]
    #[arg(long, value_enum, value_name = "on|off")]
    pub shadows: Option<Switch>,
    /// Another seed gives other noise; the same one, with the same driver, the same picture
    #[arg(long, default_value_t = 0, value_name = "N", allow_negative_numbers = true)]
    pub seed: u32,
    /// Radiance that arrives from everywhere, linear Rec. 709, each >= 0 [default: 0,0,0]
    #[arg(long, value_name = "R,G,B", value_parser = read(Value::radiance), allow_hyphen_values = true)]
    pub ambient: Option<Vec3>,
    /// Exposure value of a .png: radiance is multiplied by 2^EV; auto meters what is seen, the middle most, and says what
    /// it took [default: 0]
    #[arg(long, value_name = "EV|auto", value_parser = read(Value::exposure), allow_negative_numbers = true)]
    pub exposure: Option<Exposure>,
    /// Tone curve of a .png: none clamps, neutral is Khronos PBR Neutral, agx is Blender's AgX [default: neutral]
    #[arg(long, value_name = "none|neutral|agx", value_parser = read(Value::tone))]
    pub tonemap: Option<ToneCurve>,
    /// Prints figures for machines on stdout
    #[arg(long)]
    pub json: bool,
}

#[derive(Clone, Copy, ValueEnum, PartialEq)]
pub enum Switch {
    On,
    Off,
}

impl PictureArgs {
    /// The files beside the scene's that are read, each with what it is.
    pub fn files(&self) -> Vec<(&'static str, &Path)> {
        let table = self.sheen_table.as_deref().map(|path| ("the table that is read", path));
        let state = self.state.as_deref().filter(|path| !is_stdin(path)).map(|path| ("the state that is read", path));
        table.into_iter().chain(state).collect()
    }

    /// What the flags change in every scene; what they say of single things waits for the scene.
    pub fn edits(&self) -> Edits {
        Edits {
            lobes: self.lobes,
            lights_visible: self.lights_visible.map(|switch| switch == Switch::On),
            shadows: self.shadows.map(|switch| switch == Switch::On),
            ambient: self.ambient,
            // The radiance that is given is the one that is meant, however a state dims it.
            ambient_strength: self.ambient.map(|_| 1.0),
            exposure: self.exposure,
            tone: self.tonemap,
            every_material: MaterialEdits {
                alpha: self.alpha,
                sheen_color: self.sheen_color,
                roughness_map: self.roughness_map,
                sheen_model: self.sheen_model,
                layering: self.layering,
                ..MaterialEdits::default()
            },
            ..Edits::default()
        }
    }
}

/// Reads a flag's text as a value of edits.
fn read<T>(check: fn(&Value) -> Result<T, String>) -> impl Fn(&str) -> Result<T, String> + Clone + Send + Sync + 'static
where
    T: 'static,
{
    move |text| check(&Value::of_flag(text))
}

fn size(text: &str) -> Result<[u32; 2], String> {
    let parse = |side: &str| side.parse::<u32>().ok().filter(|side| *side > 0);
    let sides = text.split_once(['x', 'X']).and_then(|(width, height)| Some([parse(width)?, parse(height)?]));
    sides.ok_or_else(|| "give two whole numbers of at least 1, say 1280x720".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_two_whole_numbers() {
        assert_eq!(size("640x360"), Ok([640, 360]));
        for text in ["", "0x1", "1x0", "1x", "x", "1x2x3", "-1x1", "99999999999x1", "1.5x2"] {
            assert!(size(text).is_err(), "{text}");
        }
    }
}
