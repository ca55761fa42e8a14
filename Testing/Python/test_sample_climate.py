#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The made-up atmosphere keeps the balances that it claims, and Data/ carries it: test_sample_climate.py ROOT."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

import netCDF4
import numpy as np

ROOT = pathlib.Path(sys.argv.pop()).resolve()
SCRIPT = ROOT / "Utilities/SampleClimate/sample_climate.py"
SAMPLE = ROOT / "Data/sample_climate.nc"
FINE = ROOT / "Data/sample_clouds.nc"
sys.path.insert(0, str(SCRIPT.parent))

from climate.atmosphere import FULL_A, FULL_B, Atmosphere  # noqa: E402
from climate.balance import P0, coriolis, jet_shapes, JET_PROFILES  # noqa: E402
from climate.clouds import VIRTUAL, cloud_fraction, critical_humidity, saturation_humidity, total_cover  # noqa: E402
from climate.netcdf import FIELDS, SURFACE_FIELDS  # noqa: E402
from climate.sphere import GRAVITY, KAPPA, R_DRY, RADIUS, RandomWaves, smooth, unit_vectors  # noqa: E402

SMALL = Atmosphere(48, 25)
FIRST, LATER = SMALL.step(0.0), SMALL.step(6 * 3600.0)
HEIGHTS = np.array([0.1, 0.4, 0.7, 1.1, 1.6, 2.2])[:, None, None]  # Z, from 905 to 111 hPa


def rms(values):
    return np.sqrt(np.mean(np.square(values)))


class Balance(unittest.TestCase):
    """Finite differences of the analytic state, over steps so small that the differences' error is below 1e-5."""

    lat, lon, step = np.array([-71.0, -48.5, -33.0, 27.0, 44.0, 66.5]), np.arange(0.0, 360.0, 11.0), 0.01

    def columns(self, north=0.0, east=0.0):
        return SMALL.flow.columns(self.lat + north, self.lon + east, 5.0e4)

    def gradient(self, what):
        """Of columns.what(HEIGHTS): eastward and northward, per metre."""
        arc = 2.0 * np.radians(self.step) * RADIUS
        north = (getattr(self.columns(north=self.step), what)(HEIGHTS)
                 - getattr(self.columns(north=-self.step), what)(HEIGHTS)) / arc
        east = (getattr(self.columns(east=self.step), what)(HEIGHTS)
                - getattr(self.columns(east=-self.step), what)(HEIGHTS)) / arc
        return east / np.cos(np.radians(self.lat))[:, None], north

    def jets(self, z, order=0):
        return sum(a[:, None] * p(z, order) for a, p in zip(jet_shapes(self.lat), JET_PROFILES))

    def test_hydrostatic(self):
        columns, d = self.columns(), 1e-3
        thickness = columns.geopotential(HEIGHTS + d) - columns.geopotential(HEIGHTS - d)
        np.testing.assert_allclose(thickness / (2 * d), R_DRY * columns.virtual_temperature(HEIGHTS), rtol=2e-5)

    def test_gradient_wind_of_jets_and_geostrophic_wind_of_waves(self):
        east, north = self.gradient("geopotential")
        u, v = self.columns().wind(HEIGHTS)
        lat = self.lat[:, None]
        curvature = self.jets(HEIGHTS) ** 2 * np.tan(np.radians(lat)) / RADIUS
        self.assertLess(rms(coriolis(lat) * u + curvature + north), 0.01 * rms(north))
        self.assertLess(rms(coriolis(lat) * v - east), 0.01 * rms(east))

    def test_thermal_wind(self):
        """f dV/dZ = R k x grad Tv, with the jets' curvature, to 1 % (the waves' 1/f is bounded at the Equator)."""
        east, north = self.gradient("virtual_temperature")
        d = 1e-3
        above, below = self.columns().wind(HEIGHTS + d), self.columns().wind(HEIGHTS - d)
        du, dv = ((a - b) / (2 * d) for a, b in zip(above, below))
        lat = self.lat[:, None]
        curvature = 2 * self.jets(HEIGHTS) * self.jets(HEIGHTS, 1) * np.tan(np.radians(lat)) / RADIUS
        scale = R_DRY * rms(np.hypot(east, north))
        self.assertLess(rms(coriolis(lat) * du + curvature + R_DRY * north), 0.01 * scale)
        self.assertLess(rms(coriolis(lat) * dv - R_DRY * east), 0.01 * scale)

    def test_ascent_keeps_potential_temperature(self):
        columns, seconds, d = self.columns(), 60.0, 1e-3
        t_east, t_north = self.gradient("virtual_temperature")
        u, v = columns.wind(HEIGHTS)
        change = (SMALL.flow.columns(self.lat, self.lon, 5.0e4 + seconds).virtual_temperature(HEIGHTS)
                  - SMALL.flow.columns(self.lat, self.lon, 5.0e4 - seconds).virtual_temperature(HEIGHTS)) / (2 * seconds)
        slope = (columns.virtual_temperature(HEIGHTS + d) - columns.virtual_temperature(HEIGHTS - d)) / (2 * d)
        climb = columns.ascent(HEIGHTS)
        heating = change + u * t_east + v * t_north + climb * (slope + KAPPA * columns.virtual_temperature(HEIGHTS))
        free = slice(1, None)  # the ascent fades towards the ground
        self.assertLess(rms(heating[free]), 0.01 * rms((change + u * t_east + v * t_north)[free]))

    def test_waves_travel_eastward_at_synoptic_speeds(self):
        lon, hours = np.arange(0.0, 360.0, 0.5), 6.0
        for latitude in (-52.0, 50.0):
            v = [SMALL.flow.columns(np.array([latitude]), lon, h * 3600.0).wind(0.7)[1][0] for h in (0.0, hours)]
            match = np.fft.irfft(np.conj(np.fft.rfft(v[0])) * np.fft.rfft(v[1]))
            shift = (np.argmax(match) * 0.5 + 180.0) % 360.0 - 180.0
            speed = np.radians(shift) * RADIUS * np.cos(np.radians(latitude)) / (hours * 3600.0)
            self.assertTrue(4.0 < speed < 20.0, f"{speed} m/s at {latitude}")

    def test_overturning_conserves_mass(self):
        """d(v cos phi)/(a cos phi dphi) + domega/dp = 0 in the zonal mean, to 2 % of its terms."""
        cells = SMALL.humidity.overturning
        lat, pressure, d = np.linspace(-35.0, 35.0, 281)[:, None], np.array([[[3.0e4]], [[7.0e4]]]), 0.05
        calm = np.ones((lat.size, 8))
        flux = [cells.northward(lat + s, pressure) * np.cos(np.radians(lat + s)) for s in (d, -d)]
        divergence = (flux[0] - flux[1]) / (np.radians(2 * d) * RADIUS * np.cos(np.radians(lat)))
        squeeze = (cells.omega(lat, pressure + 10.0, calm) - cells.omega(lat, pressure - 10.0, calm)) / 20.0
        self.assertLess(rms(divergence + squeeze), 0.02 * rms(squeeze))


class Sampled(unittest.TestCase):
    """The arrays on the hybrid levels."""

    def virtual(self, fields):
        return fields["ta"] * (1.0 + VIRTUAL * fields["hus"])

    def test_pressure_is_hybrid_and_the_ground_is_at_its_altitude(self):
        for k in range(FULL_A.size):
            np.testing.assert_allclose(FIRST["pressure"][k], FULL_A[k] * P0 + FULL_B[k] * FIRST["ps"], rtol=1e-12)
        columns = SMALL.flow.columns(SMALL.grid.lat, SMALL.grid.lon, 0.0)
        ground = columns.geopotential(-np.log(FIRST["ps"] / P0)) / GRAVITY
        np.testing.assert_allclose(ground, SMALL.altitude, atol=1e-3)

    def test_heights_are_hypsometric(self):
        """Trapezia between levels: within 8 m a layer below 40 hPa, 3 m below 300 hPa (the layers are thick)."""
        p, z, virtual = FIRST["pressure"], FIRST["zg"], self.virtual(FIRST)
        thickness = R_DRY / GRAVITY * 0.5 * (virtual[1:] + virtual[:-1]) * np.log(p[1:] / p[:-1])
        error = np.abs(z[:-1] - z[1:] - thickness).max(axis=(1, 2))
        self.assertLess(error[2:].max(), 8.0)
        self.assertLess(error[8:].max(), 3.0)

    def test_stable_everywhere(self):
        theta = self.virtual(FIRST) * (P0 / FIRST["pressure"]) ** KAPPA
        self.assertGreater((theta[:-1] - theta[1:]).min(), 0.0)

    def test_cloud_is_sundqvists(self):
        relative = FIRST["hus"] / saturation_humidity(FIRST["ta"], FIRST["pressure"])
        np.testing.assert_allclose(relative, FIRST["relative_humidity"], rtol=1e-12)
        unresolved = SMALL.humidity.texture(0).lost
        self.assertTrue(0.0 < unresolved < 1.0)
        critical = critical_humidity(FULL_A + FULL_B, unresolved)[:, None, None] + 0.0 * relative
        cloudy = relative > critical
        np.testing.assert_allclose(FIRST["cl"][cloudy],
                                   1.0 - np.sqrt((1.0 - relative[cloudy]) / (1.0 - critical[cloudy])), atol=1e-12)
        self.assertEqual(np.abs(FIRST["cl"][~cloudy]).max(), 0.0)
        self.assertEqual(cloud_fraction(1.0, 0.8), 1.0)

    def test_water_is_where_cloud_is(self):
        water = FIRST["clw"] + FIRST["cli"]
        np.testing.assert_array_equal(water > 0.0, FIRST["cl"] > 0.0)
        self.assertEqual(FIRST["clw"][FIRST["ta"] < 235.15].max(), 0.0)
        self.assertEqual(FIRST["cli"][FIRST["ta"] > 273.15].max(), 0.0)
        self.assertTrue(1e-5 < water.max() < 4e-4)

    def test_ranges(self):
        for name, low, high in (("ta", 185.0, 315.0), ("hus", 1e-7, 0.025), ("ua", -60.0, 100.0), ("va", -70.0, 70.0),
                                ("wap", -4.0, 4.0), ("cl", 0.0, 1.0), ("clt", 0.0, 1.0), ("ps", 5.0e4, 1.05e5),
                                ("relative_humidity", 0.0, 1.0), ("zg", -600.0, 4.0e4)):
            self.assertTrue(low <= FIRST[name].min() and FIRST[name].max() <= high,
                            f"{name}: {FIRST[name].min()} to {FIRST[name].max()}")

    def test_total_cover(self):
        """Adjacent layers overlap at most, layers apart at random."""
        self.assertAlmostEqual(total_cover(np.array([0.3, 0.5, 0.2])), 0.5, 12)
        self.assertAlmostEqual(total_cover(np.array([0.3, 0.0, 0.5])), 1.0 - 0.7 * 0.5, 12)

    def test_the_seam_is_no_edge(self):
        for name in ("cl", "ta", "ua", "va", "clt", "ps"):
            step = np.abs(np.diff(FIRST[name], axis=-1)).reshape(-1, 47).mean(axis=0)
            seam = np.abs(FIRST[name][..., 0] - FIRST[name][..., -1]).mean()
            self.assertLess(seam, 1.5 * step.max(), name)

    def test_texture_drifts_with_the_air(self):
        """What lies at a point now lay, six hours ago, where that point's air was: to the weight of what is new."""
        humidity, height = SMALL.humidity, np.full(300, 0.7, np.float32)
        rng = np.random.default_rng(1)
        position = unit_vectors(np.degrees(np.arcsin(rng.uniform(-0.95, 0.95, 300))), rng.uniform(0, 360, 300))
        position = position.astype(np.float32)
        was = humidity.history(position, height, 2)[2]
        now, there, here = (humidity(*at)[1] for at in ((position, height, 2), (*was, 0), (position, height, 0)))
        # Laid down 24 h ago with weight 1, 6 h later sin(30/48 pi) = 0.92 of it and 0.38 of the next.
        self.assertGreater(np.corrcoef(now, there)[0, 1], 0.85)
        self.assertLess(np.corrcoef(now, here)[0, 1], np.corrcoef(now, there)[0, 1] - 0.1)

    def test_towers_stand_only_where_convection_is_active(self):
        convection = SMALL.humidity.sources.convection
        lat, lon = np.linspace(-85.0, 85.0, 120)[:, None], np.arange(0.0, 360.0, 1.5)[None, :]
        active, deep = convection(lat, lon, 3.6e4), convection.deep(lat, lon, 3.6e4)
        self.assertEqual(deep[active == 0.0].max(), 0.0)
        self.assertTrue(0.01 < np.mean(deep > 0.3) < 0.5 * np.mean(active > 0.05))

    def test_same_seed_same_bytes(self):
        again = Atmosphere(48, 25).step(0.0)
        other = Atmosphere(48, 25, seed=7).step(0.0)
        for name in FIRST:
            self.assertEqual(FIRST[name].tobytes(), again[name].tobytes(), name)
        self.assertGreater(rms(other["clt"] - FIRST["clt"]), 0.05)

    def test_time_off_the_trajectories_grid_is_refused(self):
        with self.assertRaisesRegex(ValueError, "multiple of 3 hours"):
            SMALL.step(3600.0)


class Sphere(unittest.TestCase):
    def test_the_filter_is_alike_everywhere(self):
        """cos(lat) cos(lon) is one shape on the sphere, poles included: the filter must only scale it."""
        lat, lon = SMALL.grid.lat, SMALL.grid.lon
        field = unit_vectors(lat[:, None], lon[None, :])[..., 0]
        weaker = 0.5 + 0.5 * np.cos(np.radians(180.0 / 25))
        np.testing.assert_allclose(smooth(field, lat), weaker * field, atol=1e-12)
        np.testing.assert_allclose(smooth(np.ones_like(field), lat), 1.0, rtol=1e-12)

    def test_the_filter_stops_the_two_grid_wave(self):
        lat = SMALL.grid.lat
        rows = np.where(np.arange(25) % 2, 1.0, -1.0)[:, None] * np.ones(48)
        self.assertLess(np.abs(smooth(rows, lat)[1:-1]).max(), 1e-12)
        columns = np.where(np.arange(48) % 2, 1.0, -1.0) * np.ones((25, 1))
        self.assertLess(np.abs(smooth(columns, lat)).max(), 0.12)

    def test_random_waves_have_variance_one_at_poles_and_equator(self):
        values = np.array([[RandomWaves(np.random.default_rng(s), 4, 20)(unit_vectors(lat, 10.0))
                            for lat in (-90.0, 0.0, 55.0, 90.0)] for s in range(400)])
        np.testing.assert_allclose(values.var(axis=0), 1.0, atol=0.25)  # 3.5 standard errors
        np.testing.assert_allclose(values.mean(axis=0), 0.0, atol=0.2)


    def test_a_coarse_grids_noise_is_a_part_of_the_fine_ones(self):
        fine = RandomWaves(np.random.default_rng(3), 12, 80, slope=0.0, count=300)
        coarse = RandomWaves(np.random.default_rng(3), 12, 80, slope=0.0, count=300, finest=30.0)
        rng = np.random.default_rng(5)
        place = unit_vectors(np.degrees(np.arcsin(rng.uniform(-1.0, 1.0, 20000))), rng.uniform(0.0, 360.0, 20000))
        whole, part = fine(place), coarse(place)
        # Equal variance for equal log(degree): between 21 and 30 the weight falls from 1 to 0.
        expected = np.log(80.0 / 25.0) / np.log(80.0 / 12.0)
        self.assertAlmostEqual(coarse.lost, expected, delta=0.05)
        self.assertAlmostEqual(np.var(part), 1.0 - coarse.lost, delta=0.05)
        self.assertEqual(fine.lost, 0.0)
        # What it keeps is in step with the whole: the covariance is between the weights' squares and the weights.
        self.assertTrue(np.var(part) < np.mean(whole * part) < np.var(part) + 0.1)


class CommittedFile(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.file = netCDF4.Dataset(SAMPLE)
        cls.addClassCleanup(cls.file.close)

    def test_is_what_the_generator_makes(self):
        """To one packing step, and one rounding step: another machine's sines may differ in the last bit."""
        atmosphere = Atmosphere()
        for index in (0, 3):
            fields = atmosphere.step(3600.0 * float(self.file["time"][index]))
            for name, (_, _, packing, bits) in FIELDS.items():
                stored = np.asarray(self.file[name][index])
                tolerance = packing[0] if packing else 2.0**-bits * np.abs(fields[name]) + 1e-9
                self.assertLessEqual(np.max(np.abs(stored - fields[name]) - tolerance), 0.0, name)
            for name, (_, _, packing) in SURFACE_FIELDS.items():
                self.assertLessEqual(np.max(np.abs(self.file[name][index] - fields[name])), packing[0], name)

    def test_shape_size_and_honesty(self):
        self.assertEqual(self.file["cl"].shape, (4, 19, 64, 128))
        self.assertLess(SAMPLE.stat().st_size, 4_000_000)
        self.assertIn("not a forecast, not a reanalysis", self.file.comment)
        self.assertEqual(self.file.Conventions, "CF-1.8")

    def test_vertical_coordinate_is_complete(self):
        for name in ("lev", "lev_bnds"):
            terms = self.file[name].formula_terms.split()
            self.assertEqual(terms[::2], ["a:", "b:", "p0:", "ps:"])
            a, b, p0, ps = (self.file[t] for t in terms[1::2])
            np.testing.assert_allclose(self.file[name][...], a[...] + b[...], rtol=1e-12)
            self.assertEqual((float(p0[...]), p0.units, ps.units), (1.0e5, "Pa", "Pa"))
        half = self.file["lev_bnds"][...]
        np.testing.assert_array_equal(half[1:, 0], half[:-1, 1])
        self.assertEqual((half[0, 0], half[-1, 1], self.file["lev"].positive), (0.0, 1.0, "down"))

    def test_looks_like_the_earth_from_far(self):
        """Total cover 38 %, give or take 5; a fifth or so of the points above 15 %; storm tracks above the subtropics."""
        weight = np.cos(np.radians(self.file["lat"][...]))
        zonal = np.asarray(self.file["clt"][...]).mean(axis=(0, 2))
        lat = np.asarray(self.file["lat"][...])
        self.assertTrue(0.33 < np.average(zonal, weights=weight) < 0.43)
        self.assertTrue(0.17 < np.mean(np.asarray(self.file["cl"][...]) > 0.15) < 0.21)
        subtropics, storms = np.abs(np.abs(lat) - 22.0) < 6.0, np.abs(np.abs(lat) - 53.0) < 8.0
        self.assertGreater(zonal[storms].min(), zonal[subtropics].max())
        self.assertGreater(zonal[np.abs(lat - 6.0) < 3.0].min(), zonal[subtropics].max())


class FineFile(unittest.TestCase):
    """The first step's clouds on the grid of Max 1994: 1.125 degrees, 19 levels."""

    @classmethod
    def setUpClass(cls):
        cls.file, cls.coarse = netCDF4.Dataset(FINE), netCDF4.Dataset(SAMPLE)
        cls.addClassCleanup(cls.file.close)
        cls.addClassCleanup(cls.coarse.close)

    def test_shape_size_and_honesty(self):
        self.assertEqual(self.file["cl"].shape, (1, 19, 160, 320))
        self.assertLess(FINE.stat().st_size, 1_000_000)
        self.assertIn("not a forecast, not a reanalysis", self.file.comment)
        self.assertEqual(self.file["lev"].formula_terms, self.coarse["lev"].formula_terms)

    def test_is_the_same_weather_in_finer_strokes(self):
        """Means over 5 x 5 boxes of one and 2 x 2 of the other: alike, and the fine file has shorter edges."""
        fine, coarse = (np.asarray(f["cl"][0]) for f in (self.file, self.coarse))
        # The coarse grid's points stand half a box off: from the centre of the first box, at longitude 0.
        blocks = np.roll(fine, 2, axis=2).reshape(19, 32, 5, 64, 5).mean(axis=(2, 4))
        halves = 0.25 * np.roll(coarse, 1, axis=2) + 0.5 * coarse + 0.25 * np.roll(coarse, -1, axis=2)
        halves = halves[:, :, ::2].reshape(19, 32, 2, 64).mean(axis=2)
        self.assertGreater(np.corrcoef(blocks.ravel(), halves.ravel())[0, 1], 0.9)
        self.assertAlmostEqual(blocks.mean(), halves.mean(), delta=0.03)
        steepest = [np.quantile(np.abs(np.diff(f, axis=2)) / step, 0.99) for f, step in ((fine, 1.125), (coarse, 2.8125))]
        self.assertGreater(steepest[0], 1.2 * steepest[1])


class Program(unittest.TestCase):
    def run_script(self, *arguments):
        return subprocess.run([sys.executable, "-B", SCRIPT, *arguments], capture_output=True, text=True, check=False)

    def test_writes_any_resolution(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "tiny.nc"
            done = self.run_script("--nlon", "17", "--nlat", "9", "--steps", "2", "--hours", "3", "-o", str(path))
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
            self.assertEqual([p.name for p in path.parent.iterdir()], ["tiny.nc"])
            with netCDF4.Dataset(path) as file:
                self.assertEqual(file["cl"].shape, (2, 19, 9, 17))
                np.testing.assert_array_equal(file["time"][...], [0.0, 3.0])

    def test_wrong_use_is_refused(self):
        for arguments, message in ((("--hours", "4"), "multiple of 3"), (("--nlon", "2"), "at least 16"),
                                   (("--seed", "-1"), "must not be negative")):
            done = self.run_script(*arguments)
            self.assertEqual(done.returncode, 2)
            self.assertIn(message, done.stderr)

    def test_a_folder_that_is_not_there(self):
        done = self.run_script("--nlon", "16", "--nlat", "8", "--steps", "1", "-o", "/nowhere/at/all.nc")
        self.assertEqual(done.returncode, 1)
        self.assertIn("cannot write /nowhere/at/all.nc", done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1)


if __name__ == "__main__":
    unittest.main()
