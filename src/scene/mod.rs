//! What there is to be drawn: meshes, materials, polygon lights and cameras, in metres and linear Rec. 709.
//!
//! A scene is plain data. [`gltf`] makes one from a file, and nobody changes it after that: what users change are
//! [`Edits`], and what is drawn ([`Drawn`]) is a function of both.

#[cfg(feature = "cli")]
pub mod assets;
pub mod black_body;
mod bounds;
mod camera;
mod clusters;
mod convex_parts;
mod cutout;
mod drawn;
mod drawn_lights;
mod edits;
mod emission;
mod emitter;
mod error;
mod framing;
pub mod gltf;
mod islands;
mod light;
mod light_frame;
mod lighting;
mod lights;
mod material;
mod mesh;
mod mipmap;
mod notices;
mod orbit;
mod outline;
mod overlaps;
mod pattern;
mod patterns;
mod rig;
mod settings;
mod sheen;
mod tangents;
#[cfg(test)]
mod tests;
mod texture;

use std::ops::Range;
use std::path::PathBuf;

use glam::{DVec3, Vec3};

pub use bounds::{Bounds, FARTHEST};
pub use camera::{Camera, Projection};
pub use cutout::Cutout;
pub use drawn::Drawn;
pub use edits::{
    Added, AddedLight, AddedPunctual, CameraEdit, Carrier, Edits, EditsError, Keyed, Kind, LightEdits, LightShape,
    MOST_CORNERS, MOST_PUNCTUAL, MaterialEdits, PunctualEdits, PunctualShape, UnknownThing, Value, select,
};
pub use error::SceneError;
pub use light::{Light, Polygon, PunctualKind, PunctualLight};
pub use light_frame::LightFrame;
pub use material::{AlphaMode, Material, TextureSlot};
pub use mesh::{Instance, Mesh};
pub use mipmap::{Encoding, Level};
pub use orbit::Orbit;
pub use pattern::{Pattern, PatternGrid, PatternImage};
pub use settings::{Lobes, Settings};
pub use sheen::{Layering, RoughnessMap, Sheen, SheenModel};
pub use texture::{Filter, Image, Sampler, Texture, TextureUse, Wrap, linear_from_srgb};

/// Everything that a picture is made of.
///
/// Indices from one part into another are valid: whoever makes a `Scene` sees to that.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Where the scene's origin stands in its file, in metres: all positions are counted from it. The file's own
    /// origin, unless the subject stands farther from that than 16 times its radius.
    pub origin: DVec3,
    /// Triangles in their own space, one mesh per glTF primitive.
    pub meshes: Vec<Mesh>,
    /// Meshes placed in the world.
    pub instances: Vec<Instance>,
    /// What the meshes are made of.
    pub materials: Vec<Material>,
    /// What the materials look up.
    pub textures: Vec<Texture>,
    /// What the textures show.
    pub images: Vec<Image>,
    /// Polygonal area lights.
    pub lights: Vec<Light>,
    /// Those of them that are the default rig, which no file has.
    pub rig: Range<usize>,
    /// Lights without extent.
    pub punctual_lights: Vec<PunctualLight>,
    /// The views. After loading there is at least one; the first is the default.
    pub cameras: Vec<Camera>,
    /// The file that it was read from, then all files that this one names as buffers and images, read or not. Empty
    /// where it was read from bytes or made otherwise.
    pub files: Vec<PathBuf>,
    /// What the file holds that Velour does not draw, and what was added to it (a framing camera, a default rig): one
    /// line per kind, for the caller to print.
    pub notices: Vec<String>,
}

impl Scene {
    /// The camera of the name `wanted`, else, where it is a number, the camera of that index, counted from 0.
    pub fn camera(&self, wanted: &str) -> Option<&Camera> {
        select(self, Kind::Camera, wanted).ok().map(|found| &self.cameras[found[0]])
    }

    /// A box in the world around all instances. It is not the smallest: around rotated meshes there is room.
    pub fn bounds(&self) -> Bounds {
        self.bounds_of(|_, _| true)
    }

    /// A box around what is lit: all instances that are no lamps, or all of them where everything is.
    pub fn subject(&self) -> Bounds {
        let lit = self.bounds_of(|material, _| !material.is_lamp());
        if lit == Bounds::EMPTY { self.bounds() } else { lit }
    }

    /// A box around what an eye in this place looks at: what is lit, but for things whose boxes hold the eye, the sweep of a studio, a
    /// room, a sky; with them where nothing else is. A floor that is flat stays.
    pub fn foreground(&self, eye: Vec3) -> Bounds {
        let before = self.bounds_of(|material, bounds| !material.is_lamp() && bounds.with(eye) != *bounds);
        if before == Bounds::EMPTY { self.subject() } else { before }
    }

    /// A box around the instances of which this holds, by their material and their box.
    fn bounds_of(&self, counts: impl Fn(&Material, &Bounds) -> bool) -> Bounds {
        let meshes: Vec<Bounds> = self.meshes.iter().map(|mesh| Bounds::of_points(&mesh.positions)).collect();
        let placed = self.instances.iter().map(|instance| {
            let material = &self.materials[self.meshes[instance.mesh].material];
            (material, meshes[instance.mesh].transformed(instance.world_from_mesh))
        });
        let counted = placed.filter(|(material, bounds)| counts(material, bounds));
        counted.fold(Bounds::EMPTY, |sum, (_, bounds)| sum.union(bounds))
    }
}
