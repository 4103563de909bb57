#!/usr/bin/python3
"""Documents name files that are there."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
NAMED = re.compile(r"`((?:[\w.-]+/)+[\w.-]+\.(?:[ch]pp|py|md|toml|fbs))`")


class Documents(unittest.TestCase):
    def test_the_page_of_equations_names_files_that_are_there(self):
        names = NAMED.findall((ROOT / "docs/equations.md").read_text())
        self.assertGreater(len(names), 30)
        for name in names:
            self.assertTrue((ROOT / name).is_file(), name)

    def test_members_that_it_names_are_in_the_files_beside_them(self):
        named = re.findall(r"`(?:System::)?(\w+)` in `([^`]+)`", (ROOT / "docs/equations.md").read_text())
        self.assertGreater(len(named), 3)
        for member, file in named:
            self.assertIn(member, (ROOT / file).read_text(), file)


if __name__ == "__main__":
    unittest.main()
