//! How a picture is saved, and how that is kept from one run to the next.

use serde::{Deserialize, Serialize};

use crate::picture::Format;
use crate::renderer::SAMPLES;

/// Most samples a pixel that can be asked for.
pub const MOST_SAMPLES: u32 = 1024;
/// The longest side that any device draws, in pixels.
pub const LONGEST: u32 = 1 << 16;

/// Size, samples and format of a picture, and the folder that it is written to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Width and height in pixels, each at least 1; none for the size in which the window shows it.
    pub size: Option<[u32; 2]>,
    /// A pixel, in [1, [`MOST_SAMPLES`]].
    pub samples: u32,
    pub format: Format,
    /// As the user writes it; none for the one that the program was started in.
    pub folder: Option<String>,
}

impl Default for Settings {
    /// As `velour render` has it where nobody says otherwise, but for the size.
    fn default() -> Self {
        Self { size: None, samples: SAMPLES, format: Format::Png, folder: None }
    }
}

/// The settings as they are written down.
#[derive(Deserialize, Serialize)]
struct Kept {
    size: Option<[u32; 2]>,
    samples: u32,
    format: String,
    folder: Option<String>,
}

/// What a format's files end in.
pub fn extension(format: Format) -> &'static str {
    match format {
        Format::Png => "png",
        Format::Exr => "exr",
    }
}

impl Settings {
    /// The settings as a text.
    pub fn to_text(&self) -> String {
        let Self { size, samples, format, folder } = self.clone();
        toml::to_string(&Kept { size, samples, format: extension(format).to_owned(), folder }).unwrap_or_default()
    }

    /// The settings in a text; none where they cannot be used.
    pub fn from_text(text: &str) -> Option<Self> {
        let Kept { size, samples, format, folder } = toml::from_str(text).ok()?;
        let format = [Format::Png, Format::Exr].into_iter().find(|listed| extension(*listed) == format)?;
        let is_usable = (1..=MOST_SAMPLES).contains(&samples)
            && size.is_none_or(|size| size.iter().all(|side| (1..=LONGEST).contains(side)));
        is_usable.then_some(Self { size, samples, format, folder })
    }

    /// The name of a file: the extension is the format's, whether the user has written one or not.
    pub fn file_name(&self, name: &str) -> String {
        let name = name.trim();
        let has_extension = [Format::Png, Format::Exr].into_iter().map(extension).find(|extension| {
            let start = name.len().checked_sub(extension.len() + 1).filter(|start| name.is_char_boundary(*start));
            start.is_some_and(|start| start > 0 && name[start..].eq_ignore_ascii_case(&format!(".{extension}")))
        });
        let stem = has_extension.map_or(name, |extension| &name[..name.len() - extension.len() - 1]);
        format!("{stem}.{}", extension(self.format))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_is_what_was_set() {
        for settings in [
            Settings::default(),
            Settings {
                size: Some([3840, 2160]),
                samples: MOST_SAMPLES,
                format: Format::Exr,
                folder: Some("/a/it's \"größe\"\\\n".to_owned()),
            },
        ] {
            assert_eq!(Settings::from_text(&settings.to_text()).as_ref(), Some(&settings), "{}", settings.to_text());
        }
    }

    #[test]
    fn what_cannot_be_used_is_nothing() {
        let text = |size: &str, samples: &str, format: &str| {
            format!("size = {size}\nsamples = {samples}\nformat = \"{format}\"\n")
        };
        assert!(Settings::from_text(&text("[1, 65536]", "1", "png")).is_some());
        for (size, samples, format) in [
            ("[0, 1]", "1", "png"),
            ("[1, 65537]", "1", "png"),
            ("[1]", "1", "png"),
            ("[1, 1]", "0", "png"),
            ("[1, 1]", "1025", "png"),
            ("[1, 1]", "-1", "png"),
            ("[1, 1]", "1", "jpg"),
        ] {
            assert_eq!(Settings::from_text(&text(size, samples, format)), None, "{size} {samples} {format}");
        }
        assert_eq!(["", "=", "samples = 3"].map(Settings::from_text), [const { None }; 3]);
    }

    #[test]
    fn files_end_as_their_format_does() {
        let [png, exr] = [Format::Png, Format::Exr].map(|format| Settings { format, ..Settings::default() });
        for (name, as_png, as_exr) in [
            ("a", "a.png", "a.exr"),
            ("a.png", "a.png", "a.exr"),
            (" a.b.EXR ", "a.b.png", "a.b.exr"),
            ("a.jpg", "a.jpg.png", "a.jpg.exr"),
            (".png", ".png.png", ".png.exr"),
            ("größe", "größe.png", "größe.exr"),
            ("é", "é.png", "é.exr"),
        ] {
            assert_eq!([png.file_name(name), exr.file_name(name)], [as_png, as_exr]);
        }
    }
}
