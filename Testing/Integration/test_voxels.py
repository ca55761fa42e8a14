# SPDX-License-Identifier: BSD-3-Clause
"""convert to OpenVDB, and pictures of such files."""
import os
import shutil
import signal
import subprocess
import time

from program import PROGRAM, SAMPLE, SHARED, ProgramTest, main, pixels, run, run_on_full_disk

COARSE = ("--geometry", "map", "--voxel", "250000,250000,1000")


class Voxels(ProgramTest):
    def setUp(self):
        super().setUp()
        self.path = self.folder / "clouds.vdb"

    def convert(self, *options):
        done = run("convert", SAMPLE, self.path, *options)
        if "without OpenVDB" in done.stderr:
            self.assert_refused(done, 1, str(self.path), "libopenvdb-dev")
            self.skipTest(done.stderr.strip())
        return done

    def render(self, body, camera):
        scene = self.folder / "scene.yaml"
        scene.write_text("picture: { size: [80, 60] }\ncamera: { %s }\nlight: { towardSun: [0.3, 0.5, 0.8] }\n"
                         "bodies:\n  - { type: voxelVolume, %s }\n" % (camera, body))
        picture = self.folder / "picture.png"
        return run("render", scene, "-o", picture), picture


class Convert(Voxels):
    def test_each_grid_is_told_with_its_mass(self):
        done = self.convert(*COARSE)
        self.assert_done(done)
        told = [line for line in done.stderr.splitlines() if " voxels" in line]
        self.assertEqual(len(told), 4, done.stderr)
        for line, grid in zip(told, ("density", "liquid", "ice", "wind")):
            self.assertRegex(line, r"clouds\.vdb: %s, [1-9]\d* voxels" % grid)
        self.assertEqual(self.files(), ["clouds.vdb"])
        if shutil.which("vdb_print"):
            words = subprocess.run(["vdb_print", "-l", str(self.path)], capture_output=True, text=True,
                                   check=True).stdout
            for word in ("density", "liquid", "ice", "wind", "sample_climate.nc", "2001-10-01T00:00:00"):
                self.assertIn(word, words)

    def test_fewer_grids_halves_and_more_pruning_make_smaller_files(self):
        sizes = []
        for options in ((), ("--grids", "density,ice"), ("--grids", "density"), ("--grids", "density", "--half"),
                        ("--grids", "density", "--half", "--prune", "0.1")):
            done = self.convert(*COARSE, *options)
            self.assert_done(done)
            self.assertEqual("wind" in done.stderr.replace(str(self.folder), ""), not options)
            sizes.append(self.path.stat().st_size)
        self.assertEqual(sizes, sorted(set(sizes), reverse=True))

    def test_a_grid_is_the_same_alone(self):
        def line(done):
            return next(line for line in done.stderr.splitlines() if ": ice, " in line)

        together = self.convert(*COARSE)
        alone = self.convert(*COARSE, "--grids", "ice")
        self.assert_done(alone)
        self.assertEqual(line(together), line(alone))

    def test_a_file_for_each_step(self):
        done = self.convert(*COARSE, "--grids", "density", "--time", "1", "--to", "2001-10-01T12")
        self.assert_done(done)
        self.assertEqual(self.files(), ["clouds_0000.vdb", "clouds_0001.vdb"])
        first, second = ((self.folder / name).read_bytes() for name in self.files())
        self.assertIn(b"2001-10-01T06:00:00", first)
        self.assertIn(b"2001-10-01T12:00:00", second)

    def test_the_same_voxels_for_any_number_of_threads(self):
        told = set()
        for threads in (1, 2):
            done = self.convert(*COARSE, "--threads", threads)
            self.assert_done(done)
            told.add(done.stderr)
        self.assertEqual(len(told), 1)

    def test_errors_leave_nothing(self):
        self.assert_refused(self.convert("--voxel", "1,2"), 2, "--voxel", "X,Y,Z")
        self.assert_refused(self.convert("--voxel", "0"), 2, "--voxel")
        self.assert_refused(self.convert("--prune", "2"), 2, "--prune")
        self.assert_failed(self.convert("--geometry", "map", "--voxel", "10"), "choose larger ones")
        self.assert_failed(self.convert(*COARSE, "--grids", "snow"), "'snow'", "density, liquid, ice or wind")
        self.assert_refused(self.convert(*COARSE, "--time", "2", "--to", "1"), 2, "--to 1")
        self.assertEqual(self.files(), [])

    def test_a_full_disk_leaves_nothing(self):
        self.assert_done(self.convert(*COARSE))
        self.path.unlink()
        self.assert_failed(run_on_full_disk("convert", SAMPLE, self.path, *COARSE), str(self.path), "disk full")
        self.assertEqual(self.files(), [])

    def test_ctrl_c_ends_sampling(self):
        self.assert_done(self.convert(*COARSE))
        self.path.unlink()
        fine = ("--voxel", "15000", "--exaggeration", "10", "--threads", "1")
        process = subprocess.Popen([PROGRAM, "convert", SAMPLE, self.path, *fine], stderr=subprocess.PIPE, text=True)
        time.sleep(2)
        process.send_signal(signal.SIGINT)
        _, words = process.communicate(timeout=240)
        self.assertEqual(process.returncode, 130, words)
        self.assertNotIn("voxels", words)
        self.assertEqual(self.files(), [])


class Render(Voxels):
    OVERHEAD = "position: [0, 0, 3e7], target: [0, 0, 0], up: [0, 1, 0], viewAngle: 60"

    def cloudy(self, file, extinction, camera):
        """The share of pixels that a file's cloud changes."""
        shown = []
        for value in (extinction, 0):
            done, picture = self.render("file: %s, asymmetry: 0.2, extinction: %s" % (file, value), camera)
            self.assert_done(done)
            width, height, rows = pixels(picture)
            self.assertEqual((width, height), (80, 60))
            shown.append([bytes(row[3 * x:3 * x + 3]) for row in rows for x in range(width)])
        return sum(1 for with_it, without in zip(*shown) if with_it != without) / (width * height)

    def test_what_was_written_is_drawn(self):
        self.assert_done(self.convert(*COARSE, "--grids", "density,wind"))
        seen = self.cloudy(self.path, 1, self.OVERHEAD)
        self.assertGreater(seen, 0.05)
        self.assertLess(seen, 0.6)

    def test_what_cannot_be_drawn_is_named(self):
        self.assert_done(self.convert(*COARSE, "--grids", "density,wind"))
        self.assert_refused(self.render("file: %s, grid: snow" % self.path, self.OVERHEAD)[0], 1, "'snow'", "density")
        self.assert_refused(self.render("file: nowhere.vdb", self.OVERHEAD)[0], 1, "nowhere.vdb")
        os.truncate(self.path, 5000)
        self.assert_refused(self.render("file: %s" % self.path, self.OVERHEAD)[0], 1, str(self.path))

    def test_a_cloud_of_other_people(self):
        cloud = SHARED / "wdas_cloud_sixteenth.vdb"
        if not cloud.exists():
            self.skipTest("no file " + str(cloud))
        self.assert_done(self.convert(*COARSE))
        seen = self.cloudy(cloud, 0.12, "position: [700, 180, 420], target: [-10, 75, -40], up: [0, 1, 0], viewAngle: 32")
        self.assertGreater(seen, 0.1)
        self.assertLess(seen, 0.9)


if __name__ == "__main__":
    main()
