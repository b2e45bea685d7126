// SPDX-License-Identifier: LGPL-3.0-or-later
// Facets found by the corners of the elements in a group.
#include "element_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "io/files/text.h"

namespace cellwalk::io {
namespace {

using Corners = std::vector<std::uint32_t>;

Corners sorted_corners(std::span<const std::uint32_t> loop) {
  Corners corners(loop.begin(), loop.end());
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// The half-facets with the corners of elements that groups name.
class Facets_by_corners {
 public:
  void expect(std::span<const std::uint32_t> element) {
    facets_.emplace_back(sorted_corners(element), Corners{});
  }

  template <int D>
  void find(const Cell_soup<D>& cells) {
    std::sort(facets_.begin(), facets_.end());
    facets_.erase(std::unique(facets_.begin(), facets_.end()), facets_.end());
    for (std::size_t f = 0; f < cells.facet_count(); ++f)
      if (Corners* found = at(cells.facet(f))) found->push_back(static_cast<std::uint32_t>(f));
  }

  /// \pre the element was expected
  const Corners& of(std::span<const std::uint32_t> element) { return *at(element); }

 private:
  Corners* at(std::span<const std::uint32_t> loop) {
    const Corners corners = sorted_corners(loop);
    const auto found = std::lower_bound(facets_.begin(), facets_.end(), corners,
                                        [](const auto& known, const Corners& c) { return known.first < c; });
    return found != facets_.end() && found->first == corners ? &found->second : nullptr;
  }

  std::vector<std::pair<Corners, Corners>> facets_;  ///< corners; half-facets
};

void note_left_out(const std::string& group, std::size_t count, const std::string& what,
                   Read_report& report) {
  if (count > 0)
    report.notes.push_back(fmt::format("group \"{}\": {} {} left out", shown(group), count, what));
}

}  // namespace

std::string group_name(std::string name) {
  constexpr unsigned char first_printed = ' ', delete_character = 0x7f;
  for (char& c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"') c = '\'';
    if (byte < first_printed || byte == delete_character) c = '?';
  }
  return name.empty() ? "unnamed" : name;
}

template <int D>
Soup_groups groups_of_cells(const Cell_soup<D>& cells, const Element_soup& elements, Read_report& report) {
  const auto surfaces = [](const Element_group& group) -> const Corners& {
    return D == 3 ? group.polygons : group.lines;
  };
  const auto element = [&](std::uint32_t i) -> std::span<const std::uint32_t> {
    if (D == 3) return elements.polygons[i];
    return elements.lines[i];
  };
  Facets_by_corners facets;
  bool is_any = false;
  for (const auto& [name, group] : elements.groups)
    for (const std::uint32_t i : surfaces(group)) facets.expect(element(i)), is_any = true;
  if (is_any) facets.find(cells);
  Soup_groups groups;
  for (const auto& [name, group] : elements.groups) {
    Soup_group found{{}, D == 3 ? group.volumes : group.polygons};
    std::size_t strays = 0;
    for (const std::uint32_t i : surfaces(group)) {
      const Corners& sides = facets.of(element(i));
      strays += sides.empty();
      found.facets.insert(found.facets.end(), sides.begin(), sides.end());
    }
    for (Corners* members : {&found.facets, &found.cells}) {
      std::sort(members->begin(), members->end());
      members->erase(std::unique(members->begin(), members->end()), members->end());
    }
    note_left_out(name, strays,
                  D == 3 ? "polygons that are no facets of cells" : "lines that are no facets of cells",
                  report);
    note_left_out(name, (D == 3 ? group.lines.size() : 0) + group.points.size(),
                  D == 3 ? "lines and points" : "points", report);
    if (!found.facets.empty() || !found.cells.empty()) groups[name] = std::move(found);
  }
  return groups;
}

template Soup_groups groups_of_cells(const Cell_soup<2>&, const Element_soup&, Read_report&);
template Soup_groups groups_of_cells(const Cell_soup<3>&, const Element_soup&, Read_report&);

}  // namespace cellwalk::io
