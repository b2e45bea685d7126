// SPDX-License-Identifier: LGPL-3.0-or-later
// The first root of the signs of a chain, and the facets on the other way round its ridge.
#include "strict_passage.h"

namespace cellwalk::detail {
namespace {

template <int D>
bool is_at(const Snapshot<D>& snapshot, Half_facet f, const Ridge& ridge) {
  return position_of(snapshot.view(snapshot.cell_of(f)), snapshot.facet_of(f), ridge).has_value();
}

/// The first root of some functions after a time, and whether others have it.
template <int D>
class First_root {
 public:
  explicit First_root(const Event_time<D>& after) : after_(after) {}

  /// True if the function has the given sign just after the time.
  bool note(const Moving_orientation<D>& f, int sign, std::size_t place, std::optional<Ridge> ridge) {
    if (after_.sign_after(f) != sign) return false;
    if (!f.has_root() || f.at_1() == sign) return true;
    auto& [end, end_place, end_ridge] = first_;
    if (end && end->is_certainly_before(f)) return true;
    const auto root = Event_time<D>::root_of(f);
    if (!end || root < *end)
      first_ = {root, place, ridge};
    else if (!end->is_root_of(f) && !(*end < root))
      end_ridge.reset();
    return true;
  }
  const Strict_passage<D>& get() const { return first_; }

 private:
  const Event_time<D>& after_;
  Strict_passage<D> first_;
};

}  // namespace

template <int D>
std::optional<Strict_passage<D>> pass_strictly(const Snapshot<D>& snapshot, const Moving_line<D>& line,
                                               const Chain& chain, const Particle<D>& q, std::size_t from) {
  // In the plane of a facet an edge without a chain may have a wall.
  if (chain.empty() && q.dimension != D) return {};
  First_root<D> first(line.time());
  for (std::size_t place = from; place < chain.size(); ++place) {
    const Cell_view<D> cell = snapshot.view(snapshot.cell_of(chain[place]));
    const std::size_t i = snapshot.facet_of(chain[place]);
    if (side<Exact>(cell, i, q.position, line.counts()) <= 0) return {};
    if (!first.note(line.side_of(cell, i), -1, place, {})) return {};
    for (std::size_t k = 0; k < cell.loop(i).size(); ++k)
      if (!first.note(line.along_of(cell, i, k), 1, place, ridge_of(cell, i, k))) return {};
  }
  return first.get();
}

template <int D>
bool turn_round(const Snapshot<D>& snapshot, const Chain& chain, std::size_t place, const Ridge& ridge,
                Chain& turned) {
  const auto first = chain.begin() + static_cast<std::ptrdiff_t>(place);
  auto rest = first + 1;
  while (rest != chain.end() && is_at(snapshot, *rest, ridge)) ++rest;
  const Cell last = snapshot.neighbour(*(rest - 1));
  turned.assign(chain.begin(), first);
  bool is_at_wall = false;
  const bool is_round = go_round(snapshot, *first, ridge, last, [&](Half_facet f) {
    turned.push_back(f);
    is_at_wall = snapshot.is_impassable(f);
    return !is_at_wall;
  });
  if (is_round) turned.insert(turned.end(), rest, chain.end());
  return is_round || is_at_wall;
}

#define CELLWALK_INSTANTIATE(D)                                                                              \
  template std::optional<Strict_passage<D>> pass_strictly<D>(const Snapshot<D>&, const Moving_line<D>&,      \
                                                             const Chain&, const Particle<D>&, std::size_t); \
  template bool turn_round<D>(const Snapshot<D>&, const Chain&, std::size_t, const Ridge&, Chain&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
