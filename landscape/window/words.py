"""All texts of the window, by language. English is complete; others may leave texts out."""

import re
from collections.abc import Mapping

from landscape.keys import Value


def typeset(french: str) -> str:
    """Return a French text with no-break spaces before its high punctuation and inside « »."""
    return re.sub(r" (?=[;:!?»])|(?<=«) ", "\u00a0", french)


TEXTS: dict[str, dict[str, str]] = {
    "en": {
        "help.title": "Keys",
        "help.walk": "walk (or the up and down arrows)",
        "help.turn": "turn (or click, then move the mouse)",
        "help.escape": "release the mouse; again to quit",
        "help.run": "run",
        "help.strike": "strike with the sword (or left button)",
        "help.fly": "fly, or walk again",
        "help.up_down": "fly up and down",
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
        "inspector.title": "Inspector",
        "inspector.stopped": "stopped",
        "inspector.going": "live, listed 4 times a second",
        "inspector.calls": "{count} calls",
        "inspector.edit": "{count} edit",
        "inspector.edits": "{count} edits",
        "inspector.pixel": "What happened to pixel {x}, {y}",
        "inspector.about_pass": "The pass {name}: {count} calls of the frame.",
        "inspector.about_element": "{name}: {count} calls. Right opens them.",
        "inspector.left_out": "left out",
        "inspector.redundant": "= redundant: it sets what is set already",
        "inspector.from_to": "from {low} to {high}",
        "inspector.from": "from {low}",
        "inspector.under": "In the cross-hair: {element}, {call}. O shows every draw there",
        "inspector.needed": "the program needs this call to go on",
        "inspector.nothing": "nothing was changed yet",
        "inspector.not_saved": "the edits could not be saved here",
        "inspector.keys": "Up Down: row. Right Left: open, close. Tab: value. + - or drag: change, "
        "with Shift finely. Del: call off, on. Ctrl+Z: undo. Backspace: undo here, with Ctrl all. "
        "Ctrl+S: save. Space: stop, go on. {pixel}: pixel in the middle, or click one. "
        "{letter}: close",
        "inspector.keys_pixel": "Up Down: draw. Enter or Left: its call in the frame. "
        "{pixel}: pixel in the middle, or click one. {letter}: close",
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
        "key.f11": "F11",
        "key.f12": "F12",
        "hint": "{letter}: keys",
        "loading": "loading…",
        "rebuilding": "building the scene again…",
        "fly.on": "flying",
        "fly.off": "walking",
        "swim.on": "deep water: swimming",
        "swim.off": "back on foot",
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
        "fix": "{name}  {title}: {state}",
        "fix.on": "on",
        "fix.off": "off",
        "resized": "size {wanted}: the window system gave {given}, so the replay was drawn at that",
        "saved": "{name} saved",
        "not_saved": "the screenshot could not be saved here",
        "no_monitor": "full screen is not available here",
    },
    "fr": {
        "help.title": "Touches",
        "help.walk": "marcher (ou flèches haut et bas)",
        "help.turn": "tourner (ou cliquer, puis bouger la souris)",
        "help.escape": "libérer la souris, puis quitter",
        "help.run": "courir",
        "help.strike": "donner un coup d'épée (ou clic gauche)",
        "help.fly": "voler, ou revenir au sol",
        "help.up_down": "monter et descendre en vol",
        "help.map": "carte",
        "help.time": "heure de la journée",
        "help.wireframe": "fil de fer",
        "help.fog": "brouillard",
        "help.reflection": "reflet dans l'eau",
        "help.sorting": "tri des arbres",
        "help.next_fix": "choisir la correction suivante (avec Maj, la précédente)",
        "help.go_to_fix": "aller là où la correction se voit",
        "help.fix": "activer ou désactiver la correction",
        "help.fullscreen": "plein écran",
        "help.screenshot": "enregistrer une capture d'écran",
        "help.help": "afficher cette liste",
        "help.list": "liste des réglages, pour les changer",
        "help.inspector": "inspecteur : les appels OpenGL de l'image, pour les changer",
        "inspector.title": "Inspecteur",
        "inspector.stopped": "arrêté",
        "inspector.going": "en marche, relevé 4 fois par seconde",
        "inspector.calls": "{count} appels",
        "inspector.edit": "{count} modification",
        "inspector.edits": "{count} modifications",
        "inspector.pixel": "Histoire du pixel {x}, {y}",
        "inspector.about_pass": "La passe {name} : {count} appels de l'image.",
        "inspector.about_element": "{name} : {count} appels. La flèche droite les ouvre.",
        "inspector.left_out": "supprimé",
        "inspector.redundant": "= redondant : fixe ce qui l'est déjà",
        "inspector.from_to": "de {low} à {high}",
        "inspector.from": "à partir de {low}",
        "inspector.under": "Dans le viseur : {element}, {call}. O montre chaque tracé",
        "inspector.needed": "le programme a besoin de cet appel",
        "inspector.nothing": "rien n'a encore été changé",
        "inspector.not_saved": "impossible d'enregistrer les modifications ici",
        "inspector.keys": "Haut Bas : ligne. Droite Gauche : ouvrir, fermer. Tab : valeur. "
        "+ - ou glisser : changer, avec Maj finement. Suppr : appel oui, non. Ctrl+Z : annuler. "
        "Retour arrière : annuler ici, avec Ctrl tout. Ctrl+S : enregistrer. Espace : arrêter, "
        "repartir. {pixel} : pixel du milieu, ou cliquer. {letter} : fermer",
        "inspector.keys_pixel": "Haut Bas : tracé. Entrée ou Gauche : son appel dans l'image. "
        "{pixel} : pixel du milieu, ou cliquer. {letter} : fermer",
        "inspector.record": "un enregistrement ne contient pas les modifications : le rejouer avec "
        "le même --edits",
        "list.title": "Réglages",
        "list.choose": "Haut, Bas : choisir. Gauche, Droite : groupe",
        "list.change": "+ - : changer. Entrée : oui, non. Retour arrière : comme le préréglage",
        "list.range": "{range} (préréglage : {default})",
        "list.from_to": "de {low} à {high} {unit}",
        "list.on": "oui",
        "list.off": "non",
        "list.taken": "changé sans reconstruire la scène",
        "list.rebuilt": "changé en reconstruisant la scène",
        "key.left": "Gauche",
        "key.right": "Droite",
        "key.space": "Espace",
        "key.left_shift": "Maj",
        "key.escape": "Échap",
        "hint": "{letter} : touches",
        "loading": "chargement…",
        "rebuilding": "reconstruction de la scène…",
        "fly.on": "en vol",
        "fly.off": "à pied",
        "swim.on": "eau profonde\u00a0: à la nage",
        "swim.off": "de nouveau à pied",
        "edge": "le bord de la carte",
        "map.on": "carte affichée",
        "map.off": "carte masquée",
        "time.noon": "midi",
        "time.sunset": "coucher du soleil",
        "wireframe.on": "fil de fer",
        "wireframe.off": "faces pleines",
        "fog.on": "avec brouillard",
        "fog.off": "sans brouillard",
        "reflection.on": "avec reflet",
        "reflection.off": "sans reflet",
        "sorting.on": "arbres triés",
        "sorting.off": "arbres non triés",
        "fix": "{name}  « {title} » : correction {state}",
        "fix.on": "activée",
        "fix.off": "désactivée",
        "resized": "taille {wanted} : le système de fenêtres a donné {given}, la relecture a donc "
        "cette taille",
        "saved": "« {name} » enregistré",
        "not_saved": "impossible d'enregistrer la capture d'écran ici",
        "no_monitor": "plein écran indisponible ici",
    },
}


TEXTS["fr"] = {key: typeset(text) for key, text in TEXTS["fr"].items()}


def language(environment: Mapping[str, str]) -> str:
    """Return the first language the environment asks for that TEXTS has, else "en".

    LANGUAGE may list several, preferred first; then LC_ALL, LC_MESSAGES and LANG, in this order.
    """
    wanted = environment.get("LANGUAGE", "").split(":")
    locale = next(
        (environment[v] for v in ("LC_ALL", "LC_MESSAGES", "LANG") if environment.get(v)), ""
    )
    for name in (*wanted, locale):
        code = name.replace("-", "_").split("_")[0].split(".")[0].lower()
        if code in TEXTS:
            return code
    return "en"


def text(language: str, key: str, **words: str) -> str:
    """Return a text in a language, else in English; ``words`` fill its {placeholders}."""
    table = TEXTS.get(language, {})
    return table.get(key, TEXTS["en"][key]).format(**words)


def state(language: str, name: str, value: Value) -> str:
    """Return the message that a switch is on or off, or what it is set to."""
    found = ("on" if value else "off") if isinstance(value, bool) else value
    return text(language, f"{name}.{found}")
