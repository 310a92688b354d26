//! The layers of a .exr: which there are, and which one is taken.

use std::collections::BTreeMap;

use exr::math::Vec2;
use exr::meta::attribute::{AttributeValue, ChannelList, Text};
use exr::meta::header::Header;

/// What ends the name of the layer that is the picture itself, from the surest on: Blender's; those of Nuke and Arnold;
/// what compositors call it; those of Houdini and RenderMan.
const WHOLE: [&str; 6] = ["combined", "rgba", "rgb", "beauty", "c", "ci"];
/// Most names that a message lists, and most characters of each.
const NAMES_LISTED: usize = 12;
const NAME_LISTED: usize = 40;

/// Channels of one part of a .exr that are a picture together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Layer {
    /// What stands before the channels' own names; in a file of several parts the part's name. Empty where the file
    /// has plain channels.
    pub name: String,
    /// Index of the part.
    pub part: usize,
    /// Indices of red, green and blue among the part's channels; thrice that of the luminance where there is no more.
    pub channels: [usize; 3],
}

/// Why no layer is taken; each with the names of those that are there.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum NoLayer {
    /// None holds colours.
    Colors,
    /// There are several, of which none is the picture by its name.
    Undecided(String),
    /// None has the name that was asked for.
    Unknown(String),
}

/// All layers that hold colours, in the file's order. Left out are deep and subsampled ones, and the ids of
/// cryptomattes, whose channels only look like colours.
pub(super) fn layers(parts: &[Header]) -> Vec<Layer> {
    let mattes = cryptomattes(parts);
    let mut layers = Vec::new();
    for (index, part) in parts.iter().enumerate() {
        let is_whole = part.channels.list.iter().all(|channel| channel.sampling == Vec2(1, 1));
        if part.deep || !is_whole {
            continue;
        }
        let part_name = part.own_attributes.layer_name.as_ref().filter(|_| parts.len() > 1).map(text);
        for (prefix, channels) in colors(&part.channels) {
            let name = joined(part_name.as_deref().unwrap_or_default(), &prefix);
            let is_matte = |matte: &String| is_numbered(&prefix, matte) || is_numbered(&name, matte);
            if !mattes.iter().any(is_matte) {
                layers.push(Layer { name, part: index, channels });
            }
        }
    }
    layers
}

/// The layer of the name that is wanted, or the one whose name ends in it after a dot; a plain picture alone in its file
/// is taken under any name. Where none is wanted: plain channels, else the only layer, else the one that is the picture
/// by its name.
pub(super) fn choose(layers: &[Layer], wanted: Option<&str>) -> Result<Layer, NoLayer> {
    let listed = || listed(layers);
    let chosen = match (layers, wanted) {
        ([], _) => return Err(NoLayer::Colors),
        ([only], None) => Some(only),
        ([only], Some(_)) if only.name.is_empty() => Some(only),
        (_, Some(wanted)) => {
            let of_name = layers.iter().find(|layer| layer.name == wanted);
            let chosen = of_name.or_else(|| only(layers, |layer| layer.name.ends_with(&format!(".{wanted}"))));
            return chosen.cloned().ok_or_else(|| NoLayer::Unknown(listed()));
        }
        (_, None) => layers.iter().find(|layer| layer.name.is_empty()).or_else(|| whole(layers)),
    };
    chosen.cloned().ok_or_else(|| NoLayer::Undecided(listed()))
}

fn whole(layers: &[Layer]) -> Option<&Layer> {
    let is =
        |layer: &Layer, name: &str| layer.name.rsplit('.').next().is_some_and(|end| end.eq_ignore_ascii_case(name));
    let surest = WHOLE.into_iter().find(|name| layers.iter().any(|layer| is(layer, name)))?;
    only(layers, |layer| is(layer, surest))
}

/// The layer that this holds of, where it holds of one alone.
fn only(layers: &[Layer], holds: impl Fn(&Layer) -> bool) -> Option<&Layer> {
    let mut found = layers.iter().filter(|layer| holds(layer));
    found.next().filter(|_| found.next().is_none())
}

/// Names for a message of one line, cut where they are many or long.
fn listed(layers: &[Layer]) -> String {
    let one = |layer: &Layer| match layer.name.chars().count() {
        0 => "R,G,B without a name".to_owned(),
        length if length > NAME_LISTED => layer.name.chars().take(NAME_LISTED).chain(['…']).collect(),
        _ => layer.name.clone(),
    };
    let mut names: Vec<String> = layers.iter().take(NAMES_LISTED).map(one).collect();
    if layers.len() > NAMES_LISTED {
        names.push(format!("{} more", layers.len() - NAMES_LISTED));
    }
    names.join(", ").replace(char::is_control, "?")
}

/// What channels with one prefix are, as far as it matters here.
#[derive(Default)]
struct Group {
    colors: [Option<usize>; 3],
    luminance: Option<usize>,
    /// Whether a channel says that Y is no luminance by itself: a coordinate, or half of a colour.
    is_other: bool,
}

impl Group {
    fn add(&mut self, name: &str, index: usize) {
        match name.to_ascii_lowercase().as_str() {
            "r" | "red" => self.colors[0] = self.colors[0].or(Some(index)),
            "g" | "green" => self.colors[1] = self.colors[1].or(Some(index)),
            "b" | "blue" => self.colors[2] = self.colors[2].or(Some(index)),
            "y" => self.luminance = Some(index),
            "x" | "z" | "ry" | "by" => self.is_other = true,
            _ => {}
        }
    }

    fn channels(&self) -> Option<[usize; 3]> {
        match self.colors {
            [Some(red), Some(green), Some(blue)] => Some([red, green, blue]),
            _ => self.luminance.filter(|_| !self.is_other).map(|luminance| [luminance; 3]),
        }
    }
}

/// The prefixes under which there are colours, in the order of their first channels, and their indices.
fn colors(channels: &ChannelList) -> Vec<(String, [usize; 3])> {
    let mut groups: BTreeMap<String, (usize, Group)> = BTreeMap::new();
    for (index, channel) in channels.list.iter().enumerate() {
        let name = text(&channel.name);
        let (prefix, own) = name.rsplit_once('.').unwrap_or(("", &name));
        groups.entry(prefix.to_owned()).or_insert_with(|| (index, Group::default())).1.add(own, index);
    }
    let mut groups: Vec<_> = groups.into_iter().collect();
    groups.sort_by_key(|(_, (first, _))| *first);
    groups.into_iter().filter_map(|(prefix, (_, group))| Some((prefix, group.channels()?))).collect()
}

/// A part's name and a prefix in it; some programs repeat the one in the other.
fn joined(part: &str, prefix: &str) -> String {
    let repeats = |whole: &str, start: &str| whole == start || whole.starts_with(&format!("{start}."));
    match (part, prefix) {
        ("", name) | (name, "") => name.to_owned(),
        _ if repeats(prefix, part) => prefix.to_owned(),
        _ if part.ends_with(&format!(".{prefix}")) => part.to_owned(),
        _ => format!("{part}.{prefix}"),
    }
}

/// The names of all cryptomattes, whose layers are these with a number behind (Friedman and Jones 2015).
fn cryptomattes(parts: &[Header]) -> Vec<String> {
    let is_name = |key: &Text| {
        let key = text(key);
        key.starts_with("cryptomatte/") && key.ends_with("/name")
    };
    let attributes =
        parts.iter().flat_map(|part| part.own_attributes.other.iter().chain(&part.shared_attributes.other));
    let names = attributes.filter(|(key, _)| is_name(key)).filter_map(|(_, value)| match value {
        AttributeValue::Text(name) => Some(text(name)),
        _ => None,
    });
    names.collect()
}

/// Whether a name is another one with nothing but digits behind it.
fn is_numbered(name: &str, other: &str) -> bool {
    name.strip_prefix(other).is_some_and(|rest| rest.bytes().all(|byte| byte.is_ascii_digit()))
}

fn text(name: &Text) -> String {
    String::from_utf8_lossy(name.as_slice()).into_owned()
}
