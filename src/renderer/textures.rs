//! Textures on the device: mipmaps, samplers, and a bind group for each material that has any.

use std::borrow::Cow;
use std::collections::HashMap;

use glam::Vec3;
use wgpu::util::DeviceExt;
use wgpu::{BindGroup, BindGroupLayout, Device, Queue, ShaderStages, TextureView};

use super::materials::transforms;
use crate::scene::{Encoding, Filter, Image, Level, Material, Sampler, Scene, TextureSlot, Wrap};

/// The most samples that a filter takes along the axis in which a texture is foreshortened.
const ANISOTROPY: u16 = 8;

/// The binding of the texture coordinates' transforms.
const TRANSFORMS: u32 = 2 * TextureSlot::COUNT as u32;

/// Group 1 of the surfaces' pass: for each slot a texture, for each a sampler, then the transforms of their
/// coordinates.
pub(super) fn bind_group_layout(device: &Device) -> BindGroupLayout {
    use wgpu::{BindingType, BufferBindingType, SamplerBindingType, TextureSampleType, TextureViewDimension};
    let texture = BindingType::Texture {
        sample_type: TextureSampleType::Float { filterable: true },
        view_dimension: TextureViewDimension::D2,
        multisampled: false,
    };
    let transforms =
        BindingType::Buffer { ty: BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: None };
    let types = [texture, BindingType::Sampler(SamplerBindingType::Filtering), transforms];
    let entries: Vec<wgpu::BindGroupLayoutEntry> = (0..=TRANSFORMS)
        .map(|binding| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: ShaderStages::FRAGMENT,
            ty: types[binding as usize / TextureSlot::COUNT],
            count: None,
        })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("material"), entries: &entries })
}

/// The bind groups of the materials that have textures, by their indices, and one with white textures for the others.
pub(super) fn bind_groups(
    (device, queue): (&Device, &Queue),
    layout: &BindGroupLayout,
    scene: &Scene,
) -> (HashMap<usize, BindGroup>, BindGroup) {
    let mut pool = Pool::new(device, queue, scene);
    let textured = scene.materials.iter().enumerate().filter(|(_, material)| is_textured(material));
    let groups = textured.map(|(index, material)| (index, pool.bind_group(layout, material))).collect();
    (groups, pool.bind_group(layout, &Material::matte("", Vec3::ONE)))
}

fn is_textured(material: &Material) -> bool {
    material.textures.iter().any(Option::is_some)
}

/// The textures and samplers made so far, none of them twice.
struct Pool<'a> {
    device: &'a Device,
    queue: &'a Queue,
    scene: &'a Scene,
    white: TextureView,
    /// By image and encoding.
    textures: HashMap<(usize, Encoding), TextureView>,
    samplers: HashMap<Sampler, wgpu::Sampler>,
}

impl<'a> Pool<'a> {
    fn new(device: &'a Device, queue: &'a Queue, scene: &'a Scene) -> Self {
        let image = Image { name: "white".to_owned(), width: 1, height: 1, texels: vec![[255; 4]] };
        let white = upload(device, queue, &image, Encoding::Numbers);
        Self { device, queue, scene, white, textures: HashMap::new(), samplers: HashMap::new() }
    }

    fn bind_group(&mut self, layout: &BindGroupLayout, material: &Material) -> BindGroup {
        for slot in TextureSlot::ALL {
            let texture = material.texture(slot).map(|texture| self.scene.textures[texture.texture]);
            let sampler = texture.map_or(Sampler::DEFAULT, |texture| texture.sampler);
            self.samplers.entry(sampler).or_insert_with(|| make_sampler(self.device, &sampler));
            if let Some(texture) = texture {
                let (image, encoding) = (&self.scene.images[texture.image], Encoding::of(slot));
                let make = || upload(self.device, self.queue, image, encoding);
                self.textures.entry((texture.image, encoding)).or_insert_with(make);
            }
        }
        let transforms = self.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("material"),
            contents: bytemuck::cast_slice(&transforms(material)),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let transforms = wgpu::BindGroupEntry { binding: TRANSFORMS, resource: transforms.as_entire_binding() };
        let entries: Vec<wgpu::BindGroupEntry> = TextureSlot::ALL
            .into_iter()
            .flat_map(|slot| {
                let texture = material.texture(slot).map(|texture| self.scene.textures[texture.texture]);
                let view = texture.map_or(&self.white, |texture| &self.textures[&(texture.image, Encoding::of(slot))]);
                let sampler = texture.map_or(Sampler::DEFAULT, |texture| texture.sampler);
                let binding = slot as u32;
                [
                    wgpu::BindGroupEntry { binding, resource: wgpu::BindingResource::TextureView(view) },
                    wgpu::BindGroupEntry {
                        binding: binding + TextureSlot::COUNT as u32,
                        resource: wgpu::BindingResource::Sampler(&self.samplers[&sampler]),
                    },
                ]
            })
            .chain([transforms])
            .collect();
        let label = Some("material");
        self.device.create_bind_group(&wgpu::BindGroupDescriptor { label, layout, entries: &entries })
    }
}

fn make_sampler(device: &Device, sampler: &Sampler) -> wgpu::Sampler {
    let wrap = |wrap: Wrap| match wrap {
        Wrap::Repeat => wgpu::AddressMode::Repeat,
        Wrap::Mirror => wgpu::AddressMode::MirrorRepeat,
        Wrap::Clamp => wgpu::AddressMode::ClampToEdge,
    };
    let filter = |filter: Filter| match filter {
        Filter::Nearest => wgpu::FilterMode::Nearest,
        Filter::Linear => wgpu::FilterMode::Linear,
    };
    let mipmap_filter = match sampler.mipmaps {
        Some(Filter::Linear) => wgpu::MipmapFilterMode::Linear,
        _ => wgpu::MipmapFilterMode::Nearest,
    };
    let is_smooth = [Some(sampler.magnify), Some(sampler.minify), sampler.mipmaps] == [Some(Filter::Linear); 3];
    device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("material"),
        address_mode_u: wrap(sampler.wrap[0]),
        address_mode_v: wrap(sampler.wrap[1]),
        mag_filter: filter(sampler.magnify),
        min_filter: filter(sampler.minify),
        mipmap_filter,
        // 0 would leave the magnifying filter as the only one.
        lod_max_clamp: if sampler.mipmaps.is_some() { 32.0 } else { 0.25 },
        anisotropy_clamp: if is_smooth { ANISOTROPY } else { 1 },
        ..Default::default()
    })
}

/// The image with all its mipmaps, without the sizes that are too large for the device.
fn upload(device: &Device, queue: &Queue, image: &Image, encoding: Encoding) -> TextureView {
    let limit = device.limits().max_texture_dimension_2d;
    let mut base = Level { size: [image.width, image.height], texels: Cow::Borrowed(&image.texels) };
    if encoding == Encoding::Normals {
        base.texels.to_mut().iter_mut().for_each(|texel| texel[3] = 255);
    }
    while base.size.iter().any(|side| *side > limit) {
        base = base.halved(encoding);
    }
    let count = u32::BITS - base.size[0].max(base.size[1]).leading_zeros();
    let extent = |[width, height]: [u32; 2]| wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some(&image.name),
        size: extent(base.size),
        mip_level_count: count,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: format(encoding),
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let mut level = base;
    for mip_level in 0..count {
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * level.size[0]), rows_per_image: None };
        let target = wgpu::TexelCopyTextureInfo { mip_level, ..texture.as_image_copy() };
        queue.write_texture(target, level.texels.as_flattened(), layout, extent(level.size));
        level = level.halved(encoding);
    }
    // Frees what was staged after each texture.
    queue.submit([]);
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// The device's format for an encoding.
fn format(encoding: Encoding) -> wgpu::TextureFormat {
    match encoding {
        Encoding::Colors => wgpu::TextureFormat::Rgba8UnormSrgb,
        Encoding::Numbers | Encoding::Normals => wgpu::TextureFormat::Rgba8Unorm,
    }
}
