"""Rules about colours and texts: values out of range, and what a letter's place and colour are.

A colour of glColor3f goes from 0 to 1, one of glColor3ub from 0 to 255. Letters drawn as bitmaps
have the place and the colour of the last glRasterPos: later transformations and colours come late.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from framelens.gl.seam import Call, gl
from framelens.why.geometry import components
from framelens.why.survey import DRAWN_TEXT, Drawn, Survey
from framelens.why.suspects import Suspect, line_of, written
from framelens.why.trial import Action, Change


def ranges(survey: Survey) -> Iterator[Suspect]:
    """Colours from 0 to 255 where 0 to 1 is meant, and the other way round."""
    large: dict[str, tuple[Call, list[float]]] = {}
    small: dict[str, tuple[Call, list[float]]] = {}
    for step in survey.tape.steps():
        call = step.call
        name = call.name
        if not step.place or not name.startswith(("glColor3", "glColor4", "glClearColor")):
            continue
        numbers = components(call)
        if "ub" in name or name.endswith(("b", "bv", "i", "iv", "s", "sv", "us", "ui")):
            if "ub" in name and 0 < max(numbers[:3]) <= 1:
                small[step.place] = (call, numbers)
        elif max(numbers[:3]) >= 16.0 and all(n == int(n) for n in numbers[:3]):
            large[step.place] = (call, numbers)

    if large:
        first, numbers = next(iter(large.values()))
        instead: dict[str, Sequence[Action]] = {}
        for place, (call, values) in large.items():
            scaled = [v / 255.0 for v in values[:3]]
            alpha = values[3] / 255.0 if len(values) > 3 and values[3] > 1 else (values + [1.0])[3]
            if call.name == "glClearColor":
                instead[place] = [("glClearColor", (*scaled, alpha))]
            else:
                instead[place] = [("glColor4f", (*scaled, alpha if len(values) > 3 else 1.0))]
        yield Suspect(
            "color-range",
            at=first,
            change=Change(instead=instead),
            strength=90,
            state="GL_COLOR_CLEAR_VALUE" if first.name == "glClearColor" else "GL_CURRENT_COLOR",
            value=numbers,
            values={"call": written(first)},
        )

    if small:
        first, numbers = next(iter(small.values()))
        yield Suspect(
            "color-range-bytes",
            at=first,
            change=Change(
                instead={
                    place: [("glColor4f", (*values[:3], 1.0))]
                    for place, (_, values) in small.items()
                }
            ),
            strength=84,
            state="GL_CURRENT_COLOR",
            value=numbers,
            values={"call": written(first)},
        )


def texts(survey: Survey) -> Iterator[Suspect]:
    """Letters that are not drawn, or not in the colour that was set for them."""
    letters = [d for d in survey.shapes if d.call.name.startswith(DRAWN_TEXT)]
    done: set[int] = set()
    for draw in letters:
        setter = draw.setter("GL_CURRENT_RASTER_POSITION")
        if setter is not None and setter.name == "glBitmap":
            setter = None
        raster = _raster(survey, draw)
        if raster is None or raster.number in done:
            continue
        done.add(raster.number)
        mine = [d for d in letters if _raster(survey, d) is raster]
        if not draw.state["GL_CURRENT_RASTER_POSITION_VALID"]:
            yield _invalid(survey, draw, raster, mine)
            continue
        yield from _colored(survey, draw, raster, mine)


def _raster(survey: Survey, draw: Drawn) -> Call | None:
    found = None
    for call in survey.tape.calls[: draw.number + 1]:
        if call.name.startswith(("glRasterPos", "glWindowPos")):
            found = call
    return found


def _invalid(survey: Survey, draw: Drawn, raster: Call, mine: list[Drawn]) -> Suspect:
    numbers = components(raster)
    point = np.array([*numbers, *[0.0, 0.0, 0.0, 1.0][len(numbers) :]][:4], float)
    modelview = _at(survey, raster, "GL_MODELVIEW_MATRIX", draw)
    projection = _at(survey, raster, "GL_PROJECTION_MATRIX", draw)
    clip = point @ modelview @ projection

    width, height = survey.tape.size
    w = clip[3] or 1.0
    x, y = (clip[0] / w + 1) / 2 * width, (clip[1] / w + 1) / 2 * height
    inside = (min(max(x, 2.0), width - 20.0), min(max(y, 2.0), height - 12.0))

    return Suspect(
        "raster-invalid",
        at=raster,
        change=Change(after={str(raster.number): [("glWindowPos2f", inside)]}),
        strength=91,
        state="GL_CURRENT_RASTER_POSITION_VALID",
        value=False,
        values={"call": written(raster), "x": round(float(x), 1), "y": round(float(y), 1)},
        draws=mine,
        source=line_of(survey, draw),
        reach=GUESSED,
    )


GUESSED = 60  # pixels between where letters were to be and where they are tried; chosen


def _at(survey: Survey, call: Call, name: str, draw: Drawn) -> np.ndarray:
    return np.array(draw.state[name], np.float64).reshape(4, 4)


def _colored(survey: Survey, draw: Drawn, raster: Call, mine: list[Drawn]) -> Iterator[Suspect]:
    calls = survey.tape.calls
    later = [c for c in calls[raster.number : draw.number] if c.name.startswith("glColor")]
    later = [c for c in later if not c.name.startswith(("glColorMask", "glColorMat", "glColorP"))]
    if later:
        color = later[-1]
        yield Suspect(
            "color-after-raster",
            at=color,
            change=Change(before={str(raster.number): [(color.name, color.args)]}),
            strength=89,
            state="GL_CURRENT_RASTER_COLOR",
            value=[round(float(v), 3) for v in draw.state["GL_CURRENT_RASTER_COLOR"]],
            values={"call": written(color), "raster": raster.site.line},
            draws=mine,
        )
        return

    if draw.state["GL_LIGHTING"]:
        yield _lit_text(raster, mine)
    if draw.state["GL_TEXTURE0.GL_TEXTURE_2D"]:
        yield _textured_text(draw, raster, mine)


def _lit_text(raster: Call, mine: list[Drawn]) -> Suspect:
    place = str(raster.number)
    return Suspect(
        "text-lit",
        at=raster,
        change=Change(
            before={place: [("glDisable", (gl.GL_LIGHTING,))]},
            after={place: [("glEnable", (gl.GL_LIGHTING,))]},
        ),
        strength=88,
        state="GL_LIGHTING",
        value=True,
        values={"raster": raster.site.line},
        draws=mine,
    )


def _textured_text(draw: Drawn, raster: Call, mine: list[Drawn]) -> Suspect:
    place = str(raster.number)
    around = {
        "before": {place: [("glDisable", (gl.GL_TEXTURE_2D,))]},
        "after": {mine[-1].place: [("glEnable", (gl.GL_TEXTURE_2D,))]},
    }
    return Suspect(
        "text-textured",
        at=draw.setter("GL_TEXTURE0.GL_TEXTURE_2D") or raster,
        change=Change(**around),  # type: ignore[arg-type]
        strength=87,
        state="GL_TEXTURE_2D",
        value=True,
        values={"raster": raster.site.line},
        draws=mine,
    )


RULES = (ranges, texts)
