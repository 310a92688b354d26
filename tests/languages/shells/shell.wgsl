// Runs the rows of golden numbers: a row an invocation.

struct Row { function: u32, first_input: u32, first_output: u32, unused: u32 }

@group(0) @binding(0) var<storage, read_write> results: array<f32>;
@group(0) @binding(1) var<storage, read> numbers: array<f32>;
@group(0) @binding(2) var<storage, read> rows: array<Row>;
@group(0) @binding(3) var shell_sheen_table: texture_2d<f32>;
@group(0) @binding(4) var shell_ggx_table: texture_2d<f32>;

var<private> shell_row: Row;

fn golden_number(index: u32) -> f32 {
    return numbers[shell_row.first_input + index];
}

fn golden_put(index: u32, value: f32) {
    results[shell_row.first_output + index] = value;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < arrayLength(&rows) {
        shell_row = rows[id.x];
        golden_row(shell_sheen_table, shell_ggx_table, shell_row.function);
    }
}
