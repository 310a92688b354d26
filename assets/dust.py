"""Makes dust.glb: a twisted, keeled ring on a plinth, for the dusty look. See README.md beside this file.

    python dust.py [OUT.glb]
"""

import sys
from pathlib import Path

import numpy as np

import glb

ALONG, AROUND = 360, 60
RING = 0.36
LEAN = np.radians(-24.0)
PLINTH_HEIGHT, PLINTH_RADIUS, PLINTH_EDGE = 0.16, 0.34, 0.018


def profile(psi):
    """Distance of the outline from the middle of its cross-section at the angle psi: three keels with hollow flanks between. An
    exact keel, (cos)^(1/2)-like, is rounded to a radius of millimetres by the small constant, so that normals exist."""
    s = np.sin(1.5 * psi)
    return 1.0 - 0.62 * np.sqrt(s * s + 0.0025) + 0.05 * s * s


def surface(u, v):
    """The form: u goes along the ring, v around its cross-section, both in [0, 2 pi]. The cross-section turns by a third of a turn
    on the way round, so that its three keels are one; it is thicker below than above."""
    thickness = 0.15 * (1.0 - 0.3 * np.cos(u))
    psi = v
    r = thickness * profile(psi)
    turn = psi + u / 3.0
    out, side = r * np.cos(turn), 0.85 * r * np.sin(turn)
    # u = 0 is the top of the ring, which stands upright.
    return np.stack([(RING + out) * np.sin(u), (RING + out) * np.cos(u), side], axis=-1)


def ring():
    """Vertices, normals (by central differences of the formula) and triangles of the form; closed: the last row is joined to the
    first a third of the way round."""
    u = 2 * np.pi * np.arange(ALONG) / ALONG
    # Closer together at the keels, v = 0, 2 pi/3, 4 pi/3, where the outline turns.
    t = 2 * np.pi * np.arange(AROUND) / AROUND
    v = t - 0.28 * np.sin(3 * t)
    u, v = np.meshgrid(u, v, indexing="ij")
    step = 1e-5
    du = surface(u + step, v) - surface(u - step, v)
    dv = surface(u, v + step) - surface(u, v - step)
    normals = np.cross(dv, du)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    triangles = glb.grid_triangles(ALONG, AROUND, wrap_rows=True, wrap_columns=True)
    # Across the seam v is a third of a turn on: the vertex (ALONG, j) is (0, j + AROUND / 3).
    seam = triangles.reshape(ALONG, -1, 3)[-1]
    first = seam < AROUND
    seam[first] = (seam[first] + AROUND // 3) % AROUND
    return surface(u, v).reshape(-1, 3), normals.reshape(-1, 3), triangles[:, ::-1]


def turned(points, normals, segments):
    """A surface of revolution about y from an outline (radius, y) and its normals."""
    angle = 2 * np.pi * np.arange(segments) / segments
    c, s = np.cos(angle), np.sin(angle)

    def spin(p):
        return np.stack([np.outer(p[:, 0], s), np.tile(p[:, 1:], segments), np.outer(p[:, 0], c)], axis=-1).reshape(-1, 3)

    return spin(points), spin(normals), glb.grid_triangles(len(points), segments, wrap_columns=True)[:, ::-1]


def plinth(segments=160, arc=8):
    """A drum with a rounded edge and a flat top."""
    angle = np.linspace(0, np.pi / 2, arc + 1)
    inner = PLINTH_RADIUS - PLINTH_EDGE
    points = np.concatenate([
        [(PLINTH_RADIUS, 0.0)],
        np.column_stack([inner + PLINTH_EDGE * np.cos(angle), PLINTH_HEIGHT - PLINTH_EDGE * (1 - np.sin(angle))]),
        [(1e-4, PLINTH_HEIGHT)],
    ])
    normals = np.concatenate([[(1.0, 0.0)], np.column_stack([np.cos(angle), np.sin(angle)]), [(0.0, 1.0)]])
    return turned(points, normals, segments)


def main(path):
    vertices, normals, triangles = ring()
    c, s = np.cos(LEAN), np.sin(LEAN)
    spin = np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])
    vertices, normals = vertices @ spin.T, normals @ spin.T
    vertices[:, 1] += PLINTH_HEIGHT - vertices[:, 1].min() - 0.004
    top = vertices[:, 1].max()
    # Outwards: the volume enclosed is positive.
    a, b, c3 = (vertices[triangles[:, k]] for k in range(3))
    volume = np.einsum("ij,ij->i", a, np.cross(b, c3)).sum() / 6
    print(f"triangles {len(triangles)}, volume {1e3 * volume:.2f} litres, top {top:.3f} m", file=sys.stderr)
    assert volume > 0
    assert 30_000 <= len(triangles) <= 50_000
    dust = (0.9, 0.85, 0.75)
    parts = [
        glb.Part("sculpture", vertices, normals, triangles, glb.matte("dusty", (0.06, 0.05, 0.045), 0.3, dust, 0.85)),
        glb.Part("plinth", *plinth(), glb.matte("plinth", (0.16, 0.15, 0.14), 0.6)),
        glb.Part("floor", *glb.backdrop(8.0, 6.0, -3.2, 6.0, 1.6), glb.matte("floor", (0.09, 0.095, 0.105))),
        glb.polygon_light("key", glb.rectangle(1.2, 1.2), (30.0, 27.0, 23.0), (-2.0, 2.2, 2.2), (0.0, 0.6, 0.0)),
        glb.polygon_light("rim", glb.regular_polygon(8, 0.45), (40.0, 50.0, 66.0), (1.7, 1.6, -1.6), (0.0, 0.6, 0.0)),
    ]
    camera = glb.Camera((0.0, 1.0, 3.9), (0.0, 0.55, 0.0), np.radians(19.0))
    size = glb.write(path, parts, camera, "assets/dust.py")
    assert size < 2_000_000
    print(f"{path}: {size} bytes", file=sys.stderr)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).with_name("dust.glb"))
