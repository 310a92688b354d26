//! `velour export tables`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use velour::export::tables::{Form, SIDES, Texture, resampled, resampled_stem};
use velour::file::write_atomically;

use crate::console::say;
use crate::failure::Failure;
use crate::output::prepare;

/// The flags of `velour export tables`.
#[derive(Args)]
pub struct Tables {
    /// Folder of the files; made if it is not there
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// The form; several times for several [default: all]
    #[arg(long, value_enum)]
    format: Vec<Format>,
    /// Which table: the sheen's (alpha along x, mu along y), or the specular base's (roughness along x, sqrt(1 - mu) along y) [default: both]
    #[arg(long, value_enum)]
    only: Option<Table>,
    /// Nodes a side of the sheen's table, 2 to 128: resampled by least squares, with the difference printed, and named sheen_ltc_N
    /// [default: 32, as shipped]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(*SIDES.start() as i64..=*SIDES.end() as i64))]
    size: Option<u16>,
}

#[derive(Clone, Copy, ValueEnum, PartialEq)]
enum Table {
    Sheen,
    Ggx,
}

/// A form, with what a file of it cannot say of itself.
#[derive(Clone, Copy, ValueEnum)]
enum Format {
    /// RGBA16F, DX10 header of 148 bytes, little-endian, first row y = 0
    Dds,
    /// RGBA16F without supercompression, little-endian, first row y = 0
    Ktx2,
    /// Text: a line for each node, the x axis slowest
    Csv,
    /// NumPy: little-endian f4, shape (height, width, 4), so [y][x][channel]
    Npy,
    /// OpenEXR: halves in R, G, B, A, first row y = 0 at the top
    Exr,
    /// Nothing but halves: RGBA, little-endian, first row y = 0
    Bin,
    /// An ES module with a Uint16Array of halves: RGBA, first row y = 0
    Js,
    /// A header with floats by [y][x][channel]
    C,
    /// A static array of f32 by [y][x][channel]
    Rust,
    /// A constant array of packed halves for GLSL ES 3.00, GLSL 4.20 and later
    Glsl,
}

impl Format {
    fn form(self) -> Form {
        match self {
            Self::Dds => Form::Dds,
            Self::Ktx2 => Form::Ktx2,
            Self::Csv => Form::Csv,
            Self::Npy => Form::Npy,
            Self::Exr => Form::Exr,
            Self::Bin => Form::Bin,
            Self::Js => Form::Js,
            Self::C => Form::C,
            Self::Rust => Form::Rust,
            Self::Glsl => Form::Glsl,
        }
    }
}

pub fn run(arguments: &Tables) -> Result<(), Failure> {
    if arguments.size.is_some() && arguments.only == Some(Table::Ggx) {
        return Err(Failure::input("--size is the sheen's: leave it out, or --only ggx"));
    }
    let forms = forms(&arguments.format);
    let [mut sheen, ggx] = Texture::shipped();
    if let Some(size) = arguments.size {
        sheen.stem = resampled_stem(usize::from(size));
    }
    let wanted = |table| arguments.only.is_none_or(|only| only == table);
    let folder = &arguments.output;
    let names = [(Table::Sheen, &sheen), (Table::Ggx, &ggx)].into_iter().filter(|(table, _)| wanted(*table));
    let paths: Vec<PathBuf> = names.flat_map(|(_, it)| forms.iter().map(|form| folder.join(it.name(*form)))).collect();
    prepare(folder, &paths)?;
    if let Some(size) = arguments.size {
        let difference;
        (sheen, difference) = resampled(usize::from(size));
        say(difference);
    }
    let textures = [(Table::Sheen, sheen), (Table::Ggx, ggx)].into_iter().filter(|(table, _)| wanted(*table));
    for (_, texture) in textures {
        for form in &forms {
            let path = folder.join(texture.name(*form));
            write_atomically(&path, &texture.file(*form)).map_err(Failure::input)?;
            say(format!("wrote {}: {}", path.display(), texture.layout(*form)));
        }
    }
    Ok(())
}

/// The forms that are asked for, each once.
fn forms(asked: &[Format]) -> Vec<Form> {
    if asked.is_empty() {
        return Form::ALL.to_vec();
    }
    Form::ALL.into_iter().filter(|form| asked.iter().any(|format| format.form() == *form)).collect()
}
