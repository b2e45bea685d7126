// SPDX-License-Identifier: LGPL-3.0-or-later
#include "falling_face.h"

#include <cellwalk/body/body.h>
#include <cellwalk/kernel/exact.h>

#include <algorithm>
#include <cmath>

namespace cellwalk::small_obstacles {
namespace {

/// Triangles thinner than that are drawn again: the greatest circle of those drawn in the unit disc.
constexpr double least_drawn_inradius = 0.15;
/// How far the normal and the way of a face lean from the vertical: the tangent of the greatest angle.
constexpr double most_tilt = 0.5;

Point<3> in_disc(Random& random) {
  for (;;) {
    const double x = random.real(-1, 1), y = random.real(-1, 1);
    if (x * x + y * y <= 1) return {x, y, 0};
  }
}

/// Opposite to corner i.
double side(const Triangle& t, std::size_t i) { return length(t[(i + 2) % 3] - t[(i + 1) % 3]); }

Point<3> incentre(const Triangle& t) {
  const double a = side(t, 0), b = side(t, 1), c = side(t, 2);
  return (1 / (a + b + c)) * (a * t[0] + b * t[1] + c * t[2]);
}

Point<3> random_point(Random& random, const Triangle& t) {
  double u = random.real(), v = random.real();
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
}

}  // namespace

double inradius(const Triangle& t) {
  return length(cross(t[1] - t[0], t[2] - t[0])) / (side(t, 0) + side(t, 1) + side(t, 2));
}

double distance_from_plane(const Triangle& t, const Point<3>& x) {
  return std::abs(dot(normalized(cross(t[1] - t[0], t[2] - t[0])), x - t[0]));
}

bool passes_inside(const Triangle& t, const Point<3>& x, const Point<3>& y) {
  Predicate_counts counts;
  const auto side_of = [&](const Point<3>& u, const Point<3>& v, const Point<3>& w, const Point<3>& z) {
    return Exact::orientation(counts, u, v, w, z);
  };
  if (side_of(t[0], t[1], t[2], x) * side_of(t[0], t[1], t[2], y) >= 0) return false;
  const int turn = side_of(x, y, t[0], t[1]);
  return turn != 0 && side_of(x, y, t[1], t[2]) == turn && side_of(x, y, t[2], t[0]) == turn;
}

Fall random_fall(Random& random, Aim aim, const Point<3>& target, double above, double step) {
  Triangle flat;
  do
    for (Point<3>& corner : flat) corner = in_disc(random);
  while (inradius(flat) < least_drawn_inradius);
  const double scale = face_inradius / inradius(flat);
  for (Point<3>& corner : flat) corner = scale * corner;
  const Point<3> below = aim == Aim::worst ? incentre(flat) : random_point(random, flat);
  Vector<3> x{1, 0, 0}, y{0, 1, 0}, way{0, 0, -1};
  if (aim == Aim::random) {
    const Vector<3> lean = in_disc(random), drift = in_disc(random);
    const Vector<3> normal = normalized(Vector<3>{most_tilt * lean[0], most_tilt * lean[1], 1});
    x = normalized(cross(Vector<3>{0, 1, 0}, normal));
    y = cross(normal, x);
    way = normalized(Vector<3>{most_tilt * drift[0], most_tilt * drift[1], -1});
  }
  Fall fall;
  fall.step = step * way;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector<3> v = flat[i] - below;
    fall.start[i] = target - above * way + v[0] * x + v[1] * y;
  }
  return fall;
}

Landing fall(const Snapshot<3>& snapshot, const Locator<3>& locator, const Fall& fall, Sweep sweep,
             int most_steps) {
  Body_soup<3> soup;
  soup.points.assign(fall.start.begin(), fall.start.end());
  soup.edges = {{0, 1}, {0, 2}, {1, 2}};
  if (sweep == Sweep::faces) soup.faces = {{0, 1, 2}};
  Body<3> body(snapshot, locator, soup);
  Body_options options;
  options.sweep.sweep = sweep;
  options.most_contacts = 1;  // stop there
  Body_counts counts;
  Step_report<3> report;
  for (int step = 0; step < most_steps && report.contacts.empty(); ++step) {
    std::array<Point<3>, 3> targets;
    for (std::size_t v = 0; v < 3; ++v) targets[v] = body.positions()[v] + fall.step;
    body.step(targets, options, report, counts);
  }
  Landing landing;
  if (!report.contacts.empty()) landing.stopped_by = report.contacts.front().body;
  std::copy(body.positions().begin(), body.positions().end(), landing.end.begin());
  return landing;
}

}  // namespace cellwalk::small_obstacles
