// Form factors of lobes that have no closed form: sums over points on a polygon light.

// Points on each polygon; w is the area that each stands for.
@group(0) @binding(7) var<storage, read> points_on_polygons: array<vec4f>;

// Greatest ratio of what the points see of a light to its exact form factor.
const POINTS_MOST = 2.0;

// What a point stands for, in the prior sheen and in the diffuse lobe.
struct PointsSeen {
    sheen: f32,
    diffuse: f32,
    // Of the light's radiance there.
    factor: vec3f,
}

// Of all of them in the prior sheen.
struct PointsSum {
    form_factor: f32,
    // Of the light's radiance, on average.
    factor: vec3f,
}

// One of them.
struct PointsPick {
    // To it, in the world.
    way: vec3f,
    factor: vec3f,
}

fn points_seen(receiver: Receiver, polygon: u32, index: u32) -> PointsSeen {
    let point = points_on_polygons[index];
    let way = point.xyz - receiver.p_world;
    let inverse = inverseSqrt(max(dot(way, way), 1e-20));
    let wo = receiver.local_from_world * (way * inverse);
    var seen: PointsSeen;
    if dot(receiver.up, wo) > 0.0 {
        let solid_angle = point.w * abs(dot(emitters_polygon(polygon).normal, way)) * inverse * inverse * inverse;
        seen.sheen = solid_angle * prior_sheens_value(receiver.prior_sheen, wo);
        seen.diffuse = solid_angle * max(wo.z, 0.0);
    }
    seen.factor = vec3f(1.0);
    if VARIANT_PATTERNS {
        seen.factor = patterns_around(emitters_polygon(polygon).pattern, point.xyz, point.w);
    }
    return seen;
}

// One of the points, with a probability in proportion to its share of the form factor (Chao 1982).
fn points_picked(receiver: Receiver, polygon: u32, start: u32) -> PointsPick {
    var total = 0.0;
    var pick: PointsPick;
    let end = emitters_polygon(polygon).end_point;
    for (var index = emitters_polygon(polygon).first_point; index < end; index++) {
        let seen = points_seen(receiver, polygon, index);
        total += seen.sheen;
        if seen.sheen > 0.0 && randoms_one(randoms_of(start, index), receiver.sample) * total < seen.sheen {
            pick = PointsPick(points_on_polygons[index].xyz - receiver.p_world, seen.factor);
        }
    }
    return pick;
}

// The prior sheen's form factor of a polygon, over its albedo. Closer to the light than the points are to each other, the sum is too large or
// too small: it is limited to POINTS_MOST times what the diffuse lobe's exact form factor allows.
fn points_sheen(receiver: Receiver, polygon: u32, diffuse: f32) -> PointsSum {
    var sheen = 0.0;
    var textured = vec3f(0.0);
    var diffuse_of_points = 0.0;
    let end = select(0u, emitters_polygon(polygon).end_point, diffuse > 0.0);
    for (var index = emitters_polygon(polygon).first_point; index < end; index++) {
        let seen = points_seen(receiver, polygon, index);
        sheen += seen.sheen;
        textured += seen.sheen * seen.factor;
        diffuse_of_points += seen.diffuse;
    }
    let most = POINTS_MOST * LTC_PI * diffuse;
    let form_factor = sheen * most / max(diffuse_of_points, max(most, 1e-30)) / receiver.prior_sheen.albedo;
    var factor = vec3f(1.0);
    if VARIANT_PATTERNS && sheen > 0.0 {
        factor = textured / sheen;
    }
    return PointsSum(form_factor, factor);
}
