"""From a photograph to an answer: the command's own folder, and its numbers."""

import json

import pytest

import vegard


@pytest.fixture(scope="module")
def camera(scenes, tmp_path_factory):
    """The camera of map.toml, for a picture large enough that the light's border is no skyline."""
    text = (scenes / "map.toml").read_text()
    section = text[text.index("[camera]") : text.index("[emission]")]
    file = tmp_path_factory.mktemp("camera") / "camera.toml"
    file.write_text(section.replace("width = 96", "width = 216").replace("height = 64", "height = 144"))
    return file


@pytest.fixture(scope="module")
def photo(run, scenes, tmp_path_factory):
    file = tmp_path_factory.mktemp("measure") / "photo.png"
    run("render", scenes / "map_light.toml", "--set", "camera.width=216", "--set", "camera.height=144", "-o", file)
    return file


@pytest.fixture(scope="module")
def measured(photo, camera, tmp_path_factory):
    lines = []
    found = vegard.measure(
        photo,
        tmp_path_factory.mktemp("run") / "python",
        camera=camera,
        site=(67.0, 20.0),
        time="2020-01-01T21:00:00+01:00",
        map=False,
        progress=lambda news: lines.append(news.stage),
    )
    assert lines
    return found


def test_is_the_commands_measurement(measured, run, photo, camera, tmp_path):
    out = tmp_path / "command"
    words = ("--site", "67,20", "--time", "2020-01-01T21:00:00+01:00", "--no-map", "--out", out)
    run("measure", photo, "--camera", camera, *words)
    here = measured.out + "/"
    for name in ("sky.png", "border/border.csv"):
        assert open(here + name, "rb").read() == (out / name).read_bytes(), name
    ours, theirs = json.loads(measured.to_json()), json.loads((out / "measure.json").read_text())
    assert ours["answer"] == theirs["answer"] and ours["trust"] == theirs["trust"] == measured.trust == "good"
    assert [one["title"] for one in theirs["stages"]] == [one.title for one in measured.stages]
    assert json.loads(open(here + "measure.json").read()) == ours
    assert theirs["parts"] == [{"name": p.name, "trust": p.trust, "reasons": p.reasons} for p in measured.parts]
    assert [part.name for part in measured.parts][:2] == ["direction", "distance"]


def test_stages_have_numbers(measured):
    picture, sky, camera, border = measured.stages
    assert picture.numbers["time_utc"] == measured.time == "2020-01-01T20:00:00Z"
    assert sky.numbers["used_px"] + sky.numbers["left_out_px"] == 216 * 144
    assert camera.numbers is None and camera.trust == "good"
    assert border.numbers["measured"] == 1 and border.command.startswith("vegard border ")
    # map_light.toml has a band some 190 km to the north.
    assert border.numbers["traces"][0]["nearest_distance_km"][2] == pytest.approx(190.0, rel=0.1)
    assert measured.site == (67.0, 20.0, 0.0) and measured.has_azimuth and measured.verdicts == []
    assert measured.camera.height == 144


def test_without_anything_known_says_what_would_help(photo, tmp_path):
    found = vegard.measure(photo, tmp_path / "bare")
    assert found.not_known == json.loads(found.to_json())["not_known"]
    assert found.trust == "unconstrained" and found.camera is None and found.time is None and found.site is None
    assert any(stage.lacking for stage in found.stages)
    with pytest.raises(vegard.Error) as caught:
        vegard.measure(photo, tmp_path / "bare")
    assert caught.value.kind == "existing_output"


@pytest.mark.parametrize("name, value", [("threads", -1), ("replicates", 2000), ("line_nm", 1.0), ("site", (97.0, 20.0))])
def test_refuses_what_the_command_refuses(photo, tmp_path, name, value):
    with pytest.raises(vegard.Error) as caught:
        vegard.measure(photo, tmp_path / "refused", **{name: value})
    assert caught.value.kind == "usage" and caught.value.key == name
    assert not (tmp_path / "refused").exists()
