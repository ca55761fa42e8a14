# SPDX-License-Identifier: BSD-3-Clause
"""The balanced flow: jets in gradient-wind balance, and waves in geostrophic balance upon them.

Everything is an analytic function of latitude phi, longitude lambda, time t and Z = -ln(p/p0). The geopotential is

    Phi = Phi0(Z) - sum_i B_i(Z) a I_i(phi) - sum_ij B_i B_j J_ij(phi) + sum_g Re[H_g(lambda, phi, t) G_g(Z)]

with zonal winds U = sum_i A_i(phi) B_i(Z), I_i = int f A_i dphi, J_ij = int tan(phi) A_i A_j dphi (gradient-wind balance,
(f + U tan(phi)/a) U = -dPhi/(a dphi)). Virtual temperature follows from the hydrostatic equation,
R Tv = dPhi/dZ, so that thermal-wind balance is exact before the fields are sampled. The vertical motion
is the one that keeps potential temperature: dZ/dt = -(dT/dt + V.grad T) / (dT/dZ + kappa T).
Symbols after Holton, An Introduction to Dynamic Meteorology, 4th ed., chapter 3 and eq. 8.45.
"""
import numpy as np

from .sphere import GRAVITY, KAPPA, R_DRY, RADIUS, ROTATION, bump

P0 = 1.0e5  # reference pressure, Pa

# The Equator's virtual temperature (K) at Z.
TROPICAL_Z = [-1.0, 0.0, 0.10, 0.35, 0.69, 1.02, 1.61, 2.0, 2.3, 2.6, 3.0, 3.7, 4.6, 8.0]
TROPICAL_T = [330., 301.5, 296.5, 285., 268.5, 250., 220., 203., 197., 200., 208., 217., 229., 255.]


def gaussian(phi, centre, width):
    """exp(-((phi - centre)/width)**2 / 2), degrees."""
    return np.exp(-0.5 * ((phi - centre) / width) ** 2)


class Profile:
    """A function of Z, real or complex, with the first and second derivatives by central differences."""

    def __init__(self, function):
        self.function = function

    def __call__(self, z, order=0, step=1e-3):
        f = self.function
        if order == 0:
            return f(z)
        if order == 1:
            return (f(z + step) - f(z - step)) / (2.0 * step)
        return (f(z + step) - 2.0 * f(z) + f(z - step)) / step**2


class TropicalColumn:
    """Phi0 and its derivatives: the table above, made smooth, and its integral; Phi0(0) lifts 1011 hPa to 0 m."""

    def __init__(self):
        self.z = np.linspace(-0.4, 7.0, 7401)
        kernel = gaussian(np.arange(-480, 481) * 1e-3, 0.0, 0.13)
        wide = np.arange(-480, self.z.size + 480) * 1e-3 + self.z[0]
        raw = np.interp(wide, TROPICAL_Z, TROPICAL_T)
        self.t = np.convolve(raw, kernel / kernel.sum(), "valid")
        steps = 0.5 * (self.t[1:] + self.t[:-1]) * 1e-3 * R_DRY
        self.phi = np.concatenate([[0.0], np.cumsum(steps)])
        self.phi += 0.011 * R_DRY * 300.0 - np.interp(0.0, self.z, self.phi)
        self.slope = np.gradient(self.t, 1e-3)

    def __call__(self, z, order=0):
        if order == 0:  # the table is linear in T within a step: integrate that
            low = np.clip(((z - self.z[0]) * 1e3).astype(int), 0, self.z.size - 2)
            d = z - self.z[low]
            return self.phi[low] + R_DRY * d * (self.t[low] + 0.5 * d * self.slope[low])
        table = self.t if order == 1 else self.slope
        return R_DRY * np.interp(z, self.z, table)


def jet_shapes(lat):
    """The zonal winds' A_i (m/s) at latitudes in degrees: the jets, then the winds near the ground."""
    taper = np.cos(np.radians(lat)) / np.cos(np.radians(45.0))
    jets = 31.0 * gaussian(lat, 40.0, 13.0) + 35.0 * gaussian(lat, -44.0, 14.0)
    ground = (5.0 * gaussian(lat, 49.0, 9.0) + 9.0 * gaussian(lat, -50.0, 9.0) - 6.5 * gaussian(lat, 14.0, 9.0)
              - 6.5 * gaussian(lat, -13.0, 9.0) - 2.5 * gaussian(lat, 74.0, 7.0) - 3.5 * gaussian(lat, -70.0, 6.0))
    return [jets * np.minimum(taper, 1.4), ground * np.minimum(taper, 1.4)]


JET_PROFILES = [Profile(lambda z: z / 1.55 * np.exp(0.5 * (1.0 - (z / 1.55) ** 2))),
                Profile(lambda z: np.exp(-0.5 * (z / 1.2) ** 2))]


def wave_profile(ground, top, tilt):
    """A wave's G(Z): `ground` at the ground, 1 near Z = 1.2, fading above over sqrt(`top`); leans west by `tilt` radians."""
    def g(z):
        s = np.tanh(z / 0.7)
        return ((ground + (1.0 - ground) * s * s) * np.exp(-np.maximum(z - 1.2, 0.0) ** 2 / top)
                * np.exp(1j * tilt * np.tanh(z / 0.8)))
    return Profile(g)


WAVE_PROFILES = [wave_profile(0.50, 2.2, 1.3), wave_profile(0.75, 1.2, 1.0), wave_profile(0.1, 1.3, 0.6),
                 wave_profile(0.9, 1.0, 0.6)]
CENTRE_PROFILE = Profile(lambda z: np.exp(-0.5 * (z / 0.75) ** 2))

# Lasting highs and lows: latitude, longitude, widths (degrees of arc), metres of geopotential height at the ground.
CENTRES = [(33, -140, 11, 17, 45), (33, -35, 10, 16, 40), (-29, -95, 10, 16, 50), (-28, -8, 9, 14, 45),
           (-31, 85, 9, 18, 45), (55, -170, 9, 15, -90), (62, -28, 8, 13, -95), (27, 70, 9, 14, -35),
           (50, 100, 12, 20, 45), (-24, 134, 8, 12, -25), (32, -108, 8, 9, -25),
           (-66, 100, 7, 25, -50), (-66, -140, 7, 22, -50)]


class Waves:
    """The travelling waves' H(lambda, phi, t) of one vertical structure (J/kg), with its derivatives."""

    def __init__(self, rng, numbers, height, centre):
        self.parts = []
        for hemisphere in (1.0, -1.0):
            for m in numbers:
                self.parts.append(dict(
                    m=m, sign=hemisphere, amplitude=GRAVITY * height * rng.uniform(0.75, 1.25),
                    centre=rng.uniform(centre - 4.0, centre + 4.0), width=rng.uniform(9.0, 12.5),
                    phase=rng.uniform(0, 2 * np.pi), bend=rng.uniform(1.0, 2.0),
                    # Short waves go east faster than long ones (Rossby): metres per second at 50 degrees.
                    speed=(2.0 + 1.6 * (min(m, 11) - 3)) * rng.uniform(0.9, 1.1) + (2.0 if hemisphere < 0 else 0.0)))

    @staticmethod
    def meridional(part, lat):
        """The envelope, calm at the Equator and the poles, and the banana shape that carries momentum poleward."""
        y = part["sign"] * lat
        s = (y - part["centre"]) / part["width"]
        calm = np.where(y > 0, np.tanh(np.maximum(y, 0) / 25.0) ** 2 * np.cos(np.radians(y)) ** 2 * 2.4, 0.0)
        return calm * np.exp(-0.5 * s * s + 1j * 0.5 * part["bend"] * np.tanh(0.5 * s) ** 2 * 2.0)

    def derivatives(self, lat, lon, time):
        """H and its derivatives by lambda and phi (radians) and t, as a dictionary of (lat, lon) arrays."""
        out = {key: 0.0 for key in ("value", "east", "north", "time")}
        step = 1e-3
        for part in self.parts:
            m, spin = part["m"], part["speed"] / (RADIUS * np.cos(np.radians(50.0)))
            zonal = np.exp(1j * (m * (np.radians(lon) - spin * time) + part["phase"]))[None, :] * part["amplitude"]
            shape = self.meridional(part, lat)[:, None]
            slope = (self.meridional(part, lat + step) - self.meridional(part, lat - step)) / np.radians(2 * step)
            out["value"] = out["value"] + shape * zonal
            out["east"] = out["east"] + 1j * m * shape * zonal
            out["north"] = out["north"] + slope[:, None] * zonal
            out["time"] = out["time"] - 1j * m * spin * shape * zonal
        return out


LOW_SCALE = 8000.0  # J/kg


def deeper_lows(groups):
    """The H of what makes lows deeper and smaller than highs: -(Re H)**2 / LOW_SCALE of the travelling waves."""
    h = {key: sum(np.real(group[key]) for group, _ in groups) for key in groups[0][0]}
    out = {key: -2.0 * h["value"] * h[key] / LOW_SCALE for key in ("east", "north", "time")}
    out["value"] = -h["value"] ** 2 / LOW_SCALE
    return out


def lasting_centres(lat, lon):
    """The H of the lasting highs and lows; they do not move."""
    def value(y, x):
        total = sum(GRAVITY * h * bump(y, x, y0, x0, wy, wx) for y0, x0, wy, wx, h in CENTRES)
        return total * np.tanh(y / 18.0) ** 4
    y, x, step = lat[:, None], lon[None, :], 1e-3
    zero = np.zeros((lat.size, lon.size))
    return dict(value=value(y, x) + 0j, time=zero,
                east=(value(y, x + step) - value(y, x - step)) / np.radians(2 * step),
                north=(value(y + step, x) - value(y - step, x)) / np.radians(2 * step))


class Flow:
    """The balanced state. `columns(lat, lon, time)` fixes the horizontal part; its methods take Z."""

    def __init__(self, rng):
        self.column = TropicalColumn()
        self.waves = [Waves(rng, (3, 4, 5, 6), 95.0, 52.0), Waves(rng, (6, 7, 8, 9, 11), 72.0, 50.0),
                      Waves(rng, (4, 6, 7, 9), 45.0, 32.0), Waves(rng, (11, 13, 16), 24.0, 48.0)]
        fine = np.linspace(-90.0, 90.0, 7201)
        a = jet_shapes(fine)
        f, tangent = coriolis(fine), np.tan(np.radians(np.clip(fine, -89.99, 89.99)))
        self.fine = fine
        self.first = [self.integral(f * ai * RADIUS) for ai in a]
        self.second = [[self.integral(tangent * ai * aj) for aj in a] for ai in a]

    def integral(self, values):
        """The integral over latitude from the Equator, at the fine latitudes."""
        step = np.radians(self.fine[1] - self.fine[0])
        total = np.concatenate([[0.0], np.cumsum(0.5 * (values[1:] + values[:-1]) * step)])
        return total - np.interp(0.0, self.fine, total)

    def columns(self, lat, lon, time):
        return Columns(self, lat, lon, time)


def coriolis(lat):
    return 2.0 * ROTATION * np.sin(np.radians(lat))


class Columns:
    """The flow over one horizontal grid at one time. Z broadcasts against (lat, lon): (nz, 1, 1) or (nz, nlat, nlon)."""

    def __init__(self, flow, lat, lon, time):
        self.flow, self.lat = flow, lat[:, None]
        self.shapes = [a[:, None] for a in jet_shapes(lat)]
        self.first = [np.interp(lat, flow.fine, i)[:, None] for i in flow.first]
        self.second = [[np.interp(lat, flow.fine, j)[:, None] for j in row] for row in flow.second]
        self.groups = [(w.derivatives(lat, lon, time), g) for w, g in zip(flow.waves, WAVE_PROFILES)]
        self.groups.append((deeper_lows(self.groups[:2]), CENTRE_PROFILE))
        self.groups.append((lasting_centres(lat, lon), CENTRE_PROFILE))
        f = coriolis(self.lat)
        self.inverse_f = f / (f * f + coriolis(2.0) ** 2)  # the waves vanish where this differs from 1/f
        self.cosine = np.maximum(np.cos(np.radians(self.lat)), 1e-6)

    def perturbation(self, z, key="value", order=0):
        """The waves' part of Phi (or of one of its horizontal derivatives), differentiated `order` times by Z."""
        return sum(np.real(h[key] * g(z, order)) for h, g in self.groups)

    def geopotential(self, z, order=0):
        """Phi (m2/s2), or its derivative by Z."""
        b = [p(z) for p in JET_PROFILES]
        d = [p(z, 1) for p in JET_PROFILES]
        total = self.flow.column(z, order) + self.perturbation(z, order=order)
        for i, first in enumerate(self.first):
            total = total - first * JET_PROFILES[i](z, order)
            for j, second in enumerate(self.second[i]):
                if order == 0:
                    product = b[i] * b[j]
                elif order == 1:
                    product = d[i] * b[j] + b[i] * d[j]
                else:
                    product = 2.0 * d[i] * d[j] + JET_PROFILES[i](z, 2) * b[j] + b[i] * JET_PROFILES[j](z, 2)
                total = total - second * product
        return total

    def virtual_temperature(self, z):
        """Tv (K) = dPhi/dZ / R."""
        return self.geopotential(z, 1) / R_DRY

    def wind(self, z):
        """Eastward and northward wind (m/s): the jets, and the waves' geostrophic wind."""
        east = sum(a * p(z) for a, p in zip(self.shapes, JET_PROFILES))
        east = east - self.perturbation(z, "north") * self.inverse_f / RADIUS
        north = self.perturbation(z, "east") * self.inverse_f / (RADIUS * self.cosine)
        return east, north

    def ascent(self, z):
        """dZ/dt (1/s) that conserves potential temperature in the balanced wind, and none at the ground."""
        east, north = self.wind(z)
        slope = [p(z, 1) for p in JET_PROFILES]
        zonal = sum(a * p(z) for a, p in zip(self.shapes, JET_PROFILES))
        shear = sum(a * s for a, s in zip(self.shapes, slope))
        tangent = np.tan(np.radians(np.clip(self.lat, -89.9, 89.9)))
        # Thermal wind of the jets: R dT/dphi = -(a f + 2 U tan phi) dU/dZ.
        gradient = -(RADIUS * coriolis(self.lat) + 2.0 * zonal * tangent) * shear
        gradient = gradient + self.perturbation(z, "north", 1)
        change = (self.perturbation(z, "time", 1) + north * gradient / RADIUS
                  + east * self.perturbation(z, "east", 1) / (RADIUS * self.cosine)) / R_DRY
        stability = self.geopotential(z, 2) / R_DRY + KAPPA * self.virtual_temperature(z)
        return -change / np.maximum(stability, 15.0) * np.clip(z / 0.2, 0.0, 1.0)

    def surface(self, altitude):
        """Z where the geopotential equals that of the ground at `altitude` (m), by Newton's method."""
        z = np.full(np.broadcast_shapes(altitude.shape, self.lat.shape), 0.0) + altitude / 8000.0
        for _ in range(6):
            z = z - (self.geopotential(z) - GRAVITY * altitude) / self.geopotential(z, 1)
        return z
