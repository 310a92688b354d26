//! The textures that a frame is drawn into before it is shown.

use wgpu::{Device, TextureFormat, TextureUsages, TextureView};

/// Depth is 32-bit float, reversed: 1 at the near plane.
pub const DEPTH_FORMAT: TextureFormat = TextureFormat::Depth32Float;

/// How a frame's radiance is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RadianceFormat {
    /// `Rgba16Float` (11 bits, up to 65504: for the screen) or `Rgba32Float` (for measuring).
    pub texture: TextureFormat,
    /// Samples per pixel: 1 or 4.
    pub samples: u32,
}

impl RadianceFormat {
    /// For pictures that are looked at: 16-bit floats; `None` where the adapter cannot draw those with that many
    /// samples.
    pub fn display(adapter: &wgpu::Adapter, samples: u32) -> Option<Self> {
        let format = Self { texture: TextureFormat::Rgba16Float, samples };
        format.is_drawn_by(adapter).then_some(format)
    }

    /// For linear pictures: 32-bit floats; `None` where the adapter cannot draw those with that many samples.
    pub fn linear(adapter: &wgpu::Adapter, samples: u32) -> Option<Self> {
        let format = Self { texture: TextureFormat::Rgba32Float, samples };
        format.is_drawn_by(adapter).then_some(format)
    }

    /// `display`, with one sample where the adapter has no more; `None` where it draws no floats at all.
    pub fn nearest_display(adapter: &wgpu::Adapter, samples: u32) -> Option<Self> {
        Self::display(adapter, samples).or_else(|| Self::display(adapter, 1))
    }

    /// `linear`, with one sample where the adapter has no more, and in 16-bit floats where it draws no others; `None` where it
    /// draws none at all.
    pub fn nearest_linear(adapter: &wgpu::Adapter, samples: u32) -> Option<Self> {
        let linear = Self::linear(adapter, samples).or_else(|| Self::linear(adapter, 1));
        linear.or_else(|| Self::nearest_display(adapter, samples))
    }

    /// Bits of each number: 32, or 16, which keep 11 binary digits of numbers up to 65504.
    pub fn bits(self) -> u32 {
        if self.texture == TextureFormat::Rgba16Float { 16 } else { 32 }
    }

    /// The greatest number that a texel holds.
    pub(super) fn greatest(self) -> f64 {
        match self.texture {
            TextureFormat::Rgba16Float => 65504.0,
            _ => f32::MAX.into(),
        }
    }

    /// Whether the adapter draws into a format, without blending.
    pub(super) fn draws(adapter: &wgpu::Adapter, format: TextureFormat) -> bool {
        adapter.get_texture_format_features(format).allowed_usages.contains(TextureUsages::RENDER_ATTACHMENT)
    }

    fn is_drawn_by(self, adapter: &wgpu::Adapter) -> bool {
        let features = adapter.get_texture_format_features(self.texture);
        // In OpenGL, multisampled textures cannot be read: with wgpu they turn out black.
        let is_read = self.samples == 1 || adapter.get_info().backend != wgpu::Backend::Gl;
        features.allowed_usages.contains(TextureUsages::RENDER_ATTACHMENT)
            && features.flags.contains(wgpu::TextureFormatFeatureFlags::BLENDABLE)
            && features.flags.sample_count_supported(self.samples)
            && is_read
    }
}

/// What a frame with shadows is drawn into: one sample a pixel.
pub struct ShadowedTargets {
    pub size: [u32; 2],
    /// With nothing in the way of light.
    pub radiance: TextureView,
    /// What of it is blocked.
    pub blocked: TextureView,
    /// What the filter of shares goes by, where there is one.
    pub guide: Option<TextureView>,
    pub depth: TextureView,
}

impl ShadowedTargets {
    /// `size` is positive and within the device's limit for textures.
    pub fn new(device: &Device, size: [u32; 2], (format, guide): (TextureFormat, Option<TextureFormat>)) -> Self {
        let bound = |label, format| attachment(device, label, (size, 1, format), TextureUsages::TEXTURE_BINDING);
        Self {
            size,
            radiance: bound("radiance", format),
            blocked: bound("blocked", format),
            guide: guide.map(|format| Self::guide(device, size, format)),
            depth: attachment(device, "depth", (size, 1, DEPTH_FORMAT), TextureUsages::empty()),
        }
    }

    /// Another of what the filter of shares goes by.
    pub fn guide(device: &Device, size: [u32; 2], format: TextureFormat) -> TextureView {
        attachment(device, "guide", (size, 1, format), TextureUsages::TEXTURE_BINDING)
    }
}

/// A texture that is drawn into, and used otherwise too.
pub fn attachment(
    device: &Device,
    label: &str,
    (size, samples, format): ([u32; 2], u32, TextureFormat),
    usage: TextureUsages,
) -> TextureView {
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: samples,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: usage | TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// Radiance and depth of one frame.
pub struct Targets {
    pub size: [u32; 2],
    pub radiance: TextureView,
    pub depth: TextureView,
}

impl Targets {
    /// `size` is positive and within the device's limit for textures.
    pub fn new(device: &Device, size: [u32; 2], format: RadianceFormat) -> Self {
        let RadianceFormat { texture, samples } = format;
        Self {
            size,
            radiance: attachment(device, "radiance", (size, samples, texture), TextureUsages::TEXTURE_BINDING),
            depth: attachment(device, "depth", (size, samples, DEPTH_FORMAT), TextureUsages::TEXTURE_BINDING),
        }
    }
}
