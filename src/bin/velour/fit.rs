//! `velour fit`: the tables from nothing.

use std::fmt::Display;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use velour::file::write_atomically;
use velour::fit;
use velour::table::{GgxTable, SheenTable, SlabTable, TableError};

use crate::console::say;
use crate::failure::Failure;
use crate::output::prepare;
use crate::progress::with_progress;

/// The flags of `velour fit`.
#[derive(Args)]
pub struct Fit {
    /// Folder of the tables; made if it is not there
    #[arg(short, long, default_value = "tables", value_name = "DIR")]
    pub output: PathBuf,
    /// Which table: sheen is sheen_ltc.csv and .dds, slab is sheen_slab.dds, ggx is ggx_ltc.csv and .dds [default: all]
    #[arg(long, value_enum, value_name = "sheen|slab|ggx")]
    pub only: Option<Table>,
    /// Nodes along alpha and along mu of the sheen's table, 2 to 128 [default: 32]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(resolutions()))]
    pub resolution: Option<u16>,
    /// Writes nothing: compares the folder's tables with what would be written, to one half-float step
    #[arg(long)]
    pub check: bool,
}

/// Of the sheen's table.
pub fn resolutions() -> RangeInclusive<i64> {
    let side = |side: &usize| *side as i64;
    side(fit::RESOLUTIONS.start())..=side(fit::RESOLUTIONS.end())
}

#[derive(Clone, Copy, ValueEnum, PartialEq)]
pub enum Table {
    Sheen,
    Slab,
    Ggx,
}

/// Half-float steps by which this machine's numbers may differ from another's.
const ROUNDING: u32 = 1;

/// What can fail comes before the work, for all tables. A check reports every file, and fails once.
pub fn run(arguments: &Fit) -> Result<(), Failure> {
    if arguments.resolution.is_some() && arguments.only.is_some_and(|only| only != Table::Sheen) {
        return Err(Failure::input("--resolution is the sheen's: leave it out, or with it --only"));
    }
    let sheen = Files::of(arguments, Table::Sheen, &["sheen_ltc.csv", "sheen_ltc.dds"], |path| SheenTable::load(path))?;
    let slab = Files::of(arguments, Table::Slab, &["sheen_slab.dds"], |path| SlabTable::load(path))?;
    let ggx = Files::of(arguments, Table::Ggx, &["ggx_ltc.csv", "ggx_ltc.dds"], |path| GgxTable::load(path))?;
    let mut wrong = Vec::new();
    if let Some(files) = sheen {
        let resolution = arguments.resolution.map_or(fit::RESOLUTION, usize::from);
        let (table, report) = with_progress("sheen", |step| fit::sheen::fit(resolution, step));
        wrong.extend(files.check(|found| found.half_steps(&table)));
        let csv = || table.to_csv(&report.header()).into_bytes();
        files.write(arguments, &[&csv, &|| table.to_dds()], &report)?;
    }
    if let Some(files) = slab {
        let (table, report) = with_progress("slab", |step| fit::slab::fit(step));
        wrong.extend(files.check(|found| Some(found.half_steps(&table))));
        files.write(arguments, &[&|| table.to_dds()], &report)?;
    }
    if let Some(files) = ggx {
        let (table, report) = with_progress("ggx", |step| fit::ggx::fit(fit::RESOLUTION, step));
        wrong.extend(files.check(|found| found.half_steps(&table)));
        let csv = || table.to_csv(&report.header()).into_bytes();
        files.write(arguments, &[&csv, &|| table.to_dds()], &report)?;
    }
    if wrong.is_empty() { Ok(()) } else { Err(Failure::check(wrong.join("; "))) }
}

/// The files of a table.
struct Files<T> {
    paths: Vec<PathBuf>,
    /// What they hold, where that is checked.
    found: Vec<T>,
}

impl<T> Files<T> {
    /// None where the table is not asked for. With `--check` the files are read; otherwise it is checked that they can
    /// be written.
    fn of(
        arguments: &Fit,
        table: Table,
        names: &[&str],
        load: impl Fn(&Path) -> Result<T, TableError>,
    ) -> Result<Option<Self>, Failure> {
        if arguments.only.is_some_and(|only| only != table) {
            return Ok(None);
        }
        let paths: Vec<PathBuf> = names.iter().map(|name| arguments.output.join(name)).collect();
        let mut found = Vec::new();
        if arguments.check {
            for path in &paths {
                found.push(load(path).map_err(Failure::input)?);
            }
        } else {
            prepare(&arguments.output, &paths)?;
        }
        Ok(Some(Self { paths, found }))
    }

    /// Says which of the files that were read hold the table, and gives what is wrong with the others. `steps` is how
    /// many half-floats they are off, none where the sizes differ.
    fn check(&self, steps: impl Fn(&T) -> Option<u32>) -> Vec<String> {
        let mut wrong = Vec::new();
        for (path, found) in self.paths.iter().zip(&self.found) {
            let path = path.display();
            match steps(found) {
                None => wrong.push(format!("{path}: has another size than what the program makes: see --resolution")),
                Some(steps) if steps > ROUNDING => wrong.push(format!(
                    "{path}: is not what the program makes, up to {steps} half-float steps off: without --check it is made anew"
                )),
                Some(steps) => say(format!("{path}: is what the program makes, to {steps} half-float steps")),
            }
        }
        wrong
    }

    /// Writes the files, unless they were only to be checked.
    fn write(&self, arguments: &Fit, bytes: &[&dyn Fn() -> Vec<u8>], report: &impl Display) -> Result<(), Failure> {
        if arguments.check {
            return Ok(());
        }
        for (path, bytes) in self.paths.iter().zip(bytes) {
            write_atomically(path, &bytes()).map_err(Failure::input)?;
        }
        say(report);
        let names: Vec<String> = self.paths.iter().map(|path| path.display().to_string()).collect();
        say(format!("wrote {}", names.join(" and ")));
        Ok(())
    }
}
