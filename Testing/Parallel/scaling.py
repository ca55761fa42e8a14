#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Strong and weak scaling of a picture over processes, the table and the chart of Utilities/Doc/parallel.md:
scaling.py [--quick] RANK_SCALING [SCALING_CHART FOLDER]

Strong: the same picture by 1 to 4 processes. Weak: as many times the pixels as there are processes. One thread a process; the
fastest of three pictures. Efficiency: of as many cores as there are processes, or of all if there are fewer. --quick: small
pictures by 1 and 2, to see that it runs."""
import math
import os
import pathlib
import subprocess
import sys

DATA = pathlib.Path(__file__).resolve().parents[2] / "Data"
ALONE = {"OMPI_MCA_plm": "isolated", "OMPI_MCA_btl": "self,vader"}  # one machine, no network


def measure(program, ranks, file, width, height):
    """Seconds of reading and contouring, seconds of the picture, MB: the most of any process; MB sent among them."""
    done = subprocess.run(["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", str(ranks), program, DATA / file,
                           str(width), str(height)], check=True, capture_output=True, text=True, env=os.environ | ALONE)
    return [float(word) for word in done.stdout.split()]


def rows(program, counts, file, width, height):
    for name, grows in ("strong", False), ("weak", True):
        first = None
        for ranks in counts:
            edge = math.sqrt(ranks) if grows else 1
            read, draw, memory, sent = measure(program, ranks, file, round(edge * width), round(edge * height))
            first = first or draw
            share = first / draw * (ranks if grows else 1) / min(ranks, os.cpu_count())
            yield f"| {name} | {ranks} | {read:.2f} | {draw:.2f} | {100 * share:.0f} % | {memory:.0f} | {sent:.0f} |"


def main():
    arguments = sys.argv[1:]
    quick = "--quick" in arguments
    programs = [word for word in arguments if word != "--quick"]
    counts, file, size = ([1, 2], "sample_climate.nc", (64, 48)) if quick else (
        [1, 2, 3, 4], "sample_clouds.nc", (1024, 768))
    print("| scaling | processes | read and contour, s | picture, s | efficiency | memory a process, MB | sent, MB |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    table = []
    for row in rows(programs[0], counts, file, *size):
        print(row, flush=True)
        table.append(row)
    if len(programs) == 3:
        subprocess.run(programs[1:], check=True, input="\n".join(table), text=True)
    return 0 if len(table) == 2 * len(counts) else 1


if __name__ == "__main__":
    sys.exit(main())
