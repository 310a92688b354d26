//! A file as a library in SPIR-V.

use naga::back::spv;
use naga::valid::{Capabilities, ValidationFlags, Validator};

/// Instructions and their operands, by the numbers of the SPIR-V specification (Khronos, 1.6, sections 3.52 and 3.20).
const OP_NAME: u32 = 5;
const OP_DECORATE: u32 = 71;
const OP_FUNCTION: u32 = 54;
const LINKAGE_ATTRIBUTES: u32 = 41;
const EXPORT: u32 = 0;
/// Words before the first instruction.
const HEADER_WORDS: usize = 5;

/// A file of functions as SPIR-V 1.1 without entry points: each function is exported by its name, so that `spirv-link`
/// joins it with modules that import it. Fails with the compiler's message where the WGSL does not compile alone.
pub fn spirv(wgsl: &str) -> Result<Vec<u8>, String> {
    let module = naga::front::wgsl::parse_str(wgsl).map_err(|error| error.emit_to_string(wgsl))?;
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
    let info = validator.validate(&module).map_err(|error| error.emit_to_string(wgsl))?;
    let options = spv::Options { flags: spv::WriterFlags::DEBUG, ..spv::Options::default() };
    let words = spv::write_vec(&module, &info, &options, None).map_err(|error| error.to_string())?;
    let functions: Vec<&str> = module.functions.iter().filter_map(|(_, function)| function.name.as_deref()).collect();
    Ok(with_exports(&words, &functions).into_iter().flat_map(u32::to_le_bytes).collect())
}

/// The module's instructions, each with its number.
fn instructions(words: &[u32]) -> impl Iterator<Item = (u32, &[u32])> {
    let mut rest = &words[HEADER_WORDS..];
    std::iter::from_fn(move || {
        let (length, number) = (rest.first()? >> 16, rest[0] & 0xffff);
        let (instruction, after) = rest.split_at(length as usize);
        rest = after;
        Some((number, instruction))
    })
}

/// The text of words, of which the last ends in zeros.
fn text(words: &[u32]) -> String {
    let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).take_while(|byte| *byte != 0).collect();
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Adds a decoration for each function of the file, behind the last of the names, where decorations begin. Those that the writer adds
/// stay within the module: others have them too.
fn with_exports(words: &[u32], exported: &[&str]) -> Vec<u32> {
    let functions: Vec<u32> =
        instructions(words).filter(|(number, _)| *number == OP_FUNCTION).map(|(_, function)| function[2]).collect();
    let mut written = words[..HEADER_WORDS].to_vec();
    let (mut names, mut exports) = (0, Vec::new());
    let mut length = written.len();
    for (number, instruction) in instructions(words) {
        length += instruction.len();
        if number == OP_NAME {
            names = length;
        }
        let is_exported = |name: &[u32]| exported.contains(&text(name).as_str());
        if number == OP_NAME && functions.contains(&instruction[1]) && is_exported(&instruction[2..]) {
            let name = &instruction[2..];
            exports.extend([(name.len() as u32 + 4) << 16 | OP_DECORATE, instruction[1], LINKAGE_ATTRIBUTES]);
            exports.extend(name);
            exports.push(EXPORT);
        }
    }
    written.extend(&words[HEADER_WORDS..names]);
    written.append(&mut exports);
    written.extend(&words[names..]);
    written
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::shaders::SOURCES;

    #[test]
    fn every_function_is_exported_by_its_name() {
        for source in SOURCES.iter().filter(|source| source.needs.is_empty()) {
            let bytes = spirv(source.text).unwrap();
            let words: Vec<u32> =
                bytes.chunks_exact(4).map(|word| u32::from_le_bytes(word.try_into().unwrap())).collect();
            let mut names: Vec<String> = instructions(&words)
                .filter(|(number, words)| *number == OP_DECORATE && words[2] == LINKAGE_ATTRIBUTES)
                .map(|(_, words)| text(&words[3..words.len() - 1]))
                .collect();
            let functions = source.text.lines().filter_map(|line| line.strip_prefix("fn "));
            let mut expected: Vec<String> = functions.map(|rest| rest.split('(').next().unwrap().to_owned()).collect();
            names.sort();
            expected.sort();
            assert_eq!(names, expected, "{}", source.stem);
        }
    }

    #[test]
    fn what_does_not_compile_is_told_apart() {
        assert!(spirv("fn f() -> f32 { return 1u; }").unwrap_err().contains("f32"));
    }
}
