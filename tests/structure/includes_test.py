#!/usr/bin/python3
"""Dependencies point one way: reads every include and fails where one breaks docs/architecture.md."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Folder → headers of ours that it may include, by their first folder ("" is the folder itself).
ALLOWED = {
    "common/core": {"core"},
    "common/scene": {"core", "scene"},
    "common/grains": {"core", "scene", "grains"},
    "common/output": {"core", "output"},
    "proto": {"core", "proto"},
    "fluid_server/fluid": {"core", "scene", "fluid"},
    "dem_server/dem": {"core", "scene", "dem"},
    "coupler/coupling": {"core", "scene", "coupling"},
}
# A library of others → the sources that may include it.
CONFINED = {
    "toml.hpp": r"common/scene/\w+\.cpp",
    "muParser.h": r"common/core/expression\.cpp",
    "spdlog/": r"common/core/log\.cpp",
    "hdf5.h": r"common/output/\w+\.cpp",
    "zmq": r"proto/.*\.cpp|proto/(transport/)?\w*(socket|zmq|curve)\w*\.hpp",
    "fpi_generated.h": r"proto/codec/.*",
    "umfpack.h": r"fluid_server/fluid/umfpack\.cpp",
    "dmumps_c.h": r"fluid_server/fluid/mumps\.cpp",
}
INCLUDE = re.compile(r'^\s*#include\s+[<"]([^>"]+)[>"]', re.M)


def sources():
    for folder in ("common", "proto", "fluid_server", "dem_server", "coupler"):
        for path in sorted((ROOT / folder).rglob("*.[ch]pp")):
            yield path.relative_to(ROOT).as_posix(), INCLUDE.findall(path.read_text())


class Includes(unittest.TestCase):
    def test_libraries_include_only_what_they_may_see(self):
        seen = 0
        for name, includes in sources():
            folder = next((f for f in ALLOWED if name.startswith(f + "/")), None)
            if folder is None:
                continue
            for include in includes:
                first = include.split("/")[0]
                if first in {"core", "scene", "grains", "output", "proto", "fluid", "dem", "coupling"} and "/" in include:
                    seen += 1
                    self.assertIn(first, ALLOWED[folder], f"{name} includes {include}")
        self.assertGreater(seen, 50)

    def test_foreign_libraries_stay_in_their_sources(self):
        for library, allowed in CONFINED.items():
            users = [name for name, includes in sources() if any(i.startswith(library) for i in includes)]
            self.assertTrue(users, f"nothing includes {library}: is the rule out of date?")
            for name in users:
                self.assertRegex(name, f"^({allowed})$", f"{name} includes {library}")


if __name__ == "__main__":
    unittest.main()
