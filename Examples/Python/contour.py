# SPDX-License-Identifier: BSD-3-Clause
"""Contours a model's cloud fraction at 15 % and writes the surface: contour.py CLIMATE.nc OUT.vtp"""
import sys

import nephoscope
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

reader = nephoscope.vtkCloudNetCDFReader()
reader.SetFileName(sys.argv[1])
reader.SetVerticalExaggeration(30)
contour = nephoscope.vtkCloudContour()
contour.SetInputConnection(reader.GetOutputPort())
contour.SetValue(0, 0.15)
writer = vtkXMLPolyDataWriter()
writer.SetInputConnection(contour.GetOutputPort())
writer.SetFileName(sys.argv[2])
sys.exit(0 if writer.Write() and contour.GetOutput().GetNumberOfPolys() > 0 else 1)
