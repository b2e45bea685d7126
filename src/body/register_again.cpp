// SPDX-License-Identifier: LGPL-3.0-or-later
#include "register_again.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "body_faces.h"

namespace cellwalk::detail {
namespace {

/// What is known of a body by names of today.
template <int D>
class Known_names {
 public:
  Known_names(const Snapshot<D>& snapshot, const Edits_since& edits) : snapshot_(snapshot), edits_(edits) {}

  /// The cell of a point, or a part of it that holds the point; Cell::none if it is gone.
  Cell cell(Cell before, const Point<D>& position) const {
    const Cell name = edits_.renamed(before);
    if (is_same(name)) return name;
    if (edits_.are_renamed()) return Cell::none;
    for (const Cell part : edits_.parts_of(before))
      if (snapshot_.is_cell(part) && in_closure(snapshot_, part, position)) return part;
    return Cell::none;
  }
  void rename(Chain& chain) const {
    for (Half_facet& f : chain) f = edits_.renamed(f);
  }
  /// Leaves out those that are gone.
  void rename(Supporting_walls& walls) const {
    for (Half_facet& f : walls) f = edits_.renamed(f);
    const auto is_gone = [this](Half_facet f) {
      return to_index(f) >= snapshot_.half_facet_slots() || !is_same(snapshot_.cell_of(f));
    };
    walls.erase(std::remove_if(walls.begin(), walls.end(), is_gone), walls.end());
  }

 private:
  bool is_same(Cell cell) const { return snapshot_.is_cell(cell) && !edits_.is_new(cell); }

  const Snapshot<D>& snapshot_;
  const Edits_since& edits_;
};

template <int D>
Registered_before<D> known_of(const Body_state<D>& body) {
  Registered_before<D> result;
  result.edits = body.snapshot->edits().since(body.epoch);
  const Known_names<D> names(*body.snapshot, result.edits);
  result.particles = body.particles;
  for (std::size_t v = 0; v < body.positions.size(); ++v)
    result.particles[v].cell = names.cell(body.particles[v].cell, body.positions[v]);
  result.chains = body.chains;
  result.may_keep_chain.assign(body.chains.size(), true);
  if (result.edits.are_renamed())
    for (Chain& chain : result.chains) names.rename(chain);
  if (body.are_faces_swept) result.supporting_walls = body.supporting_walls;
  for (Supporting_walls& of_face : result.supporting_walls) names.rename(of_face);
  return result;
}

}  // namespace

template <int D>
std::unique_ptr<Body_state<D>> registered_again(const Body_state<D>& body, const Locator<D>& locator) {
  const Body_soup<D> soup{body.positions, body.topology.edges(), body.topology.faces()};
  Registered_before<D> known = known_of(body);
  const auto make = [&] {
    return std::make_unique<Body_state<D>>(*body.snapshot, locator, soup, known, body.certificates);
  };
  auto state = make();
  state->are_faces_swept = body.are_faces_swept;
  if constexpr (D == 3) {
    if (!body.are_faces_swept) return state;
    Face_counts uncounted;
    const auto register_all = [&] {
      std::ranges::copy(known.supporting_walls, state->supporting_walls.begin());
      return register_faces(*state, uncounted);
    };
    std::vector<Pierced_face> pierced = register_all();
    if (pierced.empty()) return state;
    // A wall may have come between a face and an edge whose chain was kept: another chain may pass it.
    for (const Pierced_face& of : pierced)
      for (const std::uint32_t edge : body.topology.sides(of.face)) known.may_keep_chain[edge] = false;
    state = make();
    pierced = register_all();
    if (pierced.empty()) return state;
    // Or between vertices that were on no side of it, in cells on both.
    known.prefers_cells = false;
    known.may_keep_chain.assign(body.chains.size(), false);
    state = make();
    pierced = register_all();
    if (!pierced.empty()) refuse_pierced(*state, pierced.front(), Error_code::outside);
  }
  return state;
}

template std::unique_ptr<Body_state<2>> registered_again(const Body_state<2>&, const Locator<2>&);
template std::unique_ptr<Body_state<3>> registered_again(const Body_state<3>&, const Locator<3>&);

}  // namespace cellwalk::detail
