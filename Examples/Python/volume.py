# SPDX-License-Identifier: BSD-3-Clause
"""Draws a model's clouds as glowing fog on a globe: volume.py CLIMATE.nc OUT.png"""
import sys

import nephoscope
from vtkmodules.vtkRenderingCore import vtkCamera

reader = nephoscope.vtkCloudNetCDFReader()
reader.SetFileName(sys.argv[1])
reader.SetVerticalExaggeration(30)
volume = nephoscope.vtkCloudCellVolume()
volume.SetInputConnection(reader.GetOutputPort())
camera = vtkCamera()
camera.SetPosition(2.4e7, -1.4e7, 1e7)
camera.SetViewUp(0, 0, 1)
globe = nephoscope.vtkCloudGlobe()
globe.SetTowardSun(camera.GetPosition())
scape = nephoscope.vtkCloudscape()
scape.SetCamera(camera)
scape.SetSize(320, 240)
scape.AddBody(globe)
scape.AddBody(volume)
writer = nephoscope.vtkCloudPictureWriter()
writer.SetInputConnection(scape.GetOutputPort())
writer.SetFileName(sys.argv[2])
sys.exit(0 if writer.Write() and scape.GetNumberOfSegments() > 0 else 1)
