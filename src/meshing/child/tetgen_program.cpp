// SPDX-License-Identifier: GPL-3.0-or-later
// The program cellwalk-tetgen, the only one that is linked with TetGen (AGPL). Its option is the switches.
#include <tetgen.h>

#include <cstddef>
#include <new>
#include <string>

#include "meshing/child/helper.h"

namespace {

using namespace cellwalk::detail;

/// Copies the surfaces. TetGen's structure frees its arrays with delete[].
void fill(tetgenio& in, const Mesher_input& input) {
  in.firstnumber = 0;
  in.numberofpoints = static_cast<int>(input.points.size());
  in.numberoffacets = static_cast<int>(input.triangles.size());
  in.pointlist = new REAL[3 * input.points.size()];
  in.facetlist = new tetgenio::facet[input.triangles.size()];
  in.facetmarkerlist = new int[input.triangles.size()];
  for (std::size_t v = 0; v < input.points.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k) in.pointlist[3 * v + k] = input.points[v][k];
  for (std::size_t i = 0; i < input.triangles.size(); ++i) {
    tetgenio::facet& f = in.facetlist[i];
    tetgenio::init(&f);
    f.numberofpolygons = 1;
    f.polygonlist = new tetgenio::polygon[1];
    tetgenio::init(f.polygonlist);
    f.polygonlist->numberofvertices = 3;
    f.polygonlist->vertexlist = new int[3];
    for (std::size_t k = 0; k < 3; ++k) f.polygonlist->vertexlist[k] = input.triangles[i][k];
    in.facetmarkerlist[i] = input.surfaces[i] + 1;
  }
}

}  // namespace

int main(int argc, char** argv) {
  Mesher_input input;
  const auto options = begin_helper(argc, argv, input);
  if (options.size() != 1 || input.surfaces.size() != input.triangles.size()) end_helper(cut_short);
  try {
    tetgenio in, out;
    fill(in, input);
    std::string switches = options[0];
    tetrahedralize(switches.data(), &in, &out);
    Mesher_output output;
    for (int v = 0; v < out.numberofpoints; ++v)
      output.points.push_back({out.pointlist[3 * v], out.pointlist[3 * v + 1], out.pointlist[3 * v + 2]});
    for (int t = 0; t < out.numberoftetrahedra; ++t) {
      const int* c = out.tetrahedronlist + static_cast<std::ptrdiff_t>(t) * out.numberofcorners;
      output.tetrahedra.push_back({c[0], c[1], c[2], c[3]});
    }
    end_with(output);
  } catch (int code) {
    end_helper(mesher_failed + code);
  } catch (const std::bad_alloc&) {
    end_helper(out_of_memory);
  }
}
