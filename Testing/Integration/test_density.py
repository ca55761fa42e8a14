# SPDX-License-Identifier: BSD-3-Clause
"""fit density, and optical depths that occur in a scene."""
import json

from program import ROOT, SAMPLE, ProgramTest, main, run

SCENES = ROOT / "Examples" / "Scenes"


class FitTest(ProgramTest):
    def fit(self, *arguments):
        done = run("fit", *arguments)
        if "without Ceres" in done.stderr:
            self.skipTest(done.stderr.strip())
        return done


class Density(FitTest):
    def volume(self, values="0 0 0 0 0.02 0 0 0 0 " * 3, name="Extinction"):
        """3 x 3 x 3 points."""
        path = self.folder / "cloud.vti"
        path.write_text(f"""<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian">
            <ImageData WholeExtent="0 2 0 2 0 2" Origin="0 0 1000" Spacing="100 100 50"><Piece Extent="0 2 0 2 0 2">
            <PointData><DataArray type="Float32" Name="{name}" format="ascii">{values}</DataArray></PointData>
            </Piece></ImageData></VTKFile>""")
        return path

    def test_a_column_becomes_gaussians(self):
        out = self.folder / "column.json"
        done = self.fit("density", "--data", SAMPLE, "--column", "30,10", "--tolerance", "0.02", "-o", out)
        self.assert_done(done)
        self.assertIn("the column at longitude 30.938, latitude 9.844, extinction by its condensate", done.stderr)
        written = json.loads(out.read_text())
        self.assertEqual(written["command"], f"nephoscope fit density --data {SAMPLE} --column 30,10 "
                         "--tolerance 0.02 --terms 32")
        fits = {fit["name"]: fit for fit in written["fits"]}
        self.assertLessEqual(fits["sum"]["held_out"]["rms"], 0.02)
        self.assertLess(abs(fits["mass"]["held_out"]["bias"]), 0.05)
        self.assertEqual([p["name"] for p in fits["Gaussian 1"]["parameters"]], ["a", "z", "m22"])

    def test_a_volume_becomes_gaussians(self):
        """All of it, and the two axes of a slice."""
        done = self.fit("density", "--data", self.volume(), "--tolerance", "0.3")
        self.assert_done(done)
        self.assertRegex(done.stdout, "(?m)^Gaussian 1 .* m12 ")
        part = self.fit("density", "--data", self.volume(), "--tolerance", "0.3", "--box", "100,100,0,200,1000,1100")
        self.assert_done(part)
        self.assertRegex(part.stdout, "(?m)^Gaussian 1 .* m12 ")
        self.assertNotIn(" m01 ", part.stdout)

    def test_densities_that_cannot_be_are_refused(self):
        refused = lambda code, words, *arguments: self.assert_refused(self.fit("density", *arguments), code, *words)
        volume = self.volume()
        refused(2, ["fit density needs a density", "--column"])
        refused(2, ["--column LON,LAT"], "--data", SAMPLE)
        refused(1, ["there is no such file"], "--data", self.folder / "no.vti")
        refused(1, ["the tolerance 0.001 is not met; 1 Gaussian reaches 0."], "--data", volume,
                "--tolerance", "0.001", "--terms", "1")
        refused(1, ["give another --box"], "--data", volume, "--box", "9,9,9,9,9,9")
        refused(2, ["--tolerance"], "--data", volume, "--tolerance", "0")
        refused(1, ["no point array Extinction"], "--data", self.volume(name="Rain"))
        refused(1, ["it is 0 everywhere"], "--data", self.volume("0 " * 27))
        refused(1, ["the density of point 0 is -1"], "--data", self.volume("-1 " * 27))
        refused(1, ["no bodies of type heightField"], "--scene", SCENES / "volume.yaml", "--box", "0,1,0,1,0,1")
        refused(2, ["either --scene or --data"], "--scene", SCENES / "volume.yaml", "--data", SAMPLE)


class Depths(FitTest):
    def test_a_scene_has_depths_of_its_own(self):
        out = self.folder / "own.json"
        self.assert_done(self.fit("transmittance", "--scene", SCENES / "volume.yaml", "-o", out))
        written = json.loads(out.read_text())
        self.assertIn("--scene", written["command"])
        shipped = json.loads((ROOT / "Data" / "Calibration" / "transmittance.json").read_text())
        self.assertEqual([fit["name"] for fit in written["fits"]], [fit["name"] for fit in shipped["fits"]])
        for own, general in zip(written["fits"][:3], shipped["fits"][:3], strict=True):
            self.assertNotEqual(own["parameters"][0]["value"], general["parameters"][0]["value"])
            self.assertLess(abs(own["held_out"]["rms"] / own["training"]["rms"] - 1), 0.1)

    def test_scenes_without_depths_are_refused(self):
        self.assert_refused(self.fit("transmittance", "--scene", SCENES / "surface.yaml"), 1,
                            "no clouds with an optical depth")
        self.assert_refused(self.fit("slab", "--data", SAMPLE), 2, "fit slab takes no --scene or --data")


if __name__ == "__main__":
    main()
