// SPDX-License-Identifier: GPL-3.0-or-later
#include "tetgen_call.h"

#include <cellwalk/kernel/error.h>

#include "sizes.h"

#ifdef CELLWALK_HAS_TETGEN
#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <tetgen.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <new>
#endif

namespace cellwalk {

#ifndef CELLWALK_HAS_TETGEN

bool has_tetgen() { return false; }

detail::Tetgen_result detail::call_tetgen(const std::vector<Surface_soup>&, const Tetrahedralize_options&) {
  throw Error(Error_code::usage,
              "this build has no TetGen, which keeps surfaces exactly; install it (libtet1.5-dev) and build "
              "again, or "
              "mesh with Mesh_3, which approximates them");
}

#else

bool has_tetgen() { return true; }

namespace {

/// Suppresses the standard output during its lifetime, since TetGen prints to it even with Q.
class Quiet {
 public:
  Quiet() {
    std::fflush(stdout);
    saved_ = ::dup(STDOUT_FILENO);
    const int nowhere = ::open("/dev/null", O_WRONLY);
    if (nowhere >= 0) {
      ::dup2(nowhere, STDOUT_FILENO);
      ::close(nowhere);
    }
  }
  ~Quiet() {
    std::fflush(stdout);
    if (saved_ >= 0) {
      ::dup2(saved_, STDOUT_FILENO);
      ::close(saved_);
    }
  }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  int saved_;
};

/// The meaning of the numbers that TetGen throws (terminatetetgen in tetgen.h).
const char* meaning(int code) {
  switch (code) {
    case 1:
      return "ran out of memory; give a smaller surface or less refinement";
    case 2:
      return "failed inside; try another quality bound, or Mesh_3, which approximates the surface";
    case 3:
      return "found that the surfaces intersect; repair them, or try Mesh_3";
    case 4:
      return "found two features too close for its tolerance; simplify the surface there, or try Mesh_3";
    case 5:
      return "found two facets too close to each other; simplify the surface there, or try Mesh_3";
    case 10:
      return "found its input malformed; check the surface";
    default:
      return "could not keep the boundary; simplify the surface, or try Mesh_3";
  }
}

/// Dihedral angles above this one, in degrees, are reduced by flips, with a bound of quality only. It leaves
/// 5 to 8 % less area of facets to cross than TetGen's default of 165, with fewer tetrahedra; smaller angles
/// gain no more.
constexpr int largest_dihedral_angle = 130;

/// p: a surface is given; Y: no points are added on it; n: report neighbours; Q: little output.
std::string switches(const Tetrahedralize_options& options) {
  std::string text = "pYnQ";
  if (options.quality > 0) text += fmt::format("q{:.6f}o/{}", options.quality, largest_dihedral_angle);
  const double volume = detail::largest_volume(options.cell_size);
  if (volume > 0 && std::isfinite(volume)) text += fmt::format("a{:.17g}", volume);
  if (options.quality > 0 || options.cell_size > 0) text += fmt::format("S{}", options.most_added_points);
  return text;
}

/// Gmsh's library has classes of TetGen's names but another layout. If it is found first, memory is
/// overwritten.
void expect_one_tetgen() {
  void* const entry = dlsym(RTLD_DEFAULT, "_Z14tetrahedralizePcP8tetgenioS1_S1_S1_");
  void* const inside = dlsym(RTLD_DEFAULT, "_ZN10tetgenmesh10inittablesEv");
  Dl_info entry_library, inside_library;
  if (entry == nullptr || inside == nullptr) return;  // linked statically: found by the linker
  if (dladdr(entry, &entry_library) != 0 && dladdr(inside, &inside_library) != 0 &&
      entry_library.dli_fbase != inside_library.dli_fbase)
    throw Error(Error_code::other, fmt::format("{} shadows the TetGen of {}: link TetGen before it",
                                               inside_library.dli_fname, entry_library.dli_fname));
}

/// Copies the surfaces. TetGen's structure frees its arrays with delete[].
void fill(tetgenio& in, const std::vector<Surface_soup>& surfaces) {
  in.firstnumber = 0;
  for (const auto& s : surfaces) {
    in.numberofpoints += static_cast<int>(s.points.size());
    in.numberoffacets += static_cast<int>(s.facets.size());
  }
  in.pointlist = new REAL[3 * static_cast<std::size_t>(in.numberofpoints)];
  in.facetlist = new tetgenio::facet[in.numberoffacets];
  in.facetmarkerlist = new int[in.numberoffacets];
  std::size_t point = 0, facet = 0;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const std::size_t first = point;
    for (const auto& p : surfaces[i].points) {
      for (int k = 0; k < 3; ++k) in.pointlist[3 * point + k] = p[k];
      ++point;
    }
    for (const auto& loop : surfaces[i].facets) {
      tetgenio::facet& f = in.facetlist[facet];
      tetgenio::init(&f);
      f.numberofpolygons = 1;
      f.polygonlist = new tetgenio::polygon[1];
      tetgenio::init(f.polygonlist);
      f.polygonlist->numberofvertices = static_cast<int>(loop.size());
      f.polygonlist->vertexlist = new int[loop.size()];
      for (std::size_t k = 0; k < loop.size(); ++k)
        f.polygonlist->vertexlist[k] = static_cast<int>(first + loop[k]);
      in.facetmarkerlist[facet++] = static_cast<int>(i) + 1;
    }
  }
}

}  // namespace

detail::Tetgen_result detail::call_tetgen(const std::vector<Surface_soup>& surfaces,
                                          const Tetrahedralize_options& options) {
  expect_one_tetgen();
  tetgenio in, out;
  fill(in, surfaces);
  std::string text = switches(options);
  try {
    const Quiet quiet;
    ::tetrahedralize(text.data(), &in, &out);
  } catch (int code) {
    throw Error(Error_code::not_certified, fmt::format("TetGen {} (its code {})", meaning(code), code));
  } catch (const std::bad_alloc&) {
    throw Error(Error_code::not_certified, fmt::format("TetGen {}", meaning(1)));
  }
  Tetgen_result result;
  for (int i = 0; i < out.numberofpoints; ++i)
    result.points.push_back({out.pointlist[3 * i], out.pointlist[3 * i + 1], out.pointlist[3 * i + 2]});
  for (int t = 0; t < out.numberoftetrahedra; ++t) {
    const int* v = out.tetrahedronlist + static_cast<std::ptrdiff_t>(t) * out.numberofcorners;
    const int* n = out.neighborlist + 4 * static_cast<std::ptrdiff_t>(t);
    const auto u = [](int x) { return static_cast<std::uint32_t>(x); };
    result.tetrahedra.push_back({u(v[0]), u(v[1]), u(v[2]), u(v[3])});
    result.neighbours.push_back({n[0], n[1], n[2], n[3]});
  }
  return result;
}

#endif

}  // namespace cellwalk
