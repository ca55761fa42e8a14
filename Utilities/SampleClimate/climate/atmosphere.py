# SPDX-License-Identifier: BSD-3-Clause
"""The sample atmosphere: balanced flow and humidity sampled on hybrid levels over terrain."""
import numpy as np

from .balance import P0, Flow
from .clouds import (VIRTUAL, cloud_fraction, condensate, critical_humidity, saturation_humidity, total_cover)
from .humidity import STEP, Humidity, upslope
from .sphere import GRAVITY, Grid, smooth, smoothstep, unit_vectors
from .terrain import Terrain

# The 19 hybrid levels of the ECMWF model and of ECHAM (Roeckner et al. 1992): half levels from the top, a in Pa and b.
HALF_A = np.array([
    0.0, 2000.0, 4000.0, 6046.110595, 8267.927560, 10609.513232, 12851.100169, 14698.498086, 15861.125180, 16116.236610,
    15356.924115, 13621.460403, 11101.561987, 8127.144155, 5125.141747, 2549.969411, 783.195032, 0.0, 0.0, 0.0]) / P0
HALF_B = np.array([
    0.0, 0.0, 0.0, 0.000338993, 0.003357187, 0.013070044, 0.034077148, 0.070649633, 0.125916604, 0.201195432,
    0.295519487, 0.405408, 0.524931, 0.646107, 0.759697, 0.856437, 0.928746, 0.972985, 0.992281, 1.0])
FULL_A = 0.5 * (HALF_A[1:] + HALF_A[:-1])
FULL_B = 0.5 * (HALF_B[1:] + HALF_B[:-1])
TOP = 2.7  # Z above which there is no weather (67 hPa)
STRATOSPHERE = 3.0e-6  # its specific humidity, kg/kg


class Atmosphere:
    """Samples the made-up atmosphere on a grid; `step(time)` returns a dictionary of arrays in SI units."""

    def __init__(self, nlon=128, nlat=64, seed=6):
        rng = np.random.default_rng(seed)
        self.grid = Grid(nlon, nlat)
        self.terrain = Terrain(rng)
        self.flow = Flow(rng)
        self.humidity = Humidity(rng, self.flow, self.terrain, finest=0.75 * min(nlon / 2.0, nlat))
        lat, lon = self.grid.lat[:, None], self.grid.lon[None, :]
        self.land = self.terrain.land(lat, lon)
        self.altitude = smooth(self.terrain.altitude(lat, lon), self.grid.lat)
        self.position = unit_vectors(lat, lon)
        self.critical = critical_humidity(FULL_A + FULL_B, self.humidity.texture(0).lost)

    def step(self, seconds):
        """The atmosphere `seconds` (a multiple of 3 hours) after its start."""
        if seconds % STEP:
            raise ValueError("time must be a multiple of 3 hours")
        columns = self.flow.columns(self.grid.lat, self.grid.lon, seconds)
        ground = columns.surface(self.altitude)
        surface_pressure = P0 * np.exp(-ground)
        pressure = FULL_A[:, None, None] * P0 + FULL_B[:, None, None] * surface_pressure
        z = -np.log(pressure / P0)
        virtual = columns.virtual_temperature(z)
        relative = self.relative_humidity(z, ground, seconds)
        temperature, humidity, relative = moist_temperature(virtual, relative, pressure, z)
        fraction = cloud_fraction(relative, self.critical[:, None, None])
        liquid, ice = condensate(fraction, temperature, saturation_humidity(temperature, pressure))
        east, north, omega = self.motion(columns, z, pressure, seconds)
        return dict(ps=surface_pressure, pressure=pressure, ta=temperature, hus=humidity, ua=east, va=north, wap=omega,
                    zg=columns.geopotential(z) / GRAVITY, cl=fraction, clw=liquid, cli=ice, clt=total_cover(fraction),
                    relative_humidity=relative)

    def motion(self, columns, z, pressure, seconds):
        """The balanced wind with the Hadley cells added, and dp/dt (Pa/s)."""
        lat = self.grid.lat[:, None]
        over = self.humidity.overturning
        east, north = columns.wind(z)
        north = north + over.northward(lat, pressure)
        climb = columns.ascent(z) + upslope(columns, self.terrain, self.grid.lat, self.grid.lon, z, east, north)
        activity = self.humidity.sources.convection(lat, self.grid.lon[None, :], seconds)
        return east, north, smooth(over.omega(lat, pressure, activity) - pressure * climb, self.grid.lat)

    def relative_humidity(self, z, ground, seconds):
        """Trajectories, then irregularity, low cloud under inversions, and the filter."""
        slot = int(seconds // STEP)
        deep = self.humidity.sources.convection.deep(self.grid.lat[:, None], self.grid.lon[None, :], seconds)
        found, texture = np.zeros(z.shape, np.float32), np.zeros(z.shape, np.float32)
        for k in np.flatnonzero(z.min(axis=(1, 2)) < TOP):  # one level at a time bounds the memory
            pair = self.humidity(self.position.reshape(-1, 3), z[k].ravel(), slot)
            found[k], texture[k] = (values.reshape(z[k].shape) for values in pair)
        for _ in range(3):
            found[1:-1] = 0.25 * (found[:-2] + found[2:]) + 0.5 * found[1:-1]
        result = found + self.irregularity(z) * texture
        result = result + deep * towering(z) * np.maximum(1.0 - result, 0.0)
        result = np.maximum(result, self.low_cloud(z, ground, texture))
        result = 0.74 + 1.5 * (smooth(result, self.grid.lat) - 0.74)  # contrast between cloud systems and clear sky
        # No hard edge at saturation: the approach to 1 is asymptotic, within 3 % or so.
        return np.maximum(1.0 - 0.03 * np.logaddexp(0.0, (1.0 - result) / 0.03), 0.01)

    def irregularity(self, z):
        """The standard deviation of the texture in relative humidity."""
        return 0.18 + 0.05 * smoothstep(0.1, 0.8, z)

    def low_cloud(self, z, ground, texture):
        """Relative humidity of stratocumulus and polar stratus, in thin layers below an inversion."""
        lat, lon = self.grid.lat[:, None], self.grid.lon[None, :]
        above = z - ground
        layer = np.exp(-0.5 * ((above - 0.10) / 0.06) ** 2)
        deck = self.humidity.sources.decks(lat, lon)
        polar = smoothstep(52.0, 68.0, np.abs(lat)) * (1.0 - 0.65 * self.land)
        marine = 0.5 * smoothstep(36.0, 50.0, np.abs(lat)) * (1.0 - self.land)
        amount = np.maximum(np.maximum(deck, 0.45 * polar), marine)
        amount = 0.70 + 0.17 * smoothstep(0.1, 0.75, amount) - 0.22 * self.land * (1.0 - polar)
        return layer * (amount + 0.16 * texture)


def towering(z):
    """How much of the column a deep tower fills: from its base, some 600 m up, to the tropical tropopause."""
    return smoothstep(0.02, 0.12, z) * smoothstep(2.0, 1.75, z)


def moist_temperature(virtual, relative, pressure, z):
    """Temperature and specific humidity that together have the given virtual temperature and relative humidity."""
    weather = smoothstep(TOP, TOP - 0.5, z)
    temperature = virtual
    for _ in range(6):
        saturation = saturation_humidity(temperature, pressure)
        humidity = weather * relative * saturation + (1.0 - weather) * np.minimum(STRATOSPHERE, 0.3 * saturation)
        temperature = virtual / (1.0 + VIRTUAL * humidity)
    return temperature, humidity, humidity / saturation_humidity(temperature, pressure)
