// What stands in the way of light: all triangles of a scene, in hierarchies as src/bvh.rs builds them, and what of them lets light through.

struct Blockers {
    // Trees' coordinates are (p_world - center) / unit.
    center: vec3f,
    unit: f32,
    // The nodes at which the two trees begin: of what stays and of what moves with the lights. The second is BLOCKERS_NONE where there is only one.
    roots: vec2u,
    // Where the looks of what is cut out or blended begin in blockers_nodes, BLOCKERS_LOOK each.
    first_look: u32,
    // Where the triangles begin there.
    first_triangle: u32,
}

struct BlockersTriangle {
    corner: vec3f,
    // The light whose emitter it is of, else BLOCKERS_NONE.
    light: u32,
    first_edge: vec3f,
    // Where blockers_nodes has its coordinates and opacities; BLOCKERS_NONE: it is opaque.
    opacity: u32,
    second_edge: vec3f,
}

const BLOCKERS_NONE = 0xffffffffu;
// Half the size of the larger side of what a tree holds, in its unit.
const BLOCKERS_SPAN = 1048576.0;
// Texels of a node, of a triangle, and of a look.
const BLOCKERS_NODE = 5u;
const BLOCKERS_TRIANGLE = 3u;
const BLOCKERS_LOOK = 2u;
// Texels in a row are two to this power.
const BLOCKERS_ROW = 13u;

const BLOCKERS_REPEAT = 0u;
const BLOCKERS_MIRROR = 1u;

@group(2) @binding(0) var<uniform> blockers_all: Blockers;
// Nodes of trees, what triangles that are cut out or blended let through, and the triangles. A texture, of numbers in rows one after the other: it holds
// more than buffers may. Software drivers read it faster than those, and as a storage texture, without levels, half as fast again as otherwise.
@group(2) @binding(1) var blockers_nodes: texture_storage_2d<rgba32uint, read>;
// The alphas of images, one after the other, row by row, and on in the next layer.
@group(2) @binding(2) var blockers_alphas: texture_2d_array<f32>;

fn blockers_node(index: u32) -> vec4u {
    return textureLoad(blockers_nodes, numbers_place(index, BLOCKERS_ROW));
}

fn blockers_triangle(index: u32) -> BlockersTriangle {
    let first = blockers_all.first_triangle + BLOCKERS_TRIANGLE * index;
    let corner = blockers_node(first);
    let first_edge = blockers_node(first + 1u);
    let second_edge = blockers_node(first + 2u);
    return BlockersTriangle(
        bitcast<vec3f>(corner.xyz), corner.w, bitcast<vec3f>(first_edge.xyz), first_edge.w, bitcast<vec3f>(second_edge.xyz),
    );
}

// The share of light that a triangle stops where a ray meets it, by the weights of its second and third corner: of a mask all or nothing.
fn blockers_opacity(place: u32, weights: vec2f) -> f32 {
    let first = bitcast<vec4f>(blockers_node(place));
    let second = blockers_node(place + 1u);
    let shares = vec3f(1.0 - weights.x - weights.y, weights);
    let uv = shares.x * first.xy + shares.y * first.zw + shares.z * bitcast<vec2f>(second.xy);
    let alphas = vec3f(unpack2x16unorm(second.z), unpack2x16unorm(second.w).x);
    let look = blockers_all.first_look + BLOCKERS_LOOK * (second.w >> 16u);
    let factors = bitcast<vec2f>(blockers_node(look + 1u).xy);
    let opacity = factors.x * dot(shares, alphas) * blockers_texel(blockers_node(look), uv);
    // What is blended has a cutoff below 0.
    return select(select(0.0, 1.0, opacity >= factors.y), opacity, factors.y < 0.0);
}

// The alpha of an image, filtered as where it is magnified: scene::Sampler::magnified. `image` has its first texel, its width and height, which are 0
// where there is none, and how it goes on along u (two bits) and v (two), and whether the nearest texel is taken.
fn blockers_texel(image: vec4u, uv: vec2f) -> f32 {
    if image.y == 0u {
        return 1.0;
    }
    var place = uv * vec2f(image.yz) - 0.5;
    // As far as f32 has whole numbers.
    place = select(vec2f(0.0), place, abs(place) < vec2f(1e6));
    place = select(place, round(place), (image.w & 16u) != 0u);
    let corner = vec2i(floor(place));
    let fraction = place - floor(place);
    let columns = vec2u(blockers_wrapped(corner.x, image.y, image.w & 3u), blockers_wrapped(corner.x + 1, image.y, image.w & 3u));
    let mode = (image.w >> 2u) & 3u;
    let rows = image.x + image.y * vec2u(blockers_wrapped(corner.y, image.z, mode), blockers_wrapped(corner.y + 1, image.z, mode));
    let upper = mix(blockers_alpha(rows.x + columns.x), blockers_alpha(rows.x + columns.y), fraction.x);
    let lower = mix(blockers_alpha(rows.y + columns.x), blockers_alpha(rows.y + columns.y), fraction.x);
    return mix(upper, lower, fraction.y);
}

fn blockers_alpha(texel: u32) -> f32 {
    let size = textureDimensions(blockers_alphas);
    let row = texel / size.x;
    return textureLoad(blockers_alphas, vec2u(texel % size.x, row % size.y), row / size.y, 0).x;
}

// scene::Wrap::texel
fn blockers_wrapped(at: i32, count: u32, mode: u32) -> u32 {
    let side = i32(count);
    if mode == BLOCKERS_REPEAT {
        return u32(((at % side) + side) % side);
    }
    if mode == BLOCKERS_MIRROR {
        let folded = ((at % (2 * side)) + 2 * side) % (2 * side);
        return u32(min(folded, 2 * side - 1 - folded));
    }
    return u32(clamp(at, 0, side - 1));
}
