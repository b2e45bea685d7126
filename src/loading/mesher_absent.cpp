// SPDX-License-Identifier: LGPL-3.0-or-later
// The meshing component of a build without it: errors that describe how to get it.
#include <cellwalk/internal/loading/mesher.h>
#include <cellwalk/kernel/error.h>

namespace cellwalk {
namespace {

[[noreturn]] void refuse(const char* what) {
  throw Error(Error_code::usage,
              std::string("this build cannot mesh ") + what +
                  ": configure it with -DCELLWALK_WITH_MESHING=ON, install the wheel with meshing, or import "
                  "a mesh of cells");
}

}  // namespace

Mesher_parts mesher_parts() { return {}; }

Meshed<3> mesh_surface(const Surface_soup&, const std::vector<Surface_soup>&, const Mesher_options&) {
  refuse("a surface");
}

Meshed<3> add_tissue(Cell_soup<3>, double, const Mesher_options&) { refuse("tissue"); }

Meshed<2> mesh_domain(const Planar_domain&, const Mesher_options&) { refuse("a planar domain"); }

}  // namespace cellwalk
