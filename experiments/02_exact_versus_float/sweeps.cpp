// SPDX-License-Identifier: LGPL-3.0-or-later
#include "sweeps.h"

#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/edge/three_segments.h>
#include <cellwalk/internal/edge/triangle.h>
#include <cellwalk/internal/io/csv.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "common/confidence.h"
#include "common/seeds.h"
#include "common/shared.h"
#include "edge/sweep_judge.h"
#include "grid.h"
#include "kernels.h"
#include "scene.h"

namespace cellwalk::exact_float {
namespace {

constexpr std::uint64_t sweeps_per_world = 100;

enum class Verdict { right, missed, false_contact, stuck, wrong_time, wrong_chain, count };
constexpr std::array<const char*, 6> verdict_names{"right", "missed",     "false_contact",
                                                   "stuck", "wrong_time", "wrong_chain"};
using Verdicts = std::array<std::uint64_t, static_cast<std::size_t>(Verdict::count)>;

/// triangle and three_segments of the library, then walks of each kernel.
constexpr std::size_t method_count = 2 + kernel_count;

struct Counts {
  std::uint64_t sweeps = 0, blocked = 0;
  std::array<Verdicts, method_count> verdicts{};

  void operator+=(const Counts& other) {
    sweeps += other.sweeps;
    blocked += other.blocked;
    for (std::size_t m = 0; m < method_count; ++m)
      for (std::size_t v = 0; v < verdict_names.size(); ++v) verdicts[m][v] += other.verdicts[m][v];
  }
};

/// An edge pq and the move of p, as the library made it.
template <int D>
struct Move {
  Particle<D> p, q, moved;
  Chain before;
  std::vector<Cell> visited;
  std::vector<Half_facet> crossed;
  bool is_blocked = false;  ///< p was

  Vertex_path<D> path() const { return {p, moved, visited, crossed, is_blocked}; }
};

Verdict of_answer(bool is_free, bool may_be_free, bool may_be_blocked) {
  if (is_free) return may_be_free ? Verdict::right : Verdict::missed;
  return may_be_blocked ? Verdict::right : Verdict::false_contact;
}

Verdict of_fault(test::Sweep_fault fault) {
  switch (fault) {
    case test::Sweep_fault::false_block:
      return Verdict::false_contact;
    case test::Sweep_fault::false_free:
      return Verdict::missed;
    case test::Sweep_fault::wrong_time:
      return Verdict::wrong_time;
    case test::Sweep_fault::wrong_chain:
      return Verdict::wrong_chain;
    default:
      return Verdict::right;
  }
}

template <int D>
class Sweep_trial {
 public:
  Sweep_trial(const Setting& setting, std::uint64_t seed, const std::bitset<kernel_count>& walking)
      : setting_(setting),
        walking_(walking),
        random_(seed),
        scene_(make_world<D>(setting, seed)),
        chains_(scene_.world.soup) {}

  Counts run(std::uint64_t sweeps) {
    while (counts_.sweeps < sweeps) sweep_once();
    return counts_;
  }

 private:
  void sweep_once() {
    const Motion<D> motion = make_motion(scene_.world, setting_, random_);
    const auto p = scene_.particle_at(motion.from, random_);
    const auto q = scene_.particle_at(other_end(motion.from), random_);
    // The other end lies inside a cell: in which one a walk must arrive is then beyond doubt.
    if (!p || !q || q->dimension != D) return;
    Edge_counts counts;
    const Chain_result<D> edge = find_chain(scene_.snapshot, *p, *q, counts.walk);
    if (edge.contact) return;
    const oracle::Case<D> of_p = scene_.motion_of(*p, motion.to);
    if (of_p.truth.choices > 0) return;  // what becomes of the edge depends on the side that p takes
    Move<D> move{*p, *q, *p, edge.chain, {}, {}, false};
    const auto walked =
        cellwalk::move(scene_.snapshot, move.moved, motion.to, counts.walk, {&move.visited, &move.crossed});
    move.is_blocked = walked.status != Walk_status::arrived;
    move.moved.position = motion.to;
    move.moved.cell = move.visited.back();
    judge(move);
  }

  Point<D> other_end(const Point<D>& p) {
    Point<D> q = p;
    for (const Vector<D>& column : scene_.world.map.columns) q = q + random_.real(-1, 1) * column;
    return q;
  }

  void judge(const Move<D>& move) {
    const auto motion = test::motion_of(scene_.world.soup, scene_.snapshot, move.path(), move.q, move.before);
    const oracle::Outcomes outcomes = chains_.judge(motion);
    const bool may_be_free = !move.is_blocked && outcomes.may_be_free();
    const bool may_be_blocked = move.is_blocked || !outcomes.blocks.empty();
    ++counts_.sweeps;
    counts_.blocked += !may_be_free;
    Edge_counts counts;
    const Sweep_result<D> triangle =
        sweep_triangle(scene_.snapshot, move.path(), move.q, move.before, counts);
    note(0, of_fault(test::fault_of(chains_, motion, outcomes, scene_.snapshot, triangle)));
    const bool is_third_free =
        !move.is_blocked &&
        !check_third_segment<D>(scene_.snapshot, move.path(), move.q, move.before, counts).contact;
    note(1, of_answer(is_third_free, may_be_free, may_be_blocked));
    for (std::size_t k = 0; k < kernel_count; ++k) {
      if (!walking_[k]) continue;
      const Walk_status status = walk_both(kernels_[k], move);
      note(2 + k, status == Walk_status::lost
                      ? Verdict::stuck
                      : of_answer(status == Walk_status::arrived, may_be_free, may_be_blocked));
    }
  }

  /// The way of p and the third segment, as walks; a walk that arrives in another cell than that of q is a
  /// contact.
  Walk_status walk_both(const Kernel<D>& kernel, const Move<D>& move) const {
    Walk_counts counts;
    const Walk_result<D> of_p =
        kernel.walk(scene_.snapshot, move.p, move.moved.position, counts, kernel.strategy, {});
    if (of_p.status != Walk_status::arrived) return of_p.status;
    const Particle<D> temporary{move.moved.position, of_p.cell, of_p.dimension, 0};
    const Walk_result<D> third =
        kernel.walk(scene_.snapshot, temporary, move.q.position, counts, kernel.strategy, {});
    if (third.status == Walk_status::arrived && third.cell != move.q.cell) return Walk_status::contact;
    return third.status;
  }

  void note(std::size_t method, Verdict verdict) {
    ++counts_.verdicts[method][static_cast<std::size_t>(verdict)];
  }

  const Setting setting_;
  const std::bitset<kernel_count> walking_;
  Random random_;
  const Scene<D> scene_;
  const oracle::Chain_oracle<D> chains_;
  const std::array<Kernel<D>, kernel_count> kernels_ = kernels<D>();
  Counts counts_;
};

template <int D>
Counts sweep_at(const Grid_point& point, const Run_options& options) {
  const std::uint64_t worlds = (options.count + sweeps_per_world - 1) / sweeps_per_world;
  const auto counts = experiments::shared_trials(worlds, [&](std::uint64_t w) {
    const std::uint64_t seed = experiments::part_seed(
        options.seed, fmt::format("sweeps {} {} {}", D, point.variable, point.value), w);
    return Sweep_trial<D>(point.setting, seed, options.kernels)
        .run(std::min(sweeps_per_world, options.count - w * sweeps_per_world));
  });
  Counts sum;
  for (const Counts& c : counts) sum += c;
  return sum;
}

template <int D>
void sweep_dimension(const Run_options& options, io::Csv_writer& table, Exact_summary& summary) {
  const auto tested = kernels<D>();
  for (const Grid_point& point : degeneracy_points()) {
    const Counts counts =
        options.kept->of<Counts>(fmt::format("sweeps {}D {} {}", D, point.variable, point.value),
                                 [&] { return sweep_at<D>(point, options); });
    summary.motions += counts.sweeps;
    for (std::size_t m = 0; m < method_count; ++m) {
      if (m > 1 && !options.kernels[m - 2]) continue;
      const Verdicts& v = counts.verdicts[m];
      const std::uint64_t wrong = counts.sweeps - v[0];
      const auto interval = experiments::confidence_interval(wrong, counts.sweeps);
      const std::string name = m == 0   ? "triangle"
                               : m == 1 ? "three_segments"
                                        : fmt::format("walks_{}", tested[m - 2].name);
      table.row(D, point.variable, point.value, name, counts.sweeps, counts.blocked, wrong, interval.low,
                interval.high, v[1], v[2], v[3], v[4], v[5]);
      if (m > 0) continue;
      summary.by_exact += counts.sweeps;
      summary.wrong += wrong;
    }
    fmt::print("sweeps {}D {} {}: {} of {} blocked; missed by triangle {}, three segments {}\n", D,
               point.variable, point.value, counts.blocked, counts.sweeps, counts.verdicts[0][1],
               counts.verdicts[1][1]);
    std::fflush(stdout);
  }
}

}  // namespace

Exact_summary run_sweeps(const Run_options& options) {
  std::vector<std::string> columns{"dimension", "variable", "value", "method", "sweeps",
                                   "blocked",   "wrong",    "low",   "high"};
  columns.insert(columns.end(), verdict_names.begin() + 1, verdict_names.end());
  io::Csv_writer table(options.folder / "sweeps.csv", columns);
  Exact_summary summary;
  sweep_dimension<2>(options, table, summary);
  sweep_dimension<3>(options, table, summary);
  table.commit();
  return summary;
}

}  // namespace cellwalk::exact_float
