//! Half discs of elevations, side by side.

use super::canvas::{self, Area, CAPTION, Drawn, FAINT, GREY, LABEL};
use super::incidence::{Curve, Pool};
use plotters::element::{Circle, DashedPathElement, PathElement, Polygon};
use plotters::style::text_anchor::HPos;
use plotters::style::{BLACK, Color, RGBColor, ShapeStyle};
use std::f64::consts::{FRAC_PI_2, PI};

/// Whole numbers per pixel: the more, the smoother are the curves.
const UNITS: i32 = 8;

/// A panel's sides, and the radius of its outer circle, in pixels.
const PANEL: [i32; 2] = [420, 258];
const RADIUS: f64 = 168.0;
/// Where in a panel the half disc's centre and the title are.
const CENTER: [f64; 2] = [210.0, 224.0];
const TITLE_AT: [i32; 2] = [210, 20];
/// Left and right of the caption.
const MARGIN: i32 = 24;
/// Above the panels: title and legend.
const HEADER: i32 = 78;
const LEGEND_AT: f64 = 56.0;

/// Colours that colour-blind readers can tell apart (Okabe and Ito 2008).
const SOLVED: RGBColor = RGBColor(0, 114, 178);
const FITTED: RGBColor = RGBColor(213, 94, 0);
const COUNTED: RGBColor = BLACK;

/// Lobes of one slab and one `wi`.
pub struct Panel {
    pub title: String,
    /// Elevation of `wi` from the normal.
    pub wi: f64,
    pub solved: Curve,
    pub fitted: Curve,
    pub counted: Vec<Pool>,
}

/// What is written above the panels: the title, and what the curves are.
pub struct Words {
    pub title: &'static str,
    pub solved: &'static str,
    pub counted: &'static str,
    pub fitted: &'static str,
}

/// The picture of `panels`, `columns` in a row, as SVG text.
pub fn draw(panels: &[Panel], columns: usize, words: &Words, caption: &str) -> String {
    let width = PANEL[0] * columns as i32;
    let lines = canvas::lines(caption, width - 2 * MARGIN);
    let below = HEADER + PANEL[1] * panels.len().div_ceil(columns) as i32;
    canvas::svg([width, below + canvas::caption_height(lines.len())], UNITS, |area| {
        canvas::title(area, words.title, [width / 2, 24], UNITS)?;
        draw_legend(area, words, f64::from(width) / 2.0)?;
        for (index, panel) in panels.iter().enumerate() {
            let [column, row] = [index % columns, index / columns].map(|k| k as i32);
            let corner = [column * PANEL[0], HEADER + row * PANEL[1]];
            Disc { area, corner, outer: round_up(highest(panel)) }.draw(panel)?;
        }
        canvas::caption(area, &lines, [MARGIN, below], UNITS)
    })
}

fn draw_legend(area: &Area, words: &Words, center: f64) -> Drawn {
    let label = canvas::text(LABEL * f64::from(UNITS), BLACK, HPos::Left);
    let line = |x: f64| vec![at(x, LEGEND_AT), at(x + 36.0, LEGEND_AT)];
    let [solver, walk, table] = [-350.0, -150.0, 150.0].map(|offset| center + offset);
    area.draw(&PathElement::new(line(solver), stroke(SOLVED, 2.2)))?;
    area.draw_text(words.solved, &label, at(solver + 44.0, LEGEND_AT))?;
    area.draw(&PathElement::new(line(walk + 12.0), stroke(COUNTED, 1.4)))?;
    area.draw(&PathElement::new(
        vec![at(walk + 30.0, LEGEND_AT - 7.0), at(walk + 30.0, LEGEND_AT + 7.0)],
        stroke(COUNTED, 1.0),
    ))?;
    area.draw_text(words.counted, &label, at(walk + 56.0, LEGEND_AT))?;
    area.draw(&dashed(line(table)))?;
    area.draw_text(words.fitted, &label, at(table + 44.0, LEGEND_AT))
}

/// A panel's half disc.
struct Disc<'a, 'b> {
    area: &'a Area<'b>,
    /// Upper left corner of the panel, in pixels.
    corner: [i32; 2],
    /// The lobe's value on the outer circle.
    outer: f64,
}

impl Disc<'_, '_> {
    fn draw(&self, panel: &Panel) -> Drawn {
        self.draw_scale()?;
        self.draw_wi(panel.wi)?;
        let solved: Vec<_> = panel.solved.iter().map(|&[elevation, value]| self.point(elevation, value)).collect();
        self.area.draw(&Polygon::new(solved.clone(), SOLVED.mix(0.12).filled()))?;
        self.area.draw(&PathElement::new(solved, stroke(SOLVED, 2.2)))?;
        let fitted = panel.fitted.iter().map(|&[elevation, value]| self.point(elevation, value)).collect();
        self.area.draw(&dashed(fitted))?;
        panel.counted.iter().try_for_each(|pool| self.draw_pool(pool))?;
        let [x, y] = [0, 1].map(|axis| (self.corner[axis] + TITLE_AT[axis]) * UNITS);
        self.area.draw_text(&panel.title, &canvas::text(LABEL * f64::from(UNITS), BLACK, HPos::Center), (x, y))
    }

    /// Circles, spokes and their labels.
    fn draw_scale(&self) -> Drawn {
        for share in [0.5, 1.0] {
            self.area
                .draw(&PathElement::new(self.arc([-FRAC_PI_2, FRAC_PI_2], share * self.outer), stroke(FAINT, 1.0)))?;
        }
        for degrees in [-90, -45, 0, 45, 90] {
            let elevation = f64::from(degrees) * PI / 180.0;
            let spoke = vec![self.point(0.0, 0.0), self.point(elevation, self.outer)];
            self.area.draw(&PathElement::new(spoke, stroke(FAINT, 0.8)))?;
            let side = match degrees {
                ..0 => HPos::Right,
                0 => HPos::Center,
                1.. => HPos::Left,
            };
            let place = self.point(elevation, self.outer * (1.0 + 9.0 / RADIUS));
            self.area.draw_text(&degrees.to_string(), &canvas::text(CAPTION * f64::from(UNITS), GREY, side), place)?;
        }
        let (x, y) = self.point(FRAC_PI_2, self.outer);
        let number = canvas::text(CAPTION * f64::from(UNITS), GREY, HPos::Center);
        self.area.draw_text(&written(self.outer), &number, (x, y + 14 * UNITS))
    }

    /// An arrow from the surface towards `wi`.
    fn draw_wi(&self, elevation: f64) -> Drawn {
        let tip = self.point(elevation, self.outer);
        let (sin, cos) = elevation.sin_cos();
        let back = |along: f64, across: f64| {
            let [x, y] = [sin * -along + cos * across, cos * -along - sin * across];
            (tip.0 + units(x), tip.1 - units(y))
        };
        self.area.draw(&PathElement::new(vec![self.point(0.0, 0.0), back(8.0, 0.0)], stroke(GREY, 1.2)))?;
        self.area.draw(&Polygon::new(vec![tip, back(10.0, 4.0), back(10.0, -4.0)], GREY.filled()))?;
        let label = canvas::text(LABEL * f64::from(UNITS), GREY, HPos::Center);
        self.area.draw_text("wi", &label, self.point(elevation, self.outer * (1.0 + 15.0 / RADIUS)))
    }

    fn draw_pool(&self, pool: &Pool) -> Drawn {
        let Pool { elevations, mean, error, .. } = pool;
        let middle = (elevations[0] + elevations[1]) / 2.0;
        let bar = [mean - error, mean + error].map(|value| self.point(middle, value.clamp(0.0, self.outer * 1.1)));
        self.area.draw(&PathElement::new(self.arc(*elevations, *mean), stroke(COUNTED, 1.4)))?;
        self.area.draw(&PathElement::new(bar.to_vec(), stroke(COUNTED, 0.9)))?;
        self.area.draw(&Circle::new(self.point(middle, *mean), units(1.6), COUNTED.filled()))
    }

    fn arc(&self, [from, to]: [f64; 2], value: f64) -> Vec<(i32, i32)> {
        let steps = ((to - from) / 0.03).ceil().max(1.0) as usize;
        (0..=steps).map(|k| self.point(from + (to - from) * k as f64 / steps as f64, value)).collect()
    }

    /// Where the value at an elevation from the normal is drawn: towards `wi` is to the right.
    fn point(&self, elevation: f64, value: f64) -> (i32, i32) {
        let radius = value / self.outer * RADIUS;
        let [left, top] = self.corner.map(f64::from);
        at(left + CENTER[0] + radius * elevation.sin(), top + CENTER[1] - radius * elevation.cos())
    }
}

fn units(pixels: f64) -> i32 {
    (pixels * f64::from(UNITS)).round() as i32
}

fn at(x: f64, y: f64) -> (i32, i32) {
    (units(x), units(y))
}

fn stroke(color: RGBColor, pixels: f64) -> ShapeStyle {
    color.stroke_width(units(pixels) as u32)
}

fn dashed(points: Vec<(i32, i32)>) -> DashedPathElement<std::vec::IntoIter<(i32, i32)>, i32> {
    DashedPathElement::new(points, units(6.0), units(4.0), stroke(FITTED, 2.0))
}

/// The largest value of the curves.
fn highest(panel: &Panel) -> f64 {
    panel.solved.iter().chain(&panel.fitted).fold(0.0, |highest, [_, value]| value.max(highest))
}

/// A number of few digits, with a power of ten where it is small.
fn written(value: f64) -> String {
    if value < 1e-3 { format!("{value:e}") } else { format!("{value}") }
}

/// The next larger number with a single digit or, up to 2.5, with halves.
fn round_up(value: f64) -> f64 {
    assert!(value > 0.0 && value.is_finite(), "a lobe has a largest value: {value}");
    let mut power = value.log10().floor() as i32;
    let tenths = [10, 15, 20, 25, 30, 40, 50, 60, 70, 80, 90, 100];
    let number = |tenths: i32, power: i32| format!("{tenths}e{}", power - 1).parse().unwrap_or(f64::INFINITY);
    if number(tenths[0], power) > value {
        power -= 1;
    }
    tenths.into_iter().map(|tenths| number(tenths, power)).find(|number| *number >= value).unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::super::parsed::Parsed;
    use super::*;

    const WORDS: Words = Words { title: "Lobes", solved: "exact", counted: "measured", fitted: "approximate" };

    /// A lobe towards `wi` alone, of 0.08 at 60 degrees; fitted on the other side; walked at 45 degrees.
    fn panel() -> Panel {
        let degrees = |degrees: f64, value: f64| [degrees * PI / 180.0, value];
        Panel {
            title: "alpha 0.5, mu 0.5".to_owned(),
            wi: PI / 3.0,
            solved: vec![degrees(-90.0, 0.0), degrees(0.0, 0.0), degrees(60.0, 0.08), degrees(90.0, 0.0)],
            fitted: vec![degrees(-90.0, 0.0), degrees(-60.0, 0.04), degrees(0.0, 0.0), degrees(90.0, 0.0)],
            counted: vec![Pool { elevations: [PI / 6.0, PI / 3.0], count: 100, mean: 0.04, error: 0.004 }],
        }
    }

    /// All points of paths of a colour, from the half disc's centre in units of its radius, y upwards.
    fn points(parsed: &Parsed, color: RGBColor) -> Vec<[f64; 2]> {
        let paths =
            parsed.paths.iter().filter(|(own, points)| *own == color && points[0][1] > f64::from(HEADER * UNITS));
        let center = [CENTER[0], CENTER[1] + f64::from(HEADER)].map(|pixels| pixels * f64::from(UNITS));
        let radius = RADIUS * f64::from(UNITS);
        paths
            .flat_map(|(_, points)| points)
            .map(|[x, y]| [(x - center[0]) / radius, (center[1] - y) / radius])
            .collect()
    }

    #[test]
    fn lobes_stand_where_they_point() {
        let parsed = Parsed::new(&draw(&[panel()], 1, &WORDS, "A caption."));
        // Half a unit of the grid.
        let near = |[x, y]: [f64; 2], [right, up]: [f64; 2]| (x - right).abs().max((y - up).abs()) < 0.5 / RADIUS;
        let (sin, cos) = (PI / 3.0).sin_cos();
        let outermost = |color| points(&parsed, color).into_iter().max_by(|p, q| p[1].total_cmp(&q[1])).unwrap();
        assert!(near(outermost(SOLVED), [sin, cos]), "{:?}", outermost(SOLVED));
        // The tip lies in a dash or, at most, in the gap before the next.
        let [x, y] = outermost(FITTED);
        assert!((x + sin / 2.0).hypot(y - cos / 2.0) < 5.0 / RADIUS, "{x}, {y}");
        let arrow = points(&parsed, GREY);
        assert!(arrow.iter().any(|point| near(*point, [sin, cos])), "{arrow:?}");
        let walked = points(&parsed, COUNTED);
        let half = 0.5_f64.sqrt();
        for radius in [0.45, 0.55] {
            assert!(walked.iter().any(|point| near(*point, [radius * half, radius * half])), "{walked:?}");
        }
    }

    #[test]
    fn everything_is_labelled() {
        let parsed = Parsed::new(&draw(&[panel(), panel(), panel()], 2, &WORDS, "A caption."));
        let legend = [WORDS.title, WORDS.solved, WORDS.counted, WORDS.fitted];
        for text in legend.into_iter().chain(["alpha 0.5, mu 0.5", "wi", "-90", "45", "0.08", "A caption."]) {
            parsed.says(text);
        }
        assert_eq!(parsed.texts.iter().filter(|text| *text == "wi").count(), 3);
    }

    #[test]
    fn scales_end_at_round_numbers_not_below_the_lobe() {
        for (value, end, text) in [
            (0.27, 0.3, "0.3"),
            (0.3, 0.3, "0.3"),
            (0.31, 0.4, "0.4"),
            (0.11, 0.15, "0.15"),
            (0.1, 0.1, "0.1"),
            (0.97, 1.0, "1"),
            (1.2e-6, 1.5e-6, "1.5e-6"),
            (8.7e-4, 9e-4, "9e-4"),
        ] {
            assert_eq!(round_up(value), end, "{value}");
            assert_eq!(written(round_up(value)), text);
        }
    }
}
