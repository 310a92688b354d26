//! Typed reading of accessors, every range checked.

use glam::Vec3;
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::validation::Checked::Valid;
use gltf::json::{self, Root};

use super::Fault;
use super::buffers::{self, Bytes};
use crate::scene::error::label;

/// The accessors of a file with what they read.
pub struct Accessors<'a> {
    pub root: &'a Root,
    pub buffers: &'a [Bytes<'a>],
}

/// The layout of an accessor's elements within its view, in bytes.
struct Layout {
    offset: u64,
    stride: u64,
    element: u64,
    count: u64,
}

/// What an accessor reads.
struct Elements<'a> {
    bytes: &'a [u8],
    stride: usize,
    size: usize,
    count: usize,
}

impl<'a> Elements<'a> {
    fn get(&self, at: usize) -> &'a [u8] {
        &self.bytes[at * self.stride..][..self.size]
    }
}

impl<'a> Accessors<'a> {
    /// Checks the layout of every accessor, read or not, against its view, and every view against its buffer.
    pub fn check(&self) -> Result<(), Fault> {
        for (index, view) in self.root.buffer_views.iter().enumerate() {
            let place = || label("bufferView", index, view.name.as_deref());
            let wrong = |what: String| Fault::at(place(), format_args!("{what}; export the file again"));
            let buffer = self.root.buffers.get(view.buffer.value());
            let length = buffer.ok_or_else(|| wrong(format!("there is no buffer {}", view.buffer)))?.byte_length.0;
            let (offset, bytes) = (view.byte_offset.unwrap_or_default().0, view.byte_length.0);
            if bytes == 0 || offset.checked_add(bytes).is_none_or(|end| end > length) {
                let what = format!("{bytes} bytes from {offset} do not lie in buffer {}'s {length}", view.buffer);
                return Err(wrong(what));
            }
            if let Some(stride) = view.byte_stride.map(|stride| stride.0)
                && !(4..=252).contains(&stride) | !stride.is_multiple_of(4)
            {
                return Err(wrong(format!("byteStride {stride} is no multiple of 4 from 4 to 252")));
            }
        }
        (0..self.root.accessors.len()).try_for_each(|index| self.layout(index).map(|_| ()))
    }

    /// The positions, or other triples of finite floats, of an accessor: those `used`, or all.
    pub fn vectors(&self, index: usize, used: Option<&[u32]>) -> Result<Vec<Vec3>, Fault> {
        let accessor = self.expect(index, &[ComponentType::F32], Type::Vec3)?;
        let elements = self.elements(index)?;
        let read = |at: usize| {
            let bytes = elements.get(at);
            let float = |at: usize| f32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]);
            let vector = Vec3::new(float(0), float(4), float(8));
            let what = format_args!("element {at} is {vector}; give finite numbers");
            let wrong = || Fault::at(label("accessor", index, accessor.name.as_deref()), what);
            vector.is_finite().then_some(vector).ok_or_else(wrong)
        };
        match used {
            None => (0..elements.count).map(read).collect(),
            Some(used) => used.iter().map(|&at| read(at as usize)).collect(),
        }
    }

    /// The indices of an accessor, widened to 32 bits.
    pub fn indices(&self, index: usize) -> Result<Vec<u32>, Fault> {
        self.expect(index, &[ComponentType::U8, ComponentType::U16, ComponentType::U32], Type::Scalar)?;
        let elements = self.elements(index)?;
        let read = |bytes: &[u8]| bytes.iter().rev().fold(0, |value, &byte| value << 8 | u32::from(byte));
        Ok((0..elements.count).map(|at| read(elements.get(at))).collect())
    }

    /// How many elements can be read.
    pub fn count(&self, index: usize) -> Result<usize, Fault> {
        Ok(self.elements(index)?.count)
    }

    fn get(&self, index: usize) -> Result<&'a json::Accessor, Fault> {
        let missing = || Fault::new(format_args!("there is no accessor {index}; export the file again"));
        self.root.accessors.get(index).ok_or_else(missing)
    }

    fn expect(&self, index: usize, components: &[ComponentType], kind: Type) -> Result<&'a json::Accessor, Fault> {
        let accessor = self.get(index)?;
        let Valid(component) = accessor.component_type else { return Err(self.unknown_type(index)) };
        if accessor.type_ == Valid(kind) && components.contains(&component.0) {
            return Ok(accessor);
        }
        let names: Vec<String> = components.iter().map(|component| component.as_gl_enum().to_string()).collect();
        let names = names.join(", ");
        let what = format_args!("must be {kind:?} of component type {names}; export the file without quantization");
        Err(Fault::at(label("accessor", index, accessor.name.as_deref()), what))
    }

    fn unknown_type(&self, index: usize) -> Fault {
        let name = self.root.accessors.get(index).and_then(|accessor| accessor.name.as_deref());
        Fault::at(label("accessor", index, name), "its type or componentType is none of glTF's; export the file again")
    }

    /// The elements, all there.
    fn elements(&self, index: usize) -> Result<Elements<'a>, Fault> {
        let accessor = self.get(index)?;
        let place = || label("accessor", index, accessor.name.as_deref());
        if accessor.sparse.is_some() {
            return Err(Fault::at(place(), "is sparse, which is not served; export the file without sparse accessors"));
        }
        let view = accessor.buffer_view.and_then(|view| buffers::view(self.root, self.buffers, view.value()));
        let (Some(bytes), Some(layout)) = (view, self.layout(index)?) else {
            let what = "has no bufferView (a compressed mesh perhaps); export the file without compression";
            return Err(Fault::at(place(), what));
        };
        // No more than the view's length, which is that of bytes in memory.
        let [count, offset, stride, size] =
            [layout.count, layout.offset, layout.stride, layout.element].map(|bytes| bytes as usize);
        Ok(Elements { bytes: &bytes[offset..], stride, size, count })
    }

    /// Where the elements lie, none where there is no view. They lie within the view.
    fn layout(&self, index: usize) -> Result<Option<Layout>, Fault> {
        let accessor = self.get(index)?;
        let wrong = |what: String| {
            Fault::at(label("accessor", index, accessor.name.as_deref()), format_args!("{what}; export the file again"))
        };
        let (Valid(component), Valid(kind)) = (accessor.component_type, accessor.type_) else {
            return Err(self.unknown_type(index));
        };
        let count = accessor.count.0;
        if count == 0 {
            return Err(wrong("count is 0".to_owned()));
        }
        let Some(view_index) = accessor.buffer_view else { return Ok(None) };
        let view = self.root.buffer_views.get(view_index.value());
        let view = view.ok_or_else(|| wrong(format!("there is no bufferView {view_index}")))?;
        let element = (component.0.size() * kind.multiplicity()) as u64;
        let stride = view.byte_stride.map_or(element, |stride| stride.0 as u64);
        let offset = accessor.byte_offset.unwrap_or_default().0;
        if stride < element {
            return Err(wrong(format!("byteStride {stride} is less than its elements' {element} bytes")));
        }
        let end = (count - 1).checked_mul(stride).and_then(|start| start.checked_add(offset)?.checked_add(element));
        if end.is_none_or(|end| end > view.byte_length.0) {
            let length = view.byte_length.0;
            let what = format!("{count} elements from {offset} do not lie in bufferView {view_index}'s {length} bytes");
            return Err(wrong(what));
        }
        Ok(Some(Layout { offset, stride, element, count }))
    }
}
