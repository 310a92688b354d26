// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// SPDX-FileCopyrightText: 2026 The Velour authors
// Path tracing with lobes that are transformed cosines: ltc_sample draws directions of the density that ltc_density gives. One sample a pixel a run.
// Put together with shaders/ltc.wgsl, sheen.wgsl and ggx.wgsl as they are, and rays.wgsl: names that begin with these words are theirs.

struct Frame {
    world_from_camera: mat4x4f,
    size: vec2u,
    sample: u32,
    seed: u32,
    max_bounces: u32,
    // Of half the picture's height, at depth 1.
    extent: f32,
    near: f32,
    far: f32,
    // How far off a surface rays start, metres.
    apart: f32,
    // Over all lights, area times greatest channel.
    light_total: f32,
}
// A triangle that shines; the share of samples up to it, itself included.
struct Light { triangle: u32, share: f32 }

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(4) var<storage, read> lights: array<Light>;
@group(0) @binding(5) var sheen_table: texture_2d<f32>;
@group(0) @binding(6) var ggx_table: texture_2d<f32>;
@group(0) @binding(7) var<storage, read_write> film: array<vec4f>;

const FARTHEST = 1e30;

// A transformed cosine of unit integral, times a colour, which is its albedo.
struct Lobe { m_inv: mat3x3f, color: vec3f }
struct Lobes { diffuse: Lobe, specular: Lobe, sheen: Lobe, shares: vec3f }
// The lobes' BRDF times the cosine, and the density with which their sample goes there.
struct Scattered { value: vec3f, pdf: f32 }

var<private> draws: u32;

// Four uniform numbers in [0, 1), other ones on each call: pcg4d (Jarzynski and Olano 2020, "Hash Functions for GPU Rendering").
fn random(pixel: u32) -> vec4f {
    var v = vec4u(pixel, frame.sample, draws, frame.seed) * 1664525u + 1013904223u;
    draws++;
    v.x += v.y * v.w; v.y += v.z * v.x; v.z += v.x * v.y; v.w += v.y * v.z;
    v ^= v >> vec4u(16u);
    v.x += v.y * v.w; v.y += v.z * v.x; v.z += v.x * v.y; v.w += v.y * v.z;
    return vec4f(v >> vec4u(8u)) / 16777216.0;
}

fn greatest(color: vec3f) -> f32 {
    return max(color.r, max(color.g, color.b));
}

// The layers from the top: sheen, specular, diffuse; each weakens those below by what it sends back (KHR_materials_sheen).
fn lobes_at(surface: Surface, mu: f32) -> Lobes {
    let sheen = sheen_lobe(sheen_table, surface.sheen_alpha, mu);
    let ggx = ggx_lobe(ggx_table, surface.roughness, mu);
    let below_sheen = sheen_base_weight(surface.sheen_color, sheen.albedo);
    let f0 = mix(surface.f0, surface.base_color, surface.metallic);
    let specular = ggx_albedo(ggx, f0, vec3f(mix(surface.f90, 1.0, surface.metallic)));
    let below_specular = ggx_base_weight(ggx_albedo(ggx, surface.f0, vec3f(surface.f90)));
    let diffuse = (1.0 - surface.metallic) * below_specular * surface.base_color;
    let has_sheen = select(0.0, 1.0, sheen.m_inv[0].x > 0.0);
    var lobes: Lobes;
    lobes.diffuse = Lobe(mat3x3f(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0), below_sheen * diffuse);
    lobes.specular = Lobe(ggx.m_inv, below_sheen * specular);
    lobes.sheen = Lobe(sheen.m_inv, has_sheen * sheen.albedo * surface.sheen_color);
    let albedos = vec3f(greatest(lobes.diffuse.color), greatest(lobes.specular.color), greatest(lobes.sheen.color));
    lobes.shares = albedos / max(albedos.x + albedos.y + albedos.z, 1e-30);
    return lobes;
}

fn lobes_scattered(lobes: Lobes, wo: vec3f) -> Scattered {
    let diffuse = ltc_density(lobes.diffuse.m_inv, wo);
    let specular = ltc_density(lobes.specular.m_inv, wo);
    let sheen = ltc_density(lobes.sheen.m_inv, wo);
    let value = lobes.diffuse.color * diffuse + lobes.specular.color * specular + lobes.sheen.color * sheen;
    return Scattered(value, dot(lobes.shares, vec3f(diffuse, specular, sheen)));
}

// A direction in one of the lobes, chosen by its albedo.
fn lobes_sample(lobes: Lobes, choice: f32, uniforms: vec2f) -> vec3f {
    if choice < lobes.shares.x {
        return ltc_sample(lobes.diffuse.m_inv, uniforms);
    }
    if choice < lobes.shares.x + lobes.shares.y {
        return ltc_sample(lobes.specular.m_inv, uniforms);
    }
    return ltc_sample(lobes.sheen.m_inv, uniforms);
}

// The density, per steradian, with which sampling the lights finds a point of one.
fn light_pdf(emission: vec3f, distance: f32, cosine: f32) -> f32 {
    return greatest(emission) / frame.light_total * distance * distance / max(cosine, 1e-10);
}

// Direct light by a point of a light, as the lobes scatter it. Density over a light's area is proportional to its radiance.
fn light_sampled(point: Point, lobes: Lobes, uniforms: vec3f) -> vec3f {
    var index = 0u;
    // The first light whose share is above: by bisection.
    var last = arrayLength(&lights) - 1u;
    while index < last {
        let middle = (index + last) / 2u;
        let above = lights[middle].share > uniforms.x;
        last = select(last, middle, above);
        index = select(middle + 1u, index, above);
    }
    let t = triangles[lights[index].triangle];
    let root = sqrt(uniforms.y);
    let weights = vec3f(1.0 - root, root * (1.0 - uniforms.z), root * uniforms.z);
    let position = weights.x * t.a.position + weights.y * t.b.position + weights.z * t.c.position;
    let distance = length(position - point.origin);
    let direction = (position - point.origin) / max(distance, 1e-20);
    let normal = triangle_normal(t);
    let surface = surfaces[t.a.surface];
    let cosine = -dot(normal, direction);
    if cosine == 0.0 || (cosine < 0.0 && surface.double_sided == 0u) {
        return vec3f(0.0);
    }
    let scattered = lobes_scattered(lobes, point.local_from_world * direction);
    if greatest(scattered.value) <= 0.0 {
        return vec3f(0.0);
    }
    // Up to just in front of the light.
    if rays_nearest(leaving(point, direction), 0.0, distance * (1.0 - 1e-4), false, true).triangle != NONE {
        return vec3f(0.0);
    }
    // The balance heuristic (Veach and Guibas 1995): value / pdf, times pdf / (pdf + scattered.pdf).
    let pdf = light_pdf(surface.emission, distance, abs(cosine));
    return scattered.value * surface.emission / (pdf + scattered.pdf);
}

// What comes to the eye along a ray. A path meets max_bounces surfaces between a light and the surface that is seen.
fn radiance(first: Ray, near: f32, far: f32, pixel: u32) -> vec3f {
    var ray = first;
    var hit = rays_nearest(ray, near, far, true, false);
    if hit.triangle == NONE {
        return vec3f(0.0);
    }
    var surface = surfaces[triangles[hit.triangle].a.surface];
    var sum = surface.emission;
    var throughput = vec3f(1.0);
    for (var bounce = 0u; bounce <= frame.max_bounces; bounce++) {
        let point = point_at(hit, -ray.direction);
        let lobes = lobes_at(surface, point.mu);
        sum += throughput * light_sampled(point, lobes, random(pixel).xyz);
        let uniforms = random(pixel);
        let wo = lobes_sample(lobes, uniforms.x, uniforms.yz);
        let scattered = lobes_scattered(lobes, wo);
        if !(scattered.pdf > 0.0) {
            break;
        }
        throughput *= scattered.value / scattered.pdf;
        ray = leaving(point, wo * point.local_from_world);
        hit = rays_nearest(ray, 0.0, FARTHEST, false, false);
        if hit.triangle == NONE {
            break;
        }
        surface = surfaces[triangles[hit.triangle].a.surface];
        // The backs of one-sided surfaces are black.
        if !hit.front && surface.double_sided == 0u {
            break;
        }
        let cosine = abs(dot(triangle_normal(triangles[hit.triangle]), ray.direction));
        sum += throughput * surface.emission * scattered.pdf / (scattered.pdf + light_pdf(surface.emission, hit.distance, cosine));
        // Paths of little throughput are ended at random, and count for more where they are not.
        let survival = min(10.0 * greatest(throughput), 1.0);
        if uniforms.w >= survival {
            break;
        }
        throughput /= survival;
    }
    return sum;
}

@compute @workgroup_size(8, 8)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= frame.size) {
        return;
    }
    let pixel = id.y * frame.size.x + id.x;
    let size = vec2f(frame.size);
    let at = vec2f(id.xy) + random(pixel).xy;
    let toward = vec3f(frame.extent * vec2f(2.0 * at.x - size.x, size.y - 2.0 * at.y) / size.y, -1.0);
    let direction = (frame.world_from_camera * vec4f(toward, 0.0)).xyz;
    let ray = Ray(frame.world_from_camera[3].xyz, normalize(direction));
    // The camera's planes are depths.
    let stretch = length(direction);
    film[pixel] += vec4f(radiance(ray, frame.near * stretch, frame.far * stretch, pixel), 1.0);
}
