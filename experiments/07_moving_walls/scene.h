// SPDX-License-Identifier: LGPL-3.0-or-later
// A vessel whose walls move, with bodies that stand still in it. Everything is computed by + - * / and sqrt,
// so that the motion is the same on every machine.
#ifndef CELLWALK_EXPERIMENTS_MOVING_WALLS_SCENE_H
#define CELLWALK_EXPERIMENTS_MOVING_WALLS_SCENE_H

#include <cellwalk/body/body.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/vessel.h>
#include <cellwalk/reshape/reshaping.h>

#include <memory>
#include <string_view>
#include <vector>

namespace cellwalk::moving_walls {

/// Which points of the environment move.
enum class Movers {
  one,      ///< a vertex of the wall, where the catheter is nearest to it
  hundred,  ///< the 100 vertices of the wall nearest to that place
  branch,   ///< all points, also between the walls, that are nearest to the centre line of the last branch
  all       ///< all points
};

std::string_view name_of(Movers movers);

/// A vessel of one fork. Bodies lie as near to its walls whatever the size of the cells.
class Scene {
 public:
  /// \param options what the soup was made with
  Scene(const Cell_soup<3>& soup, const Vessel_options& options, Movers movers);
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  Environment<3>& environment() { return environment_; }
  const Snapshot<3>& snapshot() const { return environment_.snapshot(); }
  const std::vector<std::unique_ptr<Body<3>>>& bodies() const { return bodies_; }
  Residents<3> residents();
  /// Where the points are to be after a step. One vertex, or 100, go into the vessel by 0.15 of the size of
  /// the cells and as far back behind where they were; else all go towards the centre lines by a twentieth of
  /// their distance, and away from them.
  /// \param time in beats
  std::vector<Vertex_move<3>> targets(double time) const;

 private:
  void add_catheter(const Locator<3>& locator, const Tube& trunk);
  void add_soft_bodies(const Locator<3>& locator, const std::vector<Tube>& tubes);
  void choose_movers(const Vessel_options& options, const std::vector<Tube>& tubes, Movers movers);

  struct Mover {
    std::uint32_t point;
    Point<3> home;
    Vector<3> amplitude;
  };
  Environment<3> environment_;
  std::vector<std::unique_ptr<Body<3>>> bodies_;
  Point<3> nearest_{};  ///< where the catheter is nearest to a wall
  std::vector<Mover> movers_;
};

}  // namespace cellwalk::moving_walls

#endif  // CELLWALK_EXPERIMENTS_MOVING_WALLS_SCENE_H
