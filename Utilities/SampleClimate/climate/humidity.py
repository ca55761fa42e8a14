# SPDX-License-Identifier: BSD-3-Clause
"""Humidity by advection and condensation along two days of trajectories.

Every point of every level is followed back through the wind for 48 hours. The parcel starts with the
climatological humidity of where it came from, is moistened on its way by the boundary layer and by deep
convection, and loses what exceeds saturation. So air that rises ahead of a cyclone becomes its comma-shaped cloud, and sinking
air the dry slot and the clear subtropics (the advection-condensation model: Pierrehumbert, Brogniez and
Roca 2007, The relative humidity of the atmosphere). Irregularity comes from random waves that drift with the
parcels: each is laid down at a multiple of 24 hours, grows for a day and fades for another. All of it is defined without a
grid; a grid leaves out the waves that are too short for it.
"""
import numpy as np

from .balance import P0, gaussian
from .clouds import saturation_humidity
from .sphere import HOUR, RADIUS, RandomWaves, bump, smoothstep, unit_vectors

STEP = 3.0 * HOUR  # of a trajectory
MEMORY = 48.0 * HOUR  # length of a trajectory
WETTEST = 0.94  # rain leaves a grid box this near to saturation
ANCHOR = 24.0 * HOUR  # between the noises


class Overturning:
    """The zonal-mean Hadley cells: ascent at 7 N, descent in the subtropics; not part of the balanced flow."""

    def __init__(self):
        self.lat = np.linspace(-90.0, 90.0, 1801)
        weight = np.cos(np.radians(self.lat))
        rise = gaussian(self.lat, 7.0, 5.5)
        sink = 0.8 * gaussian(self.lat, 27.0, 7.5) + gaussian(self.lat, -22.0, 9.0)
        self.rise = 0.055 * rise
        self.sink = -0.055 * sink * np.sum(rise * weight) / np.sum(sink * weight)
        flux = np.cumsum((self.rise + self.sink) * weight) * np.radians(0.1) * RADIUS
        self.flux = flux / weight.clip(1e-3) * (np.abs(self.lat) < 80.0)

    def omega(self, lat, pressure, activity):
        """dp/dt (Pa/s): the rising part gathered where convection is active, the zonal mean untouched.

        `activity` is Convection's on (lat, lon)."""
        s = np.clip((pressure - 1.1e4) / 8.7e4, 0.0, 1.0)
        mean = np.mean(activity, axis=-1, keepdims=True)
        gathered = 1.7 * (activity + 0.08) / (mean + 0.08) - 0.7
        lift = np.interp(lat, self.lat, self.sink) + np.interp(lat, self.lat, self.rise) * gathered
        return -lift * np.sin(np.pi * s)

    def northward(self, lat, pressure):
        """By continuity: d(v cos phi)/(a cos phi dphi) = -domega/dp."""
        s = np.clip((pressure - 1.1e4) / 8.7e4, 0.0, 1.0)
        inside = (s > 0.0) & (s < 1.0)
        return np.interp(lat, self.lat, self.flux) * np.pi / 8.7e4 * np.cos(np.pi * s) * inside


class Convection:
    """Deep convection's activity, 0 to 1, in drifting clusters along the convergence zones."""

    def __init__(self, rng, terrain, finest):
        self.terrain = terrain
        self.clusters = RandomWaves(rng, 9, 34, slope=-0.2, count=140, period=60.0 * HOUR)
        self.towers = RandomWaves(rng, 24, 90, slope=-0.1, count=200, period=30.0 * HOUR, finest=finest)
        self.meander = RandomWaves(rng, 4, 12, count=60)
        self.envelope = RandomWaves(rng, 2, 7, count=60, period=200.0 * HOUR)

    def zones(self, lat, lon):
        wave = np.radians(lon)
        axis = 6.5 + 2.5 * np.sin(wave + 1.0) + 1.5 * np.sin(3.0 * wave + 0.4)
        axis = axis + 2.2 * self.meander(unit_vectors(lat, lon))
        band = 0.95 * np.exp(-0.5 * ((lat - axis) / 3.0) ** 2)
        pool = 0.62 * bump(lat, lon, 1, 120, 8, 32) + 0.7 * bump(lat, lon, -3, -60, 8, 11)
        pool = pool + 0.7 * bump(lat, lon, 2, 20, 8, 12) + 0.75 * bump(lat, lon, -14, -170, 5, 24, -28)
        pool = pool + 0.55 * bump(lat, lon, -16, -42, 4, 15, -35) + 0.35 * bump(lat, lon, 14, 95, 6, 14)
        return np.maximum(band, pool) + 0.25 * np.minimum(band, pool)

    def __call__(self, lat, lon, time):
        west = np.degrees(6.0 * time / RADIUS)  # easterly waves, 6 m/s
        noise = 0.85 * self.clusters(unit_vectors(lat, lon + west), time=time)
        noise = noise + 0.6 * self.envelope(unit_vectors(lat, lon - 0.8 * west), time=time)
        zone = self.zones(lat, lon)
        return smoothstep(0.1, 0.8, 0.6 * zone + 0.75 * noise * np.sqrt(zone) - 0.36)

    def deep(self, lat, lon, time):
        """The share of a grid box under towers, 0 to 1: small and ragged within the active clusters."""
        west = np.degrees(6.0 * time / RADIUS)
        noise = self.towers(unit_vectors(lat, lon + west), time=time)
        activity = self(lat, lon, time)
        return smoothstep(0.0, 0.3, activity) * smoothstep(0.4, 1.0, activity + 0.6 * noise - 0.2)


# Cold upwelling off west coasts: latitude, longitude, widths (degrees of arc), strength.
DECKS = [(27, -128, 7, 11, 1.0), (-19, -84, 8, 11, 1.1), (-16, 3, 8, 9, 1.1), (24, -24, 6, 9, 0.8),
         (-28, 103, 6, 9, 0.85), (-33, -100, 7, 18, 0.6), (-32, -5, 6, 12, 0.6), (37, -150, 6, 15, 0.5)]
DESERTS = [(23, 12, 7, 24, 1.0), (26, 47, 7, 10, 1.0), (-25, 131, 7, 13, 0.9), (40, 62, 6, 13, 0.6), (-24, 19, 6, 6, 0.8),
           (31, -110, 6, 7, 0.8), (-24, -69, 6, 4, 0.9), (40, 95, 5, 13, 0.7)]


class Sources:
    """Where the air takes up water: rates (1/s) towards target relative humidities."""

    def __init__(self, rng, terrain, finest):
        self.terrain = terrain
        self.convection = Convection(rng, terrain, finest)

    def decks(self, lat, lon):
        ocean = 1.0 - self.terrain.land(lat, lon)
        return ocean * sum(s * bump(lat, lon, y, x, wy, wx) for y, x, wy, wx, s in DECKS)

    def deserts(self, lat, lon):
        return np.minimum(sum(s * bump(lat, lon, y, x, wy, wx) for y, x, wy, wx, s in DESERTS), 1.0)

    def __call__(self, lat, lon, z, time):
        """(rate, rate * target) on (z, lat, lon)."""
        activity = self.convection(lat, lon, time)
        desert = self.deserts(lat, lon)
        storm = smoothstep(30.0, 50.0, np.abs(lat))
        depth = 0.13 + 0.07 * storm + 0.04 * activity
        near = smoothstep(1.6, 0.6, z / depth)
        near_rate = near / (10.0 * HOUR)
        near_target = 0.78 + 0.01 * storm - 0.45 * desert - 0.06 * self.terrain.land(lat, lon)
        tower = smoothstep(0.0, 0.15, z) * smoothstep(2.15, 1.75, z)
        tower_rate = activity * tower / (7.0 * HOUR)
        tower_target = 0.62 + 0.26 * np.exp(-0.5 * ((z - 1.45) / 0.3) ** 2) + 0.06 * np.exp(-0.5 * ((z - 0.2) / 0.15) ** 2)
        slow = 1.0 / (54.0 * HOUR)
        rate = near_rate + tower_rate + slow
        return rate, near_rate * near_target + tower_rate * tower_target + slow * climatology(lat, z, desert)


def climatology(lat, z, desert):
    """A first guess of relative humidity: moist storm tracks and Equator, dry subtropics, drier upward."""
    moist = 0.12 * np.exp(-0.5 * ((lat - 5.0) / 11.0) ** 2)
    moist = moist + 0.45 * smoothstep(20.0, 46.0, np.abs(lat)) - 0.20 * smoothstep(58.0, 75.0, np.abs(lat))
    moist = moist + 0.22 * np.exp(-0.5 * ((z - 1.55) / 0.3) ** 2) * np.exp(-0.5 * ((lat - 4.0) / 16.0) ** 2)
    low = np.exp(-np.maximum(z, 0.0) / 0.25)
    return np.clip((0.30 + moist) * (1.0 - 0.25 * desert) + 0.30 * low * (1.0 - desert), 0.05, 0.92)


class Air:
    """The wind and the sources on a coarse grid of their own at one time, for trajectories to look up."""

    lat = np.linspace(-90.0, 90.0, 73)
    lon = np.arange(145) * 2.5
    z = np.linspace(-0.10, 2.90, 25)

    def __init__(self, flow, overturning, sources, terrain, time):
        z = self.z[:, None, None]
        pressure = P0 * np.exp(-z)
        columns = flow.columns(self.lat, self.lon, time)
        lat, lon = self.lat[:, None], self.lon[None, :]
        east, north = columns.wind(z)
        north = north + overturning.northward(lat, pressure)
        activity = sources.convection(lat, lon, time)
        climb = columns.ascent(z) - overturning.omega(lat, pressure, activity) / pressure
        climb = climb + upslope(columns, terrain, self.lat, self.lon, z, east, north)
        position = unit_vectors(lat, lon)
        a, b = np.radians(lat), np.radians(lon)
        self.motion = np.stack([
            (-east * np.sin(b) - north * np.sin(a) * np.cos(b)) / RADIUS,
            (east * np.cos(b) - north * np.sin(a) * np.sin(b)) / RADIUS,
            north * np.cos(a) / RADIUS + 0.0 * position[..., 2], climb], axis=-1).astype(np.float32)
        temperature = columns.virtual_temperature(z)
        rate, gain = sources(lat, lon, z, time)
        saturation = np.log(saturation_humidity(temperature, pressure))
        self.water = np.stack(np.broadcast_arrays(rate * HOUR, gain * HOUR, saturation), axis=-1).astype(np.float32)

    def look_up(self, table, position, height):
        """Trilinear interpolation of `table` at unit vectors and Z."""
        lat = np.degrees(np.arcsin(np.clip(position[:, 2], -1.0, 1.0)))
        lon = np.mod(np.degrees(np.arctan2(position[:, 1], position[:, 0])), 360.0)
        nz, ny, nx, parts = table.shape
        x = np.clip(lon / 2.5, 0.0, nx - 1.001)
        y = np.clip((lat + 90.0) / 2.5, 0.0, ny - 1.001)
        k = np.clip((height - self.z[0]) / (self.z[1] - self.z[0]), 0.0, nz - 1.001).astype(np.float32)
        i, j, l = x.astype(np.int32), y.astype(np.int32), k.astype(np.int32)
        x, y, k = (x - i)[:, None], (y - j)[:, None], (k - l)[:, None]
        flat, corner = table.reshape(-1, parts), (l * ny + j) * nx + i
        def row(c):
            return flat[c] * (1 - x) + flat[c + 1] * x
        def plane(c):
            return row(c) * (1 - y) + row(c + nx) * y
        return plane(corner) * (1 - k) + plane(corner + nx * ny) * k


def upslope(columns, terrain, lat, lon, z, east, north):
    """dZ/dt (1/s) of air that is driven over mountains, fading with height above 700 hPa."""
    y, x, step = lat[:, None], lon[None, :], 0.5
    slope_x = (terrain.altitude(y, x + step) - terrain.altitude(y, x - step)) / np.radians(2 * step)
    slope_y = terrain.altitude(np.minimum(y + step, 90), x) - terrain.altitude(np.maximum(y - step, -90), x)
    slope_y = slope_y / np.radians(2 * step)
    cosine = np.maximum(np.cos(np.radians(y)), 0.1)
    rise = (east * slope_x / cosine + north * slope_y) / RADIUS
    return np.clip(rise, -0.02, 0.02) / 8000.0 * np.exp(-((z / 0.9) ** 2)) * smoothstep(85.0, 70.0, np.abs(y))


class Humidity:
    """Relative humidity at any points and times."""

    def __init__(self, rng, flow, terrain, finest):
        self.flow, self.terrain = flow, terrain
        self.overturning = Overturning()
        self.sources = Sources(rng, terrain, finest)
        self.texture_seed = rng.integers(2**31)
        self.finest = finest
        self.airs, self.textures = {}, {}

    def air(self, slot):
        if slot not in self.airs:
            self.airs[slot] = Air(self.flow, self.overturning, self.sources, self.terrain, slot * STEP)
        return self.airs[slot]

    def texture(self, anchor):
        """The noise that was laid down at time anchor * 24 h."""
        if anchor not in self.textures:
            rng = np.random.default_rng([int(self.texture_seed), anchor + 1000])
            self.textures[anchor] = RandomWaves(rng, 10, 150, slope=0.0, count=300, vertical=3.0, finest=self.finest)
        return self.textures[anchor]

    def history(self, position, height, slot):
        """Positions and Z of the parcels, from now back to 48 hours ago, by the midpoint rule."""
        path = [(position, height)]
        for back in range(int(MEMORY / STEP)):
            here = self.air(slot - back)
            rate = here.look_up(here.motion, position, height)
            middle = position - 0.5 * STEP * rate[:, :3]
            rate = here.look_up(here.motion, normalised(middle), height - 0.5 * STEP * rate[:, 3])
            position = normalised(position - STEP * rate[:, :3])
            height = np.clip(height - STEP * rate[:, 3], -0.08, 2.9)
            path.append((position, height))
        return path

    def __call__(self, position, height, slot):
        """Relative humidity of the points (n, 3), Z (n,) at time slot * 3 h, and the texture that drifted there."""
        path = self.history(position.astype(np.float32), height.astype(np.float32), slot)
        humidity = texture = None
        for back in range(len(path) - 1, -1, -1):
            here, (p, z) = self.air(slot - back), path[back]
            rate, gain, saturation = np.ascontiguousarray(here.look_up(here.water, p, z).T)
            saturation = np.exp(saturation)
            target = gain / rate * saturation
            if humidity is None:
                humidity = target
            humidity = target + (humidity - target) * np.exp(-rate * (STEP / HOUR))
            humidity = np.minimum(humidity, WETTEST * saturation)
            age = back * STEP
            if np.mod((slot - back) * STEP, ANCHOR) == 0.0 and 0 < age < MEMORY:
                part = self.texture(int((slot - back) * STEP / ANCHOR))(p, z)
                texture = (0.0 if texture is None else texture) + np.sin(np.pi * age / MEMORY) * part
        return humidity / saturation, texture


def normalised(position):
    return position / np.sqrt(np.sum(position * position, axis=1, keepdims=True))
