//! The shipped files as text: what a copier relies on before anything runs.

use std::path::Path;
use wgpu::naga;

pub fn source(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders").join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn compile(source: &str) -> Result<naga::Module, String> {
    let module = naga::front::wgsl::parse_str(source).map_err(|error| error.emit_to_string(source))?;
    let mut validator =
        naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty());
    validator.validate(&module).map_err(|error| error.emit_to_string(source))?;
    Ok(module)
}

#[test]
fn each_file_compiles_alone() {
    for name in ["ltc.wgsl", "sheen.wgsl"] {
        compile(&source(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}
