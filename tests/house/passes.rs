//! On which floor a shader stands.
//!
//! WGSL knows no files: a pass is all of its files one after another, and any of them could name what is in any other.
//! Names tell where they are from, since each begins with its file's stem: `lights_add` and `LightsCounts` are of
//! `lights.wgsl`, `VARIANT_QUADS` is of `variant.wgsl`.

use std::path::Path;

use super::{files, read, root};

/// What people copy but this program does not draw with: it has the table.
const ONLY_COPIED: &str = "sheen_fit";

/// The files of the surfaces' pass, from the ground up. A file names what stands on lower floors, and what is its own.
pub const FLOORS: [&[&str]; 24] = [
    // What people copy.
    &["ltc", "ltc_sample", "sheen", "sheen_fit", "ggx"],
    // What a pipeline is made for.
    &["passes/variant"],
    // What a frame is drawn with.
    &["passes/frame"],
    // What every pixel reads of the scene, as numbers:
    &["passes/numbers"],
    // the materials' factors, the polygons that emit light.
    &["passes/factors", "passes/emitters"],
    // Textures, looked up.
    &["passes/texels"],
    // What of a pixel is covered,
    &["passes/coverage"],
    // and how shading is filtered over it.
    &["passes/filters"],
    // Vertices; random numbers.
    &["passes/vertices", "passes/randoms"],
    // What a surface is made of; sheens of prior work.
    &["passes/material", "passes/prior_sheens"],
    // How a surface scatters light.
    &["passes/lobes"],
    // A point that is lit.
    &["passes/receiver"],
    // How much of each lobe a polygon light fills: in closed form,
    &["passes/polygons"],
    // what the lobes see of its pattern,
    &["passes/patterns"],
    // and by points on it.
    &["passes/points"],
    // Which lights get a ray.
    &["passes/picks"],
    // What all lights send there.
    &["passes/lights"],
    // All of it together.
    &["passes/shading"],
    // Entry points.
    &["passes/surfaces", "passes/prior_albedos"],
    // What stands in the way of light,
    &["passes/blockers"],
    // rays through it,
    &["passes/rays"],
    // to points of lights:
    &["passes/samples"],
    // what is blocked.
    &["passes/shadows"],
    // Entry points.
    &["passes/shadowed"],
];

/// Whole passes of one file: they name nobody else's, and nobody names theirs.
const ALONE: [&str; 7] = [
    "passes/accumulation",
    "passes/denoise",
    "passes/display",
    "passes/enlargement",
    "passes/fullscreen",
    "passes/outline",
    "passes/reprojection",
];

fn all() -> impl Iterator<Item = &'static str> {
    FLOORS.concat().into_iter().chain(ALONE)
}

/// None for files that stand alone.
fn floor(file: &str) -> Option<usize> {
    FLOORS.iter().position(|floor| floor.contains(&file))
}

pub fn stem(file: &str) -> &str {
    file.rsplit('/').next().unwrap_or(file)
}

/// The file that a name is of, by its beginning; the longest one counts.
fn owner(name: &str) -> Option<&'static str> {
    all().filter(|file| begins_with(name, stem(file))).max_by_key(|file| stem(file).len())
}

/// `prior_sheens` begins `prior_sheens_value`, `PRIOR_SHEENS_NODES`, `PriorSheensView` and a type `PriorSheens`.
fn begins_with(name: &str, stem: &str) -> bool {
    let capitalized = |word: &str| word[..1].to_uppercase() + &word[1..];
    let camel: String = stem.split('_').map(capitalized).collect();
    let is_type = name.strip_prefix(&camel).is_some_and(|rest| !rest.starts_with(|next: char| next.is_lowercase()));
    is_type || [format!("{stem}_"), format!("{}_", stem.to_uppercase())].iter().any(|begin| name.starts_with(begin))
}

/// The source with spaces in the place of comments; its lines stay.
fn without_comments(source: &str) -> String {
    let mut bare = String::new();
    let (mut depth, mut is_line) = (0, false);
    let mut letters = source.chars().peekable();
    while let Some(letter) = letters.next() {
        let pair = (letter, letters.peek().copied().unwrap_or(' '));
        match pair {
            ('\n', _) => is_line = false,
            _ if is_line => {}
            ('/', '/') if depth == 0 => is_line = true,
            ('/', '*') => depth += 1,
            ('*', '/') if depth > 0 => depth -= 1,
            _ => {}
        }
        if matches!(pair, ('/', '*') | ('*', '/')) && !is_line {
            letters.next();
            bare.push(' ');
        } else {
            bare.push(if (depth > 0 || is_line) && letter != '\n' { ' ' } else { letter });
        }
    }
    bare
}

#[derive(Debug)]
struct Token {
    line: usize,
    text: String,
}

impl Token {
    fn is_name(&self) -> bool {
        self.text.starts_with(|first: char| first.is_alphabetic() || first == '_')
    }
}

/// Words and numbers, and single letters of punctuation.
fn tokens(source: &str) -> Vec<Token> {
    let mut tokens: Vec<Token> = Vec::new();
    let mut in_word = false;
    for (line, text) in (1..).zip(without_comments(source).lines()) {
        for letter in text.chars() {
            let is_word = letter.is_alphanumeric() || letter == '_';
            match tokens.last_mut().filter(|_| is_word && in_word) {
                Some(word) => word.text.push(letter),
                None if letter.is_whitespace() => {}
                None => tokens.push(Token { line, text: letter.into() }),
            }
            in_word = is_word;
        }
        in_word = false;
    }
    tokens
}

/// What is declared at the top level.
fn declared(tokens: &[Token]) -> Vec<&Token> {
    const KEYWORDS: [&str; 6] = ["fn", "struct", "const", "override", "var", "alias"];
    let mut depth = 0;
    let mut found = Vec::new();
    for (at, token) in tokens.iter().enumerate() {
        match token.text.as_str() {
            "{" => depth += 1,
            "}" => depth -= 1,
            keyword if depth == 0 && KEYWORDS.contains(&keyword) => {
                // Of `var<storage, read> name` what stands in brackets is passed over.
                let rest = &tokens[at + 1..];
                let bracketed = rest.first().is_some_and(|next| next.text == "<");
                let close = rest.iter().position(|next| bracketed && next.text == ">");
                found.extend(rest.get(close.map_or(0, |close| close + 1)));
            }
            _ => {}
        }
    }
    found
}

/// What in a file is against the order, in lines for the reader. `file` is relative to `shaders/`, without extension.
fn violations(file: &str, source: &str) -> Vec<String> {
    if !all().any(|listed| listed == file) {
        return vec![format!("shaders/{file}.wgsl: stands on no floor")];
    }
    let tokens = tokens(source);
    let declared = declared(&tokens);
    let at = |token: &Token| format!("shaders/{file}.wgsl:{}: `{}`", token.line, token.text);
    let misnamed = declared.iter().filter(|token| owner(&token.text) != Some(file));
    let misnamed = misnamed.map(|token| format!("{} does not begin with its file's stem", at(token)));
    let may_name = |other: &str| file == other || floor(other).is_some_and(|lower| Some(lower) < floor(file));
    let is_use = |token: &&Token| token.is_name() && !declared.iter().any(|name| name.text == token.text);
    let used = tokens.iter().filter(is_use).filter_map(|token| Some((token, owner(&token.text)?)));
    let climbing = used.filter(|(_, other)| !may_name(other));
    let climbing = climbing.map(|(token, other)| format!("{} is of `{other}`, which is on no lower floor", at(token)));
    misnamed.chain(climbing).collect()
}

/// The shaders that there are, as `FLOORS` names them.
fn shaders() -> Vec<String> {
    let folder = root().join("shaders");
    let name =
        |path: &Path| path.strip_prefix(&folder).expect("found below it").with_extension("").display().to_string();
    files(&folder, "wgsl").iter().map(|path| name(path)).collect()
}

#[test]
fn shaders_name_what_stands_below_them() {
    let source = |file: &str| read(&root().join("shaders").join(file).with_extension("wgsl"));
    let found: Vec<String> = shaders().iter().flat_map(|file| violations(file, &source(file))).collect();
    assert!(found.is_empty(), "{}", found.join("\n"));
    let gone: Vec<&str> = all().filter(|listed| !shaders().iter().any(|file| file == listed)).collect();
    assert!(gone.is_empty(), "there is no {gone:?}");
    // The test reads what it should: the entry points are told apart from the ground.
    assert!(declared(&tokens(&source("ltc"))).iter().any(|token| token.text == "ltc_edge"));
    assert!(violations("ltc", &source("passes/surfaces")).len() > 10);
}

#[test]
fn the_pass_is_put_together_from_the_ground_up() {
    let included = |line: &str| {
        let path = line.trim().trim_start_matches("include_str!(").strip_prefix("\"../../shaders/")?;
        path.split_once(".wgsl\"").map(|(path, _)| path.to_owned())
    };
    let source = read(&root().join("src/renderer/shader.rs"));
    let drawn_with: Vec<&str> = FLOORS.concat().into_iter().filter(|file| *file != ONLY_COPIED).collect();
    assert_eq!(source.lines().filter_map(included).collect::<Vec<_>>(), drawn_with);
}

#[test]
fn planted_violations_are_found() {
    for (file, source) in [
        ("passes/lights", "fn lights_all() { return surfaces_place(0u); }"),
        ("passes/points", "const POINTS_MOST = 2u * lights_counts.quads;"),
        ("passes/material", "fn material_of(view: PriorSheensView) {}"),
        ("passes/prior_sheens", "fn prior_sheens_all() { if material_has(0u) {} }"),
        ("passes/variant", "override VARIANT_MOST: f32 = POINTS_MOST;"),
        ("passes/lobes", "struct LobesMore { at: Receiver }"),
        ("passes/polygons", "/* a /* nested */ comment */ alias PolygonsCount = LightsCounts; // LightsCounts"),
        ("ltc", "fn ltc_more() -> SheenLobe {}"),
        ("ltc", "fn ltc_more(fan: LtcSampleFan) {}"),
        ("ltc_sample", "fn ltc_sample_more() { let x = LTC_PI; }"),
        ("sheen", "fn sheen_more() { let x = LTC_PI; }"),
        ("ggx", "fn ggx_more() { return lobes_at(0.5, 0.5, 0.5); }"),
        ("passes/display", "fn display_more() { return ltc_angle(0.0, 1.0); }"),
        ("passes/display", "fn display_more() { return vec3f(frame_now.gain); }"),
        ("passes/surfaces", "fn surfaces_shown() { return display_tone(vec3f(0.0)); }"),
        ("passes/lights", "fn other() {}"),
        ("passes/lights", "struct Other { x: f32 }"),
        ("passes/lights", "const OTHER = 1.0;"),
        ("passes/lights", "@id(7) override other: bool = true;"),
        ("passes/lights", "alias Lightsaber = f32;"),
        ("passes/lights", "@group(0) @binding(0) var other: texture_2d<f32>;"),
        ("passes/lights", "@group(0) @binding(0)\nvar<storage, read>\nother: array<vec4<f32>>;"),
        ("passes/lights", "fn lights_all() {}\n@vertex\nfn\n  polygons_all() {}"),
        ("passes/prior_albedos", "fn prior_sheens_fill() {}"),
        ("passes/novel", ""),
        ("novel", "fn novel_all() {}"),
    ] {
        assert_eq!(violations(file, source).len(), 1, "{file}: {source}: {:?}", violations(file, source));
    }
    let [line] = &violations("passes/lights", "\n/*\n*/ // x\nvar<private> lights_x: SurfacesFrame;")[..] else {
        panic!("one line")
    };
    assert_eq!(
        line,
        "shaders/passes/lights.wgsl:4: `SurfacesFrame` is of `passes/surfaces`, which is on no lower floor"
    );
}

#[test]
fn what_the_order_allows_is_let_pass() {
    for (file, source) in [
        (
            "passes/lights",
            "fn lights_all(at: Receiver) -> LobesScalars { return polygons_walk(lights_counts, LTC_PI); }",
        ),
        ("passes/surfaces", "// display_tone\n/* display_tone /* display_tone */ */ const SURFACES_MOST = 1e5f;"),
        ("passes/surfaces", "fn surfaces_all() { let display = 1; let lightsaber: Surfacesque = lights.points_.x; }"),
        (
            "passes/prior_albedos",
            "@fragment fn prior_albedos_all() -> PriorSheensView { const local = VARIANT_SHEEN; }",
        ),
        ("passes/display", "@group(0) @binding(0) var<uniform> display_all: DisplayAll; struct DisplayAll { x: f32 }"),
        ("passes/variant", "override VARIANT_ALL: bool = (VARIANT_MORE & 4u) != 0u; const_assert true;"),
        ("ltc", "alias Ltc = f32; fn ltc_sample(direction: vec3<f32>) {} const LTC_MORE = 1.0;"),
    ] {
        assert_eq!(violations(file, source), [""; 0], "{file}: {source}");
    }
}
