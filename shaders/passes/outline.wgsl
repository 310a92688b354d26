// The outline of what is made of a material: a mask of where that is seen, and a line along the mask's border.

struct OutlineUniforms {
    // The pixel of the output that shows the mask's first.
    origin: vec2u,
}

@group(0) @binding(0) var<uniform> outline_uniforms: OutlineUniforms;
// 1 where it is seen, else 0.
@group(0) @binding(1) var outline_mask: texture_2d<f32>;

struct OutlineVarying {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) mark: f32,
}

// `x` to `w` are the columns of clip_from_mesh.
@vertex
fn outline_place(
    @location(0) position: vec3f,
    @location(1) x: vec4f,
    @location(2) y: vec4f,
    @location(3) z: vec4f,
    @location(4) w: vec4f,
    @location(5) mark: f32,
) -> OutlineVarying {
    return OutlineVarying(mat4x4f(x, y, z, w) * vec4f(position, 1.0), mark);
}

@fragment
fn outline_mark(placed: OutlineVarying) -> @location(0) vec4f {
    return vec4f(placed.mark, 0.0, 0.0, 1.0);
}

// A light pixel within the border and a dark one outside it, so that one of them stands out before anything. Where the
// picture ends there is no border.
@fragment
fn outline_line(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(vec2u(position.xy) - outline_uniforms.origin);
    let last = vec2i(textureDimensions(outline_mask)) - 1;
    let here = textureLoad(outline_mask, pixel, 0).r;
    var is_border = false;
    for (var neighbour = 0; neighbour < 9; neighbour++) {
        let at = clamp(pixel + vec2i(neighbour % 3, neighbour / 3) - 1, vec2i(0), last);
        is_border = is_border || textureLoad(outline_mask, at, 0).r != here;
    }
    if !is_border {
        discard;
    }
    return vec4f(vec3f(select(0.1, 0.9, here > 0.5)), 1.0);
}
