#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Times the compiler on a program that includes the one header of an installed library; fails if it takes too long.

usage: time_compile.py SECONDS COMPILER INCLUDE_FOLDER SOURCE

Processor time, so that other load on the machine counts less.
"""

import resource
import subprocess
import sys


def main():
    most, compiler, include, source = float(sys.argv[1]), *sys.argv[2:5]
    subprocess.run([compiler, "-std=c++20", "-O3", "-DNDEBUG", f"-I{include}", "-c", source, "-o", "/dev/null"], check=True)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = used.ru_utime + used.ru_stime
    print(f"{source}: compiled in {seconds:.2f} s of processor time; {most:g} s are allowed")
    return seconds > most


if __name__ == "__main__":
    sys.exit(main())
