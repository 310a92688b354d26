//! The shipped files on the device against the golden numbers.

use crate::{device, files};
use velour::export::golden::{Golden, Row};
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

/// What a port that is given as `source` gives for each row, on textures of halves.
fn answers(source: &str, rows: &[Row]) -> Vec<Vec<f32>> {
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
    let source = [source, include_str!("golden.wgsl"), SHELL].concat();
    let buffers = [bytemuck::cast_slice(&inputs), bytemuck::cast_slice(&places)];
    let mut given = device::run_with::<f32>(&source, &buffers, &[&sheen, &ggx], count).into_iter();
    rows.iter().map(|row| given.by_ref().take(row.outputs.len()).collect()).collect()
}

fn shipped() -> String {
    ["ltc.wgsl", "ltc_sample.wgsl", "sheen.wgsl", "ggx.wgsl"].map(files::source).concat()
}

#[test]
fn the_shipped_files_give_the_golden_numbers() {
    let golden = Golden::new();
    let mut used = vec![(0.0_f64, 0); golden.functions.len()];
    let mut off = Vec::new();
    for (row, given) in golden.rows.iter().zip(answers(&shipped(), &golden.rows)) {
        for (k, given) in given.into_iter().enumerate() {
            let Some(tolerance) = row.tolerances[k] else { continue };
            let error = (f64::from(given) - row.outputs[k]).abs();
            let share = if error == 0.0 { 0.0 } else { error / tolerance };
            let most = &mut used[row.function];
            if !(share <= most.0) {
                *most = (share, row.id);
            }
            if !(error <= tolerance) {
                let name = &golden.functions[row.function].outputs[k];
                off.push(format!("{} {name} {}: {given} is not {} +- {tolerance:e}", row.id, row.case, row.outputs[k]));
            }
        }
    }
    for (function, (share, id)) in golden.functions.iter().zip(used) {
        println!("{}: {share:.2} of the tolerance at {id}", function.name);
    }
    assert!(off.is_empty(), "{} numbers\n{}", off.len(), off.join("\n"));
}
