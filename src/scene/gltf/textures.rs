//! Textures: their samplers, and which image each of them shows.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::hash::Hash;

use gltf::json::Root;
use gltf::json::texture::{MagFilter, MinFilter, Sampler as JsonSampler, Texture as JsonTexture, WrappingMode};
use gltf::json::validation::Checked::{self, Invalid, Valid};
use serde::Deserialize;
use serde_json::Value;

use super::Fault;
use super::images::{self, Sources, Wanted};
use super::material_extensions::object;
use crate::scene::error::label;
use crate::scene::notices::Notices;
use crate::scene::{Filter, Material, Sampler, Scene, Texture, TextureSlot, TextureUse, Wrap};

/// Extensions that name an image of another format than glTF's own, the better one first where a texture has both.
const FORMATS: [&str; 2] = ["EXT_texture_webp", "KHR_texture_basisu"];

/// Such an extension as the JSON holds it.
#[derive(Deserialize)]
struct Format {
    source: u64,
}

/// Reads the textures that the scene's materials use, with their images, and makes the materials name the scene's
/// textures in place of the file's. Those without an image that can be read are left out.
pub fn read(root: &Root, sources: &Sources, scene: &mut Scene, notices: &mut Notices) -> Result<(), Fault> {
    let samplers = samplers(root)?;
    // The scene's index of each texture that is used, and of each image.
    let (mut textures, mut images, mut known) = (HashMap::new(), Numbered::new(), Numbered::new());
    let (mut same, mut colors) = (HashMap::new(), HashSet::new());
    for (index, is_color) in used(&scene.materials) {
        if let Some(image) = image(root, index, notices)? {
            // Images of the same bytes are one.
            let bytes = (root.images[image].uri.as_deref(), root.images[image].buffer_view.map(|view| view.value()));
            let image = *same.entry(bytes).or_insert(image);
            colors.extend(is_color.then_some(image));
            let sampler = root.textures[index].sampler.map_or(Sampler::DEFAULT, |sampler| samplers[sampler.value()]);
            textures.insert(index, known.number(Texture { image: images.number(image), sampler }));
        }
    }
    for slot in scene.materials.iter_mut().flat_map(|material| &mut material.textures) {
        *slot = slot.and_then(|used| Some(TextureUse { texture: *textures.get(&used.texture)?, ..used }));
    }
    scene.textures = known.things;
    let wanted = images.things.into_iter().map(|index| Wanted { index, is_color: colors.contains(&index) });
    scene.images = images::read(sources, &wanted.collect::<Vec<_>>(), notices)?;
    Ok(())
}

/// The file's textures that materials use, in order, and whether any of them reads colours there.
fn used(materials: &[Material]) -> BTreeMap<usize, bool> {
    let mut used = BTreeMap::new();
    for (material, slot) in materials.iter().flat_map(|material| TextureSlot::ALL.map(|slot| (material, slot))) {
        if let Some(TextureUse { texture, .. }) = material.texture(slot) {
            *used.entry(texture).or_default() |= slot.is_color();
        }
    }
    used
}

/// Different things, numbered in the order in which they come.
struct Numbered<T> {
    things: Vec<T>,
    numbers: HashMap<T, usize>,
}

impl<T: Copy + Eq + Hash> Numbered<T> {
    fn new() -> Self {
        Self { things: Vec::new(), numbers: HashMap::new() }
    }

    fn number(&mut self, thing: T) -> usize {
        *self.numbers.entry(thing).or_insert_with(|| {
            self.things.push(thing);
            self.things.len() - 1
        })
    }
}

/// The index of the image that a texture shows, if there is one that can be read.
fn image(root: &Root, index: usize, notices: &mut Notices) -> Result<Option<usize>, Fault> {
    let texture = &root.textures[index];
    let place = || texture_label(root, index);
    let others = texture.extensions.as_ref().map(|extensions| &extensions.others);
    let format = others.and_then(|others| FORMATS.into_iter().find_map(|name| Some((name, others.get(name)?))));
    if let Some((name, format)) = format {
        return format_source(name, format, root.images.len()).map(Some).map_err(|what| Fault::at(place(), what));
    }
    if has_source(texture) {
        return Ok(Some(texture.source.value()));
    }
    match others.and_then(|others| others.keys().next()) {
        Some(name) => notices.add("textures in formats that are not served are left out", || {
            format!("{} of {}", super::cut(name), place())
        }),
        None => notices.add("textures without an image are left out", place),
    }
    Ok(None)
}

fn format_source(name: &str, format: &Value, images: usize) -> Result<usize, String> {
    let Format { source } = object(name, format)?;
    let found = usize::try_from(source).ok().filter(|&source| source < images);
    found.ok_or_else(|| format!("{name}: there is no image {source}; export the file again"))
}

/// Whether a texture has a source. Where it has none, the JSON's type holds an index in its place that no file can
/// have.
pub fn has_source(texture: &JsonTexture) -> bool {
    texture.source.value() != u32::MAX as usize
}

/// `texture 3 "grain"`.
pub fn texture_label(root: &Root, index: usize) -> String {
    label("texture", index, root.textures.get(index).and_then(|texture| texture.name.as_deref()))
}

fn samplers(root: &Root) -> Result<Vec<Sampler>, Fault> {
    let read = |(index, read): (usize, &JsonSampler)| {
        sampler(read).map_err(|what| Fault::at(label("sampler", index, read.name.as_deref()), what))
    };
    root.samplers.iter().enumerate().map(read).collect()
}

fn sampler(sampler: &JsonSampler) -> Result<Sampler, String> {
    let magnify = match known("magFilter", sampler.mag_filter)? {
        Some(MagFilter::Nearest) => Filter::Nearest,
        Some(MagFilter::Linear) | None => Sampler::DEFAULT.magnify,
    };
    let (minify, mipmaps) = match known("minFilter", sampler.min_filter)? {
        None => (Sampler::DEFAULT.minify, Sampler::DEFAULT.mipmaps),
        Some(MinFilter::Nearest) => (Filter::Nearest, None),
        Some(MinFilter::Linear) => (Filter::Linear, None),
        Some(MinFilter::NearestMipmapNearest) => (Filter::Nearest, Some(Filter::Nearest)),
        Some(MinFilter::LinearMipmapNearest) => (Filter::Linear, Some(Filter::Nearest)),
        Some(MinFilter::NearestMipmapLinear) => (Filter::Nearest, Some(Filter::Linear)),
        Some(MinFilter::LinearMipmapLinear) => (Filter::Linear, Some(Filter::Linear)),
    };
    let wrap = |name, mode| {
        Ok::<_, String>(match known(name, Some(mode))? {
            Some(WrappingMode::ClampToEdge) => Wrap::Clamp,
            Some(WrappingMode::MirroredRepeat) => Wrap::Mirror,
            Some(WrappingMode::Repeat) | None => Wrap::Repeat,
        })
    };
    let wrap = [wrap("wrapS", sampler.wrap_s)?, wrap("wrapT", sampler.wrap_t)?];
    Ok(Sampler { wrap, magnify, minify, mipmaps })
}

fn known<T>(name: &str, value: Option<Checked<T>>) -> Result<Option<T>, String> {
    match value {
        None => Ok(None),
        Some(Valid(value)) => Ok(Some(value)),
        Some(Invalid) => Err(format!("{name} is none of glTF's; export the file again")),
    }
}
