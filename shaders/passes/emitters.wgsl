// The polygons that emit light, and their outlines.

struct EmittersPolygon {
    radiance: vec3f,
    two_sided: u32,
    normal: vec3f,
    first_vertex: u32,
    // A sphere around all vertices.
    center: vec3f,
    radius: f32,
    end_vertex: u32,
    // In points_on_polygons.
    first_point: u32,
    end_point: u32,
    // In Drawn::lights.
    light: u32,
    // Its convex parts, as outlines, too.
    first_part_vertex: u32,
    end_part_vertex: u32,
    // In patterns_sheets, else PATTERNS_NONE; and how many texels there are in the rectangle of it that is shown.
    pattern: u32,
    pattern_texels: f32,
}

// Texels of a light.
const EMITTERS_TEXELS = 5u;

fn emitters_polygon(index: u32) -> EmittersPolygon {
    let first = frame_now.first_light + EMITTERS_TEXELS * index;
    let glow = numbers_at(first);
    let plane = numbers_at(first + 1u);
    let sphere = bitcast<vec4f>(numbers_at(first + 2u));
    let ranges = numbers_at(first + 3u);
    let parts = numbers_at(first + 4u);
    return EmittersPolygon(
        bitcast<vec3f>(glow.xyz), glow.w, bitcast<vec3f>(plane.xyz), plane.w, sphere.xyz, sphere.w, ranges.x, ranges.y,
        ranges.z, ranges.w, parts.x, parts.y, parts.z, bitcast<f32>(parts.w),
    );
}

// Outlines stand one after another; w = 1 marks the first vertex of each, which comes again at its end with w = -1.
fn emitters_vertex(index: u32) -> vec4f {
    return bitcast<vec4f>(numbers_at(frame_now.first_vertex + index));
}
