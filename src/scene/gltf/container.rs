//! The .glb container.

use gltf::json::Root;

use super::Fault;
use super::elements::unsigned;
use super::exact::Exact;
use super::json::{Parsed, parse_json};
use crate::scene::notices::Notices;

/// Bytes of a chunk before its data: its length and its type.
const CHUNK_HEADER: usize = 8;
/// Bytes of a .glb before its first chunk.
const GLB_HEADER: usize = 12;

/// The parts of a file. All values have the right types; nothing else is known about them.
pub struct Document<'a> {
    pub root: Root,
    pub exact: Exact,
    /// The buffer within a .glb.
    pub binary: Option<&'a [u8]>,
    /// How many animations there are, of which nothing else is kept.
    pub animations: usize,
}

/// Splits a .glb or .gltf file into its parts; which of the two it is, its first bytes tell.
pub fn parse<'a>(bytes: &'a [u8], notices: &mut Notices) -> Result<Document<'a>, Fault> {
    if bytes.is_empty() {
        return Err(Fault::new("the file is empty; give a .gltf or .glb file"));
    }
    let (json, binary) = if bytes.starts_with(b"glTF") { split_glb(bytes)? } else { (bytes, None) };
    let Parsed { root, exact, animations } = parse_json(json, notices)?;
    Ok(Document { root, exact, binary, animations })
}

/// The JSON and, where there is one, the binary chunk.
fn split_glb(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), Fault> {
    let short = |needed: u64| {
        let have = bytes.len();
        Fault::new(format_args!("the .glb is cut short ({have} bytes of {needed}); copy or export it again"))
    };
    let header = bytes.get(..GLB_HEADER).ok_or_else(|| short(GLB_HEADER as u64))?;
    let version = unsigned(&header[4..8]);
    if version != 2 {
        return Err(Fault::new(format_args!("the .glb is of version {version}; export it as glTF 2.0")));
    }
    let length = unsigned(&header[8..12]);
    let body = bytes.get(GLB_HEADER..length as usize).ok_or_else(|| match (length as usize) < GLB_HEADER {
        true => Fault::new(format_args!("the .glb says that it is {length} bytes long; export it again")),
        false => short(length.into()),
    })?;
    let (Chunk { kind, data: json }, rest) = split_chunk(body, "JSON")?;
    if kind != b"JSON" {
        let found = kind.escape_ascii();
        return Err(Fault::new(format_args!("the .glb begins with a chunk '{found}', not with JSON; export it again")));
    }
    Ok((json, binary_chunk(rest)?))
}

/// The first binary chunk among those after the JSON. Readers are to skip chunks of other kinds.
fn binary_chunk(mut rest: &[u8]) -> Result<Option<&[u8]>, Fault> {
    while !rest.is_empty() {
        let (chunk, next) = split_chunk(rest, "BIN")?;
        if chunk.kind == b"BIN\0" {
            return Ok(Some(chunk.data));
        }
        rest = next;
    }
    Ok(None)
}

/// A part of a .glb.
struct Chunk<'a> {
    kind: &'a [u8],
    data: &'a [u8],
}

/// The first chunk, and what follows it. Errors call it `name`.
fn split_chunk<'a>(bytes: &'a [u8], name: &str) -> Result<(Chunk<'a>, &'a [u8]), Fault> {
    let cut = || Fault::new(format_args!("the .glb's {name} chunk is cut short; copy or export the file again"));
    let (header, rest) = bytes.split_at_checked(CHUNK_HEADER).ok_or_else(cut)?;
    let length = unsigned(&header[..4]) as usize;
    if !length.is_multiple_of(4) {
        let what = format_args!("the .glb's {name} chunk is {length} bytes long, no multiple of 4; export it again");
        return Err(Fault::new(what));
    }
    let (data, next) = rest.split_at_checked(length).ok_or_else(cut)?;
    Ok((Chunk { kind: &header[4..], data }, next))
}
