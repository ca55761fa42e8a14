# SPDX-License-Identifier: BSD-3-Clause
"""fit density, optical depths that occur in a scene, and fitted constants in a picture."""
import json
import os

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


class Constants(ProgramTest):
    """Constants of a height field's Sexp1986: without, shipped, of a file, and of files that cannot be used."""

    def draw(self, calibration, **environment):
        scene, picture = self.folder / "scene.yaml", self.folder / "out.png"
        scene.write_text("{picture: {size: [48, 32], samples: 1}, camera: {position: [0, 0, 250], target: [0, 1000, 530], "
                         "viewAngle: 50}, bodies: [{type: heightField, cover: 0.6, waves: 6, billows: 0, method: Sexp1986, "
                         f"calibration: {calibration}}}]}}\n")
        done = run("render", scene, "-o", picture, env={**os.environ, **environment})
        return done, picture.read_bytes() if done.returncode == 0 else None

    def test_change_the_picture(self):
        own = self.folder / "own.json"
        own.write_bytes((ROOT / "Data" / "Calibration" / "heightfield.json").read_bytes())
        _, plain = self.draw("none")
        done, shipped = self.draw("shipped")
        self.assert_done(done)
        self.assertNotEqual(shipped, plain)
        self.assertEqual(self.draw("own.json")[1], shipped)

    def test_are_those_of_1986_where_the_shipped_ones_are_broken(self):
        (self.folder / "heightfield.json").write_text('{"format": "nephoscope calibration", "ver')
        done, picture = self.draw("shipped", NEPHOSCOPE_CALIBRATION=str(self.folder))
        self.assert_done(done)
        self.assertIn("is cut short", done.stderr)
        self.assertIn("Max's own constants are used", done.stderr)
        self.assertEqual(picture, self.draw("none")[1])

    def test_of_a_file_have_to_be_there(self):
        self.assert_refused(self.draw("missing.json")[0], 1, "missing.json: there is no calibration to read")
        text = (ROOT / "Data" / "Calibration" / "heightfield.json").read_text()
        (self.folder / "edited.json").write_text(text.replace("0.70", "0.71", 1))
        self.assert_refused(self.draw("edited.json")[0], 1, "edited.json: was edited by hand")
        (self.folder / "newer.json").write_text(text.replace('"version": 1', '"version": 9', 1))
        self.assert_refused(self.draw("newer.json")[0], 1, "newer.json: is of version 9, newer than 1")
        other = (ROOT / "Data" / "Calibration" / "slab.json").read_text()
        (self.folder / "other.json").write_text(other)
        self.assert_refused(self.draw("other.json")[0], 1, "other.json: has constants of 'slab', not of 'heightfield'")


if __name__ == "__main__":
    main()
