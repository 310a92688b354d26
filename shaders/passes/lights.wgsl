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
    // Of an angle to the direction the falloff is scale (1 - cos outer - (1 - cos angle)), clamped and squared.
    cone_scale: f32,
    cone_versine: f32,
}

// Light from one direction.
struct LightsArriving {
    // Across the direction.
    irradiance: vec3f,
    // Unit, in the local frame.
    wo: vec3f,
    distance: f32,
}

// The distance of directional lights: beyond everything.
const LIGHTS_FAR = 1e15;

struct LightsCounts {
    // Polygons of one outline of four vertices come first.
    quads: u32,
    polygons: u32,
    punctual: u32,
}

@group(0) @binding(5) var<uniform> lights_counts: LightsCounts;
@group(0) @binding(6) var<storage, read> lights_punctual: array<LightsPunctual>;

// Sums of radiance x form factor; those of the base weighted by what the sheen leaves of it.
fn lights_incident(receiver: Receiver) -> LobesColors {
    var incident = LobesColors();
    if VARIANT_QUADS {
        incident = lights_add_polygons(receiver, incident, true);
    }
    if VARIANT_POLYGONS {
        incident = lights_add_polygons(receiver, incident, false);
    }
    if VARIANT_PUNCTUAL {
        for (var index = 0u; index < lights_counts.punctual; index++) {
            incident = lights_add_punctual(receiver, incident, index);
        }
    }
    return incident;
}

fn lights_add_polygons(receiver: Receiver, before: LobesColors, quads: bool) -> LobesColors {
    var incident = before;
    let first = select(lights_counts.quads, 0u, quads);
    let end = select(lights_counts.polygons, lights_counts.quads, quads);
    var index = lights_next(receiver, first, end);
    while index < end {
        let polygon = emitters_polygon(index);
        let integrals = polygons_integrals(receiver, polygon, quads);
        var form_factors = integrals.form_factors;
        var factors = patterns_seen(receiver, index, integrals.directions);
        if VARIANT_PRIOR_SHEEN {
            let sum = points_sheen(receiver, index, form_factors.diffuse);
            form_factors.sheen = sum.form_factor;
            factors.sheen = sum.factor;
        }
        incident = lights_add(receiver, incident, index, polygon.radiance, form_factors, factors, integrals.mean_cosine);
        index = lights_next(receiver, index + 1u, end);
    }
    return incident;
}

// The first polygon from one on, before the end, that may light the point: not wholly below its horizon, nor turned away from it. Neighbouring
// pixels each skip the lights that cannot reach them, and then integrate the lit ones in step.
fn lights_next(receiver: Receiver, first: u32, end: u32) -> u32 {
    var index = first;
    while index < end {
        let polygon = emitters_polygon(index);
        let to_center = polygon.center - receiver.p_world;
        let is_above = dot(receiver.normal, to_center) > -polygon.radius;
        let is_facing = dot(polygon.normal, to_center) < 0.0 || polygon.two_sided != 0u;
        if is_above && is_facing {
            break;
        }
        index++;
    }
    return index;
}

// `light` counts polygons first and then lights without extent; `factors` are those of its radiance.
fn lights_add(
    receiver: Receiver, before: LobesColors, light: u32, radiance: vec3f, form_factors: LobesScalars, factors: LobesColors,
    mean_cosine: f32,
) -> LobesColors {
    let base_weight = receiver_base_weight(receiver, mean_cosine);
    if VARIANT_SHADOWED {
        picks_offer(receiver, light, radiance, base_weight, form_factors, factors);
    }
    let base = radiance * base_weight;
    var incident = before;
    incident.diffuse += factors.diffuse * base * form_factors.diffuse;
    incident.specular += factors.specular * base * form_factors.specular;
    incident.sheen += factors.sheen * radiance * form_factors.sheen;
    return incident;
}

fn lights_add_punctual(receiver: Receiver, incident: LobesColors, index: u32) -> LobesColors {
    let arriving = lights_arriving(receiver, lights_punctual[index]);
    var densities: LobesScalars;
    if dot(receiver.up, arriving.wo) > 0.0 {
        densities = lights_densities(receiver, arriving.wo);
    }
    let light = lights_counts.polygons + index;
    return lights_add(receiver, incident, light, arriving.irradiance, densities, PATTERNS_PLAIN, max(arriving.wo.z, 0.0));
}

// What a light without extent sends to a point.
fn lights_arriving(receiver: Receiver, light: LightsPunctual) -> LightsArriving {
    let way = light.has_place * (light.position - receiver.p_world) - (1.0 - light.has_place) * light.direction;
    // A light is never nearer than a micrometre: at the point itself it comes from nowhere.
    let square = max(dot(way, way), 1e-12);
    let wo = way * inverseSqrt(square);
    // Falls off to nothing at the range as KHR_lights_punctual recommends.
    let reach = square * light.inverse_range_squared;
    // 1 - cos, which for narrow cones is what is left of it in 32 bits.
    let off_axis = light.direction + wo;
    let cone = saturate(light.cone_scale * (light.cone_versine - 0.5 * dot(off_axis, off_axis)));
    let falloff = saturate(1.0 - reach * reach) * cone * cone * mix(1.0, 1.0 / square, light.has_place);
    let distance = select(LIGHTS_FAR, sqrt(square), light.has_place > 0.0);
    return LightsArriving(falloff * light.intensity, receiver.local_from_world * wo, distance);
}

// The lobes' densities in a unit direction of the local frame.
fn lights_densities(receiver: Receiver, local: vec3f) -> LobesScalars {
    var densities: LobesScalars;
    densities.diffuse = ltc_density(LOBES_DIFFUSE, local);
    densities.specular = ltc_density(receiver.lobes.specular.m_inv, local);
    densities.sheen = ltc_density(receiver.lobes.sheen.m_inv, local);
    if VARIANT_PRIOR_SHEEN {
        densities.sheen = prior_sheens_value(receiver.prior_sheen, local) / receiver.prior_sheen.albedo;
    }
    return densities;
}

// The share of a uniform environment that reaches the base.
fn lights_ambient(receiver: Receiver) -> f32 {
    return receiver_base_weight(receiver, polygons_mean_cosine(vec3f(0.0, 0.0, 1.0)));
}
