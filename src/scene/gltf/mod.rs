//! Reads glTF 2.0 (.gltf and .glb).
//!
//! Files come from anywhere, so nothing in them is taken on trust: `json` checks the types of values, `accessor` the
//! ranges, `nodes` that nodes form trees. A scene made from a file has valid indices and finite numbers. Broken and
//! hostile files give an error; none may panic, hang, or take more memory than a small multiple of its own size.

mod accessor;
mod area;
mod assembly;
mod attributes;
mod buffers;
mod cameras;
mod container;
mod decoded;
mod draco;
mod elements;
mod exact;
mod extensions;
mod factors;
mod images;
mod instancing;
mod json;
mod ktx2;
mod material_extensions;
mod materials;
mod meshopt;
mod morph;
mod nodes;
mod options;
mod origin;
mod primitives;
mod punctual;
mod references;
mod skinning;
mod skins;
#[cfg(test)]
mod tests;
mod texture_uses;
mod textures;
mod uri;

use std::path::Path;

use super::error::{Fault, SceneError};
use super::notices::Notices;
use super::{Scene, framing, lights, rig};
use ::gltf::json::Root;
use accessor::Accessors;
use assembly::Assembly;
use decoded::Decoded;
use images::Sources;

pub use options::{Options, Pose, Rig};

/// Extensions of materials and textures that a file may require.
const SERVED: &[&str] = &[
    "EXT_texture_webp",
    "KHR_materials_emissive_strength",
    "KHR_materials_fuzz",
    "KHR_materials_ior",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_unlit",
    "KHR_texture_basisu",
    "KHR_texture_transform",
];
/// The most characters that are kept of a name: many things may share one.
const NAME_MAX: usize = 256;

/// The scene in a .glb file, or in a .gltf file with the buffers and images beside it. The error says in one line what
/// is wrong, where, and what to do.
pub fn load(path: &Path, options: &Options) -> Result<Scene, SceneError> {
    load_in_stages(path, options, &|_| ())
}

/// The same, and says what it is at: "reading", say.
pub fn load_in_stages(path: &Path, options: &Options, stage: &dyn Fn(&'static str)) -> Result<Scene, SceneError> {
    let file = path.display().to_string();
    // Only a path without a file name has no parent.
    let folder = path.parent().unwrap_or(Path::new("."));
    stage("reading");
    let read = buffers::read_file(path).and_then(|bytes| read(&bytes, Some(folder), options, stage));
    stage("finding what shines");
    let mut scene = read.map(|read| complete(read, options)).map_err(|fault| SceneError::new(&file, fault))?;
    scene.files.insert(0, path.to_owned());
    Ok(scene)
}

/// The scene in the bytes of a .glb, or of a .gltf with all its buffers and images inside. Errors are as those of
/// [`load`], with `name` in place of the file's.
pub fn from_slice(bytes: &[u8], name: &str, options: &Options) -> Result<Scene, SceneError> {
    read(bytes, None, options, &|_| ())
        .map(|read| complete(read, options))
        .map_err(|fault| SceneError::new(name, fault))
}

/// What the file holds, and what there is to say about it.
fn read(
    bytes: &[u8],
    folder: Option<&Path>,
    options: &Options,
    stage: &dyn Fn(&'static str),
) -> Result<(Scene, Notices), Fault> {
    let mut notices = Notices::default();
    let mut document = container::parse(bytes, &mut notices)?;
    check_extensions(&document.root)?;
    let mut buffers = buffers::load(&document, folder)?;
    references::check(&document.root)?;
    stage("decoding meshes");
    let mut decoded = Decoded::new(&mut document.root, &mut buffers);
    meshopt::decode(&mut decoded)?;
    draco::decode(&mut decoded)?;
    let (root, exact) = (&document.root, &document.exact);
    let accessors = Accessors { root, buffers: &buffers };
    accessors.check()?;
    let mut nodes = nodes::place(root, exact, &extensions::visibility(root)?, &mut notices)?;
    extensions::note(root, &mut notices);
    for animation in 0..document.animations {
        let kind = "animations are not played; nodes stand where the file puts them";
        notices.add(kind, || format!("animation {animation}"));
    }
    stage("placing meshes");
    let mut scene = Scene { materials: materials::read(root, &mut notices)?, ..Scene::default() };
    let placements = Assembly::new(accessors, &mut scene, &mut notices).add(&nodes, options.pose)?;
    origin::set(&mut scene, placements, &mut nodes, &mut notices);
    let placed = &nodes.placed;
    scene.cameras = cameras::read(root, exact, placed, &mut notices)?;
    scene.punctual_lights = punctual::read(root, placed, &mut notices)?;
    area::add(root, placed, &mut scene, &mut notices)?;
    if scene.instances.is_empty() {
        return Err(Fault::new(
            "the scene has no triangles to draw (points and lines are not drawn); put a visible mesh into it",
        ));
    }
    stage("decoding textures");
    textures::read(root, &Sources { root, buffers: &buffers, folder }, &mut scene, &mut notices)?;
    scene.files = buffers::named_files(root, folder).into_iter().collect();
    Ok((scene, notices))
}

/// Adds what the file leaves to be found or made: area lights, a camera, a rig. By then its bytes have been freed.
fn complete((mut scene, mut notices): (Scene, Notices), options: &Options) -> Scene {
    lights::add_lights(&mut scene, 0, &mut notices);
    framing::add_camera(&mut scene, &mut notices);
    match options.rig {
        Rig::Auto => rig::add_where_dark(&mut scene, &mut notices),
        Rig::On => rig::add(&mut scene, &mut notices),
        Rig::Off => {}
    }
    scene.notices = notices.into_lines().collect();
    scene
}

fn check_extensions(root: &Root) -> Result<(), Fault> {
    let is_served = |name: &str| SERVED.contains(&name) || extensions::SERVED.contains(&name);
    match root.extensions_required.iter().find(|name| !is_served(name)) {
        None => Ok(()),
        Some(name) => {
            let way = extensions::way_without(name);
            let what = format_args!("requires {}, which is not served; {way}", cut(name));
            Err(Fault::at("extensionsRequired", what))
        }
    }
}

/// A name from the file, cut to [`NAME_MAX`].
fn cut(name: &str) -> String {
    name.chars().take(NAME_MAX).collect()
}
