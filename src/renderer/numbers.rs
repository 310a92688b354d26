//! Textures of numbers, read by their place: four words a texel, in rows one after the other.

use wgpu::{Device, Queue, Texture, TextureFormat};

/// A texel.
pub(super) type Words = [u32; 4];

pub(super) const FORMAT: TextureFormat = TextureFormat::Rgba32Uint;

/// `BLOCKERS_ROW` of `blockers.wgsl`: texels in a row.
pub(super) const ROW: usize = 1 << 13;

/// Rows of so many texels.
pub(super) fn rows(texels: usize) -> usize {
    texels.div_ceil(ROW)
}

/// A texture of so many rows, or one.
pub(super) fn numbers(device: &Device, label: &str, rows: usize) -> Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width: ROW as u32, height: rows.max(1) as u32, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    })
}

/// Writes whole rows from one on; what is beyond the texels does not count.
pub(super) fn write(queue: &Queue, texture: &Texture, first_row: usize, mut texels: Vec<Words>) {
    let rows = rows(texels.len());
    if rows == 0 {
        return;
    }
    texels.resize(rows * ROW, [0; 4]);
    queue.write_texture(
        wgpu::TexelCopyTextureInfo {
            origin: wgpu::Origin3d { x: 0, y: first_row as u32, z: 0 },
            ..texture.as_image_copy()
        },
        bytemuck::cast_slice(&texels),
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some((ROW * size_of::<Words>()) as u32),
            rows_per_image: None,
        },
        wgpu::Extent3d { width: ROW as u32, height: rows as u32, depth_or_array_layers: 1 },
    );
}
