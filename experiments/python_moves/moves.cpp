// SPDX-License-Identifier: LGPL-3.0-or-later
// The moves of compare.py from C++: one thread, one loop. Each line on stdin starts a round, whose
// nanoseconds of processor time a move are printed, so that rounds of both languages alternate; at the end
// the results are printed for comparison.
//
// usage: python_moves CELLS POINTS
//   CELLS    tetrahedra in CELLS^3 cubes, jitter 0.1
//   POINTS   a file of doubles, starts and then two sets of targets
#include <cellwalk/cellwalk.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

using namespace cellwalk;

namespace {

std::vector<Point<3>> read_points(const char* path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  std::vector<Point<3>> points(static_cast<std::size_t>(file.tellg()) / sizeof(Point<3>));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(points.data()),
            static_cast<std::streamsize>(points.size() * sizeof(Point<3>)));
  if (!file) {
    std::fprintf(stderr, "%s cannot be read\n", path);
    std::exit(1);
  }
  return points;
}

/// What a caller keeps of each move.
struct Move_outcome {
  std::vector<Walk_status> status;
  std::vector<double> time;
  std::vector<Cell> cell;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: python_moves CELLS POINTS\n");
    return 2;
  }
  Simplex_grid_options<3> grid;
  grid.cells.fill(static_cast<std::uint32_t>(std::atoi(argv[1])));
  grid.jitter = 0.1;
  const auto environment = Environment<3>::build(tetrahedral_grid(grid), {.keep_map = false});
  const Snapshot<3>& snapshot = environment.snapshot();
  const std::vector<Point<3>> points = read_points(argv[2]);
  const std::size_t n = points.size() / 3;

  std::vector<Particle<3>> particles;
  {
    const Locator<3> locator(snapshot);
    for (std::size_t i = 0; i < n; ++i) particles.push_back(locator.particle_at(points[i]).value());
  }
  Move_outcome outcome{std::vector<Walk_status>(n), std::vector<double>(n), std::vector<Cell>(n)};
  Walk_counts counts;
  std::uint64_t contacts = 0;
  std::string line;
  for (std::size_t round = 0; std::getline(std::cin, line); ++round) {
    const Point<3>* const targets = points.data() + (1 + round % 2) * n;
    const std::clock_t start = std::clock();
    for (std::size_t i = 0; i < n; ++i) {
      const Walk_result<3> result = move(snapshot, particles[i], targets[i], counts);
      outcome.status[i] = result.status;
      outcome.time[i] = result.contact ? result.contact->time : 1;
      outcome.cell[i] = result.cell;
      contacts += result.contact.has_value();
    }
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    std::printf("%.17g\n", seconds * 1e9 / static_cast<double>(n));
    std::fflush(stdout);
  }
  std::uint64_t cell_sum = 0;
  for (const Particle<3>& particle : particles) cell_sum += snapshot.index(particle.cell);
  std::printf("%llu %llu %llu\n", static_cast<unsigned long long>(contacts),
              static_cast<unsigned long long>(counts.crossings), static_cast<unsigned long long>(cell_sum));
}
