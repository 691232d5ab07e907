"""Aurorae simulated, and fitted to photographs: docs/python.md.

    scene = vegard.load("scene.toml")
    picture = scene.render()          # picture.rayleigh: (height, width, lines)
    fit = scene.fit("photo.jpg")      # fit.values, fit.scene, fit.verdict_line

All light is linear unless a name says otherwise; units are in the names.
"""

from ._vegard import (
    AnswerPart,
    Calibration,
    Camera,
    Cost,
    DerivedNumber,
    Error,
    Fit,
    FitPhoto,
    FittedParameter,
    Map,
    Measurement,
    MeasureStage,
    Parameter,
    Photo,
    Picture,
    Progress,
    QuantityVerdict,
    Scene,
    __version__,
    calibrate,
    find_stars,
    load,
    measure,
    parse,
    photo_of_light,
)

__all__ = [
    "AnswerPart",
    "Calibration",
    "Camera",
    "Cost",
    "DerivedNumber",
    "Error",
    "Fit",
    "FitPhoto",
    "FittedParameter",
    "Map",
    "Measurement",
    "MeasureStage",
    "Parameter",
    "Photo",
    "Picture",
    "Progress",
    "QuantityVerdict",
    "Scene",
    "__version__",
    "calibrate",
    "find_stars",
    "load",
    "measure",
    "parse",
    "photo_of_light",
]
for _one in __all__:
    # Where users find them, in messages and in pickles of their names.
    if isinstance(globals()[_one], type):
        globals()[_one].__module__ = "vegard"
del _one
