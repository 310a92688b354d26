//! How languages spell types and declarations.

use super::types::{Scalar, Type};

/// A language of shaders that the files are translated to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// OpenGL ES 3.0 and WebGL 2, and every later GLSL: textures come with their samplers.
    GlslEs300,
    /// Vulkan's, where textures are apart from samplers.
    Glsl450,
    /// Direct3D's, of shader model 5.0 and later.
    Hlsl,
    /// Metal's, 1.1 and later.
    Msl,
}

impl Language {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::GlslEs300, Self::Glsl450, Self::Hlsl, Self::Msl];

    /// The extension of a file's name.
    pub fn extension(self) -> &'static str {
        match self {
            Self::GlslEs300 | Self::Glsl450 => "glsl",
            Self::Hlsl => "hlsl",
            Self::Msl => "metal",
        }
    }

    /// The folder below `shaders/` in which the translated files stand; where one folder serves two, those of the other are
    /// made when they are asked for.
    pub fn folder(self) -> Option<&'static str> {
        match self {
            Self::GlslEs300 => Some("glsl"),
            Self::Glsl450 => None,
            Self::Hlsl => Some("hlsl"),
            Self::Msl => Some("msl"),
        }
    }

    /// Whether it is a GLSL.
    pub(super) fn is_glsl(self) -> bool {
        matches!(self, Self::GlslEs300 | Self::Glsl450)
    }

    /// What a reader has to know before he pastes, in lines of comments.
    pub(super) fn notes(self) -> &'static str {
        match self {
            Self::GlslEs300 => {
                "// Language: GLSL ES 3.00, where `precision highp float; precision highp int; precision highp sampler2D;` come before it, or any later GLSL.\n"
            }
            Self::Glsl450 => {
                "// Language: GLSL 4.50 for Vulkan; where there are textures, `#extension GL_EXT_samplerless_texture_functions : require` comes before it.\n"
            }
            Self::Hlsl => {
                "// Language: HLSL, shader model 5.0 and later. m_inv is used as mul(m_inv, v), whatever the packing of buffers.\n"
            }
            Self::Msl => "// Language: Metal 1.1 and later. Half floats are not enough.\n",
        }
    }

    /// What stands between the header and the rest.
    pub(super) fn preamble(self) -> &'static str {
        match self {
            Self::GlslEs300 | Self::Glsl450 | Self::Hlsl => "",
            Self::Msl => "\n#include <metal_stdlib>\nusing namespace metal;\n",
        }
    }

    /// What stands before a constant's type.
    pub(super) fn constant(self) -> &'static str {
        match self {
            Self::GlslEs300 | Self::Glsl450 => "const ",
            Self::Hlsl => "static const ",
            Self::Msl => "constant ",
        }
    }

    /// What stands before a function's result.
    pub(super) fn function(self) -> &'static str {
        match self {
            Self::GlslEs300 | Self::Glsl450 | Self::Hlsl => "",
            // Files are included in several sources of one library.
            Self::Msl => "inline ",
        }
    }

    pub(super) fn type_name(self, kind: &Type) -> String {
        match (self, kind) {
            (_, Type::Struct(name)) => name.clone(),
            (_, Type::Nothing) => "void".to_owned(),
            (_, Type::Scalar(of)) => scalar(*of).to_owned(),
            (_, Type::Vector(size, of)) if self.is_glsl() => {
                let prefix = match of {
                    Scalar::Bool => "b",
                    Scalar::I32 => "i",
                    Scalar::U32 => "u",
                    Scalar::F32 => "",
                };
                format!("{prefix}vec{size}")
            }
            (_, Type::Vector(size, of)) => format!("{}{size}", scalar(*of)),
            (_, Type::Matrix(size)) if self.is_glsl() => format!("mat{size}"),
            (_, Type::Matrix(size)) => format!("float{size}x{size}"),
            (Self::GlslEs300, Type::Texture) => "sampler2D".to_owned(),
            (Self::Glsl450, Type::Texture) => "texture2D".to_owned(),
            (Self::Hlsl, Type::Texture) => "Texture2D".to_owned(),
            (Self::Msl, Type::Texture) => "texture2d<float>".to_owned(),
        }
    }
}

fn scalar(of: Scalar) -> &'static str {
    match of {
        Scalar::Bool => "bool",
        Scalar::I32 => "int",
        Scalar::U32 => "uint",
        Scalar::F32 => "float",
    }
}
