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
    // The luminance that the group brings.
    total: f32,
}

// Filled while the point's lights are summed.
var<private> picks_kept: array<PicksKept, PICKS_RAYS>;
var<private> picks_offered: u32;

// Of Rec. 709.
fn picks_luminance(color: vec3f) -> f32 {
    return dot(color, vec3f(0.2126, 0.7152, 0.0722));
}

// The luminance that the lobes scatter of a light, each for a form factor of 1.
fn picks_per_form_factor(receiver: Receiver, radiance: vec3f, base_weight: f32) -> LobesScalars {
    var worths: LobesScalars;
    worths.diffuse = picks_luminance(receiver.colors.diffuse * radiance) * base_weight;
    worths.specular = picks_luminance(receiver.colors.specular * radiance) * base_weight;
    worths.sheen = picks_luminance(receiver.colors.sheen * radiance);
    return worths;
}

fn picks_offer(receiver: Receiver, light: u32, radiance: vec3f, base_weight: f32, form_factors: LobesScalars) {
    var worths = picks_per_form_factor(receiver, radiance, base_weight);
    worths.diffuse *= form_factors.diffuse;
    worths.specular *= form_factors.specular;
    worths.sheen *= form_factors.sheen;
    let worth = picks_worth(worths);
    if worth > 0.0 {
        let group = picks_offered % PICKS_RAYS;
        let total = picks_kept[group].total + worth;
        picks_kept[group].total = total;
        if picks_offered < PICKS_RAYS || randoms_one(randoms_of(receiver.seed, light), receiver.sample) * total < worth {
            picks_kept[group] = PicksKept(light, worths, base_weight, total);
        }
        picks_offered++;
    }
}

fn picks_worth(worths: LobesScalars) -> f32 {
    return worths.diffuse + worths.specular + worths.sheen;
}
