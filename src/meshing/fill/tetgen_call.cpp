// SPDX-License-Identifier: GPL-3.0-or-later
// The switches of TetGen, its tolerances tried in turn, and the checks of its result.
#include "tetgen_call.h"

#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "mesher_input.h"
#include "meshing/child/run_helper.h"
#include "narrow_place.h"
#include "scale.h"
#include "sizes.h"
#include "tetgen_sides.h"

namespace cellwalk {

bool has_tetgen() { return !detail::find_helper(detail::tetgen_helper).empty(); }

namespace detail {
namespace {

/// Tolerances as parts of the size, the first one TetGen's own: within them points are taken for collinear,
/// coplanar or the same. With none (0) TetGen fails.
constexpr std::array<const char*, 3> tolerances{"", "1e-13", "1e-16"};

/// Dihedral angles above this one, in degrees, are reduced by flips, with a bound of quality only. It leaves
/// 5 to 8 % less area of facets to cross than TetGen's default of 165, with fewer tetrahedra; smaller angles
/// gain no more.
constexpr int largest_dihedral_angle = 130;

/// p: a surface is given; Y: no points are added on it; Q: little output; T: the tolerance.
std::string switches(const Tetrahedralize_options& options, int scale, const char* tolerance) {
  std::string text = "pYQ";
  if (options.quality > 0) text += fmt::format("q{:.6f}o/{}", options.quality, largest_dihedral_angle);
  const double volume = largest_volume(std::ldexp(options.cell_size, scale));
  if (volume > 0 && std::isfinite(volume)) text += fmt::format("a{:.17g}", volume);
  if (options.quality > 0 || options.cell_size > 0) text += fmt::format("S{}", options.most_added_points);
  if (*tolerance != '\0') text += fmt::format("T{}", tolerance);
  return text;
}

[[noreturn]] void refuse_result() {
  throw Error(Error_code::not_certified, "TetGen made no mesh: its tetrahedra do not fit together");
}

/// The tetrahedron on the other side of each facet.
/// \throw Error(not_certified) if there are several
std::vector<std::array<std::int32_t, 4>> neighbours_of(
    const std::vector<std::array<std::uint32_t, 4>>& tetrahedra) {
  struct Facet_side {
    Triangle triangle;
    std::int32_t tetrahedron;
    int opposite;
  };
  std::vector<Facet_side> sides;
  sides.reserve(4 * tetrahedra.size());
  for (std::size_t t = 0; t < tetrahedra.size(); ++t)
    for (int i = 0; i < 4; ++i)
      sides.push_back({opposite(tetrahedra[t], i), static_cast<std::int32_t>(t), i});
  std::sort(sides.begin(), sides.end(),
            [](const Facet_side& a, const Facet_side& b) { return a.triangle < b.triangle; });
  std::vector<std::array<std::int32_t, 4>> neighbours(tetrahedra.size(), {-1, -1, -1, -1});
  for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
    for (j = i; j < sides.size() && sides[j].triangle == sides[i].triangle;) ++j;
    if (j - i > 2) refuse_result();
    if (j - i < 2) continue;
    const Facet_side &a = sides[i], &b = sides[i + 1];
    neighbours[a.tetrahedron][a.opposite] = b.tetrahedron;
    neighbours[b.tetrahedron][b.opposite] = a.tetrahedron;
  }
  return neighbours;
}

/// The output of TetGen, checked as far as possible without the surfaces.
Tetgen_result result_of(const Mesher_output& output, int scale) {
  Tetgen_result result;
  result.scale = scale;
  for (const Point<3>& p : output.points) {
    if (!is_finite(p)) refuse_result();
    result.points.push_back(scaled(p, -scale));
  }
  for (const auto& t : output.tetrahedra) {
    std::array<std::uint32_t, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) {
      if (t[k] < 0 || static_cast<std::size_t>(t[k]) >= output.points.size()) refuse_result();
      corners[k] = static_cast<std::uint32_t>(t[k]);
    }
    result.tetrahedra.push_back(corners);
  }
  result.neighbours = neighbours_of(result.tetrahedra);
  return result;
}

}  // namespace

std::string mesh_by_tetgen(const std::vector<Surface_soup>& surfaces, const Feature_names& names,
                           const Tetrahedralize_options& options, const Accept_mesh& accept) {
  const int scale = scale_of(surfaces);
  const Mesher_input input = mesher_input(surfaces, scale);
  const auto start = std::chrono::steady_clock::now();
  std::string first_problem;
  for (const char* tolerance : tolerances) {
    try {
      const std::string switched = switches(options, scale, tolerance);
      accept(result_of(run_helper(tetgen_helper, {switched}, input, options.limits, start), scale));
      if (first_problem.empty()) return {};
      return fmt::format("a tolerance of {} was needed: without it, {}; {}", tolerance, first_problem,
                         describe(narrow_places(surfaces), names));
    } catch (const Used_up& error) {  // finer tolerances take no less
      throw Error(error.code(),
                  fmt::format("{}; {}", error.what(), describe(narrow_places(surfaces), names)));
    } catch (const Error& error) {
      if (error.code() != Error_code::not_certified) throw;
      if (first_problem.empty()) first_problem = error.what();
    }
  }
  throw Error(Error_code::not_certified,
              fmt::format("{}, and failed with finer tolerances too; {}: widen or join them, or try Mesh_3, "
                          "which approximates the surface",
                          first_problem, describe(narrow_places(surfaces), names)));
}

bool ran_out_of_time(const Error& error) { return dynamic_cast<const Used_up*>(&error) != nullptr; }

}  // namespace detail
}  // namespace cellwalk
