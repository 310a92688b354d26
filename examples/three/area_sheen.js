// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// For WebGPURenderer: mesh.material = areaSheen(mesh.material) lights it by RectAreaLights with sheen, GGX and diffuse in closed form.

import { InterpolationSamplingMode, InterpolationSamplingType } from 'three';
import { MeshPhysicalNodeMaterial, PhysicalLightingModel, RectAreaLightNode } from 'three/webgpu';
import {
    diffuseContribution, float, materialRoughness, normalView, positionView, positionViewDirection, sheen, sheenRoughness,
    specularColor, specularColorBlended, specularF90, texture, vec3, wgsl, wgslFn,
} from 'three/tsl';
import { RectAreaLightTexturesLib } from 'three/addons/lights/RectAreaLightTexturesLib.js';
import { table, text } from './tables.js';

// three's light nodes bind these; its own clearcoat reads them.
RectAreaLightNode.setLTC(RectAreaLightTexturesLib.init());

const [ltcFile, sheenFile, ggxFile, sheenTable, ggxTable] = await Promise.all([
    text('shaders/ltc.wgsl'), text('shaders/sheen.wgsl'), text('shaders/ggx.wgsl'),
    table('tables/sheen_ltc.dds'), table('tables/ggx_ltc.dds'),
]);
const [ltc, sheenLobe, ggxLobe] = [wgsl(ltcFile), wgsl(sheenFile), wgsl(ggxFile)];
const tables = { sheen_table: texture(sheenTable), ggx_table: texture(ggxTable) };

const areaFrame = wgslFn(`fn area_frame(normal: vec3f, view: vec3f) -> mat3x3f {
    return ltc_frame(normal, view);
}`, [ltc]);

const areaSheenMatrix = wgslFn(`fn area_sheen_matrix(sheen_table: texture_2d<f32>, alpha: f32, mu: f32) -> mat3x3f {
    return sheen_lobe(sheen_table, alpha, mu).m_inv;
}`, [sheenLobe]);

const areaGgxMatrix = wgslFn(`fn area_ggx_matrix(ggx_table: texture_2d<f32>, roughness: f32, mu: f32) -> mat3x3f {
    return ggx_lobe(ggx_table, roughness, mu).m_inv;
}`, [ggxLobe]);

// Columns: what the diffuse, the specular and the sheen lobe scatter of light that fills them, the base under its layers as in glTF.
const areaAlbedos = wgslFn(`fn area_albedos(
    sheen_table: texture_2d<f32>, ggx_table: texture_2d<f32>, alpha: f32, roughness: f32, mu: f32,
    sheen_color: vec3f, diffuse: vec3f, dielectric_f0: vec3f, f0: vec3f, f90: f32
) -> mat3x3f {
    let sheen = sheen_lobe(sheen_table, alpha, mu);
    let ggx = ggx_lobe(ggx_table, roughness, mu);
    let base = max(sheen_base_weight(sheen_color, sheen.albedo), 0.0);
    let below = ggx_base_weight(ggx_albedo(ggx, min(dielectric_f0, vec3f(f90)), vec3f(f90)));
    return mat3x3f(base * below * diffuse, base * ggx_albedo(ggx, f0, vec3f(f90)), sheen.albedo * sheen_color);
}`, [sheenLobe, ggxLobe]);

const areaWalk = wgsl(`
const AREA_DIFFUSE = mat3x3f(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);

struct AreaWalk {
    outline: LtcOutline,
    diffuse: f32,
    ggx: f32,
    sheen: f32,
    turn: vec2f,  // along the horizon, of the diffuse lobe and of the sheen
    ggx_turn: vec2f,
}

fn area_walk(corner: vec3f, before: AreaWalk, ggx: mat3x3f, sheen: mat3x3f) -> AreaWalk {
    let outline = ltc_next(before.outline, corner);
    return AreaWalk(
        outline, before.diffuse + ltc_edge(outline, AREA_DIFFUSE), before.ggx + ltc_edge(outline, ggx),
        before.sheen + ltc_edge(outline, sheen), ltc_turn(before.turn, outline, AREA_DIFFUSE),
        ltc_turn(before.ggx_turn, outline, ggx),
    );
}
`, [ltc]);

// Of the diffuse, the specular and the sheen lobe, from one walk round the rectangle, which shines to where half_height x half_width points.
const areaFormFactors = wgslFn(`fn area_form_factors(
    to_center: vec3f, half_width: vec3f, half_height: vec3f, frame: mat3x3f, ggx: mat3x3f, sheen: mat3x3f
) -> vec3f {
    let last = frame * (to_center + half_width + half_height);
    var walk = AreaWalk(ltc_begin(last), 0.0, 0.0, 0.0, LTC_LEVEL, LTC_LEVEL);
    walk = area_walk(frame * (to_center + half_width - half_height), walk, ggx, sheen);
    walk = area_walk(frame * (to_center - half_width - half_height), walk, ggx, sheen);
    walk = area_walk(frame * (to_center - half_width + half_height), walk, ggx, sheen);
    walk = area_walk(last, walk, ggx, sheen);
    let side = ltc_side(normalize(cross(half_height, half_width)), to_center, false);
    return vec3f(
        ltc_form_factor(walk.diffuse, walk.turn, AREA_DIFFUSE, side), ltc_form_factor(walk.ggx, walk.ggx_turn, ggx, side),
        ltc_form_factor(walk.sheen, walk.turn, sheen, side),
    );
}`, [ltc, areaWalk]);

class AreaLightingModel extends PhysicalLightingModel {
    // What all lights share; three walks through them from its own start.
    start(builder) {
        const { roughnessNode } = builder.material;
        // As it is: three widens roughness by how normals vary over a pixel, for lights that are points.
        const roughness = roughnessNode ? float(roughnessNode) : materialRoughness;
        const [alpha, sheenColor] = this.sheen ? [sheenRoughness, sheen] : [float(0), vec3(0)];
        const mu = normalView.dot(positionViewDirection).max(0).toVar();
        this.frame = areaFrame({ normal: normalView, view: positionViewDirection }).toVar();
        this.sheenMatrix = areaSheenMatrix({ ...tables, alpha, mu }).toVar();
        this.ggxMatrix = areaGgxMatrix({ ...tables, roughness, mu }).toVar();
        this.albedos = areaAlbedos({
            ...tables, alpha, roughness, mu, sheen_color: sheenColor, diffuse: diffuseContribution,
            dielectric_f0: specularColor, f0: specularColorBlended, f90: specularF90,
        }).toVar();
        super.start(builder);
    }

    // At a multisampled edge the middle of the pixel may lie off the triangle, where normals and positions could be anything.
    finish(builder) {
        super.finish(builder);
        for (const varying of builder.varyings.filter(({ name }) => /^v_(normal|position)View/.test(name))) {
            varying.interpolationType = InterpolationSamplingType.PERSPECTIVE;
            varying.interpolationSampling = InterpolationSamplingMode.CENTROID;
        }
    }

    directRectArea(light, builder) {
        const { lightColor, lightPosition, halfWidth, halfHeight, reflectedLight } = light;
        const formFactors = areaFormFactors({
            to_center: lightPosition.sub(positionView), half_width: halfWidth, half_height: halfHeight,
            frame: this.frame, ggx: this.ggxMatrix, sheen: this.sheenMatrix,
        }).toVar();
        const scattered = (lobe, share) => lightColor.mul(this.albedos.element(lobe), share);
        reflectedLight.directDiffuse.addAssign(scattered(0, formFactors.x));
        reflectedLight.directSpecular.addAssign(scattered(1, formFactors.y));
        if (this.sheen) this.sheenSpecularDirect.addAssign(scattered(2, formFactors.z));
        if (this.clearcoat) {
            // three's own, of which nothing but the coat is kept.
            const unused = { directDiffuse: vec3().toVar(), directSpecular: vec3().toVar() };
            super.directRectArea({ ...light, reflectedLight: unused }, builder);
        }
    }
}

export class AreaSheenNodeMaterial extends MeshPhysicalNodeMaterial {
    static get type() {
        return 'AreaSheenNodeMaterial';
    }

    setupLightingModel() {
        return new AreaLightingModel(
            this.useClearcoat, this.useSheen, this.useIridescence, this.useAnisotropy, this.useTransmission, this.useDispersion,
            this.useRetroreflection, this.useDiffuseRoughness,
        );
    }
}

// A material like this MeshStandard- or MeshPhysical(Node)Material.
export function areaSheen(material) {
    const area = new AreaSheenNodeMaterial();
    for (const key in material) {
        if (key !== 'uuid') area[key] = material[key];
    }
    return area;
}
