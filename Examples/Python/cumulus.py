# SPDX-License-Identifier: BSD-3-Clause
"""Draws cumulus over water, in haze with the shafts of light between them: cumulus.py OUT.png"""
import sys

import nephoscope
from vtkmodules.vtkRenderingCore import vtkCamera

source = nephoscope.vtkCloudHeightFieldSource()
source.SetPlaneHeight(1200)
source.SetCover(0.4)
source.SetRelief(110)
source.SetRoundness(150)
clouds = nephoscope.vtkCloudHeightField()
clouds.SetInputConnection(source.GetOutputPort())
shadow = nephoscope.vtkCloudHeightFieldShadow()  # what the clouds leave of the sun's light, about the eye
shadow.SetInputConnection(source.GetOutputPort())
water = nephoscope.vtkCloudWater()
water.SetInputConnection(0, shadow.GetOutputPort())
sky = nephoscope.vtkCloudGradedBackdrop()
sky.SetZenith(0.06, 0.15, 0.42)
sky.SetHorizon(0.5, 0.64, 0.82)
water.SetBackdrop(sky)
haze = nephoscope.vtkCloudHaze()
haze.SetInputConnection(0, shadow.GetOutputPort())
haze.SetExtinction(2e-5, 2.4e-5, 3e-5)
haze.SetSkyColor(0.3, 0.38, 0.48)
haze.SetHeight(1200)
camera = vtkCamera()
camera.SetPosition(0, 0, 250)
camera.SetFocalPoint(0, 1000, 400)
camera.SetViewUp(0, 0, 1)
scape = nephoscope.vtkCloudscape()
scape.SetCamera(camera)
scape.SetSize(320, 240)
scape.SetBackdrop(sky)
for body in (clouds, water, haze):
    body.SetTowardSun(-1, 1, 2)
    scape.AddBody(body)
writer = nephoscope.vtkCloudPictureWriter()
writer.SetInputConnection(scape.GetOutputPort())
writer.SetFileName(sys.argv[1])
sys.exit(0 if writer.Write() and scape.GetNumberOfSegments() > 0 else 1)
