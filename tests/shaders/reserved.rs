//! Words that mean something in other shading languages: people turn the shipped files into these, so that no name may
//! be one of them.
//!
//! Only words of small letters without digits: names with capital letters begin with their file's stem.

/// Keywords, reserved words (sections 3.6 and 3.7) and built-in functions (section 8) of GLSL 4.60 and GLSL ES 3.00.
const GLSL: &str = "
    active asm atomic_uint attribute bool break buffer case cast centroid class coherent common const continue
    default discard do double else enum extern external false filter fixed flat float for goto half highp if in
    inline inout input int interface invariant layout long lowp mediump namespace noinline noperspective out output
    packed partition patch precise precision public readonly resource restrict return row_major sample sampler shared
    short sizeof smooth static struct subroutine superp switch template this true typedef uint uniform union unsigned
    using varying void volatile while writeonly
    abs acos acosh all any asin asinh atan atanh barrier ceil clamp cos cosh cross degrees determinant distance dot
    equal exp faceforward floor fma fract frexp ftransform fwidth inverse inversesqrt isinf isnan ldexp length log
    main max min mix mod modf normalize not pow radians reflect refract round sign sin sinh smoothstep sqrt step tan
    tanh texture transpose trunc";

/// Of HLSL: Microsoft's pages of keywords, reserved words and intrinsic functions, and the keywords that later shader
/// models add.
const HLSL: &str = "
    asm asm_fragment auto bool break case catch cbuffer center centroid char class column_major compile
    compile_fragment const const_cast continue decl default delete discard do double dword dynamic_cast else enum
    explicit export extern false float for friend fxgroup globallycoherent goto groupshared half if in indices inline
    inout int interface line lineadj linear long matrix mutable namespace new nointerpolation noperspective operator
    out packoffset pass payload pixelfragment point precise primitives private protected public register
    reinterpret_cast return row_major sample sampler sampler_state shared short signed sizeof snorm stateblock
    stateblock_state static static_cast string struct switch tbuffer technique template texture this throw triangle
    triangleadj true try typedef typeid typename uint uniform union unorm unsigned using vector vertexfragment
    vertices virtual void volatile while abort abs acos all and any asdouble asfloat asin asint asuint atan ceil
    clamp clip cos cosh countbits cross ddx ddx_coarse ddx_fine ddy ddy_coarse ddy_fine degrees determinant distance
    dot dst errorf exp faceforward firstbithigh firstbitlow floor fma fmod frac frexp fwidth isfinite isinf isnan
    ldexp length lerp lit log mad max min modf mul noise normalize or pow printf radians rcp reflect refract
    reversebits round rsqrt saturate select sign sin sincos sinh smoothstep sqrt step tan tanh transpose trunc";

/// Of the Metal Shading Language: the keywords of C++14, types (section 2), address spaces (4), attributes of functions
/// and their arguments (5), and the functions (6) and options of samplers (2) in the namespace that everyone opens.
const MSL: &str = "
    alignas alignof and and_eq asm auto bitand bitor bool break case catch char class compl const const_cast
    constexpr continue decltype default delete do double dynamic_cast else enum explicit export extern false float
    for friend goto if inline int long mutable namespace new noexcept not not_eq nullptr operator or or_eq private
    protected public register reinterpret_cast return short signed sizeof static static_assert static_cast struct
    switch template this thread_local throw true try typedef typeid typename union unsigned using virtual void
    volatile wchar_t while xor xor_eq assert main restrict
    array array_ref atomic bfloat complex half imaginary matrix metal packed_vec ptrdiff_t quad sampler simd size_t
    texture uchar uint ulong ushort vec
    constant device fragment kernel object object_data mesh ray_data stage_in thread threadgroup
    threadgroup_imageblock vertex visible abs absdiff access acos acosh addsat address all any as_type asin asinh
    atan atanh bias ceil clamp clz compare_func component coord copysign cos cosh cospi cross ctz determinant dfdx
    dfdy discard_fragment distance distance_squared divide dot exp extract_bits fabs faceforward fdim filter floor
    fma fmax fmedian fmin fmod fract frexp fwidth hadd ilogb insert_bits isfinite isinf isnan isnormal isordered
    isunordered ldexp length length_squared level lod_clamp log madhi madsat max median min mip_filter mix modf mulhi
    nextafter normalize popcount pow powr read read_write reflect refract reverse_bits rhadd rint rotate round rsqrt
    sample saturate select sign signbit sin sincos sinh sinpi smoothstep sqrt step subsat tan tanh tanpi transpose
    trunc write";

/// What a source declares (functions, types, constants, variables, arguments, members) by a name that is such a word.
pub fn reserved(source: &str) -> Vec<&str> {
    let words: Vec<&str> = [GLSL, HLSL, MSL].into_iter().flat_map(str::split_whitespace).collect();
    declared(source).into_iter().filter(|name| words.contains(name)).collect()
}

/// What follows a word that declares, or is followed by its type.
fn declared(source: &str) -> Vec<&str> {
    const DECLARING: [&str; 7] = ["alias", "const", "fn", "let", "override", "struct", "var"];
    let is_part = |letter: char| letter.is_alphanumeric() || letter == '_';
    let (mut found, mut before) = (Vec::new(), "");
    for line in source.lines() {
        let mut rest = line.split("//").next().unwrap_or_default();
        while let Some(start) = rest.find(is_part) {
            let from_word = &rest[start..];
            let (word, after) =
                from_word.split_at(from_word.find(|letter| !is_part(letter)).unwrap_or(from_word.len()));
            // Not what stands in brackets, as of `var<private> name`.
            let is_declared = DECLARING.contains(&before) && rest[..start].trim().is_empty();
            let is_typed = after.trim_start().starts_with(':') && word != "default";
            if is_declared || is_typed {
                found.push(word);
            }
            (before, rest) = (word, after);
        }
    }
    found
}

#[test]
fn reserved_words_are_found_wherever_they_are_declared() {
    for (source, word) in [
        ("fn f(p: vec3f, vertex: vec3f) {}", "vertex"),
        ("fn f() {\n    let lit = 1.0;\n}", "lit"),
        ("fn f() {\n    for (var sample = 0u; sample < 4u; sample++) {}\n}", "sample"),
        ("fn f() { const half = 0.5; }", "half"),
        ("fn f() { var<function> kernel: f32; }", "kernel"),
        ("struct S {\n    point : vec3f,\n}", "point"),
        ("fn noise() {}", "noise"),
        ("fn f(p: array<f32, 4>,\n    // one\n    level: f32) {}", "level"),
    ] {
        assert_eq!(reserved(source), [word], "{source}");
    }
    let fine =
        "// let lit = vertex: f32\nfn f(corner: vec3f) -> f32 {\n    return sqrt(length(corner)); // default: point\n}";
    assert_eq!(reserved(fine), [""; 0]);
    assert_eq!(reserved("var<private> state: f32; fn f() { switch 1 { default: {} } }"), [""; 0]);
}
