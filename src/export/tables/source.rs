//! Sources of programs that hold a table: made to be pasted.

use std::fmt::Display;

use half::f16;

use super::form::Form;
use super::texture::Texture;

/// The licence of what is made to be copied, as an SPDX expression.
pub(super) const LICENCE: &str = "MIT OR Apache-2.0 OR 0BSD";

/// An object that is exported, whose `data` takes a texture of halves as it is: `new DataTexture(data, width, height, RGBAFormat, HalfFloatType)`
/// of three.js, say.
pub fn js(texture: &Texture) -> String {
    let [width, height] = texture.size;
    let name = camel_case(&texture.stem);
    let data = lines(texture, texture.halves().map(|texel| list(texel.map(f16::to_bits))));
    format!(
        "{}export const {name} = {{ width: {width}, height: {height}, data: new Uint16Array([\n{data}]) }};\n",
        head(texture, Form::Js)
    )
}

/// `static const float NAME[NAME_HEIGHT][NAME_WIDTH][4]`, in C89 and all that came after, and in C++.
pub fn c(texture: &Texture) -> String {
    let [width, height] = texture.size;
    let (name, upper) = (&texture.stem, texture.stem.to_uppercase());
    let texel = |texel: &[f64; 4]| format!("{{{}}}", list(texel.map(|value| format!("{value:?}f"))));
    let rows = brackets(texture, texture.texels.iter().map(texel), ["{", "}"]);
    let head: String =
        head(texture, Form::C).lines().map(|line| format!("/* {} */\n", line.trim_start_matches("// "))).collect();
    format!(
        "{head}#ifndef {upper}_H\n#define {upper}_H\n\n#define {upper}_WIDTH {width}\n#define {upper}_HEIGHT {height}\n\n\
         static const float {name}[{upper}_HEIGHT][{upper}_WIDTH][4] = {{\n{rows}}};\n\n#endif\n"
    )
}

/// `pub static NAME: [[[f32; 4]; WIDTH]; HEIGHT]`: a static, since a constant would be copied to wherever it is named.
pub fn rust(texture: &Texture) -> String {
    let [width, height] = texture.size;
    let upper = texture.stem.to_uppercase();
    let texel = |texel: &[f64; 4]| format!("[{}]", list(texel.map(|value| format!("{value:?}"))));
    let rows = brackets(texture, texture.texels.iter().map(texel), ["[", "]"]);
    format!(
        "{}#[rustfmt::skip]\npub static {upper}: [[[f32; 4]; {width}]; {height}] = [\n{rows}];\n",
        head(texture, Form::Rust)
    )
}

/// A constant array of packed halves, and the function that reads a texel of it.
pub fn glsl(texture: &Texture) -> String {
    let [width, height] = texture.size;
    let (name, upper, count) = (&texture.stem, texture.stem.to_uppercase(), width * height);
    let pack = |[low, high]: [f16; 2]| u32::from(low.to_bits()) | u32::from(high.to_bits()) << 16;
    let texel = |[r, g, b, a]: [f16; 4]| format!("uvec2({:#x}u, {:#x}u)", pack([r, g]), pack([b, a]));
    let data = lines(texture, texture.halves().map(texel));
    // The array's last element takes no comma.
    let data = data.trim_end().trim_end_matches(',');
    format!(
        "{}const highp uvec2 {upper}[{count}] = uvec2[{count}](\n{data}\n);\n\n\
         // The texel in column x of {width} and row y of {height}.\nhighp vec4 {name}_texel(int x, int y) {{\n    \
         highp uvec2 halves = {upper}[{width} * y + x];\n    \
         return vec4(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y));\n}}\n",
        head(texture, Form::Glsl)
    )
}

/// Whose it is, what it is, and how it lies.
fn head(texture: &Texture, form: Form) -> String {
    format!(
        "// SPDX-License-Identifier: {LICENCE}\n// SPDX-FileCopyrightText: 2026 The Velour authors\n// {}\n",
        texture.layout(form)
    )
}

fn list<const N: usize>(values: [impl Display; N]) -> String {
    values.map(|value| value.to_string()).join(", ")
}

/// A row of texels a line, each with a comma after it.
fn lines(texture: &Texture, texels: impl Iterator<Item = String>) -> String {
    let texels: Vec<String> = texels.collect();
    texels.chunks(texture.size[0]).map(|row| format!("    {},\n", row.join(", "))).collect()
}

/// The same, with a row's texels between brackets.
fn brackets(texture: &Texture, texels: impl Iterator<Item = String>, [open, close]: [&str; 2]) -> String {
    let texels: Vec<String> = texels.collect();
    texels.chunks(texture.size[0]).map(|row| format!("    {open}{}{close},\n", row.join(", "))).collect()
}

/// `sheen_ltc` as `sheenLtc`.
fn camel_case(stem: &str) -> String {
    let mut words = stem.split('_');
    let first = words.next().unwrap_or_default().to_owned();
    words.fold(first, |name, word| name + &word[..1].to_uppercase() + &word[1..])
}
