//! `velour export tables`.

use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
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
    #[arg(long, value_parser = form_parser())]
    format: Vec<Form>,
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

/// A form by its name, with what a file of it may not say of itself.
fn form_parser() -> impl TypedValueParser<Value = Form> {
    let values = Form::ALL.map(|form| PossibleValue::new(form.name()).help(form.encoding()));
    let named = |name: String| Form::ALL.into_iter().find(|form| form.name() == name);
    PossibleValuesParser::new(values).map(move |name| named(name).expect("it is one of these names"))
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
fn forms(asked: &[Form]) -> Vec<Form> {
    if asked.is_empty() {
        return Form::ALL.to_vec();
    }
    Form::ALL.into_iter().filter(|form| asked.contains(form)).collect()
}
