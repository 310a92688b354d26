//! EXT_meshopt_compression and KHR_meshopt_compression: views whose bytes are decoded from those of other buffers.

use draco_gltf::{GltfError, MeshoptFilter, MeshoptMode, meshopt};
use serde::Deserialize;

use super::decoded::Decoded;
use super::material_extensions::object;
use super::{Fault, cut, extensions};
use crate::scene::error::label;

/// The extension as a view's JSON holds it.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Stream {
    buffer: usize,
    #[serde(default)]
    byte_offset: usize,
    byte_length: usize,
    byte_stride: usize,
    count: usize,
    mode: String,
    filter: Option<String>,
}

/// Decodes every view that is compressed, and makes it show what was decoded.
pub fn decode(decoded: &mut Decoded) -> Result<(), Fault> {
    for index in 0..decoded.root.buffer_views.len() {
        let view = &decoded.root.buffer_views[index];
        let Some((name, value)) = view.extensions.as_ref().and_then(|found| extensions::codec(&found.others)) else {
            continue;
        };
        let (place, length) = (label("bufferView", index, view.name.as_deref()), view.byte_length.0);
        let stream: Result<Stream, _> = object(name, value).map_err(Fault::new);
        let bytes =
            stream.and_then(|stream| stream.decode(decoded, length)).map_err(|fault| Fault::at(place, fault))?;
        let buffer = decoded.buffer(bytes);
        let view = &mut decoded.root.buffer_views[index];
        (view.buffer, view.byte_offset, view.extensions) = (buffer, None, None);
    }
    Ok(())
}

impl Stream {
    /// The bytes of the view, of which it says that there are `length`.
    fn decode(&self, decoded: &mut Decoded, length: u64) -> Result<Vec<u8>, Fault> {
        let (stride, count) = (self.byte_stride, self.count);
        if length == 0 || (count as u64).checked_mul(stride as u64) != Some(length) {
            let what = format_args!("{count} elements of {stride} bytes are not the {length} bytes of the view");
            return Err(Fault::new(format_args!("{what}; export the file again")));
        }
        decoded.reserve(length)?;
        let bytes = decoded
            .own_buffer(self.buffer)
            .and_then(|bytes| bytes.get(self.byte_offset..self.byte_offset.checked_add(self.byte_length)?));
        let bytes = bytes.ok_or_else(|| {
            let what = format_args!("{} bytes from {} do not lie in", self.byte_length, self.byte_offset);
            Fault::new(format_args!("its compressed data, {what} buffer {}; export the file again", self.buffer))
        })?;
        let mut made = vec![0; count * stride];
        let mode = MeshoptMode::from_name(&self.mode).map_err(broken)?;
        let filter =
            self.filter.as_deref().map_or(Ok(MeshoptFilter::None), MeshoptFilter::from_name).map_err(broken)?;
        meshopt::decode_buffer_view(&mut made, bytes, mode, filter, count, stride).map_err(broken)?;
        Ok(made)
    }
}

fn broken(error: GltfError) -> Fault {
    // The decoder names the one extension, whichever it is.
    let said = error.to_string();
    let said = said.rsplit("EXT_meshopt_compression: ").next().map(cut).unwrap_or_default();
    Fault::new(format_args!("its compressed data is broken ({said}); copy or export the file again"))
}
