// SPDX-License-Identifier: GPL-3.0-or-later
// The steps of a repair, in order.
#include <cellwalk/internal/meshing/repair_surface.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "box_mesh.h"
#include "caps.h"
#include "cavity.h"
#include "changes.h"
#include "crossings.h"
#include "edges.h"
#include "facets.h"
#include "free_cells.h"
#include "meshing/fill/scale.h"
#include "meshing/fill/tetgen_bounds.h"
#include "near_points.h"
#include "parts.h"
#include "patches.h"
#include "prepare.h"
#include "tidy.h"
#include "wall_distance.h"

namespace cellwalk {
namespace {

using namespace detail;

/// Points that cuts made are joined with others nearer than this part of the size. Without it, rounding makes
/// three cubes in general position cross for ever.
constexpr double rounding_apart = 1e-9;
/// A region is free if the surface surrounds it more often than this.
constexpr double surrounded = 0.5;
/// The volume of the regions agrees with that of the surface to this part of it.
constexpr double volume_rounding = 1e-14;  // in parts of the cube of the size
constexpr double volume_tolerance = 1e-9, volume_tolerance_welded = 1e-6;

class Repair {
 public:
  Repair(const Repair_options& options, const Tetrahedralize_options& mesh, Repair_report& report)
      : options_(options), mesh_(mesh), report_(report) {}

  Repaired_surface run(const Surface_soup& soup) {
    Prepared prepared = prepare(soup, options_, report_, mesh_.limits.on_wait);
    surface_ = std::move(prepared.surface), given_ = std::move(prepared.given);
    caps_ = std::move(prepared.caps), one_sided_ = std::move(prepared.one_sided);
    if (surface_.facets.empty()) refuse_nothing();
    wait();
    const auto crossing = crossing_pairs(surface_);
    orient(crossing);
    oriented_ = surface_;
    Free_space space = free_space(crossing);
    note("opened", "inside other parts opened", opened_facets(space), "facet", "facets");
    const Found small = leave_out_small(space);
    if (small.count != 0)
      say("left_out",
          fmt::format("{} of {:.2g} of the largest together left out",
                      counted(small.count, "component", "components"), small.measured),
          small);
    return finish(std::move(space));
  }

 private:
  void say(const std::string& step, const std::string& text, const Found& found) {
    detail::report(report_.changes, step, text, found);
  }
  void note(const std::string& step, const std::string& what, const Found& found, const std::string& one,
            const std::string& many) {
    if (found.count != 0) say(step, counted(found.count, one, many) + " " + what, found);
  }
  void wait() const {
    if (mesh_.limits.on_wait) mesh_.limits.on_wait();
  }

  /// The limit of time is one for all meshes.
  double seconds_left() const {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    constexpr double least = 1e-3;  // limits are greater than 0
    return std::max(least, mesh_.limits.seconds - elapsed.count());
  }

  void orient(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& crossing) {
    const Oriented oriented = orient_by_nesting(surface_, crossing);
    if (oriented.inside_out)
      report_.changes.push_back(
          {"turned", "the surface was inside out: all facets turned", oriented.facets.count, {}, 0});
    else
      note("turned", "of components turned to bound a volume", oriented.facets, "facet", "facets");
    uneven_ = oriented.uneven;
    note("uneven", "at which the directions of facets do not cancel", oriented.uneven, "edge", "edges");
  }

  /// Where the reason of a leak is to be looked for.
  std::string hint() const {
    if (one_sided_.count != 0) return "; it has a one-sided band" + one_sided_.where();
    if (uneven_.count != 0) return "; edges at which facets do not match are left" + uneven_.where();
    return "";
  }

  void refuse_nothing() const {
    refuse_surface(fmt::format("encloses nothing{}; give a closed or open hollow surface",
                               caps_.empty() ? ""
                                             : fmt::format(": {} around flat parts only",
                                                           counted(caps_.size(), "border", "borders"))));
  }

  /// The mesh of a box, and what is free in it. Where triangles cross for ever, or no mesher succeeds, near
  /// points of the file become one.
  Free_space free_space(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& crossing) {
    const Facets uncut = surface_;
    try {
      cut(crossing);
      return mesh_and_choose(volume_tolerance);
    } catch (const Error& error) {
      const bool is_crossing = dynamic_cast<const Still_crossing*>(&error) != nullptr;
      if ((error.code() != Error_code::not_certified && !is_crossing) || !(options_.weld > 0)) throw;
      const std::string reason = error.what();
      surface_ = uncut;
      const Found welded = weld(surface_, options_.weld * surface_.size, true);
      if (welded.count == 0) throw;
      say("welded",
          fmt::format(
              "without joining near points, it failed ({}): {} joined with others, the farthest by {:.2g}",
              reason, counted(welded.count, "point", "points"), welded.measured * surface_.size),
          welded);
      leave_out_collinear(surface_);
      settle_copies(surface_);
      cut(crossing_pairs(surface_));
      return mesh_and_choose(volume_tolerance_welded);
    }
  }

  void cut(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& crossing) {
    if (crossing.empty()) return;
    const Cut cut = cut_crossings(surface_, crossing, rounding_apart * surface_.size, [this] { wait(); });
    say("cut",
        fmt::format("{} {}: cut along the intersections, {} added",
                    counted(cut.pairs.count, "pair of facets", "pairs of facets"),
                    cut.pairs.count == 1 ? "crosses" : "cross", counted(cut.added_points, "point", "points")),
        cut.pairs);
    if (cut.joined.count != 0)
      say("joined",
          fmt::format("{} of intersections joined with others, the farthest by {:.2g}",
                      counted(cut.joined.count, "point", "points"), cut.joined.measured * surface_.size),
          cut.joined);
    report_.changes.back().measured = cut.joined.measured;
  }

  Free_space mesh_and_choose(double tolerance) {
    compact(surface_);
    Tetrahedralize_options coarse = mesh_;
    coarse.quality = coarse.cell_size = 0;
    coarse.limits.seconds = seconds_left();
    Free_space space;
    space.mesh = mesh_between(surface_, Frame::box, coarse, report_.tolerance);
    space.labels = labels_of(surface_.facets);
    std::vector<Point<3>> inside = options_.inside;
    if (inside.empty() && !options_.is_solid)
      if (const auto lumen = find_lumen(oriented_)) {
        inside.push_back(*lumen);
        report_.changes.push_back(
            {"lumen",
             "the surface is a thick wall: free is the lumen that it surrounds, around " + describe(*lumen),
             1,
             {*lumen},
             0});
      }
    wait();
    if (inside.empty())
      choose_by_winding(space, tolerance);
    else
      choose_around(space, inside);
    return space;
  }

  void choose_by_winding(Free_space& space, double tolerance) {
    const Regions regions = find_regions(space.mesh, space.labels);
    const Windings windings = wind(space.mesh, regions, oriented_, hint());
    const Point<3> origin = oriented_.points[oriented_.facets[0].corners[0]];
    std::vector<Facet> bounding;
    for (const Facet& f : oriented_.facets)
      if (f.part != Part::sheet) bounding.push_back(f);
    const double expected = signed_volume(oriented_, bounding, origin);
    std::size_t free = 0;
    double largest = 0;
    for (std::size_t r = 0; r < regions.regions.size(); ++r) {
      const bool is_free = windings.of[r] > surrounded;
      free += is_free;
      largest += is_free ? regions.regions[r].volume : 0;
    }
    if (free == 0) refuse_nothing();
    const double rounding = volume_rounding * surface_.size * surface_.size * surface_.size;
    if (std::abs(windings.volume - expected) > tolerance * std::max(largest, std::abs(expected)) + rounding)
      refuse_surface(
          fmt::format("bounds no volume: its regions have {:g}, and its facets enclose {:g} more or less{}; "
                      "close its holes, or "
                      "name a point of the free space (--inside)",
                      windings.volume, expected - windings.volume, hint()));
    if (windings.inside_out.count != 0)
      report_.changes.push_back({"inside_out",
                                 fmt::format("a volume of {:g} is not free, since the facets around it are "
                                             "inside out{}",
                                             windings.inside_out_volume, windings.inside_out.where()),
                                 windings.inside_out.count, windings.inside_out.places, 0});
    report_.winding_error = windings.error;
    for (const std::uint32_t r : regions.of) space.is_free.push_back(windings.of[r] > surrounded);
    report_.changes.push_back(
        {"regions",
         fmt::format("{}, {} free; winding numbers within {:.1g} of integers{}",
                     counted(regions.regions.size(), "region", "regions"), free, windings.error,
                     windings.covered_twice > tolerance * expected
                         ? fmt::format("; a volume of {:.6g} is covered twice", windings.covered_twice)
                         : ""),
         regions.regions.size(),
         {},
         0});
  }

  void choose_around(Free_space& space, const std::vector<Point<3>>& inside) {
    Cavity cavity = close_cavity(space.mesh, space.labels, inside);
    space.is_free = std::move(cavity.is_inside);
    space.keeps_inner = true;
    number_connected(cavity.mouths, Part::mouth);
    for (const Facet& f : cavity.mouths) space.labels.insert({sorted(f.corners), f});
  }

  Repaired_surface finish(Free_space space) {
    const double volume = free_volume(space);
    if (mesh_.quality > 0 || mesh_.cell_size > 0) refine(space, volume);
    const std::vector<Facet> walls = walls_of(space);
    Part_names names;
    std::tie(report_.parts, names) = name_parts(space.mesh.points, walls, caps_);
    report_.volume = volume;
    report_.walls = walls.size();
    check_distance(space, walls);
    Repaired_surface result = cells_of(space, names);
    std::vector<bool> is_on_wall(space.mesh.points.size(), false);
    for (const Facet& f : walls)
      for (const std::uint32_t v : f.corners) is_on_wall[v] = true;
    report_.added_points = result.soup.points.size() -
                           static_cast<std::size_t>(std::count(is_on_wall.begin(), is_on_wall.end(), true));
    for (std::uint32_t t = 0; t < space.is_free.size(); ++t)
      report_.out_of_bounds +=
          space.is_free[t] && is_out_of_bounds(space.mesh, space.mesh.tetrahedra[t], mesh_);
    return result;
  }

  /// Meshes the free space again, with the bounds asked for, between the same walls.
  void refine(Free_space& space, double volume) {
    Facets walls;
    walls.points = space.mesh.points;
    walls.facets = walls_of(space);
    walls.size = surface_.size;
    compact(walls);
    Free_space fine;
    try {
      std::string tolerance;
      Tetrahedralize_options bounds = mesh_;
      bounds.limits.seconds = seconds_left();
      fine.mesh = mesh_between(walls, Frame::none, bounds, tolerance);
      if (report_.tolerance.empty()) report_.tolerance = tolerance;
    } catch (const Error& error) {
      if (error.code() != Error_code::not_certified) throw;
      report_.changes.push_back(
          {"quality", fmt::format("bounds of quality and size not applied: {}", error.what()), 1, {}, 0});
      return;
    }
    fine.labels = labels_of(walls.facets);
    fine.keeps_inner = space.keeps_inner;
    const Regions regions = find_regions(fine.mesh, fine.labels);
    std::vector<bool> is_free;
    for (const Region& region : regions.regions)
      is_free.push_back(!region.is_outer &&
                        space.is_free[locate(space.mesh, centre_of(fine.mesh, region.largest[0]))]);
    for (const std::uint32_t r : regions.of) fine.is_free.push_back(is_free[r]);
    constexpr double rounding = 1e-9;
    if (std::abs(free_volume(fine) - volume) > rounding * volume) {
      report_.changes.push_back(
          {"quality", "bounds of quality and size not applied: TetGen filled another volume", 1, {}, 0});
      return;
    }
    space = std::move(fine);
  }

  void check_distance(const Free_space& space, const std::vector<Facet>& walls) {
    const Wall_distance distance = distance_of_walls(space.mesh.points, walls, given_);
    report_.moved = distance.most / report_.size;
    if (report_.moved > options_.max_move)
      refuse_surface(
          fmt::format("would be changed too much: walls lie {:.2g} of its size from it, at {}, more "
                      "than --max-move {:g}",
                      report_.moved, describe(distance.place), options_.max_move));
  }

  const Repair_options& options_;
  const Tetrahedralize_options& mesh_;
  Repair_report& report_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Facets given_;     // the triangles of the file
  Facets surface_;   // what becomes of them
  Facets oriented_;  // before cuts
  Found one_sided_, uneven_;
  std::vector<Repaired_part> caps_;
};

void check(const Repair_options& options, const Tetrahedralize_options& mesh) {
  const auto part = [](const char* name, double value) {
    if (!(value >= 0 && value < 1))
      throw Error(Error_code::usage,
                  fmt::format("repair: {} must be a part of the size, from 0 to below 1", name));
  };
  part("--seam", options.seam), part("--weld", options.weld), part("--max-move", options.max_move);
  for (const Point<3>& p : options.inside)
    if (!is_finite(p)) throw Error(Error_code::usage, "repair: a point inside is not finite");
  detail::check_bounds(mesh);
}

/// Surfaces of extreme size are repaired at a size near 1, by a power of two, which rounds nothing: products
/// of coordinates would leave the range of doubles.
Repaired_surface repair_scaled(const Surface_soup& surface, Repair_options options,
                               Tetrahedralize_options mesh, Repair_report& report, int scale) {
  Surface_soup near_one = surface;
  for (Point<3>& p : near_one.points) p = scaled(p, scale);
  for (Point<3>& p : options.inside) p = scaled(p, scale);
  mesh.cell_size = std::ldexp(mesh.cell_size, scale);
  const std::string note = fmt::format(" (coordinates times 2^{})", scale);
  try {
    Repaired_surface result = Repair(options, mesh, report).run(near_one);
    for (Point<3>& p : result.soup.points) p = scaled(p, -scale);
    report.size = std::ldexp(report.size, -scale);
    report.volume = std::ldexp(report.volume, -3 * scale);
    for (Repair_change& change : report.changes) {
      if (!change.places.empty()) change.text += note;
      for (Point<3>& p : change.places) p = scaled(p, -scale);
    }
    for (Repaired_part& part : report.parts) {
      part.centre = scaled(part.centre, -scale);
      part.area = std::ldexp(part.area, -2 * scale);
      part.doubt = std::ldexp(part.doubt, -3 * scale);
      for (double* size : {&part.width, &part.off_plane}) *size = std::ldexp(*size, -scale);
    }
    return result;
  } catch (const Error& error) {
    throw Error(error.code(), error.what() + note);
  }
}

}  // namespace

Repaired_surface repair_surface(const Surface_soup& surface, const Repair_options& options,
                                const Tetrahedralize_options& mesh, Repair_report& report) {
  check(options, mesh);
  report = {};
  const int scale = scale_of({surface});
  if (scale != 0) return repair_scaled(surface, options, mesh, report, scale);
  return Repair(options, mesh, report).run(surface);
}

}  // namespace cellwalk
