"""The sword of the first-person view: five overlays, one at rest and four of a stroke.

The sword, the gauntlet and the forearm are one distance field, sphere traced (Hart 1996) with soft
shadows and ambient occlusion from the same field. The steel reflects a small analytic sky. The pose
is interpolated between key frames. A picture is the mean of many instants of the exposure, each
with its own sub-pixel offset, so one sum gives motion blur and antialiasing.
"""

import math
from collections.abc import Callable

import numpy as np
from numba import njit

from landscape.studio import images, light
from landscape.studio.shapes import clamp, ellipsoid, limb, mix, noise, step_smooth, union

SIZE = 512  # side of the overlay in texels
ASPECT = 1.5  # chosen: between 4:3 and 16:9, because the overlay is stretched over the window
TAN_HALF = 0.466  # chosen: tangent of half a field of view of 50 degrees
GAIN = 1.15  # chosen: exposure
OPACITY_BOOST = 1.6  # chosen: 1 is the motion blur of a camera

# Chosen: key frames of the pose. Columns: grip on the screen (x, y in -1..1, depth), direction of
# the blade, direction of its edge, elbow (view space: x right, y up, z towards the viewer).
KEYS = np.array(
    [
        # grip             blade                 edge                elbow
        (0.66, -0.54, 0.62, 0.03, 0.43, -0.62, 0.90, 0.10, 0.30, 0.46, -0.57, -0.24),  # rest
        (0.66, -0.26, 0.62, 0.42, 0.78, -0.10, 0.80, -0.40, 0.50, 0.46, -0.46, -0.22),  # raised
        (0.46, -0.16, 0.62, 0.05, 0.85, -0.45, 0.60, 0.20, 0.70, 0.42, -0.46, -0.22),  # start
        (0.06, -0.38, 0.62, -0.78, 0.26, -0.50, -0.30, -0.80, 0.30, 0.36, -0.50, -0.20),  # across
        (-0.26, -0.72, 0.60, -0.86, -0.26, -0.40, 0.10, -0.90, 0.40, 0.26, -0.52, -0.20),  # end
    ]
)

STEEL = 0
BRASS = 1
WRAP = 2
GLOVE = 3
CUFF = 4
SLEEVE = 5
TRIM = 6
# Chosen: linear albedo of each material.
ALBEDO = np.array(
    [
        (0.66, 0.67, 0.69),
        (0.66, 0.47, 0.19),
        (0.045, 0.022, 0.014),
        (0.040, 0.027, 0.020),
        (0.030, 0.017, 0.011),
        (0.055, 0.085, 0.075),
        (0.15, 0.085, 0.042),
    ]
)
GLOSS = np.array([1.0, 0.85, 0.10, 0.16, 0.16, 0.0, 0.10])  # chosen: specular weight


@njit
def _blade(x, y, z):  # type: ignore[no-untyped-def]
    """Return the distance to the blade: a tapering diamond section, fullered for two thirds."""
    t = (y - 0.095) / 0.72
    width = mix(0.030, 0.021, clamp(t, 0.0, 1.0)) * min(1.0, max(1.0 - t, 0.0) / 0.13) ** 0.7
    thick = mix(0.0066, 0.0044, clamp(t, 0.0, 1.0))
    width = max(width, 1e-4)
    rim = 0.45 * thick  # thickness where the flats end and the steeper ground edge begins
    flat = (abs(x) * (thick - rim) + abs(z) * width - width * thick) / math.hypot(
        width, thick - rim
    )
    ground = 0.26 * width
    edge = (abs(x) * rim * 1.6 + abs(z) * ground - width * rim * 1.6) / math.hypot(
        ground, rim * 1.6
    )
    depth = 0.0036 * (1.0 - step_smooth(0.60, 0.68, t))
    groove = 0.015 - math.sqrt(x * x + (abs(z) - thick - 0.015 + depth) ** 2)
    return max(flat, edge, groove, 0.092 - y, y - 0.815)


@njit
def _hilt(x, y, z):  # type: ignore[no-untyped-def]
    """Return the distance to the guard and the pommel."""
    a = abs(x)
    bow = 0.095 + 1.1 * a * a
    d = math.sqrt((y - bow) ** 2 + z * z) * 0.95 - mix(0.012, 0.0085, a / 0.1)
    d = max(d, a - 0.10)
    d = union(d, ellipsoid(a - 0.102, y - 0.107, z, 0.0145, 0.0145, 0.0145), 0.004)
    d = union(d, ellipsoid(x, y - 0.098, z, 0.032, 0.017, 0.017), 0.008)
    d = min(d, ellipsoid(x, y + 0.122, z, 0.027, 0.027, 0.020))
    return min(d, limb(x, y, z, 0.0, -0.098, 0.0, 0.017, 0.0, -0.104, 0.0, 0.017))


@njit
def _grip(x, y, z):  # type: ignore[no-untyped-def]
    """Return the distance to the handle, which is wrapped in a leather strap."""
    turns = y / 0.011 + math.atan2(z, x) / (2 * math.pi)
    f = turns - math.floor(turns) - 0.5
    d = math.sqrt(x * x + z * z) - 0.0165 - 0.0012 * (1.0 - 4 * f * f)
    return max(d * 0.8, abs(y) - 0.10)


@njit
def _polar(rho, degrees):  # type: ignore[no-untyped-def]
    """Return (x, z) on a circle around the grip: 0 degrees is right (x), 90 the viewer (z)."""
    return rho * math.cos(math.radians(degrees)), rho * math.sin(math.radians(degrees))


@njit
def _hand(x, y, z, wx, wy, wz):  # type: ignore[no-untyped-def]
    """Return the distance to the gloved right fist around the grip; (wx, wy, wz) is the wrist."""
    d = 1e9
    for k in range(4):
        fy = 0.060 - 0.0255 * k
        r = 0.0142 - 0.0006 * abs(k - 1.0)
        ax, az = _polar(0.050, -18.0)
        bx, bz = _polar(0.050 - 0.002 * k, -102.0)
        cx, cz = _polar(0.036, -172.0)
        ex, ez = _polar(0.030, -232.0)
        f = limb(x, y, z, ax, fy + 0.002, az, r * 1.12, bx, fy, bz, r)
        f = union(f, limb(x, y, z, bx, fy, bz, r * 1.05, cx, fy - 0.002, cz, r * 0.96), 0.005)
        f = union(f, limb(x, y, z, cx, fy - 0.002, cz, r, ex, fy - 0.004, ez, r * 0.9), 0.005)
        d = union(d, f, 0.0035)

    palm = 1e9
    for k in range(4):
        ax, az = _polar(0.050, -18.0)
        palm = union(
            palm, limb(x, y, z, wx, wy, wz, 0.026, ax, 0.062 - 0.0255 * k, az, 0.0155), 0.014
        )

    tx, tz = _polar(0.046, 78.0)
    palm = union(palm, limb(x, y, z, wx, wy, wz, 0.025, tx, 0.0, tz, 0.021), 0.02)
    d = union(d, palm, 0.008)
    jx, jz = _polar(0.043, 118.0)
    ex, ez = _polar(0.036, 166.0)
    thumb = limb(x, y, z, tx, 0.0, tz, 0.019, jx, 0.040, jz, 0.0155)
    thumb = union(thumb, limb(x, y, z, jx, 0.040, jz, 0.016, ex, 0.058, ez, 0.0135), 0.006)
    return union(d, thumb, 0.007)


@njit
def _nearer(d, m, other, n):  # type: ignore[no-untyped-def]
    if other < d:
        return other, n
    return d, m


@njit
def _scene(x, y, z, arm):  # type: ignore[no-untyped-def]
    """Return distance and material at a point in sword space (y along the blade, x to its edge).

    ``arm`` (8,): cosine and sine of the hand's rotation around the grip, wrist (3), elbow (3).
    """
    square = x * x + z * z
    far = math.sqrt(square + y * y)
    tall = y - clamp(y, 0.08, 0.82)
    d, m = math.sqrt(square + tall * tall) - 0.035, STEEL
    if d < 0.03:
        d = _blade(x, y, z)
    hx, hz = arm[0] * x + arm[1] * z, -arm[1] * x + arm[0] * z
    wx = arm[2]
    wy = arm[3]
    wz = arm[4]
    if far > 0.22:
        d = min(d, far - 0.16)
    else:
        d, m = _nearer(d, m, _hilt(x, y, z), BRASS)
        d, m = _nearer(d, m, _grip(x, y, z), WRAP)
        d, m = _nearer(d, m, _hand(hx, y, hz, wx, wy, wz), GLOVE)
        for k in range(4):
            sx, sz = _polar(0.0655 - 0.0006 * k, -26.0)
            stud = ellipsoid(hx - sx, y - 0.062 + 0.0255 * k, hz - sz, 0.0055, 0.0055, 0.0055)
            d, m = _nearer(d, m, stud, BRASS)

    ux = arm[5] - wx
    uy = arm[6] - wy
    uz = arm[7] - wz
    length = math.sqrt(ux * ux + uy * uy + uz * uz)
    ux = ux / length
    uy = uy / length
    uz = uz / length
    px = hx - wx
    py = y - wy
    pz = hz - wz
    along = px * ux + py * uy + pz * uz
    px = px - along * ux
    py = py - along * uy
    pz = pz - along * uz
    off = math.sqrt(px * px + py * py + pz * pz)
    if off > 0.10:
        return _nearer(d, m, off - 0.08, SLEEVE)

    # The angle around the arm, measured from the direction perpendicular to arm and sword.
    qx, qz = uz, -ux
    q = math.sqrt(qx * qx + qz * qz) + 1e-9
    qx, qz = qx / q, qz / q
    rx = uy * qz
    ry = uz * qx - ux * qz
    rz = -uy * qx
    angle = math.atan2(px * rx + py * ry + pz * rz, px * qx + pz * qz)
    flare = mix(0.036, 0.057, clamp(along / 0.15, 0.0, 1.0))
    crease = 0.0012 * math.sin(along * 260.0 + 1.5 * math.sin(2.0 * angle))
    crease *= step_smooth(0.015, 0.03, along) - step_smooth(0.06, 0.10, along)
    cuff = max(off - flare - crease, along - 0.158, -along) * 0.9
    d, m = _nearer(d, m, cuff, CUFF)
    for k in range(3):
        place = (0.150, 0.118, 0.010)[k]
        wide = (0.008, 0.0035, 0.009)[k]
        ring = max(off - flare - 0.0035, abs(along - place) - wide) * 0.9
        d, m = _nearer(d, m, ring, TRIM)

    turns = angle / (2 * math.pi) * 14.0
    around = (turns - math.floor(turns + 0.5)) * 2 * math.pi / 14.0 * flare
    rivet = ellipsoid(off - flare, along - 0.135, around, 0.005, 0.005, 0.005)
    d, m = _nearer(d, m, rivet * 0.8, BRASS)
    fold = 0.005 * noise(along * 30.0, 1.5 * math.cos(angle), 1.5 * math.sin(angle))
    sleeve = max(
        off - mix(0.046, 0.070, clamp((along - 0.12) / 0.4, 0.0, 1.0)) + fold, 0.14 - along
    )
    return _nearer(d, m, sleeve * 0.85, SLEEVE)


@njit
def _sky(x, y, z, sun):  # type: ignore[no-untyped-def]
    """Return the environment colour in a view-space direction: sky, horizon, dark land, sun."""
    up = step_smooth(-0.06, 0.10, y)
    glow = math.exp(-5.0 * abs(y))
    s = max(x * sun[0] + y * sun[1] + z * sun[2], 0.0)
    flare = 6.0 * s**90 + 0.55 * s**8
    side = 1.0 - 0.55 * x  # brighter on the side of the sun
    cloud = 0.5 + 0.5 * noise(3.0 * x + 7.0, 5.0 * y, 3.0 * z)
    r = mix(0.050, side * (mix(0.05, 0.80, glow) + 0.22 * cloud), up) + flare
    g = mix(0.055, side * (mix(0.07, 0.84, glow) + 0.22 * cloud), up) + 0.95 * flare
    b = mix(0.034, side * (mix(0.12, 0.88, glow) + 0.22 * cloud), up) + 0.86 * flare
    return r, g, b


@njit
def _shade(p, ray, frame, arm, m, sun, tables, out):  # type: ignore[no-untyped-def]
    """Write the linear colour of the surface point p seen along ``ray``, both in sword space."""
    albedo, gloss, sun_rgb, sky_rgb, bounce = tables
    x, y, z = p
    e = 0.0004
    nx = _scene(x + e, y, z, arm)[0] - _scene(x - e, y, z, arm)[0]
    ny = _scene(x, y + e, z, arm)[0] - _scene(x, y - e, z, arm)[0]
    nz = _scene(x, y, z + e, arm)[0] - _scene(x, y, z - e, arm)[0]
    rough = 0.0
    grain = 0.0
    if m >= WRAP:
        grain = noise(x * 330, y * 330, z * 330) + 0.7 * noise(x * 800, y * 800, z * 800)
        rough = 0.000028
    else:
        grain = noise(x * 900, y * 30, z * 900)
        rough = 0.00002

    if m == STEEL:
        nx *= 2.4  # hollow-ground look: the flats reflect different parts of the sky
    nx += rough * grain
    ny += rough * noise(x * 400 + 9, y * 400, z * 400)
    nz += rough * noise(x * 400, y * 400 + 9, z * 400)
    n = max(math.sqrt(nx * nx + ny * ny + nz * nz), 1e-12)
    nx = nx / n
    ny = ny / n
    nz = nz / n
    open_sky = 1.0
    for k in range(1, 5):
        h = 0.008 * k
        open_sky -= (h - _scene(x + nx * h, y + ny * h, z + nz * h, arm)[0]) * 22.0 / 2.0**k
    open_sky = clamp(open_sky, 0.15, 1.0)
    lit, t = 1.0, 0.004
    for _ in range(24):
        d = _scene(
            x + nx * 0.002 + sun[3] * t,
            y + ny * 0.002 + sun[4] * t,
            z + nz * 0.002 + sun[5] * t,
            arm,
        )[0]
        lit = min(lit, 14.0 * d / t)
        t += clamp(d, 0.004, 0.05)
        if lit < 0.0 or t > 0.5:
            break

    lit = clamp(lit, 0.0, 1.0)
    facing = max(nx * sun[3] + ny * sun[4] + nz * sun[5], 0.0) * lit
    back = nx * ray[0] + ny * ray[1] + nz * ray[2]
    rx = ray[0] - 2 * back * nx
    ry = ray[1] - 2 * back * ny
    rz = ray[2] - 2 * back * nz
    up = frame[0, 1] * nx + frame[1, 1] * ny + frame[2, 1] * nz
    vx = frame[0, 0] * rx + frame[1, 0] * ry + frame[2, 0] * rz
    vy = frame[0, 1] * rx + frame[1, 1] * ry + frame[2, 1] * rz
    vz = frame[0, 2] * rx + frame[1, 2] * ry + frame[2, 2] * rz
    mirror = _sky(vx, vy, vz, sun)
    fresnel = (1.0 - clamp(-back, 0.0, 1.0)) ** 5
    tone = 1.0 + (0.16 * grain if m >= WRAP else 0.05 * grain)
    thread = 0.0
    if m == GLOVE:
        # A seam with light stitches along the middle of each finger.
        f = (y - 0.0600) / 0.0255 - math.floor((y - 0.0600) / 0.0255 + 0.5)
        dash = math.sin(math.atan2(z, x) * 26.0)
        thread = math.exp(-((f / 0.045) ** 2)) * step_smooth(-0.3, 0.3, dash)
        thread *= 1.0 if x * arm[0] + z * arm[1] < 0.022 and y > -0.03 else 0.0

    for c in range(3):
        base = mix(albedo[m, c] * tone, albedo[TRIM, c], thread)
        ambient = mix(bounce[c], sky_rgb[c], 0.5 + 0.5 * up) * open_sky
        diffuse = base * (ambient + 2.1 * sun_rgb[c] * facing)
        shine = mirror[c] * mix(0.35, 1.0, lit) * mix(0.4, 1.0, open_sky)
        if m <= BRASS:
            tint = mix(albedo[m, c], 1.0, fresnel)
            out[c] = mix(diffuse, 1.35 * shine * tint, gloss[m])
        else:
            out[c] = diffuse + gloss[m] * shine * mix(0.12, 1.0, fresnel)


@njit
def _expose(frame, grip, arm, sun, offset, view, tables, image):  # type: ignore[no-untyped-def]
    """Add one instant to the premultiplied linear ``image`` (h, w, 4): one ray per texel."""
    h, w = image.shape[0], image.shape[1]
    eye = np.zeros(3)
    for i in range(3):
        for k in range(3):
            eye[i] -= frame[i, k] * grip[k]
    colour = np.zeros(3)

    for j in range(h):
        for i in range(w):
            sx = ((i + offset[0]) / w * 2 - 1) * view[0]
            sy = (1 - (j + offset[1]) / h * 2) * view[1]
            n = math.sqrt(sx * sx + sy * sy + 1.0)
            sx = sx / n
            sy = sy / n
            sz = -1.0 / n
            dx = frame[0, 0] * sx + frame[0, 1] * sy + frame[0, 2] * sz
            dy = frame[1, 0] * sx + frame[1, 1] * sy + frame[1, 2] * sz
            dz = frame[2, 0] * sx + frame[2, 1] * sy + frame[2, 2] * sz
            t = 0.12
            for _ in range(90):
                x = eye[0] + dx * t
                y = eye[1] + dy * t
                z = eye[2] + dz * t
                d, m = _scene(x, y, z, arm)
                if d < 0.0003:
                    _shade((x, y, z), (dx, dy, dz), frame, arm, m, sun, tables, colour)
                    for c in range(3):
                        image[j, i, c] += colour[c]
                    image[j, i, 3] += 1.0
                    break
                t += d * 0.9
                if t > 2.0:
                    break


def _unit(v: np.ndarray) -> np.ndarray:
    return v / np.linalg.norm(v)


def pose(time: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return (frame, grip, arm) at a time in 0..4: 0 is rest, 1 to 4 the four key frames.

    frame (3, 3): rows are the axes of sword space in view space. grip (3,): its origin there.
    arm (8,): cosine and sine of the hand's rotation, wrist and elbow in the frame of the hand.
    """
    i = min(int(time), len(KEYS) - 2)
    f = time - i
    key = KEYS[i] + (KEYS[i + 1] - KEYS[i]) * f
    depth = key[2]
    grip = np.array([key[0] * TAN_HALF * ASPECT * depth, key[1] * TAN_HALF * depth, -depth])
    along = _unit(key[3:6])
    edge = _unit(key[6:9] - along * (key[6:9] @ along))
    frame = np.stack([edge, along, np.cross(edge, along)])
    return frame, grip, _arm(frame @ (key[9:12] - grip))


def _arm(elbow: np.ndarray) -> np.ndarray:
    """Return the arm (8,), as of pose, with its elbow (3,) seen from the grip in sword space.

    The hand is rotated around the grip until the wrist faces the elbow.
    """
    turn = math.atan2(elbow[2], elbow[0]) - math.radians(48.0)
    c, s = math.cos(turn), math.sin(turn)
    elbow = np.array([c * elbow[0] + s * elbow[2], elbow[1], -s * elbow[0] + c * elbow[2]])
    wrist = np.array([0.048, -0.068, 0.052])
    return np.array([c, s, *wrist, *elbow])


def overlay(begin: float, end: float, instants: int) -> np.ndarray:
    """Return the overlay, uint8 (512, 512, 4), for an exposure begin..end (times of ``pose``)."""
    image = np.zeros((SIZE, SIZE, 4))
    tables = (ALBEDO, GLOSS, light.SUN_COLOR, light.SKY_COLOR, light.GROUND_BOUNCE)
    view = np.array([TAN_HALF * ASPECT, TAN_HALF])
    for k in range(instants):
        # More instants near the end give a crisp blade with a fading trail behind it.
        f = 1.0 - (1.0 - (k + 0.5) / instants) ** 2.2
        frame, grip, arm = pose(begin + (end - begin) * f)
        sun = np.concatenate([light.SPRITE_SUN, frame @ light.SPRITE_SUN])
        # The R2 sequence (Roberts 2018) distributes the sub-pixel offsets evenly over the texel.
        offset = (np.array([0.7548776662466927, 0.5698402909980532]) * (k + 1)) % 1.0
        _expose(frame, grip, arm, sun, offset, view, tables, image)
    # A fast blade covers each texel only briefly: make it more opaque than a camera would.
    alpha = 1.0 - (1.0 - image[..., 3:] / instants) ** OPACITY_BOOST
    colour = image[..., :3] / np.maximum(image[..., 3:], 1e-9) * GAIN
    rgba = np.concatenate([images.to_srgb(colour), alpha], axis=2)
    return images.bleed(images.to_uint8(rgba))


ASSETS: dict[str, Callable[[], np.ndarray]] = {
    "sword_rest.png": lambda: overlay(0.0, 0.0, 16),
    "sword_1.png": lambda: overlay(0.94, 1.0, 14),
    "sword_2.png": lambda: overlay(1.84, 2.01, 24),
    "sword_3.png": lambda: overlay(2.72, 3.01, 60),
    "sword_4.png": lambda: overlay(3.95, 4.0, 14),
}
