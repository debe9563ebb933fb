"""The page that `restframe render` writes beside the frames, as a browser shows and plays it."""

import json
import os
import re
import shutil
import subprocess
import time

import conftest
import pytest
from test_study import browser

FRAMES = 12
FPS = 10
SHOT = (
    conftest.SHOT.replace("[shot]", f"[shot]\nframes = {FRAMES}")
    .replace("time = 5.0", "time = { from = 4, to = 6 }")
    .replace("fps = 23.976", f"fps = {FPS}")
    .replace('formats = ["png", "exr"]', 'formats = ["png"]')
    .replace('layers = ["doppler", "distance", "emission_time", "worldline"]', "")
)


class Tab:
    """A tab of a headless browser, spoken to over a pair of pipes: real clicks and real keys."""

    def __init__(self, profile):
        to_browser, self.ask = os.pipe()
        self.answers, from_browser = os.pipe()

        def third_and_fourth():
            # Copied upwards first, for one may stand where the other has to go.
            reading, writing = os.dup(to_browser), os.dup(from_browser)
            os.dup2(reading, 3)
            os.dup2(writing, 4)

        self.process = subprocess.Popen(
            [browser(), "--headless", "--no-sandbox", "--disable-gpu", "--remote-debugging-pipe",
             "--no-first-run", f"--user-data-dir={profile}", "about:blank"],
            preexec_fn=third_and_fourth, close_fds=False,
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )
        os.close(to_browser)
        os.close(from_browser)
        self.rest, self.serial, self.session, self.events = b"", 0, None, []
        target = self("Target.createTarget", url="about:blank")["targetId"]
        self.session = self("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ["Page", "Runtime", "Log", "Network"]:
            self(f"{domain}.enable")

    def __call__(self, method, **parameters):
        self.serial += 1
        message = {"id": self.serial, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.ask, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.next()
            if answer.get("id") == self.serial:
                assert "error" not in answer, answer
                return answer["result"]
            self.events.append(answer)

    def next(self):
        while b"\0" not in self.rest:
            more = os.read(self.answers, 1 << 16)
            assert more, "the browser has gone"
            self.rest += more
        message, self.rest = self.rest.split(b"\0", 1)
        return json.loads(message)

    def js(self, expression):
        result = self("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in result, result
        return result["result"].get("value")

    def until(self, expression, seconds=10):
        end = time.monotonic() + seconds
        while not self.js(expression):
            assert time.monotonic() < end, expression
            time.sleep(0.02)

    def open(self, page, width=1280, height=900, scripts=True):
        self.events.clear()
        self("Emulation.setScriptExecutionDisabled", value=not scripts)
        self("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        # By way of another page, so that a fragment alone makes a new one too.
        self("Page.navigate", url="about:blank")
        self("Page.navigate", url=page)
        self.until("location.protocol === 'file:' && document.readyState === 'complete'")

    def click(self, selector):
        x, y = self.js(
            f"(() => {{ const e = document.querySelector({json.dumps(selector)});"
            "e.scrollIntoView({block: 'center'}); const b = e.getBoundingClientRect();"
            "return [b.left + b.width / 2, b.top + b.height / 2]; })()"
        )
        for kind in ["mousePressed", "mouseReleased"]:
            self("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def key(self, key, code=0, text=""):
        press = {"key": key, "windowsVirtualKeyCode": code, "text": text}
        self("Input.dispatchKeyEvent", type="keyDown" if text else "rawKeyDown", **press)
        self("Input.dispatchKeyEvent", type="keyUp", key=key, windowsVirtualKeyCode=code)

    def complaints(self):
        """What the console was told so far, and requests beyond the page's folder."""
        self.js("0")
        kinds = ("Runtime.exceptionThrown", "Runtime.consoleAPICalled", "Log.entryAdded")
        told = [e for e in self.events if e.get("method") in kinds]
        asked = [e["params"]["request"]["url"] for e in self.events if e.get("method") == "Network.requestWillBeSent"]
        return told + [url for url in asked if not url.startswith(("file:", "data:", "about:"))]

    def close(self):
        self.session = None
        try:
            self("Browser.close")
            self.process.wait(timeout=20)
        except (AssertionError, OSError, subprocess.TimeoutExpired):
            self.process.kill()
        os.close(self.ask)
        os.close(self.answers)


@pytest.fixture(scope="module")
def folder(restframe, tmp_path_factory):
    """The folder of twelve rendered frames and their page."""
    folder = tmp_path_factory.mktemp("page")
    return conftest.render(restframe, folder, SHOT).parent


@pytest.fixture(scope="module")
def browser_tab(tmp_path_factory):
    tab = Tab(tmp_path_factory.mktemp("profile"))
    yield tab
    tab.close()


@pytest.fixture
def tab(browser_tab, folder):
    """The page, just opened; whoever uses it hears of complaints at the end."""
    browser_tab.open((folder / "index.html").as_uri())
    yield browser_tab
    assert browser_tab.complaints() == []


def number(tab):
    told = re.fullmatch(rf"frame (\d+) of {FRAMES}", tab.js("document.querySelector('#number').textContent"))
    return int(told[1])


def assert_visible(tab, selector):
    top, bottom = tab.js(
        f"(() => {{ const b = document.querySelector('{selector}').getBoundingClientRect(); return [b.top, b.bottom]; }})()"
    )
    assert 0 <= top < bottom <= 900


def test_the_page_opens_at_frame_1_and_says_what_is_known_of_it(tab):
    assert number(tab) == 1
    text = tab.js("document.querySelector('#facts').innerText")
    assert re.search(r"Time, s\s*4\b", text) and re.search(r"β\s*0\.5\b", text)
    assert "State" in text and "Seconds" in text
    assert f"{FRAMES} frames" in tab.js("document.querySelector('#counts').textContent")


def test_the_slider_scrubs_and_the_full_picture_comes_where_it_stops(tab):
    box = tab.js(
        "(() => { const e = document.querySelector('#scrub'); e.scrollIntoView({block: 'center'});"
        "const b = e.getBoundingClientRect(); return [b.left, b.width, b.top + b.height / 2]; })()"
    )
    x = [box[0] + 8, box[0] + box[1] / 2, box[0] + box[1] - 2]
    tab("Input.dispatchMouseEvent", type="mousePressed", x=x[0], y=box[2], button="left", clickCount=1)
    seen = []
    for at in x:
        tab("Input.dispatchMouseEvent", type="mouseMoved", x=at, y=box[2], button="left", buttons=1)
        seen.append(number(tab))
    tab("Input.dispatchMouseEvent", type="mouseReleased", x=x[-1], y=box[2], button="left", clickCount=1)
    assert seen[0] < seen[1] < seen[2] == FRAMES
    tab.until("document.querySelector('#picture').src.endsWith('/sphere.0012.png')")
    assert tab.js("document.querySelector('#picture').naturalWidth") == 96


def test_playing_keeps_the_shots_time_and_goes_round(tab):
    # Frames by the clock of the page, counted through the ends.
    tab.js("""globalThis.seen = []; new MutationObserver(() =>
      seen.push([performance.now(), Number(document.querySelector('#scrub').value)])
    ).observe(document.querySelector('#number'), { childList: true, characterData: true, subtree: true })""")
    tab.click("#play")
    assert tab.js("document.querySelector('#play').textContent") == "Pause"
    time.sleep(2.2)
    assert tab.js("document.querySelector('#picture').src").startswith("data:image/jpeg")
    tab.click("#play")
    assert tab.js("document.querySelector('#play').textContent") == "Play"
    seen = tab.js("seen")
    advanced = sum((b - a) % FRAMES for (_, a), (_, b) in zip(seen, seen[1:]))
    seconds = (seen[-1][0] - seen[0][0]) / 1000
    # Over 2 s a busy browser is late by some frames at either end, and loses none between.
    assert abs(advanced - FPS * seconds) < 0.15 * FPS * seconds + 2, (advanced, seconds)
    assert advanced > FRAMES
    still = number(tab)
    time.sleep(0.4)
    assert number(tab) == still
    tab.until("document.querySelector('#picture').src.startsWith('file:')")


def test_a_thumbnail_and_a_bar_lead_to_their_frames(tab):
    tab.click("#grid a[data-frame='7']")
    assert number(tab) == 7
    assert tab.js("document.querySelector('#grid [aria-current]').dataset.frame") == "7"
    tab.click("#bars a[data-frame='3'] .whole")
    assert number(tab) == 3
    # It has come into view.
    assert_visible(tab, "#scrub")


def test_keys_step_play_and_walk_the_thumbnails(tab):
    tab.key("ArrowRight", 39)
    tab.key("ArrowRight", 39)
    assert number(tab) == 3
    tab.key("ArrowLeft", 37)
    assert number(tab) == 2
    tab.js("document.querySelector('#scrub').focus()")
    tab.key("End", 35)
    assert number(tab) == FRAMES
    tab.key("Home", 36)
    assert number(tab) == 1
    tab.key(" ", 32, " ")
    assert tab.js("document.querySelector('#play').textContent") == "Pause"
    tab.key(" ", 32, " ")
    assert tab.js("document.querySelector('#play').textContent") == "Play"
    tab.js("document.querySelector('#play').focus()")
    tab.key(" ", 32, " ")
    assert tab.js("document.querySelector('#play').textContent") == "Pause"
    tab.key("ArrowLeft", 37)
    at = number(tab)
    assert tab.js("document.querySelector('#play').textContent") == "Play"
    # One stop for Tab among the thumbnails; arrows go on from there.
    assert tab.js("document.querySelectorAll('#grid a[tabindex=\"0\"]').length") == 1
    tab.js("document.querySelector('#grid a[tabindex=\"0\"]').focus()")
    tab.key("ArrowRight", 39)
    assert tab.js("document.activeElement.dataset.frame") == str(min(at + 1, FRAMES)) == str(number(tab))


def test_a_link_to_a_frame_opens_it(browser_tab, folder):
    browser_tab.open((folder / "index.html").as_uri() + "#frame-5")
    assert number(browser_tab) == 5
    browser_tab.until("scrollY > 0")
    assert_visible(browser_tab, "#scrub")
    browser_tab.js("location.hash = '#frame-8'")
    browser_tab.until("document.querySelector('#scrub').value === '8'")
    assert browser_tab.complaints() == []


@pytest.mark.parametrize("scripts", [True, False], ids=["scripts", "no scripts"])
@pytest.mark.parametrize("width", [1280, 400])
def test_nothing_is_wider_than_the_window(browser_tab, folder, width, scripts):
    browser_tab.open((folder / "index.html").as_uri(), width=width, scripts=scripts)
    assert browser_tab.js("document.documentElement.scrollWidth") <= width
    boxes = browser_tab.js(
        "[...document.querySelectorAll('main, section:not([hidden]), #grid li, #bars, .stage, .controls > *')]"
        ".map((e) => e.getBoundingClientRect()).filter((b) => b.width).map((b) => [b.left, b.right])"
    )
    assert len(boxes) > FRAMES
    assert all(-1 <= left < right <= width + 1 for left, right in boxes)
    assert browser_tab.complaints() == []


def test_without_scripts_there_are_thumbnails_and_a_table(browser_tab, folder):
    browser_tab.open((folder / "index.html").as_uri(), scripts=False)
    assert browser_tab.js("document.querySelector('#player').getBoundingClientRect().height") == 0
    pictures = browser_tab.js("[...document.querySelectorAll('#grid img')].map((i) => [i.complete, i.naturalWidth, i.getBoundingClientRect().height])")
    assert len(pictures) == FRAMES
    assert all(complete and natural == 96 and height > 50 for complete, natural, height in pictures)
    assert browser_tab.js("document.querySelectorAll('#frames tbody tr').length") == FRAMES
    browser_tab.click("#grid a[data-frame='9']")
    browser_tab.until("location.hash === '#frame-9'")
    files = browser_tab.js("[...document.querySelectorAll('#frames th a')].map((a) => a.getAttribute('href'))")
    assert all((folder / file).is_file() for file in files) and len(files) == FRAMES


def test_the_page_needs_no_other_file(browser_tab, folder, tmp_path):
    shutil.copy(folder / "index.html", tmp_path)
    browser_tab.open((tmp_path / "index.html").as_uri())
    browser_tab.click("#grid a[data-frame='4']")
    assert number(browser_tab) == 4
    assert browser_tab.js("document.querySelector('#picture').naturalWidth") == 96


# Of text and what is behind it, as WCAG 2.2 has them (1.4.3).
CONTRAST = """
(() => {
  const channel = (v) => (v /= 255) <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
  const numbers = (color) => color.match(/[\\d.]+/g).map(Number);
  const luminance = ([r, g, b]) => 0.2126 * channel(r) + 0.7152 * channel(g) + 0.0722 * channel(b);
  const behind = (e) => {
    for (; e; e = e.parentElement) {
      const color = numbers(getComputedStyle(e).backgroundColor);
      if (color[3] !== 0) return color;
    }
    return [255, 255, 255];
  };
  const ratios = [];
  for (const e of document.querySelectorAll("main *")) {
    const own = [...e.childNodes].some((n) => n.nodeType === 3 && n.textContent.trim());
    if (!own || e.closest("svg") || !e.getClientRects().length) continue;
    const [a, b] = [luminance(numbers(getComputedStyle(e).color)), luminance(behind(e))];
    ratios.push([(Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05), e.outerHTML.slice(0, 80)]);
  }
  return ratios;
})()
"""


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_text_stands_out_in_light_and_dark(tab, scheme):
    tab("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
    paper = tab.js("getComputedStyle(document.body).backgroundColor")
    assert (paper == "rgb(255, 255, 255)") == (scheme == "light")
    ratios = tab.js(CONTRAST)
    assert len(ratios) > 50
    assert min(ratios)[0] >= 4.5, min(ratios)
    tab("Emulation.setEmulatedMedia", features=[])


def test_on_paper_the_player_is_left_out(tab):
    tab("Emulation.setEmulatedMedia", media="print")
    assert tab.js("getComputedStyle(document.querySelector('#player')).display") == "none"
    assert tab.js("document.querySelectorAll('#grid img').length") == FRAMES
    tab("Emulation.setEmulatedMedia", media="")
