"""The safeguards of the hall's effects, as pairs of pictures: without each one, and with it.

Their names are views (`landscape render mirror_stencil`), and keys switch them in the walk.
"""

from landscape.frame import Pose
from landscape.hall.exhibits.safeguards import EXHIBITS
from landscape.hall.safeguard import Safeguard, pair
from landscape.hall.views import ONE_LAMP
from landscape.settings.declare import Value

BRONZE = {"environment": "none"}
UPWARDS = Pose(1.6, 0.1, 1.6, 270.0, 55.0)
LOW_SUN = {"azimuth": 4.0, "elevation": 7.0}  # degrees: beyond the north wall
EVERYWHERE = {"caustics.sunlit": False}
BEFORE_WALL: dict[str, Value] = {
    "flame": (1.6, 0.22, 0.85),
    "method": "darken",
}  # between the wall and the statue

SAFEGUARDS: tuple[Safeguard, ...] = (
    Safeguard(
        "mirror_stencil",
        "The mirror image ends where the floor ends",
        Pose(0.06, 0.95, 1.6, 90.0, -33.0),
        20.0,
        **pair("mirror.stencil"),
        flaw="The mirror image is a second hall, upside down under the floor. Seen from outside, "
        "it hangs below the floor's edge.",
        look="Look below the near edge of the floor. Before, mirrored alcoves hang there; after, "
        "nothing.",
        how="The floor is drawn into the stencil buffer first (GL_REPLACE), and the image only "
        "where that is 1 (GL_EQUAL).",
        seen=(
            "the hall cut open, and a second one upside down hanging below it",
            "the hall cut open, mirrored in its floor alone",
        ),
    ),
    Safeguard(
        "mirror_winding",
        "Front faces that stay in front under the mirror",
        "hall_mirror",
        20.0,
        **pair("mirror.winding"),
        flaw="A mirror reverses the order of every triangle's corners, so that culling removes the "
        "front faces and keeps the back ones.",
        look="Compare plinth and pillars with their images in the floor.",
        how="glFrontFace(GL_CW) while the image is drawn.",
        seen=(
            "a floor that mirrors sky and the backs of arches instead of walls",
            "a floor that mirrors dragon, pillars and walls as they are",
        ),
    ),
    Safeguard(
        "mirror_normals",
        "Normals of length 1 in the image",
        "hall_mirror",
        20.0,
        **pair("mirror.normals", statue=BRONZE),
        flaw="The image's dragon is scaled by glScalef, which makes normals too long: here the "
        "light on it is four times as strong.",
        look="Compare the dragon in the floor with the one on the plinth.",
        how="GL_NORMALIZE makes each normal a unit vector after the modelview matrix.",
        seen=(
            "a bronze dragon whose image in the floor glares",
            "a bronze dragon whose image in the floor has its own shading",
        ),
    ),
    Safeguard(
        "mirror_lights",
        "Lights that are mirrored, too",
        "hall_mirror",
        20.0,
        **pair("mirror.lights", statue=BRONZE, mirror={"strength": 0.7}),
        flaw="OpenGL transforms a light's position when it is set, and not again under the mirror. "
        "The lights then shine on the mirrored dragon from above, and its belly is bright.",
        look="Compare where the light falls on the dragon and on its image.",
        how="glLightfv(GL_POSITION) is called again under the mirror matrix.",
        seen=(
            "a bronze dragon whose image is lit from the wrong side",
            "a bronze dragon whose image is lit as itself",
        ),
    ),
    Safeguard(
        "mirror_clip",
        "Nothing from under the floor in the image",
        Pose(1.74, 0.3, 2.66, 348.0, -24.0),
        20.0,
        **pair("mirror.clip", mirror={"strength": 0.8}),
        flaw="The pool's basin lies under the floor, so that its mirror image stands above it.",
        look="Look at the floor behind the pool and beside it.",
        how="glClipPlane keeps what is above the floor; it is placed under the mirror matrix.",
        seen=(
            "a pool with a ghostly wall around its far edge",
            "a pool in an even, polished floor",
        ),
    ),
    Safeguard(
        "mirror_underside",
        "A floor with an underside",
        Pose(-0.15, -0.6, 0.5, 112.0, 21.0),
        20.0,
        **pair("mirror.underside"),
        flaw="The floor's triangles face upwards. Seen from below they are culled, and one looks "
        "through the floor into the hall.",
        look="The camera is below the hall and looks up.",
        how="With glFrontFace(GL_CW) the other side of the same triangles is drawn, in a colour.",
        seen=("the hall seen through its missing floor", "the dark blue underside of the floor"),
    ),
    Safeguard(
        "shadow_stencil",
        "No pixel darkened twice",
        "hall_shadow",
        20.0,
        **pair("shadow.stencil", shadow={"method": "darken"}, camera={"fov": 36.0}),
        flaw="The flattened dragon has at least two layers, and each darkens again.",
        look="Look at the dragon's neck and body on the wall.",
        how="The wall is marked in the stencil buffer; each pixel of the shadow clears its mark.",
        seen=(
            "a black, blotched shadow of a dragon on the wall",
            "a dragon's shadow of one even tone on the wall",
        ),
    ),
    Safeguard(
        "shadow_offset",
        "A shadow that does not fight with its wall",
        Pose(1.66, 0.1, 1.02, 318.0, -9.0),
        20.0,
        **pair("shadow.offset"),
        flaw="Shadow and wall lie in one plane. Rounding decides for each pixel which is nearer.",
        look="Look at the shadow on the wall.",
        how="GL_POLYGON_OFFSET_FILL brings the shadow a little nearer to the eye.",
        seen=("a shadow torn into stripes and specks", "an unbroken shadow"),
    ),
    Safeguard(
        "shadow_matrix",
        "A plus in the shadow's matrix",
        "hall_shadow",
        20.0,
        {"shadow.misprint": "matrix", "camera.fov": 36.0},
        {"shadow.misprint": "none", "camera.fov": 36.0},
        flaw="The notes on glSkel print the matrix's last cell as a lx + b ly * c lz. For the "
        "wall, where only c is not 0, that is 0: every w is negative, and OpenGL clips the whole "
        "shadow.",
        look="Look for the dragon's shadow on the wall.",
        how="The last cell is a lx + b ly + c lz: M = (p . l) I - l p^T.",
        seen=(
            "a golden dragon before a wall without its shadow",
            "a golden dragon, and its large shadow on the wall behind it",
        ),
    ),
    Safeguard(
        "shadow_plane",
        "The plane that the shadow falls on",
        "hall_one_floor",
        20.0,
        {**ONE_LAMP, "shadow.misprint": "plane"},
        {**ONE_LAMP, "shadow.misprint": "none"},
        flaw="The notes on glSkel print the plane's equation as b x + b y + c z + d = 0. Taken at "
        "its word, the floor y = 0 becomes x + y = 0: a slope far below the floor, which hides it.",
        look="Look for the shadows of dragon and pillars on the floor.",
        how="The equation is a x + b y + c z + d = 0; for the floor a, b, c, d are 0, 1, 0, 0.",
        seen=(
            "a floor that mirrors a dragon and has no shadows",
            "a floor that mirrors a dragon, with shadows of dragon and pillars on it",
        ),
    ),
    Safeguard(
        "shadow_behind",
        "What is behind the light casts no shadow",
        Pose(1.80, 0.12, 1.02, 322.0, 8.0),
        20.0,
        **pair("shadow.behind", shadow=BEFORE_WALL),
        flaw="The torch has been brought between the dragon and the north wall, so that the "
        "dragon's shadow falls to the south. But lines from the dragon through the flame meet the "
        "wall, too: the matrix casts an anti-shadow there, upside down.",
        look="Look at the wall around the window.",
        how="The matrix gives what is behind the light a negative w, and OpenGL clips it. The "
        "flaw is drawn by the same matrix with the opposite sign.",
        seen=(
            "a dragon's shadow upside down on a wall, although a flame burns before the wall",
            "a flame before a wall without shadows",
        ),
    ),
    Safeguard(
        "shadow_sun",
        "A sun behind the wall casts nothing on its inside",
        Pose(1.72, 0.1, 1.04, 336.0, 9.0),
        20.0,
        **pair("shadow.behind", sun=LOW_SUN, shadow={"light": "sun", "method": "darken"}),
        flaw="The morning sun stands beyond the north wall. Its rays never reach the wall's "
        "inside, but the matrix projects every point of the dragon onto it.",
        look="Look at the wall below the window.",
        how="With p the wall's plane and l the sun, p . l is negative. So is the w of every "
        "projected point, and OpenGL clips all of them.",
        seen=("a dragon's shadow that the sun behind the wall casts on it", "a wall without one"),
    ),
    Safeguard(
        "caustics_doubled",
        "A net of light that brightens as well",
        "hall_caustics",
        20.0,
        **pair("caustics.doubled", caustics={"sunlit": False}),
        flaw="The notes on glSkel multiply the bed by the net with glBlendFunc(GL_ZERO, "
        "GL_SRC_COLOR). No colour of a texture exceeds 1, so the net can only darken the pool.",
        look="Compare the pool with the stone around it.",
        how="glBlendFunc(GL_DST_COLOR, GL_SRC_COLOR) adds the product twice: a factor of 0 to 2. "
        "In a single pass, with texture units, GL_RGB_SCALE of 2 does the same.",
        seen=("a dark pool with a dull net on its bed", "a pool with a bright net on its bed"),
    ),
    Safeguard(
        "caustics_planes",
        "A net of light that lies still on the bed",
        "hall_caustics",
        20.0,
        EVERYWHERE | {"caustics.planes": "eye_before_camera"},
        EVERYWHERE | {"caustics.planes": "eye"},
        flaw="An eye plane is multiplied by the inverse of the modelview matrix that is current "
        "when it is given. Given before the viewing transform, it stays in the eye's coordinates, "
        "and the net moves with whoever looks.",
        look="Walk and turn: before, the net comes along.",
        how="glTexGenfv(GL_S, GL_EYE_PLANE, ...) after the viewing transform, or "
        "GL_OBJECT_PLANE, which no matrix changes.",
        seen=("a net of light that turns with the viewer", "a net of light fixed to the bed"),
    ),
    Safeguard(
        "caustics_own_t",
        "A net of light and not stripes",
        "hall_caustics",
        20.0,
        **pair("caustics.own_t", caustics={"sunlit": False}),
        flaw="The notes on glSkel give the plane of s to t as well. Both coordinates are then "
        "equal, and only the diagonal of the texture is seen.",
        look="Compare the bed: stripes, or a net.",
        how="Two planes, sPlane and tPlane, that are not parallel.",
        seen=("stripes of light along the pool's bed", "a net of light on the pool's bed"),
    ),
    Safeguard(
        "caustics_sunlit",
        "A net of light where the sun shines",
        "hall_caustics",
        20.0,
        **pair("caustics.sunlit"),
        flaw="Water focuses the sun's light and not that of torches or of the sky. Multiplied by "
        "the net everywhere, the bed in shade has bright lines around dark cells: cobbles.",
        look="Compare the near end of the pool, in shade, with the patch of sun.",
        how="The light map's alpha says how much of the light is the sun's; GL_INTERPOLATE moves "
        "the net towards 1/2, which changes nothing, where that is little.",
        seen=(
            "a pool whose whole bed looks like dark cobbles",
            "a pool of tiles with a net of light in a patch of sun",
        ),
    ),
    Safeguard(
        "caustics_pattern",
        "Light that waves focus, and not dots",
        "hall_caustics",
        20.0,
        EVERYWHERE | {"caustics.pattern": "sines"},
        EVERYWHERE | {"caustics.pattern": "net"},
        flaw="A product of sines is periodic and moves, but has no lines: it shows rows of dots.",
        look="Compare the bed: dots, or lines that join.",
        how="A film of 32 textures: rays refracted by a sum of waves whose wave numbers and "
        "frequencies are whole, so that it is periodic in space and in time.",
        seen=("rows of round spots of light in a dark pool", "a net of light on the pool's bed"),
    ),
    Safeguard(
        "tone_texture",
        "The contrast of one texture",
        "hall_texture",
        20.0,
        {
            "tone.contrast": 1.8,
            "tone.texture": "wall",
            "tone.texture_contrast": 1.0,
            "tone.texture_brightness": 0.0,
        },
        {
            "tone.contrast": 1.0,
            "tone.texture": "wall",
            "tone.texture_contrast": 2.4,
            "tone.texture_brightness": -0.75,
        },
        flaw="A contrast of the whole picture changes all that is in it: here gold, flames and "
        "light lose their shades.",
        look="Compare the joints of the walls, then the dragon.",
        how="The wall's texture, once drawn into a framebuffer object, is copied back through "
        "glPixelTransfer, which scales and biases it. It is not loaded again.",
        seen=(
            "a hall in glaring light with a dragon of one yellow",
            "a hall whose walls have deep joints, and a golden dragon",
        ),
    ),
    Safeguard(
        "sky_layers",
        "Two layers of cloud at two speeds",
        UPWARDS,
        200.0,
        {"room.vault": False, "camera.fov": 50.0, "sky.layers": 1},
        {"room.vault": False, "camera.fov": 50.0, "sky.layers": 2},
        flaw="A single layer of cloud moves like a painted ceiling.",
        look="Compare the clouds; in a walk, see how they pass each other.",
        how="The second texture unit lays low clouds over the high ones, by their alpha; its "
        "texture matrix moves them five times as fast.",
        seen=(
            "thin white clouds behind open ribs of stone",
            "thin white clouds, and grey ones before them, behind open ribs of stone",
        ),
    ),
    Safeguard(
        "tone_doubling",
        "A contrast above 1 by doubling",
        Pose(1.78, 0.12, 1.62, 337.0, 6.0),
        20.0,
        **pair("tone.doubling", tone={"contrast": 2.0, "brightness": -0.1}),
        flaw="Blending with (GL_ONE, GL_SRC_ALPHA) multiplies by alpha, which ends at 1: a "
        "contrast of 2 shows as one of 1.",
        look="Compare light and dark stone.",
        how="glBlendFunc(GL_DST_COLOR, GL_ONE) adds the picture to itself, times a colour: each "
        "pass multiplies by up to 2.",
        seen=("the statue in an evenly lit hall", "the statue in a hall with deep contrast"),
    ),
    Safeguard(
        "flight_slerp",
        "A camera that turns about one axis",
        Pose(1.36, 0.42, 1.62, 33.0, 4.0),
        20.0,
        {"flight.path": True, "flight.interpolation": "euler"},
        {"flight.path": True, "flight.interpolation": "slerp"},
        flaw="Where the camera looks straight down, yaw and roll turn about the same axis: gimbal "
        "lock. Where the flight passes that direction, yaw and roll change by about half a turn, "
        "and the camera whirls.",
        look="Follow the ribbon, the camera's path as wide as its wings, over the statue.",
        how="Orientations are unit quaternions, interpolated by SLERP: 51 degrees instead of 347.",
        seen=(
            "a ribbon in the air over the statue that twists once about itself",
            "a ribbon in the air over the statue without a twist",
        ),
    ),
    Safeguard(
        "statue_fresh",
        "Gold that mirrors what is around it",
        Pose(1.86, 0.2, 1.4, 304.0, 4.0),
        20.0,
        **pair("statue.fresh"),
        flaw="A sphere map is right for one line of sight only. Made once, as in 1997, it turns "
        "with the viewer: here, from the east, the statue mirrors what one sees from the south.",
        look="Look at the bright spots on neck and body: windows and torches.",
        how="The map is drawn anew in each frame, from a cube map of the hall.",
        seen=(
            "a golden dragon with windows in the wrong places",
            "a golden dragon with windows in their places",
        ),
    ),
    Safeguard(
        "statue_generated",
        "Coordinates that OpenGL generates",
        Pose(1.815, 0.20, 1.53, 326.0, 4.0),
        20.0,
        **pair("statue.generated"),
        flaw="The notes on glSkel enable GL_GEN_S and GL_GEN_T, names that OpenGL does not have. "
        "Without generated coordinates all vertices look up the same texel.",
        look="Compare the gilding.",
        how="glEnable(GL_TEXTURE_GEN_S) and glEnable(GL_TEXTURE_GEN_T).",
        seen=("a dragon of one dull colour", "a dragon of gold that mirrors windows and walls"),
    ),
    Safeguard(
        "mist_clear",
        "Mist without lines on the pillars",
        "hall_mist",
        20.0,
        **pair("mist.clear", mist={"enabled": True}),
        flaw="Each sheet of mist ends where it meets a pillar, in a line.",
        look="Look at the feet of the pillars and at the plinth.",
        how="A second texture unit multiplies the sheets' alpha by the distance from what stands "
        "in them, up to 0.075 units.",
        seen=(
            "a hall with mist that ends in lines on its pillars",
            "a hall with mist that thins out around its pillars",
        ),
    ),
    Safeguard(
        "mist_sorted",
        "Sheets of mist from far to near",
        Pose(1.4, 0.2, 2.2, 25.0, -10.0),
        20.0,
        {"mist.enabled": True, "mist.sorted": False, "mist.mask": False},
        {"mist.enabled": True, "mist.sorted": True, "mist.mask": True},
        flaw="Drawn from the highest down, with depth writes, the highest sheet hides all others: "
        "most of the mist is missing, and what is left lies in one plane.",
        look="Look at the floor beside the pool.",
        how="The sheets are sorted by their distance from the eye's height, and glDepthMask keeps "
        "them from writing their depth.",
        seen=("thin wisps in one plane above a floor", "mist of some depth over a floor"),
    ),
    *EXHIBITS,
)
