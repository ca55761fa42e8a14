# SPDX-License-Identifier: BSD-3-Clause
"""Made-up continents: a few smooth mounds placed roughly where the Earth has land and mountains."""
import numpy as np

from .sphere import RandomWaves, bump, smoothstep, unit_vectors

# latitude, longitude, half widths northward and eastward (degrees of arc), turn (degrees)
LAND = [
    (50, 95, 15, 38, 0), (62, 75, 9, 32, 0), (64, 128, 7, 20, 0), (50, 20, 8, 18, 0), (62, 20, 6, 7, 45),
    (33, 108, 9, 12, 0), (22, 79, 9, 6, 0), (27, 48, 9, 9, -30), (16, 102, 7, 5, 0), (19, 8, 9, 19, 0),
    (6, 24, 10, 14, 0), (-12, 26, 13, 9, 0), (-26, 24, 6, 6, 0), (8, 42, 6, 6, 0), (-20, 47, 6, 2.2, 60),
    (48, -100, 12, 20, 0), (63, -112, 8, 22, 0), (64, -152, 5, 8, 0), (35, -95, 8, 12, 0), (24, -103, 6, 5, -35),
    (54, -72, 6, 8, 0), (15, -89, 2.5, 6, -35), (-5, -59, 10, 13, 0), (-18, -60, 10, 9, 0), (-36, -66, 9, 4.5, 0),
    (-48, -70, 5, 2.6, 0), (73, -41, 8, 8, 0), (-25, 134, 8, 15, 0), (-1, 113, 3.5, 4.5, 0), (-5, 142, 2.5, 6, -20),
    (37, 139, 5, 2.2, -25), (53, -2, 3.5, 2.2, 0), (-42, 172, 3.5, 2.2, -30), (-86, 60, 13, 13, 0),
    (-76, 100, 7, 18, 0), (-77, 20, 6, 14, 0), (-78, -110, 5, 12, 0)]

# the same, and the height (m)
MOUNTAINS = [
    (33, 88, 5.0, 12, 0, 4700), (42, 78, 4.5, 9, 15, 1900), (50, 98, 5, 10, 0, 1300), (32, 54, 4.5, 9, -25, 1300),
    (40, 42, 4, 8, 0, 1300), (46, 11, 4, 6, 0, 900), (63, 12, 4.5, 4, 45, 700), (9, 39, 4.5, 4.5, 0, 1900),
    (-3, 32, 7, 4.5, 0, 1100), (-24, 26, 6, 7, 0, 1200), (23, 8, 5, 7, 0, 600), (42, -110, 10, 5.5, 15, 2000),
    (58, -124, 7, 4.5, 35, 1100), (23, -103, 6, 4, -30, 1500), (-18, -68.5, 10, 4.2, 5, 3300), (1, -75, 6, 4, -20, 1900),
    (-36, -70, 7, 4.0, 0, 1600), (-16, -46, 6, 6, 0, 650), (73, -40, 6.5, 6.5, 0, 2700), (-82, 80, 9, 18, 0, 2900),
    (-79, -110, 5, 12, 0, 1300), (-72, 40, 5, 14, 0, 1200), (62, 135, 6, 14, 0, 700), (-5, 140, 3.5, 6, -20, 1200)]


class Terrain:
    """Land fraction (1) and surface altitude (m), smooth enough for grids of about 3 degrees."""

    def __init__(self, rng):
        self.coast = RandomWaves(rng, 8, 24, count=120)
        self.hills = RandomWaves(rng, 8, 22, count=80)

    def land(self, lat, lon):
        mounds = sum(bump(lat, lon, y, x, 0.8 * wy, 0.8 * wx, turn) for y, x, wy, wx, turn in LAND)
        return smoothstep(0.25, 0.75, mounds + 0.10 * self.coast(unit_vectors(lat, lon)))

    def altitude(self, lat, lon):
        peaks = sum(h * bump(lat, lon, y, x, wy, wx, turn) for y, x, wy, wx, turn, h in MOUNTAINS)
        hills = 250.0 + 120.0 * self.hills(unit_vectors(lat, lon))
        return (np.maximum(hills, 30.0) + peaks) * self.land(lat, lon)
