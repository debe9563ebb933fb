"""The page of `restframe study` as a browser shows it."""

import csv
import json
import shutil
import subprocess

import conftest
import numpy
import pytest
from PIL import Image

STUDY = ["--frame", 1, "--scale", 0.5, "--samples", 1, "--repeats", 1]
FILES = ["study.html", "study.csv", "study.json"]

# Shows the report in a frame of a given width, and writes down what it measures there. The report
# itself has no script.
RULER = """<!DOCTYPE html>
<html><head><meta charset="utf-8"></head><body>
<iframe src="study.html" style="width:{width}px;height:900px;border:0"></iframe>
<pre id="measured"></pre>
<script>
addEventListener("load", () => {{
  const page = document.querySelector("iframe").contentDocument;
  const root = page.documentElement;
  const box = (node) => {{
    const {{ left, right, top, bottom, width, height }} = node.getBoundingClientRect();
    return {{ left, right, top, bottom, width, height }};
  }};
  const all = (selector) => [...page.querySelectorAll(selector)];
  document.getElementById("measured").textContent = JSON.stringify({{
    text: page.body.innerText,
    scroll: root.scrollWidth,
    client: root.clientWidth,
    height: root.scrollHeight,
    sections: all("section").map(box),
    charts: all("svg").map(box),
    texts: all("svg text").filter((text) => text.textContent).map(box),
    labels: all("svg").map((svg) => [...svg.querySelectorAll(".remark")].map(box)),
    sizes: all("svg").map((svg) => {{
      const drawn = svg.getBBox();
      const page = svg.viewBox.baseVal;
      return {{ drawn: [drawn.width, drawn.height], page: [page.width, page.height] }};
    }}),
  }});
}});
</script></body></html>
"""


def browser():
    found = shutil.which("chromium") or shutil.which("chromium-browser")
    assert found, "no chromium; scripts/test installs it"
    return found


@pytest.fixture(scope="module")
def chromium(tmp_path_factory):
    """Opens a page; returns what it printed and what went wrong in it."""
    profile = tmp_path_factory.mktemp("profile")

    def run(page, *arguments):
        command = [browser(), "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"]
        command += ["--allow-file-access-from-files", "--enable-logging=stderr"]
        command += [f"--user-data-dir={profile}", *arguments, page.as_uri()]
        done = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", timeout=120)
        assert done.returncode == 0, done.stderr
        return done.stdout, [line for line in done.stderr.splitlines() if "CONSOLE" in line]

    return run


@pytest.fixture(scope="module")
def report(restframe, tmp_path_factory):
    """The folder with the three files."""
    folder = tmp_path_factory.mktemp("study")
    for name in ["sphere.obj", "sphere.mtl"]:
        shutil.copy(conftest.ROOT / "assets" / name, folder)
    (folder / "sphere.toml").write_text(conftest.SHOT, encoding="utf-8")
    done = restframe("study", "sphere.toml", "--out", "out", *STUDY, cwd=folder)
    assert done.returncode == 0, done.stderr
    assert all((folder / "out" / "sphere" / name).is_file() for name in FILES)
    return folder / "out" / "sphere"


@pytest.fixture(scope="module")
def study(report):
    return json.loads((report / "study.json").read_text(encoding="utf-8"))


def points(study):
    return [(sweep, point) for sweep in study["sweeps"] for point in sweep["points"]]


def measured(report, chromium, width):
    ruler = report / f"ruler-{width}.html"
    ruler.write_text(RULER.format(width=width), encoding="utf-8")
    dom, errors = chromium(ruler, "--dump-dom", "--window-size=1400,1000", "--virtual-time-budget=10000")
    assert not errors
    text = dom.split('<pre id="measured">')[1].split("</pre>")[0]
    for escape, sign in [("&lt;", "<"), ("&gt;", ">"), ("&nbsp;", "\u00a0"), ("&amp;", "&")]:
        text = text.replace(escape, sign)
    return json.loads(text)


def test_the_page_says_what_was_studied(report, chromium, study):
    text = measured(report, chromium, 1280)["text"]
    assert "Kügelchen: a sphere passes" in text
    for sweep, point in points(study):
        assert sweep["knob"] in text
        assert point["setting"] in text
    for effect in study["effects"]:
        assert effect["effect"] in text


@pytest.mark.parametrize("width", [1280, 800])
def test_nothing_is_wider_than_the_window(report, chromium, study, width):
    page = measured(report, chromium, width)
    assert page["client"] == width
    assert page["scroll"] <= width
    for box in page["sections"] + page["charts"]:
        assert 0 <= box["left"] < box["right"] <= width
        assert box["height"] > 20
    charted = [sweep for sweep in study["sweeps"] if sweep["points"]]
    assert len(page["charts"]) >= len(charted) > 0
    assert page["texts"] and all(box["width"] > 0 for box in page["texts"])
    for size in page["sizes"]:
        drawn, sheet = numpy.array(size["drawn"]), numpy.array(size["page"])
        # The sheet of a chart is a rectangle in it: what is drawn beyond would make it larger.
        assert (numpy.abs(drawn - sheet) < 1).all(), size


def overlap(a, b):
    # Letters fill the middle of the box of their line; a pixel more or less cannot be seen.
    tall = 0.25 * a["height"]
    across = min(a["right"], b["right"]) - max(a["left"], b["left"])
    down = min(a["bottom"], b["bottom"]) - max(a["top"], b["top"]) - 2 * tall
    return across > 1 and down > 1


def test_labels_of_settings_do_not_cover_each_other(report, chromium, study):
    charts = measured(report, chromium, 1280)["labels"]
    assert sum(map(len, charts)) > 0
    for labels in charts:
        for i, label in enumerate(labels):
            assert not any(overlap(label, other) for other in labels[i + 1 :])


def test_the_page_is_drawn_without_a_word_of_complaint(report, chromium, tmp_path):
    picture = tmp_path / "page.png"
    _, errors = chromium(report / "study.html", f"--screenshot={picture}", "--window-size=1280,2400")
    assert not errors
    pixels = numpy.asarray(Image.open(picture).convert("RGB")).astype(int)
    assert pixels.shape[:2] == (2400, 1280)
    # A page of text and charts is mostly paper, and has ink in most of its bands.
    paper = pixels[0, 0]
    ink = numpy.abs(pixels - paper).sum(axis=2) > 60
    assert 0.005 < ink.mean() < 0.5
    bands = ink[:2000].reshape(20, 100, 1280).any(axis=(1, 2))
    assert bands.sum() >= 12


def test_the_table_is_the_jsons(report, study):
    with open(report / "study.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(points(study)) > 0
    for row, (sweep, point) in zip(rows, points(study)):
        assert (row["knob"], row["setting"]) == (sweep["knob"], point["setting"])
        assert float(row["frame_median_s"]) == point["frame"]["median"]
        assert row["pareto"] == str(point["pareto"]).lower()
        radiance = point["errors"] and point["errors"]["radiance"]
        assert row["error_radiance"] == "" if radiance is None else float(row["error_radiance"]) == radiance
