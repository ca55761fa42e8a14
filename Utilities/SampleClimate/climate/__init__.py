# SPDX-License-Identifier: BSD-3-Clause
"""A made-up global atmosphere with believable clouds: neither a forecast nor a reanalysis."""
