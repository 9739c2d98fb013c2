"""The built site, checked: its size, its links, and its pages in headless Chromium, offline."""

import shutil
from collections.abc import Iterator
from pathlib import Path

from links import dead_links
from playwright.sync_api import Browser, Page, sync_playwright
from sizes import too_large

from framelens.base.texts import LANGUAGES

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
PHONE, DESK = {"width": 390, "height": 844}, {"width": 1280, "height": 900}
FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-background-networking"]
LOAD_ALL = "() => [...document.images].forEach(i => i.loading = 'eager')"
LOADED = "() => [...document.images].every(i => i.complete)"
BROKEN = "() => [...document.images].filter(i => !i.naturalWidth).map(i => i.src)"
TOO_WIDE = """() => document.documentElement.scrollWidth > innerWidth
    || [...document.images].some(i => i.getBoundingClientRect().right > innerWidth)"""
CUT = "pair => pair.style.getPropertyValue('--cut')"
BACKGROUND = "() => getComputedStyle(document.body).backgroundColor"


def check(site: Path) -> list[str]:
    """Return a line for each fault."""
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    if browser is None:
        return [f"found no browser to check with: expected one of {', '.join(BROWSERS)}"]
    faults = [*too_large(site), *dead_links(site)]
    with sync_playwright() as playwright:
        opened = playwright.chromium.launch(executable_path=browser, args=FLAGS)
        faults += _looked_at(opened, site)
        opened.close()
    return faults


def _looked_at(browser: Browser, site: Path) -> Iterator[str]:
    """Yield a line for each fault that shows in the browser."""
    for language in LANGUAGES:
        home = site if language == "en" else site / language
        context = browser.new_context(viewport=DESK, offline=True, color_scheme="light")
        page = context.new_page()
        said: list[str] = []
        page.on("console", lambda message, said=said: said.append(message.text))
        page.on("pageerror", lambda error, said=said: said.append(str(error)))
        for path in _chosen(home):
            said.clear()
            page.goto(path.as_uri())
            where = path.relative_to(site)
            # Pictures below are loaded as one scrolls.
            page.evaluate(
                "() => document.querySelectorAll('img').forEach(i => i.loading = 'eager')"
            )
            page.wait_for_function(LOADED)
            yield from (f"{where}: the console says {text}" for text in said)
            yield from (f"{where}: a picture does not load: {uri}" for uri in page.evaluate(BROKEN))
            page.set_viewport_size(PHONE)
            if page.evaluate(TOO_WIDE):
                yield f"{where}: is wider than a phone"
            page.set_viewport_size(DESK)

        yield from _slider(page, home)
        yield from _search(page, home)
        yield from _french(page, home)
        yield from _dark(browser, home)
        context.close()


def _chosen(home: Path) -> list[Path]:
    """Return the pages to look at: all but those of the calls, of which a few."""
    pages = sorted(home.rglob("*.html"))
    own = [p for p in pages if home / "fr" not in p.parents]
    calls = [p for p in own if p.parent.name == "calls"]
    return [p for p in own if p not in calls] + calls[::10]


def _slider(page: Page, home: Path) -> Iterator[str]:
    page.goto((home / "figures" / "fixes.html").as_uri())
    pair = page.locator(".before-after").first
    before = pair.evaluate(CUT)
    pair.locator("input").focus()
    page.keyboard.press("Home")
    if (before, pair.evaluate(CUT)) != ("50%", "0%"):
        yield f"{home.name}: the slider between two pictures does not move by a key"
    box = pair.bounding_box()
    assert box is not None
    page.mouse.click(box["x"] + box["width"] * 0.75, box["y"] + box["height"] / 2)
    cut = pair.evaluate(CUT)
    if cut not in [f"{percent}%" for percent in range(70, 81)]:
        yield f"{home.name}: the slider does not follow the mouse"


def _search(page: Page, home: Path) -> Iterator[str]:
    page.goto((home / "search.html").as_uri() + "?q=glClipPlane")
    results = page.locator("ul.search li a")
    results.first.wait_for()
    found = [link.get_attribute("href") or "" for link in results.all()]
    if not any("calls/glClipPlane.html" in link for link in found):
        yield f"{home.name}: the search does not find glClipPlane, but {found[:5]}"


def _french(page: Page, home: Path) -> Iterator[str]:
    """Search for a word of French without its accents."""
    if home.name != "fr":
        return
    counts = []
    for word in ("lumière", "lumiere"):
        page.goto((home / "search.html").as_uri() + f"?q={word}")
        page.wait_for_function("() => Search._pulse_status === -1")  # the results come one by one
        counts.append(page.locator("ul.search li a").count())
    # A title is searched as it is written, too.
    if counts[1] < 0.9 * counts[0] or not counts[0]:
        yield f"fr: the search finds {counts[0]} pages with an accent and {counts[1]} without"


def _dark(browser: Browser, home: Path) -> Iterator[str]:
    colours = set()
    for scheme in ("light", "dark"):
        context = browser.new_context(color_scheme=scheme)  # type: ignore[arg-type]
        page = context.new_page()
        page.goto((home / "index.html").as_uri())
        colours.add(page.evaluate(BACKGROUND))
        context.close()
    if len(colours) != 2:
        yield f"{home.name}: dark and light look the same"
