//! The scenes that the program carries, so that it runs from any folder.

use super::gltf::{self, Options};
use super::{Scene, SceneError};

/// A .glb file in the program.
pub struct Asset {
    /// The file's name, as errors give it.
    pub name: &'static str,
    bytes: &'static [u8],
}

// Statics, not constants: however many parts of the program name them, their bytes are there once.

/// A velvet cloth over a ball: what is shown where no scene is named.
pub static DRAPE: Asset = Asset { name: "drape.glb", bytes: include_bytes!("../../assets/drape.glb") };
/// A dusty sculpture.
pub static DUST: Asset = Asset { name: "dust.glb", bytes: include_bytes!("../../assets/dust.glb") };

impl Asset {
    /// Reads the scene.
    pub fn load(&self) -> Result<Scene, SceneError> {
        gltf::from_slice(self.bytes, self.name, &Options::default())
    }
}
