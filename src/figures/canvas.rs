//! Where figures are drawn: SVG text in memory, with text of three sizes.

use plotters::backend::SVGBackend;
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{BLACK, Color, IntoFont, RGBColor, TextStyle, WHITE};

pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub type Drawn = Result<(), DrawingAreaErrorKind<std::io::Error>>;

/// Colour of frames, circles and whatever else stays behind the curves.
pub const FAINT: RGBColor = RGBColor(196, 196, 196);
/// Colour of captions and scales.
pub const GREY: RGBColor = RGBColor(90, 90, 90);

/// Font sizes of captions, of labels and of titles, which plotters divides by 1.24.
pub const CAPTION: f64 = 15.0;
pub const LABEL: f64 = 17.0;
pub const TITLE: f64 = 21.0;
/// Distance from one line of a caption to the next.
const LINE: i32 = 16;
/// Upper bound of the average width of a caption's characters: nothing here knows the viewer's font.
const CHARACTER: f64 = 6.8;
/// Between a caption and what is around it.
const GAP: i32 = 10;

/// A picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Its file's name.
    pub name: &'static str,
    /// Its file.
    pub svg: String,
    /// The text below it: what it shows, and with which settings.
    pub caption: String,
}

/// A picture of `size` pixels as the text of an SVG file. plotters places everything on whole numbers, of which there
/// are `units` to a pixel; the lengths that `draw` uses are in these units.
pub fn svg(size: [i32; 2], units: i32, draw: impl FnOnce(&Area) -> Drawn) -> String {
    assert!(size.iter().all(|side| *side > 0) && units > 0, "a picture has pixels: {size:?}, {units}");
    let [width, height] = size.map(|side| (side * units) as u32);
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, (width, height)).into_drawing_area();
        let drawn = area.fill(&WHITE).and_then(|()| draw(&area)).and_then(|()| area.present());
        drawn.expect("a string takes whatever is drawn");
    }
    let [drawn, shown] = [[width as i32, height as i32], size].map(|[x, y]| format!("width=\"{x}\" height=\"{y}\""));
    // An attribute of each of thousands of cells that says no more than the default.
    text.replacen(&drawn, &shown, 1).replace("opacity=\"1\" ", "")
}

/// Text of a size and colour, anchored at half its height and, across its width, at `side`.
pub fn text(size: f64, color: RGBColor, side: HPos) -> TextStyle<'static> {
    TextStyle {
        font: ("sans-serif", size).into_font(),
        color: color.to_backend_color(),
        pos: Pos::new(side, VPos::Center),
    }
}

/// The lines of a caption, none wider than `pixels`.
pub fn lines(caption: &str, pixels: i32) -> Vec<String> {
    let most = (f64::from(pixels) / CHARACTER) as usize;
    let mut lines: Vec<String> = Vec::new();
    for word in caption.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// The height that this many lines of a caption take, in pixels.
pub fn caption_height(lines: usize) -> i32 {
    lines as i32 * LINE + 2 * GAP
}

/// Writes a caption's lines downwards from its upper left corner, in pixels of `units` each.
pub fn caption(area: &Area, lines: &[String], [x, y]: [i32; 2], units: i32) -> Drawn {
    let style = text(CAPTION * f64::from(units), GREY, HPos::Left);
    for (k, line) in lines.iter().enumerate() {
        area.draw_text(line, &style, (x * units, (y + GAP + LINE * k as i32 + LINE / 2) * units))?;
    }
    Ok(())
}

/// Writes a title centred on a point, in pixels of `units` each.
pub fn title(area: &Area, line: &str, [x, y]: [i32; 2], units: i32) -> Drawn {
    area.draw_text(line, &text(TITLE * f64::from(units), BLACK, HPos::Center), (x * units, y * units))
}

/// A number to four decimals; a small one to three digits.
pub fn digits(value: f64) -> String {
    if value < 1e-3 { format!("{value:.2e}") } else { format!("{value:.4}") }
}

#[cfg(test)]
mod tests {
    use super::super::parsed::Parsed;
    use super::*;

    #[test]
    fn captions_are_broken_between_words() {
        let said = "a few words, and averylongwordthatfitsnowhere here";
        let broken = lines(said, 100);
        assert_eq!(broken.join(" "), said);
        assert!(broken.len() > 3, "{broken:?}");
        for line in &broken {
            assert!(line.len() as f64 * CHARACTER <= 100.0 || !line.contains(' '), "{line}");
        }
        assert_eq!(lines(said, 10_000), [said]);
    }

    #[test]
    fn a_picture_is_as_large_as_asked_in_any_units() {
        for units in [1, 8] {
            let svg = svg([300, 200], units, |area| caption(area, &["R < 1 & more".to_owned()], [0, 0], units));
            let inside = format!("viewBox=\"0 0 {} {}\"", 300 * units, 200 * units);
            assert!(svg.contains("width=\"300\" height=\"200\"") && svg.contains(&inside), "{svg}");
            Parsed::new(&svg).says("R < 1 & more");
        }
    }
}
