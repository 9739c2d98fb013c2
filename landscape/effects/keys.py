"""What the digit keys change in the hall: one effect each, so that one sees what it does.

A key stands for a setting that is on or off, or has choices; its name is shown in the help and when
it changes.
"""

from landscape.scene import Toggle

KEYS: dict[str, Toggle] = {}
