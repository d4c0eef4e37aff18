"""The page in headless Chromium: drawn, quiet, offline, light and dark, narrow, printed, played."""

import itertools
import re
import shutil

import numpy as np
import pytest

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
BROWSER = next(filter(None, map(shutil.which, NAMES)), None)
pytestmark = [
    pytest.mark.heavy,  # WebGL by software takes a processor for half a minute
    pytest.mark.skipif(
        BROWSER is None,
        reason=f"no browser: none of {', '.join(NAMES)} is installed (Debian: apt-get install chromium)",
    ),
]
#: As root there is no sandbox; without a graphics card WebGL is drawn by software.
ARGUMENTS = ("--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
WEBGL_ADVICE = "GPU stall|GroupMarkerNotSet|willReadFrequently"  # of the software renderer, not of the page


@pytest.fixture(scope="module")
def shown(full_report):
    """The page, drawn, with all that the browser complained of and asked for."""
    sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    with sync_api.sync_playwright() as player:
        browser = player.chromium.launch(executable_path=BROWSER, headless=True, args=list(ARGUMENTS))
        context = browser.new_context(
            viewport={"width": 1280, "height": 900}, color_scheme="light", offline=True
        )
        page = context.new_page()
        page.complaints, page.asked = [], []
        page.on("console", lambda line: page.complaints.append(f"{line.type}: {line.text}"))
        page.on("pageerror", lambda error: page.complaints.append(f"error: {error}"))
        page.on("request", lambda request: page.asked.append(request.url))
        page.goto(full_report.path.as_uri())
        page.wait_for_function("document.documentElement.dataset.ready === 'true'", timeout=120_000)
        yield page
        browser.close()


def style(page, selector, name):
    return page.eval_on_selector(selector, f"node => getComputedStyle(node).{name}")


def lightness(colour):
    return np.mean([float(part) for part in re.findall(r"[\d.]+", colour)[:3]])


def test_every_figure_is_drawn_and_nothing_complains(shown):
    drawn = shown.eval_on_selector_all(
        ".plot", "nodes => nodes.map(n => [n.dataset.chart, n.querySelectorAll('.main-svg').length])"
    )
    assert len(drawn) >= 12 and all(count > 0 for _, count in drawn)
    curves = shown.eval_on_selector_all("#plot-spectrum .scatterlayer path.js-line", "nodes => nodes.length")
    assert curves >= 5
    unexpected = [line for line in shown.complaints if not re.search(WEBGL_ADVICE, line)]
    assert unexpected == []
    assert all(url.startswith(("file:", "data:", "blob:")) for url in shown.asked)


def test_the_balloon_is_solid(shown):
    """A WebGL canvas, and the picture of it that print takes: not blank, many colours."""
    assert shown.locator("#plot-balloon canvas").count() >= 1
    colours = shown.evaluate("""async () => {
        const image = document.querySelector('#plot-balloon > img');
        await image.decode();
        const canvas = document.createElement('canvas');
        canvas.width = canvas.height = 60;
        const pen = canvas.getContext('2d', { willReadFrequently: true });
        pen.drawImage(image, 0, 0, 60, 60);
        const data = pen.getImageData(0, 0, 60, 60).data;
        const seen = new Set();
        for (let k = 0; k < data.length; k += 4) seen.add([0, 1, 2].map((c) => data[k + c] >> 3).join());
        return seen.size;
    }""")
    assert colours > 30


def test_sounds_can_be_played(shown, full):
    found = shown.evaluate("""() => Promise.all([...document.querySelectorAll('audio')].map(async (sound) => {
        while (sound.readyState < 1 && !sound.error) await new Promise((go) => setTimeout(go, 20));
        return [sound.duration, sound.error && sound.error.message];
    }))""")
    assert len(found) == len(full.microphones)
    for duration, error in found:
        assert error is None and duration == pytest.approx(full.size / full.rate, abs=2e-3)


def test_choices_and_colours_by_keyboard(shown):
    line = "#plot-ranking .trace.bars .point path"
    names = shown.eval_on_selector(
        "#plot-spectrum", "plot => plot.data.filter(t => t.visible === true && t.meta).map(t => t.meta.mic)"
    )
    assert len(set(names)) == 1
    shown.focus("select[data-chart=spectrum][data-key=mic]")
    shown.keyboard.press("ArrowDown")
    shown.wait_for_function(
        "was => document.getElementById('plot-spectrum').data.some("
        "t => t.visible === true && t.meta && t.meta.mic !== was)", arg=names[0],
    )  # fmt: skip
    before = style(shown, line, "fill"), style(shown, "body", "backgroundColor")
    shown.focus("#theme")
    shown.keyboard.press("Enter")
    shown.wait_for_function("document.documentElement.dataset.theme === 'dark'")
    after = style(shown, line, "fill"), style(shown, "body", "backgroundColor")
    assert lightness(before[0]) < 60 < 200 < lightness(after[0])  # the total: black, then white
    assert lightness(before[1]) > 200 > 60 > lightness(after[1])
    chosen = shown.eval_on_selector(
        "#plot-spectrum", "plot => plot.data.filter(t => t.visible === true && t.meta)[0].meta.mic"
    )
    assert chosen != names[0]  # what was chosen stays
    shown.keyboard.press("Enter")
    shown.wait_for_function("document.documentElement.dataset.theme === 'light'")


def test_a_narrow_page_does_not_scroll_sideways(shown):
    shown.set_viewport_size({"width": 400, "height": 800})
    shown.wait_for_function(
        "document.querySelector('#plot-spectrum .main-svg').getBoundingClientRect().width < 400"
    )
    assert shown.evaluate("document.documentElement.scrollWidth") <= 400
    widest = shown.eval_on_selector_all(
        ".plot .main-svg", "nodes => Math.max(...nodes.map(n => n.getBoundingClientRect().right))"
    )
    assert widest <= 400
    shown.set_viewport_size({"width": 1280, "height": 900})


def test_verdicts_are_read_at_390_pixels_without_scrolling(shown):
    """Each row a block of its own width: name, then value, verdict, limit and source under each other."""
    shown.set_viewport_size({"width": 390, "height": 844})
    try:
        table, around = shown.eval_on_selector(
            "#summary table.stacked", "t => [t.scrollWidth, t.closest('.scroll').clientWidth]"
        )
        assert table <= around <= 390
        cells = shown.eval_on_selector_all(
            "#summary table.stacked tbody tr:first-child > *",
            "nodes => nodes.map(n => { const b = n.getBoundingClientRect(); "
            "return [b.left, b.right, b.top, b.bottom, n.dataset.column ?? '']; })",
        )
        assert [cell[4] for cell in cells] == ["", "value", "verdict", "limit", "source of the limit"]
        assert all(right <= 390 for _, right, *_ in cells)
        assert all(upper[3] <= lower[2] + 0.5 for upper, lower in zip(cells, cells[1:], strict=False))
        # every table is as wide as its frame but long ones, which scroll
        tables = shown.eval_on_selector_all(
            "table", "nodes => nodes.map(t => { const d = t.closest('details'); const was = d?.open; "
            "if (d) d.open = true; "
            "const found = [t.caption.innerText, t.scrollWidth - t.closest('.scroll').clientWidth]; "
            "if (d) d.open = was; return found; })",
        )  # fmt: skip
        cut = [caption for caption, beyond in tables if beyond > 0]
        assert len(tables) > 10 and [caption for caption in cut if not caption.startswith("Crossings")] == []
        # captions of tables that scroll sideways are as wide as the page
        captions = shown.eval_on_selector_all(
            ".block caption span", "nodes => nodes.map(n => n.getBoundingClientRect().right)"
        )
        assert len(captions) > 5 and max(captions) <= 390
        top = shown.eval_on_selector("#overall", "n => n.getBoundingClientRect().bottom + scrollY")
        assert top < 844  # on the first screen
    finally:
        shown.set_viewport_size({"width": 1280, "height": 900})


def test_the_toolbar_covers_no_legend_and_no_name_another(shown):
    """Boxes on the screen: toolbar beside legend and axes; names of lines apart from each other."""
    found = shown.eval_on_selector_all(
        ".plot",
        """nodes => nodes.map(plot => {
            const box = (node) => (({ left, right, top, bottom }) => [left, right, top, bottom])(
                node.getBoundingClientRect());
            const all = (selector) => [...plot.querySelectorAll(selector)].map(box);
            const beside = '.ytitle, .y2title, .xtitle, .cbaxis text, .cbtitle text';
            return [plot.dataset.chart, all('.modebar')[0], all('.legend .bg'), all('.annotation-text-g'),
                all(beside)];
        })""",
    )

    def meet(one, other):
        return (
            min(one[1], other[1]) - max(one[0], other[0]) > 0.5
            and min(one[3], other[3]) - max(one[2], other[2]) > 0.5
        )

    legends = {key: boxes for key, _, boxes, *_ in found if boxes}
    assert len(legends) >= 6
    for key, bar, boxes, _, titles in found:
        assert bar[1] > bar[0] and not any(meet(bar, box) for box in [*boxes, *titles]), key
    (names,) = [names for key, _, _, names, _ in found if key == "spectrum"]
    assert len(names) >= 3
    assert not any(meet(a, b) for a, b in itertools.combinations(names, 2))


def test_it_prints(shown):
    """Figures redrawn to the paper's width, folded tables open, and the screen as it was afterwards."""
    shown.evaluate("dispatchEvent(new Event('beforeprint'))")
    widths = shown.eval_on_selector_all(
        ".plot .main-svg:first-child", "nodes => nodes.map(n => n.clientWidth)"
    )
    assert max(widths) <= 690
    assert shown.locator("details.table:not([open])").count() == 0
    shown.evaluate("dispatchEvent(new Event('afterprint'))")
    assert shown.locator("details.table[open]").count() == 0
    paper = shown.pdf(prefer_css_page_size=True, print_background=True)
    assert paper.startswith(b"%PDF") and 5 <= len(re.findall(rb"/Type\s*/Page\b", paper)) <= 30
