// SPDX-License-Identifier: LGPL-3.0-or-later
// The module that reads .msh, MEDIT and UNV by the Gmsh API, whose state is global: one file at a time, each
// in its own session.
#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <array>
#include <clocale>
#include <numeric>
#include <string>
#include <unordered_map>

#include "io/files/text.h"
#include "reader_module.h"

namespace cellwalk::io {
namespace {

/// Restores the program's locale at the end of its lifetime, since Gmsh sets that of the user.
class Keep_locale {
 public:
  Keep_locale() : locale_(std::setlocale(LC_ALL, nullptr)) {}
  ~Keep_locale() { std::setlocale(LC_ALL, locale_.c_str()); }
  Keep_locale(const Keep_locale&) = delete;
  Keep_locale& operator=(const Keep_locale&) = delete;

 private:
  std::string locale_;
};

/// Gmsh during the lifetime of this object: silent, and without the user's configuration.
class Session {
 public:
  Session() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.AbortOnError", 0);
    gmsh::logger::start();
  }
  ~Session() {
    try {
      gmsh::logger::stop();
      gmsh::finalize();
    } catch (...) {  // a destructor cannot report it
    }
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// The messages of Gmsh at one of its levels, such as "Error".
  std::vector<std::string> messages(const std::string& level) const {
    std::vector<std::string> log, found;
    gmsh::logger::get(log);
    for (const std::string& entry : log)
      if (entry.starts_with(level + ": ")) found.push_back(entry.substr(level.size() + 2));
    return found;
  }

 private:
  Keep_locale keep_locale_;
};

/// An element of the file: its tag determines the order, its corners are tags of nodes.
struct Element {
  std::size_t tag;
  int dimension;
  std::vector<std::size_t> corners;
};

struct Kinds {
  std::size_t left_out = 0;  ///< below the lowest dimension requested
  std::size_t higher_order = 0;
};

/// The elements of at least the given dimension with their corner nodes, in the order of the file.
std::vector<Element> elements(const std::string& name, int lowest_dimension, Kinds& kinds) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes);
  std::vector<Element> found;
  for (std::size_t t = 0; t < types.size(); ++t) {
    std::string kind;
    int dimension = 0, order = 0, node_count = 0, corner_count = 0;
    std::vector<double> local;
    gmsh::model::mesh::getElementProperties(types[t], kind, dimension, order, node_count, local,
                                            corner_count);
    if (dimension < lowest_dimension) {
      kinds.left_out += tags[t].size();
      continue;
    }
    if (node_count <= 0 || nodes[t].size() != tags[t].size() * static_cast<std::size_t>(node_count))
      fail(name,
           fmt::format("elements of type {} ('{}') are not read: tetrahedra, hexahedra, prisms, pyramids are",
                       types[t], kind));
    if (order > 1) kinds.higher_order += tags[t].size();
    for (std::size_t i = 0; i < tags[t].size(); ++i) {
      const auto first = nodes[t].begin() + static_cast<std::ptrdiff_t>(i) * node_count;
      found.push_back({tags[t][i], dimension, {first, first + corner_count}});
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Element& a, const Element& b) { return a.tag < b.tag; });
  return found;
}

using Node_index = std::unordered_map<std::size_t, std::uint32_t>;

/// Points in the order of their tags, and the index of each tag.
Node_index points(const std::string& name, std::vector<Point<3>>& out) {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters);
  std::vector<std::size_t> order(tags.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return tags[a] < tags[b]; });
  Node_index index;
  index.reserve(tags.size());
  for (std::size_t i : order) {
    const Point<3> p{coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]};
    if (!is_finite(p)) fail(name, fmt::format("node {} has a coordinate that is not finite", tags[i]));
    const bool is_new = index.emplace(tags[i], static_cast<std::uint32_t>(out.size())).second;
    if (is_new) out.push_back(p);  // otherwise it is a node of several entities
  }
  return index;
}

template <std::size_t N>
std::array<std::uint32_t, N> fixed(const std::vector<std::uint32_t>& v) {
  std::array<std::uint32_t, N> a;
  std::copy_n(v.begin(), N, a.begin());
  return a;
}

/// Adds a volume element. The order of corners in Gmsh is that of the soup's functions for all of them.
void add_volume(const std::string& name, Cell_soup<3>& soup, const std::vector<std::uint32_t>& v,
                std::size_t tag) {
  switch (v.size()) {
    case 4:
      add_tetrahedron(soup, v[0], v[1], v[2], v[3]);
      return;
    case 5:
      add_pyramid(soup, fixed<5>(v));
      return;
    case 6:
      add_prism(soup, fixed<6>(v));
      return;
    case 8:
      add_hexahedron(soup, fixed<8>(v));
      return;
    default:
      fail(name, fmt::format("element {} has {} corners: no known volume has", tag, v.size()));
  }
}

/// Checks that Gmsh read everything, since it omits elements that it cannot place without a message.
void compare_counts(const std::string& name, const Msh_counts& announced, std::size_t nodes,
                    std::size_t elements, Read_report& report) {
  if (announced.elements && *announced.elements != elements)
    fail(name,
         fmt::format(
             "announces {} elements, of which Gmsh keeps {}: numbers of elements repeat, or the file is "
             "broken",
             *announced.elements, elements));
  if (announced.nodes && *announced.nodes > nodes)
    report.notes.push_back(
        fmt::format("{} nodes that belong to no element left out", *announced.nodes - nodes));
}

Element_soup model(const std::string& name, const Msh_counts& announced, Lines lines, Read_report& report) {
  Element_soup soup;
  const auto index = points(name, soup.volumes.points);
  Kinds kinds;
  const std::vector<Element> found = elements(name, lines == Lines::read ? 1 : 2, kinds);
  compare_counts(name, announced, index.size(), found.size() + kinds.left_out, report);
  std::vector<std::uint32_t> corners;
  for (const Element& e : found) {
    corners.clear();
    for (std::size_t tag : e.corners) {
      const auto node = index.find(tag);
      if (node == index.end())
        fail(name, fmt::format("element {} names node {}, which does not exist", e.tag, tag));
      corners.push_back(node->second);
    }
    if (e.dimension == 3)
      add_volume(name, soup.volumes, corners, e.tag);
    else if (e.dimension == 1)
      soup.lines.push_back({corners[0], corners[1]});
    else
      soup.polygons.push_back(corners);
  }
  if (kinds.left_out > 0)
    report.notes.push_back(fmt::format("{} {} elements ignored", kinds.left_out,
                                       lines == Lines::read ? "point" : "point and line"));
  if (kinds.higher_order > 0)
    report.notes.push_back(fmt::format("{} elements of higher order read by their corner nodes, as straight",
                                       kinds.higher_order));
  return soup;
}

Element_soup read_with_gmsh(const std::string& name, const Reader_input& input, Read_report& report) {
  const Session session;
  std::string why;
  try {
    gmsh::open(input.path);
  } catch (const std::exception& e) {
    why = e.what();
  } catch (...) {
    why = "an unknown exception";
  }
  const auto errors = session.messages("Error");
  if (!errors.empty()) why = errors.front();
  if (!why.empty()) {
    for (std::size_t at = 0; (at = why.find(input.path)) != std::string::npos;)
      why.replace(at, input.path.size(), name);
    fail(name, fmt::format("broken or cut short: Gmsh cannot read it as {} ({})", report.format, why));
  }
  Element_soup soup = model(name, input.counts, input.lines, report);
  for (const std::string& warning : session.messages("Warning"))
    report.notes.push_back("Gmsh warns: " + warning);
  return soup;
}

constexpr Reader_module gmsh_reader{CELLWALK_VERSION, GMSH_API_VERSION, read_with_gmsh};

}  // namespace
}  // namespace cellwalk::io

CELLWALK_READER_MODULE(cellwalk::io::gmsh_reader)
