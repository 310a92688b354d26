// Vertices: from a mesh to where its instances stand, and to what fragments are shaded with.

struct VerticesInstance {
    world_from_mesh: mat4x4f,
    normal_from_mesh: mat3x3f,
    // Multiplies the emission texture; without one it is the radiance itself.
    emission: vec3f,
    material: u32,
    // -1 where world_from_mesh mirrors, else 1.
    handedness: f32,
}

@group(0) @binding(3) var<storage, read> vertices_instances: array<VerticesInstance>;

struct VerticesVarying {
    @builtin(position) @invariant position: vec4f,
    // Centroid: at a silhouette the centre of a multisampled pixel may lie off the triangle.
    @location(0) @interpolate(perspective, centroid) p_from_origin: vec3f,
    @location(1) @interpolate(perspective, centroid) n_world: vec3f,
    @location(2) @interpolate(flat) emission: vec3f,
    @location(3) @interpolate(flat) material: u32,
    // At the pixel's centre, because derivatives are taken of it; those of centroid values jump.
    @location(4) n_center: vec3f,
    // dot(n_center, p_from_origin) of the corners.
    @location(5) height: f32,
}

// The same with what textures and vertex colours need.
struct VerticesTexturedVarying {
    @builtin(position) @invariant position: vec4f,
    @location(0) @interpolate(perspective, centroid) p_from_origin: vec3f,
    @location(1) @interpolate(perspective, centroid) n_world: vec3f,
    @location(2) @interpolate(flat) emission: vec3f,
    @location(3) @interpolate(flat) material: u32,
    @location(4) n_center: vec3f,
    @location(5) height: f32,
    @location(6) t_world: vec4f,
    @location(7) tex_coords: vec4f,
    @location(8) @interpolate(perspective, centroid) color: vec4f,
    // Tells triangles apart.
    @location(9) @interpolate(flat) seed: u32,
}

fn vertices_place(position: vec3f, normal: vec3f, index: u32) -> VerticesVarying {
    let p_world = vertices_instances[index].world_from_mesh * vec4f(position, 1.0);
    // Unit length before interpolation, whatever the transform's scale.
    let n_world = filters_normalize(vertices_instances[index].normal_from_mesh * normal);
    let clip = frame_now.clip_from_world * p_world;
    let p_from_origin = p_world.xyz - frame_now.origin;
    return VerticesVarying(
        clip, p_from_origin, n_world, vertices_instances[index].emission, vertices_instances[index].material, n_world,
        dot(n_world, p_from_origin),
    );
}

@vertex
fn vertices_plain(
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @builtin(instance_index) index: u32,
) -> VerticesVarying {
    return vertices_place(position, normal, index);
}

@vertex
fn vertices_textured(
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) tangent: vec4f,
    @location(3) tex_coord_0: vec2f,
    @location(4) tex_coord_1: vec2f,
    @location(5) color: vec4f,
    @builtin(instance_index) index: u32,
    @builtin(vertex_index) vertex_index: u32,
) -> VerticesTexturedVarying {
    let bare = vertices_place(position, normal, index);
    let t_world = filters_normalize((vertices_instances[index].world_from_mesh * vec4f(tangent.xyz, 0.0)).xyz);
    let side = tangent.w * vertices_instances[index].handedness;
    return VerticesTexturedVarying(
        bare.position, bare.p_from_origin, bare.n_world, bare.emission, bare.material, bare.n_world, bare.height,
        vec4f(t_world, side), vec4f(tex_coord_0, tex_coord_1), color, vertex_index ^ coverage_hash(index),
    );
}
