//! The table's three planes.

use super::canvas::Figure;
use super::color::Scale;
use super::field::{Field, Labels, draw};
use crate::table::SheenTable;

/// File names of the pictures of columns a, b, r.
pub const NAMES: [&str; 3] = ["table_a.svg", "table_b.svg", "table_r.svg"];

const ABOUT: [&str; 3] = [
    "a, the inverse matrix's scale along the surface (rows (a,0,b), (0,a,0), (0,0,1)): small is a lobe near the horizon.",
    "b, the inverse matrix's shear along x = wi projected on the surface: below 0 leans towards wi.",
    "r, the albedo, as it is looked up: bilinear between nodes.",
];

/// Columns a, b and r of `table` over (alpha, mu), with a cell for each node, centred on it.
pub fn table_planes(table: &SheenTable) -> Vec<Figure> {
    (0..NAMES.len()).map(|column| plane(table, column)).collect()
}

fn plane(table: &SheenTable, column: usize) -> Figure {
    let size = table.size();
    let values: Vec<f64> = table.cells().iter().map(|cell| cell[column]).collect();
    let scale = Scale::of(values.iter().copied());
    let edges = size.map(|nodes| {
        let half = 0.5 / (nodes - 1) as f64;
        -half..1.0 + half
    });
    let caption = format!(
        "{} {} x {} nodes, each in the middle of its cell; from {:.4} to {:.4}. Table of checksum {:08x}.",
        ABOUT[column],
        size[0],
        size[1],
        scale.value(0.0),
        scale.value(1.0),
        table.checksum()
    );
    let title = format!("Table of lobes: {}", ["a", "b", "r"][column]);
    let field = Field { size, edges, values: values.into_iter().map(Some).collect() };
    let svg = draw(&field, &scale, &Labels { title: &title, absent: None, caption: &caption });
    Figure { name: NAMES[column], svg, caption }
}

#[cfg(test)]
mod tests {
    use super::super::parsed::Parsed;
    use super::*;

    #[test]
    fn each_column_has_its_picture() {
        // a, b and r rise along different axes: r along alpha, b along mu, a not at all.
        let cells = vec![[0.5, -0.2, 0.1], [0.5, 0.0, 0.1], [0.5, -0.2, 0.9], [0.5, 0.0, 0.9]];
        let [a, b, r] = &table_planes(&SheenTable::new([2, 2], cells))[..] else { panic!("three planes") };
        for (figure, name) in [a, b, r].into_iter().zip(["a", "b", "r"]) {
            assert_eq!(figure.name, format!("table_{name}.svg"));
            let parsed = Parsed::new(&figure.svg);
            parsed.says(&format!("Table of lobes: {name}"));
            let said = parsed.texts.join(" ");
            assert!(said.contains(&figure.caption), "{said}");
        }
        let colors = |figure: &Figure| -> Vec<_> {
            let cells =
                Parsed::new(&figure.svg).rectangles.into_iter().filter(|one| (200.0..400.0).contains(&one.width));
            cells.map(|cell| cell.color).collect()
        };
        let [low, high] = [0.0, 1.0].map(|value| Scale::Linear(0.0..1.0).color(value));
        assert_eq!(colors(b), [low, high, low, high]);
        assert_eq!(colors(r), [low, low, high, high]);
        let flat = colors(a);
        assert!(flat.len() == 4 && flat.iter().all(|color| *color == flat[0]));
    }
}
