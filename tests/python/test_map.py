"""Maps of precipitation: the command's own."""

import csv

import numpy as np
import pytest

import vegard


@pytest.fixture(scope="module")
def photo_file(run, scenes, tmp_path_factory):
    file = tmp_path_factory.mktemp("map") / "photo.png"
    run("render", scenes / "map_light.toml", "-o", file)
    return file


@pytest.fixture(scope="module")
def mapped(scenes, photo_file):
    return vegard.load(scenes / "map.toml").map(str(photo_file), replicates=2, sparsity=16.0, farthest_km=350.0)


def test_is_the_commands_map(mapped, run, scenes, photo_file, tmp_path):
    words = ("--out", tmp_path / "command", "--replicates", 2, "--sparsity", 16, "--farthest-km", 350)
    run("map", scenes / "map.toml", "--photo", photo_file, *words, exit_codes=(5,))
    mapped.write(tmp_path / "python")
    for name in ("precipitation.fits", "curtains.csv", "faint_curtains.csv", "model.exr", "residual.exr"):
        assert (tmp_path / "python" / name).read_bytes() == (tmp_path / "command" / name).read_bytes(), name
    with pytest.raises(vegard.Error) as caught:
        mapped.write(tmp_path / "python")
    assert caught.value.kind == "existing_output"
    with open(tmp_path / "python" / "curtains.csv", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["curtain"] == "1"]
    curtain = mapped.curtains[0]
    assert set(rows[0]) == {"curtain", "point", *curtain}
    for name, column in curtain.items():
        # The table has six digits or more.
        np.testing.assert_allclose(column, [float(row[name] or "nan") for row in rows], rtol=1e-5, atol=1e-9)


@pytest.mark.parametrize(
    "name, value",
    [("threads", -1), ("replicates", -1), ("sparsity", float("nan")), ("farthest_km", -1.0), ("altitude_scale", 2.0)],
)
def test_refuses_what_the_command_refuses(scenes, photo_file, name, value):
    with pytest.raises(vegard.Error) as caught:
        vegard.load(scenes / "map.toml").map(str(photo_file), **{name: value})
    assert caught.value.kind == "usage" and caught.value.key == name


def test_takes_another_spectrum_as_the_command_does(run, scenes, photo_file, tmp_path):
    """The same bytes as the command's, and other energies than a Maxwellian's."""
    scene = scenes / "map.toml"
    options = {"replicates": 0, "sparsity": 16.0, "farthest_km": 350.0}
    ours = vegard.load(scene).map(str(photo_file), spectrum="gaussian", spread=0.3, **options)
    ours.write(tmp_path / "python")
    words = [word for name, value in options.items() for word in ("--" + name.replace("_", "-"), value)]
    run("map", scene, "--photo", photo_file, "--out", tmp_path / "command", "--spectrum", "gaussian", "--spread", "0.3", *words,
        exit_codes=(0, 5))
    fits = "precipitation.fits"
    assert (tmp_path / "python" / fits).read_bytes() == (tmp_path / "command" / fits).read_bytes()
    assert b"SPECTRUM= 'gaussian" in (tmp_path / "python" / fits).read_bytes()


@pytest.mark.parametrize("named", [{"spectrum": "warm"}, {"kappa": 3.0}, {"spectrum": "gaussian", "spread": 2.0}])
def test_refuses_spectra_that_are_none(scenes, photo_file, named):
    with pytest.raises(vegard.Error) as caught:
        vegard.load(scenes / "map.toml").map(str(photo_file), **named)
    assert caught.value.kind == "usage" and caught.value.key == list(named)[-1]


def test_planes_are_those_of_precipitation_fits(mapped, tmp_path):
    mapped.write(tmp_path / "run")
    planes = fits_planes(tmp_path / "run" / "precipitation.fits")
    names = ("energy_flux_mw_m2", "energy_kev", "relative_flux_error", "ln_energy_error", "sensitivity")
    assert len(planes) == len(names)
    for name, plane in zip(names, planes):
        ours = getattr(mapped, name)
        assert ours.shape == (len(mapped.north_km), len(mapped.east_km)) and ours.dtype == np.float32
        np.testing.assert_array_equal(ours, plane)  # rows of both begin in the south
        assert not ours.flags.owndata


def fits_planes(file):
    """By the standard's own layout (FITS 4.0): cards of 80 bytes in blocks of 2880, then big-endian floats."""
    data = file.read_bytes()
    count = next(i for i in range(0, len(data), 80) if data[i : i + 80].rstrip() == b"END") // 80
    cards = [data[80 * i : 80 * i + 80].decode() for i in range(count)]
    header = {card[:8].strip(): card[10:].split("/")[0].strip() for card in cards if card[8] == "="}
    assert header["BITPIX"] == "-32"
    shape = tuple(int(header[f"NAXIS{axis}"]) for axis in (3, 2, 1))
    begin = -(-80 * (count + 1) // 2880) * 2880
    return np.frombuffer(data, ">f4", int(np.prod(shape)), begin).reshape(shape)


def test_finds_the_band(mapped):
    """map_light.toml has a band of 12 mW m^-2 and 4 keV some 190 km to the north."""
    east, north = np.meshgrid(mapped.east_km, mapped.north_km)
    flux = np.nan_to_num(mapped.energy_flux_mw_m2)
    near = np.abs(east) < 120.0
    centre = np.sum((north * flux)[near]) / np.sum(flux[near])
    # One picture tells the distance of a border by its elevation: a tenth, twice what docs/map.md claims.
    assert centre == pytest.approx(190.0, rel=0.1)
    assert mapped.curtains and mapped.curtains[0]["distance_km"].size > 5


def test_says_what_to_believe(mapped):
    quantities = {one.quantity: one for one in mapped.verdicts}
    # One station does not know the electrons' spectrum, and with it the height: that is in the errors.
    assert quantities["distance of the curtains"].trust in ("good", "doubtful")
    assert quantities["height of the lower border"].trust == "doubtful"
    assert not mapped.flux_is_absolute and not mapped.interrupted
    assert mapped.chi2_per_value > 0.0


def test_refuses_as_the_command_does(scenes, photo_file):
    scene = vegard.load(scenes / "map.toml")
    with pytest.raises(vegard.Error, match="0 photographs"):
        scene.map()
    scene["camera.elevation_deg"] = -70.0
    with pytest.raises(vegard.Error, match="looks at the sky"):
        scene.map(str(photo_file))
