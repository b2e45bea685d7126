// SPDX-License-Identifier: LGPL-3.0-or-later
// The faces of a body: that no wall pierces them. 3D.
#include <cellwalk/body/body.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace cellwalk {

template <int D>
void Body<D>::link_faces() {
  const auto edge_of = [this](std::uint32_t u, std::uint32_t v) {
    const std::array<std::uint32_t, 2> ends{std::min(u, v), std::max(u, v)};
    return static_cast<std::uint32_t>(std::lower_bound(edges_.begin(), edges_.end(), ends) - edges_.begin());
  };
  face_corner_begin_.assign(positions_.size() + 1, 0);
  for (const auto& [u, v, w] : faces_) {
    sides_.push_back({edge_of(u, v), edge_of(v, w), edge_of(w, u)});
    for (const std::uint32_t x : {u, v, w}) ++face_corner_begin_[x + 1];
  }
  for (std::size_t v = 0; v < positions_.size(); ++v) face_corner_begin_[v + 1] += face_corner_begin_[v];
  face_corners_.resize(3 * faces_.size());
  std::vector<std::uint32_t> next(face_corner_begin_.begin(), face_corner_begin_.end() - 1);
  for (std::uint32_t f = 0; f < faces_.size(); ++f)
    for (std::uint32_t k = 0; k < 3; ++k) face_corners_[next[faces_[f][k]]++] = {f, k};
  rests_.resize(faces_.size());
}

template <int D>
Face_registration Body<D>::register_face_here(std::uint32_t face, Face_counts& counts) const {
  if constexpr (D == 3) {
    const auto [u, v, w] = faces_[face];
    const auto side = [&](std::size_t k, std::uint32_t from, std::uint32_t to) {
      return Side_chain{&chains_[sides_[face][k]], from > to};
    };
    return register_face(*snapshot_, particles_[u], particles_[v], particles_[w],
                         {side(0, u, v), side(1, v, w), side(2, w, u)}, counts, rests_[face]);
  } else {
    return {};
  }
}

template <int D>
void Body<D>::register_faces(Error_code code, Face_counts& counts) {
  for (std::uint32_t f = 0; f < rests_.size(); ++f) {
    const Face_registration found = register_face_here(f, counts);
    rests_[f] = found.rests;
    if (found.piercing == Half_facet::none) continue;
    const auto& [u, v, w] = faces_[f];
    const auto place = [this](std::uint32_t x) {
      return fmt::format("({})", fmt::join(positions_[x], ", "));
    };
    throw Error(
        code,
        fmt::format(
            "face {} of the body, with vertices {} at {}, {} at {} and {} at {}, is pierced by a wall "
            "of cell {}: move the body into free space",
            f, u, place(u), v, place(v), w, place(w), snapshot_->index(snapshot_->cell_of(found.piercing))));
  }
  are_faces_swept_ = true;
}

/// Before faces are swept after moves that left them alone: registers them all, so all that they are asked about is needed.
template <int D>
void Body<D>::take_up_faces(Body_counts& counts) {
  if (are_faces_swept_ || faces_.empty()) return;
  catch_up(counts);
  register_faces(Error_code::usage, counts.faces);
}

/// The chain of an edge of the vertex after its move, from the vertex; null if the edge is blocked.
template <int D>
const Chain* Body<D>::moved_chain(std::uint32_t vertex, std::uint32_t edge) const {
  // The corners of a vertex are in the order of their edges.
  const auto begin = corners_.begin() + corner_begin_[vertex],
             end = corners_.begin() + corner_begin_[vertex + 1];
  const auto corner = std::lower_bound(
      begin, end, edge, [](const Corner& known, std::uint32_t wanted) { return known.edge < wanted; });
  const Moved_chain& moved = moved_chains_[static_cast<std::size_t>(corner - begin)];
  return moved.is_free ? &moved.chain : nullptr;
}

template <int D>
void Body<D>::sweep_faces(std::uint32_t vertex, const Way<D>& way, std::optional<Body_contact<D>>& first,
                          Body_counts& counts) {
  if (faces_.empty()) return;
  if constexpr (D == 3) {
    for (std::uint32_t i = face_corner_begin_[vertex]; i < face_corner_begin_[vertex + 1]; ++i) {
      const auto [f, k] = face_corners_[i];
      const std::uint32_t q = faces_[f][(k + 1) % 3], r = faces_[f][(k + 2) % 3];
      // The edge across, of the corners that stand still, may be behind. Then it lies in a region free of walls, where it was when
      // its ends last moved: a chain is looked into where a wall meets its edge only, and none meets this one.
      const Chain& across = chains_[sides_[f][(k + 1) % 3]];
      const Face_chains chains{{moved_chain(vertex, sides_[f][k]), false},
                               {&across, q > r},
                               {moved_chain(vertex, sides_[f][(k + 2) % 3]), true}};
      const Face_result swept =
          sweep_face(*snapshot_, way, particles_[q], particles_[r], rests_[f], chains, counts.faces);
      if (swept.contact) {
        Contact<3> contact = *swept.contact;
        contact.body = Body_feature::face;
        if (!first || is_before(contact, first->contact)) first = {contact, vertex, f};
      } else if (!first && (!swept.rests.empty() || !rests_[f].empty())) {
        moved_rests_.emplace_back(f, swept.rests);
      }
    }
  }
}

#define CELLWALK_INSTANTIATE(D)                                                                     \
  template void Body<D>::link_faces();                                                              \
  template Face_registration Body<D>::register_face_here(std::uint32_t, Face_counts&) const;        \
  template void Body<D>::register_faces(Error_code, Face_counts&);                                  \
  template void Body<D>::take_up_faces(Body_counts&);                                               \
  template const Chain* Body<D>::moved_chain(std::uint32_t, std::uint32_t) const;                   \
  template void Body<D>::sweep_faces(std::uint32_t, const Way<D>&, std::optional<Body_contact<D>>&, \
                                     Body_counts&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
