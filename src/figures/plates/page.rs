//! The page that shows all figures.

use super::spheres::{ALPHA, ALPHAS, ANGLES, LAYER_ALPHAS};
use crate::figures::canvas::Figure;

/// Widths at which pictures are shown on the page, in its pixels.
const WIDE: u32 = 420;
const SMALL: u32 = 140;

/// The page, in Markdown, that shows the plates and these other figures, whose files lie beside it.
pub fn page(figures: &[Figure]) -> String {
    let clothes = table(
        &["no sheen", "alpha 0.2: fuzz", "alpha 0.7: towards dust"],
        &[(String::new(), ["none", "low", "high"].map(|name| format!("cloth_{name}")).to_vec())],
        WIDE,
    );
    let row = |(name, says): (&str, &str)| {
        (says.to_owned(), ANGLES.iter().map(|degrees| format!("sphere_{name}_{degrees}")).collect::<Vec<String>>())
    };
    let angles = ANGLES.map(|degrees| format!("{degrees} degrees"));
    let spheres = table(&angles.each_ref().map(String::as_str), &MODELS.map(row), SMALL);
    let alphas = ALPHAS.map(|alpha| format!("alpha {alpha}"));
    let swept =
        MODELS.into_iter().chain([("slab", "the slab")]).filter(|(name, _)| !["fibres", "burley"].contains(name));
    let swept =
        swept.map(|(name, says)| (says.to_owned(), ALPHAS.map(|alpha| format!("sweep_{name}_{alpha}")).to_vec()));
    let sweep = table(&alphas.each_ref().map(String::as_str), &swept.collect::<Vec<_>>(), SMALL);
    let by_alpha = |prefix: &str, names: &[&str]| -> Vec<(String, Vec<String>)> {
        let cells = |alpha: f32| names.iter().map(|name| format!("{prefix}_{name}_{alpha}")).collect();
        LAYER_ALPHAS.iter().map(|&alpha| (format!("alpha {alpha}"), cells(alpha))).collect()
    };
    let slabs = table(&["the fit", "the slab", "the walk"], &by_alpha("layers", &["ltc", "slab", "walk"]), SMALL);
    let rules = table(
        &["gltf", "openpbr", "reciprocal", "none", "walk through both"],
        &by_alpha("rules", &["gltf", "openpbr", "reciprocal", "none", "stack"]),
        SMALL,
    );
    let drawn: Vec<String> =
        figures.iter().map(|figure| format!("![{0}]({0})\n\n{1}\n", figure.name, figure.caption)).collect();
    format!(
        "# Figures\n\nMade by `velour figures`; what each picture was made with stands in the .json beside it.\n\n\
         ## A cloth without sheen, with one of low and with one of high roughness\n\n{clothes}\n\
         ## A sphere lit from the front, the side and behind, alpha {ALPHA}\n\n{spheres}\n\
         ## Dust of roughness 0.85 on a sculpted form\n\n![dust](dust.png)\n\n\
         ## Models over roughness, lit from 60 degrees\n\n{sweep}\n\
         ## The slab: fitted, tabulated, walked through\n\n{slabs}\n\
         ## A grey base: what the layering rules leave of it, and light followed through both layers\n\n{rules}\n\
         ## The table, its lobes and errors, and explicit fibres\n\n{}",
        drawn.join("\n")
    )
}

/// Names of the sphere's plates, and what they show.
const MODELS: [(&str, &str); 6] = [
    ("ltc", "ours: the fit"),
    ("fibres", "explicit fibres"),
    ("burley", "Burley 2012"),
    ("neubelt-pettineo", "Neubelt and Pettineo 2013"),
    ("conty-kulla", "Conty Estevez and Kulla 2017"),
    ("patry", "Patry 2020"),
];

/// A table of pictures: heads of the columns, and rows of a title and names.
fn table(heads: &[&str], rows: &[(String, Vec<String>)], width: u32) -> String {
    let mut lines = vec![format!("| | {} |", heads.join(" | ")), format!("|---|{}", "---|".repeat(heads.len()))];
    for (title, names) in rows {
        let cells: Vec<String> =
            names.iter().map(|name| format!("<img src=\"{name}.png\" width=\"{width}\" alt=\"{name}\">")).collect();
        lines.push(format!("| {title} | {} |", cells.join(" | ")));
    }
    lines.join("\n") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::plates::plates;

    #[test]
    fn the_page_shows_every_plate_and_nothing_else() {
        let page = page(&[]);
        let plates: Vec<String> = plates().into_iter().map(|plate| format!("{}.png", plate.name)).collect();
        for name in &plates {
            assert_eq!(
                page.matches(&format!("\"{name}\"")).count() + page.matches(&format!("({name})")).count(),
                1,
                "{name}"
            );
        }
        assert_eq!(page.matches(".png").count(), plates.len());
    }
}
