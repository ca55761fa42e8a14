# SPDX-License-Identifier: BSD-3-Clause
"""Animations: frames that are complete or absent, resumed, shared by processes, and a film of them."""
import os
import signal
import subprocess
import time

from program import PROGRAM, ROOT, SAMPLE, ProgramTest, cloudy_share, main, pixels, run

DAY = ROOT / "Examples" / "Scenes" / "day.yaml"
SCENE = """
picture: {{ size: [96, 72] }}
data: {{ file: {data}, exaggeration: 30 }}
keyframes:
  - {{ at: 0, longitude: -40, latitude: 20 }}
  - {{ at: 1, longitude: -30, towardSun: [1, 0, 0] }}
bodies:
  - {{ type: globe }}
  - {{ type: {body}, value: 0.15 }}
"""


class Animate(ProgramTest):
    def scene(self, body="surface"):
        path = self.folder / (body + ".yaml")
        path.write_text(SCENE.format(data=SAMPLE, body=body))
        return path

    def animate(self, scene, *options, **keywords):
        return run("animate", scene, "-o", self.folder / "out", *options, **keywords)

    def frames(self):
        return sorted(p.name for p in (self.folder / "out").iterdir() if p.suffix == ".png")

    def test_frames_are_numbered_move_and_are_resumed_to_the_bit(self):
        scene = self.scene("texture")
        self.assert_done(self.animate(scene, "--frames", 3, "--to", 1))
        names = ["frame-0000.png", "frame-0001.png", "frame-0002.png"]
        self.assertEqual(self.frames(), names)
        self.assertEqual(sorted(os.listdir(self.folder / "out")), ["animation.txt", *names])
        contents = [(self.folder / "out" / name).read_bytes() for name in names]
        self.assertEqual(len(set(contents)), 3)
        for name in names:
            self.assertEqual(pixels(self.folder / "out" / name)[:2], (96, 72))
            self.assertGreater(cloudy_share(self.folder / "out" / name), 0.03)
        # The middle is made anew, alone, and is the same; the others are not touched.
        (self.folder / "out" / names[1]).unlink()
        before = (self.folder / "out" / names[0]).stat().st_mtime_ns
        done = self.animate(scene, "--frames", 3, "--to", 1)
        self.assert_done(done)
        self.assertIn("1 of them drawn now", done.stderr)
        self.assertEqual((self.folder / "out" / names[1]).read_bytes(), contents[1])
        self.assertEqual((self.folder / "out" / names[0]).stat().st_mtime_ns, before)

    def test_a_cycle_has_no_end(self):
        # 2 of 4 frames of a cycle are those of a cycle of 2: the last frame is not the first again.
        words = (ROOT / "Examples" / "Scenes" / "cylinder.yaml").read_text().replace("[1764, 1280]", "[64, 48]")
        scene = self.folder / "cycle.yaml"
        scene.write_text(words)
        contents = {}
        for frames in (2, 4):
            self.assert_done(run("animate", scene, "-o", self.folder / str(frames), "--frames", frames))
            folder = self.folder / str(frames)
            contents[frames] = [(folder / f"frame-{n:04}.png").read_bytes() for n in range(frames)]
        self.assertEqual(contents[4][::2], contents[2])
        self.assertEqual(len(set(contents[4])), 4)

    def test_an_interrupt_leaves_whole_frames_and_processes_share(self):
        scene = self.scene()
        words = [PROGRAM, "animate", str(scene), "-o", str(self.folder / "out"), "--frames", "8", "--to", "1"]
        with subprocess.Popen(words, stderr=subprocess.PIPE) as process:
            until = time.monotonic() + 120
            while time.monotonic() < until and not (self.folder / "out" / "frame-0001.png").exists():
                time.sleep(0.02)
            process.send_signal(signal.SIGINT)
            process.communicate()
        self.assertIn(process.returncode, (130, 0))
        for name in self.frames():
            self.assertEqual(pixels(self.folder / "out" / name)[:2], (96, 72))
        with subprocess.Popen(words, stderr=subprocess.DEVNULL) as other:
            self.assert_done(self.animate(scene, "--frames", 8, "--to", 1))
            self.assertEqual(other.wait(240), 0)
        self.assertEqual(len(self.frames()), 8)
        left = [name for name in os.listdir(self.folder / "out") if name.startswith(".")]
        self.assertEqual([name for name in left if name.endswith(".png")], [])

    def test_a_film_by_ffmpeg_or_the_line_for_it(self):
        scene = self.scene()
        done = self.animate(scene, "--frames", 1, "--movie", env={"PATH": "/nowhere"})
        self.assert_done(done)
        self.assertIn("ffmpeg is not installed; with it, run: ffmpeg", done.stderr)
        tool = self.folder / "ffmpeg"
        tool.write_text('#!/bin/sh\nfor last; do :; done\necho "$@" > "$last"\n')
        tool.chmod(0o755)
        done = self.animate(scene, "--frames", 1, "--fps", 12.5, "--movie", env={"PATH": f"{self.folder}:/bin:/usr/bin"})
        self.assert_done(done)
        self.assertIn("-framerate 12.5", (self.folder / "out" / "movie.mp4").read_text())
        tool.write_text("#!/bin/sh\nexit 3\n")
        done = self.animate(scene, "--frames", 1, "--fps", 12.5, "--movie", env={"PATH": f"{self.folder}:/bin:/usr/bin"})
        self.assertEqual(done.returncode, 1)
        self.assertIn("ffmpeg could not make it (exit code 3)", done.stderr)

    def test_what_cannot_be_animated(self):
        scene = self.scene()
        self.assert_done(self.animate(scene, "--frames", 1))
        self.assert_refused(self.animate(scene, "--frames", 2), 1, "holds frames of another scene, size, number or time")
        self.assert_refused(run("animate", scene, "-o", scene), 1, "is not a folder")
        done = run("animate", scene, "-o", self.folder / "late", "--from", 2, "--to", 1)
        self.assertEqual(done.returncode, 1)
        self.assertIn("begin at '2' and end at '1', which is not later", done.stderr)
        self.assertFalse((self.folder / "late").exists(), "the folder is free for the right times")
        for late in ("2001-10-01T18:00:01", "1e9", "yesterday"):
            done = run("animate", scene, "-o", self.folder / late, "--to", late)
            self.assertEqual(done.returncode, 1)
            self.assertIn(f"'{late}' is no time within the file's steps 0 (2001-10-01T00:00:00) to 3", done.stderr)
        still = self.folder / "still.yaml"
        still.write_text("camera: { position: [0, 0, 900], target: [9, 0, 900] }\nbodies: [{ type: terrain }]\n")
        self.assert_refused(run("animate", still, "-o", self.folder / "b", "--to", "1"), 2, "--to", "still.yaml has none")
        scene.write_text(scene.read_text().replace("at: 1", "at: 0"))
        self.assert_refused(run("animate", scene, "-o", self.folder / "b"), 2, "'at' of keyframe 2 is not greater")

    def test_times_between_the_steps_as_dates_or_seconds(self):
        scene = self.scene()
        pictures = []
        for n, (begin, end) in enumerate((("2001-10-01T03", "2001-10-01T04:30"), ("10800", "16200"))):
            self.assert_done(run("animate", scene, "-o", self.folder / str(n), "--frames", 2, "--from", begin, "--to", end))
            pictures.append([(self.folder / str(n) / f"frame-000{frame}.png").read_bytes() for frame in (0, 1)])
        self.assertEqual(pictures[0], pictures[1])
        self.assertNotEqual(pictures[0][0], pictures[0][1])

    def test_how_long_a_texture_lives_is_the_scenes(self):
        scene = self.scene("texture")
        words = scene.read_text()
        pictures = []
        for hours in ("4", "400"):
            scene.write_text(words + f"animation: {{ restartPeriod: {hours} }}\n")
            self.assert_done(run("animate", scene, "-o", self.folder / hours, "--frames", 1, "--from", "2001-10-01T08"))
            pictures.append((self.folder / hours / "frame-0000.png").read_bytes())
        self.assertNotEqual(*pictures)
        for hours, problem in (("0", "it must be from 0.1 to 100000"), ("-3", "it must be"), ("long", "must be a number, in hours")):
            scene.write_text(words + f"animation: {{ restartPeriod: {hours} }}\n")
            self.assert_refused(run("animate", scene, "-o", self.folder / "no"), 2, "'restartPeriod'", problem)

    def test_the_example(self):
        done = self.animate(DAY, "--frames", 1, "--size", "96x72")
        self.assert_done(done)
        self.assertGreater(cloudy_share(self.folder / "out" / "frame-0000.png"), 0.03)


if __name__ == "__main__":
    main()
