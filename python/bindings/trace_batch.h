// SPDX-License-Identifier: LGPL-3.0-or-later
// Motions traced chunk by chunk and put together in order, or added to tallies in fixed point, one a thread.
// Nothing here needs the interpreter.
#ifndef CELLWALK_PYTHON_TRACE_BATCH_H
#define CELLWALK_PYTHON_TRACE_BATCH_H

#include <cellwalk/edge/sweep.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/walk/tally.h>

#include <fmt/core.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "batch.h"
#include "motions.h"
#include "traces.h"
#include "tracing.h"

namespace cellwalk::python {

/// The rows of a chunk, and what they are made of. Kept from chunk to chunk, it keeps its memory.
template <int D>
struct Traced_chunk {
  std::vector<Particle<D>> particles;
  std::vector<Motion_status> status;
  std::vector<Vector<D>> headings;
  Traces traces;
  Walk_counts counts;
};

inline Motion_status to_status(Walk_status status) {
  return status == Walk_status::arrived ? Motion_status::free : Motion_status::contact;
}

/// Motions of points, each on the side of walls on which it gets furthest, as in Environment.walk().
template <int D>
class Point_motions {
 public:
  Point_motions(const Locator<D>& locator, const Snapshot<D>& snapshot, std::span<const Point<D>> origins,
                std::span<const Point<D>> ends)
      : locator_(locator), snapshot_(snapshot), origins_(origins), ends_(ends) {}

  const Point<D>& origin(std::size_t row) const { return origins_[row]; }
  std::span<const Point<D>> targets() const { return ends_; }
  /// \param status set if there is no particle
  Particle<D> start(std::size_t row, Motion_status& status, Walk_counts& counts) const {
    const Point<D>& from = origins_[row];
    status = Motion_status::invalid;
    if (!is_usable(from) || !is_usable(ends_[row])) return {from};
    status = Motion_status::outside;
    const std::vector<Particle<D>> sides = locator_.particles_at(from);
    return sides.empty() ? Particle<D>{from} : sides.size() == 1 ? sides[0] : best(sides, ends_[row], counts);
  }
  void end(std::size_t /*row*/, const Particle<D>& /*particle*/) const {}

 private:
  Particle<D> best(const std::vector<Particle<D>>& sides, const Point<D>& to, Walk_counts& counts) const {
    Particle<D> furthest = sides[0];
    double time = -1;
    for (const Particle<D>& side : sides) {
      const Walk_result<D> result = cellwalk::walk(snapshot_, side, to, counts);
      if (!result.contact) return side;
      const Contact<D> contact = vertex_contact(snapshot_, side.position, to, *result.contact, counts);
      if (contact.time <= time) continue;
      furthest = side;
      time = contact.time;
    }
    return furthest;
  }

  const Locator<D>& locator_;
  const Snapshot<D>& snapshot_;
  std::span<const Point<D>> origins_, ends_;
};

/// Motions of particles, which move as Particles.move() moves them.
template <int D>
class Particle_motions {
 public:
  /// \param chosen the particle of each target; none: all, in order
  Particle_motions(std::span<Particle<D>> particles, std::span<const std::uint32_t> chosen,
                   std::span<const Point<D>> targets)
      : particles_(particles), chosen_(chosen), targets_(targets) {}

  const Point<D>& origin(std::size_t row) const { return particle(row).position; }
  std::span<const Point<D>> targets() const { return targets_; }
  Particle<D> start(std::size_t row, Motion_status& status, Walk_counts& /*counts*/) const {
    const Particle<D>& at = particle(row);
    status = at.cell == Cell::none ? Motion_status::outside : Motion_status::invalid;
    return is_usable(targets_[row]) ? at : Particle<D>{at.position};
  }
  void end(std::size_t row, const Particle<D>& moved) const { particle(row) = moved; }

 private:
  Particle<D>& particle(std::size_t row) const { return particles_[chosen_.empty() ? row : chosen_[row]]; }

  std::span<Particle<D>> particles_;
  std::span<const std::uint32_t> chosen_;
  std::span<const Point<D>> targets_;
};

/// Traces the rows [begin, end) of motions by walk(particles, targets, traces, counts, headings).
template <int D, class Motions_made, class Walk>
void trace_chunk(const Walk& walk, const Motions_made& motions, std::size_t begin, std::size_t end,
                 Traced_chunk<D>& chunk) {
  chunk.traces.clear();
  chunk.particles.resize(end - begin);
  chunk.status.resize(end - begin);
  chunk.headings.resize(end - begin);
  for (std::size_t row = begin; row < end; ++row) {
    chunk.particles[row - begin] = motions.start(row, chunk.status[row - begin], chunk.counts);
    chunk.headings[row - begin] = motions.targets()[row] - motions.origin(row);
  }
  walk(std::span(chunk.particles), motions.targets().subspan(begin, end - begin), chunk.traces, chunk.counts,
       std::span(chunk.headings));
  for (std::size_t row = begin; row < end; ++row) {
    const Particle<D>& particle = chunk.particles[row - begin];
    if (particle.cell == Cell::none) continue;
    chunk.status[row - begin] = to_status(chunk.traces.ends[row - begin].status);
    motions.end(row, particle);
  }
}

/// The content of Trace_arrays. Needs no interpreter.
struct Trace_buffers {
  Trace_buffers(std::size_t rows, std::size_t columns, std::size_t pieces, std::size_t crossings)
      : offsets(rows + 1),
        surface_offsets(rows + 1),
        cells(pieces),
        surfaces(crossings),
        cell(rows),
        wall(rows),
        lengths(pieces),
        headings(rows * columns),
        forward(crossings),
        status(rows),
        dimension(columns) {
    offsets.values[0] = 0;
    surface_offsets.values[0] = 0;
  }

  Buffer<std::int64_t> offsets, surface_offsets;
  Buffer<std::int32_t> cells, surfaces, cell, wall;
  Buffer<double> lengths, headings;
  Buffer<bool> forward;
  Buffer<std::uint8_t> status;
  std::size_t dimension;
};

/// The rows of a chunk, as Python names cells and facets.
template <int D>
Trace_buffers to_buffers(const Snapshot<D>& snapshot, const Tracing<D>& tracing,
                         const Traced_chunk<D>& chunk) {
  const Traces& traces = chunk.traces;
  Trace_buffers out(traces.size(), D, traces.cells.size(), traces.crossings.size());
  for (std::size_t row = 0; row < traces.size(); ++row) {
    out.offsets.values[row + 1] = static_cast<std::int64_t>(traces.offsets[row + 1]);
    out.surface_offsets.values[row + 1] = static_cast<std::int64_t>(traces.crossing_offsets[row + 1]);
    const Trace_end& end = traces.ends[row];
    out.status.values[row] = static_cast<std::uint8_t>(chunk.status[row]);
    out.cell.values[row] = number_of(snapshot, end.cell);
    out.wall.values[row] = end.wall == Half_facet::none ? -1 : tracing.row_of[to_index(end.wall)];
    std::copy_n(chunk.headings[row].begin(), D, out.headings.values.get() + D * row);
  }
  for (std::size_t i = 0; i < traces.cells.size(); ++i)
    out.cells.values[i] = static_cast<std::int32_t>(snapshot.index(traces.cells[i]));
  std::copy(traces.lengths.begin(), traces.lengths.end(), out.lengths.values.get());
  for (std::size_t i = 0; i < traces.crossings.size(); ++i) {
    const Half_facet facet = traces.crossings[i];
    const Cell beyond = snapshot.neighbour(facet);
    out.surfaces.values[i] = tracing.row_of[to_index(facet)];
    out.forward.values[i] =
        beyond == Cell::none || snapshot.index(beyond) > snapshot.index(snapshot.cell_of(facet));
  }
  return out;
}

/// The parts of chunks, one after the other. They are freed on the way, so that memory is used once.
inline Trace_buffers joined(std::vector<std::unique_ptr<Trace_buffers>> parts, std::size_t rows,
                            std::size_t columns, int threads) {
  std::vector<std::size_t> pieces{0}, crossings{0};  // before each part
  for (const auto& part : parts) {
    pieces.push_back(pieces.back() + part->cells.size);
    crossings.push_back(crossings.back() + part->surfaces.size);
  }
  Trace_buffers all(rows, columns, pieces.back(), crossings.back());
  for_each_chunk(rows, threads, [&](std::size_t i, std::size_t row, std::size_t /*end*/) {
    const auto put = [](const auto& part, const auto& whole, std::size_t at) {
      std::copy_n(part.values.get(), part.size, whole.values.get() + at);
    };
    const Trace_buffers& part = *parts[i];
    for (std::size_t k = 1; k < part.offsets.size; ++k) {
      all.offsets.values[row + k] = part.offsets.values[k] + static_cast<std::int64_t>(pieces[i]);
      all.surface_offsets.values[row + k] =
          part.surface_offsets.values[k] + static_cast<std::int64_t>(crossings[i]);
    }
    put(part.cells, all.cells, pieces[i]);
    put(part.lengths, all.lengths, pieces[i]);
    put(part.surfaces, all.surfaces, crossings[i]);
    put(part.forward, all.forward, crossings[i]);
    put(part.headings, all.headings, columns * row);
    put(part.cell, all.cell, row);
    put(part.wall, all.wall, row);
    put(part.status, all.status, row);
    parts[i].reset();
  });
  return all;
}

template <int D, class Motions_made, class Walk>
Trace_buffers trace_all(const Snapshot<D>& snapshot, const Tracing<D>& tracing, const Motions_made& motions,
                        const Walk& walk, int threads) {
  const std::size_t rows = motions.targets().size();
  std::vector<std::unique_ptr<Trace_buffers>> parts(chunk_count(rows));
  tbb::enumerable_thread_specific<Traced_chunk<D>> chunks;
  for_each_chunk(rows, threads, [&](std::size_t i, std::size_t begin, std::size_t end) {
    Traced_chunk<D>& chunk = chunks.local();
    trace_chunk<D>(walk, motions, begin, end, chunk);
    parts[i] = std::make_unique<Trace_buffers>(to_buffers(snapshot, tracing, chunk));
  });
  if (parts.size() == 1) return std::move(*parts[0]);
  return joined(std::move(parts), rows, D, threads);
}

/// Of the motions of a tally.
struct Row_weights {
  const double* values = nullptr;  ///< of each row; 1 without
  double largest = 1;              ///< of their absolute values
};

/// A bound of the lengths of pieces, and so large that those in one cell can be added.
/// \param most_bounces walls at which motions go on
template <int D, class Motions_made>
double longest_piece(const Motions_made& motions, double diameter, int most_bounces) {
  double longest = 0;
  const std::size_t rows = motions.targets().size();
  for (std::size_t row = 0; row < rows; ++row) {
    const Point<D>&from = motions.origin(row), &to = motions.targets()[row];
    double length = 0;
    for (std::size_t k = 0; k < D; ++k) length = std::hypot(length, to[k] - from[k]);
    if (length > longest) longest = length;  // rows that are not numbers have no pieces
  }
  constexpr double rounding = 0x1p-50;  // some ulp: of two roots, and of the length of a piece
  constexpr int log2_of_most = 31;  // pieces of this length in a cell of a tally; it can add twice as many
  if (most_bounces == 0) return std::min(longest, diameter) * (1 + rounding);
  // Legs may be longer than the motion by a lift off a wall.
  const double way = std::min(longest, diameter * (1.0 + most_bounces));
  return std::max(diameter, std::ldexp(way * static_cast<double>(rows), -log2_of_most)) * (1 + rounding);
}

/// Adds the weighted lengths of motions to sums by cell.
/// \param most_bounces walls at which a walk may go on
/// \throw Error(input) for another number of sums than cells, with nothing moved
template <int D, class Motions_made, class Walk>
void tally_all(const Snapshot<D>& snapshot, const Tracing<D>& tracing, const Motions_made& motions,
               const Walk& walk, int most_bounces, const Row_weights& weights, int threads,
               std::span<double> sums) {
  if (sums.size() != snapshot.cell_slots())
    throw Error(Error_code::input, fmt::format("out has {} values, and cells have numbers below {}: as many "
                                               "are needed",
                                               sums.size(), snapshot.cell_slots()));
  const double largest = weights.largest * longest_piece<D>(motions, tracing.diameter, most_bounces);
  if (!std::isfinite(largest))
    throw Error(Error_code::input, "the weights are too large: their products with lengths overflow");
  struct Worker {
    Tally tally;
    Traced_chunk<D> chunk = {};
  };
  tbb::enumerable_thread_specific<Worker> workers(
      [&] { return Worker{Tally(sums.size(), largest > 0 ? largest : 1)}; });
  for_each_chunk(motions.targets().size(), threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    auto& [tally, chunk] = workers.local();
    trace_chunk<D>(walk, motions, begin, end, chunk);
    const Traces& traces = chunk.traces;
    for (std::size_t row = begin; row < end; ++row) {
      const double weight = weights.values ? weights.values[row] : 1;
      for (std::size_t i = traces.offsets[row - begin]; i < traces.offsets[row - begin + 1]; ++i)
        tally.add(snapshot.index(traces.cells[i]), weight * traces.lengths[i]);
    }
  });
  Tally* total = nullptr;
  for (Worker& worker : workers)
    if (total)
      total->add(worker.tally);
    else
      total = &worker.tally;
  for (std::size_t i = 0; total && i < sums.size(); ++i) sums[i] += (*total)[i];
}

}  // namespace cellwalk::python

#endif  // CELLWALK_PYTHON_TRACE_BATCH_H
