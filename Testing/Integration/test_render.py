# SPDX-License-Identifier: BSD-3-Clause
"""Pictures from scenes and styles, what is said about them, and what an interrupt leaves."""
import json
import os
import pty
import signal
import subprocess
import time

from program import PROGRAM, ROOT, SAMPLE, SHARED, ProgramTest, cloudy_share, main, pixels, run

SMALL = ("--size", "160x120")
STYLES = ("surface", "texture", "volume")


class Render(ProgramTest):
    def render(self, name, *options):
        path = self.folder / name
        return run("render", *options, "-o", path), path

    def test_each_style_shows_clouds(self):
        for style in STYLES:
            done, path = self.render(style + ".png", "--data", SAMPLE, "--style", style, *SMALL)
            self.assert_done(done)
            self.assertEqual(pixels(path)[:2], (160, 120))
            self.assertGreater(cloudy_share(path), 0.03, style)
            self.assertLess(cloudy_share(path), 0.6, style)
            self.assertNotIn("\r", done.stderr)
        self.assertEqual(len(self.files()), 3)

    def test_each_scene_of_the_examples(self):
        for style in STYLES:
            done, path = self.render(style + ".png", ROOT / "Examples" / "Scenes" / (style + ".yaml"), *SMALL)
            self.assert_done(done)
            self.assertGreater(cloudy_share(path), 0.03, style)

    def test_each_landscape_of_the_examples(self):
        for name in ("scattered-clouds", "from-above", "dense-clouds-over-hills", "hole-in-the-clouds", "cylinder"):
            scene = ROOT / "Examples" / "Scenes" / (name + ".yaml")
            done, path = self.render(name + ".png", scene, "--size", "96x72")
            self.assert_done(done)
            self.assertEqual(done.stderr, "")
            self.assertGreater(cloudy_share(path), 0.03, name)

    def test_real_data(self):
        if not SHARED.exists():
            self.skipTest("no folder " + str(SHARED))
        for name in ("era5_tl31", "wrf_katrina", "um_cosp"):
            for style in STYLES:
                with self.subTest(name=name, style=style):
                    done, path = self.render(name + style + ".png", "--data", SHARED / (name + ".nc"), "--style",
                                             style, *SMALL)
                    self.assert_done(done)
                    self.assertGreater(cloudy_share(path), 0.01)
                    self.assertEqual("Xu and Randall" in done.stderr, name != "um_cosp" and style != "volume")

    def test_stats(self):
        stats = self.folder / "stats.json"
        done, _ = self.render("a.png", "--data", SAMPLE, "--style", "surface", "--stats", stats, "--threads", "2",
                              *SMALL)
        self.assert_done(done)
        figures = json.loads(stats.read_text())
        self.assertEqual(set(figures["seconds"]), {"read", "filter", "prepare", "tiles", "write"})
        self.assertTrue(all(seconds >= 0 for seconds in figures["seconds"].values()))
        self.assertGreaterEqual(figures["cells"], 128 * 63 * 18)
        self.assertGreater(figures["triangles"], 1000)
        self.assertGreater(figures["segments"], 1000)
        self.assertEqual(figures["threads"], 2)
        self.assertEqual(figures["size"], [160, 120])
        self.assertIn("nephoscope", figures["versions"])

    def with_quality(self, quality, *options):
        scene = self.folder / "scene.yaml"
        scene.write_text("quality: %s\ndata: { file: %s }\nbodies: [{ type: volume }]\n" % (quality, SAMPLE))
        done = self.render("a.png", scene, *SMALL, *options)[0]
        done.stderr = "".join(line for line in done.stderr.splitlines(True) if ", step 0 of 0 to 3" not in line)
        return done

    def test_quality_is_explained_and_verified(self):
        done = self.with_quality("{ tolerance: 0.1 }", "--explain", "--verify", "9")
        self.assert_done(done)
        self.assertTrue(done.stdout.startswith("the cheapest methods with an error of at most 0.1: predicted"))
        for words in ("\ncells: ", "\n  not Centroid (error ", "\nleft out:", "\nverified 9 of 19200 pixels by exact",
                      "the tolerance of 0.1 is met by 95 % of the pixels; 0 % are above it\n"):
            self.assertIn(words, done.stdout)
        self.assertNotIn("built-in", done.stdout + done.stderr)
        self.assert_done(self.with_quality("{ seconds: 3600 }", "--explain"))

    def test_quality_that_cannot_be_had(self):
        self.assert_refused(self.with_quality("{ seconds: 0.00001 }"), 1, "quality: no methods take", "the fastest take")
        self.assert_refused(self.with_quality("{ tolerance: 1.0e-12 }"), 1, "can be reached, in")
        self.assert_refused(self.with_quality("{ tolerance: 1, seconds: 1 }"), 2, "give one of both")
        self.assert_refused(self.with_quality("{ tolerance: 0 }"), 2, "'tolerance'")
        self.assert_refused(self.with_quality("{ }", "--explain"), 2, "--explain", "quality:")
        self.assert_refused(self.with_quality("{ }", "--verify", "0"), 2, "--verify")

    def test_a_calibration_that_cannot_be_used_is_told(self):
        shipped = (ROOT / "Data" / "Calibration" / "methods.json").read_text()
        slab = (ROOT / "Data" / "Calibration" / "slab.json").read_text()
        for text, words in ((shipped[:1000], "cut short"), (shipped.replace('"version": 1', '"version": 9'), "newer"),
                            (shipped.replace('"value":', '"value":1', 1), "edited by hand"),
                            (slab, "has constants of 'slab', not of 'methods'")):
            (self.folder / "methods.json").write_text(text)
            scene = self.folder / "scene.yaml"
            scene.write_text("quality: { tolerance: 0.1 }\ndata: { file: %s }\nbodies: [{ type: volume }]\n" % SAMPLE)
            done = run("render", scene, "-o", self.folder / "a.png", "--explain", *SMALL,
                       env={**os.environ, "NEPHOSCOPE_CALIBRATION": str(self.folder)})
            self.assert_done(done)
            self.assertIn(words, done.stderr)
            self.assertIn("by built-in constants", done.stderr)
            self.assertIn("not calibrated, by built-in constants: cells", done.stdout)

    def test_threads_do_not_matter(self):
        contents = set()
        for threads in (1, 2, 3):
            done, path = self.render("a.png", "--data", SAMPLE, "--style", "volume", "--threads", threads, *SMALL)
            self.assert_done(done)
            contents.add(path.read_bytes())
        self.assertEqual(len(contents), 1)

    def pixels_in_order(self, order, sunlit):
        scene = self.folder / "order.yaml"
        scene.write_text("data: { file: %s }\nbodies: [{ type: volume, order: %s, sunlit: %s }]\n" %
                         (SAMPLE, order, sunlit))
        done, path = self.render("order.png", scene, *SMALL)
        self.assert_done(done)
        return b"".join(pixels(path)[2])

    def test_orders_of_cells(self):
        def largest(a, b):
            return max(abs(x - y) for x, y in zip(a, b))

        sunlit = self.pixels_in_order("pixelDepth", "true")
        self.assertLessEqual(largest(sunlit, self.pixels_in_order("visibility", "true")), 1)
        # Of one colour no order matters.
        even = self.pixels_in_order("pixelDepth", "false")
        self.assertLessEqual(largest(even, self.pixels_in_order("centroid", "false")), 1)
        self.assertGreater(largest(sunlit, even), 10)

    def test_openexr_is_linear_and_unexposed(self):
        done, dark = self.render("a.exr", "--data", SAMPLE, "--style", "surface", *SMALL)
        self.assert_done(done)
        self.assertEqual(dark.read_bytes()[:4], b"\x76\x2f\x31\x01")
        done, bright = self.render("b.exr", "--data", SAMPLE, "--style", "surface", "--exposure", "2", *SMALL)
        self.assert_done(done)
        self.assertEqual(dark.read_bytes(), bright.read_bytes())

    def test_exposure_brightens(self):
        light = []
        for stops in ("-1", "0"):
            done, path = self.render("a.png", "--data", SAMPLE, "--style", "volume", "--exposure", stops, *SMALL)
            self.assert_done(done)
            light.append(sum(map(sum, pixels(path)[2])))
        self.assertLess(light[0], light[1])

    def test_the_view_can_be_chosen(self):
        done, west = self.render("a.png", "--data", SAMPLE, "--style", "surface", "--view", "-90,10,5", *SMALL)
        self.assert_done(done)
        done, east = self.render("b.png", "--data", SAMPLE, "--style", "surface", "--view=90,10", *SMALL)
        self.assert_done(done)
        self.assertNotEqual(west.read_bytes(), east.read_bytes())

    def test_geometries(self):
        options = ("--data", SAMPLE, "--style", "volume", *SMALL, "--geometry")
        for geometry in ("map", "globe"):
            self.assert_done(self.render(geometry + ".png", *options, geometry)[0])
        self.assert_refused(self.render("local.png", *options, "local")[0], 1, "projection")

    def test_usage(self):
        self.assert_refused(run("render", "--data", SAMPLE, "--style", "surface"), 2, "-o")
        self.assert_refused(self.render("a.png")[0], 2, "--data")
        self.assert_refused(self.render("a.png", "--data", SAMPLE)[0], 2, "--style")
        self.assert_refused(self.render("a.jpg", "--data", SAMPLE, "--style", "surface")[0], 2, ".png", ".exr")
        for size in ("10", "-3x5", "5x-1", "99999x2", "3x4x5"):
            self.assert_refused(self.render("a.png", "--data", SAMPLE, "--style", "surface", "--size=" + size)[0], 2,
                                "--size")
        for view in ("1", "1,2,3,4", "0,91", "0,0,0", "a,b", "1,2,"):
            self.assert_refused(self.render("a.png", "--data", SAMPLE, "--style", "surface", "--view", view)[0], 2,
                                "--view")
        self.assert_refused(self.render("a.png", "--data", SAMPLE, "--style", "clay")[0], 2, "clay")
        self.assert_refused(self.render("a.png", "--data", "nowhere.nc", "--style", "volume")[0], 1, "nowhere.nc")
        self.assertEqual(self.files(), [])

    def test_numbers_and_names_that_cannot_be(self):
        options = ("--data", SAMPLE, "--style", "surface", *SMALL)
        for option in ("--value", "--exposure", "--exaggeration"):
            self.assert_refused(self.render("a.png", *options, option, "nan")[0], 2, option, "'nan'")
        for same in (self.folder / "a.png", self.folder / ".." / self.folder.name / "a.png", SAMPLE):
            self.assert_refused(self.render("a.png", *options, "--stats", same)[0], 2, str(same), "another name")
        self.assert_refused(self.render("a.png", *options, "--stats", self.folder)[0], 1, "regular file")
        self.assertEqual(self.files(), [])

    def test_options_that_would_change_nothing(self):
        options = ("--data", SAMPLE, *SMALL, "--style")
        self.assert_refused(self.render("a.png", *options, "volume", "--value", "0.3")[0], 2, "--value")
        hills = self.folder / "hills.yaml"
        hills.write_text("camera: { position: [0, 0, 900], target: [9, 0, 900] }\nbodies: [{ type: terrain }]\n")
        for option in (("--time", "1"), ("--exaggeration", "2"), ("--geometry", "map"), ("--variable", "Height=z")):
            self.assert_refused(self.render("a.png", hills, *option)[0], 2, option[0], "hills.yaml has none")

    def test_an_eye_in_the_ground(self):
        for view in (("--view", "0,0,0.5"), ("--view", "0,-20", "--geometry", "map")):
            done = self.render("a.png", "--data", SAMPLE, "--style", "surface", *SMALL, *view)[0]
            done.stderr = done.stderr.partition("\n")[2]
            self.assert_refused(done, 2, "--view", "the eye stands in")
        self.assertEqual(self.files(), [])

    def scene(self, camera="", ground="globe", geometry="globe"):
        path = self.folder / "scene.yaml"
        path.write_text("picture: { size: [40, 30] }\ndata: { file: %s, geometry: %s }\ncamera: { %s }\n"
                        "bodies: [{ type: surface }, { type: %s }]\n" % (SAMPLE, geometry, camera, ground))
        done = self.render("a.png", path)[0]
        done.stderr = "".join(line for line in done.stderr.splitlines(True) if ", step 0 of 0 to 3" not in line)
        return done

    def test_a_camera_that_looks_nowhere_is_refused(self):
        self.assert_refused(self.scene("position: [0, 0, 0]"), 2, "'target'")
        self.assert_refused(self.scene("position: [9e7, 1, 2], target: [9e7, 1, 2]"), 2, "'target'")
        self.assert_refused(self.scene("position: [0, 9e7, 0], up: [0, -1, 0]"), 2, "'up'", "line of sight")
        self.assert_refused(self.scene("longitude: 0, latitude: 0, up: [1, 0, 0]"), 2, "'up'", "line of sight")
        self.assert_done(self.scene("position: [0, 0, 9e7]"))

    def test_the_ground_is_that_of_the_geometry(self):
        self.assert_refused(self.scene(ground="plane"), 2, "'plane'", "'globe'")
        self.assert_refused(self.scene(geometry="map"), 2, "'globe'", "'plane'")
        self.assert_done(self.scene(ground="plane", geometry="map"))

    def test_a_scene_file_names_the_nearest_key(self):
        scene = self.folder / "scene.yaml"
        scene.write_text("data: { file: %s }\nbodies:\n  - type: surface\n    valu: 0.2\n" % SAMPLE)
        done, _ = self.render("a.png", scene)
        self.assert_refused(done, 2, str(scene) + ":4: ", "'valu'", "'value'")
        scene.write_text('"a\\e[31m\\nb": 1\n')
        self.assert_refused(self.render("a.png", scene)[0], 2, "'a?[31m?b'")
        scene.write_text("bodies: [{ type: %s }]\n" % ("x" * 100000))
        done, _ = self.render("a.png", scene)
        self.assert_refused(done, 2, "xxx...")
        self.assertLess(len(done.stderr), 3000)
        scene.write_text("camera: { position: [0, 0, 500], target: [9, 0, 500] }\nlight: { towardSun: [0, 1, -1] }\n"
                         "bodies: [{ type: heightField }, { type: water }]\nmedia: [{ type: haze }]\n")
        self.assert_refused(self.render("a.png", scene)[0], 1, str(scene) + ": ", "horizon")
        self.assertEqual(self.files(), ["scene.yaml"])


class Interrupts(ProgramTest):
    def start(self, **options):
        command = [PROGRAM, "render", "--data", SAMPLE, "--style", "volume", "--size", "6000x4500", "-o",
                   str(self.folder / "a.png")]
        return subprocess.Popen(command, stdout=subprocess.PIPE, **options)

    def test_ctrl_c_leaves_nothing(self):
        process = self.start(stderr=subprocess.PIPE, text=True)
        time.sleep(1.5)
        process.send_signal(signal.SIGINT)
        _, words = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, words)
        self.assertEqual(words.splitlines()[-1], "nephoscope: interrupted")
        self.assertEqual(self.files(), [])

    def test_a_terminal_has_a_progress_bar(self):
        ours, theirs = pty.openpty()
        process = self.start(stderr=theirs)
        os.close(theirs)
        seen = b""
        while b"draw" not in seen:
            seen += os.read(ours, 4096)
        self.assertRegex(seen, rb"draw +\[#* *\] +\d+ %")
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        os.close(ours)
        self.assertEqual(process.returncode, 130)


if __name__ == "__main__":
    main()
