#version 450
#extension GL_EXT_samplerless_texture_functions : require

// Runs the rows of golden numbers: a row an invocation. A row is its function, its first input and its first output.

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) buffer Results { float results[]; };
layout(set = 0, binding = 1) readonly buffer Numbers { float numbers[]; };
layout(set = 0, binding = 2) readonly buffer Rows { uvec4 rows[]; };
layout(set = 0, binding = 3) uniform texture2D shell_sheen_table;
layout(set = 0, binding = 4) uniform texture2D shell_ggx_table;

uvec4 shell_row;

float golden_number(uint index) {
    return numbers[shell_row.y + index];
}

void golden_put(uint index, float value) {
    results[shell_row.z + index] = value;
}
