"""The schema that `restframe schema` prints, in the hands of the tools that editors use."""

import json
import pathlib
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOLS = pathlib.Path(sys.executable).parent

SOUND = [*sorted(ROOT.glob("shots/*.toml")), ROOT / "tests/bad-shots/models/valid.toml"]
BROKEN = sorted(ROOT.glob("tests/bad-shots/*.toml"))

# Mistakes that lie beyond a schema: names, files, values that depend on others, and numbers that
# JSON has not. `restframe check` finds these too.
BEYOND = set("""
    absurd-array beta-one beta-ramp camera-looks-at-itself camera-on-itself dangling-material
    dangling-spectrum dangling-worldline emissivity-above-one field-of-view field-of-view-key
    infinity inner-exceeds-outer inset-above-inset inset-outside inset-twice inset-without-png
    key-after-the-end keys-descend lab-redefined lamp-too-strong
    light-without-amount lines-of-radio lines-too-sparse look-at-and-yaw missing-csv
    missing-file missing-sky model-extension model-is-a-folder nan no-kind overflowing-number
    panorama-too-high point-at-zero point-without-position points-descend reflectance-above-one
    rgb-moves rgb-splice same-name splice-empty star-temperatures-descend strength-of-absolute
    sun-with-position temperature-key two-fields-of-view two-kinds two-skies unknown-illuminant
    window-descends window-of-nothing zero-direction zero-scale
""".split())


@pytest.fixture(scope="session")
def schema(restframe, tmp_path_factory):
    done = restframe("schema")
    assert (done.returncode, done.stderr) == (0, "")
    path = tmp_path_factory.mktemp("schema") / "shot.schema.json"
    path.write_text(done.stdout, encoding="utf-8")
    return path


def check_jsonschema(*arguments):
    command = [TOOLS / "check-jsonschema", "--output-format", "json", *arguments]
    return subprocess.run(command, capture_output=True, text=True)


@pytest.fixture(scope="session")
def refused(schema):
    """Names of the shots that the schema refuses, or that are no TOML."""
    done = check_jsonschema("--schemafile", schema, *SOUND, *BROKEN)
    report = json.loads(done.stdout)
    found = report["errors"] + report["parse_errors"]
    return {pathlib.Path(error["filename"]).stem for error in found}


def test_the_schema_is_one_of_draft_7(schema):
    assert json.loads(schema.read_text())["$schema"] == "http://json-schema.org/draft-07/schema#"
    done = check_jsonschema("--check-metaschema", schema)
    assert done.returncode == 0, done.stdout


@pytest.mark.parametrize("shot", SOUND, ids=lambda path: path.name)
def test_taplo_accepts_each_sound_shot(schema, shot):
    command = [TOOLS / "taplo", "check", "--schema", schema.as_uri(), shot]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_check_jsonschema_accepts_each_sound_shot(refused):
    assert not refused & {path.stem for path in SOUND}


def test_the_schema_refuses_each_broken_shot_that_a_schema_can(refused):
    assert {path.stem for path in BROKEN} - refused == BEYOND


def test_each_shot_names_its_schema_in_its_first_line():
    for shot in SOUND[:-1]:
        first = shot.read_text(encoding="utf-8").splitlines()[0]
        assert first.startswith("#:schema "), shot


def test_restframe_accepts_each_sound_shot_and_refuses_each_broken_one(restframe):
    for shots, status in [(SOUND[:-1], 0), (BROKEN, 2)]:
        if shots:
            done = restframe("check", *shots, "--json")
            assert done.returncode == status, done.stderr
            assert all(shot["ok"] == (status == 0) for shot in json.loads(done.stdout)["shots"])
