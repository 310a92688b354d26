//! Typed reading of accessors, every range checked.

use std::rc::Rc;

use glam::Vec3;
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::validation::Checked::Valid;
use gltf::json::{self, Root};

use super::Fault;
use crate::scene::error::label;

/// The accessors of a file with what they read: known to lie within their views, and these within their buffers.
pub struct Accessors<'a> {
    pub root: &'a Root,
    buffers: &'a [Rc<[u8]>],
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
    /// `buffers` are as long as the root's say.
    pub fn new(root: &'a Root, buffers: &'a [Rc<[u8]>]) -> Result<Self, Fault> {
        let accessors = Self { root, buffers };
        accessors.check_views()?;
        (0..root.accessors.len()).try_for_each(|index| accessors.layout(index).map(|_| ()))?;
        Ok(accessors)
    }

    fn check_views(&self) -> Result<(), Fault> {
        for (index, view) in self.root.buffer_views.iter().enumerate() {
            let place = || label("bufferView", index, view.name.as_deref());
            let wrong = |what: String| Fault::at(place(), format_args!("{what}; export the file again"));
            let length = self.root.buffers[view.buffer.value()].byte_length.0;
            let (offset, bytes) = (view.byte_offset.unwrap_or_default().0, view.byte_length.0);
            if bytes == 0 || offset.checked_add(bytes).is_none_or(|end| end > length) {
                let what = format!("{bytes} bytes from {offset} do not lie in buffer {}'s {length}", view.buffer);
                return Err(wrong(what));
            }
            if let Some(stride) = view.byte_stride.map(|stride| stride.0)
                && !((4..=252).contains(&stride) && stride.is_multiple_of(4))
            {
                return Err(wrong(format!("byteStride {stride} is no multiple of 4 from 4 to 252")));
            }
        }
        Ok(())
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

    /// The bytes of all buffers; those of one file behind several count once.
    pub fn bytes(&self) -> u64 {
        let mut parts: Vec<(*const u8, usize)> = self.buffers.iter().map(|part| (part.as_ptr(), part.len())).collect();
        parts.sort_unstable();
        parts.dedup();
        parts.iter().map(|&(_, length)| length as u64).sum()
    }

    /// How many elements can be read.
    pub fn count(&self, index: usize) -> Result<usize, Fault> {
        Ok(self.elements(index)?.count)
    }

    fn expect(&self, index: usize, components: &[ComponentType], kind: Type) -> Result<&'a json::Accessor, Fault> {
        let accessor = &self.root.accessors[index];
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
        let name = self.root.accessors[index].name.as_deref();
        Fault::at(label("accessor", index, name), "its type or componentType is none of glTF's; export the file again")
    }

    /// The bytes of a view, which lie in its buffer.
    fn view(&self, index: usize) -> &'a [u8] {
        let view = &self.root.buffer_views[index];
        // No more than the buffer's length, which is that of bytes in memory.
        let [start, length] = [view.byte_offset.unwrap_or_default(), view.byte_length].map(|bytes| bytes.0 as usize);
        &self.buffers[view.buffer.value()][start..][..length]
    }

    /// The elements, all there.
    fn elements(&self, index: usize) -> Result<Elements<'a>, Fault> {
        let accessor = &self.root.accessors[index];
        let place = || label("accessor", index, accessor.name.as_deref());
        if accessor.sparse.is_some() {
            return Err(Fault::at(place(), "is sparse, which is not served; export the file without sparse accessors"));
        }
        let view = accessor.buffer_view.map(|view| self.view(view.value()));
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
        let accessor = &self.root.accessors[index];
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
        let view = &self.root.buffer_views[view_index.value()];
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
