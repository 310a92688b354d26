//! Textures on the device: mipmaps, samplers, and a bind group for each material that has any.

use std::borrow::Cow;
use std::collections::HashMap;

use glam::Vec3;
use wgpu::util::DeviceExt;
use wgpu::{BindGroup, BindGroupLayout, Device, Queue, ShaderStages, TextureView};

use super::materials::transforms;
use crate::scene::{
    AlphaMode, Cutout, Encoding, Filter, Image, Level, Material, Sampler, Scene, Texture, TextureSlot, Wrap,
};

/// The most samples that a filter takes along the axis in which a texture is foreshortened.
const ANISOTROPY: u16 = 8;

/// Group 1 of the surfaces' pass: for each slot a texture, for each a sampler, then the transforms of their
/// coordinates, then the shares of what the base colour cuts out, and their sampler.
pub(super) fn bind_group_layout(device: &Device) -> BindGroupLayout {
    use wgpu::{BindingType, BufferBindingType, SamplerBindingType, TextureSampleType, TextureViewDimension};
    let texture = BindingType::Texture {
        sample_type: TextureSampleType::Float { filterable: true },
        view_dimension: TextureViewDimension::D2,
        multisampled: false,
    };
    let transforms =
        BindingType::Buffer { ty: BufferBindingType::Uniform, has_dynamic_offset: false, min_binding_size: None };
    let sampler = BindingType::Sampler(SamplerBindingType::Filtering);
    let slots = TextureSlot::COUNT;
    let types = [vec![texture; slots], vec![sampler; slots], vec![transforms, texture, sampler]].concat();
    let entry =
        |(binding, ty)| wgpu::BindGroupLayoutEntry { binding, visibility: ShaderStages::FRAGMENT, ty, count: None };
    let entries: Vec<wgpu::BindGroupLayoutEntry> = (0..).zip(types).map(entry).collect();
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
    textures: HashMap<Content, TextureView>,
    samplers: HashMap<Sampler, wgpu::Sampler>,
}

/// What a texture on the device holds.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Content {
    /// Index into `Scene::images`.
    image: usize,
    encoding: Encoding,
    /// Where it holds shares: the bits of opacity and cutoff, and the sampler, of what cuts out.
    cutout: Option<([u32; 2], Sampler)>,
}

impl Content {
    fn of(slot: TextureSlot, texture: Texture) -> Self {
        Self { image: texture.image, encoding: Encoding::of(slot), cutout: None }
    }

    /// The shares of what a base colour's texture cuts out, if it does.
    fn shares(material: &Material, texture: Texture) -> Option<Self> {
        let AlphaMode::Mask { cutoff } = material.alpha_mode else { return None };
        let cutout = Some(([material.opacity, cutoff].map(f32::to_bits), texture.sampler));
        Some(Self { cutout, ..Self::of(TextureSlot::BaseColor, texture) })
    }

    fn cutout(&self) -> Option<Cutout> {
        let (bits, sampler) = self.cutout?;
        let [opacity, cutoff] = bits.map(f32::from_bits);
        Some(Cutout { opacity, cutoff, sampler })
    }
}

impl<'a> Pool<'a> {
    fn new(device: &'a Device, queue: &'a Queue, scene: &'a Scene) -> Self {
        let image = Image { name: "white".to_owned(), width: 1, height: 1, texels: vec![[255; 4]] };
        let white = upload(device, queue, &image, Encoding::Numbers, None);
        Self { device, queue, scene, white, textures: HashMap::new(), samplers: HashMap::new() }
    }

    fn bind_group(&mut self, layout: &BindGroupLayout, material: &Material) -> BindGroup {
        let textures = TextureSlot::ALL.map(|slot| Some(self.scene.textures[material.texture(slot)?.texture]));
        let base = textures[TextureSlot::BaseColor as usize];
        let shares = base.and_then(|texture| Content::shares(material, texture));
        let contents = TextureSlot::ALL.map(|slot| Some(Content::of(slot, textures[slot as usize]?)));
        for content in contents.into_iter().chain([shares]).flatten() {
            let image = &self.scene.images[content.image];
            let make = || upload(self.device, self.queue, image, content.encoding, content.cutout());
            self.textures.entry(content).or_insert_with(make);
        }
        let mut plain = textures.map(|texture| texture.map_or(Sampler::DEFAULT, |texture| texture.sampler));
        let base = &mut plain[TextureSlot::BaseColor as usize];
        let smooth = Sampler { wrap: base.wrap, ..Sampler::DEFAULT };
        if shares.is_some() {
            // Of what is cut out only the image itself is looked up so, which some drivers blur where they filter along an axis.
            *base = Sampler { minify: base.magnify, mipmaps: None, ..*base };
        }
        for sampler in plain.into_iter().chain([smooth]) {
            self.samplers.entry(sampler).or_insert_with(|| make_sampler(self.device, &sampler));
        }
        let transforms = self.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("material"),
            contents: bytemuck::cast_slice(&transforms(material)),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let view = |content: Option<Content>| {
            wgpu::BindingResource::TextureView(content.map_or(&self.white, |content| &self.textures[&content]))
        };
        let sampler = |sampler| wgpu::BindingResource::Sampler(&self.samplers[&sampler]);
        let resources = contents.into_iter().map(view).chain(plain.map(sampler));
        // How much is there is always filtered, whatever the file says of smaller sizes.
        let resources = resources.chain([transforms.as_entire_binding(), view(shares), sampler(smooth)]);
        let entry = |(binding, resource)| wgpu::BindGroupEntry { binding, resource };
        let entries: Vec<wgpu::BindGroupEntry> = (0..).zip(resources).map(entry).collect();
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
fn upload(device: &Device, queue: &Queue, image: &Image, encoding: Encoding, cutout: Option<Cutout>) -> TextureView {
    let limit = device.limits().max_texture_dimension_2d;
    let mut base = Level { size: [image.width, image.height], texels: Cow::Borrowed(&image.texels) };
    if encoding == Encoding::Normals {
        base.texels.to_mut().iter_mut().for_each(|texel| texel[3] = 255);
    }
    while base.size.iter().any(|side| *side > limit) {
        base = base.halved(encoding);
    }
    let levels = match cutout {
        Some(cutout) => cutout.levels(&base),
        None => {
            let next = |level: &Level| (level.size != [1, 1]).then(|| level.halved(encoding));
            let halves: Vec<Level> = std::iter::successors(next(&base), next).collect();
            std::iter::once(base).chain(halves).collect()
        }
    };
    let extent = |[width, height]: [u32; 2]| wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some(&image.name),
        size: extent(levels[0].size),
        mip_level_count: levels.len() as u32,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: format(encoding),
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    for (mip_level, level) in (0..).zip(&levels) {
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * level.size[0]), rows_per_image: None };
        let target = wgpu::TexelCopyTextureInfo { mip_level, ..texture.as_image_copy() };
        queue.write_texture(target, level.texels.as_flattened(), layout, extent(level.size));
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
