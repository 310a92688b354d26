//! `velour fit`: the tables from nothing.

use std::fs;

use indicatif::{ProgressBar, ProgressStyle};
use velour::fit;
use velour::picture::{check_writable, write_atomically};

use crate::args::Fit;
use crate::{Failure, say};

pub fn fit(arguments: &Fit) -> Result<(), Failure> {
    let folder = &arguments.output;
    let made = fs::create_dir_all(folder);
    made.map_err(|error| Failure::input(format!("{}: the folder cannot be made ({error})", folder.display())))?;
    let [csv, dds] = ["sheen_ltc.csv", "sheen_ltc.dds"].map(|name| folder.join(name));
    for path in [&csv, &dds] {
        check_writable(path).map_err(Failure::input)?;
    }
    // Drawn on a terminal only.
    let bar = ProgressBar::new(0);
    if let Ok(style) = ProgressStyle::with_template("{wide_bar} {pos}/{len} steps, {eta} left") {
        bar.set_style(style);
    }
    let (table, report) = fit::sheen(arguments.resolution.into(), |done, all| {
        bar.set_length(all as u64);
        bar.set_position(done as u64);
    });
    bar.finish_and_clear();
    write_atomically(&csv, table.to_csv(&report.header()).as_bytes()).map_err(Failure::input)?;
    write_atomically(&dds, &table.to_dds()).map_err(Failure::input)?;
    say(report);
    say(format!("wrote {} and {}", csv.display(), dds.display()));
    Ok(())
}
