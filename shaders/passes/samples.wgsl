// Points of polygon lights, drawn by what a lobe scatters of them.

// On the way round a light's convex parts.
struct SamplesWalk {
    outline: LtcOutline,
    fan: LtcSampleFan,
    // The vertex reached, and the part's first that is above the surface, where there has been one.
    corner: vec3f,
    first: vec3f,
    is_begun: bool,
}

// A direction towards a point of the light, in the local frame: of the lobe's density over the light's form factor. 0 where there is none.
fn samples_direction(receiver: Receiver, light: u32, m_inv: mat3x3f, form_factor: f32, numbers: vec2f) -> vec3f {
    var walk: SamplesWalk;
    walk.fan = ltc_sample_begin(numbers.x, form_factor);
    let end = emitters_polygon(light).end_part_vertex;
    for (var index = emitters_polygon(light).first_part_vertex; index < end; index++) {
        let mark = emitters_vertex(index).w;
        let p_local = polygons_local(receiver, index);
        if mark > 0.0 {
            walk = samples_begin(walk, p_local, !VARIANT_NORMAL_MAP);
            walk.fan.apex = vec3f(0.0);
        } else if VARIANT_NORMAL_MAP {
            walk = samples_walk_above(walk, receiver, m_inv, p_local, mark < 0.0);
        } else {
            walk = samples_walk(walk, m_inv, p_local);
        }
    }
    return ltc_sample_point(walk.fan, m_inv, numbers.y);
}

fn samples_begin(walk: SamplesWalk, vertex: vec3f, is_begun: bool) -> SamplesWalk {
    var next = walk;
    next.outline = ltc_begin(vertex);
    next.corner = vertex;
    next.first = vertex;
    next.is_begun = is_begun;
    return next;
}

fn samples_walk(walk: SamplesWalk, m_inv: mat3x3f, vertex: vec3f) -> SamplesWalk {
    let outline = ltc_next(walk.outline, vertex);
    var next = walk;
    next.outline = outline;
    next.fan = ltc_sample_edge(walk.fan, outline.p, outline.q, outline.normal, outline.sine, m_inv);
    return next;
}

// As polygons_walk_above cuts outlines.
fn samples_walk_above(walk: SamplesWalk, receiver: Receiver, m_inv: mat3x3f, vertex: vec3f, is_last: bool) -> SamplesWalk {
    let cut = polygons_cut(receiver, walk.corner, vertex);
    var next = walk;
    if cut.is_crossed {
        next = samples_walk_on(next, m_inv, cut.crossing);
    }
    if cut.is_above {
        next = samples_walk_on(next, m_inv, vertex);
    }
    if is_last && next.is_begun {
        next = samples_walk(next, m_inv, next.first);
    }
    next.corner = vertex;
    return next;
}

fn samples_walk_on(walk: SamplesWalk, m_inv: mat3x3f, vertex: vec3f) -> SamplesWalk {
    if walk.is_begun {
        return samples_walk(walk, m_inv, vertex);
    }
    return samples_begin(walk, vertex, true);
}
