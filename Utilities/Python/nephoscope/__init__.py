# SPDX-License-Identifier: BSD-3-Clause
"""Clouds of climate and weather models as pictures whose light is right, or wrong by a known amount.

Functions for numpy arrays, what looks like xarray's, and VTK data sets:

    open, info             a model's NetCDF file
    grid                   arrays with coordinates, as a grid
    contour                surfaces of a cloudiness
    advect, interpolate    textures that move with the wind; clouds between two times
    render, camera         pictures, as arrays or files
    arrays, points, triangles    data as numpy arrays, without a copy
    fit                    constants of approximations

and every vtkCloud class of the modules. Data sets are plain VTK ones: PyVista and the VTK pipeline take them as they are.
"""
import importlib as _importlib
import pathlib as _pathlib

_FUNCTIONS = {
    "open": "_files", "info": "_files",
    "grid": "_grids",
    "arrays": "_arrays", "points": "_arrays", "triangles": "_arrays",
    "contour": "_filters", "advect": "_filters", "interpolate": "_filters",
    "render": "_pictures", "Picture": "_pictures", "camera": "_views",
    "fit": "_fits",
    "CloudError": "_errors",
}

for _file in sorted(_pathlib.Path(__file__).parent.glob("vtkCloud*.so")):
    _module = _importlib.import_module("." + _file.name.split(".")[0], __name__)
    globals().update({_name: _value for _name, _value in vars(_module).items() if _name.startswith("vtkCloud")})

#: All that the package has. ``from nephoscope import *`` leaves ``open`` to Python.
__all__ = sorted({_name for _name, _value in globals().items() if isinstance(_value, type)} | set(_FUNCTIONS) - {"open"})


def __getattr__(name):
    """Functions are loaded, and numpy with them, when they are first asked for."""
    if name not in _FUNCTIONS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(_importlib.import_module("." + _FUNCTIONS[name], __name__), name)
    globals()[name] = value
    return value


def __dir__():
    return sorted({*__all__, "open", *(name for name in globals() if name.startswith("__"))})
