// SPDX-License-Identifier: LGPL-3.0-or-later
// Walks of many particles, then the lengths of each. A motion that planes do not decide is walked and
// measured on its own.
#include <cellwalk/internal/kernel/check_finite.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/internal/walk/signs.h>
#include <cellwalk/internal/walk/star.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/walk/trace.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "block_walk.h"
#include "lane_kinds.h"
#include "lane_planes.h"
#include "piece_lengths.h"
#include "row_lengths.h"

namespace cellwalk {

void Traces::clear() {
  offsets.assign(1, 0);
  crossing_offsets.assign(1, 0);
  cells.clear();
  lengths.clear();
  crossings.clear();
  ends.clear();
}

template <int D>
struct Tracer<D>::Planes {
  const Snapshot<D>* snapshot;
  std::uint64_t epoch;
  detail::Lane_planes planes;
  const detail::Lane_functions& functions;
};

namespace {

/// One call of trace().
template <int D>
class Trace_call {
 public:
  Trace_call(const Snapshot<D>& snapshot, const detail::Lane_planes& planes,
             const detail::Lane_functions& functions, Traces& traces, Walk_counts& counts)
      : snapshot_(snapshot),
        planes_(planes),
        functions_(functions),
        traces_(traces),
        counts_(counts),
        walks_(snapshot, planes, functions),
        segments_(detail::lane_error * planes.size),
        together_(functions, segments_.lanes()),
        alone_(functions, segments_.lanes()),
        pieces_(traces.cells.size()),
        crossings_(traces.crossings.size()) {}

  /// Appends the rows, and returns the state of those particles that arrive, in order.
  std::vector<Particle<D>> run(std::span<const Particle<D>> particles, std::span<const Point<D>> targets) {
    std::vector<Particle<D>> moved(particles.begin(), particles.end());
    for (std::size_t begin = 0; begin < particles.size(); begin += detail::rows_of_block) {
      const std::size_t count = std::min(detail::rows_of_block, particles.size() - begin);
      const auto rows = particles.subspan(begin, count);
      walks_.run(rows, targets.subspan(begin, count));
      segments_.set<D>(rows, targets.subspan(begin, count), functions_);
      expected_ = 0;
      for (std::size_t i = 0; i < count; ++i) expected_ += pieces_at_most(i);
      make_room(0);
      for (std::size_t i = 0; i < count; ++i) {
        if (i % rows_together == 0) measure_together(i, std::min(i + rows_together, count));
        append(i, targets[begin + i], moved[begin + i]);
      }
    }
    traces_.cells.resize(pieces_);
    traces_.lengths.resize(pieces_);
    traces_.crossings.resize(crossings_);
    return moved;
  }

 private:
  /// So many that their lengths stay in the cache until they are appended.
  static constexpr std::size_t rows_together = 32;

  std::size_t pieces_at_most(std::size_t i) const { return walks_.count_of_met(walks_.row(i)) + 1; }

  /// Makes room for so many pieces and crossings, and those expected of the rest of the block.
  void make_room(std::size_t more) {
    const std::size_t pieces = pieces_ + more + expected_ + detail::lane_room,
                      crossings = crossings_ + more + expected_;
    if (traces_.cells.size() < pieces) {
      traces_.cells.resize(pieces);
      traces_.lengths.resize(pieces);
    }
    if (traces_.crossings.size() < crossings) traces_.crossings.resize(crossings);
  }

  /// \param i its number in the block
  void append(std::size_t i, const Point<D>& target, Particle<D>& particle) {
    const detail::Lane_row& row = walks_.row(i);
    Trace_end& end = traces_.ends.emplace_back();
    if (particle.cell == Cell::none)
      end.status = Walk_status::lost;
    else if (row.verdict == detail::Lane_verdict::undecided || !append_certified(i, target, particle, end))
      append_exact(i, target, particle, end);
    traces_.offsets.push_back(pieces_);
    traces_.crossing_offsets.push_back(crossings_);
    expected_ -= pieces_at_most(i);
  }

  /// Measures rows of the block whose walks are decided.
  void measure_together(std::size_t first, std::size_t end) {
    together_.clear();
    for (std::size_t i = first; i < end; ++i) {
      const detail::Lane_row& row = walks_.row(i);
      if (row.verdict == detail::Lane_verdict::undecided) continue;
      at_[i % rows_together] =
          together_.add(i, {planes_.planes.data(), walks_.met(row), detail::lane_slots,
                            walks_.count_of_met(row), row.verdict == detail::Lane_verdict::blocked});
    }
    together_.measure();
  }

  /// \pre its walk is decided and measured
  /// \return false if not all lengths are certain
  bool append_certified(std::size_t i, const Point<D>& target, Particle<D>& particle, Trace_end& end) {
    const detail::Lane_row& row = walks_.row(i);
    const bool is_blocked = row.verdict == detail::Lane_verdict::blocked;
    const std::size_t met = walks_.count_of_met(row), passed = is_blocked ? met - 1 : met,
                      pieces = passed + 1;
    const std::size_t at = at_[i % rows_together];
    if (!together_.are_certain(at, pieces)) return false;
    for (std::size_t k = 0; k < pieces; k += detail::lane_room)  // more than the row has: quicker
      std::copy_n(together_.at(at + k), detail::lane_room, traces_.lengths.data() + pieces_ + k);
    const unsigned* const facets = walks_.met(row);
    const bool is_by_four = snapshot_.uniform_blocks() == 1;  // cells have four half-facets each
    Cell* const cells = traces_.cells.data() + pieces_;
    Half_facet* const crossings = traces_.crossings.data() + crossings_;
    for (std::size_t k = 0; k < passed; ++k) {
      const Half_facet f{facets[detail::lane_slots * k]};
      cells[k] = is_by_four ? Cell{to_index(f) / 4} : snapshot_.cell_of(f);
      crossings[k] = f;
    }
    cells[passed] = Cell{row.cell};
    pieces_ += pieces;
    crossings_ += passed;
    ++counts_.walks;
    counts_.stays += passed == 0 && !is_blocked;
    counts_.crossings += passed;
    end = {is_blocked ? Walk_status::contact : Walk_status::arrived, Cell{row.cell},
           is_blocked ? Half_facet{facets[detail::lane_slots * passed]} : Half_facet::none};
    if (!is_blocked) particle = {target, end.cell, D, passed == 0 ? particle.aimed : std::uint16_t{0}};
    return true;
  }

  void append_exact(std::size_t i, const Point<D>& target, Particle<D>& particle, Trace_end& end) {
    visited_.clear();
    exits_.clear();
    crossed_.clear();
    Walk_options options;
    options.visited = &visited_;
    options.exits = &exits_;
    options.crossed = &crossed_;
    options.locates_contact = false;
    const Point<D> from = particle.position;
    const Walk_result<D> result = move(snapshot_, particle, target, counts_, options);
    end = {result.status, result.cell, result.contact ? result.contact->facet : Half_facet::none};
    make_room(std::max(visited_.size(), crossed_.size()));
    std::copy(crossed_.begin(), crossed_.end(), traces_.crossings.data() + crossings_);
    crossings_ += crossed_.size();
    if (from == target) return;
    met_.resize(std::max(met_.size(), exits_.size() + detail::lane_room));
    for (std::size_t k = 0; k < exits_.size(); ++k) met_[k] = facet_at(visited_[k], exits_[k], from, target);
    Float_point<D> y;
    const bool are_bounded = snapshot_.frame().map(from, y);  // as lengths by planes require
    const double* const measured = lengths_alone(i, exits_.size(), visited_.size());
    for (std::size_t k = 0; k < visited_.size(); ++k) {
      const bool is_certain = measured[k] > 0 && are_bounded;
      if (!is_certain && k == 0 && is_at_exit(from)) continue;
      const double length =
          is_certain ? measured[k] : detail::length_of_piece<D>(snapshot_, from, target, exits_, k);
      if (length < 0) continue;
      traces_.cells[pieces_] = visited_[k];
      traces_.lengths[pieces_++] = length;
    }
  }

  /// The lengths of the pieces of row i of the block, if it meets the planes of the first facets of met_ one
  /// after the other: 0 for those that are not certain.
  const double* lengths_alone(std::size_t i, std::size_t met, std::size_t pieces) {
    alone_.clear();
    const std::size_t at = alone_.add(i, {planes_.planes.data(), met_.data(), 1, met, met == pieces});
    alone_.measure();
    return alone_.at(at);
  }

  /// A facet whose plane the motion meets where it leaves a cell, and nowhere else: at a ridge or vertex, of
  /// the facets of the cell there the one to which the motion is steepest. (If it runs in all of them, the
  /// error of its place is not bounded.)
  unsigned facet_at(Cell cell, const Cell_exit& exit, const Point<D>& from, const Point<D>& to) const {
    if (exit.facet != Half_facet::none) return to_index(exit.facet);
    const Cell_view<D> view = snapshot_.view(cell);
    Half_facet best = Half_facet::none;
    double steepest = 0;
    for (std::size_t k = 0; k < view.facet_count(); ++k) {
      if (!detail::facet_contains(view, k, exit.u, exit.v)) continue;
      const Half_facet facet = Snapshot<D>::half_facet(cell, k);
      const detail::Lane_plane& plane = planes_.planes[to_index(facet)];
      double slope = 0;
      for (std::size_t axis = 0; axis < D; ++axis) slope += plane.high[axis] * (to[axis] - from[axis]);
      if (best != Half_facet::none && !(std::abs(slope) > steepest)) continue;
      best = facet;
      steepest = std::abs(slope);
    }
    return to_index(best);
  }

  /// True if the motion leaves its first cell where it starts.
  bool is_at_exit(const Point<D>& from) const {
    if (exits_.empty()) return false;
    const Cell_exit& exit = exits_[0];
    Walk_counts counts;  // the sign is none of the walk
    if (exit.facet != Half_facet::none)
      return detail::side<Exact>(snapshot_.view(visited_[0]), snapshot_.facet_of(exit.facet), from, counts) ==
             0;
    return on_segment<D>(snapshot_.point(exit.u), snapshot_.point(exit.v), from);
  }

  const Snapshot<D>& snapshot_;
  const detail::Lane_planes& planes_;
  const detail::Lane_functions& functions_;
  Traces& traces_;
  Walk_counts& counts_;
  detail::Block_walk<D> walks_;
  detail::Block_segments segments_;
  detail::Row_lengths together_, alone_;       ///< of rows that planes decide, and of one of the others
  std::array<std::size_t, rows_together> at_;  ///< in the former
  std::size_t pieces_, crossings_;             ///< appended
  std::size_t expected_ = 0;                   ///< pieces of the rows of the block that are not yet appended
  std::vector<unsigned> met_;
  std::vector<Cell> visited_;
  std::vector<Half_facet> crossed_;
  std::vector<Cell_exit> exits_;
};

/// Takes back what was appended, unless it is kept.
class Rows_kept {
 public:
  explicit Rows_kept(Traces& traces)
      : traces_(&traces),
        rows_(traces.size()),
        pieces_(traces.cells.size()),
        crossings_(traces.crossings.size()) {}
  Rows_kept(const Rows_kept&) = delete;
  Rows_kept& operator=(const Rows_kept&) = delete;
  ~Rows_kept() {
    if (!traces_) return;
    traces_->offsets.resize(rows_ + 1);
    traces_->crossing_offsets.resize(rows_ + 1);
    traces_->cells.resize(pieces_);
    traces_->lengths.resize(pieces_);
    traces_->crossings.resize(crossings_);
    traces_->ends.resize(rows_);
  }
  void keep() { traces_ = nullptr; }

 private:
  Traces* traces_;
  std::size_t rows_, pieces_, crossings_;
};

}  // namespace

template <int D>
Tracer<D>::Tracer(const Snapshot<D>& snapshot)
    : planes_(new Planes{&snapshot, snapshot.geometry_epoch(), detail::lane_planes(snapshot),
                         detail::lane_kinds().back().functions}) {}

template <int D>
Tracer<D>::~Tracer() = default;
template <int D>
Tracer<D>::Tracer(Tracer&&) noexcept = default;
template <int D>
Tracer<D>& Tracer<D>::operator=(Tracer&&) noexcept = default;

template <int D>
void Tracer<D>::trace(std::span<Particle<D>> particles, std::span<const Point<D>> targets, Traces& traces,
                      Walk_counts& counts) const {
  const Snapshot<D>& snapshot = *planes_->snapshot;
  snapshot.check_geometry_epoch(planes_->epoch, "a tracer was made of it: make a new one");
  if (targets.size() != particles.size())
    throw Error(Error_code::usage, "there are " + std::to_string(particles.size()) + " particles and " +
                                       std::to_string(targets.size()) + " targets: give one for each");
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles[i].cell == Cell::none) continue;
    detail::check_finite(targets[i], "the target of a motion");
    if (!snapshot.is_cell(particles[i].cell)) detail::refuse_removed_cell();
  }
  Rows_kept rows(traces);
  const auto moved =
      Trace_call<D>(snapshot, planes_->planes, planes_->functions, traces, counts).run(particles, targets);
  rows.keep();
  std::copy(moved.begin(), moved.end(), particles.begin());
}

template class Tracer<2>;
template class Tracer<3>;

}  // namespace cellwalk
