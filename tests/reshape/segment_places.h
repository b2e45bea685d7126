// SPDX-License-Identifier: LGPL-3.0-or-later
// A segment among simplices, cut wherever it enters or leaves one, and which of them are linked there: chains
// by definition, in rational numbers, by brute force over all cells near.
#ifndef CELLWALK_TESTS_RESHAPE_SEGMENT_PLACES_H
#define CELLWALK_TESTS_RESHAPE_SEGMENT_PLACES_H

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "reshape/near_cells.h"

namespace cellwalk::test {

/// What can be passed, and what is free space.
struct Passages {
  std::function<bool(Half_facet)> facet;
  std::function<bool(Cell)> cell;
};

/// Points of the segment (even numbers) and the pieces between them (odd ones), from p to q.
template <int D>
class Segment_places {
 public:
  /// For each place the least cell of those that each cell there is linked with.
  using Classes = std::vector<std::map<Cell, Cell>>;

  Segment_places(const Snapshot<D>& snapshot, const Point<D>& p, const Point<D>& q) : snapshot_(snapshot) {
    const Wall_motion<D> still{snapshot, 0, snapshot.point(0), snapshot.point(0)};
    const Near<D> near(still, p, q);
    is_point_ = p == q;
    std::set<Fraction> ends{0, 1};
    for (const Near_cell<D>& cell : near.cells) {
      Part part{cell.cell, {}, {}};
      for (std::size_t k = 0; k <= D; ++k) keep_positive(part.all, cell.at_p[k].at_0, cell.at_q[k].at_0);
      if (part.all.is_empty()) continue;
      for (std::size_t k = 0; k <= D; ++k) {
        Interval in_facet = part.all;
        keep_positive(in_facet, -cell.at_p[k].at_0, -cell.at_q[k].at_0);
        if (in_facet.is_empty()) continue;
        part.facets.emplace_back(cell.facet[k], in_facet);
        ends.insert(in_facet.low);
        ends.insert(in_facet.high);
      }
      ends.insert(part.all.low);
      ends.insert(part.all.high);
      parts_.push_back(part);
    }
    if (is_point_) ends = {0};
    for (const Fraction& t : ends) {
      if (!at_.empty()) at_.push_back((at_.back() + t) / 2);
      at_.push_back(t);
    }
  }

  std::size_t size() const { return at_.size(); }

  /// True if a place lies in a closed facet.
  bool lies_in(std::size_t place, Half_facet f) const {
    const Part* part = find(snapshot_.cell_of(f));
    return part && part->has(f, at_[place]);
  }

  Classes classes(const Passages& passages) const {
    Classes result(size());
    for (std::size_t k = 0; k < size(); ++k) {
      std::map<Cell, Cell>& least = result[k];
      for (const Part& part : parts_)
        if (passages.cell(part.cell) && part.has(at_[k])) least[part.cell] = part.cell;
      for (bool goes_on = true; goes_on;) {
        goes_on = false;
        for (const Part& part : parts_) {
          if (!least.contains(part.cell)) continue;
          for (const auto& [f, in_facet] : part.facets) {
            if (!part.has(f, at_[k]) || !passages.facet(f)) continue;
            const auto other = least.find(snapshot_.neighbour(f));
            if (other == least.end()) continue;
            Cell& own = least[part.cell];
            if (own == other->second) continue;
            own = other->second = std::min(own, other->second);
            goes_on = true;
          }
        }
      }
    }
    return result;
  }

  /// The class of a chain at each piece; none if it is no chain there.
  std::optional<std::vector<Cell>> classes_of(const Classes& classes, Cell start,
                                              const std::vector<Half_facet>& chain) const {
    std::vector<Cell> cells{start};
    for (const Half_facet f : chain) {
      if (snapshot_.cell_of(f) != cells.back()) return {};
      cells.push_back(snapshot_.neighbour(f));
    }
    // Whether the cell of a number may be reached at a place, and from which number.
    std::vector<std::vector<int>> from(size(), std::vector<int>(cells.size(), -1));
    for (std::size_t k = 0; k < size(); ++k)
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!classes[k].contains(cells[i])) continue;
        const bool is_start = k == 0 && i == 0;
        if (is_start || (k > 0 && from[k - 1][i] >= 0)) from[k][i] = static_cast<int>(i);
        if (k % 2 == 0 && i > 0 && from[k][i] < 0 && from[k][i - 1] >= 0 && lies_in(k, chain[i - 1]))
          from[k][i] = static_cast<int>(i - 1);
      }
    int i = static_cast<int>(cells.size()) - 1;
    if (from.back()[static_cast<std::size_t>(i)] < 0) return {};
    std::vector<Cell> result;
    for (std::size_t k = size(); k-- > 0;) {
      while (from[k][static_cast<std::size_t>(i)] != i) i = from[k][static_cast<std::size_t>(i)];
      if (k % 2 == 1) result.insert(result.begin(), classes[k].at(cells[static_cast<std::size_t>(i)]));
      if (k > 0 && from[k - 1][static_cast<std::size_t>(i)] < 0) return {};
    }
    return result;
  }

 private:
  struct Part {
    Cell cell;
    Interval all;
    std::vector<std::pair<Half_facet, Interval>> facets;
    bool has(const Fraction& t) const { return all.low <= t && t <= all.high; }
    bool has(Half_facet f, const Fraction& t) const {
      for (const auto& [facet, part] : facets)
        if (facet == f) return part.low <= t && t <= part.high;
      return false;
    }
  };
  const Part* find(Cell c) const {
    for (const Part& part : parts_)
      if (part.cell == c) return &part;
    return nullptr;
  }

  const Snapshot<D>& snapshot_;
  bool is_point_ = false;
  std::vector<Part> parts_;
  std::vector<Fraction> at_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_SEGMENT_PLACES_H
