//! What decoders make of compressed data: buffers, views and accessors that the file does not have, and that are read
//! like its own.

use gltf::json::accessor::{Accessor, ComponentType, GenericComponentType, Type};
use gltf::json::buffer::{Buffer, View};
use gltf::json::validation::Checked::Valid;
use gltf::json::validation::USize64;
use gltf::json::{Index, Root};

use super::Fault;
use super::buffers::{self, Bytes};

/// A few bytes can be decoded to any number of the same. So all decoded data together gets this many times the bytes
/// of all buffers: twice what Draco makes of a smooth surface.
const EXPANSION: u64 = 64;
/// And so many bytes more, for files that are small because they are regular: two million flat triangles.
const EXPANSION_FLOOR: u64 = 64 << 20;

/// What the elements of a decoded view are.
pub struct Format {
    pub component: ComponentType,
    pub kind: Type,
    pub count: usize,
}

/// A document and its buffers, to which decoders add.
pub struct Decoded<'d, 'a> {
    pub root: &'d mut Root,
    pub buffers: &'d mut Vec<Bytes<'a>>,
    /// Bytes that may still be added.
    left: u64,
    /// How many buffers and views the file itself has: no others may be named in it.
    own: [usize; 2],
}

impl<'d, 'a> Decoded<'d, 'a> {
    pub fn new(root: &'d mut Root, buffers: &'d mut Vec<Bytes<'a>>) -> Self {
        let left = buffers::weight(buffers).saturating_mul(EXPANSION).saturating_add(EXPANSION_FLOOR);
        let own = [buffers.len(), root.buffer_views.len()];
        Self { root, buffers, left, own }
    }

    /// The bytes of one of the file's own buffers.
    pub fn own_buffer(&self, index: usize) -> Option<&[u8]> {
        self.buffers[..self.own[0]].get(index).map(|bytes| &**bytes)
    }

    /// What one of the file's own views shows.
    pub fn own_view(&self, index: usize) -> Option<&[u8]> {
        (index < self.own[1]).then(|| buffers::view(self.root, self.buffers, index)).flatten()
    }

    /// How many bytes may still be added.
    pub fn left(&self) -> u64 {
        self.left
    }

    /// Asks for room for so many more bytes, before any memory is taken for them.
    pub fn reserve(&mut self, bytes: u64) -> Result<(), Fault> {
        self.left = self.left.checked_sub(bytes).ok_or_else(over)?;
        Ok(())
    }

    /// Adds a buffer, for which there is room.
    pub fn buffer(&mut self, bytes: Vec<u8>) -> Index<Buffer> {
        let (byte_length, extras) = (USize64::from(bytes.len()), Default::default());
        self.buffers.push(Bytes::Decoded(bytes));
        Index::push(&mut self.root.buffers, Buffer { byte_length, name: None, uri: None, extensions: None, extras })
    }

    /// Adds a view of the whole of a buffer that is added with it.
    pub fn view(&mut self, bytes: Vec<u8>) -> Index<View> {
        let (byte_length, buffer) = (USize64::from(bytes.len()), self.buffer(bytes));
        let view = View {
            buffer,
            byte_length,
            byte_offset: None,
            byte_stride: None,
            name: None,
            target: None,
            extensions: None,
            extras: Default::default(),
        };
        Index::push(&mut self.root.buffer_views, view)
    }

    /// Adds an accessor of elements that fill a view.
    pub fn accessor(&mut self, view: Index<View>, format: &Format, normalized: bool) -> Index<Accessor> {
        let accessor = Accessor {
            buffer_view: Some(view),
            byte_offset: None,
            count: USize64::from(format.count),
            component_type: Valid(GenericComponentType(format.component)),
            type_: Valid(format.kind),
            normalized,
            min: None,
            max: None,
            name: None,
            sparse: None,
            extensions: None,
            extras: Default::default(),
        };
        Index::push(&mut self.root.accessors, accessor)
    }
}

/// What is said where decoded data would take too much memory.
pub fn over() -> Fault {
    Fault::new(format_args!(
        "its compressed data claims to be more than {EXPANSION} times as long as the file; check it, or take the \
         compression out: gltf-transform copy IN.glb OUT.glb"
    ))
}
