# SPDX-License-Identifier: Apache-2.0
"""The release program is built so that an error in memory is hard to make use of."""
import os
import subprocess
import unittest

from theatron_process import PROGRAM


def readelf(option):
    return subprocess.run(["readelf", "--wide", option, PROGRAM], check=True, capture_output=True, text=True,
                          env={**os.environ, "LC_ALL": "C"}).stdout


class Hardening(unittest.TestCase):
    def test_the_program_lies_anywhere_in_memory(self):
        self.assertRegex(readelf("--file-header"), r"Type:\s+DYN")
        self.assertRegex(readelf("--dynamic"), r"FLAGS_1.*\bPIE\b")

    def test_addresses_of_functions_cannot_be_overwritten(self):
        self.assertIn("GNU_RELRO", readelf("--program-headers"))
        self.assertRegex(readelf("--dynamic"), r"FLAGS_1.*\bNOW\b|\(BIND_NOW\)")

    def test_the_stack_is_not_executable(self):
        self.assertRegex(readelf("--program-headers"), r"GNU_STACK\s.*\sRW\s")

    def test_stack_and_copies_are_checked(self):
        imported = readelf("--dyn-syms")
        self.assertIn("__stack_chk_fail", imported)
        self.assertRegex(imported, r"__(memcpy|memmove|memset|snprintf|read)_chk")

    def test_no_library_is_loaded_that_only_a_benchmark_needs(self):
        self.assertNotRegex(readelf("--dynamic"), r"(?i)NEEDED.*(opencv|charls)")


if __name__ == "__main__":
    unittest.main()
