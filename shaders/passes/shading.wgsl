// A point's radiance towards the eye, from all lobes and all lights.

// Weights, 0 or 1, of the lobes, and the radiance that arrives from everywhere.
struct ShadingWeights {
    diffuse: f32,
    specular: f32,
    sheen: f32,
    ambient: vec3f,
}

// A point of a surface, seen along `view`.
struct ShadingPoint {
    p_world: vec3f,
    // Unit, on the side that is seen; smooth_normal is without the normal map.
    normal: vec3f,
    smooth_normal: vec3f,
    view: vec3f,
    // Takes the place of the view's cosine.
    mu: f32,
    roughness: f32,
    // Of the pixel's random numbers, and which of its samples this is.
    seed: u32,
    sample: u32,
}

// The point as lights see it.
fn shading_receiver(surface: MaterialSurface, point: ShadingPoint, weights: ShadingWeights) -> Receiver {
    let lobes = lobes_at(point.roughness, surface.sheen_alpha, point.mu);
    var receiver = receiver_at(
        point.p_world, point.normal, point.smooth_normal, point.view, point.mu, surface, lobes,
    );
    receiver.seed = point.seed;
    receiver.sample = point.sample;
    var specular = vec3f(0.0);
    var diffuse = (1.0 - surface.metallic) * surface.base_color;
    if VARIANT_SPECULAR {
        // Tints may be greater than 1.
        let dielectric_f0 = min(surface.f0, vec3f(surface.f90));
        let f0 = mix(dielectric_f0, surface.base_color, surface.metallic);
        let f90 = vec3f(mix(surface.f90, 1.0, surface.metallic));
        specular = weights.specular * ggx_albedo(lobes.specular, f0, f90);
        diffuse *= ggx_base_weight(ggx_albedo(lobes.specular, dielectric_f0, vec3f(surface.f90)));
    }
    let sheen = surface.sheen_color * lobes.sheen.albedo * weights.sheen;
    receiver.colors = LobesColors(weights.diffuse * diffuse, specular, sheen);
    return receiver;
}

// What it scatters of the light that arrives there, with nothing in the way.
fn shading_reflected(receiver: Receiver, occlusion: f32, weights: ShadingWeights) -> vec3f {
    let colors = receiver.colors;
    let incident = lights_incident(receiver);
    let ambient = lights_ambient(receiver) * occlusion * weights.ambient;
    return colors.diffuse * (incident.diffuse + ambient) + colors.specular * (incident.specular + ambient)
        + colors.sheen * (incident.sheen + occlusion * weights.ambient);
}

// What a pixel shows of it: shaded at the centroid, or the mean of what the covered samples scatter that are seen from the front. `n_center` is
// the normal at the pixel's centre, not of unit length, and `side` turns it to the side that is seen.
fn shading_pixel(
    surface: MaterialSurface, centroid: ShadingPoint, weights: ShadingWeights, n_center: vec3f, side: f32,
    pixel: FiltersPixel, samples: u32,
) -> vec3f {
    if !VARIANT_SHARP {
        return shading_reflected(shading_receiver(surface, centroid, weights), surface.occlusion, weights);
    }
    var point = centroid;
    var sum = vec3f(0.0);
    var count = 0.0;
    var index = 0u;
    // Left at its end: software drivers run a loop's body to there, whatever is left to do.
    loop {
        var weight = 1.0;
        if pixel.is_sharp {
            point.normal = side * filters_normalize(n_center + filters_offset(pixel, index));
            let cosine = dot(point.normal, point.view);
            point.mu = filters_visible_mean(cosine, pixel.width);
            weight = select(0.0, 1.0, filters_covers(samples, index) && cosine > 0.0);
        }
        sum += weight * shading_reflected(shading_receiver(surface, point, weights), surface.occlusion, weights);
        count += weight;
        continuing {
            index++;
            break if !pixel.is_sharp || index == 4u;
        }
    }
    return sum / max(count, 1.0);
}
