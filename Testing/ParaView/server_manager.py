# SPDX-License-Identifier: BSD-3-Clause
"""The plugin's server-manager XML as Python sees it."""
import pathlib
import xml.etree.ElementTree as ElementTree


def xml_files(root):
    return sorted(pathlib.Path(root, "Utilities", "ParaView").glob("*.xml"))


def proxies(root):
    """(group, element) of every proxy that the XML defines."""
    for file in xml_files(root):
        for group in ElementTree.parse(file).getroot().iter("ProxyGroup"):
            for element in group:
                if element.get("class"):
                    yield group.get("name"), element


def properties(proxy):
    return [element for element in proxy if element.tag.endswith("VectorProperty")]
