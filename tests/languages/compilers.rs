//! Compilers of other languages.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// What a program writes to its standard output, given `input`; panics with what it says where it fails.
pub fn run(command: &mut Command, input: &[u8]) -> Vec<u8> {
    let name = command.get_program().display().to_string();
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child =
        command.spawn().unwrap_or_else(|error| panic!("{name}: {error}: `scripts/setup languages` sees to it"));
    let mut stdin = child.stdin.take().expect("it is piped");
    let input = input.to_vec();
    let writing = std::thread::spawn(move || stdin.write_all(&input));
    let output = child.wait_with_output().expect("it runs");
    let said = [&output.stdout[..], &output.stderr[..]].concat();
    assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&said));
    writing.join().expect("it writes").expect("it reads its input");
    output.stdout
}

/// Whether a source compiles; what the compiler says where it does not.
pub fn compiles(folder: &Path, name: &str, source: &str, compiler: impl Fn(&Path) -> Command) -> Result<(), String> {
    let path = folder.join(name);
    std::fs::write(&path, source).expect("the folder takes a file");
    let output =
        compiler(&path).output().unwrap_or_else(|error| panic!("{error}: `scripts/setup languages` sees to it"));
    let said = [&output.stdout[..], &output.stderr[..]].concat();
    if output.status.success() { Ok(()) } else { Err(String::from_utf8_lossy(&said).into_owned()) }
}

/// SPIR-V of a compute shader in Vulkan's GLSL, or in HLSL, by Khronos' compiler; its validator has passed it.
pub fn spirv(folder: &Path, source: &str, is_hlsl: bool) -> Vec<u32> {
    let (path, module) = (folder.join("shader.comp"), folder.join("shader.spv"));
    std::fs::write(&path, source).expect("the folder takes a file");
    let mut compiler = Command::new("glslangValidator");
    compiler.arg("-V").args(if is_hlsl { &["-D", "-e", "main"][..] } else { &[] }).arg(&path).arg("-o").arg(&module);
    run(&mut compiler, &[]);
    if is_hlsl {
        // HLSL hands textures to functions as values, which Vulkan takes only where they have been made out.
        run(Command::new("spirv-opt").arg("--legalize-hlsl").arg(&module).arg("-o").arg(&module), &[]);
    }
    validate(&module, "vulkan1.1");
    let bytes = std::fs::read(&module).expect("it has been written");
    bytes.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect()
}

/// Khronos' validator passes a module for an environment.
pub fn validate(module: &Path, environment: &str) {
    run(Command::new("spirv-val").args(["--target-env", environment]).arg(module), &[]);
}

/// Metal by a C++ compiler, with `metal_stdlib` of these tests.
pub fn metal(source: &Path, arguments: &[&str]) -> Command {
    let include = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/languages/shells/include");
    let mut compiler = Command::new("c++");
    compiler
        .args(["-std=c++14", "-Wall", "-Werror", "-Wno-unused-function", "-O1", "-x", "c++", "-I"])
        .arg(include)
        .arg(source)
        .args(arguments);
    compiler
}

/// A folder for the tests' files, gone when they are done.
pub fn folder() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("there is a place for a folder");
    let path = folder.path().to_owned();
    (folder, path)
}
