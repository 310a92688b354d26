"""Writes small glTF 2.0 binaries (.glb) and holds what both scenes are checked for.

A scene is a list of parts (a mesh with one material, placed by a node) and a camera. Positions are metres, y up, right-handed;
colours are linear Rec. 709; a light's radiance is emissiveFactor x emissiveStrength.
"""

import json
import struct
from dataclasses import dataclass
from pathlib import Path

import numpy as np

FLOAT, UINT16, UINT32 = 5126, 5123, 5125
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963


@dataclass
class Part:
    """One node: its mesh (n x 3 positions and normals, m x 3 indices), its material, and where it stands."""

    name: str
    positions: np.ndarray
    normals: np.ndarray
    triangles: np.ndarray
    material: dict
    translation: tuple = (0.0, 0.0, 0.0)
    rotation: tuple = (0.0, 0.0, 0.0, 1.0)


@dataclass
class Camera:
    """A perspective camera at `eye` that looks at `target`; `yfov` in radians."""

    eye: tuple
    target: tuple
    yfov: float
    name: str = "camera"


def matte(name, base_color, roughness=1.0, sheen_color=None, sheen_roughness=0.0, double_sided=False):
    """A dielectric material, with KHR_materials_sheen where `sheen_color` is given."""
    material = {
        "name": name,
        "pbrMetallicRoughness": {
            "baseColorFactor": [*base_color, 1.0],
            "metallicFactor": 0.0,
            "roughnessFactor": roughness,
        },
    }
    if sheen_color is not None:
        material["extensions"] = {
            "KHR_materials_sheen": {
                "sheenColorFactor": list(sheen_color),
                "sheenRoughnessFactor": sheen_roughness,
            }
        }
    if double_sided:
        material["doubleSided"] = True
    return material


def emitter(name, radiance):
    """A black material that emits `radiance`: a factor in [0,1] times KHR_materials_emissive_strength."""
    strength = float(max(radiance))
    material = matte(name, (0.0, 0.0, 0.0))
    material["emissiveFactor"] = [round(float(c) / strength, 6) for c in radiance]
    material["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": strength}}
    return material


def frame_towards(direction):
    """The rotation matrix whose third column is `direction` and whose second is as near to up (+y) as can be."""
    z = np.asarray(direction, float) / np.linalg.norm(direction)
    x = np.cross((0.0, 1.0, 0.0), z)
    x /= np.linalg.norm(x)
    return np.stack([x, np.cross(z, x), z], axis=1)


def quaternion(rotation):
    """The unit quaternion (x, y, z, w) of a rotation matrix: the eigenvector of the largest eigenvalue of Bar-Itzhack's
    symmetric matrix, which needs no case distinction."""
    r = rotation
    k = np.array([
        [r[0, 0] - r[1, 1] - r[2, 2], r[1, 0] + r[0, 1], r[2, 0] + r[0, 2], r[2, 1] - r[1, 2]],
        [r[1, 0] + r[0, 1], r[1, 1] - r[0, 0] - r[2, 2], r[2, 1] + r[1, 2], r[0, 2] - r[2, 0]],
        [r[2, 0] + r[0, 2], r[2, 1] + r[1, 2], r[2, 2] - r[0, 0] - r[1, 1], r[1, 0] - r[0, 1]],
        [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], r[0, 0] + r[1, 1] + r[2, 2]],
    ])
    q = np.linalg.eigh(k)[1][:, -1]
    q *= np.copysign(1.0, q[3])
    return tuple(round(float(c), 9) for c in q)


def polygon_light(name, outline, radiance, position, target):
    """A flat one-sided light: `outline` is a convex polygon, counter-clockwise in its own plane, seen from the lit side;
    it stands at `position` and faces `target`."""
    corners = np.asarray(outline, float)
    count = len(corners)
    positions = np.column_stack([corners, np.zeros(count)])
    normals = np.tile((0.0, 0.0, 1.0), (count, 1))
    triangles = np.array([(0, i, i + 1) for i in range(1, count - 1)])
    facing = frame_towards(np.subtract(target, position))
    return Part(name, positions, normals, triangles, emitter(name, radiance), tuple(position), quaternion(facing))


def regular_polygon(sides, radius):
    """The corners of a regular polygon, counter-clockwise, a flat side down."""
    angle = -np.pi / 2 + np.pi / sides + 2 * np.pi * np.arange(sides) / sides
    return radius * np.column_stack([np.cos(angle), np.sin(angle)])


def rectangle(width, height):
    """The corners of a rectangle, counter-clockwise."""
    return 0.5 * np.array([(-width, -height), (width, -height), (width, height), (-width, height)])


def grid_triangles(rows, columns, wrap_rows=False, wrap_columns=False, falling=None):
    """Two triangles for each cell of a grid of rows x columns vertices, in row-major order; counter-clockwise seen from
    cross(d/d row, d/d column). `falling` says for each cell whether its diagonal goes from (i, j) to (i+1, j+1); without it they
    alternate, so that no direction is favoured."""
    i, j = np.meshgrid(
        np.arange(rows if wrap_rows else rows - 1), np.arange(columns if wrap_columns else columns - 1), indexing="ij"
    )
    falling = (i + j) % 2 == 0 if falling is None else falling
    i, j = i.ravel(), j.ravel()
    right, below = (j + 1) % columns, (i + 1) % rows
    a, b, c, d = i * columns + j, below * columns + j, below * columns + right, i * columns + right
    choice = falling.ravel()[:, None]
    first = np.where(choice, np.column_stack([a, b, c]), np.column_stack([a, b, d]))
    second = np.where(choice, np.column_stack([a, c, d]), np.column_stack([b, c, d]))
    return np.stack([first, second], axis=1).reshape(-1, 3)


def vertex_normals(positions, triangles):
    """Unit normals of a smooth surface: at each vertex the mean of its triangles' normals, weighted by area."""
    a, b, c = (positions[triangles[:, k]] for k in range(3))
    face = np.cross(b - a, c - a)
    normals = np.zeros_like(positions)
    for k in range(3):
        np.add.at(normals, triangles[:, k], face)
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)


def backdrop(half_width, front, rear, height, radius, segments=48):
    """A seamless sweep: a floor at y = 0 from z = front to z = rear, a quarter circle of `radius` up into a wall."""
    angle = np.linspace(0.0, np.pi / 2, segments + 1)
    y = np.concatenate([[0.0], radius * (1 - np.cos(angle)), [height]])
    z = np.concatenate([[front], rear + radius - radius * np.sin(angle), [rear]])
    normal_y = np.concatenate([[1.0], np.cos(angle), [0.0]])
    normal_z = np.concatenate([[0.0], np.sin(angle), [1.0]])
    x = np.array([-half_width, half_width])
    positions = np.stack([np.tile(x, (len(y), 1)), np.tile(y[:, None], 2), np.tile(z[:, None], 2)], axis=-1)
    normals = np.stack([np.zeros((len(y), 2)), np.tile(normal_y[:, None], 2), np.tile(normal_z[:, None], 2)], axis=-1)
    return positions.reshape(-1, 3), normals.reshape(-1, 3), grid_triangles(len(y), 2)[:, ::-1]


def write(path, parts, camera, generator):
    """Writes the scene, and returns its size in bytes. One buffer: for each part positions, normals, indices."""
    chunks, views, accessors, meshes, materials, nodes = [], [], [], [], [], []
    offset = 0

    def accessor(values, target, component, kind, bounds=False):
        nonlocal offset
        data = values.tobytes()
        data += b"\0" * (-len(data) % 4)
        views.append({"buffer": 0, "byteOffset": offset, "byteLength": values.nbytes, "target": target})
        entry = {"bufferView": len(views) - 1, "componentType": component, "count": len(values), "type": kind}
        if bounds:
            entry["min"] = [float(v) for v in values.min(axis=0)]
            entry["max"] = [float(v) for v in values.max(axis=0)]
        accessors.append(entry)
        chunks.append(data)
        offset += len(data)
        return len(accessors) - 1

    for part in parts:
        check_part(part)
        wide = len(part.positions) > 65535
        attributes = {
            "POSITION": accessor(part.positions.astype("<f4"), ARRAY_BUFFER, FLOAT, "VEC3", bounds=True),
            "NORMAL": accessor(part.normals.astype("<f4"), ARRAY_BUFFER, FLOAT, "VEC3"),
        }
        indices = part.triangles.astype("<u4" if wide else "<u2").reshape(-1)
        if part.material not in materials:
            materials.append(part.material)
        primitive = {
            "attributes": attributes,
            "indices": accessor(indices, ELEMENT_ARRAY_BUFFER, UINT32 if wide else UINT16, "SCALAR"),
            "material": materials.index(part.material),
        }
        meshes.append({"name": part.name, "primitives": [primitive]})
        node = {"name": part.name, "mesh": len(meshes) - 1}
        if part.translation != (0.0, 0.0, 0.0):
            node["translation"] = [float(v) for v in part.translation]
        if part.rotation != (0.0, 0.0, 0.0, 1.0):
            node["rotation"] = list(part.rotation)
        nodes.append(node)

    rotation = quaternion(frame_towards(np.subtract(camera.eye, camera.target)))
    nodes.append({"name": camera.name, "camera": 0, "translation": list(camera.eye), "rotation": list(rotation)})
    document = {
        "asset": {"version": "2.0", "generator": generator},
        "extensionsUsed": sorted({name for material in materials for name in material.get("extensions", {})}),
        "scene": 0,
        "scenes": [{"nodes": list(range(len(nodes)))}],
        "nodes": nodes,
        "cameras": [{
            "name": camera.name,
            "type": "perspective",
            "perspective": {"yfov": camera.yfov, "aspectRatio": 16 / 9, "znear": 0.05, "zfar": 100.0},
        }],
        "meshes": meshes,
        "materials": materials,
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": offset}],
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    binary = b"".join(chunks)
    total = 12 + 8 + len(text) + 8 + len(binary)
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, total))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text)
        file.write(struct.pack("<I4s", len(binary), b"BIN\0") + binary)
    return total


def check_part(part):
    """What every part must hold: finite, indices in range and all vertices used, unit normals that agree with the winding."""
    positions, normals, triangles = part.positions, part.normals, part.triangles
    assert np.isfinite(positions).all() and np.isfinite(normals).all(), part.name
    assert np.array_equal(np.unique(triangles), np.arange(len(positions))), f"{part.name}: unused or missing vertices"
    assert np.abs(np.linalg.norm(normals, axis=1) - 1).max() < 1e-5, f"{part.name}: normals are not unit"
    a, b, c = (positions[triangles[:, k]] for k in range(3))
    face = np.cross(b - a, c - a)
    area = np.linalg.norm(face, axis=1)
    assert area.min() > 0, f"{part.name}: a triangle without area"
    agreement = np.einsum("ij,ikj->ik", face / area[:, None], normals[triangles])
    assert agreement.min() > 0, f"{part.name}: a normal against its triangle's winding ({agreement.min():.3f})"


def rotation_matrix(quaternion):
    """The rotation of a unit quaternion (x, y, z, w)."""
    x, y, z, w = quaternion
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ])


def verify(path, subject):
    """Reads a written scene again and holds what concerns the file: its size and lengths, bounds, indices, and that every light is
    flat, one-sided and turned to the point `subject`, with a factor in range and a black base."""
    data = Path(path).read_bytes()
    assert len(data) < 2_000_000, f"{path}: {len(data)} bytes"
    magic, version, total, length, kind = struct.unpack_from("<4sIII4s", data)
    assert (magic, version, total, kind) == (b"glTF", 2, len(data), b"JSON")
    document = json.loads(data[20 : 20 + length])
    binary = data[28 + length :]
    assert struct.unpack_from("<I4s", data, 20 + length) == (len(binary), b"BIN\0")
    assert document["buffers"][0]["byteLength"] == len(binary) and "extensionsRequired" not in document

    def values(index):
        accessor = document["accessors"][index]
        view = document["bufferViews"][accessor["bufferView"]]
        kind = {FLOAT: "<f4", UINT16: "<u2", UINT32: "<u4"}[accessor["componentType"]]
        width = {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
        return np.frombuffer(binary, kind, accessor["count"] * width, view["byteOffset"]).reshape(-1, width), accessor

    lights = 0
    for node in document["nodes"]:
        if "mesh" not in node:
            continue
        primitive = document["meshes"][node["mesh"]]["primitives"][0]
        material = document["materials"][primitive["material"]]
        positions, accessor = values(primitive["attributes"]["POSITION"])
        assert np.isfinite(positions).all(), node["name"]
        assert np.array_equal(positions.min(axis=0), np.float32(accessor["min"])), node["name"]
        assert np.array_equal(positions.max(axis=0), np.float32(accessor["max"])), node["name"]
        assert values(primitive["indices"])[0].max() < len(positions), node["name"]
        if "emissiveFactor" not in material:
            continue
        lights += 1
        rotation = rotation_matrix(node.get("rotation", (0.0, 0.0, 0.0, 1.0)))
        p_world = positions.astype(float) @ rotation.T + node.get("translation", (0.0, 0.0, 0.0))
        triangles = values(primitive["indices"])[0].reshape(-1, 3)
        a, b, c = (p_world[triangles[:, k]] for k in range(3))
        normals = np.cross(b - a, c - a)
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        assert np.abs((p_world - p_world[0]) @ normals[0]).max() < 1e-6, f"{node['name']} is not flat"
        assert (normals @ normals[0] > 1 - 1e-6).all(), f"{node['name']} is folded over"
        towards = np.subtract(subject, p_world.mean(axis=0))
        assert normals[0] @ towards > 0.9 * np.linalg.norm(towards), f"{node['name']} looks away"
        assert 0 <= min(material["emissiveFactor"]) and max(material["emissiveFactor"]) == 1.0, node["name"]
        assert material["pbrMetallicRoughness"]["baseColorFactor"][:3] == [0.0] * 3 and "doubleSided" not in material
    assert lights >= 2, "fewer than two lights"
