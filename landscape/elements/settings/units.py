"""The units of settings, as users read them."""

MESH_FILE = "PLY, OBJ, STL, OFF or GLB file"
DEGREES = "degrees"
UNITS = "units"
PER_SECOND = "units per second"
REPEATS = "repeats over the map"
