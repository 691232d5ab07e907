"""Residuals and Jacobian: those of the fit's own cost."""

import os
import subprocess
import threading

import numpy as np
import pytest

import vegard


def numbers_of_cpp(scene_file, photo_file, parameters, values=()):
    """Residuals and Jacobian as cost_numbers.cpp puts them together from the fit's parts."""
    words = [os.environ["VEGARD_COST_NUMBERS"], str(scene_file), str(photo_file), *map(repr, values)]
    all_of_it = np.frombuffer(subprocess.run(words, capture_output=True, check=True).stdout, np.float64)
    count = len(all_of_it) // (1 + parameters)
    return all_of_it[:count], all_of_it[count:].reshape(count, parameters)


@pytest.mark.parametrize("values", [(), (231.5, 3.1)])
def test_are_cpps_bit_by_bit(fit_scene, scenes, photo_file, values):
    expected, expected_jacobian = numbers_of_cpp(scenes / "fit.toml", photo_file, 2, values)
    cost = fit_scene.cost(str(photo_file), threads=1)
    residuals, jacobian = cost.residuals_and_jacobian(values or None)
    assert residuals.shape == expected.shape and residuals.tobytes() == expected.tobytes()
    assert jacobian.shape == expected_jacobian.shape and jacobian.tobytes() == expected_jacobian.tobytes()
    assert cost.residuals(values or None).tobytes() == expected.tobytes()
    assert cost.jacobian(values or None).tobytes() == expected_jacobian.tobytes()


def test_what_the_cost_is_of(fit_scene, photo):
    cost = fit_scene.cost(photo)
    assert cost.names == ["sheet.main.center_km.north", "sheet.main.energy_kev"]
    assert cost.units == ["km", "keV"]
    assert cost.start.tolist() == [235.0, 3.6]
    assert cost.limits[1][0] > 0.0
    assert cost.count == cost.residuals().size >= cost.of_photographs > 100
    assert cost.residuals().dtype == cost.jacobian().dtype == np.float64
    assert cost.residuals().flags.owndata is False  # the vector that C++ has filled


def test_the_scenes_own_calls_are_those_of_the_cost(fit_scene, photo):
    cost = fit_scene.cost(photo)
    assert fit_scene.residuals(photo).tobytes() == cost.residuals().tobytes()
    assert fit_scene.jacobian(photo).tobytes() == cost.jacobian().tobytes()


def test_the_jacobian_agrees_with_differences(fit_scene, photo):
    """Central differences by a thousandth of a keV and by a tenth of a km: their curvature and the film's rounding are
    both below a hundredth of the column there, by vegard fit --check-derivatives of this scene."""
    cost = fit_scene.cost(photo)
    at, jacobian = cost.start, cost.jacobian()
    for column, step in enumerate((0.1, 1e-3)):
        more, less = at.copy(), at.copy()
        more[column] += step
        less[column] -= step
        difference = (cost.residuals(more) - cost.residuals(less)) / (2.0 * step)
        off = np.linalg.norm(difference - jacobian[:, column]) / np.linalg.norm(jacobian[:, column])
        assert off < 0.05  # as the command's own verdict


def test_the_truth_is_lower_than_the_start(fit_scene, photo):
    cost = fit_scene.cost(photo)
    assert np.sum(cost.residuals([220.0, 3.0]) ** 2) < 0.1 * np.sum(cost.residuals() ** 2)


def test_a_scene_that_changes_leaves_its_cost_alone(fit_scene, photo):
    cost = fit_scene.cost(photo)
    before = cost.residuals()
    fit_scene["sheet.main.energy_kev"] = 8.0
    assert cost.residuals().tobytes() == before.tobytes()
    assert cost.start.tolist() == [235.0, 3.6]
    assert fit_scene.cost(photo).start.tolist() == [235.0, 8.0]


def test_several_threads_may_ask_one_cost(fit_scene, photo):
    cost = fit_scene.cost(photo)
    points = [[220.0 + i, 3.0 + 0.1 * i] for i in range(6)]
    alone = [cost.residuals(point) for point in points]
    found = [None] * len(points)

    def ask(i):
        found[i] = cost.residuals(points[i])

    threads = [threading.Thread(target=ask, args=(i,)) for i in range(len(points))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for one, other in zip(alone, found):
        assert one.tobytes() == other.tobytes()


def test_refuses_what_is_no_point(fit_scene, photo):
    cost = fit_scene.cost(photo)
    with pytest.raises(ValueError, match="one for each of the 2"):
        cost.residuals([1.0, 2.0, 3.0])
    with pytest.raises(ValueError, match="finite"):
        cost.jacobian([np.nan, 3.0])
    least, most = cost.limits[1]
    assert np.isfinite(cost.residuals([220.0, most])).all()  # a limit is inside
    for energy in (-1.0, 0.0, 0.9 * least, 1.1 * most, 1e9):
        for ask in (cost.residuals, cost.jacobian, cost.residuals_and_jacobian):
            with pytest.raises(ValueError, match="sheet.main.energy_kev = .* is not within .* to"):
                ask([220.0, energy])


def test_refuses_photographs_that_do_not_fit(fit_scene, photo, scene):
    with pytest.raises(vegard.Error, match="0 photographs"):
        fit_scene.cost()  # the scene names none
    with pytest.raises(vegard.Error):
        fit_scene.cost([photo, photo])
    with pytest.raises(vegard.Error) as caught:
        scene.cost(photo)  # nothing is free
    assert caught.value.kind == "scene" and caught.value.file == scene.file
    with pytest.raises(vegard.Error) as caught:
        fit_scene.cost("none.png")
    assert caught.value.kind == "unreadable_input"


def test_photographs_are_views(fit_scene, photo_file):
    photo = fit_scene.photograph(photo_file)
    assert photo.light.shape == photo.usable.shape == (120, 160, 3)
    assert photo.light.dtype == np.float32 and photo.usable.dtype == np.bool_
    assert not photo.light.flags.owndata and not photo.light.flags.writeable
    assert photo.light.__array_interface__["data"][0] == photo.light.__array_interface__["data"][0]
    assert photo.decoding.startswith("sRGB") and photo.name == "photo.png" and len(photo.sha256) == 64
    light = photo.light
    kept = light.copy()
    del photo
    assert np.array_equal(light, kept)


def test_light_of_an_array_is_a_photograph(fit_scene, photo):
    """Light is light, whether it comes from a file or an array; what differs is the noise of the file's steps."""
    given = vegard.photo_of_light(photo.light, usable=np.all(photo.usable, axis=2), name="mine")
    assert given.light.tobytes() == photo.light.tobytes()
    assert given.name == "mine" and given.decoding.startswith("linear")
    cost = fit_scene.cost(given)
    assert np.sum(cost.residuals([220.0, 3.0]) ** 2) < 0.1 * np.sum(cost.residuals() ** 2)
    light = photo.light.copy()
    light[3, 4, 1] = np.nan
    holed = vegard.photo_of_light(light)
    assert not holed.usable[3, 4, 1] and holed.light[3, 4, 1] == 0.0 and holed.usable[3, 4, 0]
    grey = vegard.photo_of_light(np.ones((5, 4)))
    assert grey.light.shape == (5, 4, 3) and grey.light.min() == 1.0
    for wrong in (np.ones(5), np.ones((5, 4, 2)), np.ones((0, 4))):
        with pytest.raises(ValueError):
            vegard.photo_of_light(wrong)
    with pytest.raises(ValueError):
        vegard.photo_of_light(np.ones((5, 4)), usable=np.ones((4, 5), bool))


def test_a_mask_leaves_out(fit_scene, photo_file, run, scenes, tmp_path):
    white = tmp_path / "white.png"
    run("render", scenes / "small.toml", "-o", white, "--set", "sky.level=[1.0, 1.0, 1.0]",
        "--set", "sky.gradient=[-2.0, -2.0, -2.0]")
    whole, masked = fit_scene.photograph(photo_file), fit_scene.photograph(photo_file, mask=str(white))
    assert 0 < masked.usable.sum() < whole.usable.sum()
    assert masked.light.tobytes() == whole.light.tobytes()
    with pytest.raises(vegard.Error) as caught:
        fit_scene.photograph(photo_file, mask=str(tmp_path / "none.png"))
    assert caught.value.file == str(tmp_path / "none.png")
