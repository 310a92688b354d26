// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// The sheen of sheen.metal without its table: short formulas that were fitted to the table, some fifty multiply-adds and an exponential.
// Copy with it: ltc.metal, which integrates the matrix over lights; the weights of sheen.metal take this albedo too.
// Frame: z = normal, x = view projected on the surface, as ltc_frame makes it; mu = dot(normal, view).
// Example: SheenFitLobe lobe = sheen_fit_lobe(alpha, mu); float3 radiance = light * sheen_color * lobe.albedo * form_factor;
// Ranges: alpha and mu in [0,1], clamped; a > 0.002, b <= 0, r in [0,1]. Made for alpha >= 0.1; below, r is off next to mu = 0.
// Greatest error: for alpha >= 3/31, a 0.054, b 0.016, r 0.036 (mean 0.005, 0.003, 0.002) against the table; below, a 0.14, b 0.02, r 0.45.
// Language: Metal 1.1 and later. Half floats are not enough.

#include <metal_stdlib>
using namespace metal;

struct SheenFitLobe {
    float3x3 m_inv;  // rows (a,0,b), (0,a,0), (0,0,1)
    float albedo;    // r: the share of the light from the view's direction that the fibres send back up
};

// Past it the albedo is 0 to all digits, and the exponential nears what floats can hold.
constant float SHEEN_FIT_DARK = 60.0f;

// Used above their definitions.
inline float sheen_fit_a(float y, float x);
inline float sheen_fit_b(float y, float x);
inline float sheen_fit_albedo(float y, float x);

// The lobe for a roughness alpha and the view's cosine mu: a = p^2 / q, b = -sqrt(1 - mu) (1 - alpha) p^2 / q, r = 1 / (1 + exp(p / q)), with
// polynomials p and q > 0 of their own (scripts/fit_formula).
inline SheenFitLobe sheen_fit_lobe(float alpha, float mu) {
    float y = clamp(alpha, 0.0f, 1.0f);
    float x = clamp(mu, 0.0f, 1.0f);
    float a = sheen_fit_a(y, x);
    float b = sheen_fit_b(y, x);
    return SheenFitLobe{float3x3(a, 0.0f, 0.0f, 0.0f, a, 0.0f, b, 0.0f, 1.0f), sheen_fit_albedo(y, x)};
}

inline float sheen_fit_a(float y, float x) {
    float above = 0.0712243f + x * (2.08384f + x * (0.447737f + x * 1.33883f));
    float p = above + y * (-1.44859f + x * (5.11827f - x * 1.43431f) + y * (11.8824f - x * 4.78599f - y * 2.86849f));
    float q = 1.0f + x * (8.39524f + x * 57.9343f) + y * (-18.981f - x * 20.0247f + y * 97.6674f);
    return p * p / q;
}

inline float sheen_fit_b(float y, float x) {
    float p = 0.0141647f + x * (-0.262813f + x * 4.68426f) + y * (1.11618f - x * 4.6743f + y * 3.33543f);
    float q = 1.0f + x * (30.9435f + x * 50.5242f) + y * (-8.88411f - x * 88.4877f + y * 35.9859f);
    return -sqrt(1.0f - x) * (1.0f - y) * p * p / q;
}

inline float sheen_fit_albedo(float y, float x) {
    float above = 0.923733f + x * (25.714f + x * (952.057f - x * 486.046f));
    float p = above + y * (-17.0376f + x * (-10.1195f - x * 6.4266f) + y * (1.24115f - x * 287.551f - y * 25.5475f));
    float below = 1.0f + x * (-9.89936f + x * (26.4968f - x * 6.45657f));
    float q = below + y * (-8.05803f + x * (367.165f - x * 227.569f) + y * (78.7201f + x * 43.9768f - y * 37.6456f));
    return 1.0f / (1.0f + exp(min(p / q, SHEEN_FIT_DARK)));
}
