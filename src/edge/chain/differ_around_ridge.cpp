// SPDX-License-Identifier: LGPL-3.0-or-later
// The comparison of the facets in which two chains differ with those round a ridge.
#include "differ_around_ridge.h"

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>

namespace cellwalk::detail {
namespace {

/// The point indices that facets have in common.
using Common_points = boost::container::small_vector<std::uint32_t, 8>;

template <int D>
bool holds(const Cell_view<D>& cell, std::size_t i, std::uint32_t point) {
  const auto loop = cell.loop(i);
  return std::any_of(loop.begin(), loop.end(), [&](std::uint16_t v) { return cell.point_index(v) == point; });
}

}  // namespace

template <int D>
bool differ_only_around_one_ridge(const Snapshot<D>& snapshot, const Moving_line<D>& line, const Chain& chain,
                                  const Chain& other) {
  const auto [first, other_first] = std::mismatch(chain.begin(), chain.end(), other.begin(), other.end());
  auto last = chain.end(), other_last = other.end();
  while (last != first && other_last != other_first && *(last - 1) == *(other_last - 1)) {
    --last;
    --other_last;
  }
  Common_points common;
  bool is_first = true;
  const auto narrow = [&](Half_facet f) {
    const Cell_view<D> cell = snapshot.view(snapshot.cell_of(f));
    const std::size_t i = snapshot.facet_of(f);
    if (side<Exact>(cell, i, line.triangle().q, line.counts()) == 0) return false;
    if (is_first)
      for (const std::uint16_t v : cell.loop(i)) common.push_back(cell.point_index(v));
    else
      common.erase(std::remove_if(common.begin(), common.end(),
                                  [&](std::uint32_t point) { return !holds(cell, i, point); }),
                   common.end());
    is_first = false;
    return common.size() >= D - 1;
  };
  if (!std::all_of(first, last, narrow) || !std::all_of(other_first, other_last, narrow)) return false;
  if (is_first) return true;
  const auto ridge = line.against(snapshot.point(common.front()), snapshot.point(common.back()));
  return line.time().sign_of(ridge) == 0;
}

template bool differ_only_around_one_ridge<2>(const Snapshot<2>&, const Moving_line<2>&, const Chain&,
                                              const Chain&);
template bool differ_only_around_one_ridge<3>(const Snapshot<3>&, const Moving_line<3>&, const Chain&,
                                              const Chain&);

}  // namespace cellwalk::detail
