// SPDX-License-Identifier: LGPL-3.0-or-later
// The cuts of facets that suit the cells on both sides, repaired by trying other diagonals.
#include "plan.h"

#include <cellwalk/internal/environment/cell_check.h>
#include <cellwalk/kernel/error.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <string>

#include "soup.h"

namespace cellwalk::detail {
namespace {

bool is_canonical(std::span<const std::uint32_t> loop) {
  const std::size_t n = loop.size();
  const std::size_t low = std::min_element(loop.begin(), loop.end()) - loop.begin();
  return loop[(low + 1) % n] < loop[(low + n - 1) % n];
}

template <class Body>
void for_each_index(std::size_t n, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 64), [&](const auto& range) {
    Predicate_counts counts;
    for (std::size_t i = range.begin(); i != range.end(); ++i) body(i, counts);
  });
}

}  // namespace

Split_plan::Split_plan(const Cell_soup<3>& soup, const std::vector<Cell_check>& checks, Cells_to_split which)
    : soup_(soup) {
  slot_of_cell_.assign(soup.cell_count(), none);
  for (std::uint32_t c = 0; c < checks.size(); ++c) {
    if (checks[c].defect == Cell_defect::none && (which == Cells_to_split::invalid || is_simplex(soup, c)))
      continue;
    slot_of_cell_[c] = static_cast<std::uint32_t>(split_cells_.size());
    split_cells_.push_back(c);
  }
  cut_of_facet_.assign(soup.facet_count(), none);
  if (split_cells_.empty()) return;
  cut_facets_of_split_cells();
  find_stars();
  repair();
}

void Split_plan::cut_facets_of_split_cells() {
  const Gluing gluing = glue(soup_);
  const auto cell_of = [&](std::uint32_t f) {
    return static_cast<std::uint32_t>(std::upper_bound(soup_.cell_begin.begin(), soup_.cell_begin.end(), f) -
                                      soup_.cell_begin.begin() - 1);
  };
  for (const std::uint32_t c : split_cells_)
    for (std::uint32_t f = soup_.cell_begin[c]; f < soup_.cell_begin[c + 1]; ++f) {
      if (soup_.facet(f).size() == 3 || cut_of_facet_[f] != none) continue;
      const std::uint32_t opposite = gluing.opposite[f];
      cut_of_facet_[f] = static_cast<std::uint32_t>(cuts_.size());
      if (opposite != no_facet) cut_of_facet_[opposite] = cut_of_facet_[f];
      cuts_.push_back({f, {c, opposite == no_facet ? c : cell_of(opposite)}, {}});
    }
  for_each_index(cuts_.size(), [&](std::size_t i, Predicate_counts& counts) {
    auto options =
        facet_triangulations(counts, soup_.points, canonical_loop(soup_.facet(cuts_[i].half_facet)), 1);
    if (!options.empty()) cuts_[i].triangles = std::move(options.front());
  });
  for (const Facet_cut& cut : cuts_)
    if (cut.triangles.empty())
      throw Error(Error_code::not_certified,
                  cell_name(cut.cells[0]) + " cannot be split: facet " +
                      std::to_string(cut.half_facet - soup_.cell_begin[cut.cells[0]]) +
                      " is a polygon that crosses or touches itself; repair or remove the cell");
}

Triangulation Split_plan::triangles(std::size_t half_facet) const {
  Triangulation result = cuts_[cut_of_facet_[half_facet]].triangles;
  if (!is_canonical(soup_.facet(half_facet)))
    for (Triangle& t : result) std::swap(t[1], t[2]);
  return result;
}

Triangulation Split_plan::surface(std::size_t cell) const {
  Triangulation result;
  for (std::size_t f = soup_.cell_begin[cell]; f < soup_.cell_begin[cell + 1]; ++f) {
    const auto loop = soup_.facet(f);
    if (loop.size() == 3) {
      result.push_back({loop[0], loop[1], loop[2]});
    } else {
      const Triangulation part = triangles(f);
      result.insert(result.end(), part.begin(), part.end());
    }
  }
  return result;
}

Star Split_plan::find_star_of(std::uint32_t slot) const {
  Predicate_counts counts;
  return find_star(counts, soup_.points, surface(split_cells_[slot]));
}

void Split_plan::find_stars() {
  stars_.resize(split_cells_.size());
  for_each_index(stars_.size(), [&](std::size_t i, Predicate_counts&) {
    stars_[i] = find_star_of(static_cast<std::uint32_t>(i));
  });
}

void Split_plan::repair() {
  // A repaired cell may allow the repair of a neighbour, so this repeats until nothing changes.
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t slot = 0; slot < stars_.size(); ++slot) {
      if (stars_[slot].found) continue;
      const bool mended = repair(slot);
      if (!mended && !has_open_neighbour(slot)) refuse(split_cells_[slot]);
      changed |= mended;
    }
  }
  for (std::uint32_t slot = 0; slot < stars_.size(); ++slot)
    if (!stars_[slot].found) refuse(split_cells_[slot]);
}

bool Split_plan::has_open_neighbour(std::uint32_t slot) const {
  const std::uint32_t cell = split_cells_[slot];
  for (std::uint32_t f = soup_.cell_begin[cell]; f < soup_.cell_begin[cell + 1]; ++f) {
    if (!is_cut(f)) continue;
    for (const std::uint32_t c : cuts_[cut_of_facet_[f]].cells) {
      const std::uint32_t other = slot_of_cell_[c];
      if (other != none && other != slot && !stars_[other].found) return true;
    }
  }
  return false;
}

bool Split_plan::repair(std::uint32_t slot) {
  // The maximum number of attempts: a hexahedron has 63 other combinations of diagonals.
  constexpr std::size_t most_attempts = 512;
  constexpr std::size_t all = std::numeric_limits<std::size_t>::max();
  struct Alternative {
    std::uint32_t cut;
    std::size_t option;
  };
  std::vector<std::vector<Triangulation>> options;
  std::vector<Alternative> alternatives;
  std::vector<std::uint32_t> cuts;
  const std::uint32_t cell = split_cells_[slot];
  Predicate_counts counts;
  for (std::uint32_t f = soup_.cell_begin[cell]; f < soup_.cell_begin[cell + 1]; ++f) {
    if (!is_cut(f)) continue;
    const auto index = static_cast<std::uint32_t>(cuts.size());
    cuts.push_back(cut_of_facet_[f]);
    options.push_back(facet_triangulations(counts, soup_.points, canonical_loop(soup_.facet(f)), all));
    for (std::size_t o = 0; o < options.back().size(); ++o)
      if (options.back()[o] != cuts_[cuts.back()].triangles) alternatives.push_back({index, o});
  }
  // Breadth first: one facet with another cut, then two, and so on; ascending, each facet at most once.
  std::vector<std::vector<std::size_t>> queue{{}};
  std::size_t attempts = 0;
  for (std::size_t head = 0; head < queue.size() && attempts < most_attempts; ++head) {
    const std::vector<std::size_t> chosen = queue[head];
    const std::size_t first = chosen.empty() ? 0 : chosen.back() + 1;
    for (std::size_t a = first; a < alternatives.size() && attempts < most_attempts; ++a) {
      if (!chosen.empty() && alternatives[chosen.back()].cut == alternatives[a].cut) continue;
      std::vector<std::size_t> next = chosen;
      next.push_back(a);
      std::vector<std::uint32_t> changed;
      std::vector<const Triangulation*> triangles;
      for (const std::size_t i : next) {
        changed.push_back(cuts[alternatives[i].cut]);
        triangles.push_back(&options[alternatives[i].cut][alternatives[i].option]);
      }
      ++attempts;
      if (try_cuts(slot, changed, triangles)) return true;
      queue.push_back(std::move(next));
    }
  }
  return false;
}

bool Split_plan::try_cuts(std::uint32_t slot, const std::vector<std::uint32_t>& cuts,
                          const std::vector<const Triangulation*>& triangles) {
  std::vector<Triangulation> former;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    former.push_back(cuts_[cuts[i]].triangles);
    cuts_[cuts[i]].triangles = *triangles[i];
  }
  // Neighbours that have a star must keep one. Those that are not split stay convex for all cuts of their
  // facets.
  std::vector<std::pair<std::uint32_t, Star>> found{{slot, find_star_of(slot)}};
  bool holds = found.front().second.found;
  for (std::size_t i = 0; holds && i < cuts.size(); ++i)
    for (const std::uint32_t c : cuts_[cuts[i]].cells) {
      const std::uint32_t other = slot_of_cell_[c];
      if (other == none || other == slot) continue;
      const Star star = find_star_of(other);
      holds = holds && (star.found || !stars_[other].found);
      found.emplace_back(other, star);
    }
  if (holds) {
    for (const auto& [s, star] : found) stars_[s] = star;
  } else {
    for (std::size_t i = 0; i < cuts.size(); ++i) cuts_[cuts[i]].triangles = former[i];
  }
  return holds;
}

void Split_plan::refuse(std::size_t cell) const {
  const bool is_inverted = enclosed_volume(soup_.points, surface(cell)) < 0;
  throw Error(
      Error_code::not_certified,
      cell_name(cell) + " cannot be split: " +
          (is_inverted ? "it is inverted (its volume is negative)"
                       : "it is not exactly convex, and no point found sees all of its facets from inside") +
          "; repair or remove the cell");
}

}  // namespace cellwalk::detail
