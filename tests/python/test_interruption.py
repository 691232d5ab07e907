"""Ctrl-C, an event, and callbacks that raise: long work ends soon, and the interpreter goes on meanwhile."""

import os
import signal
import threading
import time

import pytest

import vegard

LONG = {"sheet.main.beams": 200000, "sheet.main.layers": 3}


@pytest.fixture
def long_scene(scene):
    scene.set(LONG)  # half a minute of one core
    return scene


@pytest.fixture
def long_fit(fit_scene):
    fit_scene.set({"sheet.main.beams": 3000, "fit.scan_points": 1000, "fit.model": "draws"})
    return fit_scene


def after_first_news(action):
    """A progress callback that acts once, so that the work is under way."""
    done = []

    def progress(_):
        if not done:
            done.append(True)
            action()

    return progress


def test_an_event_ends_a_picture(long_scene):
    stop = threading.Event()
    begun = time.monotonic()
    assert long_scene.render(threads=1, progress=after_first_news(stop.set), stop=stop) is None
    assert time.monotonic() - begun < 20.0


def test_an_event_leaves_the_best_so_far_of_a_fit(long_fit, photo):
    stop = threading.Event()
    found = long_fit.fit(photo, threads=1, progress=after_first_news(stop.set), stop=stop)
    assert found.interrupted and found.verdict == "interrupted"
    assert set(found.values) == {"sheet.main.center_km.north", "sheet.main.energy_kev"}


def test_control_c_raises_keyboard_interrupt(long_scene):
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        long_scene.render(threads=1, progress=after_first_news(lambda: os.kill(os.getpid(), signal.SIGINT)))
    assert time.monotonic() - begun < 20.0
    long_scene.set({"sheet.main.beams": 50})
    assert long_scene.render() is not None  # and all goes on


def test_control_c_ends_a_fit(long_fit, photo):
    with pytest.raises(KeyboardInterrupt):
        long_fit.fit(photo, threads=1, progress=after_first_news(lambda: os.kill(os.getpid(), signal.SIGINT)))


def test_what_a_callback_raises_comes_out(long_scene):
    class Enough(Exception):
        pass

    def progress(_):
        raise Enough

    begun = time.monotonic()
    with pytest.raises(Enough):
        long_scene.render(threads=1, progress=progress)
    assert time.monotonic() - begun < 20.0


def test_other_threads_run_meanwhile(long_scene):
    """Without the interpreter's lock: a thread that counts gets far while a picture is made, and can end it."""
    stop, counted = threading.Event(), []

    def count():
        for turn in range(20):
            time.sleep(0.01)
            counted.append(turn)
        stop.set()

    other = threading.Thread(target=count)
    other.start()
    assert long_scene.render(threads=1, stop=stop) is None
    other.join()
    assert len(counted) == 20


def test_a_stop_that_is_none_is_refused(scene):
    with pytest.raises(TypeError, match="is_set"):
        scene.render(stop=True)
