// SPDX-License-Identifier: LGPL-3.0-or-later
// The content of a scene file: an environment, the objects that move in it, and the time steps. See
// docs/scenes.md.
#ifndef CELLWALK_INTERNAL_RECORDS_SCENE_H
#define CELLWALK_INTERNAL_RECORDS_SCENE_H

#include <cellwalk/internal/records/body_shape.h>
#include <cellwalk/internal/records/environment_change.h>
#include <cellwalk/internal/records/material.h>
#include <cellwalk/kernel/point.h>
#include <cellwalk/records/body_soup.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace cellwalk {

/// A generator by name with its numeric options (a single number is a list of one).
struct Generator_call {
  std::string generator;
  std::map<std::string, std::vector<double>> options;
};

/// A mesh to import, with options of `cellwalk import` by name.
struct Import_call {
  using Value = std::variant<bool, double, std::string, std::vector<double>>;
  std::string file;                    ///< relative to the scene's folder
  std::vector<std::string> obstacles;  ///< likewise
  std::map<std::string, Value> options;
  std::string cache;  ///< the folder where the environment is kept
};

/// The source of the environment: a mesh file (relative to the scene's folder), a generator call, or a mesh
/// to import.
using Environment_source = std::variant<std::string, Generator_call, Import_call>;

/// One free particle.
template <int D>
struct Particle_start {
  Point<D> position{};
  Vector<D> velocity{};
};

/// Random particles or bodies, uniformly distributed in free space, with velocities of equal speed in random
/// directions.
struct Particle_cloud {
  std::uint32_t count = 0;
  double speed = 0;
  std::uint64_t seed = 1;
};

/// The source of a body: a file (relative to the scene's folder) or a shape.
template <int D>
using Body_source = std::variant<std::string, Body_shape<D>>;

/// An angular velocity in radians per unit of time: about the axis it points along, or in 2D
/// counterclockwise.
template <int D>
using Spin = std::array<double, D == 2 ? 1 : 3>;

/// A prescribed motion along a path.
template <int D>
struct Guided_motion {
  std::vector<Point<D>> path;  ///< of the body's origin: at least two waypoints, successive ones different
  double speed = 1;            ///< along the path, in lengths per unit of time
};

/// One body, or copies of it at random positions.
template <int D>
struct Body_start {
  Body_source<D> source;
  /// Of guided bodies at the first waypoint; the position of random ones is not used.
  Body_placement<D> placement{};
  Vector<D> velocity{};  ///< of a single thrown body
  Spin<D> spin{};
  std::optional<Particle_cloud> cloud{};     ///< copies, each with its own position and velocity
  std::optional<Guided_motion<D>> guided{};  ///< none: the body is thrown, and flies freely under gravity
  std::optional<Shape_material> material{};  ///< of a thrown body; none: it is rigid
  std::optional<double> edge_radius{};       ///< how far its edges keep from every wall; none: as the source
};

/// The steering of a catheter towards its waypoints.
enum class Steering : std::uint8_t {
  tip,    ///< the tip is bent towards the next waypoint
  twist,  ///< the base is turned so that the natural curve of the tip points at it
  none,   ///< no steering; the base is turned evenly
};

/// An end of the centre line of a catheter: the name of a group of facets or cells, or a point.
template <int D>
using Catheter_end = std::variant<std::string, Point<D>>;

/// The ends of a centre line that is found in the cells.
template <int D>
struct Catheter_ends {
  Catheter_end<D> from, to;
};

/// An elastic rod that is pushed in at its base. With `ends`, numbers that are 0 follow from the centre line.
template <int D>
struct Catheter {
  std::uint32_t particles = 20;  ///< its vertices; they enter one by one at the start of the path
  double spacing = 1;            ///< distance between neighbours
  double advance = 0.5;          ///< distance by which it is pushed in a step
  double stiffness = 0.5;        ///< 0: a thread, 1: bends as little as the walls allow
  double radius = 0;             ///< how far it keeps from every wall
  std::vector<Point<D>> path;    ///< waypoints, at least two; it enters at the first, towards the second
  bool find_route = false;       ///< join waypoints by a route through the cells instead of straight lines
  std::optional<Catheter_ends<D>> ends{};  ///< of the path, before it is found
  Steering steering = Steering::tip;
  double tip_length = 0;  ///< of the naturally curved part at the tip
  double tip_angle = 0;   ///< angle of the natural curve from end to end, in degrees
  double twist = 0;       ///< degrees by which the base is turned in a step; the maximum with Steering::twist
};

/// A periodic motion of all walls along their normals.
template <int D>
struct Pulsation {
  double amplitude = 0;  ///< the furthest that a wall gets from where it stands at first
  double period = 1;     ///< in units of time
  /// The motion runs through the environment as a wave in this direction, of this length; none: all walls
  /// move alike.
  std::optional<Vector<D>> wave;
  /// The number of times that the directions in which walls go are evened out along them: each becomes the
  /// mean of itself and of the mean of those beside it; 0: they are the normals.
  std::uint32_t even = 0;
  /// The number of sweeps in which points between walls are smoothed, where cells are worse than
  /// `quality_floor` on the way; 0: they follow their neighbours only.
  std::uint32_t smooth = 0;
  double quality_floor = 0.2;  ///< from 0, a flat cell, to 1, a regular one
};

/// Walls that yield to bodies which press against them, and recover: an elastic (Winkler) foundation.
struct Soft_walls {
  double compliance = 1;     ///< yield of a vertex for a unit of force; that of bodies is 1
  double recovery = 0.05;    ///< share of the yield that is recovered in a step, 0 to 1
  std::uint32_t spread = 1;  ///< how many times the yield is shared with the neighbours along walls
};

/// Solid cells that are elastic: edges have lengths to which they return, and cells keep their volumes (2D:
/// areas). Compliances are shares of the inertia of a vertex over a step: with 0 a constraint is met as far
/// as sweeps allow, with 1 it gives way as much as the vertex does.
struct Tissue_material {
  double compliance = 0.1;    ///< of edges
  double incompressible = 1;  ///< share of the change of a volume that is undone in a sweep, 0 to 1
  double tension = 0;         ///< share by which edges are longer than they would be, 0 to below 1
  double damping = 0.5;       ///< share of velocities that is lost in a step; 1: nothing swings
  double yield = 0.5;         ///< share of the motion of a body against the tissue by which it gives way
  std::uint32_t sweeps = 10;  ///< over all edges and cells in a step
};

/// Cells around points that would make one of them flat are made better before the points go on: vertices
/// between walls move, and cells are replaced.
struct Wall_relaxation {
  double good_enough = 0.3;         ///< quality, 0 (flat) to 1 (regular), at which cells are left alone
  std::uint32_t rings = 2;          ///< of cells around such a point that are looked at
  std::uint32_t rounds = 4;         ///< through these cells, each time
  std::uint32_t operations = 1000;  ///< at most, each time
  std::uint32_t tries = 8;          ///< in a step
};

/// How the walls of an environment move.
template <int D>
struct Scene_walls {
  bool push = true;                   ///< they push bodies out of their way; otherwise they stop
  std::vector<Scene_shape<D>> fixed;  ///< where nothing moves
  std::optional<Pulsation<D>> pulsation;
  std::optional<Soft_walls> soft;
  std::optional<Tissue_material> tissue;
  /// A table of positions of points (relative to the scene's folder); empty: none.
  std::string motion;
  std::optional<Wall_relaxation> relax;  ///< of cells around points of `motion`; none: they are as they are
};

struct Picture_request {
  int width = 1600, height = 1000;  ///< pixels
  std::vector<double> toward, up;   ///< camera: empty or 3 numbers
};

struct Scene_output {
  std::uint32_t frame_every = 10;          ///< steps from one VTU frame to the next; 0: none
  std::optional<Picture_request> picture;  ///< a PNG of the last step
  /// Steps from one frame of the recording for `cellwalk view` to the next; 0: no recording; none: as
  /// required for a page of moderate size.
  std::optional<std::uint32_t> motion_every;
};

template <int D>
struct Scene {
  std::string title;
  Environment_source environment;
  std::vector<std::variant<Particle_start<D>, Particle_cloud>> particles;
  std::vector<Body_start<D>> bodies;
  std::optional<Catheter<D>> catheter;
  std::optional<Scene_walls<D>> walls;  ///< none: they stand still
  Environment_changes<D> changes;       ///< of facets and cells, in the order of the file
  Vector<D> gravity{};
  double restitution = 1;  ///< fraction of the normal speed that a free particle keeps when it bounces
  double friction = 0;     ///< fraction of the tangential speed that it loses
  double time_step = 0.01;
  std::uint32_t steps = 100;
  Scene_output output;
};

/// A scene of either dimension.
using Any_scene = std::variant<Scene<2>, Scene<3>>;

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_RECORDS_SCENE_H
