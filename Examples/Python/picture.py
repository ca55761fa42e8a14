# SPDX-License-Identifier: BSD-3-Clause
"""From a model's file to a picture in three lines: picture.py CLIMATE.nc OUT.png"""
import sys

import nephoscope

clouds = nephoscope.open(sys.argv[1], geometry="globe", exaggeration=10)
picture = nephoscope.render(clouds, style="texture", size=(320, 240))
picture.save(sys.argv[2])
sys.exit(0 if picture.transmittance.min() == 0 < picture.radiance.max() else 1)
