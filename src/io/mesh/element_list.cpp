// SPDX-License-Identifier: LGPL-3.0-or-later
// Elements in the order of their numbers, and the kinds of elements of Gmsh.
#include "element_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "element_groups.h"
#include "io/files/text.h"

namespace cellwalk::io {
namespace {

template <std::size_t N>
std::array<std::uint32_t, N> first_of(std::span<const std::uint32_t> v) {
  std::array<std::uint32_t, N> a;
  std::copy_n(v.begin(), N, a.begin());
  return a;
}

}  // namespace

void Element_list::sort_nodes() {
  const auto less = [](const auto& a, const auto& b) { return a.first < b.first; };
  if (!std::is_sorted(nodes_.begin(), nodes_.end(), less))
    std::stable_sort(nodes_.begin(), nodes_.end(), less);
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end(),
                           [](const auto& a, const auto& b) { return a.first == b.first; }),
               nodes_.end());
  if (nodes_.size() > std::numeric_limits<std::uint32_t>::max())
    fail(name_, "the mesh is too large for 32-bit indices");
  is_gapless_ = !nodes_.empty() &&
                nodes_.back().first - nodes_.front().first + 1 == static_cast<std::int64_t>(nodes_.size());
  is_used_.assign(nodes_.size(), 0);
}

std::optional<std::uint32_t> Element_list::index(std::int64_t number) const {
  if (nodes_.empty() || number < nodes_.front().first || number > nodes_.back().first) return std::nullopt;
  if (is_gapless_) return static_cast<std::uint32_t>(number - nodes_.front().first);
  const auto found = std::lower_bound(nodes_.begin(), nodes_.end(), number,
                                      [](const auto& node, std::int64_t n) { return node.first < n; });
  if (found->first != number) return std::nullopt;
  return static_cast<std::uint32_t>(found - nodes_.begin());
}

std::uint32_t Element_list::add_element(std::int64_t number, const Element_kind& kind,
                                        std::span<const std::uint32_t> nodes) {
  constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
  if (corners_.size() + nodes.size() > most) fail(name_, "the mesh is too large for 32-bit indices");
  for (const std::uint32_t node : nodes) is_used_[node] = 1;
  straightened_ += kind.is_straightened();
  elements_.push_back({number, static_cast<std::uint32_t>(corners_.size()),
                       static_cast<std::uint8_t>(kind.dimension), static_cast<std::uint8_t>(kind.corners)});
  corners_.insert(corners_.end(), nodes.begin(), nodes.begin() + kind.corners);
  return static_cast<std::uint32_t>(elements_.size() - 1);
}

std::unordered_map<std::int64_t, std::uint32_t> Element_list::positions() const {
  std::unordered_map<std::int64_t, std::uint32_t> result;
  for (std::uint32_t i = 0; i < elements_.size(); ++i) result.emplace(elements_[i].number, i);
  return result;
}

void Element_list::add_group(const std::string& name, std::span<const std::uint32_t> elements) {
  const std::string known = group_name(name);
  if (known != name) notes_.push_back(fmt::format("group \"{}\" named \"{}\"", shown(name), known));
  auto& members = groups_[known];
  members.insert(members.end(), elements.begin(), elements.end());
}

std::vector<Point<3>> Element_list::take_points(Read_report& report) {
  std::vector<Point<3>> points;
  points.reserve(nodes_.size());
  std::vector<std::uint32_t> renamed(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    renamed[i] = static_cast<std::uint32_t>(points.size());
    if (is_used_[i] || keeps_unused_) points.push_back(nodes_[i].second);
  }
  for (std::uint32_t& corner : corners_) corner = renamed[corner];
  if (const std::size_t unused = nodes_.size() - points.size(); unused > 0)
    report.notes.push_back(fmt::format("{} nodes that belong to no element left out", unused));
  nodes_.clear();
  return points;
}

std::vector<std::uint32_t> Element_list::order(Read_report& report) const {
  std::vector<std::uint32_t> order(elements_.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto number = [this](std::uint32_t i) { return elements_[i].number; };
  std::ranges::stable_sort(order, {}, number);
  if (std::ranges::adjacent_find(order, {}, number) == order.end()) return order;
  report.notes.push_back("numbers of elements repeat: the elements were numbered anew");
  std::iota(order.begin(), order.end(), 0u);
  return order;
}

void Element_list::add(Element_soup& soup, const Element& element, Collapsed_cells& collapsed) const {
  const std::span v(corners_.data() + element.first, element.corners);
  if (element.dimension == 1) soup.lines.push_back({v[0], v[1]});
  if (element.dimension == 2) {
    soup.polygons.emplace_back(v.begin(), v.end());
    collapsed.settle(soup.polygons.back(), soup.volumes.points);
  }
  if (element.dimension != 3) return;
  switch (v.size()) {
    case 4:
      add_tetrahedron(soup.volumes, v[0], v[1], v[2], v[3]);
      break;
    case 5:
      add_pyramid(soup.volumes, first_of<5>(v));
      break;
    case 6:
      add_prism(soup.volumes, first_of<6>(v));
      break;
    default:
      add_hexahedron(soup.volumes, first_of<8>(v));
  }
  collapsed.settle_last(soup.volumes, name_, fmt::format("element {}", element.number));
}

Element_soup Element_list::take(Lines lines, Read_report& report) {
  const std::vector<std::uint32_t> in_order = order(report);
  Element_soup soup;
  soup.volumes.points = take_points(report);
  Collapsed_cells collapsed;
  std::size_t left_out = 0;
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(elements_.size(), none);
  for (const std::uint32_t i : in_order) {
    const Element& element = elements_[i];
    const std::array<std::size_t, 4> next{0, soup.lines.size(), soup.polygons.size(),
                                          soup.volumes.cell_count()};
    place[i] = static_cast<std::uint32_t>(next[element.dimension]);
    add(soup, element, collapsed);
    left_out += element.dimension < (lines == Lines::read ? 1 : 2);
  }
  for (const auto& [name, members] : groups_) {
    Element_group& group = soup.groups[name];
    for (const std::uint32_t i : members)
      (elements_[i].dimension == 3   ? group.volumes
       : elements_[i].dimension == 2 ? group.polygons
       : elements_[i].dimension == 1 ? group.lines
                                     : group.points)
          .push_back(place[i]);
  }
  if (left_out > 0)
    report.notes.push_back(
        fmt::format("{} {} elements ignored", left_out, lines == Lines::read ? "point" : "point and line"));
  if (straightened_ > 0)
    report.notes.push_back(
        fmt::format("{} elements of higher order read by their corner nodes, as straight", straightened_));
  report.notes.insert(report.notes.end(), notes_.begin(), notes_.end());
  collapsed.report_to(report);
  return soup;
}

std::optional<Element_kind> element_kind_of_msh(std::int64_t type) {
  // As in Gmsh's GmshDefines.h. A shape has the same number of corners in all orders; the numbers of nodes
  // belong to consecutive types.
  struct Run {
    int first, dimension, corners;
    std::array<int, 10> nodes;  // up to the first zero
  };
  constexpr std::array<Run, 35> runs{{{1, 1, 2, {2}},
                                      {2, 2, 3, {3}},
                                      {3, 2, 4, {4}},
                                      {4, 3, 4, {4}},
                                      {5, 3, 8, {8}},
                                      {6, 3, 6, {6}},
                                      {7, 3, 5, {5}},
                                      {8, 1, 2, {3}},
                                      {9, 2, 3, {6}},
                                      {10, 2, 4, {9}},
                                      {11, 3, 4, {10}},
                                      {12, 3, 8, {27}},
                                      {13, 3, 6, {18}},
                                      {14, 3, 5, {14}},
                                      {15, 0, 1, {1}},
                                      {16, 2, 4, {8}},
                                      {17, 3, 8, {20}},
                                      {18, 3, 6, {15}},
                                      {19, 3, 5, {13}},
                                      {20, 2, 3, {9, 10, 12, 15, 15, 21}},
                                      {26, 1, 2, {4, 5, 6}},
                                      {29, 3, 4, {20, 35, 56, 22, 28}},
                                      {36, 2, 4, {16, 25, 36, 12, 16, 20}},
                                      {42, 2, 3, {28, 36, 45, 55, 66}},
                                      {47, 2, 4, {49, 64, 81, 100, 121}},
                                      {52, 2, 3, {18, 21, 24, 27, 30}},
                                      {57, 2, 4, {24, 28, 32, 36, 40}},
                                      {62, 1, 2, {7, 8, 9, 10, 11}},
                                      {71, 3, 4, {84, 120, 165, 220, 286}},
                                      {79, 3, 4, {34, 40, 46, 52, 58}},
                                      {90, 3, 6, {40, 75}},
                                      {92, 3, 8, {64, 125, 216, 343, 512, 729, 1000, 32, 44, 56}},
                                      {102, 3, 8, {68, 80, 92, 104}},
                                      {118, 3, 5, {30, 55, 91, 140, 204, 285, 385, 21, 29, 37}},
                                      {128, 3, 5, {45, 53, 61, 69}}}};
  for (const Run& run : runs)
    for (std::size_t i = 0; i < run.nodes.size() && run.nodes[i] != 0; ++i)
      if (type == run.first + static_cast<std::int64_t>(i))
        return Element_kind{run.dimension, run.corners, run.nodes[i]};
  return std::nullopt;
}

}  // namespace cellwalk::io
