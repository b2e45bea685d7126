// SPDX-License-Identifier: LGPL-3.0-or-later
#include "numbers.h"

#include <cellwalk/internal/edge/may_intersect.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace cellwalk::figures {

void require(bool holds, const std::string& claim) {
  if (!holds) throw Error(Error_code::other, "does not hold: " + claim);
}

std::string text_of(const Exact_time& time) {
  std::ostringstream out;
  out << to_rational(time);
  return out.str();
}

Json to_json(const Exact_time& time) { return {{"exact", text_of(time)}, {"rounded", time.rounded()}}; }

template <int D>
Json to_json(const Snapshot<D>& snapshot, const Contact<D>& contact) {
  constexpr const char* body_features[] = {"vertex", "edge", "face"};
  constexpr const char* features[] = {"vertex", "edge", "facet"};
  const std::vector<std::uint32_t> loop = snapshot.loop(contact.facet);
  const std::size_t first = contact.kind == Contact_kind::facet ? 0 : contact.corner;
  const std::size_t size = contact.kind == Contact_kind::vertex ? 1
                           : contact.kind == Contact_kind::edge ? 2
                                                                : loop.size();
  Json points = Json::array();
  for (std::size_t i = 0; i < size; ++i) points.push_back(snapshot.point(loop[(first + i) % loop.size()]));
  return {{"time", to_json(contact.exact_time())},
          {"point", contact.point},
          {"normal", contact.normal},
          {"body", body_features[static_cast<std::size_t>(contact.body)]},
          {"environment",
           {{"kind", features[static_cast<std::size_t>(contact.kind)]},
            {"points", points},
            {"cell", snapshot.index(snapshot.cell_of(contact.facet))}}}};
}

template <int D>
std::vector<Cell> cells_met(const Snapshot<D>& snapshot, Cell start, const Swept_triangle<D>& triangle) {
  detail::Flooded found;
  Edge_counts counts;
  detail::flood(snapshot, start, triangle, counts, std::numeric_limits<std::size_t>::max(), found,
                [](Half_facet) { return true; });
  return {found.begin(), found.end()};
}

template <int D>
Json to_json(const Snapshot<D>& snapshot, const std::vector<Cell>& cells) {
  std::vector<std::uint32_t> indices;
  for (const Cell c : cells) indices.push_back(snapshot.index(c));
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
  return indices;
}

#define CELLWALK_INSTANTIATE(D)                                                                \
  template Json to_json<D>(const Snapshot<D>&, const Contact<D>&);                             \
  template std::vector<Cell> cells_met<D>(const Snapshot<D>&, Cell, const Swept_triangle<D>&); \
  template Json to_json<D>(const Snapshot<D>&, const std::vector<Cell>&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::figures
