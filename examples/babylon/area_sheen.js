// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// For WebGL 2: areaSheen(material) lights a PBRMaterial by RectAreaLights with sheen, GGX and diffuse in closed form.

import { MaterialPluginBase } from '@babylonjs/core/Materials/materialPluginBase.js';
import { RawTexture } from '@babylonjs/core/Materials/Textures/rawTexture.js';
import { Constants } from '@babylonjs/core/Engines/constants.js';

// Where the files of the repository are: change it to where your copies lie.
const REPOSITORY = new URL('../../', import.meta.url);

async function fetched(path) {
    const url = new URL(path, REPOSITORY);
    const response = await fetch(url);
    if (!response.ok) throw new Error(`${url}: ${response.status}; REPOSITORY in area_sheen.js says where files are looked for`);
    return response;
}

const [ltc, sheenLobe, ggxLobe, sheenBytes, ggxBytes] = await Promise.all([
    ...['ltc', 'sheen', 'ggx'].map(async (name) => (await fetched(`shaders/glsl/${name}.glsl`)).text()),
    ...['sheen', 'ggx'].map(async (name) => (await fetched(`tables/${name}_ltc.dds`)).arrayBuffer()),
]);

// A table of half floats, RGBA, behind a DX10 header of 148 bytes. Shaders read its texels one by one, with weights of their own.
function table(bytes, scene) {
    const header = new DataView(bytes);
    const [height, width] = [header.getUint32(12, true), header.getUint32(16, true)];
    return new RawTexture(
        new Uint16Array(bytes, 148), width, height, Constants.TEXTUREFORMAT_RGBA, scene, false, false,
        Constants.TEXTURE_NEAREST_SAMPLINGMODE, Constants.TEXTURETYPE_HALF_FLOAT,
    );
}

const tables = new WeakMap();

function tablesOf(scene) {
    if (!tables.has(scene)) tables.set(scene, { sheen: table(sheenBytes, scene), ggx: table(ggxBytes, scene) });
    return tables.get(scene);
}

// Without comments: Babylon breaks lines at semicolons, in comments too.
const DEFINITIONS = `
precision highp sampler2D;
uniform sampler2D areaSheenTable;
uniform sampler2D areaGgxTable;
${ltc}
${sheenLobe}
${ggxLobe}
// Of a fragment, the same for all lights: the frame, the lobes, and what each scatters of light that fills it.
struct AreaSurface {
    mat3 frame, ggx, sheen;
    vec3 diffuseAlbedo, ggxAlbedo, sheenAlbedo;
};

struct AreaWalk {
    LtcOutline outline;
    float diffuse, ggx, sheen;
    vec2 turn;  // along the horizon, of the diffuse lobe and of the sheen
    vec2 ggxTurn;
};

const mat3 AREA_DIFFUSE = mat3(1.0);

AreaSurface areaSurface;
vec3 areaRadiance = vec3(0.0);

// The base under its layers as in glTF.
void area_begin(
    vec3 normal, vec3 view, vec3 diffuse, vec3 dielectricF0, vec3 f0, vec3 f90, float roughness, vec3 sheenColor, float alpha
) {
    float mu = max(dot(normal, view), 0.0);
    GgxLobe ggx = ggx_lobe(areaGgxTable, roughness, mu);
    SheenLobe sheen = sheen_lobe(areaSheenTable, alpha, mu);
    float base = max(sheen_base_weight(sheenColor, sheen.albedo), 0.0);
    float below = ggx_base_weight(ggx_albedo(ggx, min(dielectricF0, f90), f90));
    areaSurface = AreaSurface(
        ltc_frame(normal, view), ggx.m_inv, sheen.m_inv, base * below * diffuse, base * ggx_albedo(ggx, f0, f90), sheen.albedo * sheenColor
    );
}

AreaWalk area_walk(vec3 corner, AreaWalk before) {
    LtcOutline outline = ltc_next(before.outline, corner);
    return AreaWalk(
        outline, before.diffuse + ltc_edge(outline, AREA_DIFFUSE), before.ggx + ltc_edge(outline, areaSurface.ggx),
        before.sheen + ltc_edge(outline, areaSurface.sheen), ltc_turn(before.turn, outline, AREA_DIFFUSE),
        ltc_turn(before.ggxTurn, outline, areaSurface.ggx)
    );
}

// All lobes from one walk round the rectangle, which shines to where halfHeight x halfWidth points.
void area_add(vec3 toCenter, vec3 halfWidth, vec3 halfHeight, vec3 light) {
    mat3 frame = areaSurface.frame;
    vec3 last = frame * (toCenter + halfWidth + halfHeight);
    AreaWalk walk = AreaWalk(ltc_begin(last), 0.0, 0.0, 0.0, LTC_LEVEL, LTC_LEVEL);
    walk = area_walk(frame * (toCenter + halfWidth - halfHeight), walk);
    walk = area_walk(frame * (toCenter - halfWidth - halfHeight), walk);
    walk = area_walk(frame * (toCenter - halfWidth + halfHeight), walk);
    walk = area_walk(last, walk);
    float side = ltc_side(normalize(cross(halfHeight, halfWidth)), toCenter, false);
    areaRadiance += light * (
        areaSurface.diffuseAlbedo * ltc_form_factor(walk.diffuse, walk.turn, AREA_DIFFUSE, side)
        + areaSurface.ggxAlbedo * ltc_form_factor(walk.ggx, walk.ggxTurn, areaSurface.ggx, side)
        + areaSurface.sheenAlbedo * ltc_form_factor(walk.sheen, walk.turn, areaSurface.sheen, side)
    );
}
`.replace(/\/\/.*/g, '');

const BEGIN = `
vec3 areaSheenColor = vec3(0.0);
float areaAlpha = 0.0;
#ifdef SHEEN
    areaSheenColor = sheenOut.sheenColor;
    areaAlpha = sheenOut.sheenRoughness;
#endif
area_begin(
    normalW, viewDirectionW, (1.0 - reflectivityOut.metallic) * baseColor, reflectivityOut.dielectricColorF0,
    reflectivityOut.colorReflectanceF0, reflectivityOut.colorReflectanceF90, roughness, areaSheenColor, areaAlpha
);
vec3 diffuseBase=vec3(0.,0.,0.);
`;

// In place of Babylon's own, of which nothing is left.
const ADD = `
area_add($1.vLightData.xyz - vPositionW, $1.vLightWidth.xyz, $1.vLightHeight.xyz, $1.vLightDiffuse.rgb);
preInfo.areaLightDiffuse = vec3(0.0);
#ifdef SPECULARTERM
    preInfo.areaLightSpecular = vec3(0.0);
    preInfo.areaLightFresnel = vec4(0.0);
#endif
`;

class AreaSheenPlugin extends MaterialPluginBase {
    constructor(material) {
        super(material, 'AreaSheen', 200, { AREASHEEN: false }, true, true);
    }

    getClassName() {
        return 'AreaSheenPlugin';
    }

    prepareDefines(defines) {
        defines.AREASHEEN = true;
    }

    getSamplers(samplers) {
        samplers.push('areaSheenTable', 'areaGgxTable');
    }

    bindForSubMesh(uniforms, scene) {
        const { sheen, ggx } = tablesOf(scene);
        uniforms.setTexture('areaSheenTable', sheen);
        uniforms.setTexture('areaGgxTable', ggx);
    }

    getCustomCode(shaderType) {
        if (shaderType !== 'fragment') return null;
        return {
            CUSTOM_FRAGMENT_DEFINITIONS: DEFINITIONS,
            '!vec3 diffuseBase=vec3\\(0\\.,0\\.,0\\.\\);': BEGIN,
            '!preInfo=computeAreaPreLightingInfo\\([^;]*?(light\\d+)\\.vLightData[^;]*;': ADD,
            CUSTOM_FRAGMENT_BEFORE_FOG: 'finalColor.rgb += areaRadiance;',
        };
    }
}

// The material, a PBRMaterial or one made from a glTF file, with its plugin.
export function areaSheen(material) {
    new AreaSheenPlugin(material);
    return material;
}
