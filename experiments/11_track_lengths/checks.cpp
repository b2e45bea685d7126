// SPDX-License-Identifier: LGPL-3.0-or-later
#include "checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <string>

namespace cellwalk::track_lengths {
namespace {

/// True if the crossings lead from the first cell to the last, past the cells of all pieces in their order.
bool is_connected(const Snapshot<3>& snapshot, Cell first, const Row& row) {
  Cell cell = first;
  std::size_t passed = 0;
  const auto pass = [&] { passed += passed < row.cells.size() && row.cells[passed] == cell; };
  pass();
  for (const Half_facet f : row.crossings) {
    if (snapshot.cell_of(f) != cell || snapshot.is_impassable(f)) return false;
    cell = snapshot.neighbour(f);
    pass();
  }
  return cell == row.end.cell && passed == row.cells.size();
}

/// In long doubles the length and the sum are off by less than a thousandth of an ulp of the double.
bool has_right_sum(const Point<3>& from, const Point<3>& to, const Row& row) {
  long double square = 0, sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const long double d = static_cast<long double>(to[k]) - static_cast<long double>(from[k]);
    square += d * d;
  }
  for (const double length : row.lengths) {
    if (!(length >= 0)) return false;
    sum += length;
  }
  const long double length = std::sqrt(square);
  const auto rounded = static_cast<double>(length);
  const double ulp = std::nextafter(rounded, std::numeric_limits<double>::infinity()) - rounded;
  return sum <= length + ulp && (row.end.status == Walk_status::contact || sum >= length - ulp);
}

std::uint64_t digest_of(const Snapshot<3>& snapshot, const Traces& traces) {
  std::uint64_t x = 0;
  for (const std::uint64_t offset : traces.offsets) x = scramble(x ^ offset);
  for (std::size_t i = 0; i < traces.cells.size(); ++i) {
    x = scramble(x ^ snapshot.index(traces.cells[i]));
    x = scramble(x ^ std::bit_cast<std::uint64_t>(traces.lengths[i]));
  }
  return x;
}

bool is_same(const Row& a, const Row& b) {
  return std::ranges::equal(a.cells, b.cells) && std::ranges::equal(a.lengths, b.lengths) &&
         std::ranges::equal(a.crossings, b.crossings) && a.end.status == b.end.status &&
         a.end.cell == b.end.cell && a.end.wall == b.end.wall;
}

/// The judge's verdict on a row, and what becomes of it if the ray is traced alone.
void judge_row(const Tracer<3>& tracer, const Judge& judge, Particle<3> start, const Point<3>& target,
               const Row& row, Check_counts& counts) {
  ++counts.judged;
  counts.judged_pieces += row.cells.size();
  const std::string fault = judge.fault(start.position, target, row);
  if (!fault.empty()) {
    ++counts.wrong;
    const Point<3>& p = start.position;
    fmt::print(stderr, "from {:a} {:a} {:a} to {:a} {:a} {:a}: {}\n", p[0], p[1], p[2], target[0], target[1],
               target[2], fault);
  }
  Traces alone;
  Walk_counts walk_counts;
  tracer.trace(std::span(&start, 1), std::span(&target, 1), alone, walk_counts);
  counts.without_signs += walk_counts.predicates.orientations == 0;
  counts.divided += !is_same(row, row_of(alone, 0));
}

}  // namespace

Check_counts& Check_counts::operator+=(const Check_counts& other) {
  rays += other.rays;
  pieces += other.pieces;
  crossings += other.crossings;
  blocked += other.blocked;
  empty += other.empty;
  broken += other.broken;
  judged += other.judged;
  judged_pieces += other.judged_pieces;
  wrong += other.wrong;
  without_signs += other.without_signs;
  divided += other.divided;
  signs += other.signs;
  fallbacks += other.fallbacks;
  digest = scramble(digest ^ other.digest);
  return *this;
}

Check_counts check(const World& world, const Tracer<3>& tracer, const Judge& judge, const Part& part) {
  const Rays rays = draw(world, part.kind, part.rays, part.seed);
  std::vector<Particle<3>> particles = rays.starts;
  Traces traces;
  Walk_counts walk_counts;
  tracer.trace(particles, rays.targets, traces, walk_counts);
  Check_counts counts;
  counts.rays = rays.size();
  counts.pieces = traces.cells.size();
  counts.crossings = traces.crossings.size();
  counts.signs = walk_counts.predicates.orientations;
  counts.fallbacks = walk_counts.predicates.fallbacks;
  counts.digest = digest_of(world.snapshot(), traces);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Row row = row_of(traces, i);
    counts.blocked += row.end.status == Walk_status::contact;
    counts.empty += static_cast<std::uint64_t>(std::ranges::count(row.lengths, 0.0));
    counts.broken += row.end.status == Walk_status::lost || row.cells.size() != row.lengths.size() ||
                     !is_connected(world.snapshot(), rays.starts[i].cell, row) ||
                     !has_right_sum(rays.starts[i].position, rays.targets[i], row);
    if (i < part.judged) judge_row(tracer, judge, rays.starts[i], rays.targets[i], row, counts);
  }
  return counts;
}

std::uint64_t digest(const World& world, const Tracer<3>& tracer, const Part& part) {
  Rays rays = draw(world, part.kind, part.rays, part.seed);
  Traces traces;
  Walk_counts counts;
  tracer.trace(rays.starts, rays.targets, traces, counts);
  return digest_of(world.snapshot(), traces);
}

}  // namespace cellwalk::track_lengths
