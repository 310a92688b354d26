// The first pass: every surface's radiance towards the eye: emission, and the lobes lit by all polygon lights.
// Concatenated with ltc.wgsl and sheen.wgsl.

struct SurfacesFrame {
    clip_from_world: mat4x4f,
    // The eye's place (w = 1) or the direction towards it (w = 0).
    eye: vec4f,
    // Weights, 0 or 1, of sheen, diffuse, emission.
    lobes: vec3f,
    polygon_count: u32,
    // What radiance is multiplied by before it is stored, so that the range of the targets' floats is the screen's.
    gain: f32,
}

struct SurfacesInstance {
    world_from_mesh: mat4x4f,
    normal_from_mesh: mat3x3f,
    emission: vec3f,
    material: u32,
}

struct SurfacesMaterial {
    base_color: vec3f,
    alpha: f32,
    sheen_color: vec3f,
}

struct SurfacesPolygon {
    radiance: vec3f,
    two_sided: u32,
    normal: vec3f,
    first_vertex: u32,
    end_vertex: u32,
}

@group(0) @binding(0) var<uniform> surfaces_frame: SurfacesFrame;
@group(0) @binding(1) var surfaces_sheen_table: texture_2d<f32>;
@group(0) @binding(2) var<storage, read> surfaces_instances: array<SurfacesInstance>;
@group(0) @binding(3) var<storage, read> surfaces_materials: array<SurfacesMaterial>;
@group(0) @binding(4) var<storage, read> surfaces_polygons: array<SurfacesPolygon>;
// Outlines one after another; w = 1 marks the first vertex of each, which comes again at its end.
@group(0) @binding(5) var<storage, read> surfaces_light_vertices: array<vec4f>;

struct SurfacesVarying {
    @builtin(position) position: vec4f,
    // Centroid: at a silhouette the centre of a multisampled pixel may lie off the triangle.
    @location(0) @interpolate(perspective, centroid) p_world: vec3f,
    @location(1) @interpolate(perspective, centroid) n_world: vec3f,
    @location(2) @interpolate(flat) emission: vec3f,
    @location(3) @interpolate(flat) material: u32,
}

@vertex
fn surfaces_vertex(
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @builtin(instance_index) index: u32,
) -> SurfacesVarying {
    let p_world = surfaces_instances[index].world_from_mesh * vec4f(position, 1.0);
    var out: SurfacesVarying;
    out.position = surfaces_frame.clip_from_world * p_world;
    out.p_world = p_world.xyz;
    // Unit length before interpolation, whatever the transform's scale.
    out.n_world = surfaces_normalize(surfaces_instances[index].normal_from_mesh * normal);
    out.emission = surfaces_instances[index].emission;
    out.material = surfaces_instances[index].material;
    return out;
}

// A zero vector, which no direction stands for, comes back as it is.
fn surfaces_normalize(v: vec3f) -> vec3f {
    let length_squared = dot(v, v);
    return v * select(0.0, inverseSqrt(length_squared), length_squared > 0.0);
}

// The error of interpolated positions, as a share of the largest coordinate: a few roundings of f32. Points no further
// from a light's plane are in it, so that a light does not shine on itself.
const SURFACES_POSITION_ERROR = 1e-6;

// Form factors of one light for both lobes: x the diffuse one, y the sheen.
fn surfaces_form_factors(polygon: SurfacesPolygon, p_world: vec3f, local_from_world: mat3x3f, m_inv: mat3x3f) -> vec2f {
    let to_vertex = surfaces_light_vertices[polygon.first_vertex].xyz - p_world;
    let side = ltc_side(polygon.normal, to_vertex, polygon.two_sided != 0u);
    let size = abs(p_world) + abs(to_vertex);
    let error = SURFACES_POSITION_ERROR * max(size.x, max(size.y, size.z));
    if side == 0.0 || abs(dot(polygon.normal, to_vertex)) <= error {
        return vec2f(0.0);
    }
    let identity = mat3x3f(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    var sums = vec2f(0.0);
    var turn = LTC_LEVEL;
    var outline = ltc_begin(local_from_world * to_vertex);
    for (var index = polygon.first_vertex + 1u; index < polygon.end_vertex; index++) {
        let vertex = surfaces_light_vertices[index];
        let p_local = local_from_world * (vertex.xyz - p_world);
        if vertex.w != 0.0 {
            outline = ltc_begin(p_local);
        } else {
            outline = ltc_next(outline, p_local);
            sums += vec2f(ltc_edge(outline, identity), ltc_edge(outline, m_inv));
            turn = ltc_turn(turn, outline, identity);
        }
    }
    return vec2f(ltc_form_factor(sums.x, turn, identity, side), ltc_form_factor(sums.y, turn, m_inv, side));
}

@fragment
fn surfaces_fragment(in: SurfacesVarying, @builtin(front_facing) front_facing: bool) -> @location(0) vec4f {
    let material = surfaces_materials[in.material];
    let normal = surfaces_normalize(in.n_world) * select(-1.0, 1.0, front_facing);
    let view = surfaces_normalize(surfaces_frame.eye.xyz - surfaces_frame.eye.w * in.p_world);
    let local_from_world = ltc_frame(normal, view);
    let lobe = sheen_lobe(surfaces_sheen_table, material.alpha, max(dot(normal, view), 0.0));
    let sheen_weight = surfaces_frame.lobes.x * lobe.albedo * material.sheen_color;
    let base_weight = surfaces_frame.lobes.y * sheen_base_weight(material.sheen_color, lobe.albedo) * material.base_color;
    var radiance = surfaces_frame.lobes.z * in.emission;
    for (var index = 0u; index < surfaces_frame.polygon_count; index++) {
        let polygon = surfaces_polygons[index];
        let form_factors = surfaces_form_factors(polygon, in.p_world, local_from_world, lobe.m_inv);
        radiance += polygon.radiance * (base_weight * form_factors.x + sheen_weight * form_factors.y);
    }
    return vec4f(surfaces_frame.gain * radiance, 1.0);
}
