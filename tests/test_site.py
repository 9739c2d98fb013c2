"""The site's pages as they are written from the code; `make docs-check` looks at the built site."""

import re
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest
from commands import TESTS
from PIL import Image, features

from framelens.base.errors import InputError
from framelens.base.texts import LANGUAGES, translator
from framelens.spec import spec
from landscape.commands.lesson import described, program_described
from landscape.course.ladder import LADDER, lessons, program_files
from landscape.course.pages import as_markdown, blocks
from landscape.course.shelf import NAMES, exercise
from landscape.gallery.scene_captions import INTRODUCTIONS, STEPS, VIEW_TEXTS
from landscape.scene.scene import scene

SITE = TESTS.parent / "scripts" / "site"
MODULES = (
    "calls",
    "documents",
    "drawn",
    "exercise_pages",
    "gallery",
    "lesson_pages",
    "links",
    "share",
    "sizes",
    "start",
    "theme",
)


@pytest.fixture
def site(monkeypatch: pytest.MonkeyPatch) -> Any:
    """The script's modules by name."""
    import importlib
    import sys

    monkeypatch.syspath_prepend(str(SITE))
    modules: dict[str, ModuleType] = {}
    for name in MODULES:
        modules[name] = importlib.import_module(name)
    yield type("Site", (), modules)
    for name in MODULES:
        del sys.modules[name]


def pages(site: Any, language: str, folder: Path) -> dict[str, str]:
    """Return all pages, as if each lesson called two functions."""
    drawn = site.drawn.Drawn(folder)
    for lesson in lessons():
        drawn.add([site.drawn.Seen("glVertex3f", lesson.name, f"{lesson.name}.py:20")])
        drawn.add([site.drawn.Seen("glVertex2f", lesson.name, f"{lesson.name}.py:21")])
    drawn.add([site.drawn.Seen("glFogf", "island/fog", "landscape/elements/fog.py:31")])
    drawn.add([site.drawn.Seen("glStencilOp", "hall/mirror", "landscape/hall/mirror.py:40")])
    drawn.add([site.drawn.Seen("glStencilOp", "exercise/stencil_mirror", "")])
    index = site.calls.index(drawn)
    return {
        **site.start.pages(language),
        **site.lesson_pages.pages(language, drawn),
        **site.exercise_pages.pages(language),
        **site.gallery.pages(language),
        **site.documents.pages(language),
        **site.calls.pages(language, index),
    }


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.sweep(14, first=1)
def test_each_page_that_a_page_lists_is_written(language: str, site: Any, tmp_path: Path) -> None:
    found = pages(site, language, tmp_path)
    listed = {"index"}
    for name, text in found.items():
        if text.startswith(site.calls.ORPHAN):
            assert f"]({name.rpartition('/')[2]}.md)" in found["calls/index"]
            listed.add(name)
            text = text.removeprefix(site.calls.ORPHAN)
        assert text.startswith("# "), name
        folder = name.rpartition("/")[0]
        for tree in re.findall(r"```\{toctree\}\n(.*?)```", text, re.DOTALL):
            entries = [line for line in tree.splitlines() if line and line[0] != ":"]
            listed |= {f"{folder}/{entry}".lstrip("/") for entry in entries}
    assert listed == set(found)


@pytest.mark.seldom(13, first=3)
def test_a_function_is_indexed_with_its_variants_and_who_calls_it(
    site: Any, tmp_path: Path
) -> None:
    found = pages(site, "en", tmp_path)
    vertex = found["calls/glVertex"]
    assert "`glVertex2f`, `glVertex3f`" in vertex
    for lesson in lessons():
        assert f'<a href="../lessons/{lesson.name}.html#line-21">21</a>' in vertex
    assert "fog: `landscape/elements/fog.py:31`" in found["calls/glFog"]
    stencil = found["calls/glStencilOp"]
    assert "## In the great hall\n\n- mirror: `landscape/hall/mirror.py:40`" in stencil
    assert "](../exercises/stencil_mirror.md)" in stencil and "## On the island" not in stencil
    explained = spec.explain("glFogf", "en")
    assert explained and explained in found["calls/glFog"] and explained in found["calls/index"]
    assert "[`glFog`](glFog.md)" in found["calls/index"]


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.sweep(14, first=5)
def test_the_page_of_a_lesson_holds_its_whole_program(
    language: str, site: Any, tmp_path: Path
) -> None:
    found = pages(site, language, tmp_path)
    for lesson in lessons():
        page = found[f"lessons/{lesson.name}"]
        assert described(lesson, language) in page
        assert f"landscape strip {lesson.name}.py --frame {lesson.frame}\n" in page
        assert f"../pictures/{lesson.name}-strip.webp" in page
        files = [file for name in lesson.programs for file in program_files(name)]
        assert all(program_described(file, language) in page for file in files)


def test_the_theme_s_words_and_labels_are_translated(site: Any, tmp_path: Path) -> None:
    site.theme.write_words(tmp_path, "fr")
    words = (tmp_path / "locales" / "fr" / "LC_MESSAGES" / "sphinx.po").read_text(encoding="utf-8")
    assert 'msgid "Next"\nmsgstr "Suivant"\n' in words
    page = tmp_path / "a.html"
    page.write_text('<a aria-label="Toggle site navigation sidebar"></a>')
    site.theme.reword_labels(tmp_path, "fr")
    text = page.read_text(encoding="utf-8")
    assert text.startswith('<a aria-label="') and "Toggle" not in text


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.sweep(14, first=9)
def test_the_page_of_an_exercise_has_two_pictures_its_task_and_its_lessons(
    language: str, site: Any, tmp_path: Path
) -> None:
    found = pages(site, language, tmp_path)
    for each in map(exercise, NAMES):
        page = found[f"exercises/{each.name}"]
        assert all(
            site.exercise_pages.markdown(each.translate.to(language)(text)) in page
            for text in each.task
        )
        for kind in ("start", "wanted"):
            assert f"../pictures/exercise-{each.name}-{kind}.webp" in page
        assert each.lessons
        for name in each.lessons:
            assert f"(../lessons/{name}.md)" in page
            assert f"(../exercises/{each.name}.md)" in found[f"lessons/{name}"]


@pytest.mark.parametrize("name", VIEW_TEXTS)
@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.sweep(14, first=9)
def test_the_page_of_a_scene_shows_every_picture_and_a_slider_for_every_safeguard(
    language: str, name: str, site: Any, tmp_path: Path
) -> None:
    page = pages(site, language, tmp_path)[f"{name}/index"]
    kind = scene(name)
    kept = {path.name for path in site.gallery.pictures()}
    steps = [step for _, _, steps in STEPS.get(name, ()) for step in steps]
    for view in (*VIEW_TEXTS[name], *(step.name for step in steps)):
        assert f"{{figure}} ../pictures/{view}.webp" in page
        assert f"{view}.webp" in kept
    for fix in kind.fixes:
        before, after = (f"{fix.name}_{when}.webp" for when in ("before", "after"))
        assert f"{{before-after}} ../pictures/{before} ../pictures/{after}" in page
        assert {before, after} <= kept
    texts = [*INTRODUCTIONS[name], *(step.look for step in steps)]
    for text in (*texts, *(text for fix in kind.fixes for text in fix.seen)):
        text = translator(language, "gallery")(text).replace("../../docs/", "../documents/")
        assert text in page


def test_a_committed_picture_is_taken_as_it_is_if_it_is_webp_already(
    site: Any, tmp_path: Path
) -> None:
    for language in LANGUAGES:
        (tmp_path / language).mkdir()
    image = Image.linear_gradient("L").convert("RGB")
    for suffix in ("webp", "png"):
        image.save(tmp_path / f"{suffix}.{suffix}", quality=10)
        site.drawn.shrink(tmp_path / f"{suffix}.{suffix}", tmp_path)
    wanted = (tmp_path / "webp.webp").read_bytes()
    for language in LANGUAGES:
        assert (tmp_path / language / "webp.webp").read_bytes() == wanted
        with Image.open(tmp_path / language / "png.webp") as picture:
            assert picture.format == "WEBP"


def test_a_picture_of_two_languages_is_kept_once_and_its_pages_lead_there(
    site: Any, tmp_path: Path
) -> None:
    french = tmp_path / "fr"
    for folder in (tmp_path / "_images", french / "_images", french / "lessons"):
        folder.mkdir(parents=True)
    for name, english, other in (("a.webp", b"same", b"same"), ("b.webp", b"en", b"fr")):
        (tmp_path / "_images" / name).write_bytes(english)
        (french / "_images" / name).write_bytes(other)
    text = '<img src="../_images/a.webp"><a href="../_images/b.webp"></a>_images/a.webp'
    (french / "lessons" / "x.html").write_text(text)
    (french / "index.html").write_text('<img src="_images/a.webp">')
    site.share.pictures(tmp_path, french)
    assert [path.name for path in (french / "_images").iterdir()] == ["b.webp"]
    assert (french / "lessons" / "x.html").read_text() == text.replace(
        '"../_images/a', '"../../_images/a'
    )
    assert (french / "index.html").read_text() == '<img src="../_images/a.webp">'
    assert list(site.links.dead_links(tmp_path)) == []


@pytest.fixture
def conf(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Sphinx's configuration."""
    pytest.importorskip("sphinx")
    import importlib

    monkeypatch.syspath_prepend(str(TESTS.parent / "docs" / "site"))
    return importlib.import_module("conf")


def test_the_search_in_french_takes_no_notice_of_accents(conf: Any) -> None:
    stem = conf.French({}).stem
    assert stem("Lumière") == stem("lumiere") and stem("œil") == stem("oeil")
    assert stem("lumières") == stem("lumiere")


def test_a_site_that_is_too_large_is_told_by_sort_of_file(
    site: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    files = ("a.html", "b-loop.avif", "b-strip.webp", "b.webp", "searchindex.js")
    for number, name in enumerate(files, 1):
        (tmp_path / name).write_bytes(bytes(number * 1000))
    found = site.sizes.sizes(tmp_path)
    assert list(found) == list(site.sizes.LIMITS)
    assert list(found.values()) == [0.001, 0.002, 0.003, 0.004, 0.005]
    assert list(site.sizes.too_large(tmp_path)) == []
    monkeypatch.setitem(site.sizes.LIMITS, "strips", 0.002)
    monkeypatch.setattr(site.sizes, "TOTAL", 0.01)
    strips, total = site.sizes.too_large(tmp_path)
    assert strips.startswith("strips: ") and total.startswith("the site: ")


def test_a_strip_is_kept_in_the_smaller_format_and_its_page_names_that(
    site: Any, tmp_path: Path
) -> None:
    drawn = site.drawn.Drawn(tmp_path)
    drawn.pictures("en").mkdir()
    noise = Image.effect_noise((320, 240), 60).convert("RGB")
    flat = Image.new("RGB", (320, 240), "navy")
    for name, picture in (("noise", noise), ("flat", flat)):
        sheet = drawn.pictures("en") / f"{name}-strip.png"
        picture.save(sheet)
        site.drawn._save_sheet(sheet)
        assert not sheet.exists()
        with Image.open(drawn.pictures("en") / drawn.strip(name, "en")) as kept:
            assert kept.size == (320, 240)
    assert drawn.strip("flat", "en") == "flat-strip.webp"
    wanted = "avif" if features.check("avif") else "webp"
    assert drawn.strip("noise", "en") == f"noise-strip.{wanted}"
    assert len(list(drawn.pictures("en").iterdir())) == 2


def test_pages_are_written_anew_with_the_calls_of_the_last_build(site: Any, tmp_path: Path) -> None:
    drawn = site.drawn.Drawn(tmp_path)
    drawn.add([site.drawn.Seen("glFogf", "island/fog", "fog.py:31")])
    with pytest.raises(InputError):
        site.drawn.Drawn.kept(tmp_path)
    drawn.keep()
    assert site.drawn.Drawn.kept(tmp_path) == drawn


def test_the_sidebar_has_the_lessons_of_the_page_s_own_topic(conf: Any) -> None:
    first, other = (
        next(each for each in lessons() if each.topic == topic) for topic in list(LADDER)[:2]
    )
    entry = '<li class="toctree-l2"><a class="reference internal" href="{}.html">X</a></li>\n'
    tree = entry.format(first.name) + entry.format(other.name)
    context: dict[str, Any] = {}
    conf.open_branch(None, f"lessons/{first.name}", "", context, None)
    assert context["neighbours"](tree) == entry.format(first.name)
    conf.open_branch(None, "exercises/mirror", "", context, None)
    assert context["neighbours"](tree) == tree


def test_a_call_in_code_is_a_link_but_not_inside_a_link(conf: Any) -> None:
    code = '<code class="docutils literal notranslate"><span class="pre">glFogf</span></code>'
    app = SimpleNamespace(call_pages={"glFogf": "calls/glFog"})
    marked = '<span class="n">glFogf</span><span class="p">(</span><span class="mi">1</span>'
    linked = f'<a class="reference internal" href="glFog.html"><span>{code}</span></a>'
    context = {"body": f"<p>{code}</p>{linked}<pre>{marked}</pre>"}
    conf.link_calls(app, "calls/index", "", context, None)
    link = '<a class="call" href="../calls/glFog.html">glFogf</a>'
    assert context["body"] == (
        f'<p>{code.replace("glFogf", link)}</p>{linked}<pre>{link}(<span class="mi">1</span></pre>'
    )


def test_a_dead_link_and_a_missing_place_are_found(site: Any, tmp_path: Path) -> None:
    (tmp_path / "a.html").write_text(
        '<h1 id="here"></h1><a href="b.html#there"></a><a href="b.html#gone"></a>'
        '<a href="#here"></a><img src="c.png"><a href="https://example.org/x"></a>'
    )
    (tmp_path / "b.html").write_text('<p id="there"></p>')
    assert list(site.links.dead_links(tmp_path)) == [
        "a.html: leads to b.html#gone, which is not there",
        "a.html: leads to c.png, which is not there",
    ]


@pytest.mark.parametrize("name", ["docs/frame", "docs/gate", "docs/performance", "README"])
def test_a_document_taken_apart_and_put_together_says_the_same(name: str) -> None:
    text = (TESTS.parent / f"{name}.md").read_text(encoding="utf-8")
    again = as_markdown(blocks(text))
    assert again.split() == text.split()
    assert as_markdown(blocks(again)) == again


def test_blocks_are_what_is_translated() -> None:
    text = "# A\n\none\ntwo\n- x\n- y\n\n1. z\n\n    code\n\n| a | b |\n|---|---|\n"
    text += "| c | d |\n| fig35a | -3.9 |\n"
    assert [(b.mark, b.text) for b in blocks(text, str.upper)] == [
        ("# ", "A"),
        ("", "ONE TWO"),
        ("- ", "X"),
        ("- ", "Y"),
        ("1. ", "Z"),
        ("```", "    code"),
        ("| ", "| A | B |"),
        ("```", "|---|---|"),
        ("| ", "| C | D |"),
        ("```", "| fig35a | -3.9 |"),
    ]


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_document_shows_only_pictures_that_the_site_has(language: str, site: Any) -> None:
    kept = {path.stem for path in site.gallery.pictures()}
    beside = {path.name for path in site.documents.pictures()}
    for name, text in site.documents.pages(language).items():
        for target in re.findall(r"!\[[^\]]*\]\(([^)]+)\)", text):
            folder, _, file = target.rpartition("/")
            stem, _, suffix = file.rpartition(".")
            assert (
                file in beside
                if not folder
                else (folder, suffix) == ("../pictures", "webp") and stem in kept
            ), f"{name}: {target}"


def test_each_document_with_a_translation_is_on_the_site(site: Any) -> None:
    catalogues = TESTS.parent / "landscape" / "locale" / "fr" / "docs"
    translated = {path.stem for path in catalogues.glob("*.po")} - {"README"}
    assert translated == {*site.documents.ALL}
