# SPDX-License-Identifier: BSD-3-Clause
"""Clouds of climate and weather models, as VTK classes: ``import nephoscope`` finds every vtkCloud class."""
import importlib as _importlib
import pathlib as _pathlib

# VTK's own extension modules first: ours hand out their objects.
import vtkmodules.all as _vtk  # noqa: F401

for _file in sorted(_pathlib.Path(__file__).parent.glob("vtkCloud*.so")):
    _module = _importlib.import_module("." + _file.name.split(".")[0], __name__)
    globals().update({_name: _value for _name, _value in vars(_module).items() if _name.startswith("vtkCloud")})

__all__ = sorted(_name for _name, _value in globals().items() if isinstance(_value, type))
