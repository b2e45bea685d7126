// SPDX-License-Identifier: LGPL-3.0-or-later
// Surfaces from bytes that are open, cross themselves, repeat or nearly meet, through the whole repair: it
// refuses them, or fills a space whose walls lie on them and whose volume is the one reported.
#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/meshing/repair_surface.h>

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "fuzz/decoder.h"
#include "fuzz/targets.h"
#include "meshing/shapes.h"

namespace cellwalk::fuzz {
namespace {

constexpr std::size_t most_facets = 60;
constexpr std::size_t lattice = 4;  // points a side
/// That a run of TetGen may take, of which there are up to nine, and the processor time of everything
/// together.
constexpr double seconds_of_mesher = 0.5, seconds_of_repair = 8;

/// The processor time of this process and of the meshers that have ended, in seconds: other processes may be
/// busy, too.
double processor_time() {
  double seconds = 0;
  for (const int whose : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(whose, &usage);
    for (const timeval& part : {usage.ru_utime, usage.ru_stime})
      seconds += static_cast<double>(part.tv_sec) + 1e-6 * static_cast<double>(part.tv_usec);
  }
  return seconds;
}

/// Moves a point off the lattice, between a thousandth and less than rounding.
void nudge(Point<3>& p, Decoder& in) {
  double& x = p[in.below(3)];
  constexpr std::size_t least = 3, most = 16;
  const double offset = std::pow(10, -static_cast<double>(least + in.below(most - least + 1)));
  x += in.flag() ? -offset : offset;
}

Point<3> lattice_point(Decoder& in) {
  Point<3> p;
  std::size_t place = in.byte();
  for (double& x : p) {
    x = static_cast<double>(place % lattice);
    place /= lattice;
  }
  if (place == 3) nudge(p, in);
  return p;
}

/// Facets as triangles around their first corner.
void cut(Surface_soup& soup) {
  const auto polygons = std::exchange(soup.facets, {});
  for (const auto& f : polygons)
    for (std::size_t i = 2; i < f.size(); ++i) soup.facets.push_back({f[0], f[i - 1], f[i]});
}

/// A closed box between points of the lattice, perhaps without one of its facets.
Surface_soup lattice_box(Decoder& in) {
  const Point<3> low = lattice_point(in);
  Point<3> high = low;
  std::size_t sides = in.byte();
  for (double& x : high) {
    x += static_cast<double>(1 + sides % 3);
    sides /= 3;
  }
  Surface_soup box = test::box(low, high);
  const std::size_t kind = in.byte();
  if ((kind & 1) != 0) cut(box);
  if ((kind & 2) != 0) box = test::turned(box);
  const std::size_t missing = kind / 4;
  if (missing < box.facets.size() && missing != 0)
    box.facets.erase(box.facets.begin() + static_cast<std::ptrdiff_t>(missing));
  return box;
}

/// A wall of constant thickness around a box.
Surface_soup shell(Decoder& in) {
  const double side = static_cast<double>(lattice - 1), thickness = in.flag() ? 1 : 0.25;
  const Point<3> corner{thickness, thickness, thickness},
      opposite{side - thickness, side - thickness, side - thickness};
  return test::join(test::box({0, 0, 0}, {side, side, side}), test::turned(test::box(corner, opposite)));
}

std::vector<std::uint32_t> polygon(const Surface_soup& soup, Decoder& in, std::size_t corners) {
  std::vector<std::uint32_t> loop;
  for (std::size_t i = 0; i < corners; ++i)
    loop.push_back(static_cast<std::uint32_t>(in.below(soup.points.size())));
  return loop;
}

/// Adds to a surface, or changes it.
void change(Surface_soup& s, Decoder& in) {
  switch (in.below(10)) {
    case 0:
    case 1:
      s = test::join(std::move(s), lattice_box(in));
      break;
    case 2:
      s = test::join(std::move(s), shell(in));
      break;
    case 3:  // a triangle of its own
      for (int i = 0; i < 3; ++i) s.points.push_back(lattice_point(in));
      s.facets.push_back({});
      for (std::size_t i = 3; i > 0; --i)
        s.facets.back().push_back(static_cast<std::uint32_t>(s.points.size() - i));
      break;
    case 4:
      s.points.push_back(lattice_point(in));
      break;
    case 5:
      s.facets.push_back(polygon(s, in, 3));
      break;
    case 6:
      s.facets.push_back(polygon(s, in, 3 + in.below(4)));
      break;
    case 7:
      if (!s.points.empty()) nudge(s.points[in.below(s.points.size())], in);
      break;
    case 8: {  // given twice, or on both sides
      if (s.facets.empty()) break;
      auto facet = s.facets[in.below(s.facets.size())];
      if (in.flag()) std::reverse(facet.begin(), facet.end());
      s.facets.push_back(std::move(facet));
      break;
    }
    default: {  // left out, or turned
      if (s.facets.empty()) break;
      const std::size_t f = in.below(s.facets.size());
      if (in.flag())
        s.facets.erase(s.facets.begin() + static_cast<std::ptrdiff_t>(f));
      else
        std::reverse(s.facets[f].begin(), s.facets[f].end());
    }
  }
}

/// A turn in space, and then a factor.
struct Placement {
  double a = 0, b = 0;  // angles
  int exponent = 0;     // of two

  Point<3> operator()(Point<3> p) const {
    if (a != 0 || b != 0) {
      p = {std::cos(a) * p[0] - std::sin(a) * p[1], std::sin(a) * p[0] + std::cos(a) * p[1], p[2]};
      p = {p[0], std::cos(b) * p[1] - std::sin(b) * p[2], std::sin(b) * p[1] + std::cos(b) * p[2]};
    }
    for (double& x : p) x = std::ldexp(x, exponent);
    return p;
  }
};

Placement placement(Decoder& in, bool is_turned, bool is_scaled) {
  Placement place;
  constexpr double part_of_angle = 0.02;
  if (is_turned) place.a = part_of_angle * in.byte(), place.b = part_of_angle * in.byte();
  constexpr std::size_t largest_exponent = 300;  // volumes are of the third power
  if (is_scaled)
    place.exponent =
        static_cast<int>(in.below(2 * largest_exponent + 1)) - static_cast<int>(largest_exponent);
  return place;
}

Repair_options choose_options(Decoder& in, const Placement& place) {
  Repair_options options;
  const std::size_t kinds = in.byte();
  options.is_solid = (kinds & 1) != 0;
  options.sheets = std::array{Sheets::keep, Sheets::open, Sheets::refuse, Sheets::keep}[kinds / 2 % 4];
  for (std::size_t n = kinds / 8 % 4; n > 1; --n) {
    Point<3> p = lattice_point(in);
    if (in.flag()) p = p + Point<3>{0.5, 0.375, 0.625};
    options.inside.push_back(place(p));
  }
  if (kinds < 128) return options;
  const std::size_t bounds = in.byte();
  options.seam = std::array{1e-5, 0.0, 1e-2, 1e-12}[bounds % 4];
  options.weld = std::array{1e-7, 0.0, 1e-2, 1e-12}[bounds / 4 % 4];
  options.max_move = std::array{1e-3, 0.0, 0.1, 1e-9}[bounds / 16 % 4];
  return options;
}

double distance_to_segment(const Point<3>& p, const Point<3>& a, const Point<3>& b) {
  const Vector<3> along = b - a;
  const double square = dot(along, along);
  const double part = square == 0 ? 0 : std::clamp(dot(p - a, along) / square, 0.0, 1.0);
  return length(p - (a + part * along));
}

double distance_to_triangle(const Point<3>& p, const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  double least =
      std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
  const Vector<3> normal = cross(b - a, c - a);
  const auto is_left_of = [&](const Point<3>& q, const Point<3>& r) {
    return dot(cross(r - q, p - q), normal) >= 0;
  };
  if (const double l = length(normal); l > 0 && is_left_of(a, b) && is_left_of(b, c) && is_left_of(c, a))
    least = std::min(least, std::abs(dot(p - a, normal)) / l);
  return least;
}

/// The distance from a surface whose polygons may be cut into triangles in any way.
double distance_to(const Surface_soup& surface, const Point<3>& p) {
  double least = HUGE_VAL;
  for (const auto& f : surface.facets)
    for (std::size_t i = 0; i < f.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        for (std::size_t k = 0; k < j; ++k)
          least = std::min(least, distance_to_triangle(p, surface.points[f[i]], surface.points[f[j]],
                                                       surface.points[f[k]]));
  return least;
}

/// The parts that were added have names of their own, and the facets reported, which are walls.
void expect_parts(const Repaired_surface& repaired, const Repair_report& report) {
  std::set<std::string> names;
  for (const Repaired_part& part : report.parts) {
    demand(names.insert(part.name).second, "a name of a part is given once: " + part.name);
    const auto group = repaired.groups.find(part.name);
    demand(group != repaired.groups.end(), "a part is a group: " + part.name);
    demand(group->second.facets.size() == part.facets, "a group has the facets reported: " + part.name);
    for (const std::uint32_t f : group->second.facets) {
      demand(f < repaired.soup.facet_count(), "a facet of a group exists");
      demand(repaired.soup.impassable[f] == 1, "a facet of a group is a wall");
    }
    demand(std::isfinite(part.area) && is_finite(part.centre) && is_finite(part.normal),
           "a part has a size and a place: " + part.name);
  }
  demand(names.size() == repaired.groups.size(), "a group is a part");
}

/// Walls that are not caps or mouths lie near the surface. At a size near 1, products stay in range.
void expect_walls_near(const Surface_soup& surface, const Repaired_surface& repaired, int exponent,
                       double farthest) {
  const auto near_one = [exponent](Point<3> p) {
    for (double& x : p) x = std::ldexp(x, -exponent);
    return p;
  };
  const Cell_soup<3>& soup = repaired.soup;
  std::set<std::vector<std::uint32_t>> added;
  const auto corners_of = [&soup](std::size_t f) {
    std::vector<std::uint32_t> corners(soup.facet(f).begin(), soup.facet(f).end());
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  for (const auto& [name, group] : repaired.groups)
    if (name.rfind("sheet", 0) != 0)
      for (const std::uint32_t f : group.facets) added.insert(corners_of(f));
  Surface_soup given = surface;
  for (Point<3>& p : given.points) p = near_one(p);
  std::set<std::uint32_t> corners;
  for (std::size_t f = 0; f < soup.facet_count(); ++f)
    if (soup.impassable[f] == 1 && !added.contains(corners_of(f)))
      corners.insert(soup.facet(f).begin(), soup.facet(f).end());
  for (const std::uint32_t v : corners)
    demand(distance_to(given, near_one(soup.points[v])) <= farthest, "walls lie on the surface");
}

/// What a repair returns is an environment, with the volume and walls reported.
void expect_environment(Repaired_surface repaired, const Repair_report& report) {
  Build_report built;
  (void)Environment<3>::build(std::move(repaired.soup), {.split = false, .keep_map = false}, &built);
  bool is_welded = false;
  for (const Repair_change& change : report.changes) is_welded = is_welded || change.step == "welded";
  const double tolerance = is_welded ? 1e-6 : 1e-9;
  // Slabs as thin as the rounding of coordinates have a volume of rounding.
  const double rounding = 1e-15 * std::pow(report.size, 3);
  const double volume = built.certificate.free_volume;
  demand(std::isfinite(report.volume) && volume > 0, "there is free space");
  demand(std::abs(volume - report.volume) <= tolerance * volume + rounding, "the volume is the one reported");
  demand(built.certificate.walls == report.walls, "the walls are those reported");
}

void expect_sense(const Repair_report& report, double max_move) {
  demand(report.moved >= 0 && report.moved <= max_move, "walls move as far as allowed");
  demand(report.size > 0 && std::isfinite(report.size), "a surface has a size");
  for (const Repair_change& change : report.changes) {
    demand(!change.step.empty() && !change.text.empty(), "a change has words");
    demand(change.text.find('\n') == change.text.npos, "a change is told in one line");
    for (const Point<3>& p : change.places) demand(is_finite(p), "a change has places");
  }
}

}  // namespace

void repair(std::string_view bytes) {
  Decoder in(bytes);
  const std::size_t kinds = in.byte();
  const Placement place = placement(in, (kinds & 1) != 0, (kinds & 2) != 0);
  const Repair_options options = choose_options(in, place);
  Tetrahedralize_options mesh;
  if ((kinds & 4) == 0) mesh.quality = 0;
  if ((kinds & 8) != 0) mesh.cell_size = std::ldexp(1, place.exponent);
  mesh.limits.seconds = seconds_of_mesher;
  Surface_soup soup;
  while (!in.is_empty()) {
    Surface_soup larger = soup;
    change(larger, in);
    if (larger.facets.size() > most_facets) break;
    soup = std::move(larger);
  }
  for (Point<3>& p : soup.points) p = place(p);

  const double start = processor_time();
  mesh.limits.on_wait = [start] {
    demand(processor_time() - start < seconds_of_repair, "a repair ends in time");
  };
  Repaired_surface repaired;
  Repair_report report;
  const bool is_repaired = reads([&] { repaired = repair_surface(soup, options, mesh, report); },
                                 {Error_code::input, Error_code::not_certified});
  mesh.limits.on_wait();
  if (!is_repaired) return;
  expect_sense(report, options.max_move);
  expect_parts(repaired, report);
  constexpr double rounding = 1e-12;
  const double size = std::ldexp(report.size, -place.exponent);
  expect_walls_near(soup, repaired, place.exponent, (options.max_move + rounding) * size);
  expect_environment(std::move(repaired), report);
}

}  // namespace cellwalk::fuzz
