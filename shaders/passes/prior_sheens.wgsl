// Sheens of prior work, to compare with: f_r times the light's cosine, summed over points on the lights, and a table of their albedos.
// src/models/ has the sources and the same formulas in f64.

// 0: the transformed cosine of sheen.wgsl; otherwise one of the following.
override PRIOR_SHEENS_MODEL: u32 = 0;
const PRIOR_SHEENS_BURLEY = 1u;
const PRIOR_SHEENS_CONTY_KULLA = 2u;
const PRIOR_SHEENS_NEUBELT_PETTINEO = 3u;
const PRIOR_SHEENS_PATRY = 4u;
// Smaller alphas are taken for it.
const PRIOR_SHEENS_LEAST_ALPHA = 0.03;
// Most of a light that the points may see of it, over its exact form factor.
const PRIOR_SHEENS_MOST = 2.0;
const PRIOR_SHEENS_PI = 3.14159265358979;
// Logarithms of albedos. Node k of n sits at k/(n-1): alpha = least + (1 - least) x^2 along x; along y mu = (p (2 - p))^4 for each model in turn.
override PRIOR_SHEENS_NODES: u32 = 2;
// Steps of the cube root of the cosine of wo, and of half a turn, that albedos are summed over.
const PRIOR_SHEENS_ELEVATIONS = 48u;
const PRIOR_SHEENS_AZIMUTHS = 32u;
// Points on each polygon, w the areas that they stand for.
@group(0) @binding(9) var<storage, read> prior_sheens_points: array<vec4f>;
@group(0) @binding(10) var prior_sheens_log_albedos: texture_2d<f32>;

// A model as it is seen from one direction.
struct PriorSheensView {
    model: u32,
    alpha: f32,
    // Towards the view, y = 0, not below the horizon.
    wi: vec3f,
    albedo: f32,
    // Of wi, for Conty-Kulla: Lambda times the cosine; for Patry: the extinction.
    of_wi: f32,
    fit: PriorSheensFit,
}

// Of Conty Estevez and Kulla 2017: L(x) = a / (1 + b x^c) + d x + e.
struct PriorSheensFit {
    abcd: vec4f,
    e: f32,
    // 2 L(0.5)
    twice_middle: f32,
    // Where Lambda times the cosine is largest, and that largest value, which it keeps below.
    turning_point: f32,
    limit: f32,
}

// The sheen's lobe, with the model's albedo: sums over points are divided by that, as the transformed cosine's density is.
fn prior_sheens_lobe(alpha: f32, mu: f32) -> SheenLobe {
    var lobe = sheen_lobe(surfaces_sheen_table, alpha, mu);
    if PRIOR_SHEENS_MODEL != 0u { lobe.albedo = prior_sheens_albedo(alpha, mu); }
    return lobe;
}

fn prior_sheens_albedo(alpha: f32, mu: f32) -> f32 {
    let x = sqrt(saturate((alpha - PRIOR_SHEENS_LEAST_ALPHA) / (1.0 - PRIOR_SHEENS_LEAST_ALPHA)));
    let root = sqrt(sqrt(saturate(mu)));
    let at = vec2f(x, root / (1.0 + sqrt(1.0 - root))) * f32(PRIOR_SHEENS_NODES - 1u);
    let low = min(vec2<u32>(at), vec2(PRIOR_SHEENS_NODES - 1u));
    let high = min(low + 1u, vec2(PRIOR_SHEENS_NODES - 1u));
    let weight = at - vec2f(low);
    let first = vec2(0u, (PRIOR_SHEENS_MODEL - 1u) * PRIOR_SHEENS_NODES);
    let grazing = mix(prior_sheens_node(first + low), prior_sheens_node(first + vec2(high.x, low.y)), weight.x);
    let upright = mix(prior_sheens_node(first + vec2(low.x, high.y)), prior_sheens_node(first + high), weight.x);
    return exp(mix(grazing, upright, weight.y));
}

fn prior_sheens_node(at: vec2<u32>) -> f32 {
    return textureLoad(prior_sheens_log_albedos, at, 0).x;
}

// `local` is the direction to the view in the shading frame, of which mu takes the place of the cosine.
fn prior_sheens_view(local: vec3f, mu: f32, alpha: f32, albedo: f32) -> PriorSheensView {
    return prior_sheens_view_of(PRIOR_SHEENS_MODEL, max(alpha, PRIOR_SHEENS_LEAST_ALPHA), vec3f(length(local.xy), 0.0, max(mu, 1e-10)), albedo);
}

fn prior_sheens_view_of(model: u32, alpha: f32, towards: vec3f, albedo: f32) -> PriorSheensView {
    var view: PriorSheensView;
    view.model = model;
    view.alpha = alpha;
    view.wi = surfaces_normalize(towards);
    view.albedo = max(albedo, 1e-20);
    if model == PRIOR_SHEENS_CONTY_KULLA {
        view.fit = prior_sheens_fit(alpha);
        let product = view.wi.z * prior_sheens_lambda(view.fit, view.wi.z);
        view.of_wi = select(product, view.fit.limit, view.wi.z < view.fit.turning_point);
    }
    if model == PRIOR_SHEENS_PATRY {
        view.of_wi = length(view.wi * vec3f(1.0, 1.0, alpha * alpha));
    }
    return view;
}

fn prior_sheens_fit(alpha: f32) -> PriorSheensFit {
    let share = (1.0 - alpha) * (1.0 - alpha);
    let abcd = mix(vec4f(21.5473, 3.82987, 0.19823, -1.97760), vec4f(25.3245, 3.32435, 0.16801, -1.27393), share);
    var fit = PriorSheensFit(abcd, mix(-4.32054, -4.85967, share), 0.0, 0.0, 0.0);
    fit.twice_middle = 2.0 * prior_sheens_exponent(fit, 0.5);
    let middle = 0.5 * abcd.x * abcd.z - 1.0;
    fit.turning_point = pow((middle - sqrt(middle * middle - 1.0)) / abcd.y, 1.0 / abcd.z);
    fit.limit = fit.turning_point * exp(prior_sheens_exponent(fit, fit.turning_point));
    return fit;
}

// L(x)
fn prior_sheens_exponent(fit: PriorSheensFit, x: f32) -> f32 {
    return fit.abcd.x / (1.0 + fit.abcd.y * pow(max(x, 1e-20), fit.abcd.z)) + fit.abcd.w * x + fit.e;
}

// Lambda of a cosine above 0.
fn prior_sheens_lambda(fit: PriorSheensFit, mu: f32) -> f32 {
    let is_low = mu < 0.5;
    let exponent = prior_sheens_exponent(fit, select(1.0 - mu, mu, is_low));
    let fitted = exp(select(fit.twice_middle - exponent, exponent, is_low));
    return select(fitted, fit.limit / max(mu, 1e-20), mu < fit.turning_point);
}

// f_r times the cosine of wo, a unit direction: 0 below the horizon.
fn prior_sheens_value(view: PriorSheensView, wo: vec3f) -> f32 {
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
        case PRIOR_SHEENS_BURLEY: {
            let rest = max(1.0 - 0.5 * sqrt(square), 0.0);
            return wo.z * rest * rest * rest * rest * rest;
        }
        case PRIOR_SHEENS_CONTY_KULLA: {
            let distribution = (2.0 + 1.0 / alpha) * pow(sine_square, 0.5 / alpha) / (2.0 * PRIOR_SHEENS_PI);
            return distribution / (4.0 * (view.of_wi + view.wi.z * (1.0 + prior_sheens_lambda(view.fit, wo.z))));
        }
        case PRIOR_SHEENS_NEUBELT_PETTINEO: {
            // Past 80 nothing is left.
            let exponent = min(up / square / (sine_square * alpha * alpha), 80.0);
            let peak = select(0.0, exp(-exponent) / (sine_square * sine_square), exponent < 80.0);
            let distribution = (1.0 + 4.0 * peak) / (PRIOR_SHEENS_PI * (1.0 + 4.0 * alpha * alpha));
            return distribution * wo.z / (4.0 * (view.wi.z * (1.0 - wo.z) + wo.z));
        }
        default: {
            let sigma = alpha * alpha;
            let half_square = 0.5 * square;
            let ratio = half_square / (half_square + up * (1.0 - sigma * sigma) / (2.0 * sigma * sigma));
            let kernel = ratio * ratio / (4.0 * PRIOR_SHEENS_PI * sigma);
            let taken = 1.0 - exp(-sum.z / max(view.wi.z * wo.z, 1e-30));
            return kernel * taken * wo.z / (sum.z * view.of_wi);
        }
    }
}

// The model's form factor of a polygon over its albedo, summed over points. As near as points are to each other they say too much or too little:
// never more than PRIOR_SHEENS_MOST times as much of the light as is there, by the diffuse lobe's exact form factor.
fn prior_sheens_form_factor(receiver: LightsReceiver, polygon: u32, diffuse: f32) -> f32 {
    var sums = vec2f(0.0);
    let end = select(0u, polygons_lights[polygon].end_point, diffuse > 0.0);
    for (var index = polygons_lights[polygon].first_point; index < end; index++) {
        let point = prior_sheens_points[index];
        let way = point.xyz - receiver.p_world;
        let inverse = inverseSqrt(max(dot(way, way), 1e-20));
        let wo = receiver.local_from_world * (way * inverse);
        if dot(receiver.up, wo) > 0.0 {
            let solid_angle = point.w * abs(dot(polygons_lights[polygon].normal, way)) * inverse * inverse * inverse;
            sums += solid_angle * vec2f(prior_sheens_value(receiver.sheens, wo), max(wo.z, 0.0));
        }
    }
    let most = PRIOR_SHEENS_MOST * PRIOR_SHEENS_PI * diffuse;
    return sums.x * most / max(sums.y, max(most, 1e-30)) / receiver.sheens.albedo;
}

// Over a target of the table's size.
@vertex
fn prior_sheens_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(select(-1.0, 3.0, index == 1u), select(-1.0, 3.0, index == 2u), 0.0, 1.0);
}

@fragment
fn prior_sheens_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let texel = vec2<u32>(position.xy);
    let place = vec2f(vec2(texel.x, texel.y % PRIOR_SHEENS_NODES)) / f32(PRIOR_SHEENS_NODES - 1u);
    let root = place.y * (2.0 - place.y);
    let mu = root * root * root * root;
    let alpha = mix(PRIOR_SHEENS_LEAST_ALPHA, 1.0, place.x * place.x);
    let view = prior_sheens_view_of(texel.y / PRIOR_SHEENS_NODES + 1u, alpha, vec3f(sqrt((1.0 - mu) * (1.0 + mu)), 0.0, mu), 1.0);
    // Drivers' sines may err by 5e-4, which narrow lobes would notice: directions are unit all the same.
    var sum = 0.0;
    for (var k = 0u; k < PRIOR_SHEENS_ELEVATIONS * PRIOR_SHEENS_AZIMUTHS; k++) {
        let rise = (f32(k / PRIOR_SHEENS_AZIMUTHS) + 0.5) / f32(PRIOR_SHEENS_ELEVATIONS);
        let phi = (f32(k % PRIOR_SHEENS_AZIMUTHS) + 0.5) / f32(PRIOR_SHEENS_AZIMUTHS) * PRIOR_SHEENS_PI;
        let height = rise * rise * rise;
        let sine = sqrt((1.0 - height) * (1.0 + height));
        sum += 3.0 * rise * rise * prior_sheens_value(view, vec3f(sine * normalize(vec2f(cos(phi), sin(phi))), height));
    }
    return vec4f(log(max(sum * 2.0 * PRIOR_SHEENS_PI / f32(PRIOR_SHEENS_ELEVATIONS * PRIOR_SHEENS_AZIMUTHS), 1e-20)), 0.0, 0.0, 1.0);
}
