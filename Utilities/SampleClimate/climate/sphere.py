# SPDX-License-Identifier: BSD-3-Clause
"""The sphere: constants, the horizontal grid, random waves without poles, and an isotropic filter."""
import numpy as np

RADIUS = 6.371e6  # Earth's radius, m
ROTATION = 7.292e-5  # Earth's angular velocity, 1/s
GRAVITY = 9.80665  # m/s2
R_DRY = 287.05  # gas constant of dry air, J/(kg K)
KAPPA = 2.0 / 7.0  # R/cp
HOUR = 3600.0


class Grid:
    """Cell centres and bounds of a regular grid, in degrees; longitude from 0, latitude northward."""

    def __init__(self, nlon, nlat):
        self.nlon, self.nlat = nlon, nlat
        self.lon_edges = np.linspace(0.0, 360.0, nlon + 1) - 180.0 / nlon
        self.lat_edges = np.linspace(-90.0, 90.0, nlat + 1)
        self.lon = np.arange(nlon) * (360.0 / nlon)
        self.lat = 0.5 * (self.lat_edges[:-1] + self.lat_edges[1:])
        # The share of each latitude row in the sphere's area; sums to 1 over rows.
        self.area = 0.5 * np.diff(np.sin(np.radians(self.lat_edges)))


def unit_vectors(lat, lon):
    """Positions on the unit sphere from degrees; broadcasts; the last axis has x, y, z."""
    lat, lon = np.broadcast_arrays(np.radians(lat), np.radians(lon))
    return np.stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)], axis=-1)


def smoothstep(low, high, x):
    """0 below low, 1 above high, and the cubic with level ends between."""
    s = np.clip((x - low) / (high - low), 0.0, 1.0)
    return s * s * (3.0 - 2.0 * s)


def bump(lat, lon, lat0, lon0, width_lat, width_lon, turn=0.0):
    """An elliptic Gaussian of peak 1. Widths are standard deviations in degrees of arc; `turn` turns the
    ellipse anticlockwise, in degrees."""
    east = (np.mod(lon - lon0 + 180.0, 360.0) - 180.0) * np.cos(np.radians(0.5 * (lat + lat0)))
    north = lat - lat0
    c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    along, across = c * east + s * north, c * north - s * east
    return np.exp(-0.5 * ((along / width_lon) ** 2 + (across / width_lat) ** 2))


class RandomWaves:
    """Gaussian-like noise of variance 1 on the sphere: a sum of plane waves in space, met by the unit sphere.

    Isotropic, so that nothing marks the poles or the seam. The degree l of a wave is spread evenly in
    log(l) over [low, high] with amplitude l**slope; `vertical` is the spread of wavenumbers in the
    vertical coordinate, `period` (s) the shortest period with which a phase drifts. Waves fade out towards the degree
    `finest`: what is left is the same noise, as a coarser grid can hold it; `lost` is the variance that went.
    """

    def __init__(self, rng, low, high, slope=-1.0 / 3.0, count=160, vertical=0.0, period=None, finest=np.inf):
        degree = low * (high / low) ** ((np.arange(count) + rng.random(count)) / count)
        direction = rng.normal(size=(count, 3))
        direction /= np.linalg.norm(direction, axis=1, keepdims=True)
        # A wave meets the sphere at every angle: the mean tangential wavenumber is pi/4 of the whole.
        self.wavevector = (direction * degree[:, None] * 4.0 / np.pi).astype(np.float32)
        self.vertical = (vertical * rng.normal(size=count)).astype(np.float32)
        self.phase = 2.0 * np.pi * rng.random(count)
        self.drift = rng.uniform(-1.0, 1.0, count) * (2.0 * np.pi / period if period else 0.0)
        amplitude = degree**slope
        amplitude *= np.sqrt(2.0 / np.sum(amplitude**2))
        self.lost = 0.0
        if np.isfinite(finest):
            amplitude *= smoothstep(finest, 0.7 * finest, degree)
            self.lost = 1.0 - 0.5 * float(np.sum(amplitude**2))
        kept = amplitude > 0.0
        self.wavevector, self.vertical = self.wavevector[kept], self.vertical[kept]
        self.phase, self.drift = self.phase[kept], self.drift[kept]
        self.amplitude = amplitude[kept].astype(np.float32)

    def __call__(self, position, height=0.0, time=0.0):
        position = position.astype(np.float32)
        height = np.asarray(height, np.float32)
        total = np.zeros(np.broadcast_shapes(position.shape[:-1], height.shape), np.float32)
        x, y, z = (position[..., i].copy() for i in range(3))
        phase = np.mod(self.phase + self.drift * time, 2.0 * np.pi).astype(np.float32)
        for k, m, p, a in zip(self.wavevector, self.vertical, phase, self.amplitude):
            total += a * np.cos(k[0] * x + k[1] * y + k[2] * z + m * height + p)
        return total


def over_the_poles(field):
    """One row more at each end of the latitude axis (-2): the opposite meridian's, turned by half a circle."""
    m = np.arange(field.shape[-1] // 2 + 1)

    def turned(row):
        return np.fft.irfft(np.fft.rfft(row) * (-1.0) ** m, n=field.shape[-1])

    first, last = turned(field[..., :1, :]), turned(field[..., -1:, :])
    return np.concatenate([first, field, last], axis=-2)


def smooth(field, lat, passes=1):
    """A low-pass filter of about the same width in every direction on (..., lat, lon).

    Northward each pass is the weights 1/4, 1/2, 1/4, a Gaussian of variance dlat**2/2; eastward the Gaussian of
    that variance in degrees of arc, applied to the row's Fourier series; m(m-1) in place of m**2 lets a field that is
    linear across a pole pass. Of the two-grid wave it leaves nothing northward and a tenth eastward.
    """
    dlat = np.radians(180.0 / field.shape[-2])
    m = np.arange(field.shape[-1] // 2 + 1)
    arc = dlat / np.cos(np.radians(lat))[:, None]
    response = np.exp(-0.25 * passes * m * (m - 1.0) * arc**2)
    for _ in range(passes):
        wide = over_the_poles(field)
        field = 0.25 * (wide[..., :-2, :] + wide[..., 2:, :]) + 0.5 * field
    return np.fft.irfft(np.fft.rfft(field) * response, n=field.shape[-1])
