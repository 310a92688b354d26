// The walk around polygon lights: form factors of all lobes at once.

struct PolygonsLight {
    radiance: vec3f,
    two_sided: u32,
    normal: vec3f,
    first_vertex: u32,
    // A sphere around all vertices.
    center: vec3f,
    radius: f32,
    end_vertex: u32,
    // In prior_sheens_points.
    first_point: u32,
    end_point: u32,
}

@group(0) @binding(6) var<storage, read> polygons_lights: array<PolygonsLight>;
// Outlines one after another; w = 1 marks the first vertex of each, which comes again at its end with w = -1.
@group(0) @binding(7) var<storage, read> polygons_vertices: array<vec4f>;

// The error of interpolated positions, as a share of the largest coordinate: a few roundings of f32. Points no further
// from a light's plane are in it, so that a light does not shine on itself.
const POLYGONS_POSITION_ERROR = 1e-6;
const POLYGONS_IDENTITY = mat3x3f(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);

// On the way round a light.
struct PolygonsWalk {
    outline: LtcOutline,
    // Of the diffuse, specular and sheen lobe.
    sums: vec3f,
    // Along the horizon: xy of the diffuse lobe and the sheen, zw of the specular one.
    turns: vec4f,
    // The diffuse lobe's sum as a vector.
    vector: vec3f,
    // The light's vertex reached, and the contour's first that is above the surface, where there has been one.
    corner: vec3f,
    first: vec3f,
    is_begun: bool,
}

fn polygons_walk(walk: PolygonsWalk, receiver: LightsReceiver, vertex: vec3f) -> PolygonsWalk {
    let outline = ltc_next(walk.outline, vertex);
    var next = PolygonsWalk(outline, walk.sums, walk.turns, walk.vector, vertex, walk.first, true);
    next.sums.x += ltc_edge(outline, POLYGONS_IDENTITY);
    next.turns = vec4f(ltc_turn(walk.turns.xy, outline, POLYGONS_IDENTITY), walk.turns.zw);
    if SURFACES_SPECULAR {
        next.sums.y += ltc_edge(outline, receiver.ggx);
        next.turns = vec4f(next.turns.xy, ltc_turn(walk.turns.zw, outline, receiver.ggx));
    }
    if SURFACES_SHEEN && PRIOR_SHEENS_MODEL == 0u {
        next.sums.z += ltc_edge(outline, receiver.sheen);
    }
    if SURFACES_RECIPROCAL {
        next.vector += ltc_edge_vector(outline);
    }
    return next;
}

// Under a normal map light has to come from above the surface too, not only from above the mapped normal's horizon: the outline is
// cut at the surface (Sutherland and Hodgman 1974) before it is walked along.
fn polygons_walk_above(walk: PolygonsWalk, receiver: LightsReceiver, vertex: vec3f, is_last: bool) -> PolygonsWalk {
    let start = dot(receiver.up, walk.corner);
    let end = dot(receiver.up, vertex);
    var next = walk;
    if (start > 0.0) != (end > 0.0) {
        next = polygons_walk_on(next, receiver, mix(walk.corner, vertex, start / (start - end)));
    }
    if end > 0.0 {
        next = polygons_walk_on(next, receiver, vertex);
    }
    if is_last && next.is_begun {
        next = polygons_walk(next, receiver, next.first);
    }
    next.corner = vertex;
    return next;
}

// Begins where nothing has begun.
fn polygons_walk_on(walk: PolygonsWalk, receiver: LightsReceiver, vertex: vec3f) -> PolygonsWalk {
    if walk.is_begun {
        return polygons_walk(walk, receiver, vertex);
    }
    return PolygonsWalk(ltc_begin(vertex), walk.sums, walk.turns, walk.vector, vertex, vertex, true);
}

// Form factors of one light: diffuse, specular, sheen; w is the mean cosine of its directions. is_quad where it is known to be one
// outline of four vertices: what is not in a loop, and loads from places that are known, costs two thirds.
fn polygons_form_factors(receiver: LightsReceiver, light: PolygonsLight, is_quad: bool) -> vec4f {
    let to_vertex = polygons_vertices[light.first_vertex].xyz - receiver.p_world;
    let side = ltc_side(light.normal, to_vertex, light.two_sided != 0u);
    let size = abs(receiver.p_world) + abs(to_vertex);
    let error = POLYGONS_POSITION_ERROR * max(size.x, max(size.y, size.z));
    if side == 0.0 || abs(dot(light.normal, to_vertex)) <= error {
        return vec4f(0.0);
    }
    var walk: PolygonsWalk;
    walk.turns = vec4f(LTC_LEVEL, LTC_LEVEL);
    if is_quad && !MATERIAL_NORMAL {
        let first = light.first_vertex;
        walk.outline = ltc_begin(polygons_local(receiver, first + 3u));
        walk = polygons_walk(walk, receiver, polygons_local(receiver, first));
        walk = polygons_walk(walk, receiver, polygons_local(receiver, first + 1u));
        walk = polygons_walk(walk, receiver, polygons_local(receiver, first + 2u));
        walk = polygons_walk(walk, receiver, polygons_local(receiver, first + 3u));
    } else {
        walk = polygons_walk_all(walk, receiver, light);
    }
    let turn = walk.turns.xy;
    return vec4f(
        ltc_form_factor(walk.sums.x, turn, POLYGONS_IDENTITY, side),
        ltc_form_factor(walk.sums.y, walk.turns.zw, receiver.ggx, side),
        ltc_form_factor(walk.sums.z, turn, receiver.sheen, side),
        polygons_mean_cosine(ltc_vector(walk.vector, turn, side)),
    );
}

fn polygons_local(receiver: LightsReceiver, index: u32) -> vec3f {
    return receiver.local_from_world * (polygons_vertices[index].xyz - receiver.p_world);
}

// Any number of outlines and vertices.
fn polygons_walk_all(start: PolygonsWalk, receiver: LightsReceiver, light: PolygonsLight) -> PolygonsWalk {
    var walk = start;
    for (var index = light.first_vertex; index < light.end_vertex; index++) {
        let mark = polygons_vertices[index].w;
        let p_local = polygons_local(receiver, index);
        if mark > 0.0 {
            walk = PolygonsWalk(
                ltc_begin(p_local), walk.sums, walk.turns, walk.vector, p_local, p_local, !MATERIAL_NORMAL,
            );
        } else if MATERIAL_NORMAL {
            walk = polygons_walk_above(walk, receiver, p_local, mark < 0.0);
        } else {
            walk = polygons_walk(walk, receiver, p_local);
        }
    }
    return walk;
}

// The mean cosine of a light's directions, weighted by the cosine, from its vector irradiance under unit radiance over pi (whose z is
// the form factor): that of a round light straight above of the same size, 2/3 for the whole hemisphere, times the vector's.
fn polygons_mean_cosine(vector: vec3f) -> f32 {
    let size = min(length(vector), 1.0);
    let rest = sqrt(1.0 - size);
    // (2/3) (1 - rest^3) / (1 - rest^2), without its 0/0.
    let shrink = 2.0 / 3.0 * (1.0 + rest + rest * rest) / (1.0 + rest);
    return saturate(vector.z / max(size, 1e-20)) * shrink;
}
