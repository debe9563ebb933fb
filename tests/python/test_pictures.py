"""PNG and EXR as OpenImageIO and Pillow read them."""

import json
import struct
import tomllib

import conftest
import numpy
import OpenImageIO
import pytest
from PIL import Image

LAYERS = ["restframe.doppler", "restframe.distance", "restframe.emission_time", "restframe.worldline"]


def opened(path):
    image = OpenImageIO.ImageBuf(str(path))
    assert not image.has_error, image.geterror()
    return image


@pytest.fixture(scope="module")
def exr(frame):
    return opened(f"{frame}.exr")


def channel(exr, name):
    return exr.get_pixels(OpenImageIO.FLOAT)[:, :, exr.spec().channelnames.index(name)]


def srgb(linear):
    linear = numpy.clip(linear, 0, 1)
    return numpy.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def as_rendered(shot, exposure):
    """A shot of one frame, with its metered exposure and what its worldlines leave to defaults."""
    shot = tomllib.loads(shot)
    for line in shot["worldline"].values():
        line |= {"passes": [0, 0, 0], "at": 0} | line
    shot.setdefault("sensor", {})["exposure"] = pytest.approx(exposure, 1e-12)
    return shot


def is_shot_of(spec, shot):
    get = spec.getattribute
    return tomllib.loads(get("restframe:shot")) == as_rendered(shot, get("restframe:exposure"))


def test_the_exr_is_of_full_floats_and_named_channels(exr):
    spec = exr.spec()
    assert (spec.width, spec.height) == (96, 54)
    assert spec.format == OpenImageIO.FLOAT and not spec.channelformats
    assert set(spec.channelnames[:3]) == {"R", "G", "B"}
    assert len(spec.channelnames) == 7


def test_an_exr_of_halves_differs_in_its_colors_alone(exr, frame, restframe, tmp_path):
    path = conftest.render(restframe, tmp_path, conftest.SHOT + 'depth = "half"\n').with_suffix(".0001.exr")
    half = opened(path)
    names = half.spec().channelnames
    assert names == exr.spec().channelnames
    for name, kind in zip(names, half.spec().channelformats):
        written, found = channel(exr, name), channel(half, name)
        if name in "RGB":
            assert kind == OpenImageIO.HALF, name
            # 11 bits of significand, and nothing finer than 2^-24, rounded to nearest.
            assert (numpy.abs(found - written) <= numpy.maximum(numpy.abs(written) * 2**-11, 2**-25)).all(), name
        else:
            assert kind == OpenImageIO.FLOAT, name
            assert (found == written).all(), name
    assert path.stat().st_size < frame.with_suffix(frame.suffix + ".exr").stat().st_size
    assert is_shot_of(half.spec(), conftest.SHOT + 'depth = "half"\n')


def test_the_exr_says_how_it_was_made(exr):
    spec = exr.spec()
    get = spec.getattribute
    assert get("Software").startswith("restframe ")
    assert get("ImageDescription") == "Kügelchen: a sphere passes"
    assert get("restframe:frame") == 1
    assert get("restframe:time") == 5.0
    assert get("restframe:gamma") == 1.0
    assert tuple(get("restframe:beta")) == (0.0, 0.0, 0.0)
    assert get("samplesPerPixel") == 4
    assert get("colorInteropID") == "lin_rec709_scene"
    assert get("FramesPerSecond") in [(24000, 1001), pytest.approx(23.976, 1e-4)]
    assert is_shot_of(spec, conftest.SHOT)
    white = get("whiteLuminance")
    assert white == pytest.approx(100 / 2 ** get("restframe:exposure"), 1e-6)


def test_the_png_is_the_exr_encoded(exr, frame):
    encoded = numpy.asarray(Image.open(f"{frame}.png").convert("RGB")) / 255
    assert encoded.max() > 0.5
    for index, name in enumerate("RGB"):
        difference = numpy.abs(srgb(channel(exr, name)) - encoded[:, :, index])
        assert difference.max() <= 1 / 255, name


def test_layers_describe_the_light_path(exr):
    names = exr.spec().channelnames
    find = lambda word: channel(exr, next(n for n in names if n.lower().replace(" ", "_").endswith(word)))
    doppler, distance, time, worldline = map(find, ["doppler", "distance", "emission_time", "worldline"])
    seen = worldline >= 0
    assert 0 < seen.sum() < seen.size
    assert (worldline[seen] == worldline[seen][0]).all() and (worldline[~seen] == -1).all()
    # The exposure is at t = 5 in the lab; light takes a metre for a metre.
    assert numpy.abs(5 - distance - time)[seen].max() < 1e-5
    # γ = 1.1547: between receding and approaching at 0.5 c.
    assert doppler[seen].min() > 0.57 and doppler[seen].max() < 1.74
    assert (doppler[~seen] == 0).all() and (distance[~seen] == 0).all()


def chunks(path):
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at = 8
    while at < len(data):
        (length,) = struct.unpack(">I", data[at : at + 4])
        yield data[at + 4 : at + 8].decode("ascii")
        at += length + 12


def test_the_png_says_how_it_was_made(frame):
    path = frame.with_suffix(frame.suffix + ".png")
    image = Image.open(path)
    image.load()
    assert (image.size, image.mode) == ((96, 54), "RGB")
    text = image.text
    assert text["Software"].startswith("restframe ")
    assert text["Comment"] == "Kügelchen: a sphere passes"
    assert text["restframe:frame"] == "1"
    assert text["restframe:samples"] == "4"
    exposure = float(text["restframe:exposure"])
    assert tomllib.loads(text["restframe:shot"]) == as_rendered(conftest.SHOT, exposure)
    assert json.loads(text["restframe:worldlines"])[0] == "lab"
    kinds = list(chunks(path))
    assert kinds[0] == "IHDR" and kinds[-1] == "IEND"
    assert {"sRGB", "pHYs", "tEXt", "iTXt", "IDAT"} <= set(kinds)
    assert "tIME" not in kinds  # equal shots give equal bytes
