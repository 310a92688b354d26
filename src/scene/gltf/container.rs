//! The .glb container.

use gltf::json::Root;

use super::Fault;
use super::json::parse_json;

/// Bytes of a chunk before its data: its length and its type.
const CHUNK_HEADER: usize = 8;
/// Bytes of a .glb before its first chunk.
const GLB_HEADER: usize = 12;

/// The parts of a file. All values have the right types; nothing else is known about them.
pub struct Document<'a> {
    pub root: Root,
    /// The buffer within a .glb.
    pub binary: Option<&'a [u8]>,
}

/// Splits a .glb or .gltf file into its parts; which of the two it is, its first bytes tell.
pub fn parse(bytes: &[u8]) -> Result<Document<'_>, Fault> {
    if bytes.is_empty() {
        return Err(Fault::new("the file is empty; give a .gltf or .glb file"));
    }
    let (json, binary) = if bytes.starts_with(b"glTF") { split_glb(bytes)? } else { (bytes, None) };
    Ok(Document { root: parse_json(json)?, binary })
}

/// The JSON and, where there is one, the binary chunk.
fn split_glb(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), Fault> {
    let short = |needed: u64| {
        let have = bytes.len();
        Fault::new(format_args!("the .glb is cut short ({have} bytes of {needed}); copy or export it again"))
    };
    let header = bytes.get(..GLB_HEADER).ok_or_else(|| short(GLB_HEADER as u64))?;
    let version = le_u32(&header[4..8]);
    if version != 2 {
        return Err(Fault::new(format_args!("the .glb is of version {version}; export it as glTF 2.0")));
    }
    let length = le_u32(&header[8..12]);
    let body = bytes.get(GLB_HEADER..length as usize).ok_or_else(|| match (length as usize) < GLB_HEADER {
        true => Fault::new(format_args!("the .glb says that it is {length} bytes long; export it again")),
        false => short(length.into()),
    })?;
    let (json, rest) = split_chunk(body, b"JSON")?;
    // Chunks of other kinds may follow; readers are to skip them.
    let binary = if rest.is_empty() { None } else { Some(split_chunk(rest, b"BIN\0")?.0) };
    Ok((json, binary))
}

/// The data of the first chunk, which must be of `kind`, and what follows it.
fn split_chunk<'a>(bytes: &'a [u8], kind: &[u8; 4]) -> Result<(&'a [u8], &'a [u8]), Fault> {
    let name = String::from_utf8_lossy(kind.strip_suffix(b"\0").unwrap_or(kind));
    let cut = || Fault::new(format_args!("the .glb's {name} chunk is cut short; copy or export the file again"));
    let header = bytes.get(..CHUNK_HEADER).ok_or_else(cut)?;
    if header[4..] != kind[..] {
        let found = header[4..].escape_ascii();
        let what = format_args!("the .glb holds a chunk '{found}' in the {name} chunk's place; export it again");
        return Err(Fault::new(what));
    }
    let length = le_u32(&header[..4]) as usize;
    if !length.is_multiple_of(4) {
        let what = format_args!("the .glb's {name} chunk is {length} bytes long, no multiple of 4; export it again");
        return Err(Fault::new(what));
    }
    bytes[CHUNK_HEADER..].split_at_checked(length).ok_or_else(cut)
}

fn le_u32(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |value, &byte| value << 8 | u32::from(byte))
}
