# SPDX-License-Identifier: BSD-3-Clause
"""Writes the sample atmosphere as CF-1.8 NetCDF-4, packed or rounded so that it stays small."""
import os

import netCDF4
import numpy as np

from .atmosphere import FULL_A, FULL_B, HALF_A, HALF_B
from .balance import P0
from .sphere import HOUR

START = "2001-10-01 00:00:00"

# name: standard_name, units, packing step and offset for 16-bit integers (or None: floats of `bits` bits)
FIELDS = {
    "cl": ("cloud_area_fraction_in_atmosphere_layer", "1", (1 / 200, 0.0), None),
    "clw": ("mass_fraction_of_cloud_liquid_water_in_air", "kg kg-1", None, 5),
    "cli": ("mass_fraction_of_cloud_ice_in_air", "kg kg-1", None, 5),
    "ta": ("air_temperature", "K", (0.1, 250.0), None),
    "hus": ("specific_humidity", "kg kg-1", None, 7),
    "ua": ("eastward_wind", "m s-1", (0.2, 0.0), None),
    "va": ("northward_wind", "m s-1", (0.2, 0.0), None),
    "wap": ("lagrangian_tendency_of_air_pressure", "Pa s-1", (0.01, 0.0), None),
    "zg": ("geopotential_height", "m", (2.0, 20000.0), None),
}
SURFACE_FIELDS = {
    "ps": ("surface_air_pressure", "Pa", (2.0, 80000.0)),
    "clt": ("cloud_area_fraction", "1", (1 / 200, 0.0)),
}
FIXED_FIELDS = {
    "orog": ("surface_altitude", "m", (0.5, 0.0)),
    "sftlf": ("land_area_fraction", "1", (1 / 200, 0.0)),
}
LONG_NAMES = {"cl": "cloud fraction of the layer", "clt": "total cloud cover, maximum-random overlap"}


class Writer:
    """Writes beside the target and renames at the end, so that no half-written file ever has the target's name."""

    def __init__(self, path, atmosphere, history, only=None):
        self.names = [name for name in list(FIELDS) + list(SURFACE_FIELDS) if not only or name in only + ["ps"]]
        self.path, self.partial = path, path + ".partial"
        self.file = netCDF4.Dataset(self.partial, "w", format="NETCDF4")
        grid = atmosphere.grid
        self.file.setncatts({
            "Conventions": "CF-1.8", "title": "Sample climate: a made-up global atmosphere with clouds",
            "source": "Nephoscope Utilities/SampleClimate", "history": history, "institution": "Nephoscope",
            "references": "Sundqvist et al. (1989), doi:10.1175/1520-0493(1989)117<1641:CACPSW>2.0.CO;2",
            "comment": "Made up: not a forecast, not a reanalysis. Land is only roughly where the Earth has it.",
            "license": "CC0-1.0"})
        for name, size in (("time", None), ("lev", FULL_A.size), ("lat", grid.nlat), ("lon", grid.nlon), ("bnds", 2)):
            self.file.createDimension(name, size)
        self.horizontal(grid)
        self.vertical()
        self.time()
        for name, (standard, units, packing) in FIXED_FIELDS.items():
            self.field(name, ("lat", "lon"), standard, units, packing, None)
        self.put("orog", ..., atmosphere.altitude)
        self.put("sftlf", ..., atmosphere.land)
        for name, (standard, units, packing) in SURFACE_FIELDS.items():
            if name in self.names:
                self.field(name, ("time", "lat", "lon"), standard, units, packing, None)
        for name, (standard, units, packing, bits) in FIELDS.items():
            if name in self.names:
                self.field(name, ("time", "lev", "lat", "lon"), standard, units, packing, bits)

    def coordinate(self, name, dimensions, values, **attributes):
        variable = self.file.createVariable(name, "f8", dimensions)
        variable.setncatts(attributes)
        if values is not None:
            variable[...] = values

    def horizontal(self, grid):
        def pairs(edges):
            return np.stack([edges[:-1], edges[1:]], axis=1)
        self.coordinate("lat", ("lat",), grid.lat, standard_name="latitude", long_name="latitude",
                        units="degrees_north", axis="Y", bounds="lat_bnds")
        self.coordinate("lat_bnds", ("lat", "bnds"), pairs(grid.lat_edges))
        self.coordinate("lon", ("lon",), grid.lon, standard_name="longitude", long_name="longitude",
                        units="degrees_east", axis="X", bounds="lon_bnds")
        self.coordinate("lon_bnds", ("lon", "bnds"), pairs(grid.lon_edges))

    def vertical(self):
        hybrid = "atmosphere_hybrid_sigma_pressure_coordinate"
        self.coordinate("lev", ("lev",), FULL_A + FULL_B, standard_name=hybrid, long_name="hybrid sigma-pressure level",
                        computed_standard_name="air_pressure",
                        units="1", axis="Z", positive="down", bounds="lev_bnds", formula="p = hyam*P0 + hybm*ps",
                        formula_terms="a: hyam b: hybm p0: P0 ps: ps")
        bounds = dict(standard_name=hybrid, units="1", formula="p = hyam_bnds*P0 + hybm_bnds*ps",
                      formula_terms="a: hyam_bnds b: hybm_bnds p0: P0 ps: ps")
        def pairs(half):
            return np.stack([half[:-1], half[1:]], axis=1)
        self.coordinate("lev_bnds", ("lev", "bnds"), pairs(HALF_A + HALF_B), **bounds)
        for name, full, half in (("hyam", FULL_A, HALF_A), ("hybm", FULL_B, HALF_B)):
            what = "pressure part of the hybrid level, over P0" if name == "hyam" else "sigma part of the hybrid level"
            self.coordinate(name, ("lev",), full, long_name=what, units="1")
            self.coordinate(name + "_bnds", ("lev", "bnds"), pairs(half), long_name=what + ", at its bounds", units="1")
        self.coordinate("P0", (), P0, long_name="reference pressure", units="Pa",
                        standard_name="reference_air_pressure_for_atmosphere_vertical_coordinate")

    def time(self):
        self.coordinate("time", ("time",), None, standard_name="time", long_name="time", axis="T",
                        units="hours since " + START, calendar="standard")

    def field(self, name, dimensions, standard, units, packing, bits):
        size = tuple(1 if d in ("time", "lev") else len(self.file.dimensions[d]) for d in dimensions)
        extra = dict(significant_digits=bits, quantize_mode="BitRound") if bits else {}
        variable = self.file.createVariable(
            name, "i2" if packing else "f4", dimensions, zlib=True, complevel=9, shuffle=True, chunksizes=size, **extra)
        variable.setncatts({"standard_name": standard, "long_name": LONG_NAMES.get(name, standard.replace("_", " ")),
                            "units": units})
        if packing:
            variable.setncatts({"scale_factor": packing[0], "add_offset": packing[1]})
        if "time" in dimensions:
            variable.cell_methods = "time: point"

    def put(self, name, where, values):
        self.file.variables[name][where] = values

    def write(self, index, seconds, fields):
        self.put("time", index, seconds / HOUR)
        for name in self.names:
            self.put(name, index, fields[name])

    def close(self):
        self.file.close()
        os.replace(self.partial, self.path)

    def abandon(self):
        self.file.close()
        os.remove(self.partial)
