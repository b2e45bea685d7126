// SPDX-License-Identifier: LGPL-3.0-or-later
// Walks of many particles, some at a time, so that the processor finds the exits of several cells at once;
// then the lengths of each. A motion that planes do not decide is walked and measured on its own.
#include <cellwalk/internal/kernel/check_finite.h>
#include <cellwalk/internal/walk/certified_exit.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/walk/trace.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

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

/// The function for this processor.
Lane_lengths chosen_lengths() {
#if defined(CELLWALK_HAS_FUSED_LANES)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return &lengths_in_fused_lanes;
#endif
  return &lengths_in_plain_lanes;
}

/// The walk of a row, as far as planes decide it.
struct Row_walk {
  enum Verdict : std::uint8_t { arrived, blocked, undecided } verdict = undecided;
  std::uint8_t slot = 0;             ///< whose half-facets are its own
  std::uint32_t begin = 0, end = 0;  ///< of these: the facets met, the wall included
  Cell cell = Cell::none;            ///< the last one
};

/// Walks that are under way at a time, and the rows that are walked before their lengths are computed.
constexpr std::size_t most_slots = 4, rows_of_block = 256;

/// The walks of a block of rows by planes alone.
template <int D>
class Block_walk {
 public:
  explicit Block_walk(const Snapshot<D>& snapshot) : snapshot_(snapshot) {}

  void run(std::span<const Particle<D>> particles, std::span<const Point<D>> targets) {
    particles_ = particles;
    targets_ = targets;
    next_ = 0;
    std::array<Slot, most_slots> slots;
    std::size_t active = 0;
    for (auto& met : met_) met.clear();
    for (std::size_t i = 0; i < most_slots; ++i) {
      slots[active].number = static_cast<std::uint8_t>(i);
      if (starts(slots[active])) ++active;
    }
    if (snapshot_.uniform_blocks() == 1)
      follow(slots, active, [&](const Slot& slot) {
        return certified_exit<D>(*snapshot_.blocks(slot.cell), slot.line, slot.starts_inside);
      });
    else
      follow(slots, active, [&](const Slot& slot) {
        return exit_of_blocks(snapshot_, slot.cell, slot.line, slot.starts_inside);
      });
  }

  const Row_walk& row(std::size_t i) const { return rows_[i]; }
  std::span<const Half_facet> met(const Row_walk& row) const {
    return std::span(met_[row.slot]).subspan(row.begin, row.end - row.begin);
  }

 private:
  struct Slot {
    Frame_line<D> line{Float_point<D>{}, Float_point<D>{}};
    Cell cell = Cell::none;
    std::uint32_t row = 0, begin = 0;
    bool starts_inside = false;
    std::uint8_t number = 0;
  };

  /// Begins the next row that planes can decide; false if there is none.
  bool starts(Slot& slot) {
    for (; next_ < particles_.size(); ++next_) {
      const Particle<D>& particle = particles_[next_];
      rows_[next_] = {};
      Float_point<D> a, b;
      if (particle.cell == Cell::none || !snapshot_.frame().map(particle.position, a) ||
          !snapshot_.frame().map(targets_[next_], b))
        continue;
      slot.line = Frame_line<D>(a, b);
      slot.cell = particle.cell;
      slot.starts_inside = particle.dimension == D;
      slot.row = static_cast<std::uint32_t>(next_++);
      slot.begin = static_cast<std::uint32_t>(met_[slot.number].size());
      return true;
    }
    return false;
  }

  void end(const Slot& slot, Row_walk::Verdict verdict) {
    rows_[slot.row] = {verdict, slot.number, slot.begin, static_cast<std::uint32_t>(met_[slot.number].size()),
                       slot.cell};
  }

  template <class Find_exit>
  void follow(std::array<Slot, most_slots>& slots, std::size_t active, Find_exit find_exit) {
    const std::size_t limit = snapshot_.half_facet_slots();
    while (active != 0) {
      for (std::size_t i = 0; i < active;) {
        Slot& slot = slots[i];
        const Certified_exit exit = find_exit(slot);
        if (exit.verdict == Certified_exit::leaves) [[likely]] {
          const Half_facet f = Snapshot<D>::half_facet(slot.cell, exit.facet);
          met_[slot.number].push_back(f);
          if (!snapshot_.is_impassable(f)) [[likely]] {
            slot.cell = snapshot_.neighbour(f);
            slot.starts_inside = true;
            ++i;
            if (met_[slot.number].size() - slot.begin <= limit) continue;
            --i;
            end(slot, Row_walk::undecided);  // an exact walk will say that nothing was certified
          } else {
            end(slot, Row_walk::blocked);
          }
        } else {
          end(slot, exit.verdict == Certified_exit::inside ? Row_walk::arrived : Row_walk::undecided);
        }
        if (!starts(slot)) {
          std::swap(slot, slots[active - 1]);
          --active;
        }
      }
    }
  }

  const Snapshot<D>& snapshot_;
  std::span<const Particle<D>> particles_;
  std::span<const Point<D>> targets_;
  std::size_t next_ = 0;
  std::array<Row_walk, rows_of_block> rows_;
  std::array<std::vector<Half_facet>, most_slots> met_;
};

}  // namespace
}  // namespace detail

template <int D>
struct Tracer<D>::Planes {
  const Snapshot<D>* snapshot;
  std::uint64_t epoch;
  detail::Lane_planes planes;
  detail::Lane_lengths lengths;
};

namespace {

/// One call of trace().
template <int D>
class Trace_call {
 public:
  Trace_call(const Snapshot<D>& snapshot, const detail::Lane_planes& planes, detail::Lane_lengths lengths,
             Traces& traces, Walk_counts& counts)
      : snapshot_(snapshot),
        planes_(planes),
        lengths_(lengths),
        traces_(traces),
        counts_(counts),
        walks_(snapshot) {}

  /// Appends the rows, and returns the state of those particles that arrive, in order.
  std::vector<Particle<D>> run(std::span<const Particle<D>> particles, std::span<const Point<D>> targets) {
    std::vector<Particle<D>> moved(particles.begin(), particles.end());
    for (std::size_t begin = 0; begin < particles.size(); begin += detail::rows_of_block) {
      const std::size_t count = std::min(detail::rows_of_block, particles.size() - begin);
      walks_.run(particles.subspan(begin, count), targets.subspan(begin, count));
      for (std::size_t i = 0; i < count; ++i) append(walks_.row(i), targets[begin + i], moved[begin + i]);
    }
    return moved;
  }

 private:
  void append(const detail::Row_walk& row, const Point<D>& target, Particle<D>& particle) {
    Trace_end& end = traces_.ends.emplace_back();
    if (particle.cell == Cell::none)
      end.status = Walk_status::lost;
    else if (row.verdict == detail::Row_walk::undecided || !append_certified(row, target, particle, end))
      append_exact(target, particle, end);
    traces_.offsets.push_back(traces_.cells.size());
    traces_.crossing_offsets.push_back(traces_.crossings.size());
  }

  bool append_certified(const detail::Row_walk& row, const Point<D>& target, Particle<D>& particle,
                        Trace_end& end) {
    const std::span<const Half_facet> met = walks_.met(row);
    const bool is_blocked = row.verdict == detail::Row_walk::blocked;
    const std::size_t first = traces_.lengths.size(), pieces = met.size() + (is_blocked ? 0 : 1);
    constexpr std::size_t room = 8;  // that the function may write beyond
    if (high_.size() < pieces + 1 + room)
      for (auto* buffer : {&high_, &low_, &error_}) buffer->resize(2 * (pieces + 1 + room));
    traces_.lengths.resize(first + pieces + room);
    detail::Lane_segment segment{{}, {}, detail::lane_error * planes_.size};
    for (std::size_t k = 0; k < D; ++k) {
      segment.from[k] = particle.position[k];
      segment.to[k] = target[k];
    }
    const detail::Lane_crossings crossings{planes_.planes.data(), planes_.plane_of.data(),
                                           reinterpret_cast<const unsigned*>(met.data()), met.size(),
                                           is_blocked};
    const bool are_certain = lengths_(
        segment, crossings, {high_.data(), low_.data(), error_.data(), traces_.lengths.data() + first});
    traces_.lengths.resize(first + (are_certain ? pieces : 0));
    if (!are_certain) return false;

    traces_.cells.push_back(particle.cell);
    for (std::size_t i = 0; i + 1 < pieces; ++i) traces_.cells.push_back(snapshot_.neighbour(met[i]));
    traces_.crossings.insert(traces_.crossings.end(), met.begin(), met.end() - (is_blocked ? 1 : 0));
    ++counts_.walks;
    counts_.stays += pieces == 1 && !is_blocked;
    counts_.crossings += pieces - 1;
    end = {is_blocked ? Walk_status::contact : Walk_status::arrived, row.cell,
           is_blocked ? met.back() : Half_facet::none};
    if (!is_blocked) particle = {target, row.cell, D, pieces == 1 ? particle.aimed : std::uint16_t{0}};
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
  const detail::Lane_lengths lengths_;
  Traces& traces_;
  Walk_counts& counts_;
  detail::Block_walk<D> walks_;
  std::vector<double> high_, low_, error_, piece_lengths_;
  std::vector<Cell> visited_;
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
                         detail::chosen_lengths()}) {}

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
      Trace_call<D>(snapshot, planes_->planes, planes_->lengths, traces, counts).run(particles, targets);
  rows.keep();
  std::copy(moved.begin(), moved.end(), particles.begin());
}

template class Tracer<2>;
template class Tracer<3>;

}  // namespace cellwalk
