// SPDX-License-Identifier: LGPL-3.0-or-later
// A flood through the facets at a point, from one stored cell of each of its parts.
#include <cellwalk/internal/environment/star_index.h>

#include <algorithm>
#include <array>

namespace cellwalk::detail {
namespace {

/// The first cells found, to be found again: a table with places for twice as many, on the stack.
class Seen_cells {
 public:
  Seen_cells() { places_.fill(Cell::none); }
  /// True if a cell was not there.
  /// \pre fewer than `most` were entered
  bool enter(Cell c) {
    std::size_t at = (to_index(c) * 0x9e3779b1u) >> (32 - bits);
    while (places_[at] != Cell::none && places_[at] != c) at = (at + 1) % places_.size();
    const bool is_new = places_[at] == Cell::none;
    places_[at] = c;
    return is_new;
  }
  static constexpr unsigned bits = 7;
  static constexpr std::size_t most = (std::size_t{1} << bits) / 2;

 private:
  std::array<Cell, 2 * most> places_;
};

/// Calls visit(facet) for the facets of a cell that have a point.
template <int D, class Visit>
void for_each_facet_at(const Cell_view<D>& view, std::uint32_t point, const Visit& visit) {
  if (view.vertex_count() != D + 1) {
    for (std::size_t i = 0; i < view.facet_count(); ++i)
      if (has_point(view, i, point)) visit(i);
    return;
  }
  // In a simplex all facets have it but the one whose local vertices are all others.
  int sum = 0;
  for (int k = 0; k <= D; ++k) sum += view.vertices[static_cast<std::size_t>(k)] == point ? 0 : k;
  for (std::size_t i = 0; i < view.facet_count(); ++i) {
    int own = 0;
    for (const std::uint16_t v : view.loop(i)) own += v;
    if (own != sum) visit(i);
  }
}

/// Appends the cells joined with `first` through facets that have the point, walls included.
template <int D>
void append_part(const Snapshot<D>& snapshot, std::uint32_t point, Cell first, std::vector<Cell>& cells) {
  const std::size_t begin = cells.size();
  Seen_cells seen;
  seen.enter(first);
  cells.push_back(first);
  for (std::size_t visited = begin; visited < cells.size(); ++visited) {
    const Cell c = cells[visited];
    for_each_facet_at<D>(snapshot.view(c), point, [&](std::size_t i) {
      const Cell next = snapshot.neighbour(Snapshot<D>::half_facet(c, i));
      if (next == Cell::none) return;
      const bool is_new = cells.size() - begin < Seen_cells::most
                              ? seen.enter(next)
                              : std::find(cells.begin() + static_cast<std::ptrdiff_t>(begin), cells.end(),
                                          next) == cells.end();
      if (is_new) cells.push_back(next);
    });
  }
}

/// Calls visit(point, cell) for all cells and their points.
template <int D, class Visit>
void for_each_corner(const Snapshot<D>& snapshot, const Visit& visit) {
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    if (const Cell c = snapshot.cell(i); c != Cell::none)
      for (const std::uint32_t point : snapshot.view(c).vertices) visit(point, c);
}

}  // namespace

template <int D>
Star_index<D>::Star_index(const Snapshot<D>& snapshot) : first_(snapshot.points().size(), Cell::none) {
  std::vector<std::uint32_t> missed(first_.size());
  for_each_corner(snapshot, [&](std::uint32_t point, Cell c) {
    if (first_[point] == Cell::none) first_[point] = c;
    ++missed[point];
  });
  std::vector<Cell> cells;
  bool are_pinched = false;
  for (std::uint32_t point = 0; point < first_.size(); ++point) {
    if (first_[point] == Cell::none) continue;
    cells.clear();
    append_part(snapshot, point, first_[point], cells);
    missed[point] -= static_cast<std::uint32_t>(cells.size());
    are_pinched |= missed[point] != 0;
  }
  if (!are_pinched) return;
  for_each_corner(snapshot, [&](std::uint32_t point, Cell c) {
    if (missed[point] == 0) return;
    cells.clear();
    append_parts(snapshot, point, cells);
    if (std::find(cells.begin(), cells.end(), c) != cells.end()) return;
    other_parts_.insert(std::upper_bound(other_parts_.begin(), other_parts_.end(), std::pair(point, c)),
                        {point, c});
    const std::size_t before = cells.size();
    append_part(snapshot, point, c, cells);
    missed[point] -= static_cast<std::uint32_t>(cells.size() - before);
  });
}

template <int D>
void Star_index<D>::append_parts(const Snapshot<D>& snapshot, std::uint32_t point,
                                 std::vector<Cell>& cells) const {
  append_part(snapshot, point, first_[point], cells);
  for (auto part = std::lower_bound(other_parts_.begin(), other_parts_.end(), std::pair(point, Cell{0}));
       part != other_parts_.end() && part->first == point; ++part)
    append_part(snapshot, point, part->second, cells);
}

template <int D>
void Star_index<D>::find_cells(const Snapshot<D>& snapshot, std::uint32_t point, std::vector<Cell>& cells) {
  cells.clear();
  if (point >= first_.size() || first_[point] == Cell::none) return;
  if (kept_.size() < first_.size()) kept_.resize(first_.size(), none);
  if (kept_[point] != none) {
    for (const Cell* c = cells_.data() + kept_[point]; *c != Cell::none; ++c) cells.push_back(*c);
    return;
  }
  append_parts(snapshot, point, cells);
  cells_.push_back(Cell{point});
  const auto begin = static_cast<std::uint32_t>(cells_.size());
  cells_.insert(cells_.end(), cells.begin(), cells.end());
  cells_.push_back(Cell::none);
  kept_[point] = begin;
}

template <int D>
std::vector<std::pair<std::uint32_t, Cell>>::iterator Star_index<D>::parts_of(std::uint32_t point) {
  return std::lower_bound(other_parts_.begin(), other_parts_.end(), std::pair(point, Cell{0}));
}

/// Drops the entries of a point.
template <int D>
void Star_index<D>::forget(std::uint32_t point) {
  if (point >= kept_.size() || kept_[point] == none) return;
  std::size_t end = kept_[point];
  while (cells_[end] != Cell::none) ++end;
  outdated_ += end - kept_[point] + 2;
  kept_[point] = none;
}

/// Frees the room of dropped entries.
template <int D>
void Star_index<D>::compact() {
  std::size_t end = 0;
  for (std::size_t i = 0; i < cells_.size();) {
    const std::uint32_t point = to_index(cells_[i]);
    const bool is_kept = kept_[point] == i + 1;
    if (is_kept) kept_[point] = static_cast<std::uint32_t>(end + 1);
    bool is_end = false;
    for (; !is_end; ++i) {
      is_end = cells_[i] == Cell::none;
      if (is_kept) cells_[end++] = cells_[i];
    }
  }
  cells_.resize(end);
  outdated_ = 0;
}

template <int D>
void Star_index<D>::replace(const Snapshot<D>& snapshot, std::span<const Cell> removed,
                            std::span<const std::uint32_t> points, std::span<const Cell> added) {
  const auto is_removed = [&](Cell c) { return std::ranges::find(removed, c) != removed.end(); };
  first_.resize(snapshot.points().size(), Cell::none);
  for (const std::uint32_t point : points) {
    forget(point);
    if (is_removed(first_[point])) first_[point] = Cell::none;
    for (auto part = parts_of(point); part != other_parts_.end() && part->first == point; ++part)
      if (is_removed(part->second)) part->second = Cell::none;
  }
  for (const Cell c : added)
    for (const std::uint32_t point : snapshot.view(c).vertices) {
      auto part = parts_of(point);
      while (part != other_parts_.end() && part->first == point && part->second != Cell::none) ++part;
      if (part != other_parts_.end() && part->first == point)
        part->second = c;
      else if (first_[point] == Cell::none)
        first_[point] = c;
    }
  // Parts that no new cell has.
  for (const std::uint32_t point : points)
    for (auto part = parts_of(point); part != other_parts_.end() && part->first == point;) {
      if (first_[point] == Cell::none) std::swap(first_[point], part->second);
      part = part->second == Cell::none ? other_parts_.erase(part) : part + 1;
    }
  constexpr std::size_t least = 4096;
  if (cells_.size() > least && outdated_ > cells_.size() / 2) compact();
}

template class Star_index<2>;
template class Star_index<3>;

}  // namespace cellwalk::detail
