"""Makes drape.glb: a velvet cloth that fell over a ball on a column, on a photographer's set. See README.md beside this file.

    python drape.py [OUT.glb]
"""

import sys
from pathlib import Path

import numpy as np

import cloth
import glb

# The form: a ball on a round column, hidden by the cloth (centre x, y, z, radius, radius of the column; metres).
BALL_TOP, FORM = 1.08, np.array([(0.0, 0.72, 0.0, 0.36, 0.12)])
# The cloth, flat: half its width, how round its corners are, how it is turned and where it is laid.
HALF_WIDTH = 1.36
ROUNDNESS = 0.7
TURN = np.radians(27.0)
OFFSET = (0.02, -0.03)
# What the lamps are turned to.
MIDDLE = (0.0, 0.5, 0.0)
# Vertices along each side during the fall.
COARSE = 101
SMOOTHING_PASSES = 1

# Seconds, substep, drag: for the fall; then, with every cell split in four, for the folds' finer shape; then for coming
# to rest.
FALL, SETTLE, REST = (3.0, 1e-3, 2.0), (0.6, 5e-4, 1.5), (0.4, 5e-4, 30.0)


def flat_cloth(n):
    """The cloth before it falls, n x n x 2: a square whose corners are drawn in towards its inscribed circle, which ROUNDNESS 1
    would reach (the elliptical grid mapping)."""
    u, v = np.meshgrid(np.linspace(-1, 1, n), np.linspace(-1, 1, n), indexing="ij")
    flat = HALF_WIDTH * np.stack([u * np.sqrt(1 - ROUNDNESS * v**2 / 2), v * np.sqrt(1 - ROUNDNESS * u**2 / 2)], axis=-1)
    c, s = np.cos(TURN), np.sin(TURN)
    return flat @ np.array([[c, -s], [s, c]])


def fall():
    """The vertices of the cloth at rest on the form, and its flat shape (n x n x 2)."""
    flat = flat_cloth(COARSE)
    x, z = flat[..., 0] + OFFSET[0], flat[..., 1] + OFFSET[1]
    # Ripples of millimetres, as no cloth is laid quite flat: without them the folds would be symmetric.
    y = BALL_TOP + 0.015 + 0.004 * np.sin(3.1 * x + 1.7 * z + 0.4) + 0.003 * np.sin(5.3 * z - 2.9 * x + 1.1)
    vertices = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    velocity = np.zeros_like(vertices)
    for stage, (seconds, dt, drag) in enumerate((FALL, SETTLE, REST)):
        if stage == 1:
            vertices, velocity = cloth.refine(vertices, COARSE), cloth.refine(velocity, COARSE)
            flat = flat_cloth(2 * COARSE - 1)
        cloth.drop(vertices, velocity, flat, FORM, cloth.Fabric(drag=drag), seconds, dt)
        print(f"{len(vertices)} vertices, {seconds} s: mean speed {np.abs(velocity).mean():.4f} m/s", file=sys.stderr)
    return vertices, flat


def fold_lines(vertices, flat):
    """For each cell, whether its diagonal from (i, j) to (i+1, j+1) is the one that has kept more of its length: it lies along the
    fold, where the other would cut a notch into it."""
    grid = vertices.reshape(*flat.shape[:2], 3)

    def kept(one, other):
        return np.linalg.norm(one(grid) - other(grid), axis=-1) / np.linalg.norm(one(flat) - other(flat), axis=-1)

    falling = kept(lambda p: p[:-1, :-1], lambda p: p[1:, 1:])
    return falling >= kept(lambda p: p[1:, :-1], lambda p: p[:-1, 1:])


def check(vertices, flat, triangles):
    """What the cloth must hold; the figures stand in README.md."""
    grid = vertices.reshape(*flat.shape[:2], 3)
    strain = np.concatenate([
        (np.linalg.norm(np.diff(grid, axis=k), axis=-1) / np.linalg.norm(np.diff(flat, axis=k), axis=-1) - 1).ravel()
        for k in (0, 1)
    ])
    corners = vertices[triangles]
    edges = corners - np.roll(corners, 1, axis=1)
    # Vertices, middles of edges, middles of triangles.
    points = np.concatenate([vertices, (corners - edges / 2).reshape(-1, 3), corners.mean(axis=1)])
    clearance = min(cloth.form_distance(p, FORM)[0] for p in points)
    longest = np.linalg.norm(edges, axis=-1).max()
    crossings = cloth.count_crossings(vertices, triangles, flat.reshape(-1, 2), longest)
    print(
        f"triangles {len(triangles)}, least clearance {1e3 * clearance:.2f} mm, crossings {crossings}, longest edge "
        f"{1e3 * longest:.1f} mm, strain: mean {np.abs(strain).mean():.4f}, from {strain.min():.3f} to {strain.max():.3f}",
        file=sys.stderr,
    )
    assert len(triangles) >= 30_000
    assert clearance > 0.004, "the cloth touches the form or the floor"
    assert crossings == 0, "the cloth passes through itself"
    assert np.abs(strain).mean() < 0.01 and np.abs(strain).max() < 0.25, "the cloth is stretched"


def photo_set():
    """The sweep and its three lamps, all of them outside the picture."""
    floor = glb.matte("floor", (0.054, 0.0475, 0.044))
    return [
        glb.Part("floor", *glb.backdrop(half_width=9.0, front=7.0, rear=-4.5, height=7.0, radius=3.2), floor),
        # A warm softbox at the left, whose shadow falls to the right; a hexagon above the camera, which looks into the folds; a
        # cool panel high up behind. It looks down rather than forward, so that the plane it lies in, where its light ends,
        # meets the sweep at the picture's upper edge.
        glb.polygon_light("key", glb.rectangle(1.0, 1.3), (180.0, 162.0, 139.0), (-2.6, 2.6, 0.6), MIDDLE),
        glb.polygon_light("fill", glb.regular_polygon(6, 1.2), (7.0, 7.6, 8.8), (1.0, 1.6, 5.2), MIDDLE),
        glb.polygon_light("rim", glb.rectangle(1.1, 0.5), (74.0, 80.0, 95.0), (1.5, 1.95, -1.2), (0.8, 0.0, -0.25)),
    ]


def main(path):
    vertices, flat = fall()
    n = len(flat)
    normals = glb.vertex_normals(vertices, glb.grid_triangles(n, n))
    vertices = cloth.smooth(vertices, normals, n, SMOOTHING_PASSES)
    cloth.lift(vertices, FORM, cloth.Fabric.clearance)
    # Reversed, so that the upper side is the front.
    triangles = glb.grid_triangles(n, n, falling=fold_lines(vertices, flat))[:, ::-1]
    check(vertices, flat, triangles)
    # A cool base and a warm sheen: what alpha does is a change of hue, not only of brightness.
    velvet = glb.matte("velvet", (0.002, 0.038, 0.052), 1.0, sheen_color=(0.95, 0.48, 0.36), sheen_roughness=0.4, double_sided=True)
    parts = [glb.Part("cloth", vertices, glb.vertex_normals(vertices, triangles), triangles, velvet), *photo_set()]
    camera = glb.Camera((0.0, 1.1, 4.6), (0.0, 0.515, 0.0), np.radians(18.2))
    size = glb.write(path, parts, camera, "assets/drape.py")
    glb.verify(path, MIDDLE)
    print(f"{path}: {size} bytes", file=sys.stderr)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).with_name("drape.glb"))
