"""Makes drape.glb: a round velvet cloth that fell over a ball on a column. See README.md beside this file.

    python drape.py [OUT.glb]
"""

import sys
from pathlib import Path

import numpy as np

import cloth
import glb

# The form: a ball on a round column, hidden by the cloth (centre x, y, z, radius, radius of the column; metres).
BALL = (0.0, 0.86, 0.0, 0.27, 0.12)
HALF_WIDTH = 1.325
ROUNDNESS = 0.8
TURN = np.radians(27.0)
OFFSET = (0.02, -0.03)
COARSE = 101

FABRIC = cloth.Fabric(bending=1e-4, viscosity=40.0)
# Seconds, substep, drag: the fall, then with every cell split in four the folds' finer shape, then rest.
FALL, SETTLE, REST = (3.0, 1e-3, 2.0), (0.6, 5e-4, 1.5), (0.4, 5e-4, 30.0)


def flat_cloth(n):
    """The cloth before it falls, n x n x 2: a square whose corners are drawn in towards its inscribed circle, which ROUNDNESS 1
    would reach (the elliptical grid mapping)."""
    u, v = np.meshgrid(np.linspace(-1, 1, n), np.linspace(-1, 1, n), indexing="ij")
    flat = HALF_WIDTH * np.stack([u * np.sqrt(1 - ROUNDNESS * v**2 / 2), v * np.sqrt(1 - ROUNDNESS * u**2 / 2)], axis=-1)
    c, s = np.cos(TURN), np.sin(TURN)
    return flat @ np.array([[c, -s], [s, c]])


def fall():
    """The vertices of the cloth at rest on the form, and its flat shape."""
    form = np.array([BALL])
    flat = flat_cloth(COARSE)
    x, z = flat[..., 0] + OFFSET[0], flat[..., 1] + OFFSET[1]
    # Ripples of millimetres, as no cloth is laid quite flat: without them the folds would be symmetric.
    y = BALL[1] + BALL[3] + 0.015 + 0.004 * np.sin(3.1 * x + 1.7 * z + 0.4) + 0.003 * np.sin(5.3 * z - 2.9 * x + 1.1)
    vertices = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    velocity = np.zeros_like(vertices)
    fabric = FABRIC
    for stage, (seconds, dt, drag) in enumerate((FALL, SETTLE, REST)):
        if stage == 1:
            vertices, velocity = cloth.refine(vertices, COARSE), cloth.refine(velocity, COARSE)
            flat = flat_cloth(2 * COARSE - 1)
        fabric.drag = drag
        cloth.drop(vertices, velocity, flat, form, fabric, seconds, dt)
        print(f"{len(vertices)} vertices, {seconds} s: mean speed {np.abs(velocity).mean():.4f} m/s", file=sys.stderr)
    return vertices, flat


def check(vertices, flat, triangles):
    """What the scene must hold; the figures stand in README.md."""
    grid = vertices.reshape(*flat.shape[:2], 3)
    strain = np.concatenate([
        (np.linalg.norm(np.diff(grid, axis=k), axis=-1) / np.linalg.norm(np.diff(flat, axis=k), axis=-1) - 1).ravel()
        for k in (0, 1)
    ])
    distance = np.array([cloth.form_distance(p, np.array([BALL]))[0] for p in vertices])
    print(f"triangles {len(triangles)}, clearance {1e3 * distance.min():.2f} mm, "
          f"strain mean {np.abs(strain).mean():.4f}, range {strain.min():.3f} to {strain.max():.3f}", file=sys.stderr)
    assert len(triangles) >= 30_000
    assert distance.min() > 0.002, "the cloth touches the form or the floor"
    assert np.abs(strain).mean() < 0.02 and np.abs(strain).max() < 0.3, "the cloth is stretched"


def main(path):
    vertices, flat = fall()
    n = len(flat)
    triangles = glb.grid_triangles(n, n)[:, ::-1]
    normals = glb.vertex_normals(vertices, triangles)
    check(vertices, flat, triangles)
    velvet = glb.matte("velvet", (0.11, 0.006, 0.016), 1.0, (0.95, 0.16, 0.24), 0.35, double_sided=True)
    floor = glb.matte("floor", (0.11, 0.1, 0.1))
    middle = (0.0, 0.7, 0.0)
    parts = [
        glb.Part("cloth", vertices, normals, triangles, velvet),
        glb.Part("floor", *glb.backdrop(8.0, 6.0, -3.2, 6.0, 1.6), floor),
        glb.polygon_light("key", glb.rectangle(1.4, 1.0), (44.0, 36.0, 28.0), (-2.1, 2.5, 1.9), middle),
        glb.polygon_light("rim", glb.regular_polygon(6, 0.5), (40.0, 52.0, 75.0), (1.75, 1.75, -1.5), middle),
    ]
    camera = glb.Camera((0.0, 1.15, 4.6), (0.0, 0.62, 0.0), np.radians(19.0))
    size = glb.write(path, parts, camera, "assets/drape.py")
    assert size < 2_000_000
    print(f"{path}: {size} bytes", file=sys.stderr)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).with_name("drape.glb"))
