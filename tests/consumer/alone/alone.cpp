// SPDX-License-Identifier: LGPL-3.0-or-later
// Links one component by itself (ALONE_NAME), and uses the core as well, which each of them brings.
#include <cellwalk/body/body.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/generators/transform.h>
#include <cellwalk/kernel/error.h>
#ifdef ALONE_io
#include <cellwalk/io/mesh_file.h>
#endif
#ifdef ALONE_meshing
#include <cellwalk/meshing/triangulate.h>
#endif
#ifdef ALONE_loading
#include <cellwalk/loading/environment_file.h>
#endif

#include <cstdio>
#include <string>
#include <vector>

using namespace cellwalk;

namespace {

/// The part of the component; true if it does what it should.
bool use_component() {
#if defined(ALONE_io) || defined(ALONE_loading)
  try {
#ifdef ALONE_io
    io::read_mesh("nothing.off");
#else
    import_environment("nothing.off", {});
#endif
    return false;
  } catch (const Error& error) {
    return std::string(error.what()).starts_with("nothing.off");
  }
#elif defined(ALONE_meshing)
  Planar_domain domain;
  domain.points = {{0, 0}, {1, 0}, {0, 1}};
  domain.segments = {{0, 1}, {1, 2}, {2, 0}};
  return triangulate(domain).cell_count() == 1;
#else
  return true;
#endif
}

/// The number of contacts of a body that falls to the floor.
std::size_t contacts() {
  const auto environment = Environment<3>::build(hex_grid({.cells = {2, 2, 2}}));
  Body_placement<3> placement;
  placement.position = {1, 1, 1};
  Body<3> body(environment.snapshot(), Locator<3>(environment.snapshot()),
               transformed(hexahedron_body(0.5, true), placement));
  std::vector<Point<3>> targets;
  for (const Point<3>& x : body.positions()) targets.push_back(x + Vector<3>{0, 0, -1});
  Step_report<3> report;
  Body_counts counts;
  body.step(targets, {}, report, counts);
  return report.contacts.size();
}

}  // namespace

int main() {
  const bool is_good = use_component() && contacts() > 0;
  std::puts(is_good ? "linked alone" : "does not do what it should");
  return is_good ? 0 : 1;
}
