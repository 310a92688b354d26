// The first pass with shadows: beside the radiance with nothing in the way, what of it is blocked, and what the filter of shares goes by.

struct ShadowedTargets {
    @location(0) radiance: vec4f,
    @location(1) blocked: vec4f,
    // The place, from the camera's, and the normal and a number of the material in 24 bits.
    @location(2) guide: vec4f,
}

// A pixel's share of a surface.
struct ShadowedPoint {
    p_from_origin: vec3f,
    n_world: vec3f,
    n_center: vec3f,
    height: f32,
    material: u32,
    pixel: vec2f,
}

@fragment
fn shadowed_fragment(in: VerticesVarying, @builtin(front_facing) front_facing: bool) -> ShadowedTargets {
    texels_footprint = frame_now.footprint;
    let surface = material_plain(in.material, in.emission, in.n_world);
    let point = ShadowedPoint(in.p_from_origin, in.n_world, in.n_center, in.height, in.material, in.position.xy);
    return shadowed_targets(surface, point, front_facing);
}

@fragment
fn shadowed_fragment_textured(in: VerticesTexturedVarying, @builtin(front_facing) front_facing: bool) -> ShadowedTargets {
    let surface = shadowed_textured(in);
    let point = ShadowedPoint(in.p_from_origin, in.n_world, in.n_center, in.height, in.material, in.position.xy);
    return shadowed_targets(surface, point, front_facing);
}

// Depth alone, of what is cut out.
@fragment
fn shadowed_cutout(in: VerticesVarying) {
    if material_plain(in.material, in.emission, in.n_world).samples == 0u {
        discard;
    }
}

@fragment
fn shadowed_cutout_textured(in: VerticesTexturedVarying) {
    if shadowed_textured(in).samples == 0u {
        discard;
    }
}

fn shadowed_textured(in: VerticesTexturedVarying) -> MaterialSurface {
    texels_footprint = frame_now.footprint;
    return material_textured(
        in.material, in.emission, in.n_world, in.t_world, in.tex_coords, in.color, in.position.xy, in.seed,
    );
}

fn shadowed_targets(surface: MaterialSurface, at: ShadowedPoint, front_facing: bool) -> ShadowedTargets {
    let p_world = frame_now.origin + at.p_from_origin;
    var seen = surfaces_seen(surface, p_world, at.n_world, at.n_center, front_facing, 1u);
    let flat_normal = cross(dpdx(at.p_from_origin), dpdy(at.p_from_origin));
    if VARIANT_MASK && surface.samples == 0u {
        discard;
    }
    var targets: ShadowedTargets;
    targets.blocked = vec4f(vec3f(0.0), seen.opacity);
    targets.guide = vec4f(at.p_from_origin, shadowed_packed(seen.point.smooth_normal, at.material));
    if VARIANT_UNLIT {
        targets.radiance = surfaces_unlit(frame_now.emission * surface.base_color, seen.opacity);
        return targets;
    }
    seen.point.seed = randoms_seed(at.pixel, frame_now.seed);
    seen.point.sample = frame_now.sample;
    let receiver = shading_receiver(surface, seen.point, seen.weights);
    let reflected = shading_reflected(receiver, surface.occlusion, seen.weights);
    targets.radiance = surfaces_stored(frame_now.emission * surface.emission + reflected, seen.opacity);
    let origin = shadows_origin(seen.point, at.p_from_origin, at.height, at.n_center, flat_normal, seen.side);
    targets.blocked = surfaces_stored(shadows_blocked(receiver, origin), seen.opacity);
    return targets;
}

// A unit normal in 9 bits a coordinate of the octahedron (Meyer et al. 2010) and 6 bits of the material, as a whole number that f32 holds.
fn shadowed_packed(normal: vec3f, material: u32) -> f32 {
    let folded = normal.xy / (abs(normal.x) + abs(normal.y) + abs(normal.z) + 1e-20);
    let turned = (1.0 - abs(folded.yx)) * select(vec2f(-1.0), vec2f(1.0), folded >= vec2f(0.0));
    let flat = select(turned, folded, normal.z >= 0.0);
    let steps = vec2u(round(saturate(0.5 + 0.5 * flat) * 511.0));
    return f32(steps.x | steps.y << 9u | (material & 63u) << 18u);
}
