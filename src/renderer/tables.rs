//! The tables of the lobes as textures, at the full precision of their files: they are read without a sampler.

use wgpu::TextureView;
use wgpu::util::DeviceExt;

use super::Gpu;
use crate::table::{GgxTable, SheenTable};

/// The sheen's: x = alpha, y = mu.
pub(super) fn sheen(gpu: &Gpu, table: &SheenTable) -> TextureView {
    let size = table.size().map(|side| side as u32);
    texture(gpu, "sheen table", size, &table.texels())
}

/// The specular base's: x = roughness, y = sqrt(1 - mu), in two halves.
pub(super) fn ggx(gpu: &Gpu) -> TextureView {
    let table = GgxTable::embedded();
    texture(gpu, "ggx table", table.texture_size().map(|side| side as u32), &table.texels())
}

fn texture(gpu: &Gpu, label: &str, [width, height]: [u32; 2], texels: &[[f32; 4]]) -> TextureView {
    let descriptor = wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba32Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let order = wgpu::util::TextureDataOrder::LayerMajor;
    let texture = gpu.device.create_texture_with_data(&gpu.queue, &descriptor, order, bytemuck::cast_slice(texels));
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
