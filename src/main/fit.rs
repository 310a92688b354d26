//! `velour fit`: the tables from nothing.

use std::fs;

use indicatif::{ProgressBar, ProgressStyle};
use velour::fit::{self, Report, SheenOptions};
use velour::picture::{check_writable, write_atomically};

use crate::Failure;
use crate::args::Fit;

/// What stands at the head of the table's .csv before its errors.
const HEAD: [&str; 6] = [
    "The sheen of a slab of fibres (Zeltner, Burley, Chiang 2022) as linearly transformed cosines.",
    "alpha: roughness; mu: cosine of the view to the normal; node k of n at k/(n-1). mu = 0 is computed at 0.001, alpha = 0 is for",
    "interpolation only. Inverse matrix, rows (a,0,b), (0,a,0), (0,0,1), x along the view on the surface; r: albedo at the node.",
    "Lobes: single scattering in closed form, all other orders by random walk; a, b by least squares over the hemisphere. Where fewer",
    "than 1000 such paths come back, a follows the power of alpha of its neighbours of larger alpha, and b is the nearest one's.",
    "Made by: velour fit",
];

pub fn fit(arguments: &Fit) -> Result<(), Failure> {
    let folder = &arguments.output;
    let made = fs::create_dir_all(folder);
    made.map_err(|error| Failure::input(format!("{}: the folder cannot be made ({error})", folder.display())))?;
    let [csv, dds] = ["sheen_ltc.csv", "sheen_ltc.dds"].map(|name| folder.join(name));
    for path in [&csv, &dds] {
        check_writable(path).map_err(Failure::input)?;
    }
    let options = SheenOptions { resolution: arguments.resolution.into(), ..Default::default() };
    // Drawn on a terminal only.
    let bar = ProgressBar::new(0);
    if let Ok(style) = ProgressStyle::with_template("{wide_bar} {pos}/{len} lobes, {eta} left") {
        bar.set_style(style);
    }
    let (table, report) = fit::sheen(&options, |done, all| {
        bar.set_length(all as u64);
        bar.set_position(done as u64);
    });
    bar.finish_and_clear();
    write_atomically(&csv, table.to_csv(&head(&options, &report)).as_bytes()).map_err(Failure::input)?;
    write_atomically(&dds, &table.to_dds()).map_err(Failure::input)?;
    println!("{report}");
    println!("wrote {} and {}", csv.display(), dds.display());
    Ok(())
}

/// Axes, meaning, the command and the errors; no folder, so that the file is the same wherever it is made.
fn head(options: &SheenOptions, report: &Report) -> Vec<String> {
    let mut head: Vec<String> = HEAD.iter().map(|line| line.to_string()).collect();
    if *options != SheenOptions::default() {
        head[HEAD.len() - 1] += &format!(" --resolution {}", options.resolution);
    }
    head.extend(report.to_string().lines().map(str::to_owned));
    head
}
