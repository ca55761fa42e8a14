# SPDX-License-Identifier: BSD-3-Clause
"""A texture that drifts with its clouds, at a time between those of the file: wind.py CLIMATE.nc OUT.png"""
import sys

import nephoscope

clouds = nephoscope.advect(sys.argv[1], "2001-10-01T09:20", geometry="globe", exaggeration=10)
nephoscope.render(clouds, style="texture", size=(320, 240)).save(sys.argv[2])
stretch = nephoscope.arrays(clouds)["TextureStretch"]
sys.exit(0 if stretch.min() < 1.2 < stretch.max() else 1)
