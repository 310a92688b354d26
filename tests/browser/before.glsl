#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;

// A row of pixels for each row of golden numbers; a pixel shows the bits of one output.

uniform sampler2D shell_numbers;  // a function, then inputs
uniform sampler2D shell_sheen_table;
uniform sampler2D shell_ggx_table;
out uvec4 shell_bits;

float golden_number(uint index) {
    return texelFetch(shell_numbers, ivec2(index + 1u, gl_FragCoord.y), 0).x;
}

void golden_put(uint index, float value) {
    if (index == uint(gl_FragCoord.x)) {
        shell_bits.x = floatBitsToUint(value);
    }
}
