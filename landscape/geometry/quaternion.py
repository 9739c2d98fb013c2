"""Unit quaternions for rotations: products, vectors, angles, SLERP and SQUAD. No OpenGL.

A quaternion is an array (..., 4) of w, x, y, z. The unit quaternion cos(a) + v sin(a) turns by 2a
about the unit vector v, and so does its opposite (glSkel, quaternions). Angles are in radians
unless their names end in ``_deg``.

A product of two rotations takes 16 multiplications and 12 additions as quaternions, 27 and 18 as
matrices of 3 x 3. To turn many vectors by one rotation a matrix is better: 9 and 6 for each.
"""

from collections.abc import Sequence

import numpy as np

# Below this angle between two quaternions sin(angle) is too small to divide by; chosen.
NEARLY_EQUAL = 1e-4


def about(axis: tuple[float, float, float], angle: float) -> np.ndarray:
    """Return the rotation by ``angle`` about a unit vector."""
    return np.array([np.cos(angle / 2), *(np.sin(angle / 2) * np.array(axis))])


def product(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Return p q, the rotation q followed by p; p and q (..., 4)."""
    pw, pv = p[..., :1], p[..., 1:]
    qw, qv = q[..., :1], q[..., 1:]
    w = pw * qw - (pv * qv).sum(axis=-1, keepdims=True)
    return np.concatenate([w, pw * qv + qw * pv + np.cross(pv, qv)], axis=-1)


def turned(q: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """Return vectors (..., 3) turned by q: the vector part of q v q*."""
    w, v = q[..., :1], q[..., 1:]
    return np.asarray(vector + 2 * np.cross(v, np.cross(v, vector) + w * vector))


def from_axes(right: np.ndarray, up: np.ndarray, back: np.ndarray) -> np.ndarray:
    """Return the rotation that takes x, y, z to three perpendicular unit vectors (3,)."""
    m = np.stack([right, up, back], axis=1)
    # The largest of the four squares below is at least 1/4: its root is safe to divide by.
    squares = 1 + np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) @ np.diag(m)
    k = int(squares.argmax())
    products = {
        0: (squares[0], m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]),
        1: (m[2, 1] - m[1, 2], squares[1], m[1, 0] + m[0, 1], m[0, 2] + m[2, 0]),
        2: (m[0, 2] - m[2, 0], m[1, 0] + m[0, 1], squares[2], m[2, 1] + m[1, 2]),
        3: (m[1, 0] - m[0, 1], m[0, 2] + m[2, 0], m[2, 1] + m[1, 2], squares[3]),
    }
    return np.array(products[k]) / (2 * np.sqrt(squares[k]))


def looking(eye: np.ndarray, target: np.ndarray, up: np.ndarray) -> np.ndarray:
    """Return the orientation of a camera at ``eye`` (3,) that looks at ``target`` (3,).

    A camera's own axes are x to the right, y up, and z back towards the viewer. ``up`` (3,) may
    not be parallel to the line of sight.
    """
    back = (eye - target) / np.linalg.norm(eye - target)
    right = np.cross(up, back)
    right = right / np.linalg.norm(right)
    return from_axes(right, np.cross(back, right), back)


def from_angles(yaw_deg: float, pitch_deg: float, roll_deg: float) -> np.ndarray:
    """Return the orientation of a camera of these Euler angles, those of a Pose."""
    yaw, pitch, roll = np.radians([yaw_deg, pitch_deg, roll_deg])
    turn = product(about((0, 1, 0), -yaw), about((1, 0, 0), pitch))
    return product(turn, about((0, 0, 1), roll))


def to_angles(q: np.ndarray) -> tuple[float, float, float]:
    """Return the yaw, pitch and roll in degrees of a camera's orientation (4,).

    Where it looks straight up or down, yaw and roll turn about the same axis (gimbal lock): then
    the yaw is 0.
    """
    ahead, right = turned(q, np.array([0.0, 0, -1])), turned(q, np.array([1.0, 0, 0]))
    pitch = np.arcsin(np.clip(ahead[1], -1, 1))
    yaw = 0.0 if np.hypot(ahead[0], ahead[2]) < 1e-9 else np.arctan2(ahead[0], -ahead[2])
    level = np.array([np.cos(yaw), 0, np.sin(yaw)])
    roll = np.arctan2(right @ np.cross(level, ahead), right @ level)
    return float(np.degrees(yaw)), float(np.degrees(pitch)), float(np.degrees(roll))


def slerp(p: np.ndarray, q: np.ndarray, t: float, short: bool = True) -> np.ndarray:
    """Return the rotation between p and q (4,) at t in 0..1, at constant speed (Shoemake 1985).

    SLERP(p, q, t) = (p sin((1-t)a) + q sin(ta)) / sin(a), where a is the angle between p and q as
    vectors of four numbers. q and -q are the same rotation: ``short`` takes the one nearer to p,
    and the camera never turns by more than half a circle. Nearly equal ones are interpolated in a
    straight line. Opposite ones, without ``short``, have many arcs between them: one is chosen.
    """
    cosine = float(p @ q)
    if short and cosine < 0.0:
        q, cosine = -q, -cosine
    angle = np.arccos(np.clip(cosine, -1.0, 1.0))
    if angle < NEARLY_EQUAL:
        straight = (1 - t) * p + t * q
        return np.asarray(straight / np.linalg.norm(straight))
    if np.pi - angle < NEARLY_EQUAL:
        # Perpendicular to p, so that the arc from p over it to -p is half a circle.
        across = np.array([-p[1], p[0], -p[3], p[2]])
        return np.asarray(np.cos(np.pi * t) * p + np.sin(np.pi * t) * across)

    return np.asarray((p * np.sin((1 - t) * angle) + q * np.sin(t * angle)) / np.sin(angle))


def logarithm(q: np.ndarray) -> np.ndarray:
    """Return the logarithm of a unit quaternion (4,): the vector (3,) v a of cos(a) + v sin(a)."""
    sine = float(np.linalg.norm(q[1:]))
    if sine < NEARLY_EQUAL**2:
        return np.zeros(3)
    return np.asarray(np.arctan2(sine, q[0]) / sine * q[1:])


def exponential(vector: np.ndarray) -> np.ndarray:
    """Return the unit quaternion (4,) whose logarithm is a vector (3,)."""
    angle = float(np.linalg.norm(vector))
    if angle < NEARLY_EQUAL**2:
        return np.array([1.0, 0.0, 0.0, 0.0])
    return np.array([np.cos(angle), *(np.sin(angle) / angle * vector)])


def control(before: np.ndarray, here: np.ndarray, after: np.ndarray) -> np.ndarray:
    """Return the control point (4,) of SQUAD at a key between two others (Shoemake 1987).

    s = q exp(-(log(q* after) + log(q* before)) / 4), where q* is the inverse of q.
    """
    inverse = here * (1, -1, -1, -1)
    bend = logarithm(product(inverse, after)) + logarithm(product(inverse, before))
    return product(here, exponential(-bend / 4))


def squad(keys: Sequence[np.ndarray], t: float) -> np.ndarray:
    """Return the rotation at t in 0..1 between the middle two of four keys (4,), smooth at them.

    The spherical cubic between p and q with control points a and b is the SLERP, at 2 t (1 - t), of
    SLERP(p, q, t) and SLERP(a, b, t). Where keys follow each other at equal times, angular velocity
    is continuous at each: SLERP alone changes it there at once. Each key may be given as q or -q:
    the one nearer to the key before is taken.
    """
    near = [keys[0]]
    for key in keys[1:]:
        near.append(key if near[-1] @ key >= 0.0 else -key)
    before, p, q, after = near
    outer = slerp(p, q, t, short=False)
    inner = slerp(control(before, p, q), control(p, q, after), t, short=False)
    return slerp(outer, inner, 2 * t * (1 - t), short=False)
