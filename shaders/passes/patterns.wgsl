// Patterns of textured lights: images by which their radiance varies, and what the lobes see of them.
//
// In a lobe's space, where it is a cosine, the light's mean direction meets its plane at the point at which the lobe looks; there the image is
// looked up, filtered over what a cosine sees of a plane from as far away (after Heitz et al. 2016, section 5). That is exact where the
// image is even, as it is in most of the pieces into which lights are cut (src/renderer/pieces.rs); rays to points of the light make up for the rest.

// An image on a polygon: scene::Pattern.
struct PatternsSheet {
    // Its first corner, in the world.
    origin: vec3f,
    // Of its finest level in patterns_texels; the others follow, each half as wide and high, rounded up, to a single texel.
    first_texel: u32,
    // From there to the ends of its first row and of its first column.
    row: vec3f,
    columns: u32,
    column: vec3f,
    rows: u32,
}

// A place on an image, in texels of its finest level, and how many of them are seen there.
struct PatternsPlace {
    at: vec2f,
    texels: f32,
}

const PATTERNS_NONE = 0xffffffffu;
// What lobes see of lights without a pattern.
const PATTERNS_PLAIN = LobesColors(vec3f(1.0), vec3f(1.0), vec3f(1.0));
// The area of a plane that faces it in which a cosine lobe sees half of what it does, over the square of its distance.
const PATTERNS_SEEN = LTC_PI;

@group(0) @binding(9) var<storage, read> patterns_sheets: array<PatternsSheet>;
// Three numbers a texel.
@group(0) @binding(10) var<storage, read> patterns_texels: array<f32>;

// The factors of a polygon's radiance in each lobe.
fn patterns_seen(receiver: Receiver, polygon: u32, directions: LobesVectors) -> LobesColors {
    var seen = PATTERNS_PLAIN;
    if VARIANT_PATTERNS && emitters_polygon(polygon).pattern != PATTERNS_NONE {
        let sheet = patterns_sheets[emitters_polygon(polygon).pattern];
        // Lobe by lobe, in a loop: drivers take their time over code that stands there several times, also where it is then left out.
        var m_inv = LOBES_DIFFUSE;
        var direction = directions.diffuse;
        for (var lobe = 0u; lobe < 3u; lobe++) {
            var place = patterns_place(receiver, sheet, m_inv, direction);
            place.texels = min(place.texels, emitters_polygon(polygon).pattern_texels);
            let factor = patterns_filtered(sheet, place);
            switch lobe {
                case 0u: {
                    seen.diffuse = factor;
                    m_inv = receiver.lobes.specular.m_inv;
                    direction = directions.specular;
                }
                case 1u: {
                    seen.specular = factor;
                    m_inv = receiver.lobes.sheen.m_inv;
                    direction = directions.sheen;
                }
                default: {
                    seen.sheen = factor;
                }
            }
        }
    }
    return seen;
}

// The factor of a light's radiance where a direction of the local frame meets it; there is a pattern.
fn patterns_factor(receiver: Receiver, pattern: u32, wo: vec3f) -> vec3f {
    let sheet = patterns_sheets[pattern];
    let size = vec2u(sheet.columns, sheet.rows);
    let cell = min(vec2u(max(patterns_place(receiver, sheet, LOBES_DIFFUSE, wo).at, vec2f(0.0))), size - 1u);
    return patterns_texel(sheet.first_texel + cell.y * size.x + cell.x);
}

// The mean factor around a point of the world over an area.
fn patterns_around(pattern: u32, p_world: vec3f, area: f32) -> vec3f {
    if pattern == PATTERNS_NONE {
        return vec3f(1.0);
    }
    let sheet = patterns_sheets[pattern];
    return patterns_filtered(sheet, patterns_place_of(sheet, p_world - sheet.origin, sheet.row, sheet.column, area));
}

// Where a direction of a lobe's space meets a sheet.
fn patterns_place(receiver: Receiver, sheet: PatternsSheet, m_inv: mat3x3f, direction: vec3f) -> PatternsPlace {
    let lobe_from_world = m_inv * receiver.local_from_world;
    let origin = lobe_from_world * (sheet.origin - receiver.p_world);
    let row = lobe_from_world * sheet.row;
    let column = lobe_from_world * sheet.column;
    let normal = cross(row, column);
    let slope = dot(normal, direction);
    // Where they hardly meet it is far off, but not so far that it is infinite.
    let way = clamp(select(0.0, dot(normal, origin) / slope, slope != 0.0) * direction, vec3f(-1e9), vec3f(1e9));
    return patterns_place_of(sheet, way - origin, row, column, PATTERNS_SEEN * dot(way, way));
}

// Of what lies at the end of an arm from the sheet's origin, in the space in which these are its sides.
fn patterns_place_of(sheet: PatternsSheet, arm: vec3f, row: vec3f, column: vec3f, area: f32) -> PatternsPlace {
    let normal = cross(row, column);
    let square = max(dot(normal, normal), 1e-37);
    let shares = vec2f(dot(arm, cross(column, normal) / square), dot(arm, cross(normal, row) / square));
    let size = vec2f(f32(sheet.columns), f32(sheet.rows));
    return PatternsPlace(clamp(shares, vec2f(-1.0), vec2f(2.0)) * size, area * size.x * size.y * inverseSqrt(square));
}

// The mean of the image over as much of it as is seen.
fn patterns_filtered(sheet: PatternsSheet, place: PatternsPlace) -> vec3f {
    let longer = max(sheet.columns, sheet.rows);
    let last = select(0u, firstLeadingBit(longer - 1u) + 1u, longer > 1u);
    let level = clamp(0.5 * log2(max(place.texels, 1.0)), 0.0, f32(last));
    let finer = u32(level);
    let coarser = min(finer + 1u, last);
    return mix(patterns_level(sheet, place.at, finer), patterns_level(sheet, place.at, coarser), level - f32(finer));
}

// Between the texels of a level.
fn patterns_level(sheet: PatternsSheet, at: vec2f, level: u32) -> vec3f {
    var first = sheet.first_texel;
    var size = vec2u(sheet.columns, sheet.rows);
    for (var finer = 0u; finer < level; finer++) {
        first += size.x * size.y;
        size = (size + 1u) / 2u;
    }
    let place = clamp(at * exp2(-f32(level)) - 0.5, vec2f(0.0), vec2f(size - 1u));
    let low = vec2u(place);
    let high = min(low + 1u, size - 1u);
    let weight = place - vec2f(low);
    let rows = first + size.x * vec2u(low.y, high.y);
    let upper = mix(patterns_texel(rows.x + low.x), patterns_texel(rows.x + high.x), weight.x);
    let lower = mix(patterns_texel(rows.y + low.x), patterns_texel(rows.y + high.x), weight.x);
    return mix(upper, lower, weight.y);
}

fn patterns_texel(index: u32) -> vec3f {
    return vec3f(patterns_texels[3u * index], patterns_texels[3u * index + 1u], patterns_texels[3u * index + 2u]);
}
