// Runs the rows of golden numbers on the processor: Metal is C++, but for what its standard library brings, which
// metal_stdlib beside this file stands in for.

#include <metal_stdlib>
#include <cstdio>
#include <vector>
using namespace metal;

static const float* shell_numbers;
static float* shell_results;

inline float golden_number(uint index) {
    return shell_numbers[index];
}

inline void golden_put(uint index, float value) {
    shell_results[index] = value;
}
