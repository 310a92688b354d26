// What all lights send into each lobe of a surface.

struct LightsPolygon {
    radiance: vec3f,
    two_sided: u32,
    normal: vec3f,
    first_vertex: u32,
    // A sphere around all vertices.
    center: vec3f,
    radius: f32,
    end_vertex: u32,
}

// Point, spot or directional: see scene::PunctualLight.
struct LightsPunctual {
    intensity: vec3f,
    // 1 / range^2
    inverse_range_squared: f32,
    position: vec3f,
    // 0: directional, the light comes from -direction whatever the position.
    has_place: f32,
    direction: vec3f,
    // The cone's falloff is (scale cosine + offset) clamped, squared.
    cone_scale: f32,
    cone_offset: f32,
}

struct LightsCounts {
    polygons: u32,
    punctual: u32,
}

@group(0) @binding(5) var<uniform> lights_counts: LightsCounts;
@group(0) @binding(6) var<storage, read> lights_polygons: array<LightsPolygon>;
// Outlines one after another; w = 1 marks the first vertex of each, which comes again at its end.
@group(0) @binding(7) var<storage, read> lights_vertices: array<vec4f>;
@group(0) @binding(8) var<storage, read> lights_punctual: array<LightsPunctual>;

// A point to be lit.
struct LightsReceiver {
    p_world: vec3f,
    normal: vec3f,
    // Without the normal map.
    n_surface: vec3f,
    local_from_world: mat3x3f,
    sheen: mat3x3f,
    ggx: mat3x3f,
    sheen_color: vec3f,
    sheen_alpha: f32,
    layering: u32,
}

// Sums of radiance x form factor; those of the base weighted by what the sheen leaves of it.
struct LightsIncident {
    diffuse: vec3f,
    specular: vec3f,
    sheen: vec3f,
}

// The error of interpolated positions, as a share of the largest coordinate: a few roundings of f32. Points no further
// from a light's plane are in it, so that a light does not shine on itself.
const LIGHTS_POSITION_ERROR = 1e-6;
const LIGHTS_IDENTITY = mat3x3f(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);

fn lights_incident(receiver: LightsReceiver, base_weight: f32) -> LightsIncident {
    var incident = LightsIncident(vec3f(0.0), vec3f(0.0), vec3f(0.0));
    var index = lights_next(receiver, 0u);
    while index < lights_counts.polygons {
        let form_factors = lights_form_factors(receiver, lights_polygons[index]);
        let radiance = lights_polygons[index].radiance;
        incident = lights_add(receiver, incident, radiance, form_factors, base_weight);
        index = lights_next(receiver, index + 1u);
    }
    for (index = 0u; index < lights_counts.punctual; index++) {
        incident = lights_add_punctual(receiver, incident, lights_punctual[index], base_weight);
    }
    return incident;
}

// The first polygon from index on that may light the point: not wholly below its horizon, nor turned away from it. Points side by
// side skip dark lights each on their own, and walk round lit ones together.
fn lights_next(receiver: LightsReceiver, first: u32) -> u32 {
    var index = first;
    while index < lights_counts.polygons {
        let to_center = lights_polygons[index].center - receiver.p_world;
        let is_above = dot(receiver.normal, to_center) > -lights_polygons[index].radius;
        let is_facing = dot(lights_polygons[index].normal, to_center) < 0.0 || lights_polygons[index].two_sided != 0u;
        if is_above && is_facing {
            break;
        }
        index++;
    }
    return index;
}

// Form factors of one light: diffuse, specular, sheen; w is the mean cosine of its directions.
fn lights_form_factors(receiver: LightsReceiver, polygon: LightsPolygon) -> vec4f {
    let to_vertex = lights_vertices[polygon.first_vertex].xyz - receiver.p_world;
    let side = ltc_side(polygon.normal, to_vertex, polygon.two_sided != 0u);
    let size = abs(receiver.p_world) + abs(to_vertex);
    let error = LIGHTS_POSITION_ERROR * max(size.x, max(size.y, size.z));
    if side == 0.0 || abs(dot(polygon.normal, to_vertex)) <= error {
        return vec4f(0.0);
    }
    var sums = vec3f(0.0);
    var across = vec2f(0.0);
    var outline = ltc_begin(receiver.local_from_world * to_vertex);
    for (var index = polygon.first_vertex + 1u; index < polygon.end_vertex; index++) {
        let vertex = lights_vertices[index];
        let p_local = receiver.local_from_world * (vertex.xyz - receiver.p_world);
        if vertex.w != 0.0 {
            outline = ltc_begin(p_local);
        } else {
            outline = ltc_next(outline, p_local);
            sums.x += ltc_edge(outline, LIGHTS_IDENTITY);
            if SURFACES_SPECULAR {
                sums.y += ltc_edge(outline, receiver.ggx);
            }
            if SURFACES_SHEEN {
                sums.z += ltc_edge(outline, receiver.sheen);
            }
            if SURFACES_RECIPROCAL {
                let size = max(length(outline.normal), 1e-30);
                across += ltc_angle(size * outline.sine, dot(outline.p, outline.q)) / size * outline.normal.xy;
            }
        }
    }
    let diffuse = ltc_form_factor(sums.x, side);
    let cosine = lights_mean_cosine(vec3f(side / (2.0 * LTC_PI) * across, diffuse));
    return vec4f(diffuse, ltc_form_factor(sums.y, side), ltc_form_factor(sums.z, side), cosine);
}

// What the sheen leaves of light from around this cosine; by the reciprocal rule the lesser of both sides' shares.
fn lights_base_weight(receiver: LightsReceiver, base_weight: f32, cosine: f32) -> f32 {
    if !SURFACES_RECIPROCAL || receiver.layering != MATERIAL_LAYERING_RECIPROCAL {
        return base_weight;
    }
    let albedo = sheen_lobe(surfaces_sheen_table, receiver.sheen_alpha, cosine).albedo;
    return min(base_weight, sheen_base_weight(receiver.sheen_color, albedo));
}

fn lights_add(
    receiver: LightsReceiver, incident: LightsIncident, radiance: vec3f, form_factors: vec4f, base_weight: f32,
) -> LightsIncident {
    let base = radiance * lights_base_weight(receiver, base_weight, form_factors.w);
    return LightsIncident(
        incident.diffuse + base * form_factors.x,
        incident.specular + base * form_factors.y,
        incident.sheen + radiance * form_factors.z,
    );
}

fn lights_add_punctual(
    receiver: LightsReceiver, incident: LightsIncident, light: LightsPunctual, base_weight: f32,
) -> LightsIncident {
    let way = light.has_place * (light.position - receiver.p_world) - (1.0 - light.has_place) * light.direction;
    let square = max(dot(way, way), 1e-20);
    let wo = way * inverseSqrt(square);
    let local = receiver.local_from_world * wo;
    // Falls off to nothing at the range as KHR_lights_punctual recommends.
    let reach = square * light.inverse_range_squared;
    let cone = saturate(light.cone_scale * dot(light.direction, -wo) + light.cone_offset);
    let falloff = saturate(1.0 - reach * reach) * cone * cone * mix(1.0, 1.0 / square, light.has_place);
    let is_above = f32(dot(receiver.n_surface, wo) > 0.0);
    let densities = vec4f(
        ltc_density(LIGHTS_IDENTITY, local), ltc_density(receiver.ggx, local), ltc_density(receiver.sheen, local), 0.0,
    );
    let form_factors = is_above * densities + vec4f(vec3f(0.0), max(local.z, 0.0));
    return lights_add(receiver, incident, falloff * light.intensity, form_factors, base_weight);
}

// The share of a uniform environment that reaches the base.
fn lights_ambient(receiver: LightsReceiver, base_weight: f32) -> f32 {
    return lights_base_weight(receiver, base_weight, lights_mean_cosine(vec3f(0.0, 0.0, 1.0)));
}

// The mean cosine of a light's directions, weighted by the cosine, from its vector irradiance under unit radiance over pi (whose z is
// the form factor): that of a round light straight above of the same size, 2/3 for the whole hemisphere, times the vector's.
fn lights_mean_cosine(vector: vec3f) -> f32 {
    let size = min(length(vector), 1.0);
    let rest = sqrt(1.0 - size);
    // (2/3) (1 - rest^3) / (1 - rest^2), without its 0/0.
    let shrink = 2.0 / 3.0 * (1.0 + rest + rest * rest) / (1.0 + rest);
    return saturate(vector.z / max(size, 1e-20)) * shrink;
}
