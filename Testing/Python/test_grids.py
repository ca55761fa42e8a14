#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Grids of numpy arrays and of what looks like xarray's: the same memory, the reader's places: test_grids.py ROOT."""
import gc
import pathlib
import sys
import unittest
import warnings

import netCDF4
import numpy as np

import nephoscope
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImageData, vtkRectilinearGrid, vtkStructuredGrid

SAMPLE = str(pathlib.Path(sys.argv.pop()) / "Data/sample_climate.nc")
LON, LAT, HEIGHT = np.linspace(5, 15, 41), np.linspace(45, 52, 31), np.linspace(0, 12000, 25)


def ball():
    """A smooth cloud (height, latitude, longitude) in the middle of the box."""
    z, lat, lon = np.meshgrid(HEIGHT, LAT, LON, indexing="ij")
    return np.exp(-((lon - 10) / 2) ** 2 - ((lat - 48.5) / 1.5) ** 2 - ((z - 5000) / 2000) ** 2)


def address(array):
    return array.__array_interface__["data"][0]


def lain(values, **options):
    return nephoscope.grid(values, **{"longitude": LON, "latitude": LAT, "height": HEIGHT, "exaggeration": 20.0, **options})


def volume_inside(surface):
    """By the divergence theorem: positive where triangles wind counter-clockwise seen from outside."""
    corners = nephoscope.points(surface)[nephoscope.triangles(surface)]
    return np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6


class Labelled:
    """As much of xarray.DataArray as is relied upon."""

    def __init__(self, values, dims, coords=None, attrs=None):
        self.values, self.dims, self.coords, self.attrs = np.asarray(values), dims, coords or {}, attrs or {}


def labelled_ball(**attrs):
    coords = {"lon": Labelled(LON, ("lon",), attrs={"units": "degrees_east"}),
              "phi": Labelled(LAT, ("phi",), attrs={"standard_name": "latitude"}),
              "altitude": Labelled(HEIGHT, ("lev",), attrs={"units": "m"})}
    return Labelled(ball(), ("lev", "phi", "lon"), coords, attrs)


class Memory(unittest.TestCase):
    def test_floats_are_shared_with_the_grid_and_back(self):
        for kind in (np.float32, np.float64):
            for lay in (nephoscope.grid, lain):
                values = ball().astype(kind)
                view = nephoscope.arrays(lay(values))["CloudFraction"]
                self.assertEqual((address(view), view.shape, view.dtype), (address(values), values.shape, values.dtype))
                values[3, 4, 5] = 7
                self.assertEqual(view[3, 4, 5], 7)

    def test_read_only_heights_and_vectors_are_shared(self):
        values, heights = ball(), np.broadcast_to(HEIGHT[:, None, None], ball().shape).copy()
        values.flags.writeable = False
        wind = np.ones((*values.shape, 3), np.float32)
        views = nephoscope.arrays(lain({"CloudFraction": values, "Wind": wind}, height=heights))
        for name, array in (("CloudFraction", values), ("Height", heights), ("Wind", wind)):
            self.assertEqual(address(views[name]), address(array), name)

    def test_labelled_arrays_are_shared(self):
        labelled = labelled_ball()
        view = nephoscope.arrays(nephoscope.grid(labelled))["CloudFraction"]
        self.assertEqual(address(view), address(labelled.values))

    def test_memory_lives_as_long_as_either_needs_it(self):
        values, expected = ball(), ball()
        grid = nephoscope.grid(values)
        del values
        gc.collect()
        litter = [np.zeros_like(expected) for _ in range(20)]
        view = nephoscope.arrays(grid)["CloudFraction"]
        np.testing.assert_array_equal(view, expected)
        del grid
        gc.collect()
        litter += [np.zeros_like(expected) for _ in range(20)]
        np.testing.assert_array_equal(view, expected)

    def test_memory_is_given_back(self):
        owner = np.ones(1000)
        before = sys.getrefcount(owner)
        grid = nephoscope.grid(owner.reshape(10, 10, 10))
        self.assertGreater(sys.getrefcount(owner), before)
        del grid
        nephoscope.grid(np.ones((2, 2, 2)))  # VTK's wrappers let go of an array's owner when the next is made
        self.assertEqual(sys.getrefcount(owner), before)

    def test_surfaces_give_their_own_memory(self):
        surface = nephoscope.contour(ball(), 0.5)
        self.assertEqual(address(nephoscope.points(surface)), address(nephoscope.points(surface)))
        self.assertIs(nephoscope.points(surface).flags.owndata, False)
        self.assertIs(nephoscope.triangles(surface).flags.owndata, False)


class Values(unittest.TestCase):
    def test_what_cannot_be_shared_is_converted(self):
        for kind in (">f4", ">f8", "f2", "i2", ">i4", "u1", "?"):
            values = (10 * ball()).astype(kind)
            np.testing.assert_array_equal(nephoscope.arrays(nephoscope.grid(values))["CloudFraction"], values, kind)

    def test_masked_values_are_not_a_number(self):
        values = np.ma.masked_greater(ball(), 0.9)
        view = nephoscope.arrays(nephoscope.grid(values))["CloudFraction"]
        np.testing.assert_array_equal(np.isnan(view), values.mask)

    def test_lists_and_components(self):
        grid = nephoscope.grid([[[1, 2]], [[3, 4]]])
        np.testing.assert_array_equal(nephoscope.arrays(grid)["CloudFraction"], [[[1, 2]], [[3, 4]]])
        for wind in ((ball(), 2 * ball()), np.stack([ball(), 2 * ball()], axis=-1)):
            for lay in (nephoscope.grid, lain):
                view = nephoscope.arrays(lay({"Wind": wind}))["Wind"]
                np.testing.assert_array_equal(view, np.stack([ball(), 2 * ball(), 0 * ball()], axis=-1))

    def test_a_pole_has_the_mean_of_what_is_known(self):
        values = np.ones((2, 2, 4)) * [1, np.nan, 3, np.nan]
        values[1, 1] = np.nan
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            grid = nephoscope.grid(values, longitude=[0, 90, 180, 270], latitude=[-45, 45], height=[0, 1])
        view = nephoscope.arrays(grid)["CloudFraction"]
        np.testing.assert_array_equal(view[:, [0, 3], 0], [[2, 2], [2, np.nan]])

    def test_percent_becomes_a_fraction(self):
        labelled = labelled_ball(units="%")
        np.testing.assert_allclose(nephoscope.arrays(nephoscope.grid(labelled))["CloudFraction"], ball() / 100, rtol=1e-6)

    def test_dimensions_in_any_order(self):
        labelled = labelled_ball()
        turned = Labelled(labelled.values.transpose(2, 0, 1)[None], ("time", "lon", "lev", "phi"), labelled.coords)
        np.testing.assert_array_equal(nephoscope.arrays(nephoscope.grid(turned))["CloudFraction"], ball())

    def test_axes_in_either_direction(self):
        """ERA5's latitudes fall, pressure levels often too: the surface is the same, outside stays outside."""
        expected = volume_inside(nephoscope.contour(lain(ball()), 0.3))
        self.assertGreater(expected, 0)
        for axes in ((0,), (1,), (2,), (0, 1)):
            axis = [HEIGHT, LAT, LON]
            for n in axes:
                axis[n] = axis[n][::-1]
            values = np.ascontiguousarray(np.flip(ball(), axes))
            grid = lain(values, height=axis[0], latitude=axis[1], longitude=axis[2])
            self.assertEqual(address(nephoscope.arrays(grid)["CloudFraction"]), address(values))
            self.assertAlmostEqual(volume_inside(nephoscope.contour(grid, 0.3)) / expected, 1, 12)

    def test_shapes_of_other_data(self):
        image = vtkImageData()
        image.SetDimensions(2, 3, 4)
        image.AllocateScalars(10, 1)
        self.assertEqual([a.shape for a in nephoscope.arrays(image).values()], [(4, 3, 2)])
        with self.assertRaisesRegex(TypeError, "vtkRectilinearGrid has no array of points"):
            nephoscope.points(vtkRectilinearGrid())
        self.assertEqual(nephoscope.points(vtkStructuredGrid()).shape, (0, 3))


class Places(unittest.TestCase):
    def fields_of_file(self, file):
        return {"CloudFraction": np.asarray(file["cl"][1], np.float32), "Temperature": np.asarray(file["ta"][1], np.float32),
                "Wind": (np.asarray(file["ua"][1], np.float32), np.asarray(file["va"][1], np.float32))}

    def test_a_globe_of_arrays_is_the_readers(self):
        """Seam, poles, places and winds, from the file's raw arrays; the reader turns levels and latitudes to rise."""
        with netCDF4.Dataset(SAMPLE) as file:
            fields = self.fields_of_file(file)
            grid = nephoscope.grid(fields, longitude=file["lon"][...], latitude=file["lat"][...],
                                   height=np.asarray(file["zg"][1], np.float32), exaggeration=10)
        read = nephoscope.open(SAMPLE, time=1, geometry="globe", exaggeration=10)
        self.assertEqual(grid.GetDimensions(), read.GetDimensions())
        mine, theirs = nephoscope.arrays(grid), nephoscope.arrays(read)
        levels = slice(None, None, 1 if mine["Height"][0].mean() < mine["Height"][-1].mean() else -1)
        rows = slice(None, None, 1 if nephoscope.points(grid)[0, 0, 0, 2] < 0 else -1)
        for name in ("CloudFraction", "Temperature", "Height"):
            np.testing.assert_allclose(mine[name][levels, rows], theirs[name], rtol=2e-6, atol=1e-7, err_msg=name)
        np.testing.assert_allclose(nephoscope.points(grid)[levels, rows], nephoscope.points(read), atol=0.5)  # Height is float
        up = nephoscope.points(read) / np.linalg.norm(nephoscope.points(read), axis=-1, keepdims=True)
        level_wind = theirs["Wind"] - np.sum(theirs["Wind"] * up, axis=-1, keepdims=True) * up
        inner = slice(1, -1)  # a pole has its row's mean, in which the reader's upward wind is
        np.testing.assert_allclose(mine["Wind"][levels, rows][:, inner], level_wind[:, inner], atol=2e-5)

    def test_geometry_follows_from_coordinates(self):
        def geometry(grid):
            return grid.GetFieldData().GetAbstractArray("Geometry").GetValue(0)
        around = np.arange(0.0, 360.0, 30.0)
        values = np.ones((2, 3, 12))
        globe = nephoscope.grid(values, longitude=around, latitude=[-60, 0, 60], height=[0, 1])
        self.assertEqual((geometry(globe), globe.GetDimensions()), ("Globe", (13, 5, 2)))
        left = nephoscope.grid(values, longitude=around, latitude=[-60, 0, 60], height=[0, 1], close=False)
        self.assertEqual(left.GetDimensions(), (12, 3, 2))
        self.assertEqual(geometry(lain(ball())), "Map")
        local = nephoscope.grid(ball(), x=LON, y=LAT, height=HEIGHT)
        self.assertEqual((geometry(local), local.GetBounds()), ("Local", (5, 15, 45, 52, 0, 12000)))
        for first in (-180, 0, 90, 355):
            with self.subTest("longitudes may step over the end of their range", first=first):
                stepping = (first + np.arange(0, 360, 30) + 180) % 360 - 180
                globe = nephoscope.grid(values, longitude=stepping, latitude=[-60, 0, 60], height=[0, 1])
                self.assertEqual((geometry(globe), globe.GetDimensions()), ("Globe", (13, 5, 2)))
        over = nephoscope.grid(np.zeros((2, 3, 3)), longitude=[359, 0, 1], latitude=[0, 1, 2], height=[0, 1])
        np.testing.assert_allclose(over.GetBounds()[:2], np.radians([359, 361]) * 6371229)
        wide = nephoscope.grid(np.zeros((2, 3, 2)), longitude=[-100, 100], latitude=[0, 1, 2], height=[0, 1])
        np.testing.assert_allclose(wide.GetBounds()[:2], np.radians([-100, 100]) * 6371229)
        with self.subTest("curvilinear"):
            lon, lat = np.meshgrid(LON, LAT)
            curved = nephoscope.points(lain(ball(), longitude=lon, latitude=lat))
            np.testing.assert_array_equal(curved, nephoscope.points(lain(ball())))

    def test_map_is_in_metres_on_the_equator(self):
        grid = nephoscope.grid(np.zeros((2, 2, 2)), longitude=[0, 90], latitude=[0, 45], height=[0, 1000], exaggeration=3)
        quarter = np.pi / 2 * 6371229
        np.testing.assert_allclose(grid.GetBounds(), (0, quarter, 0, quarter / 2, 0, 3000))
        np.testing.assert_array_equal(nephoscope.arrays(grid)["Height"][:, 0, 0], [0, 1000])

    def test_unit_vectors_turn_with_the_globe(self):
        """East at longitude 90 is -x; north on the equator is z; up there is y."""
        shape = (2, 2, 2)
        for part, expected in ((0, (-1, 0, 0)), (1, (0, 0, 1)), (2, (0, 1, 0))):
            wind = tuple(np.full(shape, float(n == part)) for n in range(3))
            grid = nephoscope.grid({"Wind": wind}, longitude=[90, 91], latitude=[0, 1], height=[0, 1], geometry="globe")
            np.testing.assert_allclose(nephoscope.arrays(grid)["Wind"][0, 0, 0], expected, atol=1e-15)

    def test_time_of_a_grid(self):
        for time, seconds in ((np.datetime64("1970-01-02"), 86400.0), ("1970-01-01T00:01", 60.0), (12.5, 12.5)):
            grid = lain(ball(), time=time)
            self.assertEqual(grid.GetInformation().Get(vtkDataObject.DATA_TIME_STEP()), seconds)
        self.assertFalse(lain(ball()).GetInformation().Has(vtkDataObject.DATA_TIME_STEP()))


class Refusals(unittest.TestCase):
    def assert_refused(self, kind, message, call):
        with self.assertRaisesRegex(kind, message):
            call()

    def test_each_names_what_is_wrong_and_what_would_be_right(self):
        pressure = Labelled(HEIGHT, ("lev",), attrs={"units": "hPa"})
        unknown = Labelled(ball(), ("a", "b", "c"))
        for kind, message, call in (
                (ValueError, "there is no latitude: give latitude=, in degrees", lambda: nephoscope.grid(ball(), longitude=LON)),
                (ValueError, "there is no height: give height=, in m",
                 lambda: nephoscope.grid(ball(), longitude=LON, latitude=LAT)),
                (ValueError, r"'CloudFraction' is \(25, 31, 41\) where the grid is \(25, 31, 40\)",
                 lambda: lain(ball(), longitude=LON[1:])),
                (ValueError, r"'CloudFraction' has 2 dimensions \(31, 41\); 3 are needed", lambda: lain(ball()[0])),
                (ValueError, "height is in 'hPa'; give it in m", lambda: lain(ball(), height=pressure)),
                (ValueError, "height has 2 dimensions", lambda: lain(ball(), height=np.ones((2, 2)))),
                (ValueError, "there are no fields", lambda: nephoscope.grid({})),
                (ValueError, "a coordinate is empty", lambda: lain(ball()[:0], height=np.zeros(0))),
                (ValueError, "longitude neither rises nor falls throughout; sort it", lambda: lain(ball(), longitude=np.abs(LON - 9))),
                (ValueError, "latitude reaches 112; give degrees", lambda: lain(ball(), latitude=LAT + 60)),
                (ValueError, "height neither rises nor falls", lambda: lain(ball(), height=np.where(HEIGHT == HEIGHT[3], np.nan, HEIGHT))),
                (ValueError, "exaggeration=nan", lambda: lain(ball(), exaggeration=np.nan)),
                (ValueError, "geometry='flat' is none of 'globe', 'map', 'local'", lambda: lain(ball(), geometry="flat")),
                (ValueError, r"dimensions \('a', 'b', 'c'\), which do not say what they are; transpose",
                 lambda: nephoscope.grid(unknown)),
                (ValueError, "'CloudFraction' has 2 times along 'time'; choose one",
                 lambda: nephoscope.grid(Labelled(np.ones((2, 3, 3, 3)), ("time", "z", "y", "x")))),
                (ValueError, "'Wind' has 1 components", lambda: lain({"Wind": (ball(),)})),
                (ValueError, r"'Wind' is \(1, 31, 41\) where the grid is \(25, 31, 41\)",
                 lambda: lain({"Wind": (ball(), ball()[:1])})),
                (ValueError, r"'Wind' is \(2, 2, 2\) where the grid is", lambda: lain({"Wind": np.ones((2, 2, 2, 3))})),
                (ValueError, r"'b' is \(2, 2, 2\) where the grid is \(3, 3, 3\)",
                 lambda: nephoscope.grid({"a": np.ones((3, 3, 3)), "b": np.ones((2, 2, 2))})),
                (ValueError, r"longitude is \(41,\) and latitude \(7, 8\); give 1 dimension each",
                 lambda: lain(ball(), latitude=np.ones((7, 8)))),
                (ValueError, "latitude has values that are not finite", lambda: lain(ball(), latitude=LAT * np.nan)),
                (TypeError, "'a.nc' is the name of a file; give nephoscope.open", lambda: nephoscope.contour("a.nc")),
                (TypeError, "complex128 is not one of real numbers", lambda: nephoscope.grid(ball().astype(complex))),
                (ValueError, "time='yesterday'|Error parsing datetime", lambda: lain(ball(), time="yesterday"))):
            with self.subTest(message):
                self.assert_refused(kind, message, call)


try:
    import xarray
except ImportError:
    xarray = None


@unittest.skipUnless(xarray, "no xarray; install python3-xarray")
class Xarray(unittest.TestCase):
    """What Labelled stands for, from xarray itself."""

    def dataset(self):
        attrs = {"lon": {"units": "degrees_east"}, "lat": {"units": "degrees_north"}, "height": {"units": "m"}}
        coords = {"lon": ("lon", LON, attrs["lon"]), "lat": ("lat", LAT, attrs["lat"]),
                  "height": ("lev", HEIGHT, attrs["height"]), "time": np.datetime64("1970-01-01T01")}
        return xarray.Dataset({"CloudFraction": (("lev", "lat", "lon"), ball()),
                               "other": (("lat", "lon", "lev"), np.moveaxis(ball(), 0, -1))}, coords)

    def test_data_set_and_array(self):
        dataset = self.dataset()
        grid = nephoscope.grid(dataset, exaggeration=20)
        views = nephoscope.arrays(grid)
        self.assertEqual(address(views["CloudFraction"]), address(dataset.CloudFraction.values))
        np.testing.assert_array_equal(views["other"], ball())
        np.testing.assert_array_equal(nephoscope.points(grid), nephoscope.points(lain(ball())))
        self.assertEqual(grid.GetInformation().Get(vtkDataObject.DATA_TIME_STEP()), 3600)
        one = nephoscope.contour(dataset.CloudFraction, 0.5)
        self.assertEqual(one.GetNumberOfPolys(), nephoscope.contour(lain(ball()), 0.5).GetNumberOfPolys())


if __name__ == "__main__":
    unittest.main()
