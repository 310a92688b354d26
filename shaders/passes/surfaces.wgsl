// The first pass: every surface's radiance towards the eye: emission, and the lobes lit by all lights.
// It stands on the floors of the other files, which src/renderer/shader.rs lists.

// The greatest number that the target holds.
override SURFACES_GREATEST: f32 = 65504.0;

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

@fragment
fn surfaces_fragment(in: VerticesVarying, @builtin(front_facing) front_facing: bool) -> @location(0) vec4f {
    return surfaces_plain(in, front_facing, 1u);
}

@fragment
fn surfaces_fragment_textured(in: VerticesTexturedVarying, @builtin(front_facing) front_facing: bool) -> @location(0) vec4f {
    return surfaces_covered(in, front_facing, 1u).radiance;
}

// With more than one sample a pixel: naga's GLSL has no word for those that are covered, and OpenGL draws one.
@fragment
fn surfaces_multisampled(in: VerticesVarying, @builtin(front_facing) front_facing: bool, @builtin(sample_mask) samples: u32) -> @location(0) vec4f {
    return surfaces_plain(in, front_facing, samples);
}

@fragment
fn surfaces_multisampled_textured(
    in: VerticesTexturedVarying, @builtin(front_facing) front_facing: bool, @builtin(sample_mask) samples: u32,
) -> @location(0) vec4f {
    return surfaces_covered(in, front_facing, samples).radiance;
}

// The same of what is cut out.
@fragment
fn surfaces_multisampled_cutout(in: VerticesTexturedVarying, @builtin(front_facing) front_facing: bool, @builtin(sample_mask) samples: u32) -> SurfacesCovered {
    return surfaces_covered(in, front_facing, samples);
}

fn surfaces_plain(in: VerticesVarying, front_facing: bool, samples: u32) -> vec4f {
    let surface = material_plain(in.material, in.emission, in.n_world);
    return surfaces_radiance(surface, frame_now.origin + in.p_from_origin, in.n_world, in.n_center, front_facing, samples);
}

fn surfaces_covered(in: VerticesTexturedVarying, front_facing: bool, samples: u32) -> SurfacesCovered {
    let surface = material_textured(
        in.material, in.emission, in.n_world, in.t_world, in.tex_coords, in.color, in.position.xy, in.seed,
    );
    let p_world = frame_now.origin + in.p_from_origin;
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
    let view = filters_normalize(frame_now.eye.xyz - frame_now.eye.w * p_world);
    let pixel = filters_pixel(n_center, view, surface.roughness, samples);
    var point = ShadingPoint(p_world, normal, smooth_normal, view, max(dot(normal, view), 0.0), surface.roughness, 0u, 0u);
    if VARIANT_FILTERED {
        point.mu = filters_visible_mean(dot(normal, view), pixel.width);
        point.roughness = filters_roughness(surface.roughness, pixel.variance, surface.normal_length);
    }
    let weights = ShadingWeights(frame_now.diffuse, frame_now.specular, frame_now.sheen, frame_now.ambient);
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
        return surfaces_unlit(frame_now.emission * surface.base_color, seen.opacity);
    }
    // From the centroid's normal to that of the centre.
    let normal_at_center = surface.normal + (n_center - n_world);
    let reflected = shading_pixel(surface, seen.point, seen.weights, normal_at_center, seen.side, seen.pixel, samples);
    return surfaces_stored(frame_now.emission * surface.emission + reflected, seen.opacity);
}

// As the target holds what is shown as it is: without gain, and 0 for the share of the pixel that is lit. Where it is blended, its opacity is
// what it leaves of that share (src/renderer/pipelines.rs).
fn surfaces_unlit(color: vec3f, opacity: f32) -> vec4f {
    return vec4f(opacity * color, select(0.0, opacity, VARIANT_BLEND));
}

// As the target holds it: opacity times radiance, kept finite, because blending turns infinities into NaN, and the share of the pixel that is lit.
fn surfaces_stored(radiance: vec3f, opacity: f32) -> vec4f {
    return vec4f(opacity * min(frame_now.gain * radiance, vec3f(SURFACES_GREATEST)), opacity);
}
