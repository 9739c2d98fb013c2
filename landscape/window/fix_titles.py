"""What the walk says of a fix, and the titles in French; landscape/fixes has the English ones."""

from landscape.languages import typeset
from landscape.scene import Fix
from landscape.window.words import text

_TITLES = {
    "R1": "Des nuages qui bougent",
    "R2": "Des flammes qui font face à l'œil",
    "R3": "Des sprites croisés dans le bon ordre",
    "R4": "Des arbres qui ne se couchent plus sur le dos",
    "R5": "Des cerfs debout sur la pente",
    "R6a": "Des plantes sans quadrilatère vu par la tranche",
    "R6b": "Des plantes qui, d'en haut, ne sont pas des croix",
    "R7": "Des brins tournés en partie vers l'œil",
    "R8": "Un ciel qui ne se rapproche pas",
    "R9": "Des parois de ciel qui ne cachent pas les collines",
    "R10": "Des coins aussi clairs que les parois",
    "R11": "Le mur de la porte en une seule couche de brouillard",
    "R12": "Un lapin dont la texture n'est pas pincée",
    "R13": "Une souris qui tourne la vue sans fin",
    "R14": "Un sol plus lisse avec les mêmes 50 x 50 sommets",
    "R15": "Debout sur les triangles dessinés",
    "R16": "Un reflet qui ondule",
    "R17": "Des vagues qui soulèvent la surface",
    "R18": "De l'herbe dessinée en un seul appel",
    "R19": "Des textures pas plus grandes qu'il ne faut",
    "best1": "Des hauts-fonds clairs",
    "best2": "De l'écume le long de la plage",
    "best3": "Le soleil sur l'eau",
    "best4": "Herbe, sable et roche",
    "best5": "De l'herbe en touffes",
    "stencil": "Un reflet qui finit avec l'eau",
}

TITLES = {name: typeset(title) for name, title in _TITLES.items()}


def said(fix: Fix, on: bool, language: str) -> str:
    """Return the message that names a fix and says whether it is on."""
    title = TITLES.get(fix.name, fix.title) if language == "fr" else fix.title
    state = text(language, "fix.on" if on else "fix.off")
    return text(language, "fix", name=fix.name, title=title, state=state)
