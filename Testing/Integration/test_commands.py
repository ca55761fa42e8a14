# SPDX-License-Identifier: BSD-3-Clause
"""info, convert and the command line itself."""
import json
import os
import pathlib
import pty
import shutil
import subprocess

import netCDF4

from program import PROGRAM, ROOT, SAMPLE, SHARED, ProgramTest, main, run, run_on_full_disk


class CommandLine(ProgramTest):
    def test_help_has_examples_and_exit_codes(self):
        done = run("--help")
        self.assert_done(done)
        for word in ("info", "convert", "render", "animate", "Examples:", "Exit codes"):
            self.assertIn(word, done.stdout)
        for command in ("info", "convert", "render", "animate", "fit"):
            self.assertIn("nephoscope " + command, run(command, "--help").stdout)

    def test_version(self):
        self.assertRegex(run("--version").stdout, r"^nephoscope \d+\.\d+\.\d+\n$")

    def test_usage_errors_are_2(self):
        self.assert_refused(run(), 2, "--help")
        self.assert_refused(run("rendr"), 2, "--help")
        self.assert_refused(run("info"), 2, "file", "info --help")
        self.assert_refused(run("info", SAMPLE, "--jason"), 2, "--jason")
        self.assert_refused(run("info", SAMPLE, "--variable", "CloudFraction"), 2, "ROLE=NAME")
        self.assert_refused(run("convert", SAMPLE, "a.vtp", "--value", "2"), 2, "--value")
        self.assert_refused(run("convert", SAMPLE, "a.vtp", "--threads", "0"), 2, "--threads")
        self.assert_refused(run("convert", SAMPLE, "a.vtp", "--value", "nan"), 2, "--value", "'nan'")
        self.assert_refused(run("convert", SAMPLE, "a.vtp", "--exaggeration", "nan"), 2, "--exaggeration", "'nan'")
        self.assert_refused(run("info", SAMPLE, "--variable", "CloudFraction="), 2, "ROLE=NAME")
        self.assert_refused(run("rendr"), 2, "'rendr'", "'render'")
        self.assert_refused(run("chrt"), 2, "'chrt'", "'chart'")
        self.assert_refused(run("zzzzz"), 2, "'zzzzz'", "info, convert, render")

    def test_interpolation_needs_files_that_are_there(self):
        out = self.folder / "chart"
        self.assert_refused(run("chart", "--interpolation", SAMPLE), 2, "-o DIR")
        self.assert_refused(run("chart", "-o", out, "--interpolation", "nowhere.nc"), 1, "nowhere.nc")
        self.assertEqual(self.files(), [])

    def test_remedies_are_options(self):
        self.assert_refused(run("info", SAMPLE, "--variable", "Temperature=cl"), 1, "--variable ROLE=NAME")
        self.assert_refused(run("convert", SAMPLE, self.folder / "a.vtp", "--geometry", "local"), 1,
                            "--geometry map or globe")

    def test_more_threads_than_the_machine_has_are_as_many_as_it_has(self):
        done = run("convert", SAMPLE, self.folder / "a.vtp", "--threads", "1000")
        self.assert_done(done)
        self.assertNotIn("TBB", done.stderr)


class Info(ProgramTest):
    def test_json_says_what_is_there(self):
        done = run("info", SAMPLE, "--json")
        self.assert_done(done)
        info = json.loads(done.stdout)
        self.assertEqual(info["file"], SAMPLE)
        self.assertEqual(info["dimensions"], [128, 64, 19])
        self.assertEqual(info["times"], ["2001-10-01T00:00:00", "2001-10-01T06:00:00", "2001-10-01T12:00:00",
                                         "2001-10-01T18:00:00"])
        self.assertIn("hybrid", info["verticalCoordinate"])
        self.assertEqual(info["variables"]["CloudFraction"], "cl")
        self.assertIsInstance(info["derived"], dict)
        self.assertIsInstance(info["warnings"], list)

    def test_table_says_the_same(self):
        done = run("info", SAMPLE)
        self.assert_done(done)
        for word in ("128 x 64 x 19", "2001-10-01T18:00:00", "CloudFraction", "hybrid"):
            self.assertIn(word, done.stdout)

    def test_an_explicit_choice_wins(self):
        info = json.loads(run("info", SAMPLE, "--json", "--variable", "CloudFraction=clw").stdout)
        self.assertEqual(info["variables"]["CloudFraction"], "clw")

    def test_bad_files_are_named(self):
        self.assert_refused(run("info", "nowhere.nc"), 1, "nowhere.nc: ")
        bad = self.folder / "bad.nc"
        bad.write_text("this is not NetCDF")
        self.assert_refused(run("info", bad), 1, str(bad) + ": ")
        bad.write_bytes((ROOT / "Data" / "sample_climate.nc").read_bytes()[:5000])
        self.assert_refused(run("info", bad), 1, str(bad) + ": ")
        self.assert_refused(run("info", self.folder), 1, str(self.folder) + ": ")
        self.assert_refused(run("info", SAMPLE, "--variable", "CloudFraction=nothing"), 1, "nothing")


class Convert(ProgramTest):
    def convert(self, name, *options):
        path = self.folder / name
        return run("convert", SAMPLE, path, *options), path

    def test_three_kinds(self):
        for kind, word in (("vts", b"StructuredGrid"), ("vtu", b"UnstructuredGrid"), ("vtp", b"PolyData")):
            done, path = self.convert("out." + kind)
            self.assert_done(done)
            self.assertIn(b'type="' + word + b'"', path.read_bytes()[:400])
            self.assertNotIn("\r", done.stderr)
        self.assertEqual(self.files(), ["out.vtp", "out.vts", "out.vtu"])

    def test_a_time_is_an_index_a_date_or_seconds(self):
        contents = []
        for name, time in (("a", "1"), ("b", "2001-10-01T06:00:00"), ("c", "2001-10-01 06:00"), ("d", "21600")):
            done, path = self.convert(name + ".vtp", "--time", time)
            self.assert_done(done)
            self.assertIn("2001-10-01T06:00:00", done.stderr)
            contents.append(path.read_bytes())
        self.assertEqual(len(set(contents)), 1)
        _, path = self.convert("e.vtp", "--time", "2")
        self.assertNotEqual(path.read_bytes(), contents[0])

    def test_a_wrong_time_names_the_right_ones(self):
        for time in ("4", "-1", "1.5", "2001-10-02", "noon"):
            done, path = self.convert("a.vtp", "--time=" + time)
            self.assert_refused(done, 1, "2001-10-01T00:00:00", "2001-10-01T18:00:00")
            self.assertFalse(path.exists())

    def test_steps_without_dates_are_numbered(self):
        undated = self.folder / "undated.nc"
        shutil.copy(SAMPLE, undated)
        with netCDF4.Dataset(undated, "a") as file:
            file["time"].delncattr("units")
        done = run("convert", undated, self.folder / "a.vtp", "--time", "2")
        self.assert_done(done)
        self.assertIn(str(undated) + ": step 2 of 0 to 3\n", done.stderr)
        self.assert_refused(run("convert", undated, self.folder / "b.vts", "--time", "9"), 1, "the file has steps 0 to 3")

    def test_more_cloud_is_within_less(self):
        _, low = self.convert("low.vtp", "--value", "0.05")
        _, high = self.convert("high.vtp", "--value", "0.9")
        self.assertGreater(low.stat().st_size, high.stat().st_size)

    def test_what_cannot_be_written_leaves_nothing(self):
        self.assert_refused(self.convert("a.obj")[0], 2, ".vts", ".vtu", ".vtp")
        self.assert_refused(self.convert("none/a.vts")[0], 1, "none")
        (self.folder / "folder.vts").mkdir()
        self.assert_refused(self.convert("folder.vts")[0], 1, "folder.vts")
        for kind in ("vts", "vtu", "vtp"):
            path = str(self.folder / ("full." + kind))
            self.assert_failed(run_on_full_disk("convert", SAMPLE, path), path + ": cannot be written; is the disk full?")
        self.assertEqual(self.files(), ["folder.vts"])

    def test_the_file_that_is_read_is_not_replaced(self):
        data = self.folder / "data.vtp"
        shutil.copy(SAMPLE, data)
        self.assert_refused(run("convert", data, self.folder / "." / "data.vtp"), 2, "data.vtp", "another name")
        self.assertEqual(data.read_bytes(), pathlib.Path(SAMPLE).read_bytes())

    def test_a_curtain_has_no_cells(self):
        curtain = SHARED / "ecrad_meridian.nc"
        if not curtain.exists():
            self.skipTest("needs the shared file " + curtain.name)
        for kind in ("vtu", "vtp"):
            self.assert_refused(run("convert", curtain, self.folder / ("out." + kind)), 1, "no cells", ".vts")
        self.assert_done(run("convert", curtain, self.folder / "out.vts"))


class Fit(ProgramTest):
    def fit(self, *arguments):
        done = run("fit", *arguments)
        if "without Ceres" in done.stderr:
            self.skipTest(done.stderr.strip())
        return done

    def test_writes_the_same_bytes_again(self):
        for name in ("a.json", "b.json"):
            done = self.fit("transmittance", "--range", "0:2", "-o", self.folder / name)
            self.assert_done(done)
            self.assertIn("polynomial 2 to 2", done.stdout)
        self.assertEqual((self.folder / "a.json").read_bytes(), (self.folder / "b.json").read_bytes())
        written = json.loads((self.folder / "a.json").read_text())
        self.assertEqual((written["format"], written["version"]), ("nephoscope calibration", 1))
        self.assertEqual(written["command"], "nephoscope fit transmittance --range 0:2")

    def test_a_terminal_has_a_progress_bar(self):
        self.assert_done(self.fit("slab"))
        ours, theirs = pty.openpty()
        done = subprocess.run([PROGRAM, "fit", "slab"], stdout=subprocess.PIPE, stderr=theirs, timeout=240, check=True)
        os.close(theirs)
        self.assertRegex(os.read(ours, 4096), rb"fit +\[#* *\] +\d+ %")
        os.close(ours)
        self.assertNotIn(b"\r", done.stdout)

    def test_shipped_calibrations_are_what_their_commands_make(self):
        """To the digits that another machine's exponentials leave: slab, the quickest, stands for all."""
        shipped = json.loads((ROOT / "Data" / "Calibration" / "slab.json").read_text())
        self.assert_done(self.fit(*shipped["command"].split()[2:], "-o", self.folder / "slab.json"))
        again = json.loads((self.folder / "slab.json").read_text())
        for old, new in zip(shipped["fits"], again["fits"], strict=True):
            for p, q in zip(old["parameters"], new["parameters"], strict=True):
                self.assertEqual((old["name"], p["name"]), (new["name"], q["name"]))
                self.assertAlmostEqual(p["value"], q["value"], delta=1e-6 * abs(p["value"]))

    def test_what_is_wrong_is_said_in_a_line(self):
        self.assert_refused(self.fit("transmitance"), 2, "'transmitance'", "density, transmittance, phase")
        self.assert_refused(self.fit(), 2, "WHAT")
        self.assert_refused(self.fit("slab", "--data", SAMPLE), 2, "no --scene or --data")
        self.assert_refused(self.fit("slab", "--tolerance", "0.1"), 2, "go with fit density")
        self.assert_refused(self.fit("slab", "--time", "1"), 2, "go with --data")
        self.assert_refused(self.fit("density", "--range", "0:1"), 2, "no --range")
        for place in ("10,91", "361,0", "nan,0"):
            self.assert_refused(self.fit("density", "--data", SAMPLE, "--column", place), 2, "LON,LAT")
        self.assert_refused(self.fit("slab", "--range", "3:3"), 1, "the range 3:3 is empty")
        self.assert_refused(self.fit("slab", "--range=-3:3"), 1, "negative")
        self.assert_refused(self.fit("slab", "--range", "3"), 2, "two numbers")
        self.assert_refused(self.fit("slab", "-o", self.folder / "a.txt"), 2, "must end in .json")
        self.assert_refused(self.fit("slab", "-o", self.folder / "no" / "a.json"), 1, "no folder")
        self.assertEqual(self.files(), [])


if __name__ == "__main__":
    main()
