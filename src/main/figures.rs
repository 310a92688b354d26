//! `velour figures`: the table and its errors as pictures.

use velour::figures;
use velour::picture::write_atomically;
use velour::table::LtcTable;

use crate::args::Figures;
use crate::{Failure, output, say};

pub fn figures(arguments: &Figures) -> Result<(), Failure> {
    let paths = output::paths(&arguments.output, figures::NAMES)?;
    let bar = output::progress_bar();
    let figures = figures::all(&LtcTable::embedded(), |done, all| {
        bar.set_length(all as u64);
        bar.set_position(done as u64);
    });
    bar.finish_and_clear();
    for (figure, path) in figures.iter().zip(&paths) {
        write_atomically(path, figure.svg.as_bytes()).map_err(Failure::input)?;
        say(format!("{}: {}", path.display(), figure.caption));
    }
    Ok(())
}
