"""Rendering: the command's own numbers, in buffers that are not copied."""

import gc
import subprocess
import sys
import threading
import weakref

import exr
import numpy as np
import pytest

import vegard


def test_is_what_the_command_renders_bit_by_bit(scene, scenes, run, tmp_path):
    run("render", scenes / "small.toml", "-o", tmp_path / "all.exr", "--lines", tmp_path / "lines.exr")
    picture = scene.render()
    lines = exr.read(tmp_path / "lines.exr")
    assert len(lines) == len(picture.lines) == 3
    for c, wavelength in enumerate(picture.lines):
        (name,) = [name for name in lines if f"{wavelength * 10:.0f}" in name]
        assert lines[name].tobytes() == picture.rayleigh[:, :, c].tobytes()
    rgb = exr.read(tmp_path / "all.exr")
    for c, name in enumerate("RGB"):
        assert rgb[name].tobytes() == picture.rgb[:, :, c].tobytes()


def test_ground_and_limits():
    scene = vegard.parse("[camera]\nwidth = 24\nheight = 16\nelevation_deg = 0\n[ground]\nshown = true\n[[sheet]]\nbeams = 20\n")
    ground = scene.render().ground
    assert ground.shape == (16, 24, 4)
    assert ground[0, :, 3].max() == 0.0 and ground[-1, :, 3].min() == 1.0  # the horizon goes through the middle
    with pytest.raises(vegard.Error) as caught:
        scene.render(threads=-1)
    assert caught.value.kind == "usage" and caught.value.key == "threads"


def test_shapes_types_and_light(scene):
    picture = scene.render()
    assert picture.rayleigh.shape == (120, 160, 3) and picture.rayleigh.dtype == np.float32
    assert picture.rgb.shape == picture.aurora.shape == (120, 160, 3)
    assert picture.lines == scene["emission.lines"]
    assert picture.rayleigh.max() > 100.0  # an arc of 5 mW m^-2 has kilorayleighs
    assert picture.night_sky is None and picture.stars is None and picture.volume is None
    assert picture.deflection_points > 0
    display = picture.display()
    assert display.shape == (120, 160, 3) and 0.0 <= display.min() and display.max() <= 1.0


def test_the_same_for_every_number_of_threads(scene):
    assert scene.render(threads=1).rgb.tobytes() == scene.render(threads=2).rgb.tobytes()


def test_twice_the_flux_is_twice_the_light(scene):
    scene["emission.flux_law"] = "linear"
    once = scene.render().rayleigh
    scene["sheet.main.energy_flux_mw_m2"] = 10.0
    twice = scene.render().rayleigh
    # A film adds in steps of 2^-20 R; single pixels have thousands of rounded samples.
    np.testing.assert_allclose(twice, 2.0 * once, rtol=1e-5, atol=1e-2)


def test_arrays_are_views_of_one_buffer(scene):
    picture = scene.render()
    first, second = picture.rayleigh, picture.rayleigh
    assert first.__array_interface__["data"][0] == second.__array_interface__["data"][0]
    assert not first.flags.owndata and not first.flags.writeable
    with pytest.raises(ValueError):
        first[0, 0, 0] = 1.0


def test_an_array_outlives_its_picture_and_no_longer(scene):
    picture = scene.render()
    light = picture.rayleigh
    kept = light.copy()
    watched = weakref.ref(light)
    references = sys.getrefcount(light.base)
    again = picture.rayleigh
    references_then = sys.getrefcount(light.base)
    assert references_then == references  # each array has an owner of its own
    del picture, again
    gc.collect()
    assert np.array_equal(light, kept)
    del light
    gc.collect()
    assert watched() is None


def test_pictures_that_are_dropped_leave_no_memory_behind():
    """In a process of its own, whose size is its own: 25 pictures with 11 MB of light each would be 275 MB."""
    program = """
import resource, vegard
scene = vegard.parse("[camera]\\nwidth = 640\\nheight = 480\\n")
def megabytes():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * resource.getpagesize() / 2**20
for turn in range(5):
    scene.render(threads=1).rayleigh.sum()
before = megabytes()
for turn in range(25):
    scene.render(threads=1).rayleigh.sum()
print(megabytes() - before)
"""
    grown = float(subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout)
    assert grown < 60.0


def test_sheets_by_themselves_add_up(scene):
    assert scene.render().sheets == {}
    picture = scene.render(sheet_layers=True)
    (rayleigh, aurora) = picture.sheets["main"]
    assert rayleigh.tobytes() == picture.rayleigh.tobytes()
    assert aurora.shape == (120, 160, 3)


def test_progress_is_reported_on_the_callers_thread(scene):
    scene["sheet.main.beams"] = 6000
    heard = []
    scene.render(progress=lambda news: heard.append((news.share, news.stage, threading.get_ident())), threads=1)
    assert heard
    assert all(0.0 <= share <= 1.0 and stage == "rendering" for share, stage, _ in heard)
    assert {thread for _, _, thread in heard} == {threading.get_ident()}


def test_a_picture_too_large_for_memory_is_refused_before_it_is_begun(scene):
    scene.set({"camera.width": 65535, "camera.height": 65535})
    with pytest.raises(vegard.Error, match="memory"):
        scene.render()


def test_names_of_pictures_are_relative_to_the_scene(tmp_path):
    scene = vegard.parse('[composite]\nbackground = "none.png"\n', str(tmp_path / "scene.toml"))
    with pytest.raises(vegard.Error) as caught:
        scene.render()
    assert caught.value.key == "composite.background"
    assert caught.value.file == str(tmp_path / "none.png")
