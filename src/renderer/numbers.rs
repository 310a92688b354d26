//! Textures of numbers, read by their place: four words a texel, in rows one after the other.

use wgpu::{BindingResource, BindingType, Device, Queue, StorageTextureAccess, Texture, TextureFormat, TextureView};

use super::tracked_buffer::hash;
use super::{Gpu, RenderError};

/// A texel.
pub(super) type Words = [u32; 4];

const FORMAT: TextureFormat = TextureFormat::Rgba32Uint;

/// Texels in a row of what every pixel reads: two to the power of `NUMBERS_ROW` of `numbers.wgsl`, and no more than any device has room for.
const ROW: usize = 1 << 11;

/// A texture of rows of so many texels, and of so many rows, or one.
pub(super) fn numbers(device: &Device, label: &str, [row, rows]: [usize; 2]) -> Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width: row as u32, height: rows.max(1) as u32, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

/// Writes rows from one on: whole ones where there are several; what is beyond the texels does not count.
pub(super) fn write(queue: &Queue, texture: &Texture, first_row: usize, mut texels: Vec<Words>) {
    let row = texture.width() as usize;
    let (rows, width) = (texels.len().div_ceil(row), texels.len().min(row));
    if rows == 0 {
        return;
    }
    texels.resize(rows * width, [0; 4]);
    queue.write_texture(
        wgpu::TexelCopyTextureInfo {
            origin: wgpu::Origin3d { x: 0, y: first_row as u32, z: 0 },
            ..texture.as_image_copy()
        },
        bytemuck::cast_slice(&texels),
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some((width * size_of::<Words>()) as u32),
            rows_per_image: None,
        },
        wgpu::Extent3d { width: width as u32, height: rows as u32, depth_or_array_layers: 1 },
    );
}

/// How such a texture is bound.
pub(super) fn binding() -> BindingType {
    BindingType::StorageTexture {
        access: StorageTextureAccess::ReadOnly,
        format: FORMAT,
        view_dimension: wgpu::TextureViewDimension::D2,
    }
}

/// A texture of numbers that is written when they change, and only then.
pub(super) struct TrackedNumbers {
    texture: Texture,
    view: TextureView,
    hash: u64,
}

impl TrackedNumbers {
    /// Fails where they are more than a texture holds; `what` they are.
    pub fn new(gpu: &Gpu, what: &str, texels: Vec<Words>) -> Result<Self, RenderError> {
        let limit = gpu.device.limits().max_texture_dimension_2d;
        let rows = texels.len().div_ceil(ROW);
        if rows > limit as usize {
            let [bytes, limit] =
                [texels.len(), limit as usize * ROW].map(|texels| (texels * size_of::<Words>()) as u64);
            return Err(RenderError::TooLarge { what: what.to_owned(), bytes, limit });
        }
        let texture = numbers(&gpu.device, what, [ROW, rows]);
        let hash = hash(bytemuck::cast_slice(&texels));
        write(&gpu.queue, &texture, 0, texels);
        let view = texture.create_view(&Default::default());
        Ok(Self { texture, view, hash })
    }

    pub fn binding(&self) -> BindingResource<'_> {
        BindingResource::TextureView(&self.view)
    }

    /// Writes numbers; whether that took another texture, because they have grown.
    pub fn write(&mut self, gpu: &Gpu, what: &str, texels: Vec<Words>) -> Result<bool, RenderError> {
        if texels.len().div_ceil(ROW) > self.texture.height() as usize {
            *self = Self::new(gpu, what, texels)?;
            return Ok(true);
        }
        let hash = hash(bytemuck::cast_slice(&texels));
        if hash != self.hash {
            self.hash = hash;
            write(&gpu.queue, &self.texture, 0, texels);
        }
        Ok(false)
    }
}

#[cfg(test)]
mod tests {
    use super::super::layout::constant;
    use super::super::shader::SURFACES_WGSL;
    use super::*;

    #[test]
    fn rows_are_as_long_as_the_shader_takes_them_to_be() {
        assert_eq!(constant(SURFACES_WGSL, "NUMBERS_ROW"), ROW.ilog2());
        // A device that has no more than every scene needs has room for them.
        assert!(ROW <= super::super::device::needed_limits().max_texture_dimension_2d as usize);
    }
}
