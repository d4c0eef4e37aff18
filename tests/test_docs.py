"""The documentation builds without a warning, its code runs, its links hold, it names everything there is."""

import ast
import contextlib
import importlib.util
import pathlib
import re
import shutil
import subprocess
import tomllib
from html import unescape

import pytest
import typer

import fmu_bearing
from fmu_bearing.cli import app, base
from fmu_bearing.interface import variables
from fmu_bearing.scene import Scene, read_scene
from fmu_bearing.scene.nsk import sizes
from fmu_bearing.scene.units import symbol
from tests.conftest import EXAMPLES
from tests.marks import heavy_but
from tests.pages import DOCS, ROOT, blocks, commands, parse, run_page

pytestmark = pytest.mark.pages

PAGES = sorted(
    path for path in (ROOT / "README.md", *DOCS.rglob("*.md")) if "site" not in path.relative_to(ROOT).parts
)
_FENCED = re.compile(r"^(`{3,}).*?^\1", flags=re.MULTILINE | re.DOTALL)
_LINK = re.compile(r"\]\(([^)\s]+)\)")


def names(paths):
    return [path.relative_to(ROOT).as_posix() for path in paths]


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """Folder of the built site; ``strict`` turns any warning of MkDocs into an end."""
    commands = pytest.importorskip("mkdocs.commands.build", reason="MkDocs is not installed: extra docs")
    from mkdocs.config import load_config

    folder = tmp_path_factory.mktemp("site")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("NO_MKDOCS_2_WARNING", "1")
        patch.setenv("READTHEDOCS_CANONICAL_URL", "https://example.org/en/latest/")  # as a host sets it
        commands.build(load_config(str(DOCS / "site" / "mkdocs.yml"), site_dir=str(folder), strict=True))
    return folder


@pytest.fixture(scope="module")
def reference():
    pytest.importorskip("typer.cli")
    spec = importlib.util.spec_from_file_location("docs_reference", DOCS / "site" / "reference.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def text(site, page):
    return unescape((site / page).read_text(encoding="utf-8"))


def test_every_page_becomes_part_of_the_site(site):
    for path in PAGES[1:]:
        assert (site / path.relative_to(DOCS).with_suffix(".html")).exists() or path.name == "README.md", path


def test_a_notebook_is_shown_as_text_and_code(site):
    page = text(site, "source/examples/notebooks/first_result.ipynb.html")
    assert "<h3" in page and "Does less preload help" in page
    assert '"cell_type"' not in page and 'class="highlight"' in page


def test_nothing_is_fetched_from_elsewhere(site):
    for path in site.rglob("*.html"):
        page = path.read_text(encoding="utf-8")
        assert not re.search(r'<(?:script|img|iframe|source)[^>]* src="?(?:https?:)?//', page), path
        assert not re.search(r'<link[^>]*rel="?(?:stylesheet|preconnect)[^>]*href="?(?:https?:)?//', page), (
            path
        )
    for path in site.rglob("*.css"):
        assert not re.search(r"url\(['\"]?https?:", path.read_text(encoding="utf-8")), path


def test_search_knows_the_generated_pages(site):
    index = (site / "search" / "search_index.js").read_text(encoding="utf-8")
    for word in ("contact_damping_us", "heat.oil", "fmu-bearing sensitivity", "read_scene"):
        assert word in unescape(index), word


@contextlib.contextmanager
def opened(site):
    """Page of the site, opened from the disk with its search ready; its complaints and what it asked for."""
    program = shutil.which("chromium")
    if program is None:
        pytest.skip("no chromium on the path")
    playwright = pytest.importorskip("playwright.sync_api")
    with playwright.sync_playwright() as tools:
        browser = tools.chromium.launch(executable_path=program, args=["--no-sandbox"])
        page, said, asked = browser.new_page(), [], []
        page.on("console", lambda message: said.append(message.text) if message.type == "error" else None)
        page.on("pageerror", lambda error: said.append(str(error)))
        page.on("request", lambda request: asked.append(request.url))
        page.goto((site / "index.html").as_uri())
        page.locator("input[name=query]").focus()  # the index is loaded then
        page.wait_for_selector(".md-search-result__meta:not(:has-text('Initializing'))", state="attached")
        yield page, said, asked
        browser.close()


def test_search_works_on_pages_opened_from_the_disk(site):
    with opened(site) as (page, said, asked):
        page.locator("input[name=query]").press_sequentially("preload")
        page.wait_for_selector(".md-search-result__item", state="attached")
        found = page.text_content(".md-search-result__list")
    assert "preload" in found.lower()
    assert not said
    assert all(url.startswith(("file:", "data:")) for url in asked)


def test_figures_and_sizes_are_read_at_390_pixels(site):
    with opened(site) as (page, _, _):
        page.set_viewport_size({"width": 390, "height": 844})
        shown = page.eval_on_selector("figure img", "n => [n.clientWidth, n.parentNode.clientWidth]")
        assert shown[0] >= 600 and shown[1] <= 390
        page.goto((site / "sizes.html").as_uri())
        rows = page.eval_on_selector_all(
            "tbody tr:has(td:nth-child(10))", "nodes => nodes.map(n => n.clientHeight)"
        )
        assert len(rows) == len(sizes()) and max(rows) < 40  # one line each
        assert page.evaluate("document.documentElement.scrollWidth") <= 390


#: Asks the site's own search, a worker that answers one message by another (0 set up, 1 ready, 2 query, 3
#: result), and returns the pages that it finds for each query, the best first.
_ASK = """async queries => {
    const config = JSON.parse(document.getElementById("__config").textContent)
    const index = await __index
    const worker = new Worker(new URL(config.search, location.href).href)
    const ask = (type, data, answer) => new Promise(done => {
        const take = event => {
            if (event.data.type !== answer) return
            worker.removeEventListener("message", take)
            done(event.data.data)
        }
        worker.addEventListener("message", take)
        worker.postMessage({type, data})
    })
    await ask(0, {config: index.config, docs: index.docs, options: {suggest: false}}, 1)
    const found = {}
    for (const query of queries) {
        const {items} = await ask(2, query, 3)
        found[query] = items.map(([first]) => first.location.split("#")[0])
    }
    return found
}"""


def test_search_finds_every_command_and_every_variable(site, reference):
    """Commands and variables as users write them, `ball[1].velocity.x` for the row `ball[i].velocity.x`."""
    named = {reference.shown(one.name): one.name for one in reference.all_variables()}
    pages = dict.fromkeys(leaves(typer.main.get_command(app), "fmu-bearing"), "cli.html")
    pages |= dict.fromkeys(named.values(), "fmu-reference.html")
    assert len(pages) > 150
    with opened(site) as (page, said, _):
        found = page.evaluate(_ASK, list(pages))
    assert not said
    assert not [name for name, page in pages.items() if page not in found[name]]
    # Words of every day, such as preload, are in titles of other pages, which go first; of 196 they were 12.
    first = [name for name, page in pages.items() if page in found[name][:3]]
    assert len(first) > 0.9 * len(pages)


def test_every_page_states_the_version_and_the_date_of_the_commit(site):
    """By the commit and not by the clock, so that a commit always makes the same site."""
    asked = subprocess.run(
        ["git", "log", "-1", "--format=%cs"], cwd=ROOT, capture_output=True, text=True, timeout=60
    )
    if asked.returncode != 0:
        pytest.skip("not in a clone of the repository")
    date = asked.stdout.strip()
    assert re.fullmatch(r"\d{4}-\d\d-\d\d", date)
    for page in ("index.html", "results/tradeoff.html", "api.html"):
        assert f"fmu-bearing {fmu_bearing.__version__}, {date}" in text(site, page), page
    dates = set(re.findall(r"<lastmod>(.*?)</lastmod>", text(site, "sitemap.xml")))
    assert dates == {date}


@pytest.mark.parametrize("page", PAGES[1:], ids=names(PAGES[1:]))
def test_links_and_pictures_are_there(page):
    """Links of the files themselves; those of the site, anchors included, MkDocs has checked."""
    for link in _LINK.findall(_FENCED.sub("", page.read_text(encoding="utf-8"))):
        if not re.match(r"[a-z]+:|#", link):
            target = page.parent / link.split("#")[0]
            # written when the site is built
            assert target.exists() or target == DOCS / "changes.md", link


def leaves(command, path):
    children = getattr(command, "commands", {})
    for name, child in children.items():
        yield from leaves(child, f"{path} {name}")
    if not children:
        yield path


def test_messages_name_a_page_by_its_title():
    """Who installed a wheel has no folder docs: no string has a path there, each page named is there."""
    package, named = pathlib.Path(fmu_bearing.__file__).parent, set()
    for file in package.rglob("*.py"):
        tree = ast.parse(file.read_text("utf-8"))
        own = {
            id(node.body[0].value)
            for node in ast.walk(tree)
            if hasattr(node, "body")
            and isinstance(node.body, list)
            and node.body
            and isinstance(node.body[0], ast.Expr)
        }
        for node in ast.walk(tree):
            if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in own:
                assert not re.search(r"docs/[\w-]+\.md", node.value), file
                named |= set(re.findall(r'page "([^"]+)" of the\sdocumentation', node.value))
    titles = {path.read_text("utf-8").split("\n", 1)[0].removeprefix("# ") for path in DOCS.glob("*.md")}
    assert len(named) >= 4 and named <= titles


def test_every_command_is_described(site):
    page = text(site, "cli.html")
    for command in leaves(typer.main.get_command(app), "fmu-bearing"):
        assert f"<code>{command}</code>" in page, command


def test_every_size_of_a_maker_is_listed_with_its_marks(site):
    page = text(site, "sizes.html")
    for name, size in sizes().items():
        row = re.search(rf"<tr>\s*<td><code>{name}</code></td>(.*?)</tr>", page, re.S)
        assert row is not None, name
        assert f"<em>{size.balls} x {size.ball:g}</em>" in row[1]
        assert f"<td>{size.dynamic:g}, {size.static:g}</td>" in row[1]
    assert "NSK-7003C" not in text(site, "scene.html")


def test_every_exit_code_is_described(site):
    page = text(site, "cli.html")
    for code in (0, base.FOUND, base.REFUSED, base.ENDED_EARLY, base.INTERRUPTED):
        assert f"<td>{code}</td>" in page


def test_every_public_name_is_described(site):
    page = text(site, "api.html")
    for name in fmu_bearing.__all__:
        assert re.search(rf'<h2 id="fmu_bearing\.[\w.]+\.{name}"', page), name


def keys(table, path=""):
    """Dotted keys of a table of a scene file; elements of lists of tables under the list's name."""
    for key, value in table.items():
        dotted = f"{path}.{key}" if path else key
        inner = value[0] if isinstance(value, list) and value and isinstance(value[0], dict) else value
        if isinstance(inner, dict):
            yield from keys(inner, dotted)
        else:
            yield dotted


def schema_keys():
    """Table name (class) and key of everything a scene file may hold, from the schema that pydantic makes."""
    schema = Scene.model_json_schema()
    for name, part in {"Scene": schema, **schema["$defs"]}.items():
        for key, value in part.get("properties", {}).items():
            if "$ref" not in str(value):
                yield name, key


@pytest.fixture(scope="module")
def scene_rows(reference):
    """Cells of the rows of the scene reference by dotted key."""
    rows, table = {}, ""
    for line in reference.scene().splitlines():
        if line.startswith("## "):
            table = line[3:].strip("`[]")
        if line.startswith("| `"):
            key, *cells = [cell.strip() for cell in line.strip("|").split(" | ")]
            prefix = "" if table == "Top level" else f"{table}."
            rows[prefix + key.strip(" `")] = cells
    return rows


def test_every_key_of_a_scene_is_described_with_its_unit(scene_rows):
    described = {key.rsplit(".", 1)[-1] for key in scene_rows}
    for table, key in schema_keys():
        assert key in described, f"{table}.{key}"
    for path in EXAMPLES.glob("*.toml"):
        for dotted in keys(tomllib.loads(path.read_text(encoding="utf-8"))):
            assert dotted in scene_rows, dotted
    for dotted, cells in scene_rows.items():
        if dotted.startswith("Catalogue."):
            continue
        unit, _, default, sentence = cells
        # keys without a unit at their end are numbers, words or switches
        assert unit == symbol(dotted) if symbol(dotted) else unit in ("-", "text", "true/false"), dotted
        assert default and sentence.endswith("."), dotted


def test_ranges_of_the_reference_are_those_that_are_refused(scene_rows):
    # two keys by hand: a plain range, and a list's
    assert scene_rows["bearing.contact_angle_deg"][:2] == ["deg", "5 to 45"]
    assert scene_rows["mounting.flexure.outer_ring"][1] == "list, each 2 to 8"


@pytest.mark.parametrize("name", [path.stem for path in sorted(EXAMPLES.glob("*.toml"))])
def test_every_variable_is_described(name, reference, site):
    page = text(site, "fmu-reference.html")
    for variable in variables(read_scene(EXAMPLES / f"{name}.toml"), 1e-5):
        shown = variable.name
        for pattern, index in (
            (r"ball\[\d+\]", "ball[i]"),
            (r"mic\[\d+\]", "mic[k]"),
            (r"third_octave\[\d+\]", "third_octave[f]"),
            (r"flexure\.n\d+", "flexure.n*"),
            (r"defect\[\d+\]", "defect[k]"),
        ):
            shown = re.sub(pattern, index, shown)
        row = re.search(rf"<td><code>{re.escape(shown)}</code></td>(.*?)</tr>", page, flags=re.DOTALL)
        assert row is not None, variable.name
        kind, unit, _, sentence = re.findall(r"<td>(.*?)</td>", row[1], flags=re.DOTALL)
        constant = variable.variability == "constant"
        assert kind == ("constant" if constant else variable.causality), variable.name
        assert unit == (variable.unit or ("-" if variable.type == "Real" else variable.type)), variable.name
        assert sentence, variable.name


# The README runs some of these commands.
RUN = [
    "quick-start.md", "catalogue.md", "sizes.md", "choosing.md", "coupling.md", "stiffness.md", "modes.md",
    "spindle.md", "motor-spindle.md",
]  # fmt: skip


@pytest.mark.parametrize("page", heavy_but(RUN, "coupling.md"))
def test_code_of_a_page_runs(page, tmp_path, monkeypatch):
    run_page(DOCS / page, tmp_path, monkeypatch)


def test_commands_of_all_pages_are_understood():
    seen = 0
    for page in PAGES:
        for language, _, script in blocks(page):
            if language in ("sh", "bash"):
                for words in commands(script):
                    words = words[1:] if words[0].endswith("/python") else words
                    if words and words[0].endswith("fmu-bearing"):
                        parse(words)
                        seen += 1
    assert seen >= 10


def test_bash_blocks_hold_only_what_cannot_be_run():
    for page in PAGES:
        for language, _, script in blocks(page):
            if language == "bash":
                first = {words[0] for words in commands(script)}
                assert first <= {"python3", ".", "pip", "python", "make", "git"}, page


def test_pages_are_narrow():
    """Prose keeps within 110 columns; rows of tables cannot be broken, generated pages are a run's."""
    pages = [*PAGES, ROOT / "CHANGELOG.md", ROOT / "CONTRIBUTING.md", ROOT / "benchmarks" / "README.md"]
    wide = {
        f"{page.relative_to(ROOT).as_posix()}:{number}"
        for page in pages
        if page.parent.name not in ("results", "papers")
        for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1)
        if len(line) > 110 and not line.startswith(("|", "["))
    }
    assert not wide


def test_the_page_on_analysis_uses_public_names():
    found = re.findall(
        r"^from (fmu_bearing\S*) import (.+)$", (DOCS / "analysis.md").read_text("utf-8"), re.M
    )
    assert found and {module for module, _ in found} == {"fmu_bearing"}
    assert {name.strip() for _, names in found for name in names.split(",")} <= set(fmu_bearing.__all__)


def test_formulas_are_set_as_mathematics(site):
    """MathML, made when the site is built: nothing is left to a script, which offline would not run."""
    theory = (site / "theory.html").read_text(encoding="utf-8")
    assert theory.count("<math") > 50
    assert "arithmatex" not in theory
