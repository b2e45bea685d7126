// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies and spans of particles alike, and which of their vertices and edges lie in a cell.
#ifndef CELLWALK_RESHAPE_RESIDENTS_RESIDENT_GROUPS_H
#define CELLWALK_RESHAPE_RESIDENTS_RESIDENT_GROUPS_H

#include <cellwalk/internal/body/body_access.h>
#include <cellwalk/internal/kernel/box.h>
#include <cellwalk/reshape/move.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "member.h"
#include "thick_members.h"

namespace cellwalk::detail {

/// A body, or a span of particles.
template <int D>
struct Resident_group {
  std::optional<Body_access<D>> body;
  std::span<Particle<D>> particles;  ///< of a body: once it is open
  std::span<const std::array<std::uint32_t, 2>> edges;
  std::span<const std::array<std::uint32_t, 3>> faces;
  Box<D> reach;       ///< of all places that its registration depends on, and of what is within its radii
  double radius = 0;  ///< the largest
  bool is_open = false;
};

/// Groups are opened when a vertex of the environment moves near them: stale vertices and edges are
/// registered while the cells on which they depend still stand. From then on their vertices and edges are
/// known by cell.
template <int D>
class Resident_groups {
 public:
  /// \throw Error(usage) for a body of another environment, or one registered before an edit
  Resident_groups(const Snapshot<D>& snapshot, const Residents<D>& residents);

  /// Opens the groups whose reach meets a box. Returns their number.
  /// \throw Error(usage) for a particle that does not lie in its cell
  std::size_t open(const Box<D>& box);
  bool has_open() const { return open_ != 0; }

  const std::vector<Resident_group<D>>& all() const { return groups_; }
  Resident at(Member member, Body_feature feature) const;
  Particle<D>& particle(Member vertex) { return groups_[vertex.group].particles[vertex.number]; }
  Chain& chain(Member edge) { return groups_[edge.group].body->chain(edge.number); }

  /// Sets the walls on which a face rests. Takes no memory.
  void rest(Member face, Supporting_walls&& walls) noexcept {
    groups_[face.group].body->rest(face.number, std::move(walls));
  }
  /// The vertices of a feature of a resident.
  std::vector<Member> vertices_of(const Resident& resident) const;
  /// Moves a vertex as far as walls allow: one of a body as a step of that does, a particle until it meets
  /// one. Returns whether it moved.
  /// \pre its group is open
  bool push(Member vertex, const Vector<D>& by, const Body_options& options);

  /// Sets the vertices registered in some cells, and the edges that may pass them; ascending.
  void find(std::span<const Cell> cells, std::vector<Member>& vertices, std::vector<Member>& edges);

  /// The vertices and edges with a radius, of groups that are open.
  Thick_members<D>& thick() { return thick_; }
  /// Appends those that are nearer than their radius to a hull.
  void add_nearer(std::span<const Point<D>> hull, std::vector<Resident>& result);

  /// The faces of bodies that keep faces, and are open, whose boxes meet a box.
  std::vector<Member> faces_near(const Box<D>& box) const;

  // Entries into the table of cells, for members that are to be registered anew: they come first, since they
  // take memory. Old ones stay, and those of members that are not registered anew after all do no harm.
  void enter_vertex(Member vertex, Cell cell) { enter(cell, vertex, false); }
  /// \param first the cell of its first end then
  /// \param now its chain then
  /// \param before its chain at the last time
  void enter_edge(Member edge, Cell first, const Chain& now, const Chain& before);
  /// The same, into those of its cells that are among some, which are ascending.
  void enter_edge_among(Member edge, Cell first, const Chain& now, std::span<const Cell> among);
  /// Drops the entries of cells that are gone.
  void forget(std::span<const Cell> cells);

  /// Bodies go on in the environment as it is now.
  void follow_epoch();

 private:
  static constexpr std::uint32_t none = 0xffffffffu;
  struct Entry {
    Member member;
    bool is_edge;
    std::uint32_t next;
  };
  void enter(Cell cell, Member member, bool is_edge);
  void enter_all(std::uint32_t group);
  void add_thick(std::uint32_t group);
  void enter_anew();
  std::size_t body_count() const;

  const Snapshot<D>& snapshot_;
  std::vector<Resident_group<D>> groups_;
  std::size_t open_ = 0;
  std::unordered_map<std::uint32_t, std::uint32_t> first_;  ///< entry of each cell
  std::vector<Entry> entries_;
  std::size_t most_entries_ = 0;         ///< with more, outdated ones are dropped; 0: some are missing
  std::vector<std::size_t> first_edge_;  ///< of each group, when all edges are numbered
  std::vector<std::uint64_t> seen_;      ///< of each edge, the last list of a cell that had it
  std::uint64_t lists_ = 0;              ///< searched so far
  Thick_members<D> thick_;
};

extern template class Resident_groups<2>;
extern template class Resident_groups<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_RESIDENTS_RESIDENT_GROUPS_H
