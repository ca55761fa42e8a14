#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The server-manager XML shows every reader, source and filter with all that can be set: test_xml.py ROOT."""
import pathlib
import re
import sys
import unittest

from server_manager import properties, proxies

ROOT = pathlib.Path(sys.argv.pop())
SETTER = re.compile(r"vtkSet(?:Clamp|FilePath|Vector\d)?Macro\(\s*(\w+)")
LAYERS = ("IO", "Sources", "Filters", "Sparse")  # all of whose classes are shown
PARENTS = re.compile(r"^class \w+_EXPORT \w+\s*:\s*public (vtkCloud\w+)", re.MULTILINE)
GIVEN_OTHERWISE = {"SetGround"}  # by AutomaticGround
ALWAYS_ON = {"Visibility"}  # a picture draws the bodies that it is given
OF_THE_SERIES = {"FileName"}  # the writer of a file series gives it to the writer of one


def headers(*layers):
    return {path.stem: path.read_text() for layer in layers for path in (ROOT / "Modules" / layer).glob("vtkCloud*.h")}


def declarations():
    """What each class that is shown declares, with its parents of this project."""
    texts = headers(*LAYERS, "Rendering")
    for name, text in texts.items():
        parent = PARENTS.search(text)
        texts[name] = text + (texts.get(parent[1], "") if parent else "")
    return {proxy.get("class"): texts[proxy.get("class")] for _, proxy in proxies(ROOT) if proxy.get("class") in texts}


class ServerManagerXML(unittest.TestCase):
    def test_every_class_is_shown(self):
        shown = {proxy.get("class") for _, proxy in proxies(ROOT)}
        self.assertEqual(sorted(set(headers(*LAYERS)) - shown), [])

    def test_everything_that_can_be_set_is_a_property(self):
        texts = declarations()
        for group, proxy in proxies(ROOT):
            commands = {element.get("command") for element in proxy}
            otherwise = ALWAYS_ON | (OF_THE_SERIES if group == "internal_writers" else set())
            for name in set(SETTER.findall(texts.get(proxy.get("class"), ""))) - otherwise:
                with self.subTest(proxy.get("name"), parameter=name):
                    self.assertIn("Set" + name, commands)

    def test_every_command_is_a_method(self):
        texts = declarations()
        for _, proxy in proxies(ROOT):
            text = texts.get(proxy.get("class"))
            for element in properties(proxy) if text else ():
                for attribute in ("command", "clean_command", "set_number_command"):
                    method = element.get(attribute)
                    if method and method not in ("SetInputArrayToProcess", "SetInputConnection"):
                        with self.subTest(proxy.get("name"), method=method):
                            known = {"Set" + name for name in SETTER.findall(text)} | set(re.findall(r"\b(\w+)\(", text))
                            self.assertIn(method, known)

    def test_everything_has_help_and_a_domain(self):
        for _, proxy in proxies(ROOT):
            with self.subTest(proxy.get("name")):
                self.assertIsNotNone(proxy.find("Documentation"))
            for element in properties(proxy):
                if element.get("information_only"):
                    continue
                with self.subTest(proxy.get("name"), property=element.get("name")):
                    self.assertIsNotNone(element.find("Documentation"))
                    list_ = element.get("repeat_command") and element.find("ArraySelectionDomain") is None
                    free = list_ or (element.tag == "StringVectorProperty" and element.get("default_values") == "")
                    self.assertTrue(free or any(child.tag.endswith("Domain") for child in element))

    def test_groups_name_properties(self):
        for _, proxy in proxies(ROOT):
            known = {element.get("name") for element in proxy}
            for group in proxy.findall("PropertyGroup"):
                for member in group:
                    with self.subTest(proxy.get("name"), group=group.get("label")):
                        self.assertIn(member.get("name"), known)

    def test_everything_is_in_the_menu(self):
        for group, proxy in proxies(ROOT):
            if group in ("sources", "filters"):
                with self.subTest(proxy.get("name")):
                    hints = proxy.find("Hints")
                    menu = hints.find("ShowInMenu")
                    self.assertTrue(hints.find("ReaderFactory") is not None or menu.get("category") == "Nephoscope")


if __name__ == "__main__":
    unittest.main()
