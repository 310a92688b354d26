//! Textures that are drawn into and read back.

use std::sync::{Arc, Mutex};
use std::task::{Poll, Waker};

use half::f16;

use super::{Gpu, RenderError};

/// A texture for a picture, or a tile of one.
pub(super) struct Canvas {
    texture: wgpu::Texture,
    pub view: wgpu::TextureView,
}

impl Canvas {
    /// `size` is positive and within the device's limit for textures.
    pub fn new(gpu: &Gpu, [width, height]: [u32; 2], format: wgpu::TextureFormat) -> Self {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("picture"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Self { texture, view }
    }

    /// Submits what has been encoded, and reads the texels, in rows of equal length that have padding at their ends.
    pub async fn read(&self, gpu: &Gpu, mut encoder: wgpu::CommandEncoder) -> Result<Vec<u8>, RenderError> {
        let extent = self.texture.size();
        let stride = (extent.width * self.texel_size()).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("readback"),
            size: u64::from(stride) * u64::from(extent.height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(stride), rows_per_image: None };
        encoder.copy_texture_to_buffer(
            self.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
            extent,
        );
        gpu.queue.submit([encoder.finish()]);
        map(&buffer).await?;
        let range = buffer.get_mapped_range(..).map_err(|error| RenderError::Readback(error.to_string()))?;
        Ok(range.to_vec())
    }

    /// The same as numbers, without padding, where the texture holds halves or floats.
    pub async fn read_floats(&self, gpu: &Gpu, encoder: wgpu::CommandEncoder) -> Result<Vec<[f32; 4]>, RenderError> {
        let rows = self.read(gpu, encoder).await?;
        let (extent, texel_size) = (self.texture.size(), self.texel_size() as usize);
        let texel = |bytes: &[u8]| match texel_size {
            8 => bytemuck::pod_read_unaligned::<[u16; 4]>(bytes).map(|bits| f16::from_bits(bits).to_f32()),
            _ => bytemuck::pod_read_unaligned::<[f32; 4]>(bytes),
        };
        let stride = rows.len() / extent.height as usize;
        let texels = |row: &[u8]| {
            row[..extent.width as usize * texel_size].chunks_exact(texel_size).map(texel).collect::<Vec<_>>()
        };
        Ok(rows.chunks_exact(stride).flat_map(texels).collect())
    }

    fn texel_size(&self) -> u32 {
        self.texture.format().block_copy_size(None).unwrap_or(16)
    }
}

/// Resolves when the buffer can be read. The device has to be polled meanwhile: a browser does so by itself, elsewhere
/// `Gpu::block_on` does.
async fn map(buffer: &wgpu::Buffer) -> Result<(), RenderError> {
    type Mapped = (Option<Result<(), wgpu::BufferAsyncError>>, Option<Waker>);
    let shared = Arc::new(Mutex::new(Mapped::default()));
    let writer = Arc::clone(&shared);
    buffer.map_async(wgpu::MapMode::Read, .., move |result| {
        let mut mapped = writer.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        mapped.0 = Some(result);
        if let Some(waker) = mapped.1.take() {
            waker.wake();
        }
    });
    let result = std::future::poll_fn(|context| {
        let mut mapped = shared.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        match mapped.0.take() {
            Some(result) => Poll::Ready(result),
            None => {
                mapped.1 = Some(context.waker().clone());
                Poll::Pending
            }
        }
    });
    result.await.map_err(|error| RenderError::Readback(error.to_string()))
}
