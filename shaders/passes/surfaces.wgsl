// The first pass: every surface's radiance towards the eye: emission, and the lobes lit by all lights.
// It stands on the floors of the other files, which src/renderer/shader.rs lists.

struct SurfacesFrame {
    clip_from_world: mat4x4f,
    // The eye's place (w = 1) or the direction towards it (w = 0).
    eye: vec4f,
    // Weights, 0 or 1, of the lobes and the emission.
    diffuse: f32,
    specular: f32,
    sheen: f32,
    emission: f32,
    // The camera's place. Interpolated positions are relative to it: drivers err by a share of what they interpolate.
    origin: vec3f,
    ambient: vec3f,
    // Radiance is multiplied by this before it is stored, so that the targets' floats cover the range that the screen shows.
    gain: f32,
    // Which of a pixel's samples this is, the side of what it stands for, in pixels, and the start of the random numbers.
    sample: u32,
    footprint: f32,
    seed: u32,
}

struct SurfacesInstance {
    world_from_mesh: mat4x4f,
    normal_from_mesh: mat3x3f,
    // Multiplies the emission texture; without one it is the radiance itself.
    emission: vec3f,
    material: u32,
    // -1 where world_from_mesh mirrors, else 1.
    handedness: f32,
}

// The greatest number that the target holds.
override SURFACES_GREATEST: f32 = 65504.0;

@group(0) @binding(0) var<uniform> surfaces_frame: SurfacesFrame;
@group(0) @binding(3) var<storage, read> surfaces_instances: array<SurfacesInstance>;

struct SurfacesVarying {
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
struct SurfacesTexturedVarying {
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

// What shading needs to know of a surface besides what it is made of.
struct SurfacesSeen {
    point: ShadingPoint,
    pixel: FiltersPixel,
    weights: ShadingWeights,
    // -1 where it is seen from behind, else 1.
    side: f32,
    opacity: f32,
}

// Radiance, and which of the pixel's samples get it.
struct SurfacesCovered {
    @location(0) radiance: vec4f,
    @builtin(sample_mask) samples: u32,
}

fn surfaces_place(position: vec3f, normal: vec3f, index: u32) -> SurfacesVarying {
    let p_world = surfaces_instances[index].world_from_mesh * vec4f(position, 1.0);
    // Unit length before interpolation, whatever the transform's scale.
    let n_world = filters_normalize(surfaces_instances[index].normal_from_mesh * normal);
    let clip = surfaces_frame.clip_from_world * p_world;
    let p_from_origin = p_world.xyz - surfaces_frame.origin;
    return SurfacesVarying(
        clip, p_from_origin, n_world, surfaces_instances[index].emission, surfaces_instances[index].material, n_world,
        dot(n_world, p_from_origin),
    );
}

@vertex
fn surfaces_vertex(
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @builtin(instance_index) index: u32,
) -> SurfacesVarying {
    return surfaces_place(position, normal, index);
}

@vertex
fn surfaces_vertex_textured(
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) tangent: vec4f,
    @location(3) tex_coord_0: vec2f,
    @location(4) tex_coord_1: vec2f,
    @location(5) color: vec4f,
    @builtin(instance_index) index: u32,
    @builtin(vertex_index) vertex_index: u32,
) -> SurfacesTexturedVarying {
    let bare = surfaces_place(position, normal, index);
    let t_world = filters_normalize((surfaces_instances[index].world_from_mesh * vec4f(tangent.xyz, 0.0)).xyz);
    let side = tangent.w * surfaces_instances[index].handedness;
    return SurfacesTexturedVarying(
        bare.position, bare.p_from_origin, bare.n_world, bare.emission, bare.material, bare.n_world, bare.height,
        vec4f(t_world, side), vec4f(tex_coord_0, tex_coord_1), color, vertex_index ^ coverage_hash(index),
    );
}

@fragment
fn surfaces_fragment(in: SurfacesVarying, @builtin(front_facing) front_facing: bool) -> @location(0) vec4f {
    return surfaces_plain(in, front_facing, 1u);
}

@fragment
fn surfaces_fragment_textured(in: SurfacesTexturedVarying, @builtin(front_facing) front_facing: bool) -> @location(0) vec4f {
    return surfaces_covered(in, front_facing, 1u).radiance;
}

// With more than one sample a pixel: naga's GLSL has no word for those that are covered, and OpenGL draws one.
@fragment
fn surfaces_multisampled(in: SurfacesVarying, @builtin(front_facing) front_facing: bool, @builtin(sample_mask) samples: u32) -> @location(0) vec4f {
    return surfaces_plain(in, front_facing, samples);
}

@fragment
fn surfaces_multisampled_textured(
    in: SurfacesTexturedVarying, @builtin(front_facing) front_facing: bool, @builtin(sample_mask) samples: u32,
) -> @location(0) vec4f {
    return surfaces_covered(in, front_facing, samples).radiance;
}

// The same of what is cut out.
@fragment
fn surfaces_multisampled_cutout(in: SurfacesTexturedVarying, @builtin(front_facing) front_facing: bool, @builtin(sample_mask) samples: u32) -> SurfacesCovered {
    return surfaces_covered(in, front_facing, samples);
}

fn surfaces_plain(in: SurfacesVarying, front_facing: bool, samples: u32) -> vec4f {
    let surface = material_plain(in.material, in.emission, in.n_world);
    return surfaces_radiance(surface, surfaces_frame.origin + in.p_from_origin, in.n_world, in.n_center, front_facing, samples);
}

fn surfaces_covered(in: SurfacesTexturedVarying, front_facing: bool, samples: u32) -> SurfacesCovered {
    let surface = material_textured(
        in.material, in.emission, in.n_world, in.t_world, in.tex_coords, in.color, in.position.xy, in.seed,
    );
    let p_world = surfaces_frame.origin + in.p_from_origin;
    let radiance = surfaces_radiance(surface, p_world, in.n_world, in.n_center, front_facing, samples);
    return SurfacesCovered(radiance, surface.samples);
}

// A surface as a pixel sees it, of which it covers `samples`.
fn surfaces_seen(
    surface: MaterialSurface, p_world: vec3f, n_world: vec3f, n_center: vec3f, front_facing: bool, samples: u32,
) -> SurfacesSeen {
    let side = select(-1.0, 1.0, front_facing);
    let normal = side * filters_normalize(surface.normal);
    let smooth_normal = side * filters_normalize(n_world);
    let view = filters_normalize(surfaces_frame.eye.xyz - surfaces_frame.eye.w * p_world);
    let pixel = filters_pixel(n_center, view, surface.roughness, samples);
    var point = ShadingPoint(p_world, normal, smooth_normal, view, max(dot(normal, view), 0.0), surface.roughness, 0u, 0u);
    if VARIANT_FILTERED {
        point.mu = filters_visible_mean(dot(normal, view), pixel.width);
        point.roughness = filters_roughness(surface.roughness, pixel.variance, surface.normal_length);
    }
    let weights = ShadingWeights(surfaces_frame.diffuse, surfaces_frame.specular, surfaces_frame.sheen, surfaces_frame.ambient);
    return SurfacesSeen(point, pixel, weights, side, select(1.0, surface.opacity, VARIANT_BLEND));
}

// The radiance of what a pixel shows of a surface, of which it covers `samples`, and its opacity where that counts.
fn surfaces_radiance(
    surface: MaterialSurface, p_world: vec3f, n_world: vec3f, n_center: vec3f, front_facing: bool, samples: u32,
) -> vec4f {
    let seen = surfaces_seen(surface, p_world, n_world, n_center, front_facing, samples);
    if VARIANT_MASK && surface.samples == 0u {
        discard;
    }
    if VARIANT_UNLIT {
        return surfaces_unlit(surfaces_frame.emission * surface.base_color, seen.opacity);
    }
    // From the centroid's normal to that of the centre.
    let normal_at_center = surface.normal + (n_center - n_world);
    let reflected = shading_pixel(surface, seen.point, seen.weights, normal_at_center, seen.side, seen.pixel, samples);
    return surfaces_stored(surfaces_frame.emission * surface.emission + reflected, seen.opacity);
}

// As the target holds what is shown as it is: without gain, and 0 for the share of the pixel that is lit. Where it is blended, its opacity is
// what it leaves of that share (src/renderer/pipelines.rs).
fn surfaces_unlit(color: vec3f, opacity: f32) -> vec4f {
    return vec4f(opacity * color, select(0.0, opacity, VARIANT_BLEND));
}

// As the target holds it: opacity times radiance, kept finite, because blending turns infinities into NaN, and the share of the pixel that is lit.
fn surfaces_stored(radiance: vec3f, opacity: f32) -> vec4f {
    return vec4f(opacity * min(surfaces_frame.gain * radiance, vec3f(SURFACES_GREATEST)), opacity);
}
