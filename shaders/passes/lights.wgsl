// What all lights send into each lobe of a surface.

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
    // Polygons of one outline of four vertices come first.
    quads: u32,
    polygons: u32,
    punctual: u32,
}

// Which kinds there are: a driver may run the body of a loop once that has nothing to do.
override LIGHTS_QUADS: bool = true;
override LIGHTS_POLYGONS: bool = true;
override LIGHTS_PUNCTUAL: bool = true;

@group(0) @binding(5) var<uniform> lights_counts: LightsCounts;
@group(0) @binding(8) var<storage, read> lights_punctual: array<LightsPunctual>;

// A point to be lit.
struct LightsReceiver {
    p_world: vec3f,
    normal: vec3f,
    local_from_world: mat3x3f,
    // The normal without the normal map, in the local frame.
    up: vec3f,
    sheen: mat3x3f,
    ggx: mat3x3f,
    sheen_color: vec3f,
    sheen_alpha: f32,
    layering: u32,
    // The sheen where it is no transformed cosine.
    sheens: PriorSheensView,
}

// Sums of radiance x form factor; those of the base weighted by what the sheen leaves of it.
struct LightsIncident {
    diffuse: vec3f,
    specular: vec3f,
    sheen: vec3f,
}

fn lights_incident(receiver: LightsReceiver, base_weight: f32) -> LightsIncident {
    var incident = LightsIncident(vec3f(0.0), vec3f(0.0), vec3f(0.0));
    if LIGHTS_QUADS {
        incident = lights_add_polygons(receiver, incident, base_weight, true);
    }
    if LIGHTS_POLYGONS {
        incident = lights_add_polygons(receiver, incident, base_weight, false);
    }
    if LIGHTS_PUNCTUAL {
        for (var index = 0u; index < lights_counts.punctual; index++) {
            incident = lights_add_punctual(receiver, incident, lights_punctual[index], base_weight);
        }
    }
    return incident;
}

fn lights_add_polygons(receiver: LightsReceiver, before: LightsIncident, base_weight: f32, quads: bool) -> LightsIncident {
    var incident = before;
    let first = select(lights_counts.quads, 0u, quads);
    let end = select(lights_counts.polygons, lights_counts.quads, quads);
    var index = lights_next(receiver, first, end);
    while index < end {
        var form_factors = polygons_form_factors(receiver, polygons_lights[index], quads);
        if PRIOR_SHEENS_MODEL != 0u {
            form_factors.z = prior_sheens_form_factor(receiver, index, form_factors.x);
        }
        let radiance = polygons_lights[index].radiance;
        incident = lights_add(receiver, incident, radiance, form_factors, base_weight);
        index = lights_next(receiver, index + 1u, end);
    }
    return incident;
}

// The first polygon from one on, before the end, that may light the point: not wholly below its horizon, nor turned away from it. Points side by
// side skip dark lights each on their own, and walk round lit ones together.
fn lights_next(receiver: LightsReceiver, first: u32, end: u32) -> u32 {
    var index = first;
    while index < end {
        let to_center = polygons_lights[index].center - receiver.p_world;
        let is_above = dot(receiver.normal, to_center) > -polygons_lights[index].radius;
        let is_facing = dot(polygons_lights[index].normal, to_center) < 0.0 || polygons_lights[index].two_sided != 0u;
        if is_above && is_facing {
            break;
        }
        index++;
    }
    return index;
}

// What the sheen leaves of light from around this cosine; by the reciprocal rule the lesser of both sides' shares.
fn lights_base_weight(receiver: LightsReceiver, base_weight: f32, cosine: f32) -> f32 {
    if !SURFACES_RECIPROCAL || receiver.layering != MATERIAL_LAYERING_RECIPROCAL {
        return base_weight;
    }
    let albedo = prior_sheens_lobe(receiver.sheen_alpha, cosine).albedo;
    return min(base_weight, max(sheen_base_weight(receiver.sheen_color, albedo), 0.0));
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
    // A light is never nearer than a micrometre: at the point itself it comes from nowhere.
    let square = max(dot(way, way), 1e-12);
    let wo = way * inverseSqrt(square);
    let local = receiver.local_from_world * wo;
    // Falls off to nothing at the range as KHR_lights_punctual recommends.
    let reach = square * light.inverse_range_squared;
    let cone = saturate(light.cone_scale * dot(light.direction, -wo) + light.cone_offset);
    let falloff = saturate(1.0 - reach * reach) * cone * cone * mix(1.0, 1.0 / square, light.has_place);
    let is_above = dot(receiver.up, local) > 0.0;
    var densities = vec4f(
        ltc_density(POLYGONS_IDENTITY, local), ltc_density(receiver.ggx, local), ltc_density(receiver.sheen, local), 0.0,
    );
    if PRIOR_SHEENS_MODEL != 0u {
        densities.z = prior_sheens_value(receiver.sheens, local) / receiver.sheens.albedo;
    }
    let form_factors = select(vec4f(0.0), densities, is_above) + vec4f(vec3f(0.0), max(local.z, 0.0));
    return lights_add(receiver, incident, falloff * light.intensity, form_factors, base_weight);
}

// The share of a uniform environment that reaches the base.
fn lights_ambient(receiver: LightsReceiver, base_weight: f32) -> f32 {
    return lights_base_weight(receiver, base_weight, polygons_mean_cosine(vec3f(0.0, 0.0, 1.0)));
}
