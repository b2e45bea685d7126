// SPDX-License-Identifier: LGPL-3.0-or-later
#include "makers.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "touch.h"

namespace cellwalk::corpus {
namespace {

/// What makes two cases alike: the degeneracy, the answer, and the walls met.
template <int D>
std::string sort_of(const Case<D>& c) {
  std::string text =
      c.degeneracy + ' ' + c.nature + ' ' + crossing_names[static_cast<std::size_t>(c.crossing)];
  if (c.touch)
    for (const std::string& kind : c.touch->wall_kinds) text += ' ' + kind;
  return text;
}

template <int D>
bool complete(Maker<D>& maker, const World<D>& world, Case<D>& c) {
  c.crossing = Crossing::no;
  c.crossings.clear();
  c.touch.reset();
  c.nature.clear();
  if (!maker.judge(c)) return false;
  find_touch(world, c);
  c.degeneracy = degeneracy(world, c);
  return true;
}

template <int D>
bool same_answers(const Case<D>& a, const Case<D>& b) {
  return a.crossing == b.crossing && a.touch.has_value() == b.touch.has_value();
}

/// The case with its last target an ulp away, either way, if an answer changes.
template <int D>
std::vector<Case<D>> nudged(Maker<D>& maker, const World<D>& world, const Case<D>& base) {
  for (std::size_t axis = 0; axis < D; ++axis) {
    std::vector<Case<D>> both;
    for (const double towards : {-1.0, 1.0}) {
      Case<D> c = base;
      double& x = c.moves.back().to[axis];
      x = std::nextafter(x, towards * std::numeric_limits<double>::infinity());
      if (x == 0 || std::fpclassify(x) == FP_SUBNORMAL || !complete(maker, world, c)) break;
      c.degeneracy = base.degeneracy;
      c.near = base.id;
      both.push_back(c);
    }
    if (both.size() == 2 && (!same_answers(both[0], base) || !same_answers(both[1], base))) return both;
  }
  return {};
}

}  // namespace

template <int D>
std::vector<Placed_case<D>> make_cases(const std::vector<World<D>>& worlds, const Make_maker<D>& make_maker,
                                       const std::string& prefix, std::size_t cases) {
  constexpr std::size_t tries_a_visit = 40, most_rounds = 60, most_alike_a_world = 1;
  std::vector<std::unique_ptr<Maker<D>>> makers;
  for (std::size_t w = 0; w < worlds.size(); ++w) makers.push_back(make_maker(worlds[w], w));
  std::vector<Placed_case<D>> result;
  std::map<std::string, std::size_t> alike;
  std::map<std::pair<std::size_t, std::string>, std::size_t> alike_here;
  const auto add = [&](std::size_t w, Case<D> c) {
    c.id = fmt::format("{}-{:04}", prefix, result.size());
    result.push_back({w, c});
    return c;
  };
  // Sorts that are rare are met in later rounds: each round allows more cases that are alike.
  for (std::size_t round = 0; round < most_rounds; ++round)
    for (std::size_t w = 0; w < worlds.size(); ++w)
      for (std::size_t k = 0; k < tries_a_visit && result.size() < cases; ++k) {
        std::optional<Case<D>> c = makers[w]->propose();
        if (!c || !complete(*makers[w], worlds[w], *c)) continue;
        const std::string sort = sort_of(*c);
        if (alike[sort] > round / 4 + 1 || alike_here[{w, sort}] > round / 12 + most_alike_a_world) continue;
        ++alike[sort];
        ++alike_here[{w, sort}];
        const Case<D> base = add(w, *c);
        if (alike[sort] % 2 == 1)
          for (const Case<D>& beside : nudged(*makers[w], worlds[w], base)) add(w, beside);
      }
  return result;
}

template std::vector<Placed_case<2>> make_cases(const std::vector<World<2>>&, const Make_maker<2>&,
                                                const std::string&, std::size_t);
template std::vector<Placed_case<3>> make_cases(const std::vector<World<3>>&, const Make_maker<3>&,
                                                const std::string&, std::size_t);

}  // namespace cellwalk::corpus
