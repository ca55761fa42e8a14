# SPDX-License-Identifier: BSD-3-Clause
"""Each proxy of the plugin runs with its defaults on the sample data, and its defaults are those of its class."""
import pathlib
import unittest

import nephoscope
from paraview import simple

import plugin
from server_manager import properties, proxies

ROOT = plugin.ROOT


def reader():
    return simple.CloudNetCDFReader(FileName=plugin.CLIMATE)


def cumulus():
    return simple.CumulusClouds()


def voxels():
    file = str(plugin.FOLDER / "proxies.vdb")
    simple.SaveData(file, proxy=reader())
    return simple.CloudVDBReader(FileName=file)


# Sources that need a file.
OPEN = {"CloudNetCDFReader": reader, "CloudVDBReader": voxels}

# What differs from the class on purpose: surfaces have less points, and ParaView has no use for bricks.
OTHER_DEFAULTS = {("CloudHeightFieldSource", "Dimensions"), ("CloudVDBReader", "OutputForm")}


# What each source and filter takes, and the array that its output must have.
MADE = {
    "CloudNetCDFReader": (None, "CloudFraction"),
    "CloudHeightFieldSource": (None, "Normals"),
    "CloudTerrainSource": (None, "Height"),
    "CloudHeightFieldShadow": (cumulus, "SunTransmittance"),
    "CloudHeightFieldVolume": (cumulus, "Extinction"),
    "CloudContour": (reader, "Normals"),
    "CloudSmooth": (reader, "CloudFraction"),
    "CloudTexture": (reader, "Opacity"),
    "CloudTextureAdvection": (reader, "TextureCoordinates"),
    "CloudTimeInterpolator": (reader, "CloudFraction"),
    "CloudPicture": (reader, "DisplayColor"),
    "CloudVDBReader": (None, "density"),
}


def make(name, label):
    create = getattr(simple, (label or name).replace(" ", ""))
    source = MADE[name][0]
    if source:
        return create(Input=source())
    return OPEN.get(name, create)()


def values(text):
    return [float(value) for value in text.split()]


class Proxies(plugin.PluginTest):
    def each(self):
        for group, element in proxies(ROOT):
            if group in ("sources", "filters") and element.get("name") in MADE:
                yield element

    def test_all_are_tried(self):
        shown = {element.get("name") for group, element in proxies(ROOT) if group in ("sources", "filters")}
        self.assertEqual(shown, set(MADE))

    def test_run_with_defaults(self):
        for element in self.each():
            name = element.get("name")
            with self.subTest(name):
                made = make(name, element.get("label"))
                made.UpdatePipeline()
                self.assertGreater(plugin.number_of(made, "Points"), 0)
                self.assertIn(MADE[name][1], made.PointData.keys())

    def test_defaults_are_those_of_the_class(self):
        compared = 0
        for _, element in proxies(ROOT):
            kind = getattr(nephoscope, element.get("class"), None)
            for child in properties(element) if kind else ():
                getter = getattr(kind(), (child.get("command") or "").replace("Set", "Get", 1), None)
                default = child.get("default_values")
                other = (element.get("name"), child.get("name")) in OTHER_DEFAULTS
                if getter and default and not child.get("repeat_command") and not other:
                    with self.subTest(element.get("name"), property=child.get("name")):
                        own = getter()
                        self.assertEqual(list(own) if isinstance(own, tuple) else [own], values(default))
                    compared += 1
        self.assertGreater(compared, 90)

    def test_no_domain_takes_a_default_s_place(self):
        for element in self.each():
            made = make(element.get("name"), element.get("label"))
            for child in properties(element):
                default = child.get("default_values")
                if default and not child.get("repeat_command"):
                    with self.subTest(element.get("name"), property=child.get("name")):
                        shown = made.SMProxy.GetProperty(child.get("name"))
                        shown = [shown.GetElement(i) for i in range(shown.GetNumberOfElements())]
                        self.assertEqual(shown, values(default))

    def test_contour_starts_at_fifteen_per_cent_of_cloudiness(self):
        source = reader()
        source.UpdatePipeline()
        contour = simple.CloudContour(Input=source)
        self.assertEqual(list(contour.Values), [0.15])
        self.assertEqual(contour.ContourBy[1], "CloudFraction")
        contour.Values = [0.15, 0.5]
        contour.UpdatePipeline()
        self.assertEqual(contour.GetClientSideObject().GetNumberOfContours(), 2)

    def test_reader_is_chosen_for_cloudy_files_alone(self):
        self.assertEqual(simple.OpenDataFile(plugin.CLIMATE).SMProxy.GetXMLName(), "CloudNetCDFReader")
        object_ = reader().GetClientSideObject()
        self.assertEqual(object_.CanReadFile(plugin.CLOUDS), 1)
        self.assertEqual(object_.CanReadFile(str(ROOT / "README.md")), 0)

    def test_arrays_can_be_left_out(self):
        source = reader()
        source.UpdatePipelineInformation()
        self.assertIn("Wind", source.PointArrays.Available)
        source.PointArrays = ["CloudFraction"]
        source.UpdatePipeline()
        self.assertEqual(sorted(source.PointData.keys()), ["CloudFraction", "Height"])

    def test_a_variable_can_be_given_a_role(self):
        source = simple.CloudNetCDFReader(FileName=plugin.CLIMATE, Variables=["IceWater", "clw", "LiquidWater", ""])
        source.UpdatePipeline()
        self.assertEqual(source.GetClientSideObject().GetVariableOfRole("IceWater"), "clw")
        self.assertNotIn("LiquidWater", source.PointData.keys())

    def test_a_picture_of_a_grid_and_its_surface_is_written(self):
        source = reader()
        surface = simple.CloudContour(Input=source, Values=[0.5])
        picture = simple.CloudPicture(Input=source, OtherInput=surface, Size=[96, 64])
        simple.UpdatePipeline(proxy=picture)
        plain = picture.PointData["Radiance"].GetRange(0)
        picture.Surface.OpacityMode = "Texture"
        picture.Volume.FullCoverExtinction1m = 1e-4
        picture.Backdrop.Horizon = [0.1, 0.2, 2.5]
        simple.UpdatePipeline(proxy=picture)
        self.assertNotEqual(picture.PointData["Radiance"].GetRange(0), plain)
        self.assertGreater(picture.PointData["Radiance"].GetRange(2)[1], 1)
        for extension, start in (("exr", b"\x76\x2f\x31\x01"), ("png", b"\x89PNG")):
            file = pathlib.Path(plugin.FOLDER, "picture." + extension)
            file.unlink(missing_ok=True)
            simple.SaveData(str(file), proxy=picture)
            self.assertEqual(file.read_bytes()[:4], start)


if __name__ == "__main__":
    plugin.main()
