#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Experiments whose trials ranks share: the same tables as of one process.

usage: test_mpi_experiments.py BUILD_DIR [MPIRUN]
"""

from ranks_case import RanksCase, main


class Experiments(RanksCase):
    def expect_same_tables(self, program, *options, ranks=(2,), says_same=True):
        words = [self.build / "experiments" / program, *options]
        alone = self.run_ranks(1, [*words, "--out", "alone"])
        self.assertEqual(alone.returncode, 0, alone.stderr)
        expected = self.files(self.folder / "alone")
        for number in ranks:
            with self.subTest(ranks=number):
                shared = self.run_ranks(number, [*words, "--out", str(number)])
                self.assertEqual(shared.returncode, 0, shared.stderr)
                if says_same:
                    self.assertEqual(shared.stdout, alone.stdout)
                self.assertEqual(self.files(self.folder / str(number)), expected)
        return expected

    def test_exact_versus_float(self):
        files = self.expect_same_tables("02_exact_versus_float/exact_versus_float", "--part", "walks", "--part", "sweeps", "--part",
                                        "flights", "--part", "failures", "--motions", "300", "--sweeps", "51", "--moves", "1000")
        self.assertTrue([name for name in files if name.startswith("escape_")])
        self.assertGreater(len([name for name in files if name.startswith("failures/")]), 5)

    def test_degenerate_worlds(self):
        self.expect_same_tables("05_degenerate_worlds/degenerate_worlds", "--motions", "120", "--threads", "2", ranks=(2, 3))

    def test_small_obstacles(self):
        self.expect_same_tables("03_small_obstacles/small_obstacles", "--quick")

    def test_contact_search(self):
        self.expect_same_tables("04_contact_search/contact_search", "--quick")

    def test_moving_walls(self):
        self.expect_same_tables("07_moving_walls/moving_walls", "--quick", "--counts", "--scenes", "coarse", says_same=False)  # it says times

    def test_a_failure_is_printed_once(self):
        (self.folder / "file").write_text("")
        done = self.run_ranks(2, [self.build / "experiments/05_degenerate_worlds/degenerate_worlds", "--out", "file/folder"])
        self.assertEqual((done.returncode, done.stderr.count("degenerate_worlds: ")), (1, 1), done.stderr)


if __name__ == "__main__":
    main()
