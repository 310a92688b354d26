//! What the copied shaders cost on hardware that need not be there: instructions and registers, counted by the compiler of Mesa's driver for AMD
//! GPUs, which compiles for any of them on any machine. Prints tables; `cargo bench --bench costs`.
//!
//! Needs that driver (`scripts/setup` installs it where it installs Mesa's), and says so where it is not there. Unrolled walks are compiled, and what another edge, another light or
//! another lobe adds is the difference between two of them.

use std::path::Path;
use std::process::Command;

const DRIVER: &str = "/usr/share/vulkan/icd.d/radeon_icd.x86_64.json";
/// An AMD Radeon RX 6800.
const FAMILY: &str = "NAVI21";
/// Names a shader to the process that compiles it.
const KERNEL: &str = "VELOUR_KERNEL";

const BINDINGS: &str = "
@group(0) @binding(0) var<storage, read_write> results: array<vec4f>;
@group(0) @binding(1) var<storage, read> corners: array<vec4f>;
@group(0) @binding(2) var sheen_table: texture_2d<f32>;
@group(0) @binding(3) var ggx_table: texture_2d<f32>;
struct LightsRange { count: u32 }
fn lights_count(range: LightsRange) -> u32 { return range.count; }
fn lights_corners(range: LightsRange, light: u32) -> u32 { return 4u; }
fn lights_corner(range: LightsRange, light: u32, index: u32) -> vec3<f32> { return corners[4u * light + index].xyz; }
fn lights_normal(range: LightsRange, light: u32) -> vec3<f32> { return corners[4u * light].www; }
fn lights_radiance(range: LightsRange, light: u32) -> vec3<f32> { return corners[4u * light + 1u].www; }
fn lights_two_sided(range: LightsRange, light: u32) -> bool { return false; }
";

/// A walk along `edges` of each of `lights` lights, with the first `lobes` of diffuse, sheen and GGX.
fn walk(lights: usize, edges: usize, lobes: usize) -> String {
    const IDENTITY: &str = "mat3x3f(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)";
    let matrices = [IDENTITY, "sheen.m_inv", "specular.m_inv"];
    // Lobes of one width share the turn.
    let turns = [0, 0, 1];
    let mut text = "var sum = vec3f(0.0);\n".to_owned();
    for light in 0..lights {
        let corner = |k: usize| format!("frame * (corners[{}u].xyz - position)", light * edges + k);
        text += &format!("{{\nvar outline = ltc_begin({});\nvar sums = vec3f(0.0);\n", corner(edges - 1));
        text += "var turn0 = LTC_LEVEL;\nvar turn1 = LTC_LEVEL;\n";
        for edge in 0..edges {
            text += &format!("outline = ltc_next(outline, {});\n", corner(edge));
            for (lobe, matrix) in matrices.iter().enumerate().take(lobes) {
                text += &format!("sums[{lobe}] += ltc_edge(outline, {matrix});\n");
            }
            text += &format!("turn0 = ltc_turn(turn0, outline, {IDENTITY});\n");
            if lobes == 3 {
                text += "turn1 = ltc_turn(turn1, outline, specular.m_inv);\n";
            }
        }
        let to = format!("corners[{}u].xyz - position", light * edges);
        text += &format!("let side = ltc_side(corners[{}u].www, {to}, false);\n", light * edges);
        for (lobe, matrix) in matrices.iter().enumerate().take(lobes) {
            let turn = turns[lobe];
            text += &format!("sum[{lobe}] += ltc_form_factor(sums[{lobe}], turn{turn}, {matrix}, side);\n");
        }
        text += "}\n";
    }
    text + "results[id.x] = vec4f(sum, 0.0);\n"
}

/// An entry point around statements.
fn kernel(statements: &str) -> String {
    let files = [
        include_str!("../shaders/ltc.wgsl"),
        include_str!("../shaders/sheen.wgsl"),
        include_str!("../shaders/ggx.wgsl"),
        include_str!("../examples/lights.wgsl"),
    ];
    format!(
        "{BINDINGS}{}\n@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {{
            let seed = results[id.x];
            let position = seed.xyz;
            {statements}
        }}",
        files.concat()
    )
}

fn kernels() -> Vec<(String, String)> {
    let given = "
        let m = mat3x3f(seed.x, 0.0, 0.0, 0.0, seed.x, 0.0, seed.y, 0.0, 1.0);
        let frame = mat3x3f(seed.xyz, seed.yzx, seed.zxy);
        let sheen = SheenLobe(m, seed.z);
        let specular = GgxLobe(mat3x3f(seed.x, 0.0, 0.0, 0.0, seed.w, 0.0, seed.y, 0.0, 1.0), seed.z, seed.w);";
    let mut found = vec![
        ("a load and a store".to_owned(), "results[id.x] = seed + 1.0;".to_owned()),
        (
            "sheen_lobe".to_owned(),
            "let lobe = sheen_lobe(sheen_table, seed.x, seed.y); results[id.x] = vec4f(lobe.m_inv[0].x, lobe.m_inv[2].x, lobe.albedo, 0.0);".to_owned(),
        ),
        (
            "ggx_lobe".to_owned(),
            "let lobe = ggx_lobe(ggx_table, seed.x, seed.y); results[id.x] = vec4f(lobe.m_inv[0].x, lobe.m_inv[1].y, lobe.m_inv[2].x, lobe.albedo + lobe.fresnel);".to_owned(),
        ),
        (
            "ltc_frame".to_owned(),
            "let frame = ltc_frame(seed.xyz, seed.zyx); results[id.x] = vec4f(frame[0] + frame[1] * frame[2], 0.0);".to_owned(),
        ),
    ];
    for lobes in 1..=3 {
        for (lights, edges) in [(1, 4), (1, 5), (2, 4)] {
            found.push((walk_name(lights, edges, lobes), format!("{given}{}", walk(lights, edges, lobes))));
        }
    }
    let shade = "let surface = LightsSurface(position, seed.yzx, seed.zxy, seed.xxx, seed.yyy, seed.zzz, seed.x, seed.www, seed.y);
        results[id.x] = vec4f(lights_shade(sheen_table, ggx_table, LightsRange(u32(seed.w)), surface), 0.0);";
    found.push(("lights_shade".to_owned(), shade.to_owned()));
    found
}

/// SPIR-V without checks of bounds: engines make none here either.
fn spirv(source: &str) -> Vec<u32> {
    let module =
        naga::front::wgsl::parse_str(source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(source)));
    let (flags, capabilities) = (naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty());
    let info = naga::valid::Validator::new(flags, capabilities).validate(&module).expect("it is valid");
    let unchecked = naga::proc::BoundsCheckPolicy::Unchecked;
    let options = naga::back::spv::Options {
        lang_version: (1, 3),
        bounds_check_policies: naga::proc::BoundsCheckPolicies {
            index: unchecked,
            buffer: unchecked,
            image_load: unchecked,
            binding_array: unchecked,
        },
        force_loop_bounding: false,
        ..Default::default()
    };
    naga::back::spv::write_vec(&module, &info, &options, None).expect("it is written")
}

/// Compiles a kernel, here; the driver tells what it has made. Nothing is run.
fn compile(source: &str) -> Result<(), ash::vk::Result> {
    use ash::vk;
    let words = spirv(source);
    // SAFETY: each call is given what those before it have made; the process ends after the last.
    unsafe {
        let entry = ash::Entry::load().expect("a Vulkan loader");
        let application = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_1);
        let instance =
            entry.create_instance(&vk::InstanceCreateInfo::default().application_info(&application), None)?;
        let physical = instance.enumerate_physical_devices()?[0];
        let queue = [vk::DeviceQueueCreateInfo::default().queue_priorities(&[1.0])];
        let device =
            instance.create_device(physical, &vk::DeviceCreateInfo::default().queue_create_infos(&queue), None)?;
        let module = device.create_shader_module(&vk::ShaderModuleCreateInfo::default().code(&words), None)?;
        let (storage, image) = (vk::DescriptorType::STORAGE_BUFFER, vk::DescriptorType::SAMPLED_IMAGE);
        let bindings: Vec<vk::DescriptorSetLayoutBinding<'_>> = (0..)
            .zip([storage, storage, image, image])
            .map(|(binding, kind)| {
                let layout = vk::DescriptorSetLayoutBinding::default().binding(binding).descriptor_type(kind);
                layout.descriptor_count(1).stage_flags(vk::ShaderStageFlags::COMPUTE)
            })
            .collect();
        let layout = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        let layouts = [device.create_descriptor_set_layout(&layout, None)?];
        let layout =
            device.create_pipeline_layout(&vk::PipelineLayoutCreateInfo::default().set_layouts(&layouts), None)?;
        let stage = vk::PipelineShaderStageCreateInfo::default().stage(vk::ShaderStageFlags::COMPUTE).module(module);
        let pipeline = vk::ComputePipelineCreateInfo::default().stage(stage.name(c"main")).layout(layout);
        device.create_compute_pipelines(vk::PipelineCache::null(), &[pipeline], None).map_err(|(_, error)| error)?;
    }
    Ok(())
}

/// Instructions, vector registers and bytes of code.
fn counted(name: &str) -> [i64; 3] {
    let output = Command::new(std::env::current_exe().expect("this program has a path"))
        .envs([
            (KERNEL, name),
            ("VK_DRIVER_FILES", DRIVER),
            ("RADV_FORCE_FAMILY", FAMILY),
            ("RADV_DEBUG", "shaderstats,nocache"),
        ])
        .output()
        .expect("this program starts again");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    let number = |label: &str| {
        let line = said.lines().find(|line| line.trim_start().starts_with(label));
        let line = line.unwrap_or_else(|| panic!("the driver tells no '{label}':\n{said}"));
        line.rsplit([':', ' ']).find_map(|word| word.trim().parse().ok()).expect("a number")
    };
    ["Instructions", "VGPRs", "Code size"].map(number)
}

fn main() {
    if let Ok(name) = std::env::var(KERNEL) {
        let found = kernels().into_iter().find(|(found, _)| *found == name);
        let (_, statements) = found.expect("it is one of them");
        return compile(&kernel(&statements)).expect("the driver compiles without its hardware");
    }
    if !Path::new(DRIVER).exists() {
        println!("costs: left out, for Mesa's driver for AMD GPUs is not at {DRIVER}; scripts/setup installs it");
        return;
    }
    println!("{:34} {:>12} {:>9} {:>6}", "AMD, RDNA 2", "instructions", "registers", "bytes");
    let show = |what: &str, [instructions, registers, bytes]: [i64; 3]| {
        println!("{what:34} {instructions:12} {registers:9} {bytes:6}");
    };
    for (name, _) in kernels().iter().filter(|(name, _)| !name.starts_with("walk")) {
        show(name, counted(name));
    }
    for (lobes, named) in (1..=3).zip(["diffuse", "diffuse, sheen", "diffuse, sheen, GGX"]) {
        let of = |lights, edges| counted(&walk_name(lights, edges, lobes));
        let (quad, more_edges, more_lights) = (of(1, 4), of(1, 5), of(2, 4));
        show(&format!("a quad: {named}"), quad);
        // A larger kernel may need fewer registers.
        let more = |other: [i64; 3]| [other[0] - quad[0], other[1] - quad[1], other[2] - quad[2]];
        show("  an edge more", more(more_edges));
        show("  a quad more", more(more_lights));
    }
}

/// A kernel's name.
fn walk_name(lights: usize, edges: usize, lobes: usize) -> String {
    format!("walk {lobes} {lights} {edges}")
}
