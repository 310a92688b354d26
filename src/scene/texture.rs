use std::ops::{Add, Mul};

use glam::{Affine2, DVec2};

/// A decoded picture: 8 bits a channel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Its name in the file, for messages; may be empty.
    pub name: String,
    /// In texels, > 0.
    pub width: u32,
    /// In texels, > 0.
    pub height: u32,
    /// `width * height` texels of red, green, blue, alpha; rows from the top, where v = 0.
    pub texels: Vec<[u8; 4]>,
}

/// An image and how it is looked up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Texture {
    /// Index into `Scene::images`.
    pub image: usize,
    /// How it is looked up.
    pub sampler: Sampler,
}

/// How a texture is continued and filtered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Sampler {
    /// How it goes on beyond its edges, along u and along v.
    pub wrap: [Wrap; 2],
    /// Between texels, where texels are larger than pixels.
    pub magnify: Filter,
    /// Between texels, where texels are smaller than pixels.
    pub minify: Filter,
    /// Between mipmaps; `None` where only the full image is used.
    pub mipmaps: Option<Filter>,
}

impl Sampler {
    /// What stands where a glTF file says nothing: repeated, linear, with mipmaps.
    pub const DEFAULT: Self = Self {
        wrap: [Wrap::Repeat; 2],
        magnify: Filter::Linear,
        minify: Filter::Linear,
        mipmaps: Some(Filter::Linear),
    };

    /// What an image of this size shows at (u, v) as it is magnified, in `f64`. `texel` gives the texel at an index, in
    /// rows from the top; that of column i and row j has its centre at ((i + 0.5) / width, (j + 0.5) / height).
    ///
    /// Coordinates that are not finite, or so far away that they have no fractions left (10^15 texels), show the first
    /// texel.
    pub fn magnified<T>(&self, [width, height]: [u32; 2], uv: DVec2, texel: impl Fn(usize) -> T) -> T
    where
        T: Add<Output = T> + Mul<f64, Output = T>,
    {
        let place = uv * DVec2::new(width.into(), height.into()) - 0.5;
        let place = if place.abs().cmplt(DVec2::splat(1e15)).all() { place } else { DVec2::ZERO };
        let place = if self.magnify == Filter::Nearest { place.round() } else { place };
        let (corner, fraction) = (place.floor(), place - place.floor());
        let along =
            |axis: usize, side: u32| [0, 1].map(|step| self.wrap[axis].texel(corner[axis] as i64 + step, side.into()));
        let (columns, rows) = (along(0, width), along(1, height));
        let mix = |[first, second]: [T; 2], share: f64| first * (1.0 - share) + second * share;
        let row = |row: usize| mix(columns.map(|column| texel(row * width as usize + column)), fraction.x);
        mix(rows.map(row), fraction.y)
    }
}

/// How a texture goes on beyond its edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Wrap {
    /// It starts anew.
    Repeat,
    /// It runs back, and to and fro.
    Mirror,
    /// Its edge goes on.
    Clamp,
}

impl Wrap {
    /// The texel, in [0, `side`), that is seen at place `at` along an axis of `side` > 0 texels.
    pub fn texel(self, at: i64, side: i64) -> usize {
        let at = match self {
            Self::Repeat => at.rem_euclid(side),
            Self::Clamp => at.clamp(0, side - 1),
            Self::Mirror => {
                let at = at.rem_euclid(2 * side);
                at.min(2 * side - 1 - at)
            }
        };
        at as usize
    }
}

/// What is seen between the centres of texels, or between mipmaps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Filter {
    /// The nearest one.
    Nearest,
    /// Linear interpolation.
    Linear,
}

/// A texture as a material uses it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureUse {
    /// Index into `Scene::textures`.
    pub texture: usize,
    /// Which of the mesh's two sets of texture coordinates it is looked up at, 0 or 1.
    pub tex_coord: usize,
    /// KHR_texture_transform: takes those coordinates to (u, v).
    pub uv_from_tex_coord: Affine2,
}

/// The linear light, in [0, 1], of an sRGB-encoded byte (IEC 61966-2-1).
pub fn linear_from_srgb(code: u8) -> f32 {
    let encoded = f32::from(code) / 255.0;
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}
