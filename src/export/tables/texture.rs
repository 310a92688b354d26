//! A table as what all forms share: its texels, and what they mean.

use half::f16;

use super::form::Form;
use crate::table::{GgxTable, SheenTable};

/// A table as texels.
#[derive(Clone, Debug)]
pub struct Texture {
    /// The name without an extension; in sources, the array's.
    pub stem: String,
    /// Texels along x and y.
    pub size: [usize; 2],
    /// Row by row, as the .csv has them.
    pub texels: Vec<[f64; 4]>,
    /// What it is, and what its axes and channels are: a sentence without its full stop.
    pub(super) meaning: String,
    pub(super) csv: String,
    pub(super) dds: Vec<u8>,
}

impl Texture {
    /// The tables that are shipped: the sheen's, the specular base's.
    pub fn shipped() -> [Self; 2] {
        let sheen = include_str!("../../../tables/sheen_ltc.csv");
        let ggx = include_str!("../../../tables/ggx_ltc.csv");
        [Self::sheen(&SheenTable::embedded(), sheen.to_owned()), Self::ggx(&GgxTable::embedded(), ggx.to_owned())]
    }

    /// The sheen's table, with its text.
    pub fn sheen(table: &SheenTable, csv: String) -> Self {
        let [width, height] = table.size();
        let texel = |x: usize, y: usize| {
            let [a, b, r] = table.cell(x, y);
            [a, b, r, 1.0]
        };
        let meaning = format!(
            "The sheen's transformed cosines: {width} x {height} texels a, b, r, 1; x = alpha with node k at k/{}, y = mu with node k at k/{}",
            width - 1,
            height - 1
        );
        let texels = rows([width, height], texel).collect();
        Self { stem: "sheen_ltc".to_owned(), size: [width, height], texels, meaning, csv, dds: table.to_dds() }
    }

    /// The specular base's table, with its text: two parts, one above the other.
    pub fn ggx(table: &GgxTable, csv: String) -> Self {
        let [width, height] = table.size();
        let shape = |x: usize, y: usize| {
            let [u, v, s, ..] = table.cell(x, y);
            [u, v, s, 1.0]
        };
        let share = |x: usize, y: usize| {
            let [.., albedo, fresnel] = table.cell(x, y);
            [albedo, fresnel, 0.0, 1.0]
        };
        let meaning = format!(
            "The specular base's transformed cosines: {width} x {} texels, in the first {height} rows u, v, s, 1, in the others albedo, fresnel, 0, 1; \
             x = roughness with node k at k/{}, y in each half = sqrt(1 - mu) with node k at k/{}",
            2 * height,
            width - 1,
            height - 1
        );
        let texels = rows([width, height], shape).chain(rows([width, height], share)).collect();
        Self { stem: "ggx_ltc".to_owned(), size: table.texture_size(), texels, meaning, csv, dds: table.to_dds() }
    }

    /// The file's name.
    pub fn name(&self, form: Form) -> String {
        format!("{}.{}", self.stem, form.extension())
    }

    /// One sentence that says all about a file: axes, nodes, channels, order of numbers and bytes.
    pub fn layout(&self, form: Form) -> String {
        match form {
            Form::Csv => format!("{}.", form.encoding()),
            _ => format!("{}; {}.", self.meaning, form.encoding()),
        }
    }

    /// The texels rounded to halves, as they are in the .dds.
    pub fn halves(&self) -> impl Iterator<Item = [f16; 4]> {
        self.texels.iter().map(|texel| texel.map(f16::from_f64))
    }

    /// The halves, little-endian.
    pub(super) fn half_bytes(&self) -> Vec<u8> {
        self.halves().flatten().flat_map(f16::to_le_bytes).collect()
    }
}

/// Texels row by row.
fn rows([width, height]: [usize; 2], texel: impl Fn(usize, usize) -> [f64; 4]) -> impl Iterator<Item = [f64; 4]> {
    (0..width * height).map(move |index| texel(index % width, index / width))
}
