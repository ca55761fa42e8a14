# SPDX-License-Identifier: BSD-3-Clause
"""Cloud Volume over a connection: a server that renders sends the same picture as ParaView alone. Last argument: PVSERVER."""
import socket
import subprocess
import sys
import unittest

import numpy
from paraview import simple

import plugin
from test_views import show


def difference(a, b):
    return numpy.abs(a - b).mean()


class Server(plugin.PluginTest):
    def setUp(self):
        super().setUp()
        self.alone = show("Cloud Volume", True)
        self.clouds = difference(self.alone, show("Outline", True))
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        self.server = subprocess.Popen([sys.argv[4], f"--server-port={self.port}"], stdout=subprocess.PIPE, text=True)
        self.addCleanup(self.server.kill)
        next(line for line in self.server.stdout if "Accepting connection" in line)

    def tearDown(self):
        simple.Disconnect()
        super().tearDown()

    def test_a_server_renders_the_same_picture(self):
        simple.Connect("127.0.0.1", self.port)
        for remote in (True, False):
            simple.LoadPlugin(str(plugin.PLUGIN), remote=remote, ns=vars(simple))
        for threshold in (0, 1e6):  # in MB: rendered by the server; by the client, from the server's data
            with self.subTest(threshold=threshold):
                picture = show("Cloud Volume", True, threshold)
                # Outlines of the ball differ, by the samples of a pixel.
                self.assertLess(difference(picture, self.alone), 0.1 * self.clouds)


if __name__ == "__main__":
    plugin.main()
