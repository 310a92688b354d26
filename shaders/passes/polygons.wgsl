// The walk around polygon lights: form factors of all lobes at once.

// The error of interpolated positions, as a share of the largest coordinate: a few roundings of f32. Points no further
// from a light's plane are in it, so that a light does not shine on itself.
const POLYGONS_POSITION_ERROR = 1e-6;

// The angles along the horizon that close the clipped contours: one for all lobes with c = a, one for each other lobe.
struct PolygonsTurns {
    // Of the diffuse lobe and the sheen.
    isotropic: vec2f,
    specular: vec2f,
}

// On the way round a light.
struct PolygonsWalk {
    outline: LtcOutline,
    sums: LobesVectors,
    turns: PolygonsTurns,
    // The light's vertex reached, and the contour's first that is above the surface, where there has been one.
    corner: vec3f,
    first: vec3f,
    is_begun: bool,
}

// Where an edge of a light goes through the surface, if it does, and whether it ends above.
struct PolygonsCut {
    is_crossed: bool,
    crossing: vec3f,
    is_above: bool,
}

// What a light is to a receiver.
struct PolygonsIntegrals {
    form_factors: LobesScalars,
    // As ltc_vector has them: their z are the form factors.
    directions: LobesVectors,
    // Of the light's directions, weighted by the cosine.
    mean_cosine: f32,
}

fn polygons_walk(walk: PolygonsWalk, receiver: Receiver, vertex: vec3f) -> PolygonsWalk {
    let outline = ltc_next(walk.outline, vertex);
    var next = walk;
    next.outline = outline;
    next.corner = vertex;
    next.is_begun = true;
    next.sums.diffuse += ltc_edge_vector(outline, LOBES_DIFFUSE);
    next.turns.isotropic = ltc_turn(walk.turns.isotropic, outline, LOBES_DIFFUSE);
    if VARIANT_SPECULAR {
        next.sums.specular += ltc_edge_vector(outline, receiver.lobes.specular.m_inv);
        next.turns.specular = ltc_turn(walk.turns.specular, outline, receiver.lobes.specular.m_inv);
    }
    if VARIANT_SHEEN && !VARIANT_PRIOR_SHEEN {
        next.sums.sheen += ltc_edge_vector(outline, receiver.lobes.sheen.m_inv);
    }
    return next;
}

// Under a normal map light has to come from above the surface too, not only from above the mapped normal's horizon: the outline is
// cut at the surface (Sutherland and Hodgman 1974) before it is walked along.
fn polygons_walk_above(walk: PolygonsWalk, receiver: Receiver, vertex: vec3f, is_last: bool) -> PolygonsWalk {
    let cut = polygons_cut(receiver, walk.corner, vertex);
    var next = walk;
    if cut.is_crossed {
        next = polygons_walk_on(next, receiver, cut.crossing);
    }
    if cut.is_above {
        next = polygons_walk_on(next, receiver, vertex);
    }
    if is_last && next.is_begun {
        next = polygons_walk(next, receiver, next.first);
    }
    next.corner = vertex;
    return next;
}

fn polygons_cut(receiver: Receiver, corner: vec3f, vertex: vec3f) -> PolygonsCut {
    let start = dot(receiver.up, corner);
    let end = dot(receiver.up, vertex);
    return PolygonsCut((start > 0.0) != (end > 0.0), mix(corner, vertex, start / (start - end)), end > 0.0);
}

// Begins where nothing has begun.
fn polygons_walk_on(walk: PolygonsWalk, receiver: Receiver, vertex: vec3f) -> PolygonsWalk {
    if walk.is_begun {
        return polygons_walk(walk, receiver, vertex);
    }
    return polygons_begin(walk, vertex, true);
}

// Begins a contour. It is walked along from here, or from where polygons_walk_above comes above the surface.
fn polygons_begin(walk: PolygonsWalk, vertex: vec3f, is_begun: bool) -> PolygonsWalk {
    var next = walk;
    next.outline = ltc_begin(vertex);
    next.corner = vertex;
    next.first = vertex;
    next.is_begun = is_begun;
    return next;
}

// is_quad: the light is one outline of four vertices. Unrolled, with loads from fixed places, its walk takes two thirds of the time.
fn polygons_integrals(receiver: Receiver, light: EmittersPolygon, is_quad: bool) -> PolygonsIntegrals {
    let to_vertex = emitters_vertex(light.first_vertex).xyz - receiver.p_world;
    let side = ltc_side(light.normal, to_vertex, light.two_sided != 0u);
    let size = abs(receiver.p_world) + abs(to_vertex);
    let error = POLYGONS_POSITION_ERROR * max(size.x, max(size.y, size.z));
    var integrals: PolygonsIntegrals;
    if side == 0.0 || abs(dot(light.normal, to_vertex)) <= error {
        return integrals;
    }
    let walk = polygons_walk_around(receiver, light, is_quad);
    let turns = walk.turns;
    let lobes = receiver.lobes;
    let sums = walk.sums;
    integrals.form_factors.diffuse = ltc_form_factor(sums.diffuse.z, turns.isotropic, LOBES_DIFFUSE, side);
    integrals.form_factors.specular = ltc_form_factor(sums.specular.z, turns.specular, lobes.specular.m_inv, side);
    integrals.form_factors.sheen = ltc_form_factor(sums.sheen.z, turns.isotropic, lobes.sheen.m_inv, side);
    integrals.directions.diffuse = ltc_vector(sums.diffuse, turns.isotropic, side);
    integrals.directions.specular = ltc_vector(sums.specular, turns.specular, side);
    integrals.directions.sheen = ltc_vector(sums.sheen, turns.isotropic, side);
    integrals.mean_cosine = polygons_mean_cosine(integrals.directions.diffuse);
    return integrals;
}

fn polygons_walk_around(receiver: Receiver, light: EmittersPolygon, is_quad: bool) -> PolygonsWalk {
    var walk: PolygonsWalk;
    walk.turns = PolygonsTurns(LTC_LEVEL, LTC_LEVEL);
    if !is_quad || VARIANT_NORMAL_MAP {
        return polygons_walk_all(walk, receiver, light);
    }
    let first = light.first_vertex;
    walk.outline = ltc_begin(polygons_local(receiver, first + 3u));
    walk = polygons_walk(walk, receiver, polygons_local(receiver, first));
    walk = polygons_walk(walk, receiver, polygons_local(receiver, first + 1u));
    walk = polygons_walk(walk, receiver, polygons_local(receiver, first + 2u));
    return polygons_walk(walk, receiver, polygons_local(receiver, first + 3u));
}

fn polygons_local(receiver: Receiver, index: u32) -> vec3f {
    return receiver.local_from_world * (emitters_vertex(index).xyz - receiver.p_world);
}

// Any number of outlines and vertices.
fn polygons_walk_all(start: PolygonsWalk, receiver: Receiver, light: EmittersPolygon) -> PolygonsWalk {
    var walk = start;
    for (var index = light.first_vertex; index < light.end_vertex; index++) {
        let mark = emitters_vertex(index).w;
        let p_local = polygons_local(receiver, index);
        if mark > 0.0 {
            walk = polygons_begin(walk, p_local, !VARIANT_NORMAL_MAP);
        } else if VARIANT_NORMAL_MAP {
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
