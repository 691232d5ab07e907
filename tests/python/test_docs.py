"""The quick start of docs/python.md, as it stands there."""

import os
import pathlib
import re

import vegard

PAGE = pathlib.Path(os.environ["VEGARD_SOURCE"]) / "docs" / "python.md"


def examples():
    return re.findall(r"```python\n(.*?)```", PAGE.read_text(), re.DOTALL)


def test_the_quick_start_of_eight_lines_runs(scenes, photo_file, tmp_path, monkeypatch, capsys):
    (tmp_path / "scene.toml").write_text((scenes / "fit.toml").read_text())
    (tmp_path / "photo.png").write_bytes(photo_file.read_bytes())
    monkeypatch.chdir(tmp_path)
    quick_start = examples()[0]
    assert len([line for line in quick_start.splitlines() if line.strip()]) == 8
    exec(compile(quick_start, str(PAGE), "exec"), {})
    assert "Believable" in capsys.readouterr().out
    assert (tmp_path / "run" / "report.html").is_file()


def test_the_other_examples_run_too(scenes, photo_file, tmp_path, monkeypatch):
    (tmp_path / "scene.toml").write_text((scenes / "fit.toml").read_text())
    (tmp_path / "photo.png").write_bytes(photo_file.read_bytes())
    monkeypatch.chdir(tmp_path)
    for text in examples()[1:]:
        names = {"vegard": vegard, "scene": vegard.load("scene.toml")}
        exec(compile("import numpy as np\n" + text, str(PAGE), "exec"), names)


def test_the_page_names_all_that_there_is():
    page = PAGE.read_text()
    for name in vegard.__all__:
        if isinstance(getattr(vegard, name), type) and name not in ("FitPhoto", "QuantityVerdict", "DerivedNumber"):
            assert re.search(rf"\b{name}\b", page), name
        elif callable(getattr(vegard, name)) and not isinstance(getattr(vegard, name), type):
            assert f"vegard.{name}(" in page, name
