"""Cameras from stars: the command's own, from tables and columns."""

import csv
import tomllib

import numpy as np
import pytest

import vegard

TIME, SITE = "2020-01-01T20:00:00Z", (65.0, 20.0, 100.0)


@pytest.fixture
def stars():
    """Twelve stars as an equidistant lens of 15 px to a radian sees them, axis to the zenith, centre at (33, 23)."""
    i = np.arange(12)
    azimuth_deg, zenith_deg = 77.0 * i % 360.0, 8.0 + 6.0 * i
    r, a = 15.0 * np.radians(zenith_deg), np.radians(azimuth_deg)
    return {
        "name": [f"star {n}" for n in i],
        "azimuth_deg": azimuth_deg,
        "zenith_deg": zenith_deg,
        "x_px": 33.0 + r * np.sin(a),
        "y_px": 23.0 + r * np.cos(a),
    }


def written(stars, file):
    rows = [",".join(stars)]
    rows += [",".join(str(value) for value in row) for row in zip(*stars.values())]
    file.write_text("\n".join(rows) + "\n")
    return file


def test_finds_the_camera(stars):
    found = vegard.calibrate(stars, size=(64, 48), time=TIME, site=SITE)
    assert found.lens == "equidistant"
    value, sigma = found.numbers["focal_px"]
    assert value == pytest.approx(15.0, abs=1e-6) and sigma < 1e-6  # the stars are exact
    assert found.names == stars["name"] and found.used.all() and found.used.dtype == np.bool_
    assert found.residuals_px.shape == (12, 2) and np.abs(found.residuals_px).max() < 1e-6
    assert found.rms_px < 1e-6
    assert any("time or site" in warning for warning in found.warnings)
    azimuth, elevation = found.camera.directions(stars["x_px"], stars["y_px"])
    np.testing.assert_allclose(elevation, 90.0 - stars["zenith_deg"], atol=1e-6)


def test_columns_and_a_table_give_the_commands_camera(stars, run, tmp_path):
    table = written(stars, tmp_path / "stars.csv")
    run("calibrate", table, "-o", tmp_path / "camera.toml", "--size", "64,48", "--site", "65,20,100", "--time", TIME)
    expected = (tmp_path / "camera.toml").read_text()
    assert vegard.calibrate(table, size=(64, 48), time=TIME, site=SITE).to_toml() == expected
    of_columns = vegard.calibrate(stars, size=(64, 48), time=TIME, site=SITE).to_toml()
    # The table's name stands in the head.
    assert [line for line in of_columns.splitlines() if "stars" not in line] == [
        line for line in expected.splitlines() if "stars" not in line
    ]


def test_a_mistaken_star_is_left_out(stars):
    stars["x_px"][4] += 6.0
    found = vegard.calibrate(stars, size=(64, 48), lens="equidistant")
    assert list(np.flatnonzero(~found.used)) == [4]
    assert found.residuals_px[4, 0] == pytest.approx(6.0, abs=0.01)


def test_the_camera_goes_into_a_scene(stars, scene):
    scene.camera = vegard.calibrate(stars, size=(64, 48)).camera
    assert scene["camera.focal_px"] == pytest.approx(15.0, abs=1e-6)


def test_refuses_what_is_no_calibration(stars, tmp_path):
    with pytest.raises(vegard.Error, match="no stars"):
        vegard.calibrate()
    with pytest.raises(vegard.Error) as caught:
        vegard.calibrate(stars)
    assert caught.value.key == "size"
    with pytest.raises(vegard.Error, match="no lens"):
        vegard.calibrate(stars, size=(64, 48), lens="fish")
    with pytest.raises(vegard.Error, match="no time"):
        vegard.calibrate(stars, size=(64, 48), time="yesterday")
    with pytest.raises(ValueError, match="different lengths"):
        vegard.calibrate({**stars, "x_px": [1.0]}, size=(64, 48))
    few = {name: column[:2] for name, column in stars.items()}
    with pytest.raises(vegard.Error) as caught:
        vegard.calibrate(few, size=(64, 48))
    assert caught.value.kind == "unreadable_input"
    bad = written(stars, tmp_path / "bad.csv")
    bad.write_text(bad.read_text().replace("star 3,", "star 3,x"))
    with pytest.raises(vegard.Error) as caught:
        vegard.calibrate(bad, size=(64, 48))
    assert caught.value.file == str(bad) and caught.value.line == 5


def test_points_of_light_are_found_where_they_are():
    """Gaussian stars 1.2 px wide on an even ground: their places come back within their own errors."""
    places = np.array([[20.3, 15.8], [45.6, 30.1], [31.0, 48.25]])
    y, x = np.mgrid[0:64, 0:64] + 0.5
    light = np.full((64, 64), 0.01)
    random = np.random.default_rng(7)  # seed 7
    light += random.normal(0.0, 1e-4, light.shape)
    for height, (x_px, y_px) in zip((0.5, 0.4, 0.3), places):
        light += height * np.exp(-((x - x_px) ** 2 + (y - y_px) ** 2) / (2.0 * 1.2**2))
    found = vegard.find_stars(vegard.photo_of_light(light), min_signal=20.0)
    assert len(found["x_px"]) == 3
    # The brightest first. Noise of 3e-4 of a star's height moves it by some 1e-3 px; pixels sample it to as much.
    np.testing.assert_allclose(np.column_stack([found["x_px"], found["y_px"]]), places, atol=0.02)
    assert (found["sigma_px"] < 0.02).all() and (found["signal"] > 20.0).all()


def written_sky(file, catalogue):
    """The catalogue's stars to magnitude 4 as an equidistant lens of 250 px to a radian sees them, about right ascension
    90 degrees and the equator with north up, as Gaussians over a ground with a little noise: seed 7."""
    with open(catalogue, newline="") as table:
        rows = [row for row in csv.DictReader(line for line in table if not line.startswith("#"))]
    rows = [row for row in rows if float(row["magnitude"]) <= 4.0]
    ra, dec = (np.radians([float(row[key]) for row in rows]) for key in ("ra_deg", "dec_deg"))
    right, down, forward = np.cos(dec) * np.cos(ra), -np.sin(dec), np.cos(dec) * np.sin(ra)
    across = np.hypot(right, down)
    angle = np.arctan2(across, forward)
    light = 1000.0 + 60.0 * np.random.default_rng(7).uniform(-1.0, 1.0, (360, 480))
    y, x = np.mgrid[0:360, 0:480] + 0.5
    for i in np.flatnonzero(angle < 1.4):
        x_px, y_px = 240.0 + 250.0 * angle[i] * right[i] / across[i], 180.0 + 250.0 * angle[i] * down[i] / across[i]
        if not (4.0 < x_px < 476.0 and 4.0 < y_px < 356.0):
            continue
        height = 9000.0 * 10.0 ** (-0.4 * (float(rows[i]["magnitude"]) - 2.0))
        light += height * np.exp(-((x - x_px) ** 2 + (y - y_px) ** 2) / 2.9)
    levels = np.clip(light, 0, 65535).astype(">u2")
    file.write_bytes(b"P5 480 360 65535\n" + levels.tobytes())
    return file


def test_the_stars_of_a_photograph_are_recognised(scene, scenes, run, tmp_path):
    """When and where that sky was overhead, its stars alone tell the camera: the command's, which also takes fainter stars
    and the time's error. Both know directions and focal length to some 0.01 degrees and 0.05 px."""
    sky = written_sky(tmp_path / "sky.pgm", scenes.parents[2] / "data" / "stars" / "bright_stars.csv")
    when, where = "2020-12-22T00:00:00Z", (0.0, 0.0)
    run("calibrate", "--image", sky, "--decoding", "linear", "--site", "0,0", "--time", when, "-o", tmp_path / "c.toml")
    photo = scene.photograph(sky, decoding="linear")
    found = vegard.calibrate(photo=photo, time=when, site=where)
    ours, theirs = (tomllib.loads(text)["camera"] for text in (found.to_toml(), (tmp_path / "c.toml").read_text()))
    assert ours["elevation_deg"] == pytest.approx(theirs["elevation_deg"], abs=0.05)
    assert ours["focal_px"] == pytest.approx(theirs["focal_px"], abs=0.2)
    assert found.numbers["focal_px"][0] == pytest.approx(250.0, abs=1.0)
    with pytest.raises(vegard.Error) as caught:
        vegard.calibrate(photo=photo, time=when)
    assert caught.value.key == "site"
