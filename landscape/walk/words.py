"""The texts of the window, by key. The translations are in locale/LANGUAGE/window.po."""

from framelens.base.texts import Texts, Wording, translator
from landscape.settings.declare import Value
from landscape.settings.notices import value_text

TEXTS: Texts = {
    "help.title": "Keys",
    "help.walk": "walk (or the up and down arrows)",
    "help.turn": "turn (or click, then move the mouse)",
    "help.escape": "release the mouse; again to quit",
    "help.run": "run",
    "help.strike": "strike with the sword (or left button)",
    "help.fly": "fly, or walk again",
    "help.up_down": "fly up and down",
    "help.turn.blocks": "turn (or drag with the left mouse button)",
    "help.strike.blocks": "strike with the sword",
    "help.up_down.blocks": "jump; in flight and in the water, up and down",
    "help.mouse": "look with the mouse, without a button; again to release it",
    "help.save": "save the world, with --world",
    "help.dig": "dig the framed block (hold: one after another)",
    "help.place": "place a block",
    "help.pick": "take this kind of block to place",
    "help.carry": "drag: carry the torch's light around the statue, up and down",
    "help.slots": "choose a kind of block (or the wheel)",
    "help.map": "map",
    "help.time": "time of day",
    "help.wireframe": "wireframe",
    "help.fog": "fog",
    "help.reflection": "reflection in the water",
    "help.sorting": "sorting of the trees",
    "help.next_fix": "choose the next fix (with Shift, the one before)",
    "help.go_to_fix": "go where the chosen fix shows",
    "help.fix": "turn the chosen fix on or off",
    "help.fullscreen": "full screen",
    "help.screenshot": "save a screenshot",
    "help.help": "these keys",
    "help.list": "list of settings, to change them",
    "help.inspector": "inspector: the frame's OpenGL calls, to change them",
    "inspector.record": "a recording does not contain edits: replay it with the same --edits",
    "list.title": "Settings",
    "list.choose": "Up, Down: choose. Left, Right: group",
    "list.change": "+ -: change. Enter: on, off. Backspace: as in the preset",
    "list.range": "{range} (preset: {default})",
    "list.from_to": "from {low} to {high} {unit}",
    "list.on": "on",
    "list.off": "off",
    "list.taken": "changed without building the scene again",
    "list.rebuilt": "changed by building the scene again",
    "key.left": "Left",
    "key.right": "Right",
    "key.space": "Space",
    "key.left_shift": "Shift",
    "key.escape": "Esc",
    "key.tab": "Tab",
    "key.f5": "F5",
    "key.dig": "Left click",
    "key.place": "Right click",
    "key.pick": "Middle click",
    "key.carry": "Right button",
    "key.slots": "1 to 9",
    "key.f11": "F11",
    "key.f12": "F12",
    "hint": "{letter}: keys",
    "hint.blocks": "{letter}: keys. Left button: drag to look, click to dig. {mouse}: free look",
    "world.saved": "the world is saved",
    "loading": "loading…",
    "opening": "{place}: loading…",
    "shut": "this door is shut",
    "rebuilding": "building the scene again…",
    "fly.on": "flying",
    "fly.off": "walking",
    "swim.on": "deep water: swimming",
    "swim.off": "back on foot",
    "path": "flying along the path; a step of your own ends it",
    "path.left": "the path is left: flying",
    "edge": "the edge of the map",
    "map.on": "map on",
    "map.off": "map off",
    "time.noon": "noon",
    "time.sunset": "sunset",
    "wireframe.on": "wireframe on",
    "wireframe.off": "wireframe off",
    "fog.on": "fog on",
    "fog.off": "fog off",
    "reflection.on": "reflection on",
    "reflection.off": "reflection off",
    "sorting.on": "sorting on",
    "sorting.off": "sorting off",
    "toggle": "{name}: {state}",
    "fix": "{name}  {title}: {state}",
    "fix.on": "on",
    "fix.off": "off",
    "resized": "size {wanted}: the window system gave {given}, so the replay was drawn at that",
    "saved": "{name} saved",
    "not_saved": "the screenshot could not be saved here",
    "flyover.title": "Keys of the fly-over",
    "flyover.move": "fly freely (or the up and down arrows)",
    "flyover.run": "four times as fast",
    "flyover.free": "free flight, or back to the path",
    "flyover.pause": "pause, or go on",
    "flyover.step": "a single step (with Shift, one back)",
    "flyover.speed": "faster, slower",
    "flyover.at_speed": "speed x {speed}",
    "flyover.is_free": "free flight",
    "flyover.on_path": "along the path",
    "flyover.paused": "pause",
    "flyover.goes_on": "the flight goes on",
    "flyover.mean": "{frames} frames in {seconds} s: {rate} frames/s on average",
    "flyover.lines": "{rate} frames/s   {lines} lines of {considered}   {pixels} pixels",
    "flyover.ground": "{rate} frames/s",
    "flyover.flyover.strips": "triangle strips: each edge once",
    "flyover.flyover.back_faces": "back faces dropped",
    "flyover.flyover.bounding_volumes": "bounding volumes",
    "flyover.flyover.quad_tree": "quad-tree",
    "flyover.flyover.detail": "level of detail",
    "flyover.flyover.morph": "morphing between levels",
    "flyover.flyover.hidden_lines": "hidden lines removed",
    "flyover.flyover.colours": "colours of the lines",
    "flyover.flyover.mode": "lines or ground",
    "flyover.filled.smooth": "smooth ground, not blocks",
    "flyover.filled.levels": "smaller copies far away",
    "flyover.filled.fog": "haze far away",
    "flyover.filled.shadows": "shadows",
    "flyover.filled.occlusion": "darker hollows",
    "flyover.filled.reflection": "the sky in the water",
    "flyover.filled.clouds": "clouds",
    "flyover.filled.edges": "smooth ridges",
    "no_monitor": "full screen is not available here",
}


WORDING = Wording(TEXTS, "window")
text = WORDING.text


def state(language: str, name: str, value: Value) -> str:
    """Return the message that a switch is on or off, or what it is set to."""
    found = ("on" if value else "off") if isinstance(value, bool) else value
    return text(language, f"{name}.{found}")


def toggled(language: str, name: str, value: Value) -> str:
    """Return the message that what is called ``name`` is on or off, or what it is set to."""
    told = state(language, "list", value) if isinstance(value, bool) else value_text(value)
    return text(language, "toggle", name=name, state=told)


def fix_state(language: str, name: str, title: str, on: bool) -> str:
    """Return the message that a fix is on or off; the title is the English one."""
    title = translator(language, "fixes")(title, name)
    return text(language, "fix", name=name, title=title, state=state(language, "fix", on))
