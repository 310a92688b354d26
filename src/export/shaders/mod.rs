//! The files at the top of `shaders/`, in other languages.

/// A file that is made to be copied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Source {
    /// The name without its extension.
    pub stem: &'static str,
    /// The WGSL.
    pub text: &'static str,
}

/// All of them, each after those that it is copied with.
pub const SOURCES: [Source; 4] = [
    Source { stem: "ltc", text: include_str!("../../../shaders/ltc.wgsl") },
    Source { stem: "ltc_sample", text: include_str!("../../../shaders/ltc_sample.wgsl") },
    Source { stem: "sheen", text: include_str!("../../../shaders/sheen.wgsl") },
    Source { stem: "ggx", text: include_str!("../../../shaders/ggx.wgsl") },
];
