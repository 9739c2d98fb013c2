"""What a strip says, in English and French."""

TEXTS = {
    "en": {
        "title": "{name}: a frame growing",
        "intro": "{width} × {height} pixels, {calls}, {draws}; {steps}",
        "steps.pass": "a picture for each pass",
        "steps.element": "a picture for each element, in the order in which they draw",
        "steps.draw": "a picture for each draw call, with its number in the trace",
        "calls": "{n} call|{n} calls",
        "listed": "{n} more in display lists",
        "changed": "changes {percent}\u00a0% of the pixels",
        "hardly": "changes less than {percent}\u00a0% of the pixels",
        "unchanged": "changes no pixel's colour",
        "draws": "{n} draw|{n} draws",
        "vertices": "{n} vertex|{n} vertices",
        "clear": "clear",
        "pass.setup": "setup",
        "pass.reflection": "reflection",
        "pass.main": "main pass",
        "pass.overlay": "overlay",
        "in_pass": "{element} ({pass_})",
        "aside": "into framebuffer object {target}",
        "layers": "{mean} layers per pixel, at most {most}",
        "color": "colour",
        "depth": "depth",
        "stencil": "stencil",
        "overdraw": "overdraw",
        "legend.depth": "Depth, as distance from the eye in units of the scene (logarithmic)",
        "legend.window_depth": "Depth, as in the depth buffer",
        "legend.stencil": "Stencil values",
        "legend.overdraw": "Overdraw: fragments that passed all tests",
        "nothing": "nothing",
        "more": "{n} more values",
        "or_more": "{n} or more",
        "lacking": "no such buffer",
        "uncounted": "not counted here",
        "number": "Number",
        "code": "Call",
        "source": "Line of code",
        "rest": "{n} more; `landscape trace` prints all",
        "contents": "Steps",
        "alt": "{what} after step {number}, {title}",
    },
    "fr": {
        "title": "{name}\u00a0: une image se forme",
        "intro": "{width} × {height} pixels, {calls}, {draws}\u00a0; {steps}",
        "steps.pass": "une vignette par passe",
        "steps.element": "une vignette par élément, dans l'ordre où ils se dessinent",
        "steps.draw": "une vignette par dessin, avec son numéro dans la trace",
        "calls": "{n} appel|{n} appels",
        "listed": "{n} de plus dans des listes d'affichage",
        "changed": "change {percent}\u00a0% des pixels",
        "hardly": "change moins de {percent}\u00a0% des pixels",
        "unchanged": "ne change la couleur d'aucun pixel",
        "draws": "{n} dessin|{n} dessins",
        "vertices": "{n} sommet|{n} sommets",
        "clear": "effacement",
        "pass.setup": "préparation",
        "pass.reflection": "reflet",
        "pass.main": "passe principale",
        "pass.overlay": "incrustations",
        "in_pass": "{element} ({pass_})",
        "aside": "dans le framebuffer {target}",
        "layers": "{mean} couches par pixel, au plus {most}",
        "color": "couleur",
        "depth": "profondeur",
        "stencil": "pochoir",
        "overdraw": "couches",
        "legend.depth": "Profondeur, en distance à l'œil en unités de la scène (logarithmique)",
        "legend.window_depth": "Profondeur, comme dans le tampon",
        "legend.stencil": "Valeurs du pochoir",
        "legend.overdraw": "Couches\u00a0: fragments qui ont passé tous les tests",
        "nothing": "rien",
        "more": "{n} autres valeurs",
        "or_more": "{n} ou plus",
        "lacking": "pas de tel tampon",
        "uncounted": "non compté ici",
        "number": "Numéro",
        "code": "Appel",
        "source": "Ligne de code",
        "rest": "{n} autres\u00a0; `landscape trace` les écrit tous",
        "contents": "Étapes",
        "alt": "{what} après l'étape {number}, {title}",
        "element.ground": "terrain",
        "element.water": "eau",
        "element.sky": "ciel",
        "element.trees": "arbres",
        "element.deer": "cerfs",
        "element.plants": "plantes",
        "element.grass": "herbe",
        "element.castle": "château",
        "element.rabbit": "lapin",
        "element.dragon": "dragon",
        "element.sword": "épée",
        "element.map": "carte",
        "element.fog": "brouillard",
        "element.reflection": "reflet",
        "element.frame": "image",
    },
}


def text(language: str, key: str, **words: object) -> str:
    """Return a text in "en" or "fr"; ``words`` fill its {placeholders}."""
    return TEXTS[language][key].format(**words)


def counted(language: str, key: str, n: int) -> str:
    """Return a number of things: "1 call", "336 calls"."""
    one, _, many = TEXTS[language][key].partition("|")
    # In French 0 is singular, too.
    single = n == 1 or (language == "fr" and n == 0)
    return (one if single or not many else many).format(n=number(language, n))


def number(language: str, n: float, digits: int = 0) -> str:
    """Return a number as the language writes it: 1,234.5 or 1 234,5."""
    written = f"{n:,.{digits}f}"
    if language == "fr":
        written = written.replace(",", "\u202f").replace(".", ",")
    return written


def element(language: str, name: str) -> str:
    """Return an element's name; that of a program's own element is left as it is."""
    return TEXTS[language].get(f"element.{name}", name)


def pass_name(language: str, name: str) -> str:
    """Return a pass's name."""
    return TEXTS[language].get(f"pass.{name}", name)
