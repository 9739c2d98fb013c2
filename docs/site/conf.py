"""Sphinx's configuration of the site; scripts/site writes the pages and runs it."""

import json
import re
import unicodedata
from pathlib import Path

from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.search import languages
from sphinx.search.fr import SearchFrench
from sphinx.util.docutils import SphinxDirective

project = "landscape"
author = "The landscape authors"
extensions = ["myst_parser", "sphinx_design"]
myst_enable_extensions = ["colon_fence"]
myst_heading_anchors = 3
html_theme = "furo"
html_title = "landscape"
html_static_path = ["_static"]
templates_path = ["_templates"]
html_css_files = ["site.css"]
html_js_files = ["slider.js"]
html_codeblock_linenos_style = "inline"
html_show_search_summary = False  # it fetches pages, which no browser does from files
html_copy_source = False
html_show_sourcelink = False
html_show_sphinx = False
html_show_copyright = False
html_sidebars = {
    "**": [
        "sidebar/brand.html",
        "languages.html",
        "sidebar/search.html",
        "sidebar/scroll-start.html",
        "sidebar/navigation.html",
        "sidebar/scroll-end.html",
    ]
}
html_theme_options = {"navigation_with_keys": True}
pygments_style = "friendly"
pygments_dark_style = "native"

CALLS = Path(__file__).parent / "calls.json"


class French(SearchFrench):
    """The search in French: a word is found with its accents and without them."""

    def stem(self, word: str) -> str:
        return super().stem(without_accents(word.lower()))


def without_accents(word: str) -> str:
    plain = word.replace("œ", "oe").replace("æ", "ae")
    return "".join(c for c in unicodedata.normalize("NFD", plain) if not unicodedata.combining(c))


# The same for what a reader types; appended to the stemmer that Sphinx writes.
FOLDING = r"""
window.Stemmer = class extends window.Stemmer {
  stemWord(word) {
    const plain = word.replaceAll("œ", "oe").replaceAll("æ", "ae");
    return super.stemWord(plain.normalize("NFD").replace(/\p{M}/gu, ""));
  }
};
"""


def fold_queries(app, error) -> None:
    """Let the search of the built pages take queries without accents."""
    data = Path(app.outdir) / "_static" / "language_data.js"
    if error is None and app.config.language == "fr" and data.exists():
        written = data.read_text(encoding="utf-8")
        if FOLDING not in written:
            data.write_text(written + FOLDING, encoding="utf-8")


class BeforeAfter(SphinxDirective):
    """Two pictures of one size on top of each other, with a slider between them."""

    required_arguments = 2
    option_spec = {"before": directives.unchanged, "after": directives.unchanged,
                   "label": directives.unchanged}  # fmt: skip

    def run(self) -> list[nodes.Node]:
        pair = nodes.container(classes=["before-after"])
        for uri, side in zip(self.arguments, ("before", "after"), strict=True):
            image = nodes.image(uri=uri, alt=self.options.get(side, ""), classes=[side])
            self.set_source_info(image)
            pair += image
        label = self.options.get("label", "")
        slider = f'<input type="range" min="0" max="100" value="50" aria-label="{label}">'
        pair += nodes.raw("", slider, format="html")
        return [pair]


def link_calls(app, pagename, templatename, context, doctree) -> None:
    """Make each OpenGL call in code a link to what it does, and each line of code a target."""
    if "body" not in context:
        return
    up = "../" * pagename.count("/")
    pages = app.call_pages

    def link(match: re.Match[str]) -> str:
        page = pages.get(match[2])
        if page in (None, pagename):
            return match[0]
        return f'{match[1]}<a class="call" href="{up}{page}.html">{match[2]}</a>{match[3]}'

    body = re.sub(r'(<span class="n[a-z]*">)(gl[A-Z]\w+)(</span>)', link, context["body"])
    inline = r'(<code class="docutils literal notranslate"><span class="pre">)(gl[A-Z]\w+)(</span>)'
    body = re.sub(inline, link, body)
    line = r'<span class="linenos">( *(\d+))</span>'
    context["body"] = re.sub(line, r'<span class="linenos" id="line-\2">\1</span>', body)


def setup(app) -> None:
    app.call_pages = json.loads(CALLS.read_text()) if CALLS.exists() else {}
    app.add_directive("before-after", BeforeAfter)
    app.connect("html-page-context", link_calls)
    app.connect("build-finished", fold_queries)
    languages["fr"] = French
