//! What the reference is asked for beside the settings that all ways of rendering share.

/// How light is followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Surfaces that light meets between a light and the surface that is seen: 0 is direct light.
    pub max_bounces: u32,
    /// Surfaces cast shadows.
    pub shadows: bool,
    /// Where a pixel's samples lie.
    pub filter: Filter,
    /// The lobe of the specular base.
    pub specular: SpecularModel,
}

impl Default for Options {
    fn default() -> Self {
        Self { max_bounces: 0, shadows: true, filter: Filter::Box, specular: SpecularModel::Ltc }
    }
}

/// Where a pixel's samples lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filter {
    /// All over the pixel.
    Box,
    /// At its centre, where `velour render --msaa 1` takes its value.
    Centre,
}

/// What the lobe of the specular base is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpecularModel {
    /// The transformed cosine of real time.
    Ltc,
    /// GGX microfacets themselves.
    Ggx,
}

/// How much work is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Samples a pixel, at least 1.
    pub samples: u64,
    /// Another seed gives other noise.
    pub seed: u64,
}
