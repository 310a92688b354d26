//! What is left to whoever loads a file.

use std::fmt::{Display, Formatter};
use std::str::FromStr;

/// How a file is read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// How meshes with skins or morph targets stand.
    pub pose: Pose,
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
