// A point to be lit.

struct Receiver {
    p_world: vec3f,
    normal: vec3f,
    local_from_world: mat3x3f,
    // The normal without the normal map, in the local frame.
    up: vec3f,
    lobes: Lobes,
    // The sheen where it is no transformed cosine.
    prior_sheen: PriorSheensView,
    sheen_color: vec3f,
    sheen_alpha: f32,
    layering: u32,
    // What the sheen leaves of the base, seen from the view's side.
    base_weight: f32,
    // What the lobes scatter of light that fills them.
    colors: LobesColors,
    // Of the pixel's random numbers, and which of its samples this is.
    seed: u32,
    sample: u32,
}

// Both normals are unit and on the side that is seen; smooth_normal is without the normal map. mu takes the place of the
// view's cosine.
fn receiver_at(
    p_world: vec3f, normal: vec3f, smooth_normal: vec3f, view: vec3f, mu: f32, surface: MaterialSurface, lobes: Lobes,
) -> Receiver {
    let local_from_world = ltc_frame(normal, view);
    var receiver: Receiver;
    receiver.p_world = p_world;
    receiver.normal = normal;
    receiver.local_from_world = local_from_world;
    receiver.up = local_from_world * smooth_normal;
    receiver.lobes = lobes;
    receiver.prior_sheen = prior_sheens_view(local_from_world * view, mu, surface.sheen_alpha, lobes.sheen.albedo);
    receiver.sheen_color = surface.sheen_color;
    receiver.sheen_alpha = surface.sheen_alpha;
    receiver.layering = surface.layering;
    receiver.base_weight = receiver_material_weight(surface, lobes.sheen.albedo);
    return receiver;
}

// What the sheen leaves of light from around this cosine; by the reciprocal rule the lesser of both sides' shares.
fn receiver_base_weight(receiver: Receiver, cosine: f32) -> f32 {
    if !VARIANT_RECIPROCAL || receiver.layering != MATERIAL_LAYERING_RECIPROCAL {
        return receiver.base_weight;
    }
    let albedo = lobes_sheen(receiver.sheen_alpha, cosine).albedo;
    return min(receiver.base_weight, max(sheen_base_weight(receiver.sheen_color, albedo), 0.0));
}

// What is left of the base under a sheen of this albedo, which may pass 1 (Conty-Kulla's does), seen from the view's side.
fn receiver_material_weight(surface: MaterialSurface, sheen_albedo: f32) -> f32 {
    if !VARIANT_SHEEN {
        return 1.0;
    }
    switch surface.layering {
        case MATERIAL_LAYERING_GLTF, MATERIAL_LAYERING_RECIPROCAL: {
            return max(sheen_base_weight(surface.sheen_color, sheen_albedo), 0.0);
        }
        case MATERIAL_LAYERING_OPENPBR: {
            return max(sheen_base_weight_openpbr(surface.sheen_weight, sheen_albedo), 0.0);
        }
        default: {
            return surface.manual;
        }
    }
}
