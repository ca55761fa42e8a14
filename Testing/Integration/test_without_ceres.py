# SPDX-License-Identifier: BSD-3-Clause
"""A program that was built without Ceres: it says so where it should fit, and reads what others have fitted."""
import subprocess

from program import PROGRAM, ProgramTest, main, run

QUALITY = ("{quality: {tolerance: 0.2}, picture: {size: [48, 32], samples: 1}, camera: {position: [0, 0, 250], "
           "target: [0, 1000, 530], viewAngle: 50}, bodies: [{type: heightField, cover: 0.6, waves: 6, billows: 0}]}\n")


class WithoutCeres(ProgramTest):
    def test_it_is_not_there(self):
        linked = subprocess.run(["ldd", PROGRAM], capture_output=True, text=True, check=True).stdout
        self.assertIn("libvtkCloudKernels", linked)
        self.assertNotIn("libceres", linked)

    def test_fits_are_refused(self):
        for command in (("fit", "transmittance"), ("fit", "density", "--data", "a.vti"), ("calibrate",)):
            self.assert_refused(run(*command, "-o", self.folder / "a.json"), 1, "without Ceres", "libceres-dev")
        self.assertEqual(self.files(), [])

    def test_methods_are_chosen_by_the_shipped_calibration(self):
        scene = self.folder / "scene.yaml"
        scene.write_text(QUALITY)
        done = run("render", scene, "-o", self.folder / "a.png", "--explain")
        self.assert_done(done)
        self.assertIn("light in height-field clouds: Moments", done.stdout)
        self.assertNotIn("built-in", done.stdout + done.stderr)


if __name__ == "__main__":
    main()
