"""Scenes: read, looked into, changed with the checks of --set, and the one exception."""

import copy
import pickle
import re

import numpy as np
import pytest

import vegard


def test_reads_values_of_every_kind(scene):
    assert scene["sheet.main.energy_kev"] == 3.0
    assert scene["sheet.energy_kev"] == 3.0  # one sheet needs no name
    assert scene["camera.width"] == 160 and isinstance(scene["camera.width"], int)
    assert scene["sheet.main.center_km"] == [20.0, 220.0]
    assert scene["sheet.main.center_km.north"] == 220.0
    assert scene["stars.shown"] is False
    assert scene["site.time_utc"] == "2019-09-05T22:11:12Z"
    assert scene["emission.lines"] == [630.0, 557.7, 427.8]
    assert scene["fit.free"] == []


def test_sets_values_as_the_command_line_does(scene):
    scene["sheet.main.energy_kev"] = np.float32(4.5)
    scene["sheet.main.center_km"] = np.array([1.0, 2.5])
    scene["camera.width"] = np.int64(100)
    scene["stars.shown"] = True
    scene["emission.flux_law"] = "linear"
    scene["fit.free"] = ["sheet.main.energy_kev", {"path": "sheet.main.width_km", "min": 1.0, "max": 3.0}]
    assert scene["sheet.main.energy_kev"] == 4.5
    assert scene["sheet.main.center_km"] == [1.0, 2.5]
    assert scene["camera.width"] == 100
    assert scene["stars.shown"] is True
    assert scene["emission.flux_law"] == "linear"
    assert scene["fit.free"][1]["max"] == 3.0


def test_a_number_comes_back_to_the_last_bit(scene):
    for number in (0.1 + 0.2, 1 / 3, 17.0):
        scene["sheet.main.thickness_km"] = number
        assert scene["sheet.main.thickness_km"] == number
    scene["seed"] = 2**63 - 1
    assert scene["seed"] == 2**63 - 1


def test_load_takes_changes_seed_and_camera(scenes, tmp_path):
    camera = tmp_path / "camera.toml"
    camera.write_text("[camera]\nwidth = 50\nheight = 40\nelevation_deg = 70.0\n[site]\nlatitude_deg = 10.0\n")
    scene = vegard.load(
        scenes / "small.toml", camera=str(camera), set={"sheet.main.energy_kev": 5.0}, seed=11
    )
    assert (scene["camera.width"], scene["site.latitude_deg"]) == (50, 10.0)
    assert scene["sheet.main.energy_kev"] == 5.0
    assert scene["seed"] == 11


def test_a_refused_value_leaves_the_scene_as_it_was(scene):
    before = scene.to_toml()
    with pytest.raises(vegard.Error) as caught:
        scene["sheet.main.energy_kev"] = -1.0
    assert caught.value.key == "sheet.main.energy_kev"
    assert caught.value.kind == "scene"
    with pytest.raises(vegard.Error):
        scene.set({"sheet.main.energy_kev": 5.0, "sheet.main.energykev": 5.0})
    with pytest.raises(vegard.Error):  # that only the whole tells
        scene["fit.free"] = ["sheet.main.no_such_number"]
    assert scene.to_toml() == before


def test_an_error_says_where_and_what_would_be_right(tmp_path):
    file = tmp_path / "wrong.toml"
    file.write_text("[camera]\nwidth = 160\nheigth = 120\n")
    with pytest.raises(vegard.Error) as caught:
        vegard.load(file)
    error = caught.value
    assert error.file == str(file)
    assert error.line == 3
    assert error.key == "camera.heigth"
    assert "heigth" in error.message or "unknown" in error.message
    assert "height" in error.hint
    assert re.match(rf"{re.escape(str(file))}:3: ", str(error))
    with pytest.raises(vegard.Error) as caught:
        vegard.load(tmp_path / "none.toml")
    assert caught.value.kind == "unreadable_input"
    assert caught.value.line is None


def test_an_error_of_another_kind_is_pythons_own(scene):
    with pytest.raises(TypeError, match="a parameter is"):
        scene["sheet.main.energy_kev"] = object()
    with pytest.raises(TypeError):
        vegard.load(3)
    with pytest.raises(TypeError):
        scene.render(progress=3)


def test_lists_parameters_with_units_and_limits(scene):
    by_path = {one.path: one for one in scene.parameters()}
    energy = by_path["sheet.main.energy_kev"]
    assert (energy.value, energy.unit, energy.may_be_free) == (3.0, "keV", True)
    assert energy.min < 3.0 < energy.max
    assert "linear" in by_path["emission.flux_law"].choices
    for path, one in by_path.items():
        if "." in path:  # what is listed can be asked for
            assert scene[path] == one.value or one.value != one.value


def test_copies_go_their_own_ways(scene):
    other = copy.copy(scene)
    deep = copy.deepcopy(scene)
    scene["sheet.main.energy_kev"] = 9.0
    assert other["sheet.main.energy_kev"] == deep["sheet.main.energy_kev"] == 3.0


def test_what_is_written_is_the_same_scene(scene):
    assert vegard.parse(scene.to_toml()).to_toml() == scene.to_toml()


def test_takes_what_a_photograph_says_of_itself(scenes, photo_file):
    scene = vegard.parse("[camera]\nhfov_deg = 60.0\n")
    told = scene.take_from(str(photo_file))
    assert (scene["camera.width"], scene["camera.height"]) == (160, 120)
    assert any("camera.width" in line for line in told)


def test_the_exception_is_one_class_with_all_its_parts():
    assert issubclass(vegard.Error, Exception)
    for part in ("kind", "message", "file", "line", "key", "expected", "hint"):
        assert hasattr(vegard.Error, part)
    assert pickle.loads(pickle.dumps(vegard.Error)) is vegard.Error
