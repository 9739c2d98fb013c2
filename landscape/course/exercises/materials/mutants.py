"""Mistakes that students make, each as a change of solution.py: (old, new), ..."""

from landscape.course.grader.mutants import Mutant

AMBIENT = "    glMaterialfv(GL_FRONT, GL_AMBIENT, [0.4 * channel for channel in color] + [1])\n"
DIFFUSE = "    glMaterialfv(GL_FRONT, GL_DIFFUSE, (*color, 1))\n"
SPECULAR = "    glMaterialfv(GL_FRONT, GL_SPECULAR, (*highlight, 1))\n"
SHININESS = "    glMaterialf(GL_FRONT, GL_SHININESS, shininess)\n"
EMISSION = "    glMaterialfv(GL_FRONT, GL_EMISSION, (*glow, 1))\n"
ENABLE = "    glEnable(GL_LIGHT1)\n"
POSITION = "    glLightfv(GL_LIGHT1, GL_POSITION, (0, 1, 0, 0))\n"
LIGHT = "    glLightfv(GL_LIGHT1, GL_DIFFUSE, (*SKY, 1))\n"

MUTANTS = {
    "only_color": Mutant(
        "sets the current colour", "body", [(AMBIENT, ""), (DIFFUSE, "    glColor3fv(color)\n")]
    ),
    "back_faces": Mutant(
        "sets the material of back faces",
        "body",
        [(AMBIENT, AMBIENT.replace("FRONT", "BACK")), (DIFFUSE, DIFFUSE.replace("FRONT", "BACK"))],
    ),
    "no_ambient": Mutant("leaves the ambient reflection", "body", [(AMBIENT, "")]),
    "no_diffuse": Mutant("leaves the diffuse reflection", "body", [(DIFFUSE, "")]),
    "full_ambient": Mutant(
        "takes the whole colour for ambient light",
        "body",
        [(AMBIENT, "    glMaterialfv(GL_FRONT, GL_AMBIENT, (*color, 1))\n")],
    ),
    "swapped": Mutant(
        "swaps ambient and diffuse",
        "body",
        [
            (AMBIENT, AMBIENT.replace("AMBIENT", "DIFFUSE")),
            (DIFFUSE, DIFFUSE.replace("DIFFUSE", "AMBIENT")),
        ],
    ),
    "no_highlight": Mutant("leaves the specular reflection", "highlights", [(SPECULAR, "")]),
    "color_shines": Mutant(
        "takes the colour for the highlight",
        "highlights",
        [(SPECULAR, SPECULAR.replace("highlight", "color"))],
    ),
    "no_shininess": Mutant("leaves the shininess", "highlights", [(SHININESS, "")]),
    "fraction": Mutant(
        "counts the shininess from 0 to 1",
        "highlights",
        [(SHININESS, SHININESS.replace("shininess", "shininess / 128"))],
    ),
    "kept": Mutant(
        "sets only a highlight that there is",
        "highlights",
        [(SPECULAR, "    if any(highlight):\n    " + SPECULAR)],
    ),
    "no_glow": Mutant("leaves the emission", "glows", [(EMISSION, "")]),
    "glow_kept": Mutant(
        "sets only a glow that there is",
        "glows",
        [(EMISSION, "    if any(glow):\n    " + EMISSION)],
    ),
    "all_glow": Mutant(
        "lets all balls glow in their colour",
        "glows",
        [(EMISSION, EMISSION.replace("glow", "color"))],
    ),
    "not_enabled": Mutant("does not turn the sky on", "sky", [(ENABLE, "")]),
    "no_light": Mutant("gives the sky no light", "sky", [(LIGHT, "")]),
    "ambient_sky": Mutant(
        "makes the sky's light ambient", "sky", [(LIGHT, LIGHT.replace("DIFFUSE", "AMBIENT"))]
    ),
    "a_place": Mutant(
        "puts the sky into a place",
        "sky",
        [(POSITION, POSITION.replace("(0, 1, 0, 0)", "(0, 1, 0, 1)"))],
    ),
    "from_below": Mutant(
        "lets the sky shine from below",
        "sky",
        [(POSITION, POSITION.replace("(0, 1, 0, 0)", "(0, -1, 0, 0)"))],
    ),
    "no_position": Mutant("gives the sky no direction", "sky", [(POSITION, "")]),
    "with_camera": Mutant(
        "sets the sky before the camera",
        "sky",
        [
            ("        set_sky()\n", ""),
            ("        glRotatef(25,", "        set_sky()\n        glRotatef(25,"),
        ],
    ),
    "shining_sky": Mutant(
        "gives the sky a specular light",
        "sky",
        [(LIGHT, LIGHT + LIGHT.replace("DIFFUSE", "SPECULAR"))],
    ),
}
