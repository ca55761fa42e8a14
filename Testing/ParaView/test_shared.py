# SPDX-License-Identifier: BSD-3-Clause
"""The reader and the contour with their defaults on files of models, where they are beside the repository."""
import unittest

from paraview import simple

import plugin

# File to the field to contour and its value.
FILES = {
    "cmip6_cesm2_cl.nc": ("CloudFraction", 0.15),
    "era5_tl31.nc": ("LiquidWater", 1e-5),
    "era5_fraction_13h.nc": ("CloudFraction", 0.15),
    "wrf_katrina.nc": ("LiquidWater", 1e-5),
}


class SharedFiles(plugin.PluginTest):
    def test_read_and_contour(self):
        for name, (field, value) in FILES.items():
            path = plugin.SHARED / name
            with self.subTest(name):
                if not path.exists():
                    self.skipTest(f"{path} is not there")
                source = simple.CloudNetCDFReader(FileName=str(path))
                contour = simple.CloudContour(Input=source, ContourBy=["POINTS", field], Values=[value])
                contour.UpdatePipeline()
                self.assertGreater(plugin.number_of(contour, "Cells"), 0)


if __name__ == "__main__":
    plugin.main()
