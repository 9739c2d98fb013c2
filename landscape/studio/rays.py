"""Rays against triangles: a tree of boxes, for the studio's baked light (compiled by numba)."""

import numpy as np
from numba import njit

LEAF = 4  # chosen: most triangles in a leaf of the tree
FAR = 1e9  # length of a ray that has no end


def tree(corners: np.ndarray) -> tuple[np.ndarray, ...]:
    """Return a tree of boxes over triangles ``corners`` (n, 3, 3), and the order of its leaves.

    Boxes (m, 6): lows and highs; nodes (m, 2): a leaf's first place in the order and its count, or
    the number of the second child (the first follows its parent) and 0.
    """
    low, high = corners.min(axis=1), corners.max(axis=1)
    centres = (low + high) / 2
    order = np.arange(len(corners))
    boxes: list[np.ndarray] = []
    nodes: list[list[int]] = []
    stack = [(0, len(corners), -1)]
    while stack:
        first, end, parent = stack.pop()
        number = len(nodes)
        if parent >= 0:
            nodes[parent][0] = number
        here = order[first:end]
        boxes.append(np.concatenate([low[here].min(axis=0), high[here].max(axis=0)]))
        if end - first <= LEAF:
            nodes.append([first, end - first])
            continue
        spread = centres[here].max(axis=0) - centres[here].min(axis=0)
        order[first:end] = here[np.argsort(centres[here, int(spread.argmax())], kind="stable")]
        middle = (first + end) // 2
        nodes.append([0, 0])
        # The first child is popped next; the second one writes its number into the parent.
        stack.append((middle, end, number))
        stack.append((first, middle, -1))

    return np.array(boxes), np.array(nodes, np.int64), order


@njit(inline="always")
def _enters(box, ox, oy, oz, ix, iy, iz, far):  # type: ignore[no-untyped-def]
    """Return whether a ray from o with inverse direction i meets a box before ``far``."""
    a, b = (box[0] - ox) * ix, (box[3] - ox) * ix
    near, end = min(a, b), max(a, b)
    a, b = (box[1] - oy) * iy, (box[4] - oy) * iy
    near, end = max(near, min(a, b)), min(end, max(a, b))
    a, b = (box[2] - oz) * iz, (box[5] - oz) * iz
    near, end = max(near, min(a, b)), min(end, max(a, b))
    return end >= max(near, 0.0) and near < far


@njit
def hit(scene, o, d, far, nearest):  # type: ignore[no-untyped-def]
    """Return triangle (-1: none), distance and barycentric u, v of what a ray from o along d meets.

    ``nearest`` false: of any triangle before ``far``.
    """
    boxes, nodes, v0, e1, e2 = scene
    ix = 1.0 / d[0] if abs(d[0]) > 1e-12 else 1e12
    iy = 1.0 / d[1] if abs(d[1]) > 1e-12 else 1e12
    iz = 1.0 / d[2] if abs(d[2]) > 1e-12 else 1e12
    stack = np.empty(64, np.int64)
    count = 1
    found = -1
    best_u = 0.0
    best_v = 0.0
    stack[0] = 0
    while count > 0:
        count -= 1
        node = stack[count]
        if not _enters(boxes[node], o[0], o[1], o[2], ix, iy, iz, far):
            continue
        if nodes[node, 1] == 0:
            stack[count] = nodes[node, 0]
            stack[count + 1] = node + 1
            count += 2
            continue
        for k in range(nodes[node, 0], nodes[node, 0] + nodes[node, 1]):
            px = d[1] * e2[k, 2] - d[2] * e2[k, 1]
            py = d[2] * e2[k, 0] - d[0] * e2[k, 2]
            pz = d[0] * e2[k, 1] - d[1] * e2[k, 0]
            det = e1[k, 0] * px + e1[k, 1] * py + e1[k, 2] * pz
            if abs(det) < 1e-14:
                continue
            tx = o[0] - v0[k, 0]
            ty = o[1] - v0[k, 1]
            tz = o[2] - v0[k, 2]
            u = (tx * px + ty * py + tz * pz) / det
            if u < 0.0 or u > 1.0:
                continue
            qx = ty * e1[k, 2] - tz * e1[k, 1]
            qy = tz * e1[k, 0] - tx * e1[k, 2]
            qz = 0.0
            qz = tx * e1[k, 1] - ty * e1[k, 0]
            v = (d[0] * qx + d[1] * qy + d[2] * qz) / det
            if v < 0.0 or u + v > 1.0:
                continue
            t = (e2[k, 0] * qx + e2[k, 1] * qy + e2[k, 2] * qz) / det
            if 0.0 < t < far:
                far = t
                found = k
                best_u = u
                best_v = v
                if not nearest:
                    return found, far, best_u, best_v

    return found, far, best_u, best_v
