"""The sound of a scene: synthesised with numpy alone, a pure function of pose, scene and time."""
