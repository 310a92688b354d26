// Shading, filtered over a pixel: once at the centroid of what is covered, with lobes that are widened, or, where normals vary over the
// pixel by more than the specular lobe is wide, at each of the samples that are covered.

// How much wider the normals' variance is than alpha^2, for which each sample is shaded, and the least that counts.
const FILTERS_SHARP = 0.1;
const FILTERS_FLAT = 2e-5;
// The share of a pixel's variance that is left to each of its samples. The lobe grows by no more than itself, so that what is
// black beside a smooth surface's reflections stays so.
const FILTERS_LEFT = 0.05;

struct FiltersPixel {
    // How the interpolated normal, not of unit length, changes from one pixel to the next.
    right: vec3f,
    down: vec3f,
    // Of the unit normals over the pixel.
    variance: f32,
    // What the cosines to the view span.
    width: f32,
    // Whether samples are shaded one by one.
    is_sharp: bool,
}

// `samples` has a bit for each that is covered. A single one is the centroid.
fn filters_pixel(n_center: vec3f, view: vec3f, roughness: f32, samples: u32) -> FiltersPixel {
    var pixel: FiltersPixel;
    if VARIANT_FILTERED {
        pixel.right = texels_footprint * dpdx(n_center);
        pixel.down = texels_footprint * dpdy(n_center);
        let unit = filters_normalize(n_center);
        let right = texels_footprint * dpdx(unit);
        let down = texels_footprint * dpdy(unit);
        pixel.width = abs(dot(right, view)) + abs(dot(down, view));
        pixel.variance = 0.25 * (dot(right, right) + dot(down, down));
        let squared = roughness * roughness * roughness * roughness;
        if VARIANT_SHARP && pixel.variance > FILTERS_SHARP * squared + FILTERS_FLAT {
            pixel.variance = min(FILTERS_LEFT * pixel.variance, squared);
            pixel.is_sharp = countOneBits(samples & COVERAGE_ALL) > 1u;
        }
    }
    return pixel;
}

// From the normal at the pixel's centre to that at a sample.
fn filters_offset(pixel: FiltersPixel, index: u32) -> vec3f {
    return COVERAGE_SAMPLE_X[index] * pixel.right + COVERAGE_SAMPLE_Y[index] * pixel.down;
}

fn filters_covers(samples: u32, index: u32) -> bool {
    return (samples & (1u << index)) != 0u;
}

// Over a pixel at a silhouette the cosine to the view runs through 0, and only its positive part is seen. A single sample there could be anything
// up to the sheen's peak; this is the mean over the visible part of a pixel whose cosines span `width`.
fn filters_visible_mean(mu: f32, width: f32) -> f32 {
    let half_width = min(0.5 * width, 0.5);
    return 0.5 * (max(mu - half_width, 0.0) + max(mu + half_width, 0.0));
}

// Normals that vary over a pixel widen the specular lobe (Tokuyoshi and Kaplanyan 2019, eqs. 4 and 5: the half vector's variance from
// the normal's derivatives), as do those that a mipmap has averaged, whose mean is shorter than 1 (Toksvig 2005).
fn filters_roughness(roughness: f32, variance: f32, mean_length: f32) -> f32 {
    let mapped = 2.0 * (1.0 - mean_length) / max(mean_length, 0.5);
    let alpha = roughness * roughness;
    return sqrt(sqrt(min(alpha * alpha + min(variance + mapped, 0.18), 1.0)));
}

// A zero vector, which no direction stands for, comes back as it is.
fn filters_normalize(v: vec3f) -> vec3f {
    let length_squared = dot(v, v);
    return v * select(0.0, inverseSqrt(length_squared), length_squared > 0.0);
}
