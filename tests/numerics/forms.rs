//! The tables in other forms, read back by what knows nothing of how they were written.

use std::path::Path;
use std::process::{Command, Output};

use half::f16;
use velour::export::tables::{Difference, Form, Texture, resample, resampled};
use velour::table::{GgxTable, SheenTable};

/// What a reader found: width, height, and texels in rows from y = 0 on.
#[derive(Clone, Debug, PartialEq)]
struct Found {
    size: [usize; 2],
    texels: Vec<[f32; 4]>,
}

/// How far a number may be off.
#[derive(Clone, Copy)]
enum Precision {
    /// Half a step of an f16 (2^-11 of the number, 2^-25 near 0), and what rounding by way of f32 adds.
    Half,
    Single,
}

impl Found {
    /// From halves in order, as bytes.
    fn of_halves([width, height]: [usize; 2], bytes: &[u8]) -> Self {
        let halves: Vec<f32> = bytes.as_chunks().0.iter().map(|pair| f16::from_le_bytes(*pair).to_f32()).collect();
        Self { size: [width, height], texels: halves.as_chunks().0.to_vec() }
    }

    fn of_floats([width, height]: [usize; 2], bytes: &[u8]) -> Self {
        let floats: Vec<f32> = bytes.as_chunks().0.iter().map(|four| f32::from_le_bytes(*four)).collect();
        Self { size: [width, height], texels: floats.as_chunks().0.to_vec() }
    }

    fn is(&self, expected: &Self, precision: Precision) -> bool {
        let tolerance = |value: f32| match precision {
            Precision::Half => value.abs() * 4.9e-4 + 3.1e-8,
            Precision::Single => 0.0,
        };
        let pairs = self.texels.as_flattened().iter().zip(expected.texels.as_flattened());
        let close = pairs.into_iter().all(|(found, expected)| (found - expected).abs() <= tolerance(*expected));
        self.size == expected.size && self.texels.len() == expected.texels.len() && close
    }

    fn moved(&self, from: impl Fn(usize, usize) -> (usize, usize)) -> Self {
        let [width, height] = self.size;
        let texel = |index| {
            let (x, y) = from(index % width, index / width);
            self.texels[y * width + x]
        };
        Self { size: self.size, texels: (0..width * height).map(texel).collect() }
    }
}

/// The tables as the library looks them up, and as they are exported.
fn tables() -> [(Found, Texture); 2] {
    let (sheen, ggx) = (SheenTable::embedded(), GgxTable::embedded());
    let [exported_sheen, exported_ggx] = Texture::shipped();
    let sheen = Found { size: sheen.size(), texels: sheen.texels() };
    let ggx = Found { size: ggx.texture_size(), texels: ggx.texels() };
    [(sheen, exported_sheen), (ggx, exported_ggx)]
}

/// Both tables, read back, are what they should be; and would not be if they were turned or had their channels exchanged.
fn check(form: Form, precision: Precision, read: impl Fn(&Texture, &[u8]) -> Found) {
    for (expected, texture) in tables() {
        let found = read(&texture, &texture.file(form));
        let name = texture.name(form);
        assert!(found.is(&expected, precision), "{name}");
        let [width, height] = expected.size;
        let transposed = |x: usize, y: usize| (y % width, x + y / width * width);
        assert!(!found.moved(transposed).is(&expected, precision), "{name} transposed");
        assert!(!found.moved(|x, y| (x, height - 1 - y)).is(&expected, precision), "{name} upside down");
        assert!(!found.moved(|x, y| (width - 1 - x, y)).is(&expected, precision), "{name} mirrored");
        let mut exchanged = found.clone();
        exchanged.texels.iter_mut().for_each(|texel| texel.swap(0, 2));
        assert!(!exchanged.is(&expected, precision), "{name} in the order BGRA");
    }
}

#[test]
fn dds_opens_as_direct3d_would_open_it() {
    check(Form::Dds, Precision::Half, |_, bytes| {
        let dds = ddsfile::Dds::read(bytes).unwrap();
        assert_eq!(dds.get_dxgi_format(), Some(ddsfile::DxgiFormat::R16G16B16A16_Float));
        assert_eq!((dds.get_num_mipmap_levels(), dds.get_num_array_layers(), dds.get_depth()), (1, 1, 1));
        let size = [dds.get_width() as usize, dds.get_height() as usize];
        Found::of_halves(size, dds.get_data(0).unwrap())
    });
}

#[test]
fn ktx2_opens_and_describes_its_texels() {
    check(Form::Ktx2, Precision::Half, |texture, bytes| {
        let file = ktx2::Reader::new(bytes).unwrap();
        let header = file.header();
        assert_eq!((header.format, header.type_size), (Some(ktx2::Format::R16G16B16A16_SFLOAT), 2));
        assert_eq!((header.pixel_depth, header.layer_count, header.face_count, header.level_count), (0, 0, 1, 1));
        assert_eq!(header.supercompression_scheme, None);
        let basic = file.basic_dfd().expect("a basic descriptor");
        assert_eq!(
            (file.color_model(), file.transfer_function()),
            (Some(ktx2::ColorModel::RGBSDA), Some(ktx2::TransferFunction::Linear))
        );
        assert_eq!((file.color_primaries(), file.is_alpha_premultiplied()), (None, Some(false)));
        assert_eq!(basic.bytes_planes, [8, 0, 0, 0, 0, 0, 0, 0]);
        let samples: Vec<_> = basic
            .sample_information
            .iter()
            .map(|sample| (sample.bit_offset, sample.bit_length.get(), sample.channel_type))
            .collect();
        assert_eq!(samples, [(0, 16, 0), (16, 16, 1), (32, 16, 2), (48, 16, 15)]);
        let notes: Vec<(&str, &[u8])> = file.key_value_data().collect();
        assert!(notes.is_sorted());
        let note = |key| notes.iter().find(|(found, _)| *found == key).expect("a note").1;
        assert_eq!(note("layout"), format!("{}\0", texture.layout(Form::Ktx2)).as_bytes());
        assert_eq!(note("KTXorientation"), b"rd\0");
        let levels: Vec<_> = file.levels().collect();
        assert_eq!(levels.len(), 1);
        assert_eq!(header.index.kvd_byte_offset % 4, 0);
        assert_eq!((levels[0].data.as_ptr() as usize - bytes.as_ptr() as usize) % 8, 0);
        Found::of_halves([header.pixel_width as usize, header.pixel_height as usize], levels[0].data)
    });
}

#[test]
fn exr_opens_as_a_picture() {
    check(Form::Exr, Precision::Half, |_, bytes| {
        let picture = image::load_from_memory_with_format(bytes, image::ImageFormat::OpenExr).unwrap().into_rgba32f();
        let texels = picture.pixels().map(|pixel| pixel.0).collect();
        Found { size: [picture.width() as usize, picture.height() as usize], texels }
    });
}

#[test]
fn bin_is_nothing_but_halves() {
    check(Form::Bin, Precision::Half, |texture, bytes| Found::of_halves(texture.size, bytes));
}

/// Read as NEP 1 has it.
#[test]
fn npy_has_the_head_that_numpy_reads() {
    check(Form::Npy, Precision::Single, |_, bytes| {
        let (magic, rest) = bytes.split_at(8);
        assert_eq!(magic, b"\x93NUMPY\x01\x00");
        let length = usize::from(u16::from_le_bytes([rest[0], rest[1]]));
        let head = std::str::from_utf8(&rest[2..2 + length]).unwrap();
        assert!(head.ends_with('\n') && (10 + length).is_multiple_of(64));
        assert!(head.contains("'descr': '<f4'") && head.contains("'fortran_order': False"), "{head}");
        let shape = head.split_once("'shape': (").unwrap().1.split_once(')').unwrap().0;
        let shape: Vec<usize> = shape.split(',').map(|side| side.trim().parse().unwrap()).collect();
        assert_eq!(shape[2], 4);
        Found::of_floats([shape[1], shape[0]], &rest[2 + length..])
    });
}

#[test]
fn csv_is_the_shipped_one() {
    let [sheen, ggx] = Texture::shipped();
    let text = |texture: &Texture| String::from_utf8(texture.file(Form::Csv)).unwrap();
    assert_eq!(SheenTable::from_csv(&text(&sheen)).unwrap(), SheenTable::embedded());
    assert_eq!(GgxTable::from_csv(&text(&ggx)).unwrap(), GgxTable::embedded());
}

#[test]
fn js_is_an_object_of_halves() {
    check(Form::Js, Precision::Half, |texture, bytes| {
        let text = std::str::from_utf8(bytes).unwrap();
        let code: String = text.lines().filter(|line| !line.starts_with("//")).collect();
        let name = ["sheenLtc", "ggxLtc"][usize::from(texture.stem == "ggx_ltc")];
        let rest = code.strip_prefix(&format!("export const {name} = {{ width: ")).unwrap();
        let (width, rest) = rest.split_once(", height: ").unwrap();
        let (height, rest) = rest.split_once(", data: new Uint16Array([").unwrap();
        let data = rest.strip_suffix("]) };").unwrap().trim_end_matches(',');
        let bytes: Vec<u8> =
            data.split(',').flat_map(|half| half.trim().parse::<u16>().unwrap().to_le_bytes()).collect();
        Found::of_halves([width.parse().unwrap(), height.parse().unwrap()], &bytes)
    });
}

/// A compiler, with the variable that names another one, and its flags.
struct Compiler {
    name: &'static str,
    variable: &'static str,
    flags: &'static [&'static str],
}

const C: Compiler = Compiler { name: "cc", variable: "CC", flags: &["-std=c89", "-pedantic", "-Wall", "-Werror"] };
const RUST: Compiler = Compiler { name: "rustc", variable: "RUSTC", flags: &["--edition=2021", "-Dwarnings"] };

impl Compiler {
    fn command(&self) -> Command {
        Command::new(std::env::var_os(self.variable).unwrap_or_else(|| self.name.into()))
    }

    /// Compiles a file to `program`, in its folder.
    fn compile(&self, mut command: Command, folder: &Path, source: &Path) -> Output {
        let run = command.args(self.flags).args(["-o", "program"]).arg(source).current_dir(folder).output();
        run.unwrap_or_else(|error| {
            let (program, variable) = (command.get_program().display(), self.variable);
            panic!("the compiler '{program}' does not start ({error}): install it, or name another in {variable}")
        })
    }
}

#[test]
#[should_panic(expected = "the compiler 'no-such-compiler' does not start")]
fn a_compiler_that_is_not_there_is_named() {
    C.compile(Command::new("no-such-compiler"), Path::new("."), Path::new("program.c"));
}

/// Compiles a program that stands beside a file, runs it, and takes what it writes.
fn built(texture: &Texture, form: Form, program: &str, compiler: &Compiler) -> Vec<u8> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(texture.name(form)), texture.file(form)).unwrap();
    let source = Path::new("program").with_extension(if form == Form::C { "c" } else { "rs" });
    std::fs::write(folder.path().join(&source), program).unwrap();
    let built = compiler.compile(compiler.command(), folder.path(), &source);
    assert!(built.status.success(), "{}: {}", texture.name(form), String::from_utf8_lossy(&built.stderr));
    Command::new(folder.path().join("program")).output().unwrap().stdout
}

#[test]
fn c_compiles() {
    check(Form::C, Precision::Single, |texture, _| {
        let (name, upper) = (&texture.stem, texture.stem.to_uppercase());
        let program = format!(
            "#include <stdio.h>\n#include \"{name}.h\"\n#include \"{name}.h\"\nint main(void) {{\n\
             int size[2] = {{ {upper}_WIDTH, {upper}_HEIGHT }};\nfwrite(size, sizeof size, 1, stdout);\n\
             fwrite({name}, sizeof {name}, 1, stdout);\nreturn 0;\n}}\n"
        );
        let out = built(texture, Form::C, &program, &C);
        let side = |at: usize| i32::from_ne_bytes(out[4 * at..4 * at + 4].try_into().unwrap()) as usize;
        Found::of_floats([side(0), side(1)], &out[8..])
    });
}

#[test]
fn rust_compiles() {
    check(Form::Rust, Precision::Single, |texture, _| {
        let (name, upper) = (&texture.stem, texture.stem.to_uppercase());
        let program = format!(
            "mod {name};\nuse std::io::Write;\nuse {name}::{upper};\nfn main() {{\n\
             let mut out = vec![{upper}[0].len() as u8, {upper}.len() as u8];\n\
             out.extend({upper}.iter().flatten().flatten().flat_map(|value: &f32| value.to_le_bytes()));\n\
             std::io::stdout().write_all(&out).unwrap();\n}}\n"
        );
        let out = built(texture, Form::Rust, &program, &RUST);
        Found::of_floats([usize::from(out[0]), usize::from(out[1])], &out[2..])
    });
}

#[test]
fn glsl_compiles_and_packs_halves_as_unpack_half_2x16_takes_them() {
    use naga::{Expression, Handle, Literal};
    check(Form::Glsl, Precision::Half, |texture, bytes| {
        let (text, name) = (std::str::from_utf8(bytes).unwrap(), &texture.stem);
        let main = format!("layout(location = 0) out vec4 o;\nvoid main() {{ o = {name}_texel(3, 1); }}\n");
        let options = naga::front::glsl::Options::from(naga::ShaderStage::Fragment);
        let module = naga::front::glsl::Frontend::default().parse(&options, &format!("#version 450\n{text}{main}"));
        let module = module.unwrap_or_else(|errors| panic!("{errors:?}"));
        let parts = |at: Handle<Expression>| match &module.global_expressions[at] {
            Expression::Compose { components, .. } => components.clone(),
            other => panic!("{other:?}"),
        };
        let number = |at: &Handle<Expression>| match module.global_expressions[*at] {
            Expression::Literal(Literal::U32(number)) => number,
            ref other => panic!("{other:?}"),
        };
        let upper = name.to_uppercase();
        let (_, array) = module.constants.iter().find(|(_, it)| it.name.as_deref() == Some(&upper)).expect("the array");
        let numbers = parts(array.init).into_iter().flat_map(&parts).map(|at| number(&at));
        let bytes: Vec<u8> = numbers.flat_map(u32::to_le_bytes).collect();
        // What the text says of its size is in how it finds a row.
        let width: usize = text
            .split_once(&format!("{upper}["))
            .unwrap()
            .1
            .split_once(" * y + x]")
            .unwrap()
            .0
            .rsplit('[')
            .next()
            .unwrap()
            .parse()
            .unwrap();
        Found::of_halves([width, bytes.len() / 8 / width], &bytes)
    });
}

#[test]
fn each_file_that_holds_text_says_how_it_is_laid_out() {
    for texture in Texture::shipped() {
        for form in Form::ALL {
            let (file, layout) = (texture.file(form), texture.layout(form));
            let holds = |text: &str| file.windows(text.len()).any(|window| window == text.as_bytes());
            let silent = [Form::Dds, Form::Npy, Form::Bin, Form::Csv].contains(&form);
            assert_eq!(holds(&layout), !silent, "{}", texture.name(form));
            let licensed = !silent || form == Form::Csv;
            assert_eq!(holds("SPDX-License-Identifier"), licensed, "{}", texture.name(form));
        }
    }
}

#[test]
fn differences_of_tables_are_found_where_they_are() {
    let table = SheenTable::embedded();
    let same = Difference::between(&table, &table);
    assert_eq!((same.max, same.mean, same.lobe), ([0.0; 3], [0.0; 3], [0.0; 2]));
    // Half as bright: lobes are half as far from each other as from none.
    let dim = SheenTable::new([32, 32], table.cells().iter().map(|[a, b, r]| [*a, *b, r / 2.0]).collect());
    assert!(Difference::between(&dim, &table).lobe.iter().all(|distance| (distance - 0.5).abs() < 1e-12));
    let mut cells = table.cells().to_vec();
    cells[32 * 20 + 7][1] -= 0.25;
    let other = Difference::between(&table, &SheenTable::new([32, 32], cells));
    assert_eq!((other.max[0], other.max[2]), (0.0, 0.0));
    // One node: itself, its four neighbours midway at half of it, and four at a quarter.
    assert!((other.max[1] - 0.25).abs() < 1e-12);
    assert!((other.mean[1] - 0.25 * 4.0 / (63.0 * 63.0)).abs() < 1e-12, "{}", other.mean[1]);
}

#[test]
fn resampling_to_the_same_nodes_changes_nothing() {
    let table = SheenTable::embedded();
    let again = Difference::between(&resample(&table, 32), &table);
    assert!(again.max.iter().all(|apart| *apart < 1e-6), "{again}");
}

#[test]
fn a_small_table_is_nearer_than_one_of_every_other_node() {
    let table = SheenTable::embedded();
    let at = |k: usize| k as f64 / 15.0;
    let looked_up = SheenTable::new([16, 16], (0..256).map(|k| table.lookup(at(k / 16), at(k % 16))).collect());
    let [small, looked_up] =
        [resample(&table, 16), looked_up].map(|table| Difference::between(&table, &SheenTable::embedded()));
    println!("{small}\n{looked_up}");
    for k in 0..3 {
        assert!(small.mean[k] < 0.7 * looked_up.mean[k] && small.max[k] < looked_up.max[k], "{small}; {looked_up}");
    }
    // What docs/tables.md states.
    assert!(small.mean[2] < 0.0016 && small.lobe[1] < 0.05, "{small}");
}

#[test]
fn tables_of_all_sizes_are_whole() {
    for side in [2, 3, 16, 128] {
        let (texture, _) = resampled(side);
        assert_eq!(texture.size, [side, side]);
        let table = SheenTable::from_csv(&String::from_utf8(texture.file(Form::Csv)).unwrap()).unwrap();
        assert_eq!(table.size(), [side, side]);
        assert_eq!(SheenTable::from_dds(&texture.file(Form::Dds)).unwrap().size(), [side, side]);
        assert!(table.cells().iter().all(|[a, b, r]| *a > 0.0 && *b <= 0.0 && (0.0..=1.0).contains(r)), "{side}");
    }
}
