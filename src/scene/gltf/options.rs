//! What is left to whoever loads a file.

use std::fmt::{Display, Formatter};
use std::str::FromStr;

/// How a file is read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// How meshes with skins or morph targets stand.
    pub pose: Pose,
    /// Whether the rig of key, fill and rim light is added.
    pub rig: Rig,
}

/// How meshes with skins or morph targets stand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pose {
    /// As the file poses them: bent by the joints of their skins, and morphed by the default weights.
    #[default]
    File,
    /// As they were modelled: their vertices as the file has them. A mesh with a skin follows whichever of its joints
    /// is nearest the root.
    Bind,
}

impl Pose {
    /// Each with the name that flags give it.
    pub const NAMES: [(&'static str, Self); 2] = [("file", Self::File), ("bind", Self::Bind)];
}

impl Display for Pose {
    fn fmt(&self, formatter: &mut Formatter) -> std::fmt::Result {
        formatter.write_str(match self {
            Self::File => "file",
            Self::Bind => "bind",
        })
    }
}

impl FromStr for Pose {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let named = Self::NAMES.into_iter().find(|(name, _)| *name == text);
        named.map(|(_, pose)| pose).ok_or_else(|| "give file or bind".to_owned())
    }
}

/// Whether the rig of key, fill and rim light is added to what lights a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rig {
    /// Where nothing lights the scene, or too faintly to see the subject by: lights of which all areas times radiances
    /// together are below 0.001 pi times the square of the subject's radius, unless they are so near that on 2% of its
    /// surface, or where they shine straight at it, it would have a radiance of 0.002 if it were white and matte.
    #[default]
    Auto,
    /// Always.
    On,
    /// Never.
    Off,
}

impl Rig {
    /// Each with the name that flags give it.
    pub const NAMES: [(&'static str, Self); 3] = [("auto", Self::Auto), ("on", Self::On), ("off", Self::Off)];
}

impl Display for Rig {
    fn fmt(&self, formatter: &mut Formatter) -> std::fmt::Result {
        formatter.write_str(match self {
            Self::Auto => "auto",
            Self::On => "on",
            Self::Off => "off",
        })
    }
}

impl FromStr for Rig {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let named = Self::NAMES.into_iter().find(|(name, _)| *name == text);
        named.map(|(_, rig)| rig).ok_or_else(|| "give auto, on or off".to_owned())
    }
}
