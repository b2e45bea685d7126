// SPDX-License-Identifier: LGPL-3.0-or-later
// Makes the cases of a kind, with the answers of the oracles of the tests.
#ifndef CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_MAKERS_H
#define CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_MAKERS_H

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "case.h"

namespace cellwalk::corpus {

/// Makes cases in one world.
template <int D>
class Maker {
 public:
  virtual ~Maker() = default;
  /// A random motion, not judged yet; none if it starts where no free space is.
  virtual std::optional<Case<D>> propose() = 0;
  /// Finds all answers. False if the motion leaves a choice before it ends, so that there is not one answer.
  virtual bool judge(Case<D>& c) = 0;
};

template <int D>
using Make_maker = std::function<std::unique_ptr<Maker<D>>(const World<D>&, std::uint64_t seed)>;

template <int D>
std::unique_ptr<Maker<D>> walk_maker(const World<D>& world, std::uint64_t seed);
template <int D>
std::unique_ptr<Maker<D>> sweep_maker(const World<D>& world, std::uint64_t seed);
std::unique_ptr<Maker<3>> face_maker(const World<3>& world, std::uint64_t seed);
/// \pre the cells of the world are simplices
template <int D>
std::unique_ptr<Maker<D>> moving_wall_maker(const World<D>& world, std::uint64_t seed);

/// A case and the world in which it is.
template <int D>
struct Placed_case {
  std::size_t world;
  Case<D> c;
};

/// Some of each degeneracy, with each answer; and beside some of them two whose target is an ulp away.
template <int D>
std::vector<Placed_case<D>> make_cases(const std::vector<World<D>>& worlds, const Make_maker<D>& make_maker,
                                       const std::string& prefix, std::size_t cases);

}  // namespace cellwalk::corpus

#endif  // CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_MAKERS_H
