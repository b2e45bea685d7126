// SPDX-License-Identifier: LGPL-3.0-or-later
// What a method of this experiment is: it is built once for the walls of a scene, and answers a recorded
// motion step by step.
//
// Rule (docs/formats.md, traces of any bodies): before a step all vertices are put where the trace says.
// Then, body by body and vertex by vertex, the vertex stays if a wall meets the segment to its target, or a
// segment from there to where one of its neighbours is now; else it moves.
#ifndef CELLWALK_EXPERIMENTS_REAL_SCENES_PEERS_PEER_H
#define CELLWALK_EXPERIMENTS_REAL_SCENES_PEERS_PEER_H

#include <cellwalk/body/step.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "../motion.h"
#include "common/peers/measured_build.h"
#include "common/peers/wall_mesh.h"

namespace cellwalk::real_scenes {

using experiments::Build;
using experiments::Wall_mesh;

class Peer {
 public:
  virtual ~Peer() = default;
  /// Drops what is remembered of an earlier replay.
  virtual void prepare() = 0;
  /// Puts all vertices where they stand before a step. It is not timed.
  virtual void place(std::span<const Point<3>> positions) = 0;
  /// Moves them to their targets, by its own answers. This is what is timed.
  /// \param blocked receives 1 for each vertex that stays, else 0; or see note()
  virtual void step(std::span<const Point<3>> targets, std::span<std::uint8_t> blocked) = 0;
  /// Writes the answers of the step just done, where step() did not. It is not timed.
  virtual void note(std::span<std::uint8_t> blocked) { static_cast<void>(blocked); }
  /// The work since prepare(), of Cellwalk.
  virtual std::optional<Body_counts> counts() const { return {}; }

  std::string name;             ///< in tables: lower case and underscores
  std::string library;          ///< "cellwalk", "bullet", ...
  bool is_exact = false;        ///< decides by exact signs
  bool is_reproducible = true;  ///< its answers are the same on every machine
  double margin_steps = 0;      ///< by how many steps boxes are enlarged
  Build build;
  double edge_cells = 0;  ///< of Cellwalk: the mean number of cells that an edge lies in
};

using Peers = std::vector<std::unique_ptr<Peer>>;

/// The margins that methods with kept boxes are measured with, in steps.
inline constexpr double margins[] = {2, 6, 20};

/// A method that keeps positions of its own.
class Placed_peer : public Peer {
 public:
  explicit Placed_peer(const Motion& motion) : motion_(motion), positions_(motion.trace.vertices()) {}
  void place(std::span<const Point<3>> positions) override {
    std::ranges::copy(positions, positions_.begin());
  }

 protected:
  const Motion& motion_;
  std::vector<Point<3>> positions_;
};

/// The walls of a scene, in the forms that methods are built from.
struct Scene_walls {
  const Cell_soup<3>* soup = nullptr;
  const Wall_mesh* mesh = nullptr;  ///< Facing::wall
};

// Each appends its methods; walls and motion must outlive them.
void add_cellwalk_peers(const Scene_walls& walls, const Motion& motion, Peers& peers);
void add_cgal_peers(const Scene_walls& walls, const Motion& motion, Peers& peers);
void add_bullet_peers(const Scene_walls& walls, const Motion& motion, Peers& peers);
void add_fcl_peers(const Scene_walls& walls, const Motion& motion, Peers& peers);
void add_embree_peers(const Scene_walls& walls, const Motion& motion, Peers& peers);

}  // namespace cellwalk::real_scenes

#endif  // CELLWALK_EXPERIMENTS_REAL_SCENES_PEERS_PEER_H
