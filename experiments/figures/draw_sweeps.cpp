// SPDX-License-Identifier: LGPL-3.0-or-later
// Draws the figures of docs/sweep.md, and writes the numbers behind them.
#include <cellwalk/kernel/error.h>

#include <cstdio>
#include <exception>

#include "figures.h"

int main(int argc, char** argv) {
  using namespace cellwalk;
  if (argc != 2) {
    std::fprintf(stderr, "usage: draw_sweeps OUT_DIR\n");
    return static_cast<int>(Error_code::usage);
  }
  try {
    std::filesystem::create_directories(argv[1]);
    figures::draw_sweep_2d(argv[1]);
    figures::draw_sweep_3d(argv[1]);
    figures::draw_face_3d(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "draw_sweeps: %s\n", error.what());
    return static_cast<int>(Error_code::other);
  }
  return 0;
}
