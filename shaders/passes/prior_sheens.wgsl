// Sheens of prior work, to compare with: f_r times the light's cosine, and their albedos, of which there is a table.
// src/models/ has the sources and the same formulas in f64.

// What VARIANT_SHEEN_MODEL counts.
const PRIOR_SHEENS_BURLEY = 1u;
const PRIOR_SHEENS_CONTY_KULLA = 2u;
const PRIOR_SHEENS_NEUBELT_PETTINEO = 3u;
const PRIOR_SHEENS_PATRY = 4u;
// Smaller alphas are replaced by this one.
const PRIOR_SHEENS_LEAST_ALPHA = 0.03;
// Logarithms of albedos, as their bits: every adapter draws integers of 32 bits, but some draw no such floats.
// Node k of n sits at k/(n-1): alpha = least + (1 - least) x^2 along x; along y mu = (p (2 - p))^4 for each model in turn.
override PRIOR_SHEENS_NODES: u32 = 2;
@group(0) @binding(8) var prior_sheens_log_albedos: texture_2d<u32>;

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
    // The cosine at which Lambda times the cosine is largest, and that value, which it keeps below it.
    turning_point: f32,
    limit: f32,
}

fn prior_sheens_albedo(alpha: f32, mu: f32) -> f32 {
    let x = sqrt(saturate((alpha - PRIOR_SHEENS_LEAST_ALPHA) / (1.0 - PRIOR_SHEENS_LEAST_ALPHA)));
    let root = sqrt(sqrt(saturate(mu)));
    let at = vec2f(x, root / (1.0 + sqrt(1.0 - root))) * f32(PRIOR_SHEENS_NODES - 1u);
    let low = min(vec2<u32>(at), vec2(PRIOR_SHEENS_NODES - 1u));
    let high = min(low + 1u, vec2(PRIOR_SHEENS_NODES - 1u));
    let weight = at - vec2f(low);
    let first = vec2(0u, (VARIANT_SHEEN_MODEL - 1u) * PRIOR_SHEENS_NODES);
    let grazing = mix(prior_sheens_node(first + low), prior_sheens_node(first + vec2(high.x, low.y)), weight.x);
    let upright = mix(prior_sheens_node(first + vec2(low.x, high.y)), prior_sheens_node(first + high), weight.x);
    return exp(mix(grazing, upright, weight.y));
}

fn prior_sheens_node(at: vec2<u32>) -> f32 {
    return bitcast<f32>(textureLoad(prior_sheens_log_albedos, at, 0).x);
}

// The variant's model. `local` points to the view in the shading frame; mu replaces its cosine.
fn prior_sheens_view(local: vec3f, mu: f32, alpha: f32, albedo: f32) -> PriorSheensView {
    let towards = vec3f(length(local.xy), 0.0, max(mu, 1e-10));
    return prior_sheens_view_of(VARIANT_SHEEN_MODEL, max(alpha, PRIOR_SHEENS_LEAST_ALPHA), towards, albedo);
}

// What a node of the table of albedos stands for.
fn prior_sheens_view_of_node(node: vec2<u32>) -> PriorSheensView {
    let place = vec2f(vec2(node.x, node.y % PRIOR_SHEENS_NODES)) / f32(PRIOR_SHEENS_NODES - 1u);
    let root = place.y * (2.0 - place.y);
    let mu = root * root * root * root;
    let alpha = mix(PRIOR_SHEENS_LEAST_ALPHA, 1.0, place.x * place.x);
    let towards = vec3f(sqrt((1.0 - mu) * (1.0 + mu)), 0.0, mu);
    return prior_sheens_view_of(node.y / PRIOR_SHEENS_NODES + 1u, alpha, towards, 1.0);
}

// `towards` is never zero.
fn prior_sheens_view_of(model: u32, alpha: f32, towards: vec3f, albedo: f32) -> PriorSheensView {
    var view: PriorSheensView;
    view.model = model;
    view.alpha = alpha;
    view.wi = towards * inverseSqrt(dot(towards, towards));
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
            let distribution = (2.0 + 1.0 / alpha) * pow(sine_square, 0.5 / alpha) / (2.0 * LTC_PI);
            return distribution / (4.0 * (view.of_wi + view.wi.z * (1.0 + prior_sheens_lambda(view.fit, wo.z))));
        }
        case PRIOR_SHEENS_NEUBELT_PETTINEO: {
            // Past 80 nothing is left.
            let exponent = min(up / square / (sine_square * alpha * alpha), 80.0);
            let peak = select(0.0, exp(-exponent) / (sine_square * sine_square), exponent < 80.0);
            let distribution = (1.0 + 4.0 * peak) / (LTC_PI * (1.0 + 4.0 * alpha * alpha));
            return distribution * wo.z / (4.0 * (view.wi.z * (1.0 - wo.z) + wo.z));
        }
        default: {
            let sigma = alpha * alpha;
            let half_square = 0.5 * square;
            let ratio = half_square / (half_square + up * (1.0 - sigma * sigma) / (2.0 * sigma * sigma));
            let kernel = ratio * ratio / (4.0 * LTC_PI * sigma);
            let taken = 1.0 - exp(-sum.z / max(view.wi.z * wo.z, 1e-30));
            return kernel * taken * wo.z / (sum.z * view.of_wi);
        }
    }
}
