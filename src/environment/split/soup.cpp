// SPDX-License-Identifier: LGPL-3.0-or-later
// The check of every cell of a soup, and the refusal of those that no split can repair.
#include "soup.h"

#include <cellwalk/internal/environment/cell_check.h>
#include <cellwalk/kernel/error.h>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "environment/certify/shape.h"

namespace cellwalk::detail {
namespace {

/// Checks one cell after the other; one per thread.
template <int D>
class Soup_checker {
 public:
  explicit Soup_checker(const Cell_soup<D>& soup) : soup_(soup) {}

  Cell_check operator()(std::size_t c) {
    number_vertices(c);
    if (!(shape_ == sound_)) {
      const Cell_check check = check_shape<D>(shape_);
      if (check.defect != Cell_defect::none) return check;
      sound_ = shape_;
    }
    return check_geometry<D>(Cell_view<D>{&shape_, vertices_, soup_.points});
  }

 private:
  void number_vertices(std::size_t c) {
    shape_.loop_begin.assign(1, 0);
    shape_.loops.clear();
    vertices_.clear();
    for (std::size_t f = soup_.cell_begin[c]; f < soup_.cell_begin[c + 1]; ++f) {
      for (const std::uint32_t v : soup_.facet(f)) {
        const auto at = std::find(vertices_.begin(), vertices_.end(), v);
        shape_.loops.push_back(static_cast<std::uint16_t>(at - vertices_.begin()));
        if (at == vertices_.end()) vertices_.push_back(v);
      }
      shape_.loop_begin.push_back(static_cast<std::uint16_t>(shape_.loops.size()));
    }
    shape_.vertex_count = static_cast<std::uint16_t>(vertices_.size());
  }

  const Cell_soup<D>& soup_;
  Cell_shape shape_, sound_;
  std::vector<std::uint32_t> vertices_;
};

/// Refuses cells that a Cell_shape cannot describe.
template <int D>
void refuse_malformed(const Cell_soup<D>& soup) {
  const auto bad = std::find_if(soup.vertices.begin(), soup.vertices.end(),
                                [&](std::uint32_t v) { return v >= soup.points.size(); });
  const auto position = static_cast<std::uint32_t>(bad - soup.vertices.begin());
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    const std::uint32_t begin = soup.facet_begin[soup.cell_begin[c]],
                        end = soup.facet_begin[soup.cell_begin[c + 1]];
    if (end - begin > std::numeric_limits<std::uint16_t>::max())
      throw Error(Error_code::input,
                  cell_name(c) + " has more than 65535 facet corners: divide it beforehand");
    if (bad != soup.vertices.end() && position < end)
      throw Error(Error_code::input, cell_name(c) + ": vertex index " + std::to_string(*bad) +
                                         " is out of range: there are " + std::to_string(soup.points.size()) +
                                         " points");
  }
}

}  // namespace

template <int D>
std::vector<Cell_check> check_soup(const Cell_soup<D>& soup) {
  refuse_malformed(soup);
  std::vector<Cell_check> checks(soup.cell_count());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, checks.size(), 1024), [&](const auto& range) {
    Soup_checker<D> check(soup);
    for (std::size_t c = range.begin(); c != range.end(); ++c) checks[c] = check(c);
  });
  return checks;
}

void refuse_hopeless(const std::vector<Cell_check>& checks) {
  for (std::size_t c = 0; c < checks.size(); ++c) {
    switch (checks[c].defect) {
      case Cell_defect::not_finite:
        throw Error(Error_code::input, cell_name(c) + ": " + describe(checks[c]) + ": correct the input");
      case Cell_defect::not_closed:
      case Cell_defect::degenerate_facet:
      case Cell_defect::inverted:
      case Cell_defect::flat:
        throw Error(Error_code::not_certified, cell_name(c) + " cannot be split: " + describe(checks[c]) +
                                                   "; repair or remove the cell");
      default:
        break;
    }
  }
}

template std::vector<Cell_check> check_soup<2>(const Cell_soup<2>&);
template std::vector<Cell_check> check_soup<3>(const Cell_soup<3>&);

}  // namespace cellwalk::detail
