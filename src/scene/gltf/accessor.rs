//! Accessors read as typed values, with every range checked.

use gltf::json::accessor::{ComponentType, Type};
use gltf::json::validation::Checked::Valid;
use gltf::json::{self, Root};

use super::Fault;
use super::buffers::{self, Bytes};
use super::elements::{Elements, Sparse, decoder, unsigned};
use crate::scene::error::label;

/// Accessors may share the indices of their sparse elements, and each index is looked at. So many times the bytes of
/// all buffers may be looked at in all; accessors that share nothing need less than once.
const SPARSE_SHARING: u64 = 16;

/// The accessors of a file, with the bytes that they read.
pub struct Accessors<'a> {
    pub root: &'a Root,
    pub buffers: &'a [Bytes<'a>],
}

/// Which types of components are accepted for numbers of a kind. Floats are, unless it says otherwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Numbers {
    /// Only floats.
    Floats,
    /// Integers of 8 or 16 bits, as they are or, where the accessor says so, normalized.
    Quantized,
    /// Signed integers of 8 or 16 bits, normalized.
    Signed,
    /// Unsigned integers of 8 or 16 bits, normalized.
    Unsigned,
    /// Unsigned integers of 8 or 16 bits, as they are, and no floats.
    Indices,
}

impl Numbers {
    fn components(self) -> &'static [ComponentType] {
        use ComponentType::{F32, I8, I16, U8, U16};
        match self {
            Self::Floats => &[F32],
            Self::Quantized => &[F32, I8, U8, I16, U16],
            Self::Signed => &[F32, I8, I16],
            Self::Unsigned => &[F32, U8, U16],
            Self::Indices => &[U8, U16],
        }
    }
}

/// The layout of an accessor's elements within its view, in bytes.
struct Layout {
    offset: u64,
    stride: u64,
}

impl<'a> Accessors<'a> {
    /// Checks the layout of every accessor against its view, whether it is read or not, and every view against its
    /// buffer.
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
        let mut budget = buffers::weight(self.buffers).saturating_mul(SPARSE_SHARING);
        (0..self.root.accessors.len()).try_for_each(|index| {
            self.layout(index)?;
            self.check_sparse(index, &mut budget)
        })
    }

    /// Checks that the sparse indices of an accessor increase and that it has the elements of these indices.
    fn check_sparse(&self, index: usize, budget: &mut u64) -> Result<(), Fault> {
        let accessor = self.get(index)?;
        let Some(sparse) = self.sparse(index)? else { return Ok(()) };
        let wrong = |what: String| Fault::at(label("accessor", index, accessor.name.as_deref()), what);
        let over = || wrong("too many accessors share the same sparse indices; export the file again".to_owned());
        *budget = budget.checked_sub((sparse.indices.len() / sparse.width) as u64).ok_or_else(over)?;
        match sparse.first_bad(accessor.count.0) {
            None => Ok(()),
            Some((at, element)) => {
                let what = "its sparse indices must increase and be less than its count; export the file again";
                Err(wrong(format!("sparse index {at} is {element}; {what}")))
            }
        }
    }

    /// `N` finite numbers for each element, of those in `used` or of all.
    pub fn read<T: From<[f32; N]>, const N: usize>(
        &self,
        index: usize,
        kind: Type,
        numbers: Numbers,
        used: Option<&[u32]>,
    ) -> Result<Vec<T>, Fault> {
        let (accessor, component) = self.expect(index, numbers.components(), kind)?;
        let elements = self.elements(index)?;
        let is_normalized = match numbers {
            Numbers::Signed | Numbers::Unsigned => true,
            Numbers::Floats | Numbers::Quantized => accessor.normalized,
            Numbers::Indices => false,
        };
        let (decode, width) = (decoder(component, is_normalized), component.size());
        let read = |at: usize| {
            let bytes = elements.get(at);
            let vector: [f32; N] = std::array::from_fn(|part| decode(&bytes[part * width..]));
            if vector.iter().all(|number| number.is_finite()) {
                return Ok(T::from(vector));
            }
            let what = format_args!("element {at} is {vector:?}; give finite numbers");
            Err(Fault::at(label("accessor", index, accessor.name.as_deref()), what))
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
        Ok((0..elements.count).map(|at| unsigned(elements.get(at))).collect())
    }

    /// How many elements can be read: as many as the file says, which without a view may be far more than it has bytes.
    pub fn count(&self, index: usize) -> Result<usize, Fault> {
        Ok(self.elements(index)?.count)
    }

    /// Whether there is data to be read: else all elements are zero.
    pub fn has_data(&self, index: usize) -> bool {
        self.root
            .accessors
            .get(index)
            .is_some_and(|accessor| accessor.buffer_view.is_some() || accessor.sparse.is_some())
    }

    /// Whether elements are of a type.
    pub fn is_of(&self, index: usize, kind: Type) -> bool {
        self.root.accessors.get(index).is_some_and(|accessor| accessor.type_ == Valid(kind))
    }

    fn get(&self, index: usize) -> Result<&'a json::Accessor, Fault> {
        let missing = || Fault::new(format_args!("there is no accessor {index}; export the file again"));
        self.root.accessors.get(index).ok_or_else(missing)
    }

    fn expect(
        &self,
        index: usize,
        components: &[ComponentType],
        kind: Type,
    ) -> Result<(&'a json::Accessor, ComponentType), Fault> {
        let accessor = self.get(index)?;
        let Valid(component) = accessor.component_type else { return Err(self.unknown_type(index)) };
        if accessor.type_ == Valid(kind) && components.contains(&component.0) {
            return Ok((accessor, component.0));
        }
        let names: Vec<String> = components.iter().map(|component| component.as_gl_enum().to_string()).collect();
        let names = names.join(", ");
        let what = format_args!("must be {kind:?} of component type {names}; export the file again");
        Err(Fault::at(label("accessor", index, accessor.name.as_deref()), what))
    }

    fn unknown_type(&self, index: usize) -> Fault {
        let name = self.root.accessors.get(index).and_then(|accessor| accessor.name.as_deref());
        Fault::at(label("accessor", index, name), "its type or componentType is none of glTF's; export the file again")
    }

    /// The elements; those that no view holds are zero (glTF 2.0, section 5.1.1).
    fn elements(&self, index: usize) -> Result<Elements<'a>, Fault> {
        let accessor = self.get(index)?;
        let size = self.size(index)?;
        let count = usize::try_from(accessor.count.0).unwrap_or(usize::MAX);
        let sparse = self.sparse(index)?;
        let Some(Layout { offset, stride }) = self.layout(index)? else {
            return Ok(Elements { bytes: None, stride: 0, size, count, sparse });
        };
        // Neither is more than the view's length, and that many bytes are in memory.
        let [offset, stride] = [offset, stride].map(|bytes| bytes as usize);
        let view = accessor.buffer_view.and_then(|view| buffers::view(self.root, self.buffers, view.value()));
        Ok(Elements { bytes: view.map(|bytes| &bytes[offset..]), stride, size, count, sparse })
    }

    /// The bytes of one element.
    fn size(&self, index: usize) -> Result<usize, Fault> {
        let accessor = self.get(index)?;
        match (accessor.component_type, accessor.type_) {
            (Valid(component), Valid(kind)) => Ok(component.0.size() * kind.multiplicity()),
            _ => Err(self.unknown_type(index)),
        }
    }

    /// Where the elements lie, which is within the view; `None` where there is no view.
    fn layout(&self, index: usize) -> Result<Option<Layout>, Fault> {
        let accessor = self.get(index)?;
        let wrong = |what: String| {
            Fault::at(label("accessor", index, accessor.name.as_deref()), format_args!("{what}; export the file again"))
        };
        let element = self.size(index)? as u64;
        let count = accessor.count.0;
        if count == 0 {
            return Err(wrong("count is 0".to_owned()));
        }
        let Some(view_index) = accessor.buffer_view else { return Ok(None) };
        let view = self.root.buffer_views.get(view_index.value());
        let view = view.ok_or_else(|| wrong(format!("there is no bufferView {view_index}")))?;
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
        Ok(Some(Layout { offset, stride }))
    }

    /// The elements of an accessor that replace others; they lie within their views.
    fn sparse(&self, index: usize) -> Result<Option<Sparse<'a>>, Fault> {
        let accessor = self.get(index)?;
        let Some(sparse) = &accessor.sparse else { return Ok(None) };
        let wrong = |what: String| {
            let what = format_args!("sparse: {what}; export the file again");
            Fault::at(label("accessor", index, accessor.name.as_deref()), what)
        };
        let count = sparse.count.0;
        if count == 0 || count > accessor.count.0 {
            return Err(wrong(format!("count is {count}, of {} elements", accessor.count.0)));
        }
        let Valid(json::accessor::IndexComponentType(component)) = sparse.indices.component_type else {
            return Err(wrong("componentType is none that indices have".to_owned()));
        };
        let part = |view: usize, offset: u64, element: usize| {
            let bytes = buffers::view(self.root, self.buffers, view);
            let bytes = bytes.ok_or_else(|| wrong(format!("there is no bufferView {view}")))?;
            let range = usize::try_from(offset)
                .ok()
                .zip(usize::try_from(count).ok().and_then(|count| count.checked_mul(element)));
            let part = range.and_then(|(offset, length)| bytes.get(offset..offset.checked_add(length)?));
            part.ok_or_else(|| wrong(format!("{count} elements do not lie in bufferView {view}")))
        };
        let size = self.size(index)?;
        let indices = part(sparse.indices.buffer_view.value(), sparse.indices.byte_offset.0, component.size())?;
        let values = part(sparse.values.buffer_view.value(), sparse.values.byte_offset.0, size)?;
        Ok(Some(Sparse { indices, width: component.size(), values, size }))
    }
}
