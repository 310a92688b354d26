//! A buffer that is written when its contents change, and only then: what is not sent costs nothing, and drivers that
//! specialise shaders by what buffers hold have no cause to do so again.

use std::hash::{DefaultHasher, Hasher};

use wgpu::util::{BufferInitDescriptor, DeviceExt};
use wgpu::{BindingResource, Buffer, BufferUsages, Device, Queue};

/// A buffer and a hash of what it holds, which takes no memory however large the buffer is.
pub(super) struct TrackedBuffer {
    buffer: Buffer,
    hash: u64,
}

impl TrackedBuffer {
    /// A buffer with these contents, which are not empty, for this usage and for `write`.
    pub fn new(device: &Device, label: &str, contents: &[u8], usage: BufferUsages) -> Self {
        let usage = usage | BufferUsages::COPY_DST;
        let buffer = device.create_buffer_init(&BufferInitDescriptor { label: Some(label), contents, usage });
        Self { buffer, hash: hash(contents) }
    }

    /// Bytes that there is room for.
    pub fn size(&self) -> u64 {
        self.buffer.size()
    }

    pub fn binding(&self) -> BindingResource<'_> {
        self.buffer.as_entire_binding()
    }

    /// Sends the contents, for which there is room, unless they are what was sent last.
    pub fn write(&mut self, queue: &Queue, contents: &[u8]) {
        let hash = hash(contents);
        if hash != self.hash {
            queue.write_buffer(&self.buffer, 0, contents);
            self.hash = hash;
        }
    }
}

/// Two contents in 2^64 have the same one.
pub(super) fn hash(contents: &[u8]) -> u64 {
    let mut hasher = DefaultHasher::new();
    hasher.write(contents);
    hasher.finish()
}

#[cfg(test)]
mod tests {
    use super::super::device;
    use super::*;

    /// What is written behind its back stays until the contents change.
    #[test]
    fn only_what_changes_is_sent() {
        let gpu = pollster::block_on(device::open_offscreen(None)).expect("this test needs a device");
        let mut tracked = TrackedBuffer::new(&gpu.device, "tracked", b"held", BufferUsages::COPY_SRC);
        let held = |tracked: &TrackedBuffer| {
            let usage = BufferUsages::COPY_DST | BufferUsages::MAP_READ;
            let read = wgpu::BufferDescriptor { label: None, size: tracked.size(), usage, mapped_at_creation: false };
            let read = gpu.device.create_buffer(&read);
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            encoder.copy_buffer_to_buffer(&tracked.buffer, 0, &read, 0, None);
            gpu.queue.submit([encoder.finish()]);
            read.map_async(wgpu::MapMode::Read, .., |result| result.unwrap());
            gpu.device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
            read.get_mapped_range(..).unwrap().to_vec()
        };
        assert_eq!(held(&tracked), b"held");
        for (contents, expected) in [(b"held", b"else"), (b"next", b"next"), (b"next", b"else"), (b"held", b"held")] {
            if contents != expected {
                gpu.queue.write_buffer(&tracked.buffer, 0, expected);
            }
            tracked.write(&gpu.queue, contents);
            assert_eq!(held(&tracked), expected);
        }
    }
}
