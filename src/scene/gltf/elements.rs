//! The elements that an accessor reads, wherever their bytes are.

use gltf::json::accessor::ComponentType;

/// As large as the largest element: a matrix of 4 x 4 floats.
const ZEROS: [u8; 64] = [0; 64];

/// Elements that are known to lie within their buffers.
pub struct Elements<'a> {
    /// From the first element on; `None` where all elements but those of `sparse` are zero.
    pub bytes: Option<&'a [u8]>,
    pub stride: usize,
    pub size: usize,
    pub count: usize,
    pub sparse: Option<Sparse<'a>>,
}

impl<'a> Elements<'a> {
    /// The bytes of element `at`, which is less than `count`.
    pub fn get(&self, at: usize) -> &'a [u8] {
        match (self.sparse.as_ref().and_then(|sparse| sparse.find(at)), self.bytes) {
            (Some(place), _) => &place[..self.size],
            (None, Some(bytes)) => &bytes[at * self.stride..][..self.size],
            (None, None) => &ZEROS[..self.size],
        }
    }
}

/// Elements that replace others.
pub struct Sparse<'a> {
    /// The indices of the elements that are replaced, `width` bytes each.
    pub indices: &'a [u8],
    pub width: usize,
    /// What replaces them, `size` bytes each.
    pub values: &'a [u8],
    pub size: usize,
}

impl<'a> Sparse<'a> {
    /// What replaces an element, if anything does.
    fn find(&self, element: usize) -> Option<&'a [u8]> {
        let (mut low, mut high) = (0, self.count());
        while low < high {
            let middle = low.midpoint(high);
            if self.index(middle) < element { low = middle + 1 } else { high = middle }
        }
        (low < self.count() && self.index(low) == element).then(|| &self.values[low * self.size..])
    }

    fn count(&self) -> usize {
        self.indices.len() / self.width
    }

    fn index(&self, at: usize) -> usize {
        unsigned(&self.indices[at * self.width..][..self.width]) as usize
    }

    /// The first index that is not greater than the one before it, or not below `count`: its position, and the index
    /// itself.
    pub fn first_bad(&self, count: u64) -> Option<(usize, usize)> {
        let is_bad = |&at: &usize| {
            self.index(at) as u64 >= count
                || at.checked_sub(1).is_some_and(|before| self.index(before) >= self.index(at))
        };
        (0..self.count()).find(is_bad).map(|at| (at, self.index(at)))
    }
}

/// An integer of up to four bytes, the least significant first.
pub fn unsigned(bytes: &[u8]) -> u32 {
    integer(bytes) as u32
}

/// An integer of up to eight bytes, the least significant first.
pub fn integer(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |value, &byte| value << 8 | u64::from(byte))
}

/// The function that makes a number of a component's bytes. Normalized integers span [0, 1] or [-1, 1] (glTF 2.0,
/// section 3.6.2.2, and KHR_mesh_quantization).
pub fn decoder(component: ComponentType, is_normalized: bool) -> fn(&[u8]) -> f32 {
    match (component, is_normalized) {
        (ComponentType::I8, false) => |bytes| f32::from(bytes[0].cast_signed()),
        (ComponentType::I8, true) => |bytes| (f32::from(bytes[0].cast_signed()) / 127.0).max(-1.0),
        (ComponentType::U8, false) => |bytes| f32::from(bytes[0]),
        (ComponentType::U8, true) => |bytes| f32::from(bytes[0]) / 255.0,
        (ComponentType::I16, false) => |bytes| f32::from(i16::from_le_bytes([bytes[0], bytes[1]])),
        (ComponentType::I16, true) => |bytes| (f32::from(i16::from_le_bytes([bytes[0], bytes[1]])) / 32767.0).max(-1.0),
        (ComponentType::U16, false) => |bytes| f32::from(u16::from_le_bytes([bytes[0], bytes[1]])),
        (ComponentType::U16, true) => |bytes| f32::from(u16::from_le_bytes([bytes[0], bytes[1]])) / 65535.0,
        (ComponentType::U32, _) => |bytes| unsigned(&bytes[..4]) as f32,
        (ComponentType::F32, _) => |bytes| f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]),
    }
}
