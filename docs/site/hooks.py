"""What MkDocs does not do by itself: references, links to files outside docs, captions, formulas, the date.

A page says ``<!-- generated: scene -->`` where ``reference.scene()`` belongs, or a function of ``structure``;
the text is made when the site is built and kept nowhere else. Formulas between dollar signs become MathML
when the site is built, so that no script has to set them in the browser. The foot of each page states version
and date of the commit, not of the build: the same commit makes the same files.
"""

import functools
import html
import importlib.util
import json
import logging
import posixpath
import re
import subprocess
from pathlib import Path

from latex2mathml.converter import convert
from mkdocs.structure.files import File, InclusionLevel

from fmu_bearing import __version__

ROOT = Path(__file__).parents[2]

#: Who searches for a command or a variable looks for what it means, not for every page that uses it.
_REFERENCES = ("cli.md", "fmu-reference.md")
#: Pages of the root of the repository that have a place in the site.
_ROOT_PAGES = {"CHANGELOG.md": "changes.md", "CONTRIBUTING.md": "contributing.md"}


def _beside(name):
    """Load a module beside this one by its path: MkDocs puts no folder of hooks on the import path."""
    spec = importlib.util.spec_from_file_location(f"docs_{name}", Path(__file__).with_name(f"{name}.py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


_makers = vars(_beside("reference")) | vars(_beside("structure"))

_log = logging.getLogger("mkdocs.hooks")

_GENERATED = re.compile(r"<!-- generated: (\w+) -->")
_LINK = re.compile(r"(?<=\]\()((?:\.\./)+[^)#\s]+)")
_PICTURE = re.compile(r'<p>(<img alt="([^"]+)" src="[^"]+" */?>)</p>')
_ROLE = re.compile(r":(?:func|class|meth|mod):(?=<code|`)")
_FORMULA = re.compile(r'<(span|div) class="arithmatex">\\[(\[](.*?)\\[)\]]</\1>', re.DOTALL)
_SIGN = re.compile(r"(?<=&#x000(?:3D|2C|28);</mo>)<mo>(?=&#x0(?:2212|002B);)")
_FUNCTION = re.compile(r"<mi>(sin|cos|log)</mi>")
_LANGUAGES = {".py": "python", ".toml": "toml", ".c": "c", ".h": "c"}


def on_config(config):
    """State version and date at the foot of each page."""
    config.copyright = ", ".join(filter(None, (f"fmu-bearing {__version__}", _date())))
    return config


@functools.cache
def _date():
    """Date of the commit (YYYY-MM-DD); empty where there is no git, as in an unpacked source distribution."""
    try:
        command = ["git", "-C", str(ROOT), "log", "-1", "--format=%cs"]
        return subprocess.run(command, capture_output=True, text=True, check=True, timeout=60).stdout.strip()
    except (OSError, subprocess.SubprocessError):
        return ""


def on_files(files, config):
    """Add pages of the root, and each file outside docs that a page links to as a page of its own."""
    for name, page in _ROOT_PAGES.items():
        content = (ROOT / name).read_text("utf-8").replace("](docs/", "](")
        for other, place in _ROOT_PAGES.items():
            content = content.replace(f"]({other}", f"]({place}")
        files.append(File.generated(config, page, content=content))
    linked = {
        _outside(file.src_uri, link)
        for file in files.documentation_pages()
        for link in _LINK.findall(file.content_string)
    } - {None}
    for path in sorted(linked - set(_ROOT_PAGES)):
        files.append(
            File.generated(
                config, _source_page(path), content=_shown(path), inclusion=InclusionLevel.NOT_IN_NAV
            )
        )
    return files


def on_page_markdown(markdown, page, config, files):
    """Put generated references in their places, and point links to files outside docs at their pages."""
    here = page.file.src_uri
    if here in _REFERENCES:
        page.meta.setdefault("search", {"boost": 4})
    page.update_date = _date() or page.update_date  # in the map of the site
    if here.startswith("results/"):
        page.meta.setdefault("hide", ["toc"])  # room for wide tables
    markdown = _GENERATED.sub(lambda match: _makers[match[1]](), markdown)

    def pointed(match):
        path = _outside(here, match[1])
        if path is None:
            return match[1]
        return posixpath.relpath(_source_page(path), posixpath.dirname(here) or ".")

    return _LINK.sub(pointed, markdown)


def on_page_content(content, page, config, files):
    """Set formulas, and turn a picture that stands alone into a figure; its text becomes the caption."""
    content = _FORMULA.sub(lambda match: _mathml(match, page.file.src_uri), content)
    content = _ROLE.sub("", content)
    content = _PICTURE.sub(r"<figure>\1<figcaption>\2</figcaption></figure>", content)
    return f'<div class="results">{content}</div>' if page.file.src_uri.startswith("results/") else content


def _mathml(match, page):
    """Return a formula as MathML; one that the converter does not know is a warning, an error if strict."""
    tag, tex = match[1], html.unescape(match[2])
    shown = convert(tex, display="block" if tag == "div" else "inline")
    if "\\" in shown or "&</" in shown:
        _log.warning("%s: formula not understood: %s", page, tex)
    shown = _SIGN.sub('<mo form="prefix">', shown)  # x = -y, not x = - y
    shown = _FUNCTION.sub(r'<mo lspace="0.17em" rspace="0.17em">\1</mo>', shown)  # r sin x, not rsinx
    return f'<{tag} class="formula">{shown}</{tag}>'


def _outside(page, link):
    """Path from the repository's root of a link that leaves docs; None for any other link."""
    path = posixpath.normpath(posixpath.join("docs", posixpath.dirname(page), link))
    return None if path.startswith("docs/") or not (ROOT / path).is_file() else path


def _source_page(path):
    if path in _ROOT_PAGES:
        return _ROOT_PAGES[path]
    return f"source/{path}" if path.endswith(".md") else f"source/{path}.md"


def _shown(path):
    text = (ROOT / path).read_text("utf-8")
    if path.endswith(".md"):
        return text
    language = _LANGUAGES.get(Path(path).suffix, "text")
    head = f"---\ntitle: {html.escape(path)}\nsearch:\n  exclude: true\n---\n\n# `{path}`\n\n"
    if path.endswith(".ipynb"):
        return head + _notebook(json.loads(text))
    return f"{head}````{language}\n{text}````\n"


def _notebook(found):
    """Cells of a notebook: its text, a heading lower than that of the page, and its code."""
    cells = []
    for cell in found["cells"]:
        text = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            cells.append(re.sub(r"^#", "##", text, flags=re.MULTILINE))
        else:
            cells.append(f"```python\n{text}\n```")
    return "\n\n".join(cells) + "\n"
