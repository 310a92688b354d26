//! KHR_draco_mesh_compression: primitives whose attributes and indices are decoded from one view.

use std::collections::hash_map::{Entry, HashMap};

use draco_core::{DataType, DecodeLimits, DecoderBuffer, ErrorKind, Mesh, MeshDecoder, PointAttribute, PointIndex};
use gltf::json::Index;
use gltf::json::accessor::{Accessor, ComponentType, GenericComponentType, Type};
use gltf::json::buffer::View;
use gltf::json::mesh::{Mode, Primitive};
use gltf::json::validation::Checked::Valid;
use serde::Deserialize;
use serde_json::Value;

use super::assembly::primitive_label;
use super::decoded::{Decoded, Format, over};
use super::material_extensions::object;
use super::{Fault, cut};

const NAME: &str = "KHR_draco_mesh_compression";

/// The extension as a primitive's JSON holds it.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Stream {
    buffer_view: usize,
    /// The numbers of attributes in the stream, by their names in the primitive.
    attributes: HashMap<String, u32>,
}

/// What a stream has been decoded to.
struct Piece {
    indices: Index<Accessor>,
    /// By their numbers.
    attributes: HashMap<u32, Attribute>,
}

/// One value for each point.
struct Attribute {
    view: Index<View>,
    format: Format,
    /// As the stream has it.
    normalized: bool,
}

/// Decodes every primitive of triangles that is compressed, and gives it accessors of what was decoded.
pub fn decode(decoded: &mut Decoded) -> Result<(), Fault> {
    // Primitives may share a stream, which is decoded once.
    let mut pieces = HashMap::new();
    for mesh in 0..decoded.root.meshes.len() {
        for index in 0..decoded.root.meshes[mesh].primitives.len() {
            let Some(value) = compressed(&decoded.root.meshes[mesh].primitives[index]) else { continue };
            let stream = object(NAME, value).map_err(Fault::new);
            let mut primitive = decoded.root.meshes[mesh].primitives[index].clone();
            let replaced = stream.and_then(|stream| replace(&mut primitive, &stream, decoded, &mut pieces));
            replaced.map_err(|fault| Fault::at(primitive_label(decoded.root, mesh, index), fault))?;
            decoded.root.meshes[mesh].primitives[index] = primitive;
        }
    }
    Ok(())
}

/// The extension in a primitive that is drawn.
fn compressed(primitive: &Primitive) -> Option<&Value> {
    let value = primitive.extensions.as_ref()?.others.get(NAME)?;
    matches!(primitive.mode, Valid(Mode::Triangles | Mode::TriangleStrip)).then_some(value)
}

fn replace(
    primitive: &mut Primitive,
    stream: &Stream,
    decoded: &mut Decoded,
    pieces: &mut HashMap<usize, Piece>,
) -> Result<(), Fault> {
    let piece = match pieces.entry(stream.buffer_view) {
        Entry::Occupied(known) => known.into_mut(),
        Entry::Vacant(unknown) => unknown.insert(Piece::decode(decoded, stream.buffer_view)?),
    };
    for (semantic, accessor) in &mut primitive.attributes {
        let name = semantic.to_string();
        let Some(number) = stream.attributes.get(&name) else { continue };
        let wrong = |what| Fault::new(format_args!("{name}: there is no {what}; export the file again"));
        let found = piece.attributes.get(number);
        let found = found.ok_or_else(|| wrong(format!("attribute {number} that is read in its Draco data")))?;
        let said = decoded.root.accessors.get(accessor.value());
        let said = said.ok_or_else(|| wrong(format!("accessor {accessor}")))?;
        let is_same = matches!(said.component_type, Valid(GenericComponentType(own)) if own == found.format.component);
        let normalized = if is_same { said.normalized } else { found.normalized };
        *accessor = decoded.accessor(found.view, &found.format, normalized);
    }
    // A strip, too, is decoded to triangles.
    (primitive.indices, primitive.mode) = (Some(piece.indices), Valid(Mode::Triangles));
    Ok(())
}

impl Piece {
    fn decode(decoded: &mut Decoded, view: usize) -> Result<Self, Fault> {
        let bytes = decoded.own_view(view);
        let missing = format_args!("{NAME}: there is no bufferView {view} with data; export the file again");
        let bytes = bytes.ok_or_else(|| Fault::new(missing))?;
        let mesh = decode_mesh(bytes, decoded.left())?;
        // Views may overlap: what is read counts, so that no bytes are read without end.
        let read = bytes.len() as u64;
        decoded.reserve(read)?;
        if mesh.num_faces() == 0 {
            return Err(Fault::new("its Draco data holds no triangles; export the file again"));
        }
        decoded.reserve(size_of_val(mesh.faces()) as u64)?;
        let indices = mesh.faces().as_flattened().iter().flat_map(|corner| corner.0.to_le_bytes()).collect();
        let format = Format { component: ComponentType::U32, kind: Type::Scalar, count: 3 * mesh.num_faces() };
        let view = decoded.view(indices);
        let indices = decoded.accessor(view, &format, false);
        let mut attributes = HashMap::new();
        for attribute in (0..mesh.num_attributes()).map(|index| mesh.attribute(index)) {
            let Some(format) = format_of(attribute, mesh.num_points()) else { continue };
            let normalized = attribute.normalized();
            let view = add_values(decoded, attribute, &format)?;
            attributes.insert(attribute.unique_id(), Attribute { view, format, normalized });
        }
        Ok(Self { indices, attributes })
    }
}

/// The mesh of a stream, whose indices and values are each at most `room` bytes.
fn decode_mesh(bytes: &[u8], room: u64) -> Result<Mesh, Fault> {
    let limits = DecodeLimits::default().with_max_decoded_bytes(room).with_max_points(room);
    let limits = limits.with_max_faces(room / size_of::<[PointIndex; 3]>() as u64);
    let mut mesh = Mesh::new();
    let read = MeshDecoder::new().decode(&mut DecoderBuffer::new(bytes).with_limits(limits), &mut mesh);
    read.map_err(|error| match error.kind() {
        ErrorKind::LimitExceeded => over(),
        _ => broken(&error.to_string()),
    })?;
    Ok(mesh)
}

/// What an attribute's values are, where glTF has such.
fn format_of(attribute: &PointAttribute, count: usize) -> Option<Format> {
    let component = match attribute.data_type() {
        DataType::Int8 => ComponentType::I8,
        DataType::Uint8 => ComponentType::U8,
        DataType::Int16 => ComponentType::I16,
        DataType::Uint16 => ComponentType::U16,
        DataType::Uint32 => ComponentType::U32,
        DataType::Float32 => ComponentType::F32,
        _ => return None,
    };
    let kinds = [Type::Scalar, Type::Vec2, Type::Vec3, Type::Vec4];
    let kind = *kinds.get(usize::from(attribute.num_components()).checked_sub(1)?)?;
    Some(Format { component, kind, count })
}

/// Adds a view of an attribute's value at each point.
fn add_values(decoded: &mut Decoded, attribute: &PointAttribute, format: &Format) -> Result<Index<View>, Fault> {
    let size = format.component.size() * format.kind.multiplicity();
    decoded.reserve((format.count as u64).saturating_mul(size as u64))?;
    let (data, stride) = (attribute.buffer().data(), usize::try_from(attribute.byte_stride()).unwrap_or(size));
    let mut values = Vec::with_capacity(format.count * size);
    for point in 0..format.count {
        let start = (attribute.mapped_index(PointIndex(point as u32)).0 as usize).checked_mul(stride);
        let value = start.and_then(|start| data.get(start..start.checked_add(size)?));
        values.extend(value.ok_or_else(|| broken("a point without a value"))?);
    }
    Ok(decoded.view(values))
}

fn broken(said: &str) -> Fault {
    Fault::new(format_args!("its Draco data is broken ({}); copy or export the file again", cut(said)))
}
