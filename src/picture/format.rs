//! The formats of picture files.

use std::fmt;
use std::path::{Path, PathBuf};

/// The kinds of picture files that are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Shown values: sRGB, 8 bits a channel.
    Png,
    /// Linear radiance: OpenEXR, 32-bit floats.
    Exr,
}

impl Format {
    /// The format that the file name's extension names, whether in capitals or not; an error where it names neither.
    pub fn of(path: &Path) -> Result<Self, FormatError> {
        let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
        match extension.to_ascii_lowercase().as_str() {
            "png" => Ok(Self::Png),
            "exr" => Ok(Self::Exr),
            _ => Err(FormatError::Extension { path: path.to_owned() }),
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str(match self {
            Self::Png => "PNG",
            Self::Exr => "OpenEXR",
        })
    }
}

/// A picture could not be put into a file's format.
#[derive(Debug, thiserror::Error)]
pub enum FormatError {
    /// The file name's extension names no format.
    #[error("{}: the extension says what to write: use .png or .exr", path.display())]
    Extension {
        /// The picture's place.
        path: PathBuf,
    },
    /// The encoder refuses the picture.
    #[error("the picture cannot be encoded as {format} ({source})")]
    Encode {
        /// The format that was asked for.
        format: Format,
        /// The encoder's reason.
        source: image::ImageError,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_names_the_format() {
        assert_eq!(Format::of(Path::new("a/b.PNG")).unwrap(), Format::Png);
        assert_eq!(Format::of(Path::new("b.exr")).unwrap(), Format::Exr);
        for name in ["b.jpg", "b", "png", ".png"] {
            assert!(Format::of(Path::new(name)).is_err(), "{name}");
        }
    }
}
