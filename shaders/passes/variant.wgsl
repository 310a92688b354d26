// What a pipeline of the surfaces' pass is made for. Whatever a variant does not need is compiled away.

// What a material has.
override VARIANT_SHEEN: bool = true;
override VARIANT_SPECULAR: bool = true;
override VARIANT_RECIPROCAL: bool = true;
override VARIANT_UNLIT: bool = false;
override VARIANT_MASK: bool = false;
override VARIANT_BLEND: bool = false;
// 0: the sheen is the transformed cosine of sheen.wgsl; otherwise prior work's of that number (prior_sheens.wgsl).
override VARIANT_SHEEN_MODEL: u32 = 0;
override VARIANT_PRIOR_SHEEN: bool = VARIANT_SHEEN_MODEL != 0u;
// Which textures count: bit k is slot k's (scene::TextureSlot), and bit 2 the normal map's.
override VARIANT_TEXTURES: u32 = 0;
override VARIANT_NORMAL_MAP: bool = (VARIANT_TEXTURES & 4u) != 0u;

// Which kinds of lights there are: some drivers run a loop's body once even where there is nothing to loop over.
override VARIANT_QUADS: bool = true;
override VARIANT_POLYGONS: bool = true;
override VARIANT_PUNCTUAL: bool = true;
// Some polygons are textured.
override VARIANT_PATTERNS: bool = true;

// The specular lobe may be narrower than what normals vary over a pixel, which is then shaded sample by sample.
override VARIANT_SHARP: bool = true;
// Lights that reach a point are picked, for rays towards them.
override VARIANT_SHADOWED: bool = true;
// Some of what stands in the way of light lets light through.
override VARIANT_OPACITIES: bool = true;
// What is cut out covers some of a pixel's four samples; otherwise all of the one that there is or nothing.
override VARIANT_DITHERED: bool = true;
// Shading is filtered over the pixel; otherwise it is the value at the pixel's centre.
override VARIANT_FILTERED: bool = true;
