"""Cameras: directions and pixels of whole arrays."""

import exr
import numpy as np
import pytest

import vegard

FISHEYE = "[camera]\nmodel = 'equidistant'\nwidth = 64\nheight = 48\nfocal_px = 15.0\nelevation_deg = 90.0\n"


def test_the_middle_looks_along_the_axis(scene):
    azimuth, elevation = scene.camera.directions(80.0, 60.0)
    assert (float(azimuth), float(elevation)) == pytest.approx((0.0, 32.0), abs=1e-12)
    assert azimuth.shape == ()


def test_pixels_and_directions_are_inverse(scene):
    """Seed 20190905. Distortion is undone by iteration to 1e-9 of a pixel; there is none here, so rounding is left."""
    random = np.random.default_rng(20190905)
    x, y = random.uniform(0, 160, (7, 5)), random.uniform(0, 120, (7, 5))
    azimuth, elevation = scene.camera.directions(x, y)
    assert azimuth.shape == elevation.shape == (7, 5) and azimuth.dtype == np.float64
    back_x, back_y = scene.camera.pixels(azimuth, elevation)
    np.testing.assert_allclose(back_x, x, atol=1e-9)
    np.testing.assert_allclose(back_y, y, atol=1e-9)


def test_an_equidistant_lens_by_its_formula():
    camera = vegard.parse(FISHEYE).camera
    zenith_deg = np.linspace(1.0, 80.0, 9)
    x, y = camera.pixels(30.0, 90.0 - zenith_deg)
    assert x.shape == (9,)  # a number and an array
    np.testing.assert_allclose(np.hypot(x - 32.0, y - 24.0), 15.0 * np.radians(zenith_deg), rtol=1e-12)


def test_what_has_no_image_is_not_a_number():
    camera = vegard.parse("[camera]\nwidth = 64\nheight = 48\nelevation_deg = 0.0\n").camera
    x, y = camera.pixels([0.0, 180.0], 0.0)  # ahead and behind
    assert np.isfinite(x[0]) and np.isnan(x[1]) and np.isnan(y[1])
    azimuth, elevation = vegard.parse(FISHEYE).camera.directions(32.0 + 15.0 * 3.0, 24.0)  # 172 degrees off the axis
    assert np.isnan(azimuth) and np.isnan(elevation)


def test_the_map_of_directions_is_the_commands(scene, scenes, run, tmp_path):
    run("directions", scenes / "small.toml", "-o", tmp_path / "maps.exr")
    azimuth, elevation = scene.camera.direction_map()
    assert azimuth.shape == (120, 160) and azimuth.dtype == np.float32
    maps = exr.read(tmp_path / "maps.exr")
    assert maps["azimuth_deg"].tobytes() == azimuth.tobytes()
    assert maps["elevation_deg"].tobytes() == elevation.tobytes()
    one, other = scene.camera.directions(3.5, 7.5)
    assert (azimuth[7, 3], elevation[7, 3]) == (np.float32(one), np.float32(other))


def test_shapes_that_do_not_go_together_are_refused(scene):
    with pytest.raises(ValueError):
        scene.camera.pixels([1.0, 2.0], [1.0, 2.0, 3.0])


def test_a_camera_goes_into_a_scene(scene):
    camera = vegard.parse(FISHEYE).camera
    scene.camera = camera
    assert scene["camera.model"] == "equidistant" == scene.camera.model
    assert (scene.camera.width, scene.camera.height) == (64, 48)
    assert scene.render().rayleigh.shape == (48, 64, 3)
