// Which lights get a ray: all of them as long as they are no more than PICKS_RAYS; of more, that many, by what they bring.
//
// Lights are dealt out to as many groups in turn, and of each group one is kept, with a probability in proportion to the luminance that it
// brings (Chao 1982): what it stands for is the group's whole.

// Rays of a point and sample.
const PICKS_RAYS = 4u;

struct PicksKept {
    // The polygon's number; lights without extent count on from there.
    light: u32,
    // The luminance that it brings in each lobe, and what the sheen leaves of the base under it.
    worths: LobesScalars,
    base_weight: f32,
    // Of its radiance, where there are patterns.
    factors: LobesColors,
    // The luminance that the group brings.
    total: f32,
}

// Lobes are picked by this share of what they would bring of an even light, and for the rest by what they see of its pattern, so that none is
// left out that sees more of it than it seems to.
const PICKS_EVEN = 0.25;

// Filled while the point's lights are summed.
var<private> picks_kept: array<PicksKept, PICKS_RAYS>;
var<private> picks_offered: u32;

// Of Rec. 709.
fn picks_luminance(color: vec3f) -> f32 {
    return dot(color, vec3f(0.2126, 0.7152, 0.0722));
}

// The luminance that the lobes scatter of a light, or about that, each for a form factor of 1.
fn picks_per_form_factor(receiver: Receiver, radiance: vec3f, factors: LobesColors, base_weight: f32) -> LobesScalars {
    var worths: LobesScalars;
    worths.diffuse = picks_luminance(receiver.colors.diffuse * picks_seen(radiance, factors.diffuse)) * base_weight;
    worths.specular = picks_luminance(receiver.colors.specular * picks_seen(radiance, factors.specular)) * base_weight;
    worths.sheen = picks_luminance(receiver.colors.sheen * picks_seen(radiance, factors.sheen));
    return worths;
}

fn picks_seen(radiance: vec3f, factor: vec3f) -> vec3f {
    if !VARIANT_PATTERNS {
        return radiance;
    }
    return mix(factor, vec3f(1.0), PICKS_EVEN) * radiance;
}

// The factors of a kept light's radiance.
fn picks_factors(pick: PicksKept) -> LobesColors {
    if !VARIANT_PATTERNS {
        return PATTERNS_PLAIN;
    }
    return pick.factors;
}

fn picks_offer(
    receiver: Receiver, light: u32, radiance: vec3f, base_weight: f32, form_factors: LobesScalars, factors: LobesColors,
) {
    var worths = picks_per_form_factor(receiver, radiance, factors, base_weight);
    worths.diffuse *= form_factors.diffuse;
    worths.specular *= form_factors.specular;
    worths.sheen *= form_factors.sheen;
    let worth = picks_worth(worths);
    if worth > 0.0 {
        let group = picks_offered % PICKS_RAYS;
        let total = picks_kept[group].total + worth;
        picks_kept[group].total = total;
        if picks_offered < PICKS_RAYS || randoms_one(randoms_of(receiver.seed, light), receiver.sample) * total < worth {
            picks_kept[group].light = light;
            picks_kept[group].worths = worths;
            picks_kept[group].base_weight = base_weight;
            if VARIANT_PATTERNS {
                picks_kept[group].factors = factors;
            }
        }
        picks_offered++;
    }
}

fn picks_worth(worths: LobesScalars) -> f32 {
    return worths.diffuse + worths.specular + worths.sheen;
}
