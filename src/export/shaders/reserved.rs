//! Words that mean something in the languages: a file that uses one as a name is not translated.
//!
//! Only words of small letters without digits: names with capital letters begin with their file's stem.

use super::refusal::Refusal;

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

/// Refuses a name that is such a word, or that languages keep for themselves.
pub(super) fn check(name: &str, line: usize) -> Result<(), Refusal> {
    if is_reserved(name) || name.starts_with("gl_") || name.contains("__") {
        return Err(Refusal::new(line, format!("the name {name}, which means something in another language")));
    }
    Ok(())
}

/// Names of types and functions with digits or capitals, of those that translations use.
const WITH_DIGITS_OR_CAPITALS: &str = "
    atan2 exp2 log2 inverseSqrt texelFetch textureSize textureLoad textureDimensions floatBitsToInt floatBitsToUint
    intBitsToFloat uintBitsToFloat lessThan lessThanEqual greaterThan greaterThanEqual notEqual sampler2D texture2D
    texture2d Texture2D f32 i32 u32";

/// Whether a name is such a word, in any of the languages: files are carried over to all of them.
pub fn is_reserved(name: &str) -> bool {
    let words = [GLSL, HLSL, MSL, WITH_DIGITS_OR_CAPITALS].into_iter().flat_map(str::split_whitespace);
    words.into_iter().any(|word| word == name) || is_sized(name)
}

/// Whether it is a vector's or a matrix's type: a word, a digit, and perhaps another one behind an x.
fn is_sized(name: &str) -> bool {
    const WORDS: [&str; 14] = [
        "vec",
        "bvec",
        "ivec",
        "uvec",
        "dvec",
        "mat",
        "dmat",
        "bool",
        "int",
        "uint",
        "float",
        "half",
        "double",
        "min16float",
    ];
    let is_size = |text: &str| matches!(text, "1" | "2" | "3" | "4");
    WORDS.iter().filter_map(|word| name.strip_prefix(word)).any(|sizes| match sizes.split_once('x') {
        Some((columns, rows)) => is_size(columns) && is_size(rows.trim_end_matches(['f', 'h'])),
        None => is_size(sizes.trim_end_matches(['f', 'h', 'i', 'u'])),
    })
}
