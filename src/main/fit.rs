//! `velour fit`: the tables from nothing.

use std::fmt::Display;
use std::path::{Path, PathBuf};

use velour::fit;
use velour::picture::write_atomically;
use velour::table::{LtcTable, SlabTable};

use crate::args::{Fit, Table};
use crate::output::{self, with_progress};
use crate::{Failure, say};

pub fn fit(arguments: &Fit) -> Result<(), Failure> {
    let tables = match arguments.only {
        Some(table) => vec![table],
        None => vec![Table::Sheen, Table::Slab],
    };
    for table in tables {
        match table {
            Table::Sheen => sheen(arguments)?,
            Table::Slab => slab(arguments)?,
        }
    }
    Ok(())
}

/// Half-float steps between what this machine makes and what another one may have made.
const ROUNDING: u32 = 1;

fn sheen(arguments: &Fit) -> Result<(), Failure> {
    let paths = ["sheen_ltc.csv", "sheen_ltc.dds"].map(|name| arguments.output.join(name));
    let found = files(arguments, &paths, |path| LtcTable::load(path).map_err(Failure::input))?;
    let (table, report) = with_progress("sheen", |step| fit::sheen(arguments.resolution.into(), step));
    if arguments.check {
        return paths.iter().zip(found).try_for_each(|(path, found)| compared(path, found.half_steps(&table)));
    }
    let [csv, dds] = &paths;
    write_atomically(csv, table.to_csv(&report.header()).as_bytes()).map_err(Failure::input)?;
    write_atomically(dds, &table.to_dds()).map_err(Failure::input)?;
    wrote(&paths, report);
    Ok(())
}

fn slab(arguments: &Fit) -> Result<(), Failure> {
    let paths = [arguments.output.join("sheen_slab.dds")];
    let found = files(arguments, &paths, |path| SlabTable::load(path).map_err(Failure::input))?;
    let (table, report) = with_progress("slab", |step| fit::slab::slab(step));
    if arguments.check {
        return paths.iter().zip(found).try_for_each(|(path, found)| compared(path, Some(found.half_steps(&table))));
    }
    write_atomically(&paths[0], &table.to_dds()).map_err(Failure::input)?;
    wrote(&paths, report);
    Ok(())
}

/// What can fail comes before the work: with `--check` the files are read, else it is seen that they can be written.
fn files<T>(arguments: &Fit, paths: &[PathBuf], load: impl Fn(&Path) -> Result<T, Failure>) -> Result<Vec<T>, Failure> {
    if arguments.check {
        return paths.iter().map(|path| load(path)).collect();
    }
    output::prepare(&arguments.output, paths)?;
    Ok(vec![])
}

/// Says how a file compares with the table that the program makes; `steps` is none where their sizes differ.
fn compared(path: &Path, steps: Option<u32>) -> Result<(), Failure> {
    let path = path.display();
    match steps {
        None => Err(Failure::check(format!("{path}: has another size than what the program makes; see --resolution"))),
        Some(steps) if steps > ROUNDING => Err(Failure::check(format!(
            "{path}: is not what the program makes, up to {steps} half-float steps off; without --check it is made anew"
        ))),
        Some(steps) => {
            say(format!("{path}: is what the program makes, to {steps} half-float steps"));
            Ok(())
        }
    }
}

fn wrote(paths: &[PathBuf], report: impl Display) {
    say(report);
    let names: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
    say(format!("wrote {}", names.join(" and ")));
}
