# SPDX-License-Identifier: BSD-3-Clause
"""Constants of the clipped transmittance, with what is not known of them: fit.py"""
import sys

import nephoscope

table = nephoscope.fit("transmittance", (0, 2))
for name, parameter, value, error in zip(table["Fit"], table["Parameter"], table["Value"], table["StandardError"]):
    print(f"{name:40} {parameter:5} {value:10.5f} +- {error:.5f}")
sys.exit(0 if (table["HeldOutRMS"] < 0.1).all() else 1)
