// The shipped files on the same rectangle: one walk for all lobes.

struct Specular {
    m_inv: mat3x3<f32>,
    weights: vec2<f32>,
}

// With two filtered fetches, as the published form has them.
fn filtered_specular(at: Point) -> Specular {
    let size = vec2<f32>(textureDimensions(specular_matrices));
    let uv = (vec2(at.roughness, dot(at.normal, at.view)) * (size - 1.0) + 0.5) / size;
    let abc = textureSampleLevel(specular_matrices, filtering, uv, 0.0);
    let weights = textureSampleLevel(specular_weights, filtering, uv, 0.0);
    return Specular(mat3x3(abc.x, 0.0, 0.0, 0.0, abc.z, 0.0, abc.y, 0.0, 1.0), weights.xy);
}

// With four loads and its own weights, as in sheen.wgsl.
fn loaded_specular(at: Point) -> Specular {
    let last = textureDimensions(specular_matrices) - 1u;
    let node = clamp(vec2(at.roughness, dot(at.normal, at.view)), vec2(0.0), vec2(1.0)) * vec2<f32>(last);
    let low = min(vec2<u32>(node), last);
    let weight = node - vec2<f32>(low);
    let abc = between(specular_matrices, low, min(low + 1u, last), weight);
    let weights = between(specular_weights, low, min(low + 1u, last), weight);
    return Specular(mat3x3(abc.x, 0.0, 0.0, 0.0, abc.z, 0.0, abc.y, 0.0, 1.0), weights.xy);
}

fn between(table: texture_2d<f32>, low: vec2<u32>, high: vec2<u32>, weight: vec2<f32>) -> vec4<f32> {
    let first = mix(textureLoad(table, low, 0), textureLoad(table, vec2(high.x, low.y), 0), weight.x);
    let second = mix(textureLoad(table, vec2(low.x, high.y), 0), textureLoad(table, high, 0), weight.x);
    return mix(first, second, weight.y);
}

struct Sums {
    diffuse: f32,
    specular: f32,
    sheen: f32,
    level: vec2<f32>,  // shared by the diffuse lobe and the sheen
    turn: vec2<f32>,   // the specular one's
}

fn add(sums: Sums, outline: LtcOutline, specular: mat3x3<f32>, sheen: mat3x3<f32>, with_sheen: bool) -> Sums {
    var sum = sums;
    sum.diffuse += ltc_edge(outline, IDENTITY);
    sum.specular += ltc_edge(outline, specular);
    if with_sheen {
        sum.sheen += ltc_edge(outline, sheen);
    }
    sum.level = ltc_turn(sums.level, outline, IDENTITY);
    sum.turn = ltc_turn(sums.turn, outline, specular);
    return sum;
}

fn to_corner(at: Point, k: u32) -> vec3<f32> {
    return scene.corners[k].xyz - at.position;
}

fn shade(at: Point, specular: Specular, sheen: SheenLobe, with_sheen: bool, streamed: bool) -> vec4<f32> {
    let frame = ltc_frame(at.normal, at.view);
    let side = ltc_side(scene.light_normal.xyz, to_corner(at, 0u), false);
    var sums = Sums(0.0, 0.0, 0.0, LTC_LEVEL, LTC_LEVEL);
    var outline = ltc_begin(frame * to_corner(at, 3u));
    if streamed {
        for (var k = 0u; k < 4u; k++) {
            outline = ltc_next(outline, frame * to_corner(at, k));
            sums = add(sums, outline, specular.m_inv, sheen.m_inv, with_sheen);
        }
    } else {
        outline = ltc_next(outline, frame * to_corner(at, 0u));
        sums = add(sums, outline, specular.m_inv, sheen.m_inv, with_sheen);
        outline = ltc_next(outline, frame * to_corner(at, 1u));
        sums = add(sums, outline, specular.m_inv, sheen.m_inv, with_sheen);
        outline = ltc_next(outline, frame * to_corner(at, 2u));
        sums = add(sums, outline, specular.m_inv, sheen.m_inv, with_sheen);
        outline = ltc_next(outline, frame * to_corner(at, 3u));
        sums = add(sums, outline, specular.m_inv, sheen.m_inv, with_sheen);
    }
    let mirrored = ltc_form_factor(sums.specular, sums.turn, specular.m_inv, side);
    let diffuse = ltc_form_factor(sums.diffuse, sums.level, IDENTITY, side);
    let fuzz = sheen.albedo * ltc_form_factor(sums.sheen, sums.level, sheen.m_inv, side);
    return vec4(mirrored * (0.04 * specular.weights.x + specular.weights.y), diffuse, mirrored, select(1.0, fuzz, with_sheen));
}

const NO_SHEEN = SheenLobe(IDENTITY, 0.0);

@fragment
fn filtered(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let at = point(pixel.xy);
    return shade(at, filtered_specular(at), NO_SHEEN, false, false);
}

@fragment
fn shipped(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let at = point(pixel.xy);
    return shade(at, loaded_specular(at), NO_SHEEN, false, false);
}

@fragment
fn with_sheen(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let at = point(pixel.xy);
    let sheen = sheen_lobe(sheen_table, at.roughness, dot(at.normal, at.view));
    return shade(at, loaded_specular(at), sheen, true, false);
}

@fragment
fn streamed(@builtin(position) pixel: vec4<f32>) -> @location(0) vec4<f32> {
    let at = point(pixel.xy);
    return shade(at, loaded_specular(at), NO_SHEEN, false, true);
}
