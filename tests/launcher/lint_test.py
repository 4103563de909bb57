"""What `./fpi lint` finds, on a project of its own with planted faults."""

import contextlib
import io
import shutil
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from launcher.setup import lint


class Lint(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        patch = mock.patch.object(lint, "ROOT", self.root)
        patch.start()
        self.addCleanup(patch.stop)

    def write(self, name: str, text: str) -> None:
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def test_a_line_of_text_that_is_too_long_is_named_and_one_that_cannot_be_broken_is_not(self):
        wide = "word " * 30
        self.write("docs/a.md", f"short\n{wide}\n| {wide} |\n`{wide}`\n```\n{wide}\n```\n")
        self.write("build/b.md", wide)  # is not of the project
        self.assertEqual(list(lint.long_lines()), ["docs/a.md:2: a line of at most 120 columns is required; got 150"])

    def test_letters_are_counted_as_they_are_seen(self):
        self.assertEqual(lint.width("ẋ = u\u0308"), 5)

    def test_a_structure_test_that_fails_is_named_with_its_last_words(self):
        self.write("tests/structure/x_test.py", "import sys\nsys.exit('FAILED (failures=1)')\n")
        self.write("tests/structure/y_test.py", "")
        self.assertEqual(list(lint.structure_faults()), ["tests/structure/x_test.py: FAILED (failures=1); run it to see"])

    @unittest.skipUnless(shutil.which("clang-format"), "clang-format is not installed")
    def test_a_source_out_of_format_is_named_with_the_remedy(self):
        self.write(".clang-format", "BasedOnStyle: Google\n")
        self.write("a.cpp", "int  f( ){return 1;}\n")
        self.write("b.cpp", "int f() { return 1; }\n")
        self.assertEqual(list(lint.unformatted()), ["a.cpp: not formatted; run: clang-format -i a.cpp"])

    @unittest.skipUnless(shutil.which("pyflakes3"), "pyflakes3 is not installed")
    def test_a_fault_in_python_is_named(self):
        self.write("a.py", "import os\n")
        self.assertEqual(list(lint.python_faults()), ["a.py:1:1: 'os' imported but unused"])

    def test_all_steps_are_taken_and_counted(self):
        with mock.patch.object(lint, "python_faults", lambda: iter(["a fault"])), \
             mock.patch.object(lint, "unformatted", lambda: iter(())), contextlib.redirect_stdout(io.StringIO()) as out:
            self.assertEqual(lint.lint(), ["a fault"])
        self.assertIn("Python: 1 fault\n", out.getvalue())
        self.assertIn("line length: no faults\n", out.getvalue())


if __name__ == "__main__":
    unittest.main()
