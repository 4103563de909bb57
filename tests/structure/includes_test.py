#!/usr/bin/python3
"""Dependencies point one way: reads every include and fails where one breaks docs/architecture.md."""

import graphlib
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
# The rooms of a library, lowest first: each may see itself and those below it; files outside of them stand on top.
ROOMS = {
    "fluid_server/fluid": ["base", "geometry", "linear", "mesh", "cut", "discretisation", "solve", "measure"],
    "dem_server/dem": ["base", "walls", "model", "neighbours", "contact", "lubrication", "integrate"],
    "coupler": ["coupling", "step", "results", "setup", "run"],
}
# Folders whose headers are named from there, as in `#include "dem/contact.hpp"`.
INCLUDE_FOLDERS = "common", "proto", "fluid_server", "dem_server", "coupler", ""
# A library of others → the sources that may include it.
CONFINED = {
    "toml.hpp": r"common/scene/\w+\.cpp",
    "muParser.h": r"common/core/expression\.cpp",
    "spdlog/": r"common/core/log\.cpp",
    "hdf5.h": r"common/output/\w+\.cpp",
    "zmq": r"proto/.*\.cpp|proto/(transport/)?\w*(socket|zmq|curve)\w*\.hpp",
    "fpi_generated.h": r"proto/codec/.*",
    "umfpack.h": r"fluid_server/fluid/linear/umfpack\.cpp",
    "dmumps_c.h": r"fluid_server/fluid/linear/mumps\.cpp",
}
INCLUDE = re.compile(r'^\s*#include\s+[<"]([^>"]+)[>"]', re.M)


def sources():
    for folder in ("common", "proto", "fluid_server", "dem_server", "coupler"):
        for path in sorted((ROOT / folder).rglob("*.[ch]pp")):
            yield path.relative_to(ROOT).as_posix(), INCLUDE.findall(path.read_text())


def ours(include: str, of: str) -> str | None:
    """The file of ours that an include names."""
    own = (pathlib.PurePosixPath(of).parent / include).as_posix()
    candidates = [own, *((pathlib.PurePosixPath(folder) / include).as_posix() for folder in INCLUDE_FOLDERS)]
    return next((c for c in candidates if (ROOT / c).is_file()), None)


def unit(path: str) -> str:
    """A header and its source are one."""
    return path.rsplit(".", 1)[0]


def units() -> dict[str, set[str]]:
    """Each unit with those that it includes."""
    arrows: dict[str, set[str]] = {}
    for name, includes in sources():
        named = {unit(file) for include in includes if (file := ours(include, name))}
        arrows.setdefault(unit(name), set()).update(named - {unit(name)})
    return arrows


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

    def test_no_header_comes_back_to_itself(self):
        try:
            list(graphlib.TopologicalSorter(units()).static_order())
        except graphlib.CycleError as error:
            self.fail("units include one another: " + " → ".join(reversed(error.args[1])))

    def test_rooms_include_only_what_is_below_them(self):
        for folder, rooms in ROOMS.items():
            library = pathlib.PurePosixPath(folder).name
            for name, includes in sources():
                if not name.startswith(folder + "/"):
                    continue
                room = pathlib.PurePosixPath(name).relative_to(folder).parts[0]
                below = rooms[:rooms.index(room) + 1] if room in rooms else rooms
                for include in includes:
                    parts = include.split("/")
                    inner = parts[1] if parts[0] == library and len(parts) == 3 else parts[0]
                    if inner in rooms:
                        self.assertIn(inner, below, f"{name} includes {include}")

    def test_rooms_are_all_there_is(self):
        for folder, rooms in ROOMS.items():
            found = {path.name for path in (ROOT / folder).iterdir() if path.is_dir()}
            self.assertEqual(found, set(rooms), folder)

    def test_foreign_libraries_stay_in_their_sources(self):
        for library, allowed in CONFINED.items():
            users = [name for name, includes in sources() if any(i.startswith(library) for i in includes)]
            self.assertTrue(users, f"nothing includes {library}: is the rule out of date?")
            for name in users:
                self.assertRegex(name, f"^({allowed})$", f"{name} includes {library}")


if __name__ == "__main__":
    unittest.main()
