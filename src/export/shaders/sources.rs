//! The files that are made to be copied.

use super::language::Language;
use super::refusal::Refusal;
use super::translate::translate;

/// A file that is made to be copied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Source {
    /// The name without its extension.
    pub stem: &'static str,
    /// The WGSL.
    pub text: &'static str,
    /// The stems of those without which it does not compile.
    pub needs: &'static [&'static str],
    /// What whoever copies it declares before it, as WGSL that compiles in its place; empty where it is nothing.
    pub theirs: &'static str,
    /// What the example in its header takes for granted: a function, but for its closing brace.
    pub given: &'static str,
}

impl Source {
    /// The file in another language.
    pub fn in_language(&self, language: Language) -> Result<String, Refusal> {
        let mut known: Vec<&str> = self.needed().map(|source| source.text).collect();
        known.push(self.theirs);
        translate(self.text, self.given, &known, language)
    }

    /// The WGSL before which it compiles: what it needs, and what is left to whoever copies it.
    pub fn before(&self) -> String {
        self.needed().map(|source| source.text).chain([self.theirs]).collect()
    }

    /// Those without which it does not compile.
    pub fn needed(&self) -> impl Iterator<Item = &'static Self> {
        let needs = self.needs;
        SOURCES.iter().filter(move |source| needs.contains(&source.stem))
    }
}

/// All of them, each after those that it is copied with.
pub const SOURCES: [Source; 6] = [
    Source {
        stem: "ltc",
        text: include_str!("../../../shaders/ltc.wgsl"),
        needs: &[],
        theirs: "",
        given: "fn example(frame: mat3x3<f32>, last: vec3<f32>, corner: vec3<f32>, position: vec3<f32>, m_inv: mat3x3<f32>) {
            var outline = ltc_begin(frame * (last - position));
            var sum = 0.0;
            var turn = LTC_LEVEL;",
    },
    Source {
        stem: "ltc_sample",
        text: include_str!("../../../shaders/ltc_sample.wgsl"),
        needs: &[],
        theirs: "",
        given: "struct Outline { p: vec3<f32>, q: vec3<f32>, normal: vec3<f32>, sine: f32 }
        fn example(outline: Outline, m_inv: mat3x3<f32>, number: f32, form_factor: f32) {
            var fan = ltc_sample_begin(number, form_factor);",
    },
    Source {
        stem: "sheen",
        text: include_str!("../../../shaders/sheen.wgsl"),
        needs: &[],
        theirs: "",
        given: "fn example(table: texture_2d<f32>, alpha: f32, mu: f32, light: vec3<f32>, sheen_color: vec3<f32>, form_factor: f32) {",
    },
    Source {
        stem: "sheen_fit",
        text: include_str!("../../../shaders/sheen_fit.wgsl"),
        needs: &[],
        theirs: "",
        given: "fn example(alpha: f32, mu: f32, light: vec3<f32>, sheen_color: vec3<f32>, form_factor: f32) {",
    },
    Source {
        stem: "ggx",
        text: include_str!("../../../shaders/ggx.wgsl"),
        needs: &[],
        theirs: "",
        given: "fn example(table: texture_2d<f32>, roughness: f32, mu: f32, light: vec3<f32>, f0: vec3<f32>, f90: vec3<f32>, form_factor: f32) {",
    },
    Source {
        stem: "lights",
        text: include_str!("../../../examples/lights.wgsl"),
        needs: &["ltc", "sheen", "ggx"],
        theirs: "struct LightsRange { count: u32 }
        fn lights_count(range: LightsRange) -> u32 { return range.count; }
        fn lights_corners(range: LightsRange, light: u32) -> u32 { return 3u; }
        fn lights_corner(range: LightsRange, light: u32, index: u32) -> vec3<f32> { return vec3(f32(index)); }
        fn lights_normal(range: LightsRange, light: u32) -> vec3<f32> { return vec3(0.0, 0.0, 1.0); }
        fn lights_radiance(range: LightsRange, light: u32) -> vec3<f32> { return vec3(1.0); }
        fn lights_two_sided(range: LightsRange, light: u32) -> bool { return false; }",
        given: "fn example(sheen_table: texture_2d<f32>, ggx_table: texture_2d<f32>, range: LightsRange, surface: LightsSurface) {",
    },
];
