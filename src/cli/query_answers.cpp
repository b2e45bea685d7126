// SPDX-License-Identifier: LGPL-3.0-or-later
#include "cli/query_answers.h"

#include <cellwalk/io/csv.h>
#include <cellwalk/walk/locate.h>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <limits>

#include "cli/progress.h"

namespace cellwalk::cli {
namespace {

constexpr const char* kind_names[] = {"vertex", "edge", "facet"};
constexpr std::size_t batch = 1 << 16;  // rows between two looks at the progress bar

Status to_status(Walk_status status) {
  switch (status) {
    case Walk_status::arrived:
      return Status::free;
    case Walk_status::contact:
      return Status::contact;
    case Walk_status::lost:
      break;
  }
  return Status::lost;
}

template <class Kernel, int D>
Answer<D> answer(const Snapshot<D>& snapshot, const Locator<D>& locator, const Move_query<D>& motion,
                 const Walk_options& options, Walk_counts& counts) {
  if (!motion.invalid.empty()) return {};
  const auto& [from, to] = motion.points;
  const Location<D> start = locator.locate(from);
  if (start.status != Location_status::free) return {Status::outside, {}};
  Answer<D> best;
  for (const Cell cell : start.cells) {
    const Particle<D> particle{from, cell, start.dimension, 0};
    const Walk_result<D> result = walk<Kernel>(snapshot, particle, to, counts, options);
    const bool further = result.status == Walk_status::arrived ||
                         (result.status == Walk_status::contact && best.status == Status::contact &&
                          result.contact->time > best.walk.contact->time);
    if (best.status == Status::invalid || further) best = {to_status(result.status), result};
    if (start.sides <= 1 || best.status == Status::free) break;
  }
  return best;
}

template <class Kernel, int D>
std::vector<Answer<D>> answer_all(const Snapshot<D>& snapshot, const std::vector<Move_query<D>>& motions,
                                  Walk_strategy strategy, Walk_counts& total) {
  const Locator<D> locator(snapshot);
  std::vector<Answer<D>> answers(motions.size());
  tbb::enumerable_thread_specific<Walk_counts> counts;
  Progress progress("walking", motions.size());
  for (std::size_t begin = 0; begin < motions.size(); begin += batch) {
    const std::size_t end = std::min(begin + batch, motions.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(begin, end), [&](const auto& range) {
      for (std::size_t i = range.begin(); i != range.end(); ++i)
        answers[i] = answer<Kernel>(snapshot, locator, motions[i], {strategy, nullptr}, counts.local());
    });
    progress.update(end);
  }
  for (const Walk_counts& c : counts) total += c;
  return answers;
}

/// Not a number, which a table leaves empty.
constexpr double absent = std::numeric_limits<double>::quiet_NaN();

/// Three fields, without negative zeros; in the plane the third is empty.
template <std::size_t D>
std::array<double, 3> fields(const std::array<double, D>& p) {
  std::array<double, 3> f{absent, absent, absent};
  std::transform(p.begin(), p.end(), f.begin(), [](double x) { return x + 0.0; });
  return f;
}

}  // namespace

template <int D>
std::vector<Answer<D>> answer_motions(const Snapshot<D>& snapshot, const std::vector<Move_query<D>>& motions,
                                      Kernel_choice kernel, Walk_strategy strategy, Walk_counts& counts) {
  switch (kernel) {
    case Kernel_choice::exact:
      return answer_all<Exact>(snapshot, motions, strategy, counts);
    case Kernel_choice::lazy:
      return answer_all<Lazy>(snapshot, motions, strategy, counts);
    case Kernel_choice::double_precision:
      return answer_all<Double>(snapshot, motions, strategy, counts);
    case Kernel_choice::float_precision:
      break;
  }
  return answer_all<Float>(snapshot, motions, strategy, counts);
}

template <int D>
void write_answers(const std::string& path, const Snapshot<D>& snapshot,
                   const std::vector<Move_query<D>>& motions, const std::vector<Answer<D>>& answers) {
  io::Csv_writer table(path,
                       {"row", "status", "time", "x", "y", "z", "kind", "nx", "ny", "nz", "cells", "cell"});
  for (std::size_t row = 0; row < answers.size(); ++row) {
    const auto& [status, walk] = answers[row];
    const bool walked = status != Status::outside && status != Status::invalid;
    double time = absent;
    std::array<double, 3> end{absent, absent, absent}, normal = end;
    const char* kind = "";
    if (status == Status::free) {
      time = 1;
      end = fields(motions[row].points[1]);
    } else if (status == Status::contact) {
      time = walk.contact->time;
      end = fields(walk.contact->point);
      normal = fields(walk.contact->normal);
      kind = kind_names[static_cast<std::size_t>(walk.contact->kind)];
    }
    table.row(row, status_names[static_cast<std::size_t>(status)], time, end[0], end[1], end[2], kind,
              normal[0], normal[1], normal[2], walked ? walk.cells : 0,
              walked ? std::to_string(snapshot.index(walk.cell)) : std::string{});
  }
  table.commit();
}

template std::vector<Answer<2>> answer_motions(const Snapshot<2>&, const std::vector<Move_query<2>>&,
                                               Kernel_choice, Walk_strategy, Walk_counts&);
template std::vector<Answer<3>> answer_motions(const Snapshot<3>&, const std::vector<Move_query<3>>&,
                                               Kernel_choice, Walk_strategy, Walk_counts&);
template void write_answers(const std::string&, const Snapshot<2>&, const std::vector<Move_query<2>>&,
                            const std::vector<Answer<2>>&);
template void write_answers(const std::string&, const Snapshot<3>&, const std::vector<Move_query<3>>&,
                            const std::vector<Answer<3>>&);

}  // namespace cellwalk::cli
