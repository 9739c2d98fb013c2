"""What the digit keys change in the hall: one effect each, so that one sees what it does.

A key stands for a setting that is on or off, or has choices, or takes the values given here in
turn; its name is shown in the help and when it changes.
"""

from landscape.keys import Toggle

KEYS: dict[str, Toggle] = {
    "1": Toggle("mirror.enabled", "mirror image in the floor"),
    "2": Toggle("shadow.enabled", "the statue's shadows"),
    "3": Toggle("caustics.enabled", "light that the pool's water focuses"),
    "4": Toggle("statue.environment", "what the statue mirrors"),
    "5": Toggle("mist.enabled", "mist over the floor"),
    "6": Toggle("sky.layers", "layers of cloud in the sky", (0, 1, 2)),
    "7": Toggle("tone.contrast", "contrast", (1.0, 1.6, 0.5)),
    "8": Toggle("tone.area", "where the contrast changes"),
    "9": Toggle("flight.enabled", "flight around the statue"),
}
