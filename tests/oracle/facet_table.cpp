// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <map>
#include <stdexcept>

#include "oracle/exact_world.h"

namespace cellwalk::oracle {

template <int D>
Facet_table make_facet_table(const Cell_soup<D>& soup) {
  Facet_table table;
  table.opposite.assign(soup.facet_count(), -1);
  table.passable.assign(soup.facet_count(), 0);
  for (std::size_t c = 0; c < soup.cell_count(); ++c)
    table.cell.insert(table.cell.end(), soup.cell_begin[c + 1] - soup.cell_begin[c],
                      static_cast<std::uint32_t>(c));
  std::map<std::vector<std::uint32_t>, std::size_t> unmatched;
  for (std::size_t f = 0; f < soup.facet_count(); ++f) {
    std::vector<std::uint32_t> key(soup.facet(f).begin(), soup.facet(f).end());
    std::sort(key.begin(), key.end());
    const auto [other, is_new] = unmatched.try_emplace(key, f);
    if (is_new) continue;
    const std::size_t g = other->second;
    if (table.opposite[g] >= 0) throw std::invalid_argument("three cells share a facet");
    table.opposite[f] = static_cast<std::int64_t>(g);
    table.opposite[g] = static_cast<std::int64_t>(f);
    table.passable[f] = table.passable[g] = !soup.impassable[f] && !soup.impassable[g] &&
                                            !soup.solid[table.cell[f]] && !soup.solid[table.cell[g]];
  }
  return table;
}

template Facet_table make_facet_table(const Cell_soup<2>&);
template Facet_table make_facet_table(const Cell_soup<3>&);

int integer_shift(double x) { return -to_dyadic(x).exponent; }

}  // namespace cellwalk::oracle
