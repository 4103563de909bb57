"""What an error becomes for the user, and what a JSON document may hold."""

import contextlib
import errno
import io
import json
import math
import os
import unittest
from pathlib import Path
from unittest import mock

from launcher import ending
from launcher.common import Refusal, naming, printable


def told(error: BaseException) -> str:
    try:
        raise error
    except BaseException as raised:
        return str(ending.refusal_of(raised))


class Errors(unittest.TestCase):
    def test_a_file_is_named_with_what_to_do(self):
        self.assertEqual(told(OSError(errno.ENOSPC, "No space left on device", "r/a.png")),
                         "r/a.png cannot be used: No space left on device: free some space")
        self.assertEqual(told(OSError(errno.ENOSPC, "No space left on device")),
                         "the output cannot be used: No space left on device: free some space")

    def test_a_full_disk_is_named_by_its_file(self):
        with self.assertRaises(OSError) as raised, naming(Path("r/sweep.csv")):
            raise OSError(errno.ENOSPC, "No space left on device")
        self.assertTrue(told(raised.exception).startswith("r/sweep.csv cannot be used"))

    def test_a_missing_module_and_memory_are_no_faults(self):
        self.assertIn("must import h5py", told(ModuleNotFoundError("No module named 'h5py'", name="h5py")))
        self.assertIn("more memory", told(MemoryError()))

    def test_a_fault_of_the_launcher_says_where(self):
        self.assertRegex(told(KeyError("x")), r"has a fault.*KeyError: 'x' \(.*ending_test.py:\d+\)")

    def test_an_interruption_that_a_library_passes_on_is_one(self):
        self.assertEqual(ending.refusal_of(KeyboardInterrupt()).status, 130)

    def test_what_a_terminal_takes_for_a_command_is_shown(self):
        self.assertEqual(printable("a\x1b[2Jé\n\x07"), "a\\x1b[2Jé\n\\x07")


class Documents(unittest.TestCase):
    def test_numbers_and_names_that_json_has_not_are_replaced(self):
        text = ending.document_of({"k": math.inf, "list": [math.nan, 1.5], os.fsdecode(b"caf\xe9"): "μ"})
        self.assertEqual(json.loads(text), {"k": None, "list": [None, 1.5], "caf\ufffd": "μ"})

    def test_a_failure_is_one_document(self):
        def fail(_words):
            raise Refusal("no", 2)

        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err), mock.patch.object(ending, "listen"), \
             mock.patch.object(ending, "hold_stops"):
            self.assertEqual(ending.end(["run", "--json"], fail), 2)
        self.assertEqual((json.loads(out.getvalue()), err.getvalue()), ({"status": "failed", "reason": "no"}, ""))


if __name__ == "__main__":
    unittest.main()
