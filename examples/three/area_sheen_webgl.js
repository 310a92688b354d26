// SPDX-License-Identifier: MIT OR Apache-2.0 OR 0BSD
// For WebGLRenderer: mesh.material = areaSheen(mesh.material) lights it by RectAreaLights with sheen, GGX and diffuse in closed form.

import { ShaderChunk } from 'three';
import { RectAreaLightUniformsLib } from 'three/addons/lights/RectAreaLightUniformsLib.js';
import { table, text } from './tables.js';

// three binds these where there are area lights; its own clearcoat reads them.
RectAreaLightUniformsLib.init();

const [ltc, sheenLobe, ggxLobe, sheenTable, ggxTable] = await Promise.all([
    text('shaders/glsl/ltc.glsl'), text('shaders/glsl/sheen.glsl'), text('shaders/glsl/ggx.glsl'),
    table('tables/sheen_ltc.dds'), table('tables/ggx_ltc.dds'),
]);
const tables = { areaSheenTable: { value: sheenTable }, areaGgxTable: { value: ggxTable } };

const AREA = `
uniform sampler2D areaSheenTable;
uniform sampler2D areaGgxTable;

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

// The base under its layers as in glTF. The roughness is as the material has it: three widens its own by how normals vary over a pixel, for
// lights that are points.
void area_begin(vec3 normal, vec3 view, PhysicalMaterial material, float roughness) {
    float mu = max(dot(normal, view), 0.0);
    GgxLobe ggx = ggx_lobe(areaGgxTable, roughness, mu);
    vec3 f90 = vec3(material.specularF90);
    vec3 specular = ggx_albedo(ggx, material.specularColorBlended, f90);
    vec3 diffuse = ggx_base_weight(ggx_albedo(ggx, min(material.specularColor, f90), f90)) * material.diffuseContribution;
    #ifdef USE_SHEEN
        SheenLobe sheen = sheen_lobe(areaSheenTable, material.sheenRoughness, mu);
        float base = max(sheen_base_weight(material.sheenColor, sheen.albedo), 0.0);
        vec3 sheenAlbedo = sheen.albedo * material.sheenColor;
    #else
        SheenLobe sheen = SheenLobe(mat3(0.0), 0.0);
        float base = 1.0;
        vec3 sheenAlbedo = vec3(0.0);
    #endif
    areaSurface = AreaSurface(ltc_frame(normal, view), ggx.m_inv, sheen.m_inv, base * diffuse, base * specular, sheenAlbedo);
}

AreaWalk area_walk(vec3 corner, AreaWalk before) {
    LtcOutline outline = ltc_next(before.outline, corner);
    return AreaWalk(
        outline, before.diffuse + ltc_edge(outline, AREA_DIFFUSE), before.ggx + ltc_edge(outline, areaSurface.ggx),
        before.sheen + ltc_edge(outline, areaSurface.sheen), ltc_turn(before.turn, outline, AREA_DIFFUSE),
        ltc_turn(before.ggxTurn, outline, areaSurface.ggx)
    );
}

#if NUM_RECT_AREA_LIGHTS > 0

// All lobes from one walk round the rectangle, which shines to where halfHeight x halfWidth points.
void RE_Direct_RectArea_Velour(
    RectAreaLight light, vec3 position, vec3 normal, vec3 view, vec3 clearcoatNormal, PhysicalMaterial material, inout ReflectedLight reflected
) {
    mat3 frame = areaSurface.frame;
    vec3 toCenter = light.position - position;
    vec3 last = frame * (toCenter + light.halfWidth + light.halfHeight);
    AreaWalk walk = AreaWalk(ltc_begin(last), 0.0, 0.0, 0.0, LTC_LEVEL, LTC_LEVEL);
    walk = area_walk(frame * (toCenter + light.halfWidth - light.halfHeight), walk);
    walk = area_walk(frame * (toCenter - light.halfWidth - light.halfHeight), walk);
    walk = area_walk(frame * (toCenter - light.halfWidth + light.halfHeight), walk);
    walk = area_walk(last, walk);
    float side = ltc_side(normalize(cross(light.halfHeight, light.halfWidth)), toCenter, false);
    reflected.directDiffuse += light.color * areaSurface.diffuseAlbedo * ltc_form_factor(walk.diffuse, walk.turn, AREA_DIFFUSE, side);
    reflected.directSpecular += light.color * areaSurface.ggxAlbedo * ltc_form_factor(walk.ggx, walk.ggxTurn, areaSurface.ggx, side);
    #ifdef USE_SHEEN
        sheenSpecularDirect += light.color * areaSurface.sheenAlbedo * ltc_form_factor(walk.sheen, walk.turn, areaSurface.sheen, side);
    #endif
    #ifdef USE_CLEARCOAT
        // three's own, of which nothing but the coat is kept.
        ReflectedLight unused = ReflectedLight(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
        RE_Direct_RectArea_Physical(light, position, normal, view, clearcoatNormal, material, unused);
    #endif
}

#undef RE_Direct_RectArea
#define RE_Direct_RectArea RE_Direct_RectArea_Velour

#endif
`;

const PARS = '#include <lights_physical_pars_fragment>';
const LIGHTS = '#include <lights_fragment_begin>';
const BEGIN = 'area_begin(normal, isOrthographic ? vec3(0.0, 0.0, 1.0) : normalize(vViewPosition), material, roughnessFactor);';

// At a multisampled edge the middle of the pixel may lie off the triangle, where normals and positions could be anything.
function withCentroids(source) {
    return source
        .replace(/#include <(normal_pars_(vertex|fragment))>/, (_, chunk) => ShaderChunk[chunk])
        .replace(/varying vec3 (vNormal|vViewPosition);/g, 'centroid varying vec3 $1;');
}

// A material like this MeshStandard- or MeshPhysicalMaterial.
export function areaSheen(material) {
    const area = material.clone();
    area.onBeforeCompile = (shader, renderer) => {
        material.onBeforeCompile(shader, renderer);
        Object.assign(shader.uniforms, tables);
        shader.vertexShader = withCentroids(shader.vertexShader);
        shader.fragmentShader = withCentroids(shader.fragmentShader)
            .replace(PARS, [PARS, ltc, sheenLobe, ggxLobe, AREA].join('\n'))
            .replace(LIGHTS, `${BEGIN}\n${LIGHTS}`);
    };
    area.customProgramCacheKey = () => `area sheen ${material.customProgramCacheKey()}`;
    return area;
}
