// Sheens of prior work, to compare with: f_r times the light's cosine, summed over points on the lights, and a table of their albedos.
// src/models/ has the sources and the same formulas in f64.

// 0: the transformed cosine of sheen.wgsl; otherwise one of the following.
override SHEENS_MODEL: u32 = 0;
const SHEENS_BURLEY = 1u;
const SHEENS_CONTY_KULLA = 2u;
const SHEENS_NEUBELT_PETTINEO = 3u;
const SHEENS_PATRY = 4u;
// Smaller alphas are taken for it.
const SHEENS_LEAST_ALPHA = 0.03;
// Most of a light that the points may see of it, over its exact form factor.
const SHEENS_MOST = 2.0;
const SHEENS_PI = 3.14159265358979;
// Logarithms of albedos. Node k of n sits at k/(n-1): alpha = least + (1 - least) x^2 along x; along y mu = (p (2 - p))^4 for each model in turn.
override SHEENS_NODES: u32 = 2;
// Steps of the cube root of the cosine of wo, and of half a turn, that albedos are summed over.
const SHEENS_ELEVATIONS = 48u;
const SHEENS_AZIMUTHS = 32u;
// Points on each polygon, w the areas that they stand for.
@group(0) @binding(9) var<storage, read> sheens_points: array<vec4f>;
@group(0) @binding(10) var sheens_log_albedos: texture_2d<f32>;

// A model as it is seen from one direction.
struct SheensView {
    model: u32,
    alpha: f32,
    // Towards the view, y = 0, not below the horizon.
    wi: vec3f,
    albedo: f32,
    // Of wi, for Conty-Kulla: Lambda times the cosine; for Patry: the extinction.
    of_wi: f32,
    fit: SheensFit,
}

// Of Conty Estevez and Kulla 2017: L(x) = a / (1 + b x^c) + d x + e.
struct SheensFit {
    abcd: vec4f,
    e: f32,
    // 2 L(0.5)
    twice_middle: f32,
    // Where Lambda times the cosine is largest, and that largest value, which it keeps below.
    turning_point: f32,
    limit: f32,
}

// The sheen's lobe, with the model's albedo: sums over points are divided by that, as the transformed cosine's density is.
fn sheens_lobe(alpha: f32, mu: f32) -> SheenLobe {
    var lobe = sheen_lobe(surfaces_sheen_table, alpha, mu);
    if SHEENS_MODEL != 0u { lobe.albedo = sheens_albedo(alpha, mu); }
    return lobe;
}

fn sheens_albedo(alpha: f32, mu: f32) -> f32 {
    let x = sqrt(saturate((alpha - SHEENS_LEAST_ALPHA) / (1.0 - SHEENS_LEAST_ALPHA)));
    let root = sqrt(sqrt(saturate(mu)));
    let at = vec2f(x, root / (1.0 + sqrt(1.0 - root))) * f32(SHEENS_NODES - 1u);
    let low = min(vec2<u32>(at), vec2(SHEENS_NODES - 1u));
    let high = min(low + 1u, vec2(SHEENS_NODES - 1u));
    let weight = at - vec2f(low);
    let first = vec2(0u, (SHEENS_MODEL - 1u) * SHEENS_NODES);
    let grazing = mix(sheens_node(first + low), sheens_node(first + vec2(high.x, low.y)), weight.x);
    let upright = mix(sheens_node(first + vec2(low.x, high.y)), sheens_node(first + high), weight.x);
    return exp(mix(grazing, upright, weight.y));
}

fn sheens_node(at: vec2<u32>) -> f32 {
    return textureLoad(sheens_log_albedos, at, 0).x;
}

// `local` is the direction to the view in the shading frame, of which mu takes the place of the cosine.
fn sheens_view(local: vec3f, mu: f32, alpha: f32, albedo: f32) -> SheensView {
    return sheens_view_of(SHEENS_MODEL, max(alpha, SHEENS_LEAST_ALPHA), vec3f(length(local.xy), 0.0, max(mu, 1e-10)), albedo);
}

fn sheens_view_of(model: u32, alpha: f32, towards: vec3f, albedo: f32) -> SheensView {
    var view: SheensView;
    view.model = model;
    view.alpha = alpha;
    view.wi = surfaces_normalize(towards);
    view.albedo = max(albedo, 1e-20);
    if model == SHEENS_CONTY_KULLA {
        view.fit = sheens_fit(alpha);
        let product = view.wi.z * sheens_lambda(view.fit, view.wi.z);
        view.of_wi = select(product, view.fit.limit, view.wi.z < view.fit.turning_point);
    }
    if model == SHEENS_PATRY {
        view.of_wi = length(view.wi * vec3f(1.0, 1.0, alpha * alpha));
    }
    return view;
}

fn sheens_fit(alpha: f32) -> SheensFit {
    let share = (1.0 - alpha) * (1.0 - alpha);
    let abcd = mix(vec4f(21.5473, 3.82987, 0.19823, -1.97760), vec4f(25.3245, 3.32435, 0.16801, -1.27393), share);
    var fit = SheensFit(abcd, mix(-4.32054, -4.85967, share), 0.0, 0.0, 0.0);
    fit.twice_middle = 2.0 * sheens_exponent(fit, 0.5);
    let middle = 0.5 * abcd.x * abcd.z - 1.0;
    fit.turning_point = pow((middle - sqrt(middle * middle - 1.0)) / abcd.y, 1.0 / abcd.z);
    fit.limit = fit.turning_point * exp(sheens_exponent(fit, fit.turning_point));
    return fit;
}

// L(x)
fn sheens_exponent(fit: SheensFit, x: f32) -> f32 {
    return fit.abcd.x / (1.0 + fit.abcd.y * pow(max(x, 1e-20), fit.abcd.z)) + fit.abcd.w * x + fit.e;
}

// Lambda of a cosine above 0.
fn sheens_lambda(fit: SheensFit, mu: f32) -> f32 {
    let is_low = mu < 0.5;
    let exponent = sheens_exponent(fit, select(1.0 - mu, mu, is_low));
    let fitted = exp(select(fit.twice_middle - exponent, exponent, is_low));
    return select(fitted, fit.limit / max(mu, 1e-20), mu < fit.turning_point);
}

// f_r times the cosine of wo, a unit direction: 0 below the horizon.
fn sheens_value(view: SheensView, wo: vec3f) -> f32 {
    if wo.z <= 0.0 {
        return 0.0;
    }
    let alpha = view.alpha;
    let sum = view.wi + wo;
    let across = dot(sum.xy, sum.xy);
    let up = sum.z * sum.z;
    // Of the sum's length, twice the cosine of the difference angle; and the half vector's sine. wo is above the horizon.
    let square = max(across + up, 1e-30);
    let sine_square = max(across / square, 1e-30);
    switch view.model {
        case SHEENS_BURLEY: {
            let rest = max(1.0 - 0.5 * sqrt(square), 0.0);
            return wo.z * rest * rest * rest * rest * rest;
        }
        case SHEENS_CONTY_KULLA: {
            let distribution = (2.0 + 1.0 / alpha) * pow(sine_square, 0.5 / alpha) / (2.0 * SHEENS_PI);
            return distribution / (4.0 * (view.of_wi + view.wi.z * (1.0 + sheens_lambda(view.fit, wo.z))));
        }
        case SHEENS_NEUBELT_PETTINEO: {
            // Past 80 nothing is left.
            let exponent = min(up / square / (sine_square * alpha * alpha), 80.0);
            let peak = select(0.0, exp(-exponent) / (sine_square * sine_square), exponent < 80.0);
            let distribution = (1.0 + 4.0 * peak) / (SHEENS_PI * (1.0 + 4.0 * alpha * alpha));
            return distribution * wo.z / (4.0 * (view.wi.z * (1.0 - wo.z) + wo.z));
        }
        default: {
            let sigma = alpha * alpha;
            let half_square = 0.5 * square;
            let ratio = half_square / (half_square + up * (1.0 - sigma * sigma) / (2.0 * sigma * sigma));
            let kernel = ratio * ratio / (4.0 * SHEENS_PI * sigma);
            let taken = 1.0 - exp(-sum.z / max(view.wi.z * wo.z, 1e-30));
            return kernel * taken * wo.z / (sum.z * view.of_wi);
        }
    }
}

// The model's form factor of a polygon over its albedo, summed over points. As near as points are to each other they say too much or too little:
// never more than SHEENS_MOST times as much of the light as is there, by the diffuse lobe's exact form factor.
fn sheens_form_factor(receiver: LightsReceiver, polygon: u32, diffuse: f32) -> f32 {
    var sums = vec2f(0.0);
    let end = select(0u, polygons_lights[polygon].end_point, diffuse > 0.0);
    for (var index = polygons_lights[polygon].first_point; index < end; index++) {
        let point = sheens_points[index];
        let way = point.xyz - receiver.p_world;
        let inverse = inverseSqrt(max(dot(way, way), 1e-20));
        let wo = receiver.local_from_world * (way * inverse);
        if dot(receiver.up, wo) > 0.0 {
            let solid_angle = point.w * abs(dot(polygons_lights[polygon].normal, way)) * inverse * inverse * inverse;
            sums += solid_angle * vec2f(sheens_value(receiver.sheens, wo), max(wo.z, 0.0));
        }
    }
    let most = SHEENS_MOST * SHEENS_PI * diffuse;
    return sums.x * most / max(sums.y, max(most, 1e-30)) / receiver.sheens.albedo;
}

// Over a target of the table's size.
@vertex
fn sheens_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(select(-1.0, 3.0, index == 1u), select(-1.0, 3.0, index == 2u), 0.0, 1.0);
}

@fragment
fn sheens_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let texel = vec2<u32>(position.xy);
    let place = vec2f(vec2(texel.x, texel.y % SHEENS_NODES)) / f32(SHEENS_NODES - 1u);
    let root = place.y * (2.0 - place.y);
    let mu = root * root * root * root;
    let alpha = mix(SHEENS_LEAST_ALPHA, 1.0, place.x * place.x);
    let view = sheens_view_of(texel.y / SHEENS_NODES + 1u, alpha, vec3f(sqrt((1.0 - mu) * (1.0 + mu)), 0.0, mu), 1.0);
    // Drivers' sines may err by 5e-4, which narrow lobes would notice: directions are unit all the same.
    var sum = 0.0;
    for (var k = 0u; k < SHEENS_ELEVATIONS * SHEENS_AZIMUTHS; k++) {
        let rise = (f32(k / SHEENS_AZIMUTHS) + 0.5) / f32(SHEENS_ELEVATIONS);
        let phi = (f32(k % SHEENS_AZIMUTHS) + 0.5) / f32(SHEENS_AZIMUTHS) * SHEENS_PI;
        let height = rise * rise * rise;
        let sine = sqrt((1.0 - height) * (1.0 + height));
        sum += 3.0 * rise * rise * sheens_value(view, vec3f(sine * normalize(vec2f(cos(phi), sin(phi))), height));
    }
    return vec4f(log(max(sum * 2.0 * SHEENS_PI / f32(SHEENS_ELEVATIONS * SHEENS_AZIMUTHS), 1e-20)), 0.0, 0.0, 1.0);
}
