//! What a URI in a file stands for: a path within the scene's folder, or the data that it spells out.

use std::path::{Component, Path, PathBuf};

use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, general_purpose::PAD};
use percent_encoding::{percent_decode, percent_decode_str};

use super::Fault;

/// Some leave out the padding at the end.
const BASE64: GeneralPurpose =
    GeneralPurpose::new(&STANDARD, PAD.with_decode_padding_mode(DecodePaddingMode::Indifferent));
/// How much of a URI messages show.
const SHOWN: usize = 200;

/// The data of a data URI (RFC 2397), in base64 or as percent-encoded bytes; `None` where the URI is of another kind.
pub fn data(uri: &str) -> Result<Option<Vec<u8>>, Fault> {
    let Some(("data", content)) = scheme(uri).as_ref().map(|(scheme, rest)| (scheme.as_str(), *rest)) else {
        return Ok(None);
    };
    let no_data = || Fault::new("its data URI has no comma, and so no data; export the file again");
    let (media, data) = content.split_once(',').ok_or_else(no_data)?;
    let is_base64 = media.rsplit(';').next().is_some_and(|last| last.trim().eq_ignore_ascii_case("base64"));
    let bytes = percent_decode(data.as_bytes());
    if !is_base64 {
        return Ok(Some(bytes.collect()));
    }
    let broken = |error| Fault::new(format_args!("its data URI is broken ({error}); export the file again"));
    BASE64.decode(std::borrow::Cow::from(bytes)).map(Some).map_err(broken)
}

/// The path that a URI names, within the scene's folder: a scene must not reach other files of its user. Dot segments
/// are taken out as RFC 3986 does (section 5.2.4), so that they may lead through any folder, and back.
pub fn path(uri: &str, folder: Option<&Path>) -> Result<PathBuf, Fault> {
    let shown: String = uri.chars().take(SHOWN).collect();
    let refuse = |why: &str| Fault::new(format_args!("its URI '{shown}' {why}"));
    let folder = folder.ok_or_else(|| refuse("names a file, and this scene has no folder; give a .glb file"))?;
    if scheme(uri).is_some() {
        return Err(refuse("has a scheme; give a path relative to the scene's folder"));
    }
    let outside =
        || refuse("leads out of the scene's folder; put the file beside the scene and name it by a relative path");
    // What follows is for servers.
    let named = uri.split(['?', '#']).next().unwrap_or_default();
    let mut segments = Vec::new();
    if named.starts_with('/') {
        return Err(outside());
    }
    // Empty segments in the middle or at the end lead nowhere.
    for segment in named.split('/').filter(|segment| !segment.is_empty()) {
        let name = percent_decode_str(segment).decode_utf8().map_err(|_| refuse("is not UTF-8; rename the file"))?;
        match name.as_ref() {
            "." => {}
            ".." => drop(segments.pop().ok_or_else(outside)?),
            name if !is_file_name(name) => return Err(refuse("names no file beside the scene; name one")),
            _ => segments.push(name),
        }
    }
    if named.is_empty() {
        return Err(refuse("names no file beside the scene; name one"));
    }
    Ok(segments.iter().fold(folder.to_owned(), |path, segment| path.join(segment.as_ref())))
}

/// Whether a segment names something in its folder: neither a path of its own, as `a%2Fb` or, where that means something,
/// `C:`, nor one that ends early.
fn is_file_name(segment: &str) -> bool {
    let mut components = Path::new(segment).components();
    let is_plain = matches!(components.next(), Some(Component::Normal(name)) if name == segment);
    is_plain && components.next().is_none() && !segment.contains('\0')
}

/// The scheme, in lower case, and what follows its colon (RFC 3986, section 3.1), if there is one.
fn scheme(uri: &str) -> Option<(String, &str)> {
    let (scheme, rest) = uri.split_once(':')?;
    let follows = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'+' | b'-' | b'.');
    let is_scheme = scheme.starts_with(|first: char| first.is_ascii_alphabetic()) && scheme.bytes().all(follows);
    is_scheme.then(|| (scheme.to_ascii_lowercase(), rest))
}
