//! `velour figures`: the table and its errors as pictures.

use velour::figures;
use velour::picture::write_atomically;
use velour::table::LtcTable;

use crate::args::Figures;
use crate::output::{prepare, with_progress};
use crate::{Failure, say};

pub fn figures(arguments: &Figures) -> Result<(), Failure> {
    let folder = &arguments.output;
    let paths = figures::NAMES.map(|name| folder.join(name));
    prepare(folder, &paths)?;
    let figures = with_progress("figures", |step| figures::all(&LtcTable::embedded(), step));
    for (figure, path) in figures.iter().zip(&paths) {
        write_atomically(path, figure.svg.as_bytes()).map_err(Failure::input)?;
        say(format!("{}: {}", path.display(), figure.caption));
    }
    Ok(())
}
