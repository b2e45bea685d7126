// SPDX-License-Identifier: LGPL-3.0-or-later
// Walks of many particles, then the lengths of each. A motion that planes do not decide is walked and
// measured on its own.
#include <cellwalk/internal/kernel/check_finite.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/walk/trace.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "block_walk.h"
#include "lane_planes.h"
#include "piece_lengths.h"
#include "plain_lanes.h"

namespace cellwalk {

void Traces::clear() {
  offsets.assign(1, 0);
  crossing_offsets.assign(1, 0);
  cells.clear();
  lengths.clear();
  crossings.clear();
  ends.clear();
}

namespace detail {
namespace {

/// The functions for this processor.
const Lane_functions& chosen_functions() {
#if defined(CELLWALK_HAS_FUSED_LANES)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return fused_lane_functions;
#endif
  return plain_lane_functions;
}

/// The segments of a block.
class Block_segments {
 public:
  explicit Block_segments(double error) : kept_(14 * stride) {
    double* next = kept_.data();
    const auto take = [&next] { return std::exchange(next, next + stride); };
    for (int k = 0; k < 3; ++k) {
      lanes_.from[k] = take();
      lanes_.to[k] = take();
      lanes_.direction_high[k] = take();
      lanes_.direction_low[k] = take();
    }
    lanes_.length_high = take();
    lanes_.length_low = take();
    lanes_.error = error;
  }

  template <int D>
  void set(std::span<const Particle<D>> particles, std::span<const Point<D>> targets,
           const Lane_functions& functions) {
    for (std::size_t k = 0; k < D; ++k)
      for (std::size_t i = 0; i < particles.size(); ++i) {
        lanes_.from[k][i] = particles[i].position[k];
        lanes_.to[k][i] = targets[i][k];
      }
    functions.set_directions(lanes_, particles.size());
  }
  const Lane_segments& lanes() const { return lanes_; }

 private:
  static constexpr std::size_t stride = rows_of_block + 8;
  std::vector<double> kept_;
  Lane_segments lanes_{};
};

}  // namespace
}  // namespace detail

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
        walks_(snapshot, functions),
        segments_(detail::lane_error * planes.size) {}

  /// Appends the rows, and returns the state of those particles that arrive, in order.
  std::vector<Particle<D>> run(std::span<const Particle<D>> particles, std::span<const Point<D>> targets) {
    std::vector<Particle<D>> moved(particles.begin(), particles.end());
    for (std::size_t begin = 0; begin < particles.size(); begin += detail::rows_of_block) {
      const std::size_t count = std::min(detail::rows_of_block, particles.size() - begin);
      const auto rows = particles.subspan(begin, count);
      walks_.run(rows, targets.subspan(begin, count));
      segments_.set<D>(rows, targets.subspan(begin, count), functions_);
      for (std::size_t i = 0; i < count; ++i) append(i, targets[begin + i], moved[begin + i]);
    }
    return moved;
  }

 private:
  /// \param i its number in the block
  void append(std::size_t i, const Point<D>& target, Particle<D>& particle) {
    const detail::Lane_row& row = walks_.row(i);
    Trace_end& end = traces_.ends.emplace_back();
    if (particle.cell == Cell::none)
      end.status = Walk_status::lost;
    else if (row.verdict == detail::Lane_verdict::undecided || !append_certified(i, target, particle, end))
      append_exact(target, particle, end);
    traces_.offsets.push_back(traces_.cells.size());
    traces_.crossing_offsets.push_back(traces_.crossings.size());
  }

  bool append_certified(std::size_t i, const Point<D>& target, Particle<D>& particle, Trace_end& end) {
    const detail::Lane_row& row = walks_.row(i);
    const std::span<const unsigned> met = walks_.met(row);
    const bool is_blocked = row.verdict == detail::Lane_verdict::blocked;
    const std::size_t pieces = met.size() + (is_blocked ? 0 : 1), passed = pieces - 1;
    constexpr std::size_t room = 8;  // that the function may write beyond
    if (high_.size() < pieces + 1 + room)
      for (auto* buffer : {&high_, &low_, &error_, &length_}) buffer->resize(2 * (pieces + 1 + room));
    const detail::Lane_crossings crossings{planes_.planes.data(), planes_.plane_of.data(), met.data(),
                                           met.size(), is_blocked};
    if (!functions_.measure(segments_.lanes(), i, crossings,
                            {high_.data(), low_.data(), error_.data(), length_.data()}))
      return false;

    const std::uint32_t* const links = snapshot_.links(Cell{0});  // of passable facets: the cells beyond
    if (cells_.size() < pieces) cells_.resize(2 * pieces);
    cells_[0] = particle.cell;
    for (std::size_t k = 0; k < passed; ++k) cells_[k + 1] = Cell{links[met[k]]};
    const auto* const facets = reinterpret_cast<const Half_facet*>(met.data());
    traces_.crossings.insert(traces_.crossings.end(), facets, facets + passed);
    traces_.cells.insert(traces_.cells.end(), cells_.data(), cells_.data() + pieces);
    traces_.lengths.insert(traces_.lengths.end(), length_.data(), length_.data() + pieces);
    ++counts_.walks;
    counts_.stays += passed == 0 && !is_blocked;
    counts_.crossings += passed;
    end = {is_blocked ? Walk_status::contact : Walk_status::arrived, Cell{row.cell},
           is_blocked ? Half_facet{met.back()} : Half_facet::none};
    if (!is_blocked) particle = {target, end.cell, D, passed == 0 ? particle.aimed : std::uint16_t{0}};
    return true;
  }

  void append_exact(const Point<D>& target, Particle<D>& particle, Trace_end& end) {
    visited_.clear();
    exits_.clear();
    piece_lengths_.clear();
    Walk_options options;
    options.visited = &visited_;
    options.exits = &exits_;
    options.crossed = &traces_.crossings;
    options.locates_contact = false;
    const Point<D> from = particle.position;
    const Walk_result<D> result = move(snapshot_, particle, target, counts_, options);
    end = {result.status, result.cell, result.contact ? result.contact->facet : Half_facet::none};
    if (from == target) return;
    detail::append_lengths(snapshot_, from, target, exits_, visited_.size(), piece_lengths_);
    for (std::size_t i = 0; i < visited_.size(); ++i) {
      if (piece_lengths_[i] < 0) continue;
      traces_.cells.push_back(visited_[i]);
      traces_.lengths.push_back(piece_lengths_[i]);
    }
  }

  const Snapshot<D>& snapshot_;
  const detail::Lane_planes& planes_;
  const detail::Lane_functions& functions_;
  Traces& traces_;
  Walk_counts& counts_;
  detail::Block_walk<D> walks_;
  detail::Block_segments segments_;
  std::vector<double> high_, low_, error_, length_, piece_lengths_;
  std::vector<Cell> cells_, visited_;
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
                         detail::chosen_functions()}) {}

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
