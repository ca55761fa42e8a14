# SPDX-License-Identifier: BSD-3-Clause
"""Pictures against the approved ones of Testing/Baseline, which says what must be seen in each."""
import pathlib
import shutil
import sys

from program import ROOT, SAMPLE, ProgramTest, main, pixels, run

APPROVED = ROOT / "Testing" / "Baseline"
LEFT = pathlib.Path(sys.argv[3])  # pictures that differ are left here

# Another compiler or processor rounds otherwise: an edge may pass from one pixel to the next, a shade by a step.
STEP = 3            # of 255, by which a channel may differ anywhere
MOVED_EDGES = 0.005  # share of the pixels that may differ by more


def differing_share(one, other):
    width, height, rows = pixels(one)
    if (width, height) != pixels(other)[:2]:
        return 1.0
    differing = 0
    for row, approved in zip(rows, pixels(other)[2]):
        for x in range(0, 3 * width, 3):
            differing += any(abs(row[x + c] - approved[x + c]) > STEP for c in range(3))
    return differing / (width * height)


class Baseline(ProgramTest):
    def compare(self, name, *arguments):
        picture = self.folder / f"{name}.png"
        self.assert_done(run("render", *arguments, "--size", "320x240", "-o", picture))
        approved = APPROVED / f"{name}.png"
        share = differing_share(picture, approved) if approved.exists() else 1.0
        if share > MOVED_EDGES:
            shutil.copy(picture, LEFT)
            self.fail(f"{name}: {100 * share:.2f} % of the pixels differ; look at {LEFT / picture.name}, and at {approved}")

    def test_styles(self):
        for style in ("surface", "texture", "volume"):
            with self.subTest(style=style):
                self.compare(style, "--data", SAMPLE, "--style", style)

    def test_height_field_clouds(self):
        self.compare("scattered-clouds", ROOT / "Examples" / "Scenes" / "scattered-clouds.yaml")

    def test_a_changed_picture_is_found(self):
        other = self.folder / "other.png"
        self.assert_done(run("render", "--data", SAMPLE, "--style", "surface", "--time", 1, "--size", "320x240", "-o", other))
        self.assertGreater(differing_share(other, APPROVED / "surface.png"), 4 * MOVED_EDGES)


if __name__ == "__main__":
    main()
