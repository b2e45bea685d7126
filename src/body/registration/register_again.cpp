// SPDX-License-Identifier: LGPL-3.0-or-later
// The sides of walls of a body before edits, by the new names of cells and facets.
#include "register_again.h"

#include <cellwalk/kernel/exact.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "body/shape/body_faces.h"

namespace cellwalk::detail {
namespace {

/// The registration of a body before edits, by the names of today.
template <int D>
class Known_names {
 public:
  Known_names(const Snapshot<D>& snapshot, const Edits_since& edits) : snapshot_(snapshot), edits_(edits) {}

  /// Cell::none if it is gone.
  Cell cell(Cell before) const {
    const Cell name = edits_.renamed(before);
    return is_same(name) ? name : Cell::none;
  }
  /// The parts of a cell that hold a point.
  std::vector<Cell> parts(Cell before, const Point<D>& position) const {
    std::vector<Cell> result;
    if (edits_.are_renamed()) return result;
    for (const Cell part : edits_.parts_of(before))
      if (snapshot_.is_cell(part) && in_closure(snapshot_, part, position)) result.push_back(part);
    return result;
  }
  void rename(Chain& chain) const {
    for (Half_facet& f : chain) f = edits_.renamed(f);
  }
  /// Leaves out those that are gone. Walls of parts of a cell in the plane of the face take their place.
  void rename(Supporting_walls& walls, const std::array<Point<D>, 3>& face) const {
    Supporting_walls known;
    for (const Half_facet f : walls) {
      const Half_facet name = edits_.renamed(f);
      if (to_index(name) < snapshot_.half_facet_slots() && is_same(snapshot_.cell_of(name)))
        known.push_back(name);
      else if (!edits_.are_renamed())
        add_walls_of_parts(f, face, known);
    }
    walls = std::move(known);
  }

 private:
  bool is_same(Cell cell) const { return snapshot_.is_cell(cell) && !edits_.is_new(cell); }

  void add_walls_of_parts(Half_facet before, const std::array<Point<D>, 3>& face,
                          Supporting_walls& known) const {
    // The name of the cell is that of the first of its blocks of four facets.
    constexpr std::uint32_t most_blocks = 4;
    const std::uint32_t block = to_index(before) / 4;
    for (std::uint32_t back = 0; back < most_blocks && back <= block; ++back) {
      const Cell cell{block - back};
      const std::vector<Cell> parts = edits_.parts_of(cell);
      if (parts.size() == 1 && parts.front() == cell) continue;
      for (const Cell part : parts)
        if (snapshot_.is_cell(part)) add_walls_in_plane(part, face, known);
      return;
    }
  }

  void add_walls_in_plane(Cell cell, const std::array<Point<D>, 3>& face, Supporting_walls& known) const {
    if constexpr (D == 3) {
      Predicate_counts uncounted;
      const Cell_view<3> view = snapshot_.view(cell);
      for (std::size_t k = 0; k < view.facet_count(); ++k) {
        const auto loop = view.loop(k);
        const Half_facet f = Snapshot<3>::half_facet(cell, k);
        const auto is_in_plane = [&](std::uint16_t v) {
          return Exact::orientation(uncounted, face[0], face[1], face[2], view.point(v)) == 0;
        };
        if (snapshot_.is_impassable(f) && std::all_of(loop.begin(), loop.end(), is_in_plane))
          known.push_back(f);
      }
    }
  }

  const Snapshot<D>& snapshot_;
  const Edits_since& edits_;
};

template <int D>
Registered_before<D> known_of(const Body_state<D>& body) {
  Registered_before<D> result;
  result.edits = body.snapshot->edits().since(body.epoch);
  const Known_names<D> names(*body.snapshot, result.edits);
  result.particles = body.particles;
  for (std::uint32_t v = 0; v < body.positions.size(); ++v) {
    Cell& cell = result.particles[v].cell;
    const Cell before = std::exchange(cell, names.cell(cell));
    if (cell != Cell::none) continue;
    const std::vector<Cell> parts = names.parts(before, body.positions[v]);
    if (parts.empty()) continue;
    cell = parts.front();
    result.parts[v] = parts;
  }
  result.chains = body.chains;
  result.may_keep_chain.assign(body.chains.size(), true);
  if (result.edits.are_renamed())
    for (Chain& chain : result.chains) names.rename(chain);
  if (body.are_faces_swept) result.supporting_walls = body.supporting_walls;
  for (std::size_t f = 0; f < result.supporting_walls.size(); ++f) {
    const auto [u, v, w] = body.topology.faces()[f];
    names.rename(result.supporting_walls[f], {body.positions[u], body.positions[v], body.positions[w]});
  }
  return result;
}

/// Faces that have come to the other side of a wall that supported them.
std::vector<Pierced_face> faces_turned(const Body_state<3>& body,
                                       const std::vector<Supporting_walls>& known) {
  std::vector<Pierced_face> result;
  for (std::uint32_t f = 0; f < known.size(); ++f) {
    const Supporting_walls& now = body.supporting_walls[f];
    for (const Half_facet wall : known[f]) {
      const Half_facet behind = body.snapshot->opposite(wall);
      if (behind == Half_facet::none || std::ranges::find(now, wall) != now.end() ||
          std::ranges::find(now, behind) == now.end())
        continue;
      result.push_back({f, wall});
      break;
    }
  }
  return result;
}

}  // namespace

template <int D>
std::unique_ptr<Body_state<D>> registered_again(const Body_state<D>& body, const Locator<D>& locator) {
  const Body_soup<D> soup = body.soup();
  Registered_before<D> known = known_of(body);
  const auto make = [&] {
    return std::make_unique<Body_state<D>>(*body.snapshot, locator, soup, known, body.certificates);
  };
  auto state = make();
  state->are_faces_swept = body.are_faces_swept;
  check_distances(*state, state->thick, Error_code::outside);
  if constexpr (D == 3) {
    if (!body.are_faces_swept) return state;
    Face_counts uncounted;
    const auto register_all = [&] {
      std::ranges::copy(known.supporting_walls, state->supporting_walls.begin());
      std::vector<Pierced_face> pierced = register_faces(*state, uncounted);
      return pierced.empty() ? faces_turned(*state, known.supporting_walls) : pierced;
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
