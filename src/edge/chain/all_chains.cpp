// SPDX-License-Identifier: LGPL-3.0-or-later
// The repeated search for a chain that equals none of those found before.
#include <cellwalk/internal/edge/all_chains.h>
#include <cellwalk/internal/walk/sides_taken.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "link.h"

namespace cellwalk::detail {
namespace {

template <int D>
class Chain_lister {
 public:
  Chain_lister(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q, Walk_counts& counts)
      : snapshot_(snapshot), p_(p), q_(q), counts_(counts) {
    options_.crossed = &crossed_;
    options_.locates_contact = false;
  }

  All_chains run() {
    Sides_taken choices;
    for (int tries = 0; tries < most_side_tries; ++tries) {
      if (auto chain = follow(choices)) found_.chains.push_back(*std::move(chain));
      if (!take_next_sides(choices)) return std::move(found_);
    }
    found_.are_all = false;
    // A face that hangs from a row of walls needs the same side of all.
    for (std::uint16_t side = 1; side < most_sides_; ++side) add_uniform(side);
    return std::move(found_);
  }

 private:
  /// The chain on these sides, if it leads to q.
  std::optional<Chain> follow(Sides_taken& choices) {
    crossed_.clear();
    const Walk_result<D> walked = walk_on_sides(snapshot_, p_, q_.position, counts_, options_, choices);
    for (const Side_taken& choice : choices) most_sides_ = std::max(most_sides_, choice.sides);
    if (walked.status != Walk_status::arrived) return {};
    Chain chain(crossed_.begin(), crossed_.end());
    if (append_link(snapshot_, chain, walked.cell, q_.cell, q_.position, counts_) != Half_facet::none)
      return {};
    return chain;
  }

  /// Puts the chain on one side of all walls, or the last one where there are fewer, behind the first chain.
  void add_uniform(std::uint16_t side) {
    Sides_taken choices;
    std::optional<Chain> chain = follow(choices);
    for (std::size_t k = 0; k < choices.size(); ++k) {
      choices[k].taken = std::min<std::uint16_t>(side, choices[k].sides - 1);
      choices.resize(k + 1);
      chain = follow(choices);
    }
    auto& chains = found_.chains;
    if (!chain) return;
    std::erase(chains, *chain);
    chains.insert(chains.begin() + (chains.empty() ? 0 : 1), *std::move(chain));
  }

  const Snapshot<D>& snapshot_;
  const Particle<D>&p_, &q_;
  Walk_counts& counts_;
  Walk_options options_;
  std::vector<Half_facet> crossed_;
  std::uint16_t most_sides_ = 1;
  All_chains found_;
};

}  // namespace

template <int D>
All_chains all_chains(const Snapshot<D>& snapshot, const Particle<D>& p, const Particle<D>& q,
                      Walk_counts& counts) {
  return Chain_lister<D>(snapshot, p, q, counts).run();
}

template All_chains all_chains(const Snapshot<2>&, const Particle<2>&, const Particle<2>&, Walk_counts&);
template All_chains all_chains(const Snapshot<3>&, const Particle<3>&, const Particle<3>&, Walk_counts&);

}  // namespace cellwalk::detail
