#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a made-up global atmosphere with clouds on 19 hybrid levels as NetCDF.

It looks like weather and obeys the balances that tests check, but it is neither a forecast nor a reanalysis.
"""
import argparse
import sys

from climate.atmosphere import Atmosphere
from climate.netcdf import FIELDS, SURFACE_FIELDS, Writer


def arguments(argv):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--nlon", type=int, default=128, help="points along a parallel, 16 or more (default 128)")
    parser.add_argument("--nlat", type=int, default=64, help="points along a meridian, 8 or more (default 64)")
    parser.add_argument("--steps", type=int, default=4, help="time steps (default 4)")
    parser.add_argument("--hours", type=int, default=6, help="hours between steps, a multiple of 3 (default 6)")
    parser.add_argument("--seed", type=int, default=6, help="of the random numbers (default 6)")
    parser.add_argument("--only", nargs="+", choices=[*FIELDS, *SURFACE_FIELDS], metavar="NAME",
                        help="write these variables and the surface pressure, not all")
    parser.add_argument("-o", "--output", default="sample_climate.nc", help="file to write (default sample_climate.nc)")
    options = parser.parse_args(argv)
    if options.nlon < 16 or options.nlat < 8:
        parser.error("--nlon must be at least 16 and --nlat at least 8")
    if options.steps < 1 or options.hours < 3 or options.hours % 3:
        parser.error("--steps must be at least 1, and --hours a multiple of 3")
    if options.seed < 0:
        parser.error("--seed must not be negative")
    return options


def main(argv=None):
    options = arguments(argv)
    atmosphere = Atmosphere(options.nlon, options.nlat, options.seed)
    command = ("sample_climate.py --nlon {0.nlon} --nlat {0.nlat} --steps {0.steps} --hours {0.hours} "
               "--seed {0.seed}").format(options)
    if options.only:
        command += " --only " + " ".join(options.only)
    try:
        writer = Writer(options.output, atmosphere, command, options.only)
    except OSError as error:
        print(f"sample_climate.py: cannot write {options.output}: {error.strerror}", file=sys.stderr)
        return 1
    try:
        for index in range(options.steps):
            seconds = 3600.0 * options.hours * index
            writer.write(index, seconds, atmosphere.step(seconds))
            if sys.stderr.isatty():
                print(f"\rstep {index + 1} of {options.steps}", end="\n" * (index + 1 == options.steps), file=sys.stderr)
    except BaseException:
        writer.abandon()
        raise
    writer.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
