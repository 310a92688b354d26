//! `velour fit`: the tables from nothing.

use velour::fit;
use velour::picture::write_atomically;

use crate::args::Fit;
use crate::{Failure, output, say};

pub fn fit(arguments: &Fit) -> Result<(), Failure> {
    let [csv, dds] = output::paths(&arguments.output, ["sheen_ltc.csv", "sheen_ltc.dds"])?;
    let bar = output::progress_bar();
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
