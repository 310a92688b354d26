"""A cloth that falls on a form: extended position based dynamics on a square grid, in small steps.

Method: Macklin, Mueller, Chentanez 2016 (compliant constraints) and Macklin et al. 2019 (one iteration a substep). The cloth is
a sheet of given areal density; stretch and shear are springs along the grid's edges and diagonals, bending is the
quadratic energy of the second difference along rows and columns, contacts are inequality constraints with Coulomb friction.
Everything is sequential and in one order, so that the result is the same each time it is run on one machine.
"""

from dataclasses import dataclass

import numpy as np
from numba import njit

GRAVITY = 9.81
# How near layers may come to each other, in cells: well over a cell's half diagonal (0.71), so that no vertex slips
# through between others.
GAP = 0.85
# Two neighbouring cells may fold until they span this part of their length, a turn of 2 acos(0.85) = 64 degrees between
# them.
SHARPEST = 0.85


@dataclass
class Fabric:
    """A middling velvet; its bending length (bending / (density g))^(1/3) is 2.7 cm."""

    density: float = 0.4  # kg/m2
    stretch: float = 1500.0  # N/m
    shear: float = 15.0  # N/m
    bending: float = 8e-5  # N m
    friction_form: float = 0.5
    friction_self: float = 0.3
    drag: float = 1.5  # of the air, 1/s
    viscosity: float = 20.0  # the rate at which neighbours share their velocity, 1/s
    clearance: float = 0.006  # of the sheet's middle from the form, m


@njit
def form_distance(p, balls):
    """Signed distance to the form, and its unit gradient: the union of the floor and of balls on round columns, each a row
    (centre x, y, z, radius, radius of the column)."""
    distance, nx, ny, nz = p[1], 0.0, 1.0, 0.0
    for ball in balls:
        dx, dy, dz = p[0] - ball[0], p[1] - ball[1], p[2] - ball[2]
        length = np.sqrt(dx * dx + dy * dy + dz * dz)
        if length - ball[3] < distance:
            distance = length - ball[3]
            nx, ny, nz = dx / length, dy / length, dz / length
        across = np.sqrt(dx * dx + dz * dz)
        if dy < 0.0 and across - ball[4] < distance:
            distance = across - ball[4]
            nx, ny, nz = dx / across, 0.0, dz / across
    return distance, nx, ny, nz


@njit
def distance_constraint(x, a, b, rest, weight, softness):
    dx, dy, dz = x[a, 0] - x[b, 0], x[a, 1] - x[b, 1], x[a, 2] - x[b, 2]
    length = np.sqrt(dx * dx + dy * dy + dz * dz)
    if length > 0.0:
        s = -(length - rest) / (2.0 * weight + softness) * weight / length
        x[a, 0] += s * dx
        x[a, 1] += s * dy
        x[a, 2] += s * dz
        x[b, 0] -= s * dx
        x[b, 1] -= s * dy
        x[b, 2] -= s * dz


@njit
def bend_constraint(x, a, m, b, weight, softness):
    s = -weight / (1.5 * weight + softness)
    for k in range(3):
        d = s * (0.5 * (x[a, k] + x[b, k]) - x[m, k])
        x[a, k] += 0.5 * d
        x[b, k] += 0.5 * d
        x[m, k] -= d


@njit
def crease_constraint(x, a, b, least):
    """Two vertices with one between them stay `least` apart: velvet doesn't fold to a knife's edge."""
    dx, dy, dz = x[a, 0] - x[b, 0], x[a, 1] - x[b, 1], x[a, 2] - x[b, 2]
    length = np.sqrt(dx * dx + dy * dy + dz * dz)
    if 0.0 < length < least:
        s = 0.5 * (least - length) / length
        x[a, 0] += s * dx
        x[a, 1] += s * dy
        x[a, 2] += s * dz
        x[b, 0] -= s * dx
        x[b, 1] -= s * dy
        x[b, 2] -= s * dz


@njit
def internal_forces(x, rest, n, weight, soft_stretch, soft_shear, soft_bend):
    """One pass over all constraints, in colours: those of a colour share no vertex. In the order of the grid instead, a pass
    would carry errors across the whole sheet, and shake its corners."""
    for colour in range(3):
        for i in range(n):
            for j in range(1 + colour, n - 1, 3):
                v = i * n + j
                bend_constraint(x, v - 1, v, v + 1, weight, soft_bend)
                crease_constraint(x, v - 1, v + 1, SHARPEST * (rest[0, v - 1] + rest[0, v]))
        for i in range(1 + colour, n - 1, 3):
            for j in range(n):
                v = i * n + j
                bend_constraint(x, v - n, v, v + n, weight, soft_bend)
                crease_constraint(x, v - n, v + n, SHARPEST * (rest[1, v - n] + rest[1, v]))
    for colour in range(2):
        for i in range(colour, n - 1, 2):
            for j in range(n - 1):
                v = i * n + j
                distance_constraint(x, v, v + n + 1, rest[3, v], weight, soft_shear)
        for i in range(colour, n - 1, 2):
            for j in range(n - 1):
                v = i * n + j
                distance_constraint(x, v + 1, v + n, rest[2, v], weight, soft_shear)
    for colour in range(2):
        for i in range(colour, n - 1, 2):
            for j in range(n):
                v = i * n + j
                distance_constraint(x, v, v + n, rest[1, v], weight, soft_stretch)
        for i in range(n):
            for j in range(colour, n - 1, 2):
                v = i * n + j
                distance_constraint(x, v, v + 1, rest[0, v], weight, soft_stretch)


@njit
def near_pairs(x, flat, reach, apart):
    """Pairs of vertices nearer than `reach` that lie more than `apart` from each other in the flat sheet, by a hash grid."""
    count = len(x)
    buckets = 1 << 16
    cell = np.empty((count, 3), np.int64)
    key = np.empty(count, np.int64)
    start = np.zeros(buckets + 1, np.int64)
    for v in range(count):
        for k in range(3):
            cell[v, k] = np.int64(np.floor(x[v, k] / reach))
        key[v] = ((cell[v, 0] * 73856093) ^ (cell[v, 1] * 19349663) ^ (cell[v, 2] * 83492791)) & (buckets - 1)
        start[key[v] + 1] += 1
    for b in range(buckets):
        start[b + 1] += start[b]
    fill = start.copy()
    order = np.empty(count, np.int64)
    for v in range(count):
        order[fill[key[v]]] = v
        fill[key[v]] += 1
    pairs = np.empty((count * 64, 2), np.int32)
    found = 0
    for v in range(count):
        for dx in range(-1, 2):
            for dy in range(-1, 2):
                for dz in range(-1, 2):
                    cx, cy, cz = cell[v, 0] + dx, cell[v, 1] + dy, cell[v, 2] + dz
                    k = ((cx * 73856093) ^ (cy * 19349663) ^ (cz * 83492791)) & (buckets - 1)
                    for s in range(start[k], start[k + 1]):
                        u = order[s]
                        if u <= v or cell[u, 0] != cx or cell[u, 1] != cy or cell[u, 2] != cz:
                            continue
                        if (flat[u, 0] - flat[v, 0]) ** 2 + (flat[u, 1] - flat[v, 1]) ** 2 < apart * apart:
                            continue
                        d = 0.0
                        for c in range(3):
                            d += (x[u, c] - x[v, c]) ** 2
                        if d < reach * reach:
                            if found == len(pairs):
                                raise RuntimeError("more pairs than there is room for")
                            pairs[found, 0] = v
                            pairs[found, 1] = u
                            found += 1
    return pairs[:found]


@njit
def separate(x, before, pairs, gap, friction, widest):
    """Keeps each pair `gap` apart, and takes part of its sliding since `before` away. A pair that was nearer before may not come
    nearer still, and parts by at most `widest` in a step: pushed out at once it would fly off."""
    for k in range(len(pairs)):
        a, b = pairs[k, 0], pairs[k, 1]
        dx, dy, dz = x[a, 0] - x[b, 0], x[a, 1] - x[b, 1], x[a, 2] - x[b, 2]
        length = np.sqrt(dx * dx + dy * dy + dz * dz)
        if length >= gap or length == 0.0:
            continue
        past = 0.0
        for c in range(3):
            past += (before[a, c] - before[b, c]) ** 2
        depth = min(gap, np.sqrt(past) + widest) - length
        if depth <= 0.0:
            continue
        nx, ny, nz = dx / length, dy / length, dz / length
        sx = dx - (before[a, 0] - before[b, 0])
        sy = dy - (before[a, 1] - before[b, 1])
        sz = dz - (before[a, 2] - before[b, 2])
        along = sx * nx + sy * ny + sz * nz
        sx, sy, sz = sx - along * nx, sy - along * ny, sz - along * nz
        slide = np.sqrt(sx * sx + sy * sy + sz * sz)
        f = min(1.0, friction * depth / slide) if slide > 0.0 else 0.0
        for c, push in enumerate((0.5 * (depth * nx - f * sx), 0.5 * (depth * ny - f * sy), 0.5 * (depth * nz - f * sz))):
            x[a, c] += push
            x[b, c] -= push


@njit
def rest_on_form(x, before, form, clearance, friction):
    for v in range(len(x)):
        distance, nx, ny, nz = form_distance(x[v], form)
        depth = clearance - distance
        if depth <= 0.0:
            continue
        sx, sy, sz = x[v, 0] - before[v, 0], x[v, 1] - before[v, 1], x[v, 2] - before[v, 2]
        along = sx * nx + sy * ny + sz * nz
        sx, sy, sz = sx - along * nx, sy - along * ny, sz - along * nz
        slide = np.sqrt(sx * sx + sy * sy + sz * sz)
        f = min(1.0, friction * depth / slide) if slide > 0.0 else 0.0
        x[v, 0] += depth * nx - f * sx
        x[v, 1] += depth * ny - f * sy
        x[v, 2] += depth * nz - f * sz


@njit
def share_velocity(velocity, n, part):
    """Each pair of neighbours gives the other `part` of their difference: the sheet's inner friction; momentum is kept."""
    for v in range(n * n):
        for other in (v + 1 if v % n + 1 < n else v, v + n if v + n < n * n else v):
            for c in range(3):
                d = part * (velocity[other, c] - velocity[v, c])
                velocity[v, c] += d
                velocity[other, c] -= d


@njit
def calm_contacts(x, velocity, pairs, gap):
    """Layers that lie on each other share a fifth of the difference of their velocities: cloth doesn't bounce off cloth."""
    for k in range(len(pairs)):
        a, b = pairs[k, 0], pairs[k, 1]
        d = 0.0
        for c in range(3):
            d += (x[a, c] - x[b, c]) ** 2
        if d < 1.1 * gap * gap:
            for c in range(3):
                part = 0.2 * (velocity[b, c] - velocity[a, c])
                velocity[a, c] += part
                velocity[b, c] -= part


@njit
def advance(
    x, velocity, flat, rest, n, h, dt, steps, form, density, stretch, shear, bending, gap, frictions, drag, viscosity, clearance
):
    """`steps` substeps of length `dt`, in place."""
    weight = 1.0 / (density * h * h)
    soft_stretch, soft_shear = 1.0 / (stretch * dt * dt), 1.0 / (shear * dt * dt)
    soft_bend = h * h / (4.0 * bending * dt * dt)
    keep = np.exp(-drag * dt)
    limit = 0.25 * gap / dt
    before = x.copy()
    pairs = near_pairs(x, flat, 1.6 * gap, 3.0 * gap)
    for step in range(steps):
        if step % 8 == 0:
            pairs = near_pairs(x, flat, 1.6 * gap, 3.0 * gap)
        for v in range(len(x)):
            velocity[v, 1] -= GRAVITY * dt
            speed = np.sqrt(velocity[v, 0] ** 2 + velocity[v, 1] ** 2 + velocity[v, 2] ** 2)
            scale = keep * (min(1.0, limit / speed) if speed > 0.0 else 1.0)
            for c in range(3):
                before[v, c] = x[v, c]
                velocity[v, c] *= scale
                x[v, c] += velocity[v, c] * dt
        internal_forces(x, rest, n, weight, soft_stretch, soft_shear, soft_bend)
        separate(x, before, pairs, gap, frictions[1], 0.1 * dt)
        rest_on_form(x, before, form, clearance, frictions[0])
        for v in range(len(x)):
            for c in range(3):
                velocity[v, c] = (x[v, c] - before[v, c]) / dt
        calm_contacts(x, velocity, pairs, gap)
        share_velocity(velocity, n, min(0.2, viscosity * dt))


def drop(x, velocity, flat, form, fabric, seconds, dt):
    """Lets the cloth move for `seconds`; `flat` is its n x n x 2 shape before it falls, whose lengths it keeps."""
    n = len(flat)
    rest = np.zeros((4, n, n))
    rest[0, :, :-1] = np.linalg.norm(flat[:, 1:] - flat[:, :-1], axis=-1)
    rest[1, :-1] = np.linalg.norm(flat[1:] - flat[:-1], axis=-1)
    rest[2, :-1, :-1] = np.linalg.norm(flat[1:, :-1] - flat[:-1, 1:], axis=-1)
    rest[3, :-1, :-1] = np.linalg.norm(flat[1:, 1:] - flat[:-1, :-1], axis=-1)
    h = rest[0, :, :-1].mean()
    advance(
        x, velocity, flat.reshape(-1, 2), rest.reshape(4, -1), n, h, dt, int(round(seconds / dt)), form,
        fabric.density, fabric.stretch, fabric.shear, fabric.bending, GAP * h,
        (fabric.friction_form, fabric.friction_self), fabric.drag, fabric.viscosity, fabric.clearance,
    )


def refine(values, n):
    """Twice as many cells each way: the four-point rule (-1, 9, 9, -1)/16 between vertices, quadratic at the border."""

    def along_first(v):
        padded = np.concatenate([3 * v[:1] - 3 * v[1:2] + v[2:3], v, 3 * v[-1:] - 3 * v[-2:-1] + v[-3:-2]])
        out = np.empty((2 * len(v) - 1, *v.shape[1:]))
        out[::2] = v
        out[1::2] = (9 * (padded[1:-2] + padded[2:-1]) - padded[:-3] - padded[3:]) / 16
        return out

    grid = values.reshape(n, n, 3)
    return along_first(along_first(grid).swapaxes(0, 1)).swapaxes(0, 1).reshape(-1, 3).copy()


def smooth(vertices, normals, n, passes):
    """Takes out ripples as fine as the grid and keeps what is wider: Taubin's pairs of Laplacian steps (1995) along rows and
    columns, of which the part along `normals` is taken, so that no vertex slides in the sheet."""
    grid = vertices.reshape(n, n, 3).copy()
    for step in (0.5, -0.52) * passes:
        for axis in (0, 1):
            g = np.moveaxis(grid, axis, 0)
            g[1:-1] += step * (0.5 * (g[:-2] + g[2:]) - g[1:-1])
    change = np.einsum("ij,ij->i", grid.reshape(-1, 3) - vertices, normals)
    return vertices + change[:, None] * normals


def lift(vertices, form, clearance):
    """Moves what is nearer to the form than `clearance` out to it."""
    rest_on_form(vertices, vertices.copy(), form, clearance, 0.0)


@njit
def crosses(p, q, a, b, c):
    """Whether the segment pq passes through the triangle abc (Moeller and Trumbore 1997)."""
    d, e, f = q - p, b - a, c - a
    h = np.cross(d, f)
    volume = (e * h).sum()
    if abs(volume) < 1e-18:
        return False
    s = p - a
    u = (s * h).sum() / volume
    if u < 0.0 or u > 1.0:
        return False
    k = np.cross(s, e)
    v = (d * k).sum() / volume
    if v < 0.0 or u + v > 1.0:
        return False
    t = (f * k).sum() / volume
    return 0.0 <= t <= 1.0


@njit
def count_crossings(x, triangles, flat, reach):
    """How many pairs of a grid edge and a triangle without a vertex in common pass through each other. No edge
    is longer than `reach`."""
    centres = np.empty((len(triangles), 3))
    flat_centres = np.empty((len(triangles), 2))
    for t in range(len(triangles)):
        for c in range(3):
            centres[t, c] = (x[triangles[t, 0], c] + x[triangles[t, 1], c] + x[triangles[t, 2], c]) / 3.0
        for c in range(2):
            flat_centres[t, c] = (flat[triangles[t, 0], c] + flat[triangles[t, 1], c] + flat[triangles[t, 2], c]) / 3.0
    # Two triangles that touch have centres within 4/3 of the longest edge of each other.
    pairs = near_pairs(centres, flat_centres, 4.0 / 3.0 * reach, 0.0)
    found = 0
    for k in range(len(pairs)):
        for one, other in ((pairs[k, 0], pairs[k, 1]), (pairs[k, 1], pairs[k, 0])):
            shared = False
            for i in range(3):
                for j in range(3):
                    shared = shared or triangles[one, i] == triangles[other, j]
            if shared:
                continue
            a, b, c = x[triangles[other, 0]], x[triangles[other, 1]], x[triangles[other, 2]]
            for i in range(3):
                found += crosses(x[triangles[one, i]], x[triangles[one, (i + 1) % 3]], a, b, c)
    return found
