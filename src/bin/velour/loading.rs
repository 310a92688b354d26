//! The flags that say how a scene's file is read.

use clap::Args;
use velour::scene::gltf::{Options, Pose};

/// How a scene's file is read.
#[derive(Args)]
pub struct Loading {
    /// How meshes with a skin or morph targets stand: file, as the joints and weights in the file pose them; bind, as
    /// they were modelled
    #[arg(long, default_value_t, value_name = "file|bind")]
    pub pose: Pose,
}

impl Loading {
    pub fn options(&self) -> Options {
        Options { pose: self.pose }
    }
}
