// SPDX-License-Identifier: LGPL-3.0-or-later
// Layers of cells that are cut in different ways, and points that are moved: unintended walls are
// refused, exactly where brute force in rationals finds them, and refined to cells that conform.
#include "environment/nonconforming.h"

#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/environment/refine.h>

#include <cmath>
#include <string>

#include "environment/facing_oracle.h"
#include "fuzz/decoder.h"
#include "fuzz/targets.h"

namespace cellwalk::fuzz {
namespace {

/// Moves a point by a few units in the last place, or by quarters.
template <int D>
void nudge(Cell_soup<D>& soup, Decoder& in) {
  Point<D>& point = soup.points[in.below(soup.points.size())];
  double& x = point[in.below(D)];
  const auto steps = static_cast<std::int8_t>(in.byte());
  if (in.flag()) {
    x += steps / 4.0;
    return;
  }
  for (int i = 0; i < std::abs(steps) % 8; ++i) x = std::nextafter(x, steps < 0 ? -1e9 : 1e9);
}

/// Cells that do not overlap are refined to cells that conform, or refused with a reason.
template <int D>
void refine_and_judge(const Cell_soup<D>& soup, const Build_report& kept, double tolerance) {
  Cell_soup<D> refined = soup;
  Soup_groups groups;
  const auto codes = {Error_code::not_certified};
  if (!reads([&] { refine(refined, groups, tolerance); }, codes)) return;
  Build_report built;
  const bool is_exact = tolerance == 0;
  const auto build = [&] {
    Environment<D>::build(refined, {.duplicates = Duplicate_vertices::merge, .split = !is_exact}, &built);
  };
  if (!is_exact) {
    reads(build, {Error_code::input, Error_code::not_certified});
    return;
  }
  build();
  demand(built.certificate.cells == kept.certificate.cells, "no cell is cut");
  demand(built.certificate.membranes == kept.certificate.membranes, "no wall is made");
  const double volume = kept.certificate.free_volume;
  demand(std::abs(built.certificate.free_volume - volume) <= 1e-9 * volume, "free space stays as it is");
}

template <int D>
void build_and_judge(Decoder& in) {
  const std::uint8_t kinds = in.byte();
  test::Layers_options options;
  options.cells = kinds & 1;
  options.hanging = kinds & 2;
  options.shifted = kinds & 4;
  options.collinear = kinds & 8;
  options.incomplete = kinds & 16;
  options.turned = kinds & 32;
  options.gap = kinds & 64 ? std::ldexp(1.0, -static_cast<int>(in.below(64))) : -1;
  Cell_soup<D> soup = test::layers<D>(options, [&](std::size_t n) { return in.below(n); });
  if (soup.cell_count() == 0) return;
  for (std::size_t n = in.below(4); n > 0; --n) nudge(soup, in);
  Build_report kept;
  const auto codes = {Error_code::not_certified};
  if (!reads(
          [&] {
            Environment<D>::build(soup, {.duplicates = Duplicate_vertices::keep, .split = false}, &kept);
          },
          codes))
    return;
  const auto expected = test::overlapping_facets(soup);
  demand(kept.facing.overlapping.pairs == expected.size(), "facets overlap as rationals say");
  demand(expected.empty() || kept.facing.overlapping.cells == expected[0], "the first pair is named");
  const bool is_read = reads([&] { Environment<D>::build(soup, {.split = false}); }, codes);
  demand(!is_read || expected.empty(), "unintended walls are refused");
  const bool is_merged =
      reads([&] { Environment<D>::build(soup, {.duplicates = Duplicate_vertices::merge, .split = false}); },
            {Error_code::input, Error_code::not_certified});
  demand(!is_read || is_merged, "what is accepted with points apart has none to merge");
  refine_and_judge(soup, kept, in.flag() ? 1e-9 : 0);
}

}  // namespace

void nonconforming(std::string_view bytes) {
  Decoder in(bytes);
  if (in.flag())
    build_and_judge<3>(in);
  else
    build_and_judge<2>(in);
}

}  // namespace cellwalk::fuzz
