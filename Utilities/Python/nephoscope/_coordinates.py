# SPDX-License-Identifier: BSD-3-Clause
"""What arrays say of themselves: which of their dimensions is which, and where their points are."""
from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from ._arrays import Array, values_of

# The words by which a dimension or a coordinate says what it is: CF's axis, standard_name or units, or a usual name.
_WORDS = {
    "longitude": {"longitude", "lon", "degrees_east", "degree_east", "degrees_e"},
    "latitude": {"latitude", "lat", "degrees_north", "degree_north", "degrees_n"},
    "x": {"x", "projection_x_coordinate", "grid_longitude", "rlon", "west_east", "easting"},
    "y": {"y", "projection_y_coordinate", "grid_latitude", "rlat", "south_north", "northing"},
    "height": {"height", "altitude", "z", "geopotential_height"},
    "level": {"lev", "level", "plev", "air_pressure", "pressure", "model_level_number", "bottom_top", "hpa", "pa", "isobaric"},
    "time": {"time", "t"},
}
_METRES = {"m", "metre", "metres", "meter", "meters"}
_ORDER = {"level": 0, "height": 0, "latitude": 1, "y": 1, "longitude": 2, "x": 2}


def attributes(data: Any) -> Mapping[str, Any]:
    found = getattr(data, "attrs", None)
    return found if isinstance(found, Mapping) else {}


def meaning(name: Any, coordinate: Any) -> str | None:
    """What a dimension or coordinate is, a key of _WORDS: by what it says of itself, else by its name, else by its axis."""
    attrs = attributes(coordinate)
    for said in (attrs.get("standard_name"), attrs.get("units"), name, attrs.get("axis")):
        for key, words in _WORDS.items():
            if str(said).lower() in words:
                return key
    return None


def _coordinates_of(data: Any) -> dict[Any, Any]:
    coordinates = getattr(data, "coords", None)
    return {name: coordinates[name] for name in coordinates} if coordinates is not None else {}


def ordered(name: str, data: Any) -> Array:
    """The values with axes (height, latitude, longitude), turned if the data's dimensions say that they lie otherwise."""
    dims, coordinates = getattr(data, "dims", None), _coordinates_of(data)
    values = getattr(data, "values", data)
    if dims is None:
        return values_of(values)
    kept, keys = [], []
    for axis, dim in enumerate(dims):
        key = meaning(dim, coordinates.get(dim))
        if key == "time" and values.shape[axis] > 1:
            raise ValueError(f"'{name}' has {values.shape[axis]} times along '{dim}'; choose one, with .isel({dim}=0)")
        if key != "time":
            kept.append(axis)
            keys.append(_ORDER.get(key or "", -1))
    if sorted(keys) != list(range(len(keys))):
        raise ValueError(f"'{name}' has the dimensions {tuple(dims)}, which do not say what they are; transpose it to "
                         "(height, latitude, longitude) or (height, y, x) and give .values and the coordinates")
    values = np.squeeze(values, tuple(set(range(len(dims))) - set(kept))) if len(kept) < len(dims) else values
    return values_of(np.transpose(values, np.argsort(keys)))


def discovered(fields: Iterable[Any]) -> dict[str, Any]:
    """The coordinates that the fields bring along, by meaning."""
    found: dict[str, Any] = {}
    for data in fields:
        for name, coordinate in _coordinates_of(data).items():
            key = meaning(name, coordinate)
            if key:
                found.setdefault(key, coordinate)
    return found


def metres(coordinate: Any) -> Array:
    """Heights as numbers. Raises ValueError if they say that they are something else."""
    units = attributes(coordinate).get("units")
    if units is not None and str(units).lower() not in _METRES:
        raise ValueError(f"height is in '{units}'; give it in m")
    return values_of(coordinate)


def epoch_seconds(time: Any) -> float:
    """A time as seconds: dates count from 1970-01-01."""
    value = np.asarray(getattr(time, "values", time))
    if value.dtype.kind == "M":
        return float((value - np.datetime64(0, "s")) / np.timedelta64(1, "s"))
    if value.dtype.kind in "fiu":
        return float(value)
    if hasattr(time, "isoformat") or isinstance(time, str):
        return epoch_seconds(np.datetime64(time if isinstance(time, str) else time.isoformat()))
    raise ValueError(f"time={time!r} is neither seconds nor a date of the ordinary calendar")
