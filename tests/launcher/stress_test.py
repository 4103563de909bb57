"""`./fpi stress` with a stand-in for the program that runs the cases."""

import json
import unittest

from fakes import FakeTest

CASES = '''#!/usr/bin/python3
import json, os, signal, sys
words = sys.argv[1:]
if "--list" in words:
    for k in range(int(words[words.index("--list") + 1])):
        print(f"slide-{k}\\ta body that slides")
    sys.exit(0)
name = words[-1]
if name == "slide-1":
    os.kill(os.getpid(), signal.SIGSEGV)
if name == "nothing":
    print("interface_stress: a case named as --list does is required; got nothing", file=sys.stderr)
    sys.exit(2)
refused = name == "slide-2"
print("a line of the log")
print(json.dumps({"case": name, "failure": "too many" if refused else "", "refused": refused, "noise": 0.001 * len(words),
                  "condition": 10.0, "seconds": 1.0, "parameters": {}}))
'''


class Stress(FakeTest):
    def setUp(self):
        super().setUp()
        self.program("interface_stress", CASES)

    def test_a_case_that_crashes_is_a_failure_with_the_command_that_repeats_it(self):
        status, out, err = self.fpi("stress", "--cases", "4", "--seed", "7", "--quick", "--out", "all.json")
        self.assertEqual(status, 1)
        self.assertRegex(out, r"slide +4 +2 +1 +1 .*a body that slides")
        self.assertIn("slide-1 failed: its process ended with signal 11 (SIGSEGV)\n"
                      "  ./fpi stress interface --seed 7 --quick --only slide-1", err)
        self.assertIn("slide-2 refused: too many", err)
        written = json.loads((self.folder / "all.json").read_text())
        self.assertEqual([case["case"] for case in written["cases"]], [f"slide-{k}" for k in range(4)])

    def test_one_case_says_all_it_knows_and_a_refusal_is_no_failure(self):
        status, out, err = self.fpi("stress", "--only", "slide-2", "--json", "--out", "all.json")
        self.assertEqual(status, 0, err)
        self.assertEqual(json.loads(out)[0]["failure"], "too many")

    def test_a_case_that_there_is_not_is_refused(self):
        for subject in ("interface", "coupling"):
            status, _, err = self.fpi("stress", subject, "--only", "nothing", "--out", "all.json")
            self.assertEqual(status, 1)
            self.assertIn("a case named as --list does is required", err)

    def test_a_coupled_run_without_results_is_a_failure_with_the_command_that_repeats_it(self):
        status, _, err = self.fpi("stress", "coupling", "--only", "one-0", "--out", "all.json")
        self.assertEqual(status, 1)
        self.assertIn("one-0 failed: ", err)
        self.assertIn("./fpi stress coupling --seed 1 --only one-0", err)


if __name__ == "__main__":
    unittest.main()
