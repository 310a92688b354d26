//! Pictures read back, for the tests.

use plotters::style::RGBColor;
use roxmltree::Document;

/// The contents, in drawing order, of a picture, which must be XML.
pub struct Parsed {
    pub texts: Vec<String>,
    pub rectangles: Vec<Rectangle>,
    /// Polylines and polygons by colour.
    pub paths: Vec<(RGBColor, Vec<[f64; 2]>)>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Rectangle {
    pub color: RGBColor,
    pub left: f64,
    pub top: f64,
    pub width: f64,
    pub height: f64,
}

impl Parsed {
    pub fn new(svg: &str) -> Self {
        let document = Document::parse(svg).unwrap_or_else(|error| panic!("no XML: {error}"));
        assert!(document.root_element().has_tag_name(("http://www.w3.org/2000/svg", "svg")));
        let mut parsed = Self { texts: vec![], rectangles: vec![], paths: vec![] };
        for node in document.descendants() {
            let number = |name: &str| node.attribute(name).expect(name).parse::<f64>().expect(name);
            match node.tag_name().name() {
                "text" => parsed.texts.push(node.text().unwrap_or_default().trim().to_owned()),
                "rect" => parsed.rectangles.push(Rectangle {
                    color: color(node.attribute("fill").expect("a colour")),
                    left: number("x"),
                    top: number("y"),
                    width: number("width"),
                    height: number("height"),
                }),
                "polyline" | "polygon" => {
                    let paint = node.attribute("stroke").or(node.attribute("fill")).expect("a colour");
                    parsed.paths.push((color(paint), points(node.attribute("points").expect("points"))));
                }
                _ => {}
            }
        }
        parsed
    }

    /// Fails unless one of the texts is exactly this.
    pub fn says(&self, text: &str) {
        assert!(self.texts.iter().any(|own| own == text), "no '{text}' in {:?}", self.texts);
    }
}

fn color(hexadecimal: &str) -> RGBColor {
    let channel = |at: usize| u8::from_str_radix(&hexadecimal[at..at + 2], 16).expect("a colour");
    RGBColor(channel(1), channel(3), channel(5))
}

fn points(text: &str) -> Vec<[f64; 2]> {
    let point = |pair: &str| {
        let (x, y) = pair.split_once(',').expect("a pair");
        [x, y].map(|number| number.parse().expect("a number"))
    };
    text.split_whitespace().map(point).collect()
}
