//! The bytes that accessors point into: within the file, beside it, or spelled out in a data URI.

use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap};
use std::fs::File;
use std::io::Read;
use std::ops::Deref;
use std::path::{Component, Path, PathBuf};
use std::rc::Rc;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use gltf::json;
use percent_encoding::percent_decode_str;

use super::Fault;
use super::container::Document;
use super::extensions;
use crate::scene::error::label;

/// The most bytes that are read from one file: the greatest length that a .glb can state.
const FILE_BYTES_MAX: u64 = u32::MAX as u64;

/// The most bytes of memory that are reserved on the file system's word alone.
const RESERVE_MAX: u64 = 1 << 28;

/// A buffer's bytes.
pub enum Bytes<'a> {
    /// In the .glb itself.
    Within(&'a [u8]),
    Read(Rc<Vec<u8>>),
    /// From what others hold.
    Decoded(Vec<u8>),
}

impl Deref for Bytes<'_> {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        match self {
            Self::Within(bytes) => bytes,
            Self::Read(bytes) => bytes,
            Self::Decoded(bytes) => bytes,
        }
    }
}

/// The files that have been read, by their paths.
pub type Files = HashMap<PathBuf, Rc<Vec<u8>>>;

/// Reads a file, which must be an ordinary one: not a folder, and nothing that never ends.
pub fn read_file(path: &Path) -> Result<Vec<u8>, Fault> {
    let unreadable = |error: std::io::Error| Fault::new(format_args!("can't be read ({error}); check the path"));
    let metadata = std::fs::metadata(path).map_err(unreadable)?;
    if metadata.is_dir() {
        return Err(Fault::new("is a folder; name a file"));
    }
    if !metadata.is_file() {
        return Err(Fault::new("is no ordinary file; name one"));
    }
    if metadata.len() > FILE_BYTES_MAX {
        let length = metadata.len();
        return Err(Fault::new(format_args!("{length} bytes long; files of up to {FILE_BYTES_MAX} are served")));
    }
    // What is said to be long need not be: some room is made at first, and more as bytes arrive.
    let mut bytes = Vec::with_capacity(metadata.len().min(RESERVE_MAX) as usize);
    File::open(path).and_then(|file| file.take(FILE_BYTES_MAX).read_to_end(&mut bytes)).map_err(unreadable)?;
    Ok(bytes)
}

/// The bytes of every buffer, each at least as long as the file says. External buffers are in `folder`; without it,
/// none are read.
pub fn load<'a>(document: &Document<'a>, folder: Option<&Path>) -> Result<Vec<Bytes<'a>>, Fault> {
    // Many buffers may name the same file: its bytes are held once.
    let mut files = Files::new();
    let mut buffers = Vec::with_capacity(document.root.buffers.len());
    let stand_ins = extensions::stand_ins(&document.root);
    for (index, buffer) in document.root.buffers.iter().enumerate() {
        if stand_ins[index] {
            buffers.push(Bytes::Within(&[]));
            continue;
        }
        let place = || label("buffer", index, buffer.name.as_deref());
        let bytes = match (&buffer.uri, document.binary) {
            (Some(uri), _) => Bytes::Read(fetch(uri, folder, &mut files).map_err(|fault| Fault::at(place(), fault))?),
            (None, Some(binary)) if index == 0 => Bytes::Within(binary),
            (None, _) => {
                let what = "has no uri, and the file holds no data for it; export the file again";
                return Err(Fault::at(place(), what));
            }
        };
        let (have, said) = (bytes.len() as u64, buffer.byte_length.0);
        if said == 0 || have < said {
            let what = format_args!("byteLength is {said}, and its data is {have} bytes long; export the file again");
            return Err(Fault::at(place(), what));
        }
        buffers.push(bytes);
    }
    Ok(buffers)
}

/// How many bytes buffers count for where memory is granted by them, whatever they claim to hold: a file's count once,
/// however many buffers name it, and an eighth of those that are decoded, to which memory has been granted already.
pub fn weight(buffers: &[Bytes]) -> u64 {
    let weigh = |bytes: &Bytes| bytes.len() as u64 / if matches!(bytes, Bytes::Decoded(_)) { 8 } else { 1 };
    let parts: HashMap<_, _> = buffers.iter().map(|bytes| (bytes.as_ptr(), weigh(bytes))).collect();
    parts.into_values().sum()
}

/// The files that the document's buffers and images name.
pub fn named_files(root: &json::Root, folder: Option<&Path>) -> BTreeSet<PathBuf> {
    let buffers = root.buffers.iter().filter_map(|buffer| buffer.uri.as_deref());
    let images = root.images.iter().filter_map(|image| image.uri.as_deref());
    let files = buffers.chain(images).filter(|uri| !uri.starts_with("data:"));
    files.filter_map(|uri| resolve(uri, folder).ok()).collect()
}

/// The bytes that a URI stands for: a file in `folder`, read only once, or the data in the URI itself.
pub fn fetch(uri: &str, folder: Option<&Path>, files: &mut Files) -> Result<Rc<Vec<u8>>, Fault> {
    if let Some(data) = uri.strip_prefix("data:") {
        return decode(data).map(Rc::new);
    }
    let path = resolve(uri, folder)?;
    let identity = path.canonicalize().unwrap_or_else(|_| path.clone());
    if let Some(bytes) = files.get(&identity) {
        return Ok(Rc::clone(bytes));
    }
    let bytes = Rc::new(read_file(&path).map_err(|fault| Fault::at(path.display(), fault))?);
    files.insert(identity, Rc::clone(&bytes));
    Ok(bytes)
}

/// The data of a data URI, which follows its media type.
fn decode(data: &str) -> Result<Vec<u8>, Fault> {
    let encoded = data.split_once(',').and_then(|(media, data)| media.ends_with(";base64").then_some(data));
    let encoded = encoded.ok_or_else(|| Fault::new("its data URI is not base64; export the file again"))?;
    let broken = |error| Fault::new(format_args!("its data URI is broken ({error}); export the file again"));
    STANDARD.decode(encoded).map_err(broken)
}

/// The path that a URI names, within the scene's folder: a scene must not reach other files of its user.
fn resolve(uri: &str, folder: Option<&Path>) -> Result<PathBuf, Fault> {
    let shown: String = uri.chars().take(200).collect();
    let refuse = |why: &str| Fault::new(format_args!("its URI '{shown}' {why}"));
    let folder = folder.ok_or_else(|| refuse("names a file, and this scene has no folder; give a .glb file"))?;
    if uri.split_once(':').is_some_and(|(scheme, _)| !scheme.contains('/')) {
        return Err(refuse("has a scheme; give a path relative to the scene's folder"));
    }
    let decoded: Cow<str> =
        percent_decode_str(uri).decode_utf8().map_err(|_| refuse("is not UTF-8; rename the file"))?;
    let path = Path::new(decoded.as_ref());
    let inside = |component| matches!(component, Component::Normal(_) | Component::CurDir);
    if decoded.is_empty() || decoded.contains('\0') || !path.components().all(inside) {
        return Err(refuse(
            "leads out of the scene's folder; put the file beside the scene and name it by a relative path",
        ));
    }
    Ok(folder.join(path))
}

/// The part of its buffer that a view shows; `None` where there is no such part.
pub fn view<'a>(root: &json::Root, buffers: &'a [Bytes], index: usize) -> Option<&'a [u8]> {
    let view = root.buffer_views.get(index)?;
    let start = usize::try_from(view.byte_offset.unwrap_or_default().0).ok()?;
    let length = usize::try_from(view.byte_length.0).ok()?;
    buffers.get(view.buffer.value())?.get(start..start.checked_add(length)?)
}
