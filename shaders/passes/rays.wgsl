// Rays from lit points to lights, through the trees of what blocks them.

// What a triangle is to a ray.
struct RaysMeeting {
    // In the tree's units; negative where the ray misses it.
    distance: f32,
    // Weights of its second and third corner.
    weights: vec2f,
}

// Groups that may wait. Of 5000 triangles, each within the one before, 14 do (a test in src/renderer/blockers.rs holds them below this).
const RAYS_STACK = 32;
// Of a group of siblings that are to be visited, the bits that say which, in the order of the ray's octant; above them is the place to which
// their slots are added.
const RAYS_SLOTS = 0xffu;
const RAYS_SLOT_BITS = 8u;
// Of what a ray meets of a node's children, the bits of the triangles; the nodes' are above them.
const RAYS_TRIANGLES = 0xffffffu;
const RAYS_TRIANGLE_BITS = 24u;
// How far outside an edge a triangle is still met, in weights of its corners, so that neighbours leave no gap.
const RAYS_EDGE = 2e-6;
// Components of directions are no smaller.
const RAYS_LEAST = 1e-20;
// A light's own emitter stands in its way up to this share of the distance to it; others up to that one.
const RAYS_OWN_UNTIL = 0.999;
const RAYS_UNTIL = 0.99999;
// The share of light below which nothing is left of it.
const RAYS_LEAST_PASSING = 1e-6;

// Groups that wait. A function's own would be set to 0 for each ray.
var<private> rays_stack: array<u32, RAYS_STACK>;

// The share of light, in [0, 1], that comes through to a point along a unit direction, from a light at a distance. It is stopped from the
// front and from behind by what is opaque, and by what is blended to the share of its opacity.
//
// Ylitie, Karras and Laine 2017, section 4: groups of children and of triangles as bits, nearer children first; and from node to node until there
// are triangles, then through those (Aila and Laine 2009): software drivers run all of a loop's body for all of some neighbouring pixels, as long
// as one of them needs any of it. For the same reason loops are left at their ends: they run to there, whatever is left to do.
fn rays_passing(p_world: vec3f, direction: vec3f, distance: f32, light: u32) -> f32 {
    let origin = (p_world - blockers_all.center) / blockers_all.unit;
    let far = distance / blockers_all.unit;
    let is_up = direction >= vec3f(0.0);
    let least = select(vec3f(-RAYS_LEAST), vec3f(RAYS_LEAST), is_up);
    let inverse = 1.0 / select(direction, least, abs(direction) < vec3f(RAYS_LEAST));
    let octant = dot(select(vec3u(0u), vec3u(4u, 2u, 1u), is_up), vec3u(1u));
    // Of roots the slot is 0.
    let roots = (blockers_all.roots << vec2u(RAYS_SLOT_BITS)) | vec2u(1u << octant);
    rays_stack[0] = roots.y;
    var height = select(1, 0, blockers_all.roots.y == BLOCKERS_NONE);
    var group = roots.x;
    var passing = 1.0;
    loop {
        var triangles = 0u;
        var first = 0u;
        loop {
            let bit = firstLeadingBit(group & RAYS_SLOTS);
            let node = BLOCKERS_NODE * ((group >> RAYS_SLOT_BITS) + (bit ^ octant));
            group ^= 1u << bit;
            if (group & RAYS_SLOTS) != 0u && height < RAYS_STACK {
                rays_stack[height] = group;
                height++;
            }
            let head = blockers_node(node);
            let base = blockers_node(node + 1u);
            let hits = rays_children(node, head, base.zw, origin, inverse, far * RAYS_UNTIL, octant);
            group = (base.x << RAYS_SLOT_BITS) | (hits >> RAYS_TRIANGLE_BITS);
            first = base.y;
            triangles = hits & RAYS_TRIANGLES;
            if (group & RAYS_SLOTS) == 0u && height > 0 {
                height--;
                group = rays_stack[height];
            }
            continuing {
                break if triangles != 0u || (group & RAYS_SLOTS) == 0u;
            }
        }
        loop {
            let index = first + (firstTrailingBit(triangles) & 31u);
            let share = rays_passing_triangle(index, origin, direction, far, light);
            passing *= select(1.0, share, triangles != 0u);
            triangles &= triangles - 1u;
            continuing {
                break if triangles == 0u;
            }
        }
        continuing {
            break if passing < RAYS_LEAST_PASSING || (group & RAYS_SLOTS) == 0u;
        }
    }
    return select(passing, 0.0, passing < RAYS_LEAST_PASSING);
}

// Which of a node's children a ray meets before a distance: of nodes in the upper eight bits, in the order of the octant; of triangles in the lower ones.
fn rays_children(node: u32, head: vec4u, children: vec2u, origin: vec3f, inverse: vec3f, until: f32, octant: u32) -> u32 {
    let extent = bitcast<vec3f>(((vec3u(head.w) >> vec3u(0u, 8u, 16u)) & vec3u(0xffu)) << vec3u(23u));
    let scale = extent * inverse;
    let start = (bitcast<vec3f>(head.xyz) - origin) * inverse;
    let x = blockers_node(node + 2u);
    let y = blockers_node(node + 3u);
    let z = blockers_node(node + 4u);
    // Minima of four and of four, then maxima.
    let near_x = select(x.zw, x.xy, inverse.x > 0.0);
    let near_y = select(y.zw, y.xy, inverse.y > 0.0);
    let near_z = select(z.zw, z.xy, inverse.z > 0.0);
    let far_x = select(x.xy, x.zw, inverse.x > 0.0);
    let far_y = select(y.xy, y.zw, inverse.y > 0.0);
    let far_z = select(z.xy, z.zw, inverse.z > 0.0);
    return rays_four(vec3u(near_x.x, near_y.x, near_z.x), vec3u(far_x.x, far_y.x, far_z.x), children.x, scale, start, until, octant)
        | rays_four(vec3u(near_x.y, near_y.y, near_z.y), vec3u(far_x.y, far_y.y, far_z.y), children.y, scale, start, until, octant);
}

fn rays_four(near: vec3u, far: vec3u, children: u32, scale: vec3f, start: vec3f, until: f32, octant: u32) -> u32 {
    let enter = rays_greater(rays_greater(rays_planes(near.x, scale.x, start.x), rays_planes(near.y, scale.y, start.y)),
        rays_greater(rays_planes(near.z, scale.z, start.z), vec4f(0.0)));
    let leave = rays_smaller(rays_smaller(rays_planes(far.x, scale.x, start.x), rays_planes(far.y, scale.y, start.y)),
        rays_smaller(rays_planes(far.z, scale.z, start.z), vec4f(until)));
    let metas = rays_bytes(children);
    // A node's number is 24 or more; a leaf's says how many triangles it has, a bit each, and where they begin.
    let is_node = (metas & vec4u(24u)) == vec4u(24u);
    let place = (metas ^ select(vec4u(0u), vec4u(octant), is_node)) & vec4u(31u);
    let bits = select(vec4u(0u), (metas >> vec4u(5u)) << place, enter <= leave);
    return bits.x | bits.y | bits.z | bits.w;
}

// Without what min and max do about NaN, of which there is none but in rays that go nowhere, and those meet nothing: on software drivers that takes longer than they.
fn rays_smaller(a: vec4f, b: vec4f) -> vec4f {
    return select(b, a, a < b);
}

fn rays_greater(a: vec4f, b: vec4f) -> vec4f {
    return select(b, a, a > b);
}

fn rays_bytes(word: u32) -> vec4u {
    return (vec4u(word) >> vec4u(0u, 8u, 16u, 24u)) & vec4u(0xffu);
}

fn rays_planes(word: u32, scale: f32, start: f32) -> vec4f {
    return vec4f(rays_bytes(word)) * scale + start;
}

// The share of light that a triangle lets through.
fn rays_passing_triangle(index: u32, origin: vec3f, direction: vec3f, distance: f32, light: u32) -> f32 {
    let triangle = blockers_triangle(index);
    let meeting = rays_meeting(triangle, origin, direction);
    let until = distance * select(RAYS_UNTIL, RAYS_OWN_UNTIL, triangle.light == light);
    if meeting.distance <= 0.0 || meeting.distance >= until {
        return 1.0;
    }
    if !VARIANT_OPACITIES || triangle.opacity == BLOCKERS_NONE {
        return 0.0;
    }
    return 1.0 - blockers_opacity(triangle.opacity, meeting.weights);
}

// Moeller and Trumbore 1997.
fn rays_meeting(triangle: BlockersTriangle, origin: vec3f, direction: vec3f) -> RaysMeeting {
    let across = cross(direction, triangle.second_edge);
    let slope = dot(triangle.first_edge, across);
    let to_origin = origin - triangle.corner;
    let over = cross(to_origin, triangle.first_edge);
    // Without area it is met nowhere.
    let factor = select(0.0, 1.0 / slope, slope != 0.0);
    let weights = factor * vec2f(dot(to_origin, across), dot(direction, over));
    let is_met = slope != 0.0 && min(weights.x, weights.y) >= -RAYS_EDGE && weights.x + weights.y <= 1.0 + RAYS_EDGE;
    return RaysMeeting(select(-1.0, factor * dot(triangle.second_edge, over), is_met), weights);
}
