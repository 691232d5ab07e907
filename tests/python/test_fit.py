"""Fits: the command's answer, and its run's directory."""

import json

import numpy as np
import pytest

import vegard


@pytest.fixture(scope="module")
def fitted(scenes, photo_file):
    return vegard.load(scenes / "fit.toml").fit(str(photo_file), threads=1)


def test_finds_what_the_picture_was_made_from(fitted):
    assert fitted.verdict == "good" and not fitted.interrupted
    for parameter, truth in zip(fitted.parameters, (220.0, 3.0)):
        # Of the command's own fit of this picture; five standard errors, of which one draw in millions is farther.
        assert abs(parameter.value - truth) < 5.0 * parameter.sigma
    assert fitted.values["sheet.main.energy_kev"] == fitted.parameters[1].value
    assert fitted.scene["sheet.main.energy_kev"] == fitted.parameters[1].value
    assert any("distance" in number.name for number in fitted.derived)
    assert {number.trust for number in fitted.derived} <= {"good", "doubtful", "unconstrained"}


def test_is_the_commands_answer(fitted, run, scenes, photo_file, tmp_path):
    run("fit", scenes / "fit.toml", "--photo", photo_file, "--out", tmp_path / "command", "--threads", 1)
    fitted.write(tmp_path / "python")
    for name in ("profiles.csv", "trace.csv", "map.svg", "model.exr", "residual.exr"):
        assert (tmp_path / "python" / name).read_bytes() == (tmp_path / "command" / name).read_bytes(), name
    ours, theirs = (json.loads((tmp_path / who / "result.json").read_text()) for who in ("python", "command"))
    assert ours.pop("command") != theirs.pop("command")
    assert ours == theirs
    assert json.loads(fitted.to_json())["verdict"] == "good"
    with pytest.raises(vegard.Error) as caught:
        fitted.write(tmp_path / "python")
    assert caught.value.kind == "existing_output"
    fitted.write(tmp_path / "python", overwrite=True)


def test_profiles_and_correlation_are_arrays(fitted):
    (photo,) = fitted.photos
    assert photo.data.shape == photo.sigma.shape == photo.model.shape == (4, 120, 3)
    assert not photo.data.flags.owndata
    used = photo.sigma > 0.0
    assert np.sqrt(np.mean(((photo.data - photo.model)[used] / photo.sigma[used]) ** 2)) < 2.0
    assert fitted.correlation.shape == (2, 2)
    np.testing.assert_allclose(np.diag(fitted.correlation), 1.0, rtol=1e-9)
    assert fitted.dof > 0 and fitted.chi2 > 0.0
    model = photo.model
    kept = model.copy()
    del photo
    assert np.array_equal(model, kept)


def test_a_photo_is_left_as_it_was(fit_scene, photo):
    light = photo.light.copy()
    fit_scene.fit(photo, max_evaluations=5)
    assert np.array_equal(photo.light, light)


def test_progress_tells_stages(fit_scene, photo):
    fit_scene["sheet.main.beams"] = 3000
    heard = []
    fit_scene.fit(photo, progress=heard.append, threads=1)
    assert heard and all(isinstance(news, vegard.Progress) for news in heard)
    assert heard[-1].evaluations > 0 and all(0.0 <= news.share <= 1.0 for news in heard)
    assert all(news.stage for news in heard)


def test_refuses_as_the_command_does(fit_scene, photo, tmp_path):
    with pytest.raises(vegard.Error) as caught:
        fit_scene.fit()
    assert caught.value.key == "photo"
    fit_scene["camera.width"] = 161
    with pytest.raises(vegard.Error, match="161 x 120"):
        fit_scene.fit(photo)
    with pytest.raises(vegard.Error):
        fit_scene.fit(photo, from_map=str(tmp_path / "none"))
