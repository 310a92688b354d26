//! `velour figures`: the table and its errors, the paper's figures and our comparisons as pictures, and a page that
//! shows them.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use clap::Args;
use serde_json::{Map, Value, json};
use velour::figures::{self, Figure, plates};
use velour::file::write_atomically;
use velour::table::SheenTable;

use crate::comment::command;
use crate::console::say;
use crate::failure::Failure;
use crate::interrupt::{ENDING, listen};
use crate::output::prepare;
use crate::progress::with_progress;

/// The flags of `velour figures`.
#[derive(Args)]
pub struct Figures {
    /// Folder for the pictures; made if it is not there
    #[arg(short, long, default_value = "figures", value_name = "DIR")]
    pub output: PathBuf,
}

/// The page's file.
const PAGE: &str = "README.md";

pub fn run(arguments: &Figures) -> Result<(), Failure> {
    let folder = &arguments.output;
    let plates = plates::plates();
    let beside = |name: &str| [folder.join(format!("{name}.png")), folder.join(format!("{name}.json"))];
    let mut paths: Vec<PathBuf> = figures::NAMES.iter().map(|name| folder.join(name)).collect();
    paths.extend(plates.iter().flat_map(|plate| beside(&plate.name)));
    paths.extend([PAGE, figures::fibres::NAME, "fibres.json"].map(|name| folder.join(name)));
    prepare(folder, &paths)?;
    let drawn = drawn(folder)?;
    listen();
    for plate in &plates {
        let [picture, settings] = beside(&plate.name);
        let wanted = described(&plate.settings);
        if picture.is_file() && fs::read_to_string(&settings).is_ok_and(|found| found == wanted) {
            say(format!("{}: is there", picture.display()));
            continue;
        }
        let image = with_progress("figures", |step| {
            plate.make(&|done, all| {
                step(done as usize, all as usize);
                !ENDING.load(Ordering::Relaxed)
            })
        });
        let image = image.map_err(|error| match error {
            plates::PlateError::Interrupted => Failure::check(error),
            _ => Failure::input(error),
        });
        let bytes = image?.to_png_with_comment(&command()).map_err(Failure::input)?;
        // Settings come last: a picture without them is made again.
        write_atomically(&picture, &bytes).map_err(Failure::input)?;
        write_atomically(&settings, wanted.as_bytes()).map_err(Failure::input)?;
        let settings: Vec<String> = plate.settings.iter().map(|(name, value)| format!("{name} {value}")).collect();
        say(format!("{}: {}", picture.display(), settings.join("; ")));
    }
    let page = folder.join(PAGE);
    write_atomically(&page, plates::page(&drawn).as_bytes()).map_err(Failure::input)?;
    say(format!("{}: shows them all", page.display()));
    Ok(())
}

/// The figures that are drawings: those of the table take seconds and are always made; that of the fibres takes a
/// minute and is made only where it is missing.
fn drawn(folder: &Path) -> Result<Vec<Figure>, Failure> {
    let mut figures = with_progress("figures", |step| figures::all(&SheenTable::embedded(), step));
    for figure in &figures {
        let path = folder.join(figure.name);
        write_atomically(&path, figure.svg.as_bytes()).map_err(Failure::input)?;
        say(format!("{}: {}", path.display(), figure.caption));
    }
    figures.push(fibres(folder)?);
    Ok(figures)
}

fn fibres(folder: &Path) -> Result<Figure, Failure> {
    let path = folder.join(figures::fibres::NAME);
    let settings = path.with_extension("json");
    let found = fs::read(&settings).ok().and_then(|bytes| serde_json::from_slice::<Value>(&bytes).ok());
    let current = found.filter(|found| found["velour"] == env!("CARGO_PKG_VERSION"));
    let caption = current.and_then(|found| Some(found["caption"].as_str()?.to_owned()));
    if let (Some(caption), Ok(svg)) = (caption, fs::read_to_string(&path)) {
        say(format!("{}: is there", path.display()));
        return Ok(Figure { name: figures::fibres::NAME, svg, caption });
    }
    let figure = with_progress("fibres", |step| {
        let done = AtomicUsize::new(0);
        let all = figures::fibres::steps();
        figures::fibres::fibres_figure(|| step(done.fetch_add(1, Ordering::Relaxed) + 1, all))
    });
    write_atomically(&path, figure.svg.as_bytes()).map_err(Failure::input)?;
    let caption = described(&[("caption", figure.caption.clone())]);
    write_atomically(&settings, caption.as_bytes()).map_err(Failure::input)?;
    say(format!("{}: {}", path.display(), figure.caption));
    Ok(figure)
}

/// What a plate is made with, as the file beside it says.
fn described(settings: &[(&str, String)]) -> String {
    let mut map: Map<String, Value> = settings.iter().map(|(name, value)| ((*name).to_owned(), json!(value))).collect();
    map.insert("velour".to_owned(), json!(env!("CARGO_PKG_VERSION")));
    map.insert("sheen_ltc".to_owned(), json!(format!("{:08x}", SheenTable::embedded().checksum())));
    format!("{:#}\n", Value::Object(map))
}
