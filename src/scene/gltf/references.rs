//! Indices from one list of the file into another, as far as they are not checked where they are followed.

use std::collections::HashMap;

use gltf::json::{Index, Root};

use super::assembly::primitive_label;
use super::nodes::node_label;
use super::{Fault, morph, textures};
use crate::scene::error::label;

/// Checks what nodes, primitives, textures, images, skins, views and accessors refer to, whether they are in the scene
/// or not. Before anything is decoded: decoders add to these lists.
pub fn check(root: &Root) -> Result<(), Fault> {
    for (index, view) in root.buffer_views.iter().enumerate() {
        let place = || label("bufferView", index, view.name.as_deref());
        within("buffer", root.buffers.len(), Some(&view.buffer), place)?;
    }
    for (index, accessor) in root.accessors.iter().enumerate() {
        let place = || label("accessor", index, accessor.name.as_deref());
        let sparse = accessor.sparse.iter();
        let sparse = sparse.flat_map(|sparse| [&sparse.indices.buffer_view, &sparse.values.buffer_view]);
        within("bufferView", root.buffer_views.len(), accessor.buffer_view.iter().chain(sparse), place)?;
    }
    for (index, node) in root.nodes.iter().enumerate() {
        let place = || node_label(root, index);
        within("mesh", root.meshes.len(), &node.mesh, place)?;
        within("camera", root.cameras.len(), &node.camera, place)?;
        within("skin", root.skins.len(), &node.skin, place)?;
    }
    for (mesh, primitives) in root.meshes.iter().map(|mesh| &mesh.primitives).enumerate() {
        for (index, primitive) in primitives.iter().enumerate() {
            let place = || primitive_label(root, mesh, index);
            let accessors = primitive.attributes.values().chain(&primitive.indices);
            within("accessor", root.accessors.len(), accessors, place)?;
            let targets = morph::targets(primitive).map_err(|fault| Fault::at(place(), fault))?;
            if let Some(delta) = targets.iter().flat_map(HashMap::values).find(|&&delta| delta >= root.accessors.len())
            {
                return Err(Fault::at(place(), format_args!("there is no accessor {delta}; export the file again")));
            }
            within("material", root.materials.len(), &primitive.material, place)?;
        }
    }
    check_pictures(root)?;
    for (index, skin) in root.skins.iter().enumerate() {
        let place = || label("skin", index, skin.name.as_deref());
        within("node", root.nodes.len(), skin.joints.iter().chain(&skin.skeleton), place)?;
        within("accessor", root.accessors.len(), &skin.inverse_bind_matrices, place)?;
    }
    Ok(())
}

fn check_pictures(root: &Root) -> Result<(), Fault> {
    for (index, texture) in root.textures.iter().enumerate() {
        let place = || textures::texture_label(root, index);
        within("sampler", root.samplers.len(), &texture.sampler, place)?;
        // The source is missing where an extension names an image of another kind in its stead.
        let source = textures::has_source(texture).then_some(texture.source);
        within("image", root.images.len(), &source, place)?;
    }
    for (index, image) in root.images.iter().enumerate() {
        let place = || label("image", index, image.name.as_deref());
        within("bufferView", root.buffer_views.len(), &image.buffer_view, place)?;
    }
    Ok(())
}

fn within<'a, T: 'a>(
    kind: &str,
    count: usize,
    indices: impl IntoIterator<Item = &'a Index<T>>,
    place: impl Fn() -> String,
) -> Result<(), Fault> {
    match indices.into_iter().find(|index| index.value() >= count) {
        None => Ok(()),
        Some(index) => Err(Fault::at(place(), format_args!("there is no {kind} {index}; export the file again"))),
    }
}
