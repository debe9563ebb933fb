"""What the Python tests share: the repository, the program, and one rendered frame.

They look at restframe's files through programs that others wrote. The program is the one that the
environment variable RESTFRAME names, or target/debug/restframe.
"""

import os
import pathlib
import shutil
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / os.environ.get("RESTFRAME", "target/debug/restframe")

SHOT = """
[shot]
title = "Kügelchen: a sphere passes"
time = 5.0
fps = 23.976

[image]
size = [96, 54]
samples = 4

[worldline.passing]
velocity = [0.5, 0, 0]

[[model]]
file = "sphere.obj"
worldline = "passing"

[[light]]
kind = "sun"
direction = [0, -1, -2]
intensity = 1000

[camera]
position = [0, 0, 5]
look_at = [0, 0, 0]

[output]
formats = ["png", "exr"]
layers = ["doppler", "distance", "emission_time", "worldline"]
"""


@pytest.fixture(scope="session")
def root():
    return ROOT


@pytest.fixture(scope="session")
def restframe():
    """Runs the program; standard output and error are text."""

    def run(*arguments, cwd=ROOT):
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=cwd, capture_output=True, text=True)

    return run


def render(restframe, folder, shot):
    """Renders a shot of the sphere; the path of its first frame, without extension."""
    for name in ["sphere.obj", "sphere.mtl"]:
        shutil.copy(ROOT / "assets" / name, folder)
    (folder / "sphere.toml").write_text(shot, encoding="utf-8")
    done = restframe("render", "sphere.toml", cwd=folder)
    assert done.returncode == 0, done.stderr
    return folder / "renders" / "sphere" / "sphere.0001"


@pytest.fixture(scope="session")
def frame(restframe, tmp_path_factory):
    """The path of a rendered frame, without extension."""
    return render(restframe, tmp_path_factory.mktemp("frame"), SHOT)
