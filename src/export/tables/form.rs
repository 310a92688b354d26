//! The forms, and how each lays out its numbers.

/// A form of a table's file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A DirectDraw Surface, as in `tables/`.
    Dds,
    /// A Khronos texture, version 2.
    Ktx2,
    /// Text, as in `tables/`.
    Csv,
    /// NumPy's.
    Npy,
    /// A picture in OpenEXR.
    Exr,
    /// The numbers alone.
    Bin,
    /// A module of JavaScript.
    Js,
    /// A header of C and C++.
    C,
    /// A file of Rust.
    Rust,
    /// A file of GLSL: ES 3.00 and later, 3.30 with ARB_shading_language_packing, 4.20 and later.
    Glsl,
}

impl Form {
    /// All of them.
    pub const ALL: [Self; 10] =
        [Self::Dds, Self::Ktx2, Self::Csv, Self::Npy, Self::Exr, Self::Bin, Self::Js, Self::C, Self::Rust, Self::Glsl];

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Dds => "dds",
            Self::Ktx2 => "ktx2",
            Self::Csv => "csv",
            Self::Npy => "npy",
            Self::Exr => "exr",
            Self::Bin => "bin",
            Self::Js => "js",
            Self::C => "c",
            Self::Rust => "rust",
            Self::Glsl => "glsl",
        }
    }

    /// The extension of a file's name.
    pub fn extension(self) -> &'static str {
        match self {
            Self::C => "h",
            Self::Rust => "rs",
            _ => self.name(),
        }
    }

    /// What the form makes of the texels, in half a sentence.
    pub fn encoding(self) -> &'static str {
        match self {
            Self::Dds => "DX10 header of 148 bytes, then halves, little-endian, RGBA, first row first, no mips",
            Self::Ktx2 => "VK_FORMAT_R16G16B16A16_SFLOAT, little-endian, RGBA, first row first, one level",
            Self::Csv => "Text whose head tells axes, columns and errors; a line for each node, the first axis slowest",
            Self::Npy => "little-endian floats of 32 bits in C order, shape (height, width, 4)",
            Self::Exr => "channels R, G, B, A of halves, the first row at the top",
            Self::Bin => "halves, little-endian, RGBA, first row first, nothing before or after",
            Self::Js => "bits of halves, RGBA, first row first",
            Self::C | Self::Rust => "floats by [y][x][channel], first row first",
            Self::Glsl => "two halves to a uint, the first in its low bits, a uvec2 a texel, first row first",
        }
    }
}
