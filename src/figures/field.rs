//! A function of (alpha, mu) as an image with axes and a bar of its colours.

use super::canvas::{self, Area, CAPTION, Drawn, GREY, LABEL};
use super::color::Scale;
use plotters::backend::SVGBackend;
use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::cartesian::Cartesian2d;
use plotters::coord::types::RangedCoordf64;
use plotters::element::{PathElement, Rectangle};
use plotters::style::text_anchor::HPos;
use plotters::style::{BLACK, Color, RGBColor};
use std::ops::Range;

/// Sides of the image in pixels, a multiple of the cells that are drawn.
const SIDE: i32 = 576;
/// The same as plotters counts it: points, not the gaps between them.
const SPAN: i32 = SIDE + 1;
const TITLE_HEIGHT: i32 = 44;
const LEFT: i32 = 72;
/// Left of everything.
const MARGIN: i32 = 14;
const BELOW: i32 = 52;
/// Of the bar of colours: its distance from the image, its width, and its labels' width.
const BAR_GAP: i32 = 30;
const BAR: i32 = 22;
const BAR_LABELS: i32 = 72;
/// Colours that the bar shows.
const BAR_STEPS: i32 = 96;
/// Where nothing is shown.
const ABSENT: RGBColor = RGBColor(214, 214, 214);

/// Numbers in square cells over (alpha, mu).
pub struct Field {
    /// Cells along alpha and along mu.
    pub size: [usize; 2],
    /// The axes' ends, the outer edges of the first and the last cells.
    pub edges: [Range<f64>; 2],
    /// Cell by cell, alpha-major; `None` where nothing is to be shown.
    pub values: Vec<Option<f64>>,
}

impl Field {
    /// The field of `values` at the centres of n x n cells of the unit square, at (k + 1/2) / n along either axis.
    pub fn of_centers(n: usize, values: Vec<Option<f64>>) -> Self {
        assert_eq!(values.len(), n * n, "values of {n} x {n} cells");
        Self { size: [n; 2], edges: [0.0..1.0, 0.0..1.0], values }
    }

    /// Edges of cell `k` along `axis`.
    fn cell(&self, axis: usize, k: usize) -> [f64; 2] {
        let Range { start, end } = self.edges[axis];
        [k, k + 1].map(|edge| start + (end - start) * edge as f64 / self.size[axis] as f64)
    }
}

/// What is written around a field.
pub struct Labels<'a> {
    pub title: &'a str,
    /// What grey cells mean, where there are any.
    pub absent: Option<&'a str>,
    pub caption: &'a str,
}

/// The picture of a field as SVG text: alpha to the right, mu upwards.
pub fn draw(field: &Field, scale: &Scale, labels: &Labels) -> String {
    assert_eq!(field.values.len(), field.size[0] * field.size[1], "values of {:?} cells", field.size);
    let width = LEFT + SPAN + BAR_GAP + BAR + BAR_LABELS;
    let below = TITLE_HEIGHT + SPAN + BELOW;
    let lines = canvas::lines(labels.caption, width - 2 * MARGIN);
    canvas::svg([width, below + canvas::caption_height(lines.len())], 1, |area| {
        canvas::title(area, labels.title, [LEFT + SIDE / 2, TITLE_HEIGHT / 2], 1)?;
        let (above, caption) = area.split_vertically(below);
        canvas::caption(&caption, &lines, [MARGIN, 0], 1)?;
        let (_, above) = above.split_vertically(TITLE_HEIGHT);
        let (image, bar) = above.split_horizontally(LEFT + SPAN + BAR_GAP / 2);
        draw_image(&image, field, scale)?;
        draw_bar(&bar, scale)?;
        labels.absent.map_or(Ok(()), |absent| draw_absent(&bar, absent))
    })
}

fn draw_image(area: &Area, field: &Field, scale: &Scale) -> Drawn {
    let [alphas, mus] = field.edges.clone();
    let mut chart = ChartBuilder::on(area)
        .margin_left(MARGIN)
        .margin_right(BAR_GAP / 2)
        .x_label_area_size(BELOW)
        .y_label_area_size(LEFT - MARGIN)
        .build_cartesian_2d(alphas, mus)?;
    draw_cells(&chart, field, scale)?;
    let one_decimal = |value: &f64| format!("{value:.1}");
    let mut mesh = chart.configure_mesh();
    mesh.disable_mesh().axis_style(GREY).label_style(canvas::text(CAPTION, BLACK, HPos::Center));
    mesh.axis_desc_style(canvas::text(LABEL, BLACK, HPos::Center));
    mesh.x_desc("alpha").y_desc("mu").x_labels(6).y_labels(6);
    mesh.x_label_formatter(&one_decimal).y_label_formatter(&one_decimal).draw()
}

/// Each cell extends by a pixel under those to its right and above, which are drawn later: otherwise viewers that blend
/// the edges of both let the paper shine through.
fn draw_cells(
    chart: &ChartContext<SVGBackend, Cartesian2d<RangedCoordf64, RangedCoordf64>>,
    field: &Field,
    scale: &Scale,
) -> Drawn {
    let [alphas, mus] = field.size;
    let area = chart.plotting_area();
    let origin = area.get_base_pixel();
    let area = area.strip_coord_spec();
    for (index, value) in field.values.iter().enumerate() {
        let (i, j) = (index / mus, index % mus);
        let [[left, right], [bottom, top]] = [field.cell(0, i), field.cell(1, j)];
        let [from, to] = [(left, top), (right, bottom)].map(|corner| {
            let (x, y) = chart.backend_coord(&corner);
            (x - origin.0, y - origin.1)
        });
        let to = (to.0 + i32::from(i + 1 < alphas), to.1);
        let from = (from.0, from.1 - i32::from(j + 1 < mus));
        let color = value.map_or(ABSENT, |value| scale.color(value));
        area.draw(&Rectangle::new([from, to], color.filled()))?;
    }
    Ok(())
}

fn draw_bar(area: &Area, scale: &Scale) -> Drawn {
    let left = BAR_GAP / 2;
    let height = |place: f64| SIDE - (place * f64::from(SIDE)).round() as i32;
    for k in 0..BAR_STEPS {
        let [low, middle] = [0.0, 0.5].map(|within| (f64::from(k) + within) / f64::from(BAR_STEPS));
        // Up to the top, under the next steps, for the same reason as with the image's cells.
        let corners = [(left, 0), (left + BAR, height(low))];
        area.draw(&Rectangle::new(corners, scale.color(scale.value(middle)).filled()))?;
    }
    for tick in scale.ticks() {
        let y = height(scale.place(tick));
        area.draw(&PathElement::new([(left + BAR, y), (left + BAR + 5, y)], GREY))?;
        area.draw_text(&short(tick), &canvas::text(CAPTION, BLACK, HPos::Left), (left + BAR + 9, y))?;
    }
    Ok(())
}

/// A round number without the noise of its last digits.
fn short(value: f64) -> String {
    let rounded = format!("{value:.3e}").parse().unwrap_or(value);
    format!("{rounded}")
}

/// Says below the bar what grey means.
fn draw_absent(area: &Area, absent: &str) -> Drawn {
    let (left, top) = (BAR_GAP / 2, SIDE + 18);
    area.draw(&Rectangle::new([(left, top), (left + BAR, top + BAR / 2)], ABSENT.filled()))?;
    area.draw_text(absent, &canvas::text(CAPTION, BLACK, HPos::Left), (left + BAR + 8, top + BAR / 4))
}

#[cfg(test)]
mod tests {
    use super::super::parsed::{Parsed, Rectangle};
    use super::*;

    /// Two cells of alpha by three of mu, of values 0 to 5, alpha-major; cell (1, 1) is absent.
    fn small(scale: &Scale) -> Parsed {
        let values = (0..6).map(|k| (k != 4).then_some(f64::from(k))).collect();
        let field = Field { size: [2, 3], edges: [0.0..1.0, 0.0..1.0], values };
        let labels = Labels { title: "A field", absent: Some("x < y & z"), caption: "What it is." };
        Parsed::new(&draw(&field, scale, &labels))
    }

    #[test]
    fn alpha_is_to_the_right_and_mu_upwards() {
        let scale = Scale::Linear(0.0..5.0);
        let parsed = small(&scale);
        let cell = |color: RGBColor| -> Rectangle {
            // The bar's steps have the colours of their middles, so that neither end's colour is among them.
            let found: Vec<_> =
                parsed.rectangles.iter().filter(|one| one.color == color && one.width > 200.0).collect();
            assert_eq!(found.len(), 1, "{color:?}");
            found[0].clone()
        };
        let [first, second, third, fourth] = [0.0, 1.0, 2.0, 3.0].map(|value| cell(scale.color(value)));
        assert!(first.left == second.left && second.left == third.left && first.left < fourth.left);
        assert!(first.top > second.top && second.top > third.top && first.top == fourth.top);
        let absent = cell(ABSENT);
        assert!(absent.left == fourth.left && absent.top == second.top, "{absent:?}");
        // The image is whole: from the first cell's corner to the last one's, no pixel missing.
        let last = cell(scale.color(5.0));
        assert_eq!([last.left + last.width - first.left, first.top + first.height - last.top], [f64::from(SIDE); 2]);
    }

    #[test]
    fn everything_is_labelled() {
        let parsed = small(&Scale::Log(1e-3..1.0));
        for text in ["A field", "What it is.", "alpha", "mu", "0.0", "1.0", "x < y & z", "0.001", "0.01", "0.1", "1"] {
            parsed.says(text);
        }
    }

    #[test]
    fn the_bar_goes_from_the_lowest_colour_to_the_highest() {
        let scale = Scale::Linear(-1.0..1.0);
        let parsed = small(&scale);
        let bar: Vec<_> =
            parsed.rectangles.iter().filter(|one| one.width == f64::from(BAR) && one.color != ABSENT).collect();
        assert_eq!(bar.len(), BAR_STEPS as usize);
        for (k, step) in bar.iter().enumerate() {
            assert_eq!(step.color, scale.color(-1.0 + 2.0 * (k as f64 + 0.5) / f64::from(BAR_STEPS)));
        }
        assert!(bar.windows(2).all(|pair| pair[0].height > pair[1].height && pair[0].top == pair[1].top));
    }

    #[test]
    #[should_panic(expected = "values of")]
    fn a_field_has_a_value_a_cell() {
        Field::of_centers(3, vec![None; 8]);
    }
}
