// SPDX-License-Identifier: LGPL-3.0-or-later
// Two bounds that no general method has to reach.
//
//   read_and_write   reads the targets and recorded answers, moves the vertices that are not held, and writes
//                    the answers: the cost of the replay itself
//   unit_cubes       arithmetic for unit cubes only: for each body the cells of its box, then the solid cubes
//                    among them against segments
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "body_box.h"
#include "families.h"
#include "replay.h"

namespace cellwalk::figure_8 {
namespace {

class Read_and_write : public Peer {
 public:
  std::string name() const override { return "read_and_write"; }
  unsigned answer_bits() const override { return segment_bits; }
  void prepare(const Trace& trace) override { positions_ = trace.start_positions; }
  Counts count(const Trace& trace, std::span<std::uint8_t> answers) override {
    replay(trace, answers);
    return {};
  }
  void replay(const Trace& trace, std::span<std::uint8_t> answers) override {
    std::size_t at = 0;
    for (std::size_t step = 0; step < trace.steps; ++step)
      for (std::size_t v = 0; v < positions_.size(); ++v, ++at) {
        const auto bits = static_cast<std::uint8_t>(trace.answers[at] & segment_bits);
        answers[at] = bits;
        if (!bits) positions_[v] = trace.targets[at];
      }
  }

 private:
  std::vector<Point<3>> positions_;
};

struct Cubes {
  std::array<std::int32_t, 3> cells;
  std::vector<std::uint8_t> solid;
};

class Unit_cubes {
 public:
  static constexpr unsigned bits = segment_bits;
  explicit Unit_cubes(std::shared_ptr<Cubes> cubes) : cubes_(std::move(cubes)) {}

  void prepare(const Trace&) {}
  template <class Counter>
  bool start(std::size_t, const Point<3>* positions, const Point<3>* targets, Counter&) {
    return is_free(body_box(positions, targets), [](const Point<3>&) { return true; });
  }
  template <class Counter>
  unsigned vertex(std::size_t, std::size_t v, const Point<3>* positions, const Point<3>& target, Counter&) {
    return four_segments(v, positions, target, [&](const Point<3>& a, const Point<3>& b) {
      return !is_free(box_of(a, b), [&](const Point<3>& low) { return meets_cube(a, b, low); });
    });
  }

 private:
  static std::int32_t floor_of(double x) {
    const auto i = static_cast<std::int32_t>(x);
    return i - (x < i);
  }
  /// False if the box leaves the grid or holds a part of a solid cube that counts.
  template <class Counts_in>
  bool is_free(const Box& box, const Counts_in& counts_in) const {
    std::array<std::int32_t, 3> low, high;
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = floor_of(box.low[k]);
      high[k] = floor_of(box.high[k]);
      if (low[k] < 0 || high[k] >= cubes_->cells[k]) return false;
    }
    for (std::int32_t z = low[2]; z <= high[2]; ++z)
      for (std::int32_t y = low[1]; y <= high[1]; ++y)
        for (std::int32_t x = low[0]; x <= high[0]; ++x) {
          const auto at = static_cast<std::size_t>(x + cubes_->cells[0] * (y + cubes_->cells[1] * z));
          if (cubes_->solid[at] &&
              counts_in({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)}))
            return false;
        }
    return true;
  }
  static bool meets_cube(const Point<3>& a, const Point<3>& b, const Point<3>& low) {
    double enter = 0, leave = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const double d = b[k] - a[k];
      if (d == 0) {
        if (a[k] < low[k] || a[k] > low[k] + 1) return false;
        continue;
      }
      const double s = (low[k] - a[k]) / d, t = (low[k] + 1 - a[k]) / d;
      enter = std::max(enter, std::min(s, t));
      leave = std::min(leave, std::max(s, t));
    }
    return enter <= leave;
  }

  std::shared_ptr<Cubes> cubes_;
};

}  // namespace

void add_bounds(const Grid_world& world, Peers& peers) {
  peers.push_back(std::make_unique<Read_and_write>());
  Build build;
  const auto cubes = measured_build(build, "cell", [&] {
    auto c = std::make_shared<Cubes>();
    c->cells = {static_cast<std::int32_t>(world.trace->nx), static_cast<std::int32_t>(world.trace->ny),
                static_cast<std::int32_t>(world.trace->nz)};
    c->solid.assign(world.cell_count(), 0);
    for (const std::uint32_t cell : world.trace->obstacles) c->solid[cell] = 1;
    return c;
  });
  add_peer(peers, "unit_cubes", Unit_cubes(cubes), build);
}

}  // namespace cellwalk::figure_8
