# SPDX-License-Identifier: BSD-3-Clause
"""Clouds that are nothing but a numpy array, drawn without copying it: arrays.py OUT.png"""
import sys

import nephoscope
import numpy as np

east, north, height = np.linspace(0, 40e3, 161), np.linspace(0, 30e3, 121), np.linspace(500, 6e3, 45)
z, y, x = np.meshgrid(height, north, east, indexing="ij")  # (height, y, x), as in most model output
cover = np.zeros(z.shape, np.float32)
for place in np.random.default_rng(3).uniform((2e3, 2e3, 1.2e3), (38e3, 28e3, 2.5e3), (60, 3)):
    puff = ((x - place[0]) / 1.6e3) ** 2 + ((y - place[1]) / 1.6e3) ** 2 + ((z - place[2]) / 700) ** 2
    np.maximum(cover, np.exp(-puff), out=cover)

clouds = nephoscope.grid(cover, x=east, y=north, height=height)
picture = nephoscope.render(clouds, value=0.4, size=(320, 240), camera={"elevation": 25})
picture.save(sys.argv[1])
sys.exit(0 if np.shares_memory(nephoscope.arrays(clouds)["CloudFraction"], cover) else 1)
