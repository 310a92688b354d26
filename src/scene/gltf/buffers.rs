//! The bytes that accessors point into: within the file, beside it, or spelled out in a data URI.

use std::collections::{BTreeSet, HashMap};
use std::fs::File;
use std::io::Read;
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use gltf::json;

use super::container::Document;
use super::{Fault, extensions, uri};
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
    buffers.chain(images).filter_map(|uri| uri::path(uri, folder).ok()).collect()
}

/// The bytes that a URI stands for: a file in `folder`, read only once, or the data in the URI itself.
pub fn fetch(uri: &str, folder: Option<&Path>, files: &mut Files) -> Result<Rc<Vec<u8>>, Fault> {
    if let Some(data) = uri::data(uri)? {
        return Ok(Rc::new(data));
    }
    let path = uri::path(uri, folder)?;
    let identity = path.canonicalize().unwrap_or_else(|_| path.clone());
    if let Some(bytes) = files.get(&identity) {
        return Ok(Rc::clone(bytes));
    }
    let bytes = Rc::new(read_file(&path).map_err(|fault| Fault::at(path.display(), fault))?);
    files.insert(identity, Rc::clone(&bytes));
    Ok(bytes)
}

/// The part of its buffer that a view shows; `None` where there is no such part.
pub fn view<'a>(root: &json::Root, buffers: &'a [Bytes], index: usize) -> Option<&'a [u8]> {
    let view = root.buffer_views.get(index)?;
    let start = usize::try_from(view.byte_offset.unwrap_or_default().0).ok()?;
    let length = usize::try_from(view.byte_length.0).ok()?;
    buffers.get(view.buffer.value())?.get(start..start.checked_add(length)?)
}
