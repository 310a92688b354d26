// Form factors of lobes that have no closed form: sums over points on a polygon light.

// Points on each polygon, w the areas that they stand for.
@group(0) @binding(9) var<storage, read> points_on_polygons: array<vec4f>;

// Most of a light that the points may see of it, over its exact form factor.
const POINTS_MOST = 2.0;

// The prior sheen's form factor of a polygon, over its albedo. As near as points are to each other they say too much or too
// little: never more than POINTS_MOST times as much of the light as is there, by the diffuse lobe's exact form factor.
fn points_sheen(receiver: Receiver, polygon: u32, diffuse: f32) -> f32 {
    var sums = vec2f(0.0);
    let end = select(0u, polygons_lights[polygon].end_point, diffuse > 0.0);
    for (var index = polygons_lights[polygon].first_point; index < end; index++) {
        let point = points_on_polygons[index];
        let way = point.xyz - receiver.p_world;
        let inverse = inverseSqrt(max(dot(way, way), 1e-20));
        let wo = receiver.local_from_world * (way * inverse);
        if dot(receiver.up, wo) > 0.0 {
            let solid_angle = point.w * abs(dot(polygons_lights[polygon].normal, way)) * inverse * inverse * inverse;
            sums += solid_angle * vec2f(prior_sheens_value(receiver.prior_sheen, wo), max(wo.z, 0.0));
        }
    }
    let most = POINTS_MOST * LTC_PI * diffuse;
    return sums.x * most / max(sums.y, max(most, 1e-30)) / receiver.prior_sheen.albedo;
}
