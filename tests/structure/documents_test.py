#!/usr/bin/python3
"""Documents name files that are there."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
NAMED = re.compile(r"`((?:[\w.-]+/)+[\w.-]+\.(?:[ch]pp|py|md|toml|fbs))`")


JOURNAL = re.compile(r"(?:Fluid Mech\.|Comput\. Phys\.|Comput\. Fluids|Phys\. Rev\. \w+\.?|Granular Matter|Powder Technology|"
                     r"R\. Soc\.(?: Lond\.)? A|J\. E|I France) (\d+)")
LINK = re.compile(r"\]\(([^)#\s]+?)(#[\w-]+)?\)")


class Documents(unittest.TestCase):
    def test_links_between_documents_lead_somewhere(self):
        seen = 0
        for page in [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").rglob("*.md")]:
            for target, _ in LINK.findall(page.read_text()):
                if "://" not in target:
                    seen += 1
                    self.assertTrue((page.parent / target).exists(), f"{page.relative_to(ROOT)}: {target}")
        self.assertGreater(seen, 20)

    def test_every_journal_that_a_scene_names_is_in_the_bibliography(self):
        works = (ROOT / "docs/bibliography.md").read_text()
        for scene in sorted((ROOT / "configs").rglob("*.toml")):
            source = re.search(r'^source = "(.*)"', scene.read_text(), re.M)[1]
            volumes = JOURNAL.findall(source)
            for volume in volumes:
                self.assertRegex(works, rf"\b{volume}\b", f"{scene.name}: {source}")

    def test_files_that_documents_name_are_there(self):
        for page, least in (("docs/equations.md", 30), ("CONTRIBUTING.md", 20), ("docs/architecture.md", 1)):
            names = [name for name in NAMED.findall((ROOT / page).read_text()) if "NAME" not in name]
            self.assertGreaterEqual(len(names), least, page)
            for name in names:
                self.assertTrue((ROOT / name).is_file(), f"{page}: {name}")

    def test_members_that_it_names_are_in_the_files_beside_them(self):
        pages = "".join((ROOT / page).read_text() for page in ("docs/equations.md", "CONTRIBUTING.md"))
        named = re.findall(r"`(?:System::)?(\w+)` in `([^`]+)`", pages)
        self.assertGreater(len(named), 3)
        for member, file in named:
            self.assertIn(member, (ROOT / file).read_text(), file)


if __name__ == "__main__":
    unittest.main()
