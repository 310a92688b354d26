// What of the light that a point scatters is blocked: for each light that has been picked a ray to one point of it.
//
// Subtracted from the closed form, it leaves what is seen, unbiased: L = A - mean (1 - V) g / p, with V whether the ray gets through, g all that
// the lobes scatter of the light's radiance at the point, and p the density by which it was drawn. That is the mixture of the lobes' own
// densities over the polygon, each by the luminance that it brings, so that the luminance of g / p is the same at every point.
// Of a textured light, V carries the pattern at the point, and 1 becomes what the closed form has of it in each lobe.

// From where rays start.
struct ShadowsOrigin {
    p_world: vec3f,
    // Unit, of the flat triangle, on the side that is seen.
    normal: vec3f,
    // How far the point was moved off that.
    lift: f32,
    // How far rays start off it: more than what positions are rounded by.
    apart: f32,
}

// Rounding, as a share of what positions are computed from, and of half the scene's size: where a ray meets a triangle is known to a share of the triangle's.
const SHADOWS_ROUNDING = 4e-6;
const SHADOWS_ROUNDING_OF_SCENE = 2e-7;
// But no more of the latter than this share of the distance to the camera, which is about a pixel: where one thing is far larger than what is looked at,
// rays would start beyond that.
const SHADOWS_ROUNDING_MOST = 1e-3;

// Lights without extent have no emitter.
const SHADOWS_NO_EMITTER = 0xfffffffeu;

// Where rays from a point start. Where normals curve outwards, that is on the curved surface for which the flat triangle stands, so that facets do
// not shade each other in grazing light (Hanika 2021, "Hacking the shadow terminator"; here the corners' tangent planes are interpolated
// before the point's height below them is taken). `height` is interpolated of the corners' dot(normal, p_from_origin), `n_center` of their
// normals, `flat_normal` the triangle's, of any length and side.
fn shadows_origin(
    point: ShadingPoint, p_from_origin: vec3f, height: f32, n_center: vec3f, flat_normal: vec3f, side: f32,
) -> ShadowsOrigin {
    let unit = filters_normalize(flat_normal);
    let facing = select(-unit, unit, dot(unit, point.view) > 0.0);
    let normal = select(point.smooth_normal, facing, dot(unit, unit) > 0.0);
    let lift = max(side * (height - dot(n_center, p_from_origin)), 0.0);
    let size = max(abs(point.p_world), abs(p_from_origin));
    let of_scene = SHADOWS_ROUNDING_OF_SCENE * BLOCKERS_SPAN * blockers_all.unit;
    let most = SHADOWS_ROUNDING_MOST * length(p_from_origin);
    let apart = SHADOWS_ROUNDING * max(size.x, max(size.y, size.z)) + min(of_scene, most);
    return ShadowsOrigin(point.p_world + lift * point.smooth_normal, normal, lift, apart);
}

// A ray to a light.
struct ShadowsRay {
    // From a point, along a unit direction, so far.
    start: vec3f,
    distance: f32,
    direction: vec3f,
    // The light to whose emitter it goes.
    light: u32,
    // What is blocked where it is stopped.
    radiance: vec3f,
    // What is not where it gets through: of textured lights as much as is there, which may be more.
    arriving: vec3f,
}

// All rays are made before the first is followed: what they are made of need not be kept at hand meanwhile.
var<private> shadows_rays: array<ShadowsRay, PICKS_RAYS>;

// What of the radiance that the point scatters is blocked.
fn shadows_blocked(receiver: Receiver, origin: ShadowsOrigin) -> vec3f {
    let count = min(picks_offered, PICKS_RAYS);
    for (var index = 0u; index < count; index++) {
        let pick = picks_kept[index];
        if VARIANT_PUNCTUAL && pick.light >= lights_counts.polygons {
            shadows_rays[index] = shadows_to_punctual(receiver, origin, pick);
        } else {
            shadows_rays[index] = shadows_to_polygon(receiver, origin, pick);
        }
    }
    var blocked = vec3f(0.0);
    for (var index = 0u; index < count; index++) {
        let ray = shadows_rays[index];
        let passing = rays_passing(ray.start, ray.direction, ray.distance, ray.light);
        if VARIANT_PATTERNS {
            blocked += ray.radiance - passing * ray.arriving;
        } else {
            blocked += ray.radiance * (1.0 - passing);
        }
    }
    return blocked;
}

fn shadows_to_polygon(receiver: Receiver, origin: ShadowsOrigin, pick: PicksKept) -> ShadowsRay {
    let start = randoms_of(receiver.seed, pick.light);
    let numbers = randoms_three(start, receiver.sample);
    let polygon = emitters_polygon(pick.light);
    let radiance = polygon.radiance;
    let factors = picks_factors(pick);
    let whole = picks_per_form_factor(receiver, radiance, factors, pick.base_weight);
    // The lobe by what it brings.
    let at = numbers.x * picks_worth(pick.worths);
    let is_sheen = at >= pick.worths.diffuse + pick.worths.specular;
    if VARIANT_PRIOR_SHEEN && is_sheen {
        let point = points_picked(receiver, pick.light, start);
        let blocked = pick.total / whole.sheen * point.factor * radiance * receiver.colors.sheen;
        return shadows_ray(receiver, origin, filters_normalize(point.way), length(point.way), polygon.light, blocked, blocked);
    }
    var m_inv = LOBES_DIFFUSE;
    var form_factor = pick.worths.diffuse / whole.diffuse;
    if at >= pick.worths.diffuse {
        m_inv = receiver.lobes.specular.m_inv;
        form_factor = pick.worths.specular / whole.specular;
    }
    if is_sheen {
        m_inv = receiver.lobes.sheen.m_inv;
        form_factor = pick.worths.sheen / whole.sheen;
    }
    let wo = samples_direction(receiver, pick.light, m_inv, form_factor, numbers.yz);
    var densities = lights_densities(receiver, wo);
    if VARIANT_PRIOR_SHEEN {
        densities.sheen = 0.0;
    }
    let density = whole.diffuse * densities.diffuse + whole.specular * densities.specular + whole.sheen * densities.sheen;
    // Nothing where no point was found.
    let share = select(0.0, pick.total / density, density > 0.0);
    let blocked = share * shadows_scattered(receiver, densities, radiance, factors, pick.base_weight);
    var arriving = blocked;
    if VARIANT_PATTERNS && polygon.pattern != PATTERNS_NONE {
        let even = share * shadows_scattered(receiver, densities, radiance, PATTERNS_PLAIN, pick.base_weight);
        arriving = even * patterns_factor(receiver, polygon.pattern, wo);
    }
    let direction = wo * receiver.local_from_world;
    let to_vertex = emitters_vertex(polygon.first_vertex).xyz - receiver.p_world;
    return shadows_ray(receiver, origin, direction, dot(polygon.normal, to_vertex) / dot(polygon.normal, direction), polygon.light, blocked, arriving);
}

fn shadows_to_punctual(receiver: Receiver, origin: ShadowsOrigin, pick: PicksKept) -> ShadowsRay {
    let arriving = lights_arriving(receiver, lights_punctual[pick.light - lights_counts.polygons]);
    let densities = lights_densities(receiver, arriving.wo);
    let scattered = shadows_scattered(receiver, densities, arriving.irradiance, PATTERNS_PLAIN, pick.base_weight);
    let blocked = pick.total / picks_worth(pick.worths) * scattered;
    let direction = arriving.wo * receiver.local_from_world;
    return shadows_ray(receiver, origin, direction, arriving.distance, SHADOWS_NO_EMITTER, blocked, blocked);
}

// What the lobes scatter of light of this radiance, which has a factor in each.
fn shadows_scattered(
    receiver: Receiver, densities: LobesScalars, radiance: vec3f, factors: LobesColors, base_weight: f32,
) -> vec3f {
    let diffuse = factors.diffuse * receiver.colors.diffuse * densities.diffuse;
    let specular = factors.specular * receiver.colors.specular * densities.specular;
    return radiance * (base_weight * (diffuse + specular) + factors.sheen * receiver.colors.sheen * densities.sheen);
}

// From a point to a light at a distance. What comes from below the flat triangle is not stopped by that itself, unless the point was
// moved off it.
fn shadows_ray(
    receiver: Receiver, origin: ShadowsOrigin, direction: vec3f, distance: f32, light: u32, radiance: vec3f, arriving: vec3f,
) -> ShadowsRay {
    let is_below = dot(direction, origin.normal) < 0.0 && origin.lift <= origin.apart;
    let start = origin.p_world + select(origin.apart, -origin.apart, is_below) * origin.normal;
    let way = receiver.p_world + distance * direction - start;
    let far = length(way);
    return ShadowsRay(start, far, way / far, light, radiance, arriving);
}
