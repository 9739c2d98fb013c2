"""The safeguards of the exhibits, as pairs of pictures; part of the hall's (safeguards.py)."""

from landscape.frame import Pose
from landscape.hall import plan
from landscape.hall.exhibits.niche import FOCUS, VOLUME
from landscape.hall.safeguard import Safeguard, pair

# Within the knot's shadow, at the back of the alcove.
BEHIND = Pose(0.826, 0.13, plan.ALCOVES[VOLUME] - 0.052, 338.0, -10.0)

EXHIBITS: tuple[Safeguard, ...] = (
    Safeguard(
        "volume_inside",
        "A shadow seen from inside it",
        BEHIND,
        20.0,
        {"exhibits.volume_count": "zpass"},
        {"exhibits.volume_count": "zfail"},
        flaw="The faces in front of a surface are counted from the eye, which must be outside of "
        "the volume. Inside, the face through which one came is missing from every count: what is "
        "in the shadow is lit, and what is lit is in the shadow.",
        look="Compare where the stone is lit.",
        how="glStencilOp(GL_KEEP, GL_INCR_WRAP, GL_KEEP) counts the faces behind each surface "
        "instead, of a volume that is closed at both ends.",
        seen=(
            "an alcove's side wall, lit within the shadow's outline",
            "an alcove's side wall in shadow",
        ),
    ),
    Safeguard(
        "volume_caps",
        "A volume that is closed at both ends",
        BEHIND,
        20.0,
        {"exhibits.volume_count": "zfail", "exhibits.volume_caps": False},
        {"exhibits.volume_count": "zfail", "exhibits.volume_caps": True},
        flaw="Counted from behind, each line of sight that enters the volume must leave it. "
        "Through an open end it does not, and the count is wrong there.",
        look="Compare the shadow's outline on the stone.",
        how="The triangles that face the light close the near end, their images the far one.",
        seen=("an alcove's side wall with false patches", "an alcove's side wall in shadow"),
    ),
    Safeguard(
        "soft_samples",
        "A lamp of many points",
        "hall_exhibit_soft",
        20.0,
        {"exhibits.soft_samples": 1},
        {"exhibits.soft_samples": 32},
        flaw="A single point throws a shadow with sharp edges, however large the lamp is.",
        look="Compare the shadow of the rings on the wall with that of the foot.",
        how="The mean of one shadow for each of 32 points of the lamp.",
        seen=("rings of brass and a hard shadow", "rings of brass and a soft shadow"),
    ),
    Safeguard(
        "deep",
        "Sums in floating point",
        Pose(1.01, 0.125, plan.ALCOVES[FOCUS], 270.0, -6.0),
        20.0,
        {"exhibits.deep": False, "exhibits.focus_samples": 60},
        {"exhibits.deep": True, "exhibits.focus_samples": 60},
        flaw="In 8 bits, a sample divided by 60 has at most 4 steps of 1/255, and each is rounded.",
        look="Look for steps of colour on the rabbits.",
        how="The samples are added in a texture GL_RGBA32F (ARB_texture_float).",
        seen=("three rabbits in steps of colour", "three rabbits in smooth colours"),
    ),
    Safeguard(
        "focus_shear",
        "A plane of focus that stays where it is",
        "hall_exhibit_focus",
        20.0,
        **pair("exhibits.focus_shear"),
        flaw="If the eye moves along the lens and the frustum keeps its shape, all that is near "
        "moves in the picture, and with it what should be sharp.",
        look="Compare the middle rabbit.",
        how="The frustum is sheared against the eye's movement: glFrustum with its left and right "
        "moved by -dx * near / focus.",
        seen=("three blurred rabbits", "a sharp rabbit between two blurred ones"),
    ),
    Safeguard(
        "lines_offset",
        "Lines that the fill does not break",
        "hall_exhibit_lines",
        20.0,
        **pair("exhibits.lines_offset"),
        flaw="A line and the triangle it bounds have nearly the same depth: rounding decides which "
        "is in front.",
        look="Look at the lines of the dragon's body.",
        how="GL_POLYGON_OFFSET_FILL moves the fill back by its slope and a step of depth.",
        seen=("a dragon in broken lines", "a dragon in whole lines"),
    ),
    Safeguard(
        "solids_stencil",
        "A hole cut by the stencil buffer",
        "hall_exhibit_solids",
        20.0,
        **pair("exhibits.solids_stencil"),
        flaw="The depth buffer keeps the nearest surface, but where the beam is taken away the "
        "sphere's front must not be seen.",
        look="Look for the hole.",
        how="Each face of the beam in front of the sphere inverts a bit (GL_INVERT); where it is "
        "set, the sphere's front is inside the beam.",
        seen=(
            "a whole blue sphere, and the inside of a beam",
            "a blue sphere with a square hole lined with gold",
        ),
    ),
)
