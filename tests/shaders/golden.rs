//! The shipped files on the device against the golden numbers.

use crate::reserved::reserved;
use crate::{device, files};
use velour::export::golden::{Answers, Golden, Judgement, Mistake, Row};
use velour::table::{GgxTable, SheenTable};

/// What a language's shell supplies to `golden.wgsl`, and an entry point that runs each row.
const SHELL: &str = "
@group(0) @binding(0) var<storage, read_write> golden_outputs: array<f32>;
@group(0) @binding(1) var<storage, read> golden_inputs: array<f32>;
// Index of the function, of the first input and of the first output.
@group(0) @binding(2) var<storage, read> golden_rows: array<vec4<u32>>;
@group(0) @binding(3) var golden_sheen: texture_2d<f32>;
@group(0) @binding(4) var golden_ggx: texture_2d<f32>;
var<private> golden_at: vec4<u32>;

fn golden_number(index: u32) -> f32 {
    return golden_inputs[golden_at.y + index];
}

fn golden_put(index: u32, value: f32) {
    golden_outputs[golden_at.z + index] = value;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < arrayLength(&golden_rows) {
        golden_at = golden_rows[id.x];
        golden_row(golden_sheen, golden_ggx, golden_at.x);
    }
}
";

/// What files and harness, given as `source`, give for each row, on textures of halves.
fn given(source: &str, rows: &[Row]) -> Answers {
    let (mut inputs, mut places, mut count) = (Vec::<f32>::new(), Vec::<[u32; 4]>::new(), 0);
    for row in rows {
        places.push([row.function as u32, inputs.len() as u32, count as u32, 0]);
        inputs.extend(row.inputs.iter().map(|input| *input as f32));
        count += row.outputs.len();
    }
    let halves = |texels: Vec<[f32; 4]>| texels.into_iter().map(|texel| texel.map(|x| half::f16::from_f32(x).to_f32()));
    let (sheen, ggx) = (SheenTable::embedded(), GgxTable::embedded());
    let [sheen, ggx] = [(sheen.size()[0], sheen.texels()), (ggx.texture_size()[0], ggx.texels())]
        .map(|(width, texels)| device::texture(width as u32, &halves(texels).collect::<Vec<_>>()));
    let source = [source, SHELL].concat();
    let buffers = [bytemuck::cast_slice(&inputs), bytemuck::cast_slice(&places)];
    let mut given = device::run_with::<f32>(&source, &buffers, &[&sheen, &ggx], count).into_iter().map(f64::from);
    let numbers = |row: &Row| given.by_ref().take(row.outputs.len()).collect();
    Answers { rows: rows.iter().map(|row| row.id).zip(rows.iter().map(numbers)).collect() }
}

/// The shipped files and the harness.
fn shipped() -> String {
    let files = ["ltc.wgsl", "ltc_sample.wgsl", "sheen.wgsl", "sheen_fit.wgsl", "ggx.wgsl"].map(files::source).concat();
    [&files, include_str!("golden.wgsl")].concat()
}

#[test]
fn the_shipped_files_give_the_golden_numbers() {
    let golden = Golden::new();
    let given = given(&shipped(), &golden.rows);
    for (index, function) in golden.functions.iter().enumerate() {
        let rows = golden.rows.iter().filter(|row| row.function == index);
        let share = rows.flat_map(|row| {
            let compared = row.tolerances.iter().zip(&row.outputs).zip(&given.rows[&row.id]);
            let used =
                compared.filter_map(|((tolerance, expected), given)| Some(((given - expected).abs(), (*tolerance)?)));
            used.map(|(error, tolerance)| if error == 0.0 { 0.0 } else { error / tolerance })
        });
        println!("{}: {:.2} of the tolerance", function.name, share.fold(0.0, f64::max));
    }
    let judgement = Judgement::of(&given, &golden);
    assert!(judgement.missing.is_empty() && judgement.off.is_empty(), "{:?}", judgement.off);
}

/// Functions in which no mistake is made here, and that drivers take long to compile.
const LEFT_OUT: [(&str, &str); 2] = [
    ("ltc_sample_edge", "golden_put_fan(0u, golden_sample_edge());"),
    (
        "ltc_sample_point",
        "golden_put_vec3(0u, ltc_sample_point(golden_fan(0u), golden_mat3(33u), golden_number(42u)));",
    ),
];

/// What is said of files and harness that have been edited.
fn judged(golden: &Golden, edits: &[(&str, &str)]) -> Judgement {
    let mut source = shipped();
    for (from, to) in edits.iter().copied().chain(LEFT_OUT.map(|(_, call)| (call, ""))) {
        assert!(source.contains(from), "'{from}' stands in the files");
        source = source.replace(from, to);
    }
    let is_left_out = |row: &Row| LEFT_OUT.iter().any(|(name, _)| *name == golden.functions[row.function].name);
    let rows: Vec<Row> = golden.rows.iter().filter(|row| !is_left_out(row)).cloned().collect();
    Judgement::of(&given(&source, &rows), golden)
}

/// Text that is replaced, and by what.
type Edit = (&'static str, &'static str);

/// Each mistake as it is made in code.
const MADE: [(Mistake, &[Edit]); 12] = [
    (Mistake::TableTransposed, &[("vec2(alpha, mu)", "vec2(mu, alpha)")]),
    (
        Mistake::TableTransposed,
        &[(
            "vec2(clamp(roughness, 0.0, 1.0), sqrt(1.0 - cosine))",
            "vec2(sqrt(1.0 - cosine), clamp(roughness, 0.0, 1.0))",
        )],
    ),
    (
        Mistake::MInvTransposed,
        &[
            (
                "mat3x3(abr.x, 0.0, 0.0, 0.0, abr.x, 0.0, abr.y, 0.0, 1.0)",
                "mat3x3(abr.x, 0.0, abr.y, 0.0, abr.x, 0.0, 0.0, 0.0, 1.0)",
            ),
            (
                "mat3x3(aspect * c, 0.0, 0.0, 0.0, c, 0.0, lean * c, 0.0, 1.0)",
                "mat3x3(aspect * c, 0.0, lean * c, 0.0, c, 0.0, 0.0, 0.0, 1.0)",
            ),
        ],
    ),
    // In the functions that read its entries.
    (Mistake::MInvTransposed, &[("let b = m_inv[2].x;", "let b = m_inv[0].z;")]),
    (Mistake::FrameTransposed, &[("return transpose(mat3x3(turn.x", "return (mat3x3(turn.x")]),
    (
        Mistake::FrameAboutLight,
        &[(
            "let frame = ltc_frame(normal, view);",
            "var middle = vec3(0.0);
            for (var k = 0u; k < count; k++) { middle += golden_vec3(13u + 3u * k) / f32(count); }
            let frame = ltc_frame(normal, normalize(middle - position));",
        )],
    ),
    (Mistake::BSign, &[("abr.y, 0.0, 1.0)", "-abr.y, 0.0, 1.0)"), ("lean * c, 0.0, 1.0)", "-lean * c, 0.0, 1.0)")]),
    (Mistake::AlphaSquared, &[("vec2(alpha, mu)", "vec2(alpha * alpha, mu)")]),
    (
        Mistake::NoHalfTexel,
        &[(
            "let at = clamp(vec2(alpha, mu), vec2(0.0), vec2(1.0)) * vec2<f32>(last);",
            "let at = clamp(clamp(vec2(alpha, mu), vec2(0.0), vec2(1.0)) * vec2<f32>(last + 1u) - 0.5, vec2(0.0), vec2<f32>(last));",
        )],
    ),
    (Mistake::TurnForgotten, &[("return turned / max(abs(turned.x) + abs(turned.y), 1e-37);", "return turn;")]),
    (
        Mistake::TurnForgotten,
        &[
            ("turn = ltc_turn(turn, outline, GOLDEN_IDENTITY);", ""),
            ("specular_turn = ltc_turn(specular_turn, outline, specular.m_inv);", ""),
        ],
    ),
    (
        Mistake::WindingReversed,
        &[
            ("var before = golden_vec3(10u + 3u * count);", "var before = golden_vec3(13u);"),
            ("let corner = golden_vec3(13u + 3u * k);", "let corner = golden_vec3(10u + 3u * (count - k));"),
        ],
    ),
];

#[test]
fn each_mistake_that_is_made_in_code_is_named() {
    let golden = Golden::new();
    for (mistake, edits) in MADE {
        let judgement = judged(&golden, edits);
        let (off, causes) = (judgement.rows_off().len(), &judgement.causes);
        let counts: Vec<_> = causes.iter().map(|cause| (cause.mistake, cause.rows.len())).collect();
        println!("{mistake:?}: {off} rows off, {counts:?}, none for {:?}", judgement.unexplained);
        assert!(off >= 12, "{mistake:?} is off in {off} rows");
        assert_eq!(causes[0].mistake, mistake);
        assert!(10 * causes[0].rows.len() >= 9 * off, "{mistake:?} fits {} of {off} rows", causes[0].rows.len());
    }
}

#[test]
fn what_is_less_exact_than_the_files_is_off_and_no_mistake_fits() {
    let golden = Golden::new();
    // An ordinary cross product; a rough arctangent; a sampler's weights.
    for (from, to) in [
        ("return (p_high.yzx * q_high.zxy - p_high.zxy * q_high.yzx) + 0.5 * rest;", "return cross(p, q);"),
        ("0.99999753", "0.9999"),
        ("let weight = at - vec2<f32>(low);", "let weight = floor(256.0 * (at - vec2<f32>(low)) + 0.5) / 256.0;"),
    ] {
        let judgement = judged(&golden, &[(from, to)]);
        let off = judgement.rows_off().len();
        assert!(off >= 3 && judgement.unexplained.len() * 10 >= 9 * off, "'{to}': {:?}", judgement.causes);
    }
}

/// Other languages get the harness by the same translation as the files: it has no more of WGSL than they have.
#[test]
fn the_harness_can_be_carried_over_like_the_files() {
    let harness = include_str!("golden.wgsl");
    assert_eq!(reserved(harness), [""; 0]);
    let code = harness.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<String>();
    for word in ["array", "@", "var<", "ptr", "switch", "while", "loop", "vec3f", "fn golden_number(", "fn golden_put("]
    {
        assert!(!code.contains(word), "{word}");
    }
    assert!(harness.lines().count() <= 200);
    // A branch for each function, in the order of the numbers.
    for (index, function) in Golden::new().functions.iter().enumerate() {
        let (_, branch) = harness.split_once(&format!("if function == {index}u {{")).expect("each has a branch");
        let call = format!(
            "{}(",
            function.name.replace("ltc_sample_edge", "golden_sample_edge").replace("lights", "golden_lights")
        );
        assert!(branch.split('}').next().is_some_and(|branch| branch.contains(&call)), "{index} is {}", function.name);
    }
}
