// Points of polygon lights, drawn by what lobes scatter of them.

// PLACEHOLDER by area
fn samples_point(receiver: Receiver, light: u32, uniforms: vec2f) -> vec4f {
    let first = polygons_lights[light].first_vertex;
    let a = polygons_vertices[first].xyz;
    let b = polygons_vertices[first + 1u].xyz;
    let c = polygons_vertices[first + 2u].xyz;
    let d = polygons_vertices[first + 3u].xyz;
    let x = a + uniforms.x * (b - a) + uniforms.y * (d - a);
    let way = x - receiver.p_world;
    let area = length(cross(b - a, d - a));
    let distance = length(way);
    let cosine = abs(dot(polygons_lights[light].normal, way)) / distance;
    return vec4f(receiver.local_from_world * (way / distance), distance * distance / (cosine * area));
}
