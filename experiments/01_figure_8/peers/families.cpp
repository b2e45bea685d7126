// SPDX-License-Identifier: LGPL-3.0-or-later
#include "families.h"

#include <CGAL/version.h>
#include <dlfcn.h>

#include <stdexcept>
#ifdef CELLWALK_WITH_EMBREE
#if CELLWALK_WITH_EMBREE == 3
#include <embree3/rtcore_config.h>
#else
#include <embree4/rtcore_config.h>
#endif
#endif
#ifdef CELLWALK_WITH_FCL
#include <fcl/config.h>
#endif

namespace cellwalk::figure_8 {
namespace {

/// The entry of a plug-in. It is loaded with its symbols apart from all others, and stays.
[[maybe_unused]] Make_peers plug_in(const char* path) {
  void* const library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  void* const entry = library ? dlsym(library, "cellwalk_figure_8_peers") : nullptr;
  if (!entry) throw std::runtime_error(dlerror());
  return reinterpret_cast<Make_peers>(entry);
}

}  // namespace

std::vector<Family> families() {
  std::vector<Family> all{{"bounds", "", add_bounds},
                          {"cellwalk", CELLWALK_VERSION, add_cellwalk_peers},
                          {"walks in doubles", "", add_double_walks},
                          {"walks in doubles with regions", "", add_double_regions},
                          {"walk on the map", CELLWALK_VERSION, add_map_walk},
                          {"cgal", CGAL_VERSION_STR, add_cgal_peers}};
#ifdef CELLWALK_BULLET_FLOAT
  all.push_back({"bullet, float", CELLWALK_BULLET_VERSION, plug_in(CELLWALK_BULLET_FLOAT)});
#endif
#ifdef CELLWALK_BULLET_DOUBLE
  all.push_back({"bullet, double", CELLWALK_BULLET_VERSION, plug_in(CELLWALK_BULLET_DOUBLE)});
#endif
#ifdef CELLWALK_WITH_EMBREE
  all.push_back({"embree", RTC_VERSION_STRING, add_embree_peers});
#endif
#ifdef CELLWALK_WITH_FCL
  all.push_back({"fcl", FCL_VERSION, add_fcl_peers});
#endif
  return all;
}

}  // namespace cellwalk::figure_8
