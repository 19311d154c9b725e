# SPDX-License-Identifier: BSD-3-Clause
"""A case of the stress matrix that runs the program: what verdict.h is to those that call it."""

import os


class Verdict:
    """Collects what a case measured; at its end one line "number, criterion, measured, pass" between tabs is appended to
    the file that TESSERA_STRESS_TABLE names. Any exception on the way is a FAIL."""

    def __init__(self, number, criterion):
        self.number, self.criterion, self.measured, self.passes = number, criterion, [], True

    def none_wrong(self, name, wrong, tried):
        """COUNT(0): wrong ones among so many, of which there must be some."""
        self.measured.append(f"{len(wrong)} of {tried} {name}")
        self.passes = self.passes and not wrong and tried > 0
        if wrong:
            print(f"case {self.number}: {name}:", *wrong[:20], sep="\n  ")

    def __enter__(self):
        return self

    def __exit__(self, kind, error, trace):
        self.passes = self.passes and error is None
        table = os.environ.get("TESSERA_STRESS_TABLE")
        if table:
            with open(table, "a") as file:
                print(self.number, self.criterion, "; ".join(self.measured), "pass" if self.passes else "FAIL",
                      sep="\t", file=file)
        assert self.passes or error, f"case {self.number}: {'; '.join(self.measured)}"
