#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The functions of the package: files, contours, motion, pictures, fits: test_functions.py ROOT PROGRAM rejected=MODULES."""
import contextlib
import datetime
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings

import numpy as np

import nephoscope as ns
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkStructuredGrid
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkRenderingCore import vtkCamera

WITH_FITS = "CloudFits" not in sys.argv.pop()
PROGRAM = sys.argv.pop()
SAMPLE = str(pathlib.Path(sys.argv.pop()) / "Data/sample_climate.nc")
HOUR = 3600.0


def ball(n=24):
    """A ball of fog of radius n / 3 in the middle of a grid whose sides differ; 1 in the middle, 0 at its edge."""
    k, j, i = np.mgrid[:n + 3, :n, :n + 5]
    distance = np.sqrt((i - (n + 4) / 2) ** 2 + (j - (n - 1) / 2) ** 2 + (k - (n + 2) / 2) ** 2)
    return np.clip(1 - distance * 3 / n, 0, None).astype(np.float32)


def picture_of(path):
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    return ns.arrays(reader.GetOutput())["PNGImage"][0, ::-1].astype(int)


class Quiet(unittest.TestCase):
    """No test prints what VTK says, and a warning is an error."""

    def setUp(self):
        warnings.simplefilter("error")
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def assert_refused(self, kind, message, call):
        with self.subTest(message), self.assertRaisesRegex(kind, message):
            call()


class Files(Quiet):
    def test_info(self):
        info = ns.info(SAMPLE)
        self.assertEqual((info["dimensions"], info["geometry"]), ((128, 64, 19), "globe"))
        self.assertEqual(info["vertical"], "hybrid sigma-pressure")
        self.assertEqual(info["times"][1], "2001-10-01T06:00:00")
        self.assertEqual(info["seconds"], [0, 6 * HOUR, 12 * HOUR, 18 * HOUR])
        self.assertEqual(info["variables"]["CloudFraction"], "cl")

    def test_one_time_by_many_names(self):
        expected = ns.arrays(ns.open(SAMPLE, time=1))["CloudFraction"]
        for time in (-3, np.int64(1), 6 * HOUR, np.float32(6 * HOUR), "2001-10-01T06", "2001-10-01 06:00:00",
                     "2001-10-01T06:00:00Z", datetime.datetime(2001, 10, 1, 6), np.datetime64("2001-10-01T06")):
            np.testing.assert_array_equal(ns.arrays(ns.open(SAMPLE, time=time))["CloudFraction"], expected, str(time))
        self.assertTrue((ns.arrays(ns.open(SAMPLE))["CloudFraction"] != expected).any())

    def test_options(self):
        grid = ns.open(pathlib.Path(SAMPLE), geometry="map", map_units="degrees", variables={"LiquidWater": "cli"})
        self.assertEqual(grid.GetBounds()[:2], (0, 360))
        views = ns.arrays(grid)
        np.testing.assert_array_equal(views["LiquidWater"], views["IceWater"])

    def test_refusals(self):
        (self.folder / "text.nc").write_text("no NetCDF")
        for kind, message, call in (
                (FileNotFoundError, "/nowhere.nc: there is no such file", lambda: ns.open("/nowhere.nc")),
                (ValueError, "9 is no time within the file's steps 0 .2001-10-01T00:00:00. to 3",
                 lambda: ns.open(SAMPLE, time=9)),
                (ValueError, "'1999-01-01' is no time", lambda: ns.open(SAMPLE, time="1999-01-01")),
                (ValueError, "'soon' is no time", lambda: ns.open(SAMPLE, time="soon")),
                (ValueError, "lies between .* nephoscope.interpolate", lambda: ns.open(SAMPLE, time=HOUR)),
                (ValueError, "geometry='flat' is none of 'automatic', 'map', 'globe'", lambda: ns.open(SAMPLE, geometry="flat")),
                (ValueError, "exaggeration=0", lambda: ns.open(SAMPLE, exaggeration=0)),
                (ns.CloudError, "sample_climate.nc: role 'Fog' is not known; the roles are CloudFraction",
                 lambda: ns.open(SAMPLE, variables={"Fog": "cl"})),
                (ns.CloudError, "sample_climate.nc: .*nothere", lambda: ns.open(SAMPLE, variables={"CloudFraction": "nothere"})),
                (ns.CloudError, "text.nc: it cannot be opened as NetCDF", lambda: ns.open(self.folder / "text.nc"))):
            self.assert_refused(kind, message, call)


class Messages(Quiet):
    def test_nothing_is_printed_and_vtk_speaks_again_afterwards(self):
        with tempfile.TemporaryFile("w+") as file:
            kept = os.dup(2)
            os.dup2(file.fileno(), 2)
            try:
                with contextlib.suppress(ns.CloudError):
                    ns.contour(ball(), field="nothere")
                os.lseek(2, 0, os.SEEK_SET)
                self.assertEqual(file.read(), "")
                ns.vtkCloudContour().SetValue(-1, 0.5)  # not within the package's care: VTK's own way
                os.lseek(2, 0, os.SEEK_SET)
                self.assertIn("out of range", file.read())
            finally:
                os.dup2(kept, 2)
                os.close(kept)

    def test_messages_are_of_one_line_and_in_the_words_of_functions(self):
        with self.assertRaises(ns.CloudError) as caught:
            ns.contour(ball(), field="nothere")
        self.assertEqual(str(caught.exception),
                         "No point array 'nothere' to contour; the input has: CloudFraction. Choose one with field=.")

    def test_warnings_are_pythons(self):
        longitude = np.arange(0, 360, 40.0)  # an odd number of cells round the globe: the contour's seam stays open
        fields = np.random.default_rng(1).random((3, 4, 9))
        globe = ns.grid(fields, longitude=longitude, latitude=[-60, -20, 20, 60], height=[0, 1e3, 2e3])
        with self.assertWarnsRegex(UserWarning, "seam"):
            ns.contour(globe, 0.5)


class Interruption(Quiet):
    def scape(self):
        body = ns.vtkCloudSurface()
        body.SetInputData(ns.contour(ball(), 0.5))
        scape = ns.vtkCloudscape()
        scape.AddBody(body)
        scape.SetSize(400, 300)
        scape.SetCamera(ns.camera(ball()))
        return scape

    def test_ctrl_c_aborts_a_picture_and_leaves_nothing_behind(self):
        handler = signal.getsignal(signal.SIGINT)
        expected = ns.render(self.scape()).radiance
        scape, progress = self.scape(), []

        def press(source, event):
            progress.append(scape.GetProgress())
            if len(progress) == 2:
                signal.raise_signal(signal.SIGINT)
        tag = scape.AddObserver("ProgressEvent", press)
        with self.assertRaises(KeyboardInterrupt):
            ns.render(scape)
        self.assertLess(len(progress), 30)  # of the 130 tiles
        self.assertIs(signal.getsignal(signal.SIGINT), handler)
        scape.RemoveObserver(tag)
        scape.Modified()
        np.testing.assert_array_equal(ns.render(scape).radiance, expected)

    def test_other_threads_draw_too(self):
        pictures = []
        draw = lambda: pictures.append(ns.render(ball(), size=(40, 30), value=0.5).radiance)  # noqa: E731
        threads = [threading.Thread(target=draw) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for picture in pictures:
            np.testing.assert_array_equal(picture, ns.render(ball(), size=(40, 30), value=0.5).radiance)
        self.assertEqual(len(pictures), 3)


class Contour(Quiet):
    def test_ball_of_an_array(self):
        """The surface at 1/2 is a sphere of radius n / 6: area to 1 %, normals out of it."""
        n = 48
        surface = ns.contour(ball(n), 0.5)
        at, normals = ns.points(surface), ns.arrays(surface)["Normals"]
        corners = at[ns.triangles(surface)]
        area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2
        self.assertAlmostEqual(area / (4 * np.pi * (n / 6) ** 2), 1, delta=0.01)
        outward = at - [(n + 4) / 2, (n - 1) / 2, (n + 2) / 2]
        self.assertGreater(np.min(np.sum(outward * normals, axis=1) / np.linalg.norm(outward, axis=1)), 0.99)

    def test_several_values_and_smoothing(self):
        grid = ns.open(SAMPLE)
        one, two, both = (ns.contour(grid, v).GetNumberOfPolys() for v in (0.15, 0.5, [0.15, 0.5]))
        self.assertEqual(one + two, both)
        smooth = ns.contour(grid, 0.15, smoothing=400e3, normals=False)
        self.assertLess(smooth.GetNumberOfPolys(), one)
        self.assertNotIn("Normals", ns.arrays(smooth))

    def test_refusals(self):
        for kind, message, call in (
                (ns.CloudError, "Contour value nan is not finite", lambda: ns.contour(ball(), np.nan)),
                (ValueError, "smoothing=-1", lambda: ns.contour(ball(), smoothing=-1)),
                (ValueError, "has 2 dimensions", lambda: ns.contour(ball()[0]))):
            self.assert_refused(kind, message, call)


class Motion(Quiet):
    def test_grids_move_as_their_file_does(self):
        grids = [ns.open(SAMPLE, time=n, geometry="globe") for n in range(3)]
        for function, name in ((ns.advect, "TextureCoordinates"), (ns.interpolate, "CloudFraction")):
            by_file = ns.arrays(function(SAMPLE, "2001-10-01T09:00", geometry="globe"))[name]
            by_grids = ns.arrays(function(grids, 9 * HOUR))[name]
            np.testing.assert_array_equal(by_file, by_grids, name)

    def test_interpolation_at_a_step_is_the_step(self):
        at = ns.arrays(ns.interpolate(SAMPLE, 2))["CloudFraction"]
        np.testing.assert_array_equal(at, ns.arrays(ns.open(SAMPLE, time=2))["CloudFraction"])

    def moving(self, seconds):
        """Uniform wind of 10 m/s along x in a box of 200 km; arrays, with a time each."""
        shape = (3, 20, 41)
        x = np.linspace(0, 200e3, 41)
        cloud = np.broadcast_to(np.exp(-((x - 80e3 - 10 * seconds) / 20e3) ** 2), shape).copy()
        return ns.grid({"CloudFraction": cloud, "Wind": (np.full(shape, 10.0), np.zeros(shape))}, x=x,
                               y=np.linspace(0, 95e3, 20), height=[0, 500, 1000], time=seconds)

    def test_arrays_in_a_uniform_wind(self):
        """Coordinates lie where the air was; a carried cloud is in its place, a faded one has two halves."""
        grids = [self.moving(0), self.moving(2 * HOUR)]
        moved = ns.arrays(ns.advect(grids, HOUR, cross_fade=False))["TextureCoordinates"]
        inside = moved[1, 5, 10:-1, 0]
        np.testing.assert_allclose(inside, np.linspace(0, 200e3, 41)[10:-1] - 10 * HOUR, atol=1)
        truth = ns.arrays(self.moving(HOUR))["CloudFraction"][1, 5]
        carried, faded = (ns.arrays(ns.interpolate(grids, HOUR, carry_clouds=carry))["CloudFraction"][1, 5]
                          for carry in (True, False))
        self.assertLess(np.abs(carried - truth).max(), 0.02)
        self.assertGreater(np.abs(faded - truth).max(), 0.3)

    def test_refusals(self):
        timeless = ns.grid(ball())
        still = vtkStructuredGrid()
        grids = [ns.open(SAMPLE, time=n) for n in range(2)]
        for kind, message, call in (
                (ValueError, "'1999' is no time|is no time within", lambda: ns.advect(SAMPLE, "1999-01-01")),
                (ValueError, "is no time within the grids', 0.0 to 21600.0 s", lambda: ns.advect(grids, 1e9)),
                (ValueError, "number 0 of the grids has no time", lambda: ns.advect([still], 0)),
                (TypeError, "number 0 of the grids is a vtkImageData", lambda: ns.advect([timeless], 0)),
                (ValueError, "do not rise", lambda: ns.advect(grids[::-1], 0)),
                (ValueError, "integrator='euler' is none of 'rk2', 'rk4'", lambda: ns.advect(grids, 0, integrator="euler")),
                (TypeError, "geometry: only for files", lambda: ns.advect(grids, 0, geometry="globe"))):
            self.assert_refused(kind, message, call)
        grids[1].GetPointData().RemoveArray("Wind")
        self.assert_refused(ns.CloudError, "there is no point array Wind", lambda: ns.advect(grids, HOUR))


class Pictures(Quiet):
    def test_the_program_draws_the_same(self):
        """Cameras, sun, ground and looks that are not said are the program's: to a few steps of 255, where rounding differs."""
        for geometry, exaggeration in (("globe", 10), ("map", 40)):
            grid = ns.open(SAMPLE, geometry=geometry, exaggeration=exaggeration)
            for style in ("surface", "texture", "volume"):
                path = self.folder / "program.png"
                subprocess.run([PROGRAM, "render", "--data", SAMPLE, "--style", style, "--geometry", geometry, "--exaggeration",
                                str(exaggeration), "--size", "160x120", "-o", path], check=True, stderr=subprocess.DEVNULL)
                difference = np.abs(ns.render(grid, style, size=(160, 120)).rgb().astype(int) - picture_of(path))
                self.assertLess(difference.mean(), 0.2, f"{geometry} {style}")
                self.assertLess((difference > 8).mean(), 1e-3, f"{geometry} {style}")

    def test_fog_has_its_optical_depth(self):
        """A slab of extinction 1/50 and thickness 60, seen along z by a parallel camera: transmittance exp(-60/50)."""
        camera = vtkCamera()
        camera.SetPosition(15, 20, 500)
        camera.SetFocalPoint(15, 20, 0)
        camera.SetViewUp(0, 1, 0)
        camera.ParallelProjectionOn()
        camera.SetParallelScale(10)
        slab = np.ones((61, 41, 31))
        colour = np.array([1, 0.5, 0.25])
        picture = ns.render(slab, "volume", size=(7, 5), camera=camera, samples=1, full_cover_extinction=0.02,
                            color=tuple(colour))
        np.testing.assert_allclose(picture.transmittance, np.exp(-1.2), rtol=2e-5)
        expected = np.broadcast_to((1 - np.exp(-1.2)) * colour, (5, 7, 3))
        np.testing.assert_allclose(picture.radiance, expected, rtol=5e-5)
        np.testing.assert_allclose(picture.depth, 440 + 50 * np.log(2), rtol=1e-4)

    def test_arrays_are_the_images_memory_the_right_way_up(self):
        picture = ns.render(ball(), "surface", size=(40, 30), value=0.5, camera={"bearing": 90, "elevation": 40})
        views = picture.radiance, picture.transmittance, picture.depth
        self.assertEqual([view.shape for view in views], [(30, 40, 3), (30, 40, 3), (30, 40)])
        self.assertEqual({view.dtype for view in views}, {np.dtype(np.float32)})
        stored = ns.arrays(picture.image)["Radiance"][0]
        self.assertEqual(picture.radiance[-1].__array_interface__["data"], stored[0].__array_interface__["data"])
        picture.save(self.folder / "ball.png")
        np.testing.assert_array_equal(picture_of(self.folder / "ball.png"), picture.rgb())
        self.assertEqual(picture._repr_png_(), (self.folder / "ball.png").read_bytes())
        lit = picture.radiance.mean(axis=2)
        self.assertGreater(lit[:15].sum(), lit[15:].sum())  # the sun is above
        with self.subTest("depth"):
            self.assertTrue(np.isinf(picture.depth[0, 0]) and np.isfinite(picture.depth[15, 20]))

    def test_scenes_surfaces_and_looks(self):
        surface = ns.contour(ball(), 0.5)
        size = {"size": (40, 30)}
        whole = ns.render(ball(), value=0.5, smoothing=0, **size).radiance
        np.testing.assert_allclose(ns.render(surface, camera=ns.camera(ball(), size=(40, 30)), **size).radiance, whole,
                                   atol=1e-5)
        faint = ns.render(surface, opacity=0.25, **size)
        self.assertAlmostEqual(faint.transmittance[15, 20, 0], 0.75, 5)
        body = ns.vtkCloudSurface()
        body.SetInputData(surface)
        scape = ns.vtkCloudscape()
        scape.AddBody(body)
        scape.SetSize(40, 30)
        scape.SetCamera(ns.camera(surface, size=(40, 30)))
        self.assertEqual(ns.render(scape).transmittance[15, 20, 0], 0)

    def test_moving_textures_differ_from_resting_ones(self):
        options = {"geometry": "globe", "exaggeration": 10}
        resting, moved = ns.open(SAMPLE, time=2, **options), ns.advect(SAMPLE, 2, **options)
        a, b = (ns.render(grid, "texture", size=(80, 60)).radiance for grid in (resting, moved))
        self.assertGreater(np.abs(a - b).max(), 0.2)
        surfaces = [ns.render(grid, "surface", size=(80, 60)).radiance for grid in (resting, moved)]
        np.testing.assert_array_equal(*surfaces)

    def test_no_cloud_is_no_error(self):
        grid = ns.open(SAMPLE, geometry="globe")
        picture = ns.render(grid, value=2.0, size=(20, 15))
        self.assertTrue(np.isfinite(picture.radiance).all())

    def test_refusals(self):
        fog = ball(8)
        picture = ns.render(fog, size=(8, 6))
        for kind, message, call in (
                (ValueError, "style='oil' is none of 'surface', 'texture', 'volume'", lambda: ns.render(fog, "oil")),
                (TypeError, "vtkCloudSurface has no property 'opacty'; did you mean 'opacity'",
                 lambda: ns.render(fog, opacty=1)),
                (ns.CloudError, "No point array 'x' to draw; the data have: CloudFraction",
                 lambda: ns.render(fog, "volume", field="x")),
                (ValueError, "size=.0, 3. is no width", lambda: ns.render(fog, size=(0, 3))),
                (ValueError, "size=5 is no width", lambda: ns.render(fog, size=5)),
                (ValueError, "samples=99 is not within 1 to 8", lambda: ns.render(fog, samples=99)),
                (ns.CloudError, "32768", lambda: ns.render(fog, size=(40000, 3), samples=1)),
                (ValueError, "toward_sun|is no direction", lambda: ns.render(fog, toward_sun=(0, 0, 0))),
                (ValueError, "camera: 'zoom' is none of longitude", lambda: ns.render(fog, camera={"zoom": 2})),
                (ValueError, "view_angle=0 is not between", lambda: ns.camera(fog, view_angle=0)),
                (ValueError, "distance=-1 is not above 0", lambda: ns.render(fog, camera={"distance": -1})),
                (ValueError, "elevation=91 is not within -90 and 90", lambda: ns.render(fog, camera={"elevation": 91})),
                (ValueError, "longitude=nan is not within", lambda: ns.camera(fog, longitude=np.nan)),
                (ns.CloudError, "has no cells; give two at least", lambda: ns.render(np.ones((1, 1, 4)), "volume")),
                (ns.CloudError, "no camera", lambda: ns.render(ns.vtkCloudscape())),
                (ns.CloudError, "the name has to end in .png or .exr", lambda: picture.save(self.folder / "a.jpg")),
                (ns.CloudError, "Cannot write /nowhere/a.png", lambda: picture.save("/nowhere/a.png"))):
            self.assert_refused(kind, message, call)


class Fits(Quiet):
    @unittest.skipUnless(WITH_FITS, "built without Ceres")
    def test_table_has_a_row_for_each_parameter(self):
        table = ns.fit("transmittance", (0, 2))
        rows = len(table["Parameter"])
        self.assertGreater(rows, 10)
        self.assertEqual({len(column) for column in table.values()}, {rows})
        self.assertEqual(table["Value"].dtype, np.float64)
        row = table["Fit"].index("power 2 gain")
        self.assertTrue(table["Lower"][row] < table["Value"][row] < table["Upper"][row])
        self.assertAlmostEqual(np.sqrt(table["Covariance"][row][0]), table["StandardError"][row])

    @unittest.skipUnless(WITH_FITS, "built without Ceres")
    def test_refusals(self):
        self.assert_refused(ValueError, "subject='fog' is none of 'transmittance'", lambda: ns.fit("fog"))
        self.assert_refused(ns.CloudError, "range 3:1 is empty", lambda: ns.fit("phase", (3, 1)))

    @unittest.skipUnless(WITH_FITS, "built without Ceres")
    def test_a_column_that_is_a_gaussian_is_found(self):
        height = np.arange(0, 2500, 40.0)
        layer = 0.02 * np.exp(-0.5 * ((height - 1000) / 200) ** 2)
        table = ns.fit("density", density=layer, at=(height,), tolerance=0.01)
        first = {p: v for f, p, v in zip(table["Fit"], table["Parameter"], table["Value"]) if f == "Gaussian 1"}
        self.assertAlmostEqual(first["a"], 0.02, delta=2e-4)
        self.assertAlmostEqual(first["z"], 1000, delta=2)
        self.assertAlmostEqual(abs(first["m22"]), 1 / 200, delta=1e-4)
        self.assertNotIn("Gaussian 2", table["Fit"])

    @unittest.skipUnless(WITH_FITS, "built without Ceres")
    def test_a_volume_is_the_same_as_array_and_as_vtk_grid(self):
        z, y, x = (np.linspace(0, 1000, n) for n in (7, 8, 9))
        blob = 0.01 * np.exp(-0.5 * (((z[:, None, None] - 500) / 150) ** 2 + ((y[:, None] - 400) / 200) ** 2
                                     + ((x - 600) / 250) ** 2))
        table = ns.fit("density", density=blob, at=(z, y, x), tolerance=0.2)
        first = {p: v for f, p, v in zip(table["Fit"], table["Parameter"], table["Value"]) if f == "Gaussian 1"}
        for name, middle in (("x", 600), ("y", 400), ("z", 500)):
            self.assertAlmostEqual(first[name], middle, delta=10)
        image = vtkImageData()
        image.SetDimensions(9, 8, 7)
        image.SetSpacing(1000 / 8, 1000 / 7, 1000 / 6)
        values = numpy_to_vtk(blob.ravel(), deep=True)
        values.SetName("Extinction")
        image.GetPointData().AddArray(values)
        again = ns.fit("density", density=image, tolerance=0.2)
        np.testing.assert_allclose(again["Value"], table["Value"], rtol=1e-6)

    @unittest.skipUnless(WITH_FITS, "built without Ceres")
    def test_depths_are_those_that_occur(self):
        general, thin = ns.fit("transmittance"), ns.fit("transmittance", depths=np.linspace(0, 0.5, 400))
        self.assertGreater(thin["Value"][0], general["Value"][0] + 0.1)
        clouds = ns.open(SAMPLE, time=0, geometry="globe", exaggeration=10)
        picture = ns.render(clouds, "volume", size=(64, 48), ground=False, samples=1)
        green = picture.transmittance[..., 1]
        seen = green[(green > 0) & (green < 1)]
        drawn = ns.fit("transmittance", depths=picture)
        self.assertEqual(drawn["TrainingCases"][0] + drawn["HeldOutCases"][0], seen.size)
        same = ns.fit("transmittance", depths=-np.log(seen.astype(float)))
        np.testing.assert_array_equal(drawn["Value"], same["Value"])

    @unittest.skipUnless(WITH_FITS, "built without Ceres")
    def test_arrays_that_do_not_fit_are_refused(self):
        column, height = np.ones(4), np.arange(4.0)
        for kind, message, call in (
                (ValueError, "density is for 'density' and not for 'slab'", lambda: ns.fit("slab", density=column, at=(height,))),
                (ValueError, "'density' needs density=", lambda: ns.fit("density")),
                (ValueError, r"density is \(4,\) and at has \(\(3,\),\); give at=\(heights,\)",
                 lambda: ns.fit("density", density=column, at=(height[:3],))),
                (ValueError, r"give at=\(heights,\) for a column", lambda: ns.fit("density", density=column)),
                (ns.CloudError, "the density of point 0 is -1", lambda: ns.fit("density", density=-column, at=(height,))),
                (ns.CloudError, "the tolerance has to be above 0",
                 lambda: ns.fit("density", density=column, at=(height,), tolerance=0)),
                (ns.CloudError, "no optical depth above 0", lambda: ns.fit("transmittance", depths=np.zeros(9)))):
            self.assert_refused(kind, message, call)

    @unittest.skipIf(WITH_FITS, "built with Ceres")
    def test_without_ceres_it_says_so(self):
        self.assert_refused(RuntimeError, "built without Ceres; install libceres-dev", lambda: ns.fit("phase"))


if __name__ == "__main__":
    unittest.main()
