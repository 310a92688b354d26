//! Textures on the device: mipmaps, samplers, and a bind group for each material that has any.

use std::borrow::Cow;
use std::collections::HashMap;

use glam::Vec3;
use rayon::prelude::*;
use wgpu::util::DeviceExt;
use wgpu::{BindGroup, BindGroupLayout, Device, Queue, ShaderStages, TextureView};

use super::materials::transforms;
use crate::scene::{Filter, Image, Material, Sampler, Scene, TextureSlot, Wrap, linear_from_srgb};

/// Most samples of a filter along the axis on which a texture is seen at a slant.
const ANISOTROPY: u16 = 8;

/// Where the transforms of the texture coordinates are bound.
const TRANSFORMS: u32 = 2 * TextureSlot::COUNT as u32;

/// Group 1 of the surfaces' pass: a texture for each slot, a sampler for each, and the transforms of their coordinates.
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

/// The bind groups of the materials that have textures, by their indices, and one of white textures for the others.
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

/// Textures and samplers that were made, each once.
struct Pool<'a> {
    device: &'a Device,
    queue: &'a Queue,
    scene: &'a Scene,
    white: TextureView,
    /// By image and what its texels are.
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
        // 0 would leave only the magnifying filter.
        lod_max_clamp: if sampler.mipmaps.is_some() { 32.0 } else { 0.25 },
        anisotropy_clamp: if is_smooth { ANISOTROPY } else { 1 },
        ..Default::default()
    })
}

/// The image with all its mipmaps; those larger than the device takes are left out.
fn upload(device: &Device, queue: &Queue, image: &Image, encoding: Encoding) -> TextureView {
    let limit = device.limits().max_texture_dimension_2d;
    let mut base = Level { size: [image.width, image.height], texels: Cow::Borrowed(&image.texels) };
    if encoding == Encoding::Normals {
        base.texels.to_mut().iter_mut().for_each(|texel| texel[3] = 255);
    }
    while base.size.iter().any(|side| *side > limit) {
        base = base.next(encoding);
    }
    let count = u32::BITS - base.size[0].max(base.size[1]).leading_zeros();
    let extent = |[width, height]: [u32; 2]| wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some(&image.name),
        size: extent(base.size),
        mip_level_count: count,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: encoding.format(),
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let mut level = base;
    for mip_level in 0..count {
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * level.size[0]), rows_per_image: None };
        let target = wgpu::TexelCopyTextureInfo { mip_level, ..texture.as_image_copy() };
        queue.write_texture(target, level.texels.as_flattened(), layout, extent(level.size));
        level = level.next(encoding);
    }
    // What was staged is let go texture by texture.
    queue.submit([]);
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// What the bytes of a texture are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Encoding {
    /// sRGB; opacity is a number.
    Colors,
    Numbers,
    /// Unit normals; a mipmap's alpha keeps the length of the mean that each of its texels stands for: see [`length_from`].
    Normals,
}

impl Encoding {
    fn of(slot: TextureSlot) -> Self {
        match slot {
            TextureSlot::Normal => Self::Normals,
            slot if slot.is_color() => Self::Colors,
            _ => Self::Numbers,
        }
    }

    fn format(self) -> wgpu::TextureFormat {
        match self {
            Self::Colors => wgpu::TextureFormat::Rgba8UnormSrgb,
            Self::Numbers | Self::Normals => wgpu::TextureFormat::Rgba8Unorm,
        }
    }

    /// What means are taken of.
    fn decode(self, byte: u8) -> f32 {
        match self {
            Self::Colors => linear_from_srgb(byte),
            Self::Numbers => f32::from(byte),
            Self::Normals => f32::from(byte) / 127.5 - 1.0,
        }
    }

    fn encode(self, mean: [f32; 4]) -> [u8; 4] {
        let rounded = |value: f32| (value + 0.5) as u8;
        let [r, g, b, a] = mean;
        match self {
            Self::Colors => {
                let [r, g, b] = [r, g, b].map(|linear| rounded(255.0 * crate::picture::srgb_from_linear(linear)));
                [r, g, b, rounded(a)]
            }
            Self::Numbers => mean.map(rounded),
            Self::Normals => {
                let length = Vec3::new(r, g, b).length().min(1.0);
                let [r, g, b] = (Vec3::new(r, g, b).normalize_or(Vec3::Z) * 127.5 + 127.5).to_array().map(rounded);
                [r, g, b, rounded(255.0 * (1.0 - (1.0 - length).sqrt()))]
            }
        }
    }
}

/// The length of a mean of unit normals from the alpha that keeps it, finest near 1, where it tells most.
fn length_from(alpha: u8) -> f32 {
    let rest = 1.0 - f32::from(alpha) / 255.0;
    1.0 - rest * rest
}

/// A normal as bytes have rounded it, of the length that it stands for.
fn normal_of_length([x, y, z, _]: [f32; 4], length: f32) -> [f32; 4] {
    let normal = length * Vec3::new(x, y, z).normalize_or(Vec3::Z);
    normal.extend(0.0).to_array()
}

/// A texture at one of its sizes.
struct Level<'a> {
    size: [u32; 2],
    texels: Cow<'a, [[u8; 4]]>,
}

impl Level<'_> {
    /// Half the size, rounded down: each texel is the mean over the area that it covers, of colours in linear light.
    fn next(&self, encoding: Encoding) -> Level<'static> {
        let [width, height] = self.size.map(|side| (side / 2).max(1));
        let linear: [f32; 256] = std::array::from_fn(|byte| encoding.decode(byte as u8));
        let columns: Vec<Span> = (0..width).map(|x| Span::new(x, width, self.size[0])).collect();
        let row = |y: u32| {
            let rows = Span::new(y, height, self.size[1]);
            columns
                .iter()
                .map(move |columns| (rows, *columns))
                .map(|(rows, columns)| self.mean((rows, columns), encoding, &linear))
        };
        let texels = (0..height)
            .into_par_iter()
            .flat_map_iter(|y| row(y).map(|mean| encoding.encode(mean)).collect::<Vec<_>>())
            .collect();
        Level { size: [width, height], texels: Cow::Owned(texels) }
    }

    /// The mean over some rows and columns; opacity is never encoded.
    fn mean(&self, (rows, columns): (Span, Span), encoding: Encoding, linear: &[f32; 256]) -> [f32; 4] {
        let mut mean = [0.0; 4];
        for (y, row_weight) in rows.weights() {
            for (x, column_weight) in columns.weights() {
                let [r, g, b, a] = self.texels[y * self.size[0] as usize + x];
                let weight = row_weight * column_weight;
                let mut values = [linear[r as usize], linear[g as usize], linear[b as usize], f32::from(a)];
                if encoding == Encoding::Normals {
                    values = normal_of_length(values, length_from(a));
                }
                mean.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
            }
        }
        mean
    }
}

/// What one of `count` texels covers of `of`: at most three.
#[derive(Clone, Copy)]
struct Span {
    first: usize,
    weights: [f32; 3],
    count: usize,
}

impl Span {
    fn new(index: u32, count: u32, of: u32) -> Self {
        let scale = of as f32 / count as f32;
        let (start, end) = (index as f32 * scale, (index + 1) as f32 * scale);
        let first = start as usize;
        let last = ((end - 1e-3) as usize).min(of as usize - 1);
        let mut weights = [0.0; 3];
        for (at, weight) in (first..=last).zip(&mut weights) {
            *weight = (end.min((at + 1) as f32) - start.max(at as f32)) / scale;
        }
        Self { first, weights, count: last + 1 - first }
    }

    fn weights(self) -> impl Iterator<Item = (usize, f32)> {
        (0..self.count.min(3)).map(move |k| (self.first + k, self.weights[k]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_are_means_over_the_area_in_linear_light() {
        let checker = |size: [u32; 2]| {
            let texel = |at: u32| [if (at % size[0] + at / size[0]).is_multiple_of(2) { 255 } else { 0 }; 4];
            Level { size, texels: (0..size[0] * size[1]).map(texel).collect() }
        };
        // Half the light is 188 in sRGB, 128 as a number; opacity is one.
        assert_eq!(checker([8, 4]).next(Encoding::Colors).texels, vec![[188, 188, 188, 128]; 8]);
        assert_eq!(checker([8, 4]).next(Encoding::Numbers).texels, vec![[128; 4]; 8]);
        let odd = Level { size: [3, 1], texels: vec![[30; 4], [60; 4], [90; 4]].into() }.next(Encoding::Numbers);
        assert_eq!((odd.size, odd.texels.to_vec()), ([1, 1], vec![[60; 4]]));
        let five = Level { size: [5, 1], texels: vec![[0; 4], [0; 4], [100; 4], [0; 4], [0; 4]].into() }
            .next(Encoding::Numbers);
        assert_eq!((five.size, five.texels.to_vec()), ([2, 1], vec![[20; 4]; 2]));
    }

    #[test]
    fn the_mean_survives_every_halving() {
        let texels: Vec<[u8; 4]> = (0..37 * 21).map(|at: u32| [(at * 97 % 256) as u8; 4]).collect();
        let mean = |level: &Level| {
            level.texels.iter().map(|texel| f64::from(texel[0])).sum::<f64>() / level.texels.len() as f64
        };
        let mut level = Level { size: [37, 21], texels: texels.into() };
        let whole = mean(&level);
        while level.size != [1, 1] {
            level = level.next(Encoding::Numbers);
            assert!((mean(&level) - whole).abs() < 1.0, "{:?}", level.size);
        }
    }

    #[test]
    fn mipmaps_of_normals_keep_the_length_of_their_mean() {
        let lean = |x: f32| {
            let normal = Vec3::new(x, 0.0, 1.0).normalize() * 127.5 + 127.5;
            [normal.x.round() as u8, 128, normal.z.round() as u8, 255]
        };
        let mean = |level: &Level| {
            let [r, g, b, a] = level.texels[0];
            (Vec3::new(f32::from(r), f32::from(g), f32::from(b)) / 127.5 - 1.0, length_from(a))
        };
        let flat = Level { size: [2, 2], texels: vec![lean(0.4); 4].into() }.next(Encoding::Normals);
        assert!(mean(&flat).1 > 0.9999, "nothing was averaged");
        let texels = vec![lean(1.0), lean(-1.0), lean(-1.0), lean(1.0), lean(1.0), lean(-1.0), lean(-1.0), lean(1.0)];
        let bumpy = Level { size: [4, 2], texels: texels.into() }.next(Encoding::Normals);
        for level in [&bumpy, &bumpy.next(Encoding::Normals)] {
            let (normal, length) = mean(level);
            assert!(normal.distance(Vec3::Z) < 0.01 && (length - 0.5_f32.sqrt()).abs() < 0.005, "{normal} {length}");
        }
    }
}
