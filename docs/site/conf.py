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

from landscape.course.ladder import lessons

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

# Names, punctuation and spaces, which both styles leave in the colour of the text: their marks were
# a fifth of a page of code.
PLAIN = re.compile(r'<span class="[npw]">([^<]*|<a class="call"[^>]*>\w+</a>)</span>')
# A page that is listed in the sidebar, of the second level.
ENTRY = re.compile(r'<li class="toctree-l2"><a [^>]*href="([^"#]+)"[^>]*>.*?</a></li>\n?')
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

    def outside_links(match: re.Match[str]) -> str:
        return match[0] if match[1] else re.sub(inline, link, match[0])

    body = re.sub(r'(<span class="n[a-z]*">)(gl[A-Z]\w+)(</span>)', link, context["body"])
    inline = r'(<code class="docutils literal notranslate"><span class="pre">)(gl[A-Z]\w+)(</span>)'
    anchor = r"(<a [^>]*>(?:<span[^>]*>)?)"  # what is in a link already leads elsewhere
    body = re.sub(f"{anchor}?{inline}", outside_links, body)
    line = r'<span class="linenos">( *(\d+))</span>'
    body = re.sub(line, r'<span class="linenos" id="line-\2">\1</span>', body)
    context["body"] = PLAIN.sub(r"\1", body)


def open_branch(app, pagename, templatename, context, doctree) -> None:
    """Give the sidebar a function that leaves, of the lessons, those of the page's own topic."""
    topics = {f"{lesson.name}.html": lesson.topic for lesson in lessons()}
    own = topics.get(f"{pagename.removeprefix('lessons/')}.html")

    def kept(match: re.Match[str]) -> str:
        return match[0] if topics.get(match[1], own) == own else ""

    def neighbours(tree: str) -> str:
        return ENTRY.sub(kept, tree) if own else tree

    context["neighbours"] = neighbours


def setup(app) -> None:
    app.call_pages = json.loads(CALLS.read_text()) if CALLS.exists() else {}
    app.add_directive("before-after", BeforeAfter)
    app.connect("html-page-context", link_calls)
    app.connect("html-page-context", open_branch)
    app.connect("build-finished", fold_queries)
    languages["fr"] = French
