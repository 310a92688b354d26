// Runs the rows of golden numbers: a row an invocation. A row is its function, its first input and its first output.

[[vk::binding(0, 0)]] RWStructuredBuffer<float> results;
[[vk::binding(1, 0)]] StructuredBuffer<float> numbers;
[[vk::binding(2, 0)]] StructuredBuffer<uint4> rows;
[[vk::binding(3, 0)]] Texture2D shell_sheen_table;
[[vk::binding(4, 0)]] Texture2D shell_ggx_table;

static uint4 shell_row;

float golden_number(uint index) {
    return numbers[shell_row.y + index];
}

void golden_put(uint index, float value) {
    results[shell_row.z + index] = value;
}
