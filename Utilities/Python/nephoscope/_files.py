# SPDX-License-Identifier: BSD-3-Clause
"""NetCDF files of climate and weather models."""
from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkStructuredGrid

from ._errors import raising
from .vtkCloudIO import vtkCloudNetCDFReader

GEOMETRIES = ("automatic", "map", "globe", "local")


def choice(what: str, value: str, allowed: tuple[str, ...]) -> int:
    """The index of one of the words allowed."""
    if value not in allowed:
        raise ValueError(f"{what}={value!r} is none of {', '.join(map(repr, allowed))}")
    return allowed.index(value)


def reader_of(file: str | os.PathLike[str], *, geometry: str = "automatic", exaggeration: float = 1.0, map_units: str = "m",
              variables: Mapping[str, str] | None = None, diagnose_cloud_fraction: bool = False) -> vtkCloudNetCDFReader:
    """A reader that knows what is in the file. The parameters are those of ``open``."""
    path = os.fspath(file)
    if not os.path.exists(path):
        raise FileNotFoundError(f"{path}: there is no such file; check the path")
    if not 1e-6 <= exaggeration <= 1e6:
        raise ValueError(f"exaggeration={exaggeration} is not within 1e-6 to 1e6")
    reader = vtkCloudNetCDFReader()
    reader.SetFileName(path)
    reader.SetGeometry(choice("geometry", geometry, GEOMETRIES))
    reader.SetMapUnits(choice("map_units", map_units, ("m", "degrees")))
    reader.SetVerticalExaggeration(exaggeration)
    reader.SetDiagnoseCloudFraction(diagnose_cloud_fraction)
    for role, name in (variables or {}).items():
        reader.SetVariableName(role, name)
    with raising():
        reader.UpdateInformation()
    return reader


def _labels(reader: vtkCloudNetCDFReader) -> list[str]:
    return [reader.GetTimeLabel(step) for step in range(reader.GetNumberOfTimeSteps())]


def _steps_of(reader: vtkCloudNetCDFReader) -> str:
    labels = _labels(reader)
    return f"steps 0 ({labels[0]}) to {len(labels) - 1} ({labels[-1]})" if labels else "no time axis"


def date_text(time: Any) -> str | None:
    """ISO text of a date: str, datetime, cftime or numpy.datetime64; None if it is none."""
    if isinstance(time, np.datetime64):
        time = str(time.astype("datetime64[s]"))
    elif hasattr(time, "isoformat"):
        time = time.isoformat()
    return time.strip().replace(" ", "T").removesuffix("Z").removesuffix("+00:00") if isinstance(time, str) else None


def seconds_of(reader: vtkCloudNetCDFReader, time: Any) -> float:
    """Any time within those of the file: an index (int), seconds on its time axis (float), or a date."""
    count, text = reader.GetNumberOfTimeSteps(), date_text(time)
    if isinstance(time, (int, np.integer)) and not isinstance(time, bool):
        seconds = reader.GetTimeValue(int(time) % count) if -count <= time < count else np.nan
    elif text is not None:
        matching = [step for step, label in enumerate(_labels(reader)) if len(text) >= 4 and label.startswith(text)]
        seconds = reader.GetTimeValue(matching[0]) if matching else reader.GetTimeOfDate(text)
    else:
        seconds = float(time)
    if not (count and reader.GetTimeValue(0) <= seconds <= reader.GetTimeValue(count - 1)):
        raise ValueError(f"{reader.GetFileName()}: {time!r} is no time within the file's {_steps_of(reader)}")
    return seconds


def _read(reader: vtkCloudNetCDFReader, time: Any) -> None:
    """Brings the reader up to one of the file's own steps."""
    if time is None or (reader.GetNumberOfTimeSteps() == 0 and time == 0):
        with raising(reader):
            reader.Update()
        return
    seconds = seconds_of(reader, time)
    if all(reader.GetTimeValue(step) != seconds for step in range(reader.GetNumberOfTimeSteps())):
        raise ValueError(f"{reader.GetFileName()}: {time!r} lies between the file's {_steps_of(reader)}; "
                         "nephoscope.interpolate gives the clouds at any time between two steps")
    with raising(reader):
        reader.UpdateTimeStep(seconds)


def detached(grid: vtkStructuredGrid) -> vtkStructuredGrid:
    """The same data without the pipeline that made them."""
    alone = grid.NewInstance()
    alone.ShallowCopy(grid)
    return alone


def open(file: str | os.PathLike[str], *, time: Any = None, geometry: str = "automatic", exaggeration: float = 1.0,  # noqa: A001
         map_units: str = "m", variables: Mapping[str, str] | None = None,
         diagnose_cloud_fraction: bool = False) -> vtkStructuredGrid:
    """One time step of a model's NetCDF file, as a grid in the scene.

    Levels, units, packing, the seam and the poles are the reader's business: see ``help(nephoscope.vtkCloudNetCDFReader)``.

    Parameters
    ----------
    file
        NetCDF file: regular, projected, rotated or curvilinear longitudes and latitudes, a plane in metres, or a curtain.
    time
        Step by index from 0 (``int``; -1 is the last), seconds on the file's time axis (``float``), or a date: ISO 8601 text
        or its beginning, ``datetime``, ``numpy.datetime64``, ``cftime``. Default: the first step.
    geometry
        How the grid lies in the scene. ``"globe"``: about the planet's centre, z to the north pole, x to longitude 0;
        ``"map"``: plate carree, x east, y north; ``"local"``: the file's own projection. Default ``"automatic"``: globe for a
        global grid, local for a projected, rotated or curvilinear one, else map.
    exaggeration
        Factor on heights in the scene, 1e-6 to 1e6; the array Height stays in metres. Default 1; 10 or more shows clouds as
        bodies on a whole globe.
    map_units
        Unit of a map: ``"m"`` (default) or ``"degrees"``.
    variables
        The file's variable for a role, such as ``{"CloudFraction": "CLDTOT"}``, where the names are not known or another is
        wanted. ``info`` shows roles and variables.
    diagnose_cloud_fraction
        Diagnose a cloud fraction after Xu and Randall 1996 where the file has condensate, temperature and humidity but no
        fraction. Default off.

    Returns
    -------
    vtkStructuredGrid
        Points in scene units (m, or degrees) and the point arrays that the file has or that follow from it: CloudFraction
        0..1, LiquidWater, IceWater, SpecificHumidity kg/kg, Wind m/s along the scene's axes, Pressure Pa, Height m,
        Temperature K. ``arrays`` gives them as numpy arrays without a copy.

    Raises
    ------
    FileNotFoundError
        There is no such file.
    ValueError
        No such time, geometry or unit.
    CloudError
        The file cannot be read; the message names file, variable and remedy.

    Examples
    --------
    >>> clouds = nephoscope.open("climate.nc", time="2001-10-01T06", geometry="globe", exaggeration=10)
    >>> nephoscope.arrays(clouds)["CloudFraction"].shape
    (19, 66, 129)
    """
    reader = reader_of(file, geometry=geometry, exaggeration=exaggeration, map_units=map_units, variables=variables,
                       diagnose_cloud_fraction=diagnose_cloud_fraction)
    _read(reader, time)
    return detached(reader.GetOutput())


def info(file: str | os.PathLike[str], *, variables: Mapping[str, str] | None = None) -> dict[str, Any]:
    """What is in a file, without reading fields.

    Parameters
    ----------
    file, variables
        As of ``open``.

    Returns
    -------
    dict
        ``dimensions`` (boxes east, north, up), ``geometry`` (what ``"automatic"`` means here), ``vertical`` (the coordinate),
        ``times`` (ISO 8601 labels), ``seconds`` (the same on the file's time axis), ``units`` of the seconds, ``calendar``,
        ``variables`` (role to the file's variable), ``derived`` (what would be computed, and how), ``warnings``.

    Raises
    ------
    FileNotFoundError, CloudError
        As ``open``.
    """
    reader = reader_of(file, variables=variables)
    steps = range(reader.GetNumberOfTimeSteps())
    roles = [reader.GetRoleName(n) for n in range(reader.GetNumberOfRoles())]
    return {
        "dimensions": tuple(reader.GetFileDimensions()),
        "geometry": reader.GetChosenGeometryAsString().lower(),
        "vertical": reader.GetVerticalCoordinate(),
        "times": _labels(reader),
        "seconds": [reader.GetTimeValue(step) for step in steps],
        "units": reader.GetTimeUnits(),
        "calendar": reader.GetCalendar(),
        "variables": {role: reader.GetVariableOfRole(role) for role in roles},
        "derived": [reader.GetDerivation(n) for n in range(reader.GetNumberOfDerivations())],
        "warnings": [reader.GetWarning(n) for n in range(reader.GetNumberOfWarnings())],
    }
