//! The flags that say how a scene's file is read.

use clap::Args;
use velour::scene::gltf::{Options, Pose, Rig};

/// How a scene's file is read.
#[derive(Args)]
pub struct Loading {
    /// How meshes with a skin or morph targets stand: file, as the joints and weights in the file pose them; bind, as
    /// they were modelled
    #[arg(long, default_value_t, value_name = "file|bind")]
    pub pose: Pose,
    /// Key, fill and rim lights around the subject: auto, where nothing lights it, or too faintly to see it by; on,
    /// always; off, never
    #[arg(long, default_value_t, value_name = "auto|on|off")]
    pub rig: Rig,
}

impl Loading {
    pub fn options(&self) -> Options {
        Options { pose: self.pose, rig: self.rig }
    }

    /// The flags that say so, where they say anything.
    #[cfg(feature = "window")]
    pub fn words(options: &Options) -> Vec<String> {
        let Options { pose, rig } = options;
        let default = Options::default();
        let pose = (*pose != default.pose).then(|| format!("--pose={pose}"));
        let rig = (*rig != default.rig).then(|| format!("--rig={rig}"));
        pose.into_iter().chain(rig).collect()
    }
}
