"""What the tests of the module share: small scenes, a photograph of one, and the command to compare with."""

import os
import pathlib
import subprocess

import pytest

import vegard

SOURCE = pathlib.Path(os.environ["VEGARD_SOURCE"])
SCENES = SOURCE / "tests" / "cli" / "scenes"


@pytest.fixture(scope="session")
def scenes():
    return SCENES


@pytest.fixture(scope="session")
def run():
    """run(word, ...): the command, which is to succeed; returns what it printed."""

    def call(*words, exit_codes=(0,)):
        done = subprocess.run([os.environ["VEGARD"], *map(str, words)], capture_output=True, text=True)
        assert done.returncode in exit_codes, done.stderr
        return done.stdout

    return call


@pytest.fixture
def scene(scenes):
    return vegard.load(scenes / "small.toml")


@pytest.fixture
def fit_scene(scenes):
    return vegard.load(scenes / "fit.toml")


@pytest.fixture(scope="session")
def photo_file(run, scenes, tmp_path_factory):
    """The picture of small.toml, which fit.toml is to find."""
    file = tmp_path_factory.mktemp("photo") / "photo.png"
    run("render", scenes / "small.toml", "-o", file)
    return file


@pytest.fixture
def photo(fit_scene, photo_file):
    return fit_scene.photograph(photo_file)
