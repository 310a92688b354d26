"""Makes dust.glb: a twisted, keeled ring on a plinth, for the dusty look, on a photographer's set. See README.md beside this file.

    python dust.py [OUT.glb]
"""

import sys
from pathlib import Path

import numpy as np

import glb

# Vertices along the ring and around its cross-section.
ALONG, AROUND = 340, 72
# Turns of the cross-section on its way round the ring. A multiple of a third that isn't whole: so the three keels are
# one edge, which goes three times round.
TURNS = -5.0 / 3.0
# The distance from the ring's middle to its cross-section's (metres), how far the keels reach from the latter, and by
# what part more below.
RING, THICKNESS, GROWTH = 0.33, 0.19, 0.25
# How deep the form is let into the plinth, and how it is turned to the camera.
SUNK, YAW = 0.025, np.radians(-24.0)
PLINTH_HEIGHT, PLINTH_RADIUS, PLINTH_EDGE = 0.16, 0.34, 0.018
# What the lamps are turned to.
MIDDLE = (0.0, 0.62, 0.0)


def profile(v):
    """The outline of the cross-section, as a distance from its middle at the angle v: three keels at multiples of 2 pi/3, hollow
    flanks between. |sin| alone would end in an edge without a normal; the small constant rounds it to millimetres."""
    s = np.sin(1.5 * v)
    return 1.0 - 0.62 * np.sqrt(s * s + 0.0025) + 0.05 * s * s


def surface(u, v):
    """The form: u goes along the ring from its top, v around its cross-section, both in [0, 2 pi]. The ring stands upright in the
    plane z = 0."""
    r = THICKNESS * (1.0 - GROWTH * np.cos(u)) * profile(v)
    turn = v + TURNS * u
    out, side = r * np.cos(turn), 0.85 * r * np.sin(turn)
    return np.stack([(RING + out) * np.sin(u), (RING + out) * np.cos(u), side], axis=-1)


def ring():
    """Vertices, normals (central differences of the formula) and triangles of the form. It is closed: the last row is joined to the
    first."""
    u = 2 * np.pi * np.arange(ALONG) / ALONG
    # Closer together at the keels, v = 0, 2 pi/3, 4 pi/3, where the outline turns.
    t = 2 * np.pi * np.arange(AROUND) / AROUND
    v = t - 0.24 * np.sin(3 * t)
    u, v = np.meshgrid(u, v, indexing="ij")
    step = 1e-5
    du = surface(u + step, v) - surface(u - step, v)
    dv = surface(u, v + step) - surface(u, v - step)
    normals = np.cross(dv, du)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    triangles = glb.grid_triangles(ALONG, AROUND, wrap_rows=True, wrap_columns=True)
    # Across the seam v goes on by TURNS turns: the vertex (ALONG, j) is (0, j + TURNS * AROUND).
    seam = triangles.reshape(ALONG, -1, 3)[-1]
    first = seam < AROUND
    seam[first] = (seam[first] + round(TURNS * AROUND)) % AROUND
    return surface(u, v).reshape(-1, 3), normals.reshape(-1, 3), triangles[:, ::-1]


def plinth(segments=160, arc=8):
    """A drum with a rounded edge: its outline (radius, y) turned about the y axis, and a vertex in the middle of the top."""
    angle = np.linspace(0, np.pi / 2, arc + 1)
    inner, shoulder = PLINTH_RADIUS - PLINTH_EDGE, PLINTH_HEIGHT - PLINTH_EDGE
    edge = np.column_stack([np.cos(angle), np.sin(angle)])
    outline = np.concatenate([[(PLINTH_RADIUS, 0.0)], (inner, shoulder) + PLINTH_EDGE * edge])
    normals = np.concatenate([[(1.0, 0.0)], edge])

    azimuth = 2 * np.pi * np.arange(segments) / segments

    def turn(p):
        x, z = np.outer(p[:, 0], np.sin(azimuth)), np.outer(p[:, 0], np.cos(azimuth))
        return np.stack([x, np.tile(p[:, 1:], segments), z], axis=-1).reshape(-1, 3)

    rim = (len(outline) - 1) * segments + np.arange(segments)
    top = np.column_stack([rim, np.roll(rim, -1), np.full(segments, len(outline) * segments)])
    triangles = np.concatenate([glb.grid_triangles(len(outline), segments, wrap_columns=True)[:, ::-1], top])
    vertices = np.concatenate([turn(outline), [(0.0, PLINTH_HEIGHT, 0.0)]])
    return vertices, np.concatenate([turn(normals), [(0.0, 1.0, 0.0)]]), triangles


def check(vertices, triangles):
    """What the form must hold; the figures stand in README.md."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
    edges = np.concatenate([triangles[:, (k, (k + 1) % 3)] for k in range(3)])
    longest = np.linalg.norm(vertices[edges[:, 0]] - vertices[edges[:, 1]], axis=1).max()
    print(
        f"triangles {len(triangles)}, volume {1e3 * volume:.2f} litres, top {vertices[:, 1].max():.3f} m, "
        f"longest edge {1e3 * longest:.1f} mm",
        file=sys.stderr,
    )
    assert 30_000 <= len(triangles) <= 50_000
    # Closed and consistently wound: each edge occurs once in each direction. A ring: V - E + F = 0.
    there, back = (set(map(tuple, e)) for e in (edges, edges[:, ::-1]))
    assert len(there) == len(edges) and there == back
    assert len(vertices) - len(edges) // 2 + len(triangles) == 0
    assert volume > 0, "inside out"
    assert longest < 0.03
    # The cross-section doesn't reach the ring's middle, so the form can't meet itself.
    assert THICKNESS * (1 + GROWTH) * profile(0.0) < RING


def photo_set():
    """The sweep and its three lamps, all of them outside the picture; drape.py says what each is for."""
    floor = glb.matte("floor", (0.072, 0.068, 0.066))
    return [
        glb.Part("floor", *glb.backdrop(half_width=9.0, front=7.0, rear=-4.5, height=7.0, radius=3.2), floor),
        glb.polygon_light("key", glb.rectangle(1.0, 1.3), (125.0, 116.0, 104.0), (-2.6, 2.3, 0.8), MIDDLE),
        glb.polygon_light("fill", glb.regular_polygon(6, 1.2), (6.0, 6.5, 7.6), (1.0, 1.6, 5.2), MIDDLE),
        glb.polygon_light("rim", glb.regular_polygon(8, 0.45), (70.0, 77.0, 91.0), (1.5, 1.95, -1.2), (0.8, 0.1, -0.25)),
    ]


def main(path):
    vertices, normals, triangles = ring()
    c, s = np.cos(YAW), np.sin(YAW)
    turn = np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])
    vertices, normals = vertices @ turn.T, normals @ turn.T
    vertices[:, 1] += PLINTH_HEIGHT - SUNK - vertices[:, 1].min()
    check(vertices, triangles)
    # Blue lacquer under sand: opposite hues, so that dust is told from light.
    dusty = glb.matte("dusty", (0.001, 0.02, 0.062), 0.3, sheen_color=(0.56, 0.4, 0.2), sheen_roughness=0.85)
    parts = [
        glb.Part("sculpture", vertices, normals, triangles, dusty),
        glb.Part("plinth", *plinth(), glb.matte("plinth", (0.09, 0.086, 0.082), 0.6)),
        *photo_set(),
    ]
    camera = glb.Camera((0.0, 1.0, 4.4), (0.0, 0.55, 0.0), np.radians(18.0))
    size = glb.write(path, parts, camera, "assets/dust.py")
    glb.verify(path, MIDDLE)
    print(f"{path}: {size} bytes", file=sys.stderr)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).with_name("dust.glb"))
