//! Extensions of the file as a whole, of its nodes, and of what holds its data.

use gltf::json::{Buffer, Root};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use super::Fault;
use super::nodes::node_label;
use crate::scene::notices::Notices;

/// Those that a file may require, besides those of materials and textures.
pub const SERVED: [&str; 9] = [
    "EXT_lights_area",
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_variants",
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "KHR_node_visibility",
];

/// Codecs that compress what buffers hold.
const CODECS: [&str; 2] = ["EXT_meshopt_compression", "KHR_meshopt_compression"];

/// How a file is made one that does not require an extension.
pub fn way_without(name: &str) -> &'static str {
    match name {
        "EXT_texture_avif" => "convert its images: gltf-transform png --formats avif IN.glb OUT.glb",
        "KHR_materials_pbrSpecularGlossiness" => "convert its materials: gltf-transform metalrough IN.glb OUT.glb",
        _ => "export the file without it",
    }
}

/// What the file as a whole holds under an extension's name, if anything.
pub fn of_root<T: DeserializeOwned>(root: &Root, name: &str) -> Result<Option<T>, Fault> {
    root.extensions
        .as_ref()
        .and_then(|extensions| extensions.others.get(name))
        .map(|value| parse(value, name))
        .transpose()
}

fn parse<T: DeserializeOwned>(value: &Value, name: &str) -> Result<T, Fault> {
    let wrong =
        |error| Fault::at(format_args!("extensions.{name}"), format_args!("{error}; correct it or export again"));
    serde_path_to_error::deserialize(value).map_err(wrong)
}

/// What a node holds under an extension's name, if anything.
pub fn of_node<T: DeserializeOwned>(root: &Root, index: usize, name: &str) -> Result<Option<T>, Fault> {
    let value = root.nodes[index].extensions.as_ref().and_then(|extensions| extensions.others.get(name));
    let parsed = value.map(|value| parse(value, name)).transpose();
    parsed.map_err(|fault| Fault::at(node_label(root, index), fault))
}

/// A node's reference to a light.
#[derive(Deserialize)]
struct Reference {
    light: usize,
}

/// Which of an extension's `count` lights each node bears, whether the node is in the scene or not.
pub fn lights_of_nodes(root: &Root, name: &str, count: usize) -> Result<Vec<Option<usize>>, Fault> {
    let light = |index: usize| {
        let Some(Reference { light }) = of_node(root, index, name)? else { return Ok(None) };
        let missing = format_args!("there is no light {light} in {name}; export the file again");
        (light < count).then_some(Some(light)).ok_or_else(|| Fault::at(node_label(root, index), missing))
    };
    (0..root.nodes.len()).map(light).collect()
}

/// What a node says of itself under KHR_node_visibility.
#[derive(Deserialize)]
struct Visibility {
    #[serde(default = "visible")]
    visible: bool,
}

fn visible() -> bool {
    true
}

/// Whether each node says of itself that it is to be seen; those above it may hide it still.
pub fn visibility(root: &Root) -> Result<Vec<bool>, Fault> {
    let is_visible = |index: usize| {
        let said: Option<Visibility> = of_node(root, index, "KHR_node_visibility")?;
        Ok(said.is_none_or(|said| said.visible))
    };
    (0..root.nodes.len()).map(is_visible).collect()
}

/// Notes what is not drawn of the file as a whole and of its nodes.
pub fn note(root: &Root, notices: &mut Notices) {
    if root.extensions.as_ref().is_some_and(|extensions| extensions.others.contains_key("KHR_materials_variants")) {
        notices.add("material variants: the default one is drawn", || "KHR_materials_variants".to_owned());
    }
    for (index, node) in root.nodes.iter().enumerate() {
        for name in node.extensions.iter().flat_map(|extensions| extensions.others.keys()) {
            if !SERVED.contains(&name.as_str()) {
                notices
                    .add("node extensions that are passed over", || format!("{name} of {}", node_label(root, index)));
            }
        }
    }
}

/// The extension that says how the data of a buffer or view is compressed, if there is one.
pub fn codec(extensions: &Map<String, Value>) -> Option<(&'static str, &Value)> {
    CODECS.into_iter().find_map(|name| Some((name, extensions.get(name)?)))
}

/// Whether each buffer only stands in for what is decoded from others: its own data, if it has any, is not read.
pub fn stand_ins(root: &Root) -> Vec<bool> {
    let marked = |buffer: &Buffer| buffer.extensions.as_ref().is_some_and(|found| codec(&found.others).is_some());
    let mut stand_ins: Vec<bool> = root.buffers.iter().map(marked).collect();
    let codecs = root.buffer_views.iter().map(|view| codec(&view.extensions.as_ref()?.others));
    let views = || root.buffer_views.iter().zip(codecs.clone());
    let mut mark = |buffer: usize, is_one| stand_ins.get_mut(buffer).into_iter().for_each(|found| *found = is_one);
    for (view, codec) in views() {
        if codec.is_some() {
            mark(view.buffer.value(), true);
        }
    }
    // Any other use of its data outweighs this.
    for (view, codec) in views() {
        let used = codec.map_or(Some(view.buffer.value() as u64), |(_, value)| value.get("buffer")?.as_u64());
        used.and_then(|buffer| usize::try_from(buffer).ok()).into_iter().for_each(|buffer| mark(buffer, false));
    }
    stand_ins
}
