# SPDX-License-Identifier: BSD-3-Clause
"""A labelled array of xarray, drawn as it is: it says itself where its points are. labels.py OUT.png"""
import sys

import nephoscope
import numpy as np
import xarray

lon, lat, height = np.arange(0, 360, 2.0), np.arange(-89, 90, 2.0), np.linspace(0, 14e3, 15)
cover = xarray.DataArray(np.zeros((90, 180, 15), np.float32), name="cover", dims=("lat", "lon", "height"), coords={
    "lon": ("lon", lon, {"units": "degrees_east"}), "lat": ("lat", lat, {"units": "degrees_north"}),
    "height": ("height", height, {"units": "m"})})
wave = np.cos(np.radians(5 * cover.lon + 4 * cover.lat)) * np.sin(np.radians(2 * cover.lat)) ** 2
cover = (cover + wave * np.exp(-(((cover.height - 5e3) / 2e3) ** 2))).clip(0, 1).astype(np.float32)

globe = nephoscope.grid(cover, exaggeration=20)
nephoscope.render(globe, style="texture", size=(320, 240), value=0.4).save(sys.argv[1])
sys.exit(0 if globe.GetDimensions() == (181, 92, 15) else 1)
