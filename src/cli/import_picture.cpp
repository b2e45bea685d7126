// SPDX-License-Identifier: LGPL-3.0-or-later
// Two panels in one view: the surface with its open edges; walls, groups with their names, and arrows.
#include "import_picture.h"

#include <cellwalk/internal/drawing/bodies.h>
#include <cellwalk/internal/drawing/figure.h>
#include <cellwalk/internal/io/vtu.h>
#include <cellwalk/internal/kernel/box.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace cellwalk::cli {
namespace {

using namespace drawing;
using Json = nlohmann::ordered_json;

constexpr Colour given_colour{0.74, 0.77, 0.81}, wall_colour{0.80, 0.37, 0.33}, open_edge{0.86, 0.08, 0.10},
    other_group{0.88, 0.62, 0.08};
/// Kinds of parts in the report, what the legend calls several of them, and their colours.
struct Kind {
  const char *key, *one, *many;
  Colour colour;
};
constexpr Kind kinds[] = {{"cap", "cap over a hole", "caps over holes", {0.10, 0.38, 0.80}},
                          {"mouth", "mouth of the lumen", "mouths of the lumen", {0.05, 0.58, 0.32}},
                          {"sheet", "sheet, a membrane", "sheets, membranes", {0.55, 0.22, 0.70}}};
/// Of arrows, step by step; more steps share the last.
constexpr Colour step_colours[] = {
    {0.10, 0.10, 0.12}, {0.95, 0.50, 0.05}, {0.75, 0.10, 0.50}, {0.00, 0.55, 0.62}, {0.45, 0.32, 0.10}};
constexpr std::size_t most_arrows = 30, most_names = 16;
// Shares of the size of the drawing.
constexpr double edge_size = 0.0022, arrow_length = 0.055, arrow_size = 0.0012, apart = 0.035,
                 name_distance = 0.012;
constexpr int single_width = 1200, double_width = 800, shown_height = 640;  // pixels
constexpr std::size_t longest_legend = 84;                                  // letters
constexpr double letter_width = 8.5;                                        // pixels

/// Text that the renderer can draw.
std::string drawable(std::string text) {
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return text;
}

std::string counted(std::size_t n, const char* one, const char* many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

/// The facets of a group.
struct Patch {
  std::string name;
  std::vector<std::vector<Point<3>>> facets;
  Point<3> centre{};
  Vector<3> normal{};  ///< out of the cells from which the facets are seen; times twice the area
  double extent = 0;   ///< area, in 2D length
};

template <int D>
Patch patch_of(const std::string& name, const Snapshot<D>& snapshot, const Selection<D>& group) {
  Patch patch{name, {}};
  Vector<3> sum{};
  double corners = 0;
  for (const Half_facet h : group.facets) {
    std::vector<Point<3>>& facet = patch.facets.emplace_back();
    for (const std::uint32_t p : snapshot.loop(h)) facet.push_back(io::in_space(snapshot.point(p)));
    Vector<3> area{};
    for (std::size_t i = 1; i + 1 < facet.size(); ++i)
      area = area + cross(facet[i] - facet[0], facet[i + 1] - facet[0]);
    patch.normal = patch.normal + area;
    patch.extent += D == 2 ? length(facet[1] - facet[0]) : length(area) / 2;
    for (const Point<3>& x : facet) sum = sum + x, ++corners;
  }
  if (corners != 0) patch.centre = (1 / corners) * sum;
  return patch;
}

/// The part "repaired" of a report, or none.
const Json* repaired_in(const Json& report) {
  const auto found = report.find("repaired");
  return found == report.end() ? nullptr : &*found;
}

/// The kind of a group in the report, if it has one.
const Kind* kind_of(const std::string& name, const Json& report) {
  if (const Json* repaired = repaired_in(report))
    for (const Json& part : (*repaired)["parts"])
      for (const Kind& kind : kinds)
        if (part["name"] == name && part["kind"] == kind.key) return &kind;
  return nullptr;
}

/// Adds the surface and its edges of an odd number of facets; returns the number of these.
std::size_t draw_given(Drawing& drawing, const Surface_soup& surface, double size) {
  constexpr std::size_t most_facets = 300000;
  std::map<Point<3>, std::uint32_t> numbers;  // readers keep equal points apart
  std::vector<std::uint32_t> number;
  for (const Point<3>& p : surface.points)
    number.push_back(numbers.try_emplace(p, static_cast<std::uint32_t>(numbers.size())).first->second);
  std::vector<Point<3>> points(numbers.size());
  for (const auto& [p, i] : numbers) points[i] = p;
  const double share =
      static_cast<double>(most_facets) / static_cast<double>(std::max(most_facets, surface.facets.size()));
  std::vector<std::vector<std::uint32_t>> facets;
  std::map<std::array<std::uint32_t, 2>, std::size_t> uses;
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    std::vector<std::uint32_t> loop;
    for (const std::uint32_t p : surface.facets[f]) loop.push_back(number[p]);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto [a, b] = std::minmax(loop[i], loop[(i + 1) % loop.size()]);
      if (a != b) ++uses[{a, b}];
    }
    if (loop.size() > 2 && is_among(share, f)) facets.push_back(std::move(loop));
  }
  add_surface(drawing, points, facets, drawing.add_material({given_colour}));
  const std::uint32_t border = drawing.add_material({open_edge});
  std::size_t open = 0;
  drawing.sides = 6;
  for (const auto& [edge, count] : uses)
    if (count % 2 != 0 && ++open <= most_facets / 10)
      add_tube(drawing, std::array{points[edge[0]], points[edge[1]]}, edge_size * size, border);
  return open;
}

/// Places that lie apart from each other, the first ones.
std::vector<Point<3>> spread(const Json& places, std::size_t most, double distance) {
  std::vector<Point<3>> result;
  for (const Json& place : places) {
    const auto p = place.get<Point<3>>();
    const bool is_near = std::any_of(result.begin(), result.end(),
                                     [&](const Point<3>& q) { return length(p - q) < distance; });
    if (!is_near && result.size() < most) result.push_back(p);
  }
  return result;
}

/// A change in words, without its place and explanations.
std::string brief(const std::string& text) {
  const std::string first =
      text.substr(0, std::min({text.find(", the f"), text.find(", at ("), text.find(": ")}));
  return first.size() <= longest_legend ? first : first.substr(0, longest_legend - 3) + "...";
}

/// One picture in the making.
template <int D>
class Import_picture {
 public:
  Import_picture(const Snapshot<D>& snapshot, const Groups<D>& groups, const Json& report) : report_(report) {
    for (const auto& [name, group] : groups)
      if (!group.facets.empty()) patches_.push_back(patch_of(name, snapshot, group));
    std::stable_sort(patches_.begin(), patches_.end(),
                     [](const Patch& a, const Patch& b) { return a.extent > b.extent; });
    Drawing& drawing = result_.drawing;
    const Scene_materials materials = add_materials(drawing, D == 2);
    if constexpr (D == 3) {
      std::unordered_set<Half_facet> in_groups;
      for (const auto& [name, group] : groups) in_groups.insert(group.facets.begin(), group.facets.end());
      draw_walls_but(drawing, snapshot, materials.environment, in_groups);
    } else {
      draw_walls(drawing, snapshot, materials.environment, 1, diagonal_of(snapshot));
    }
    legend_.push_back({Legend_entry::patch, wall_colour, "walls at free space"});
    for (const Patch& patch : patches_)
      for (const auto& facet : patch.facets)
        for (const Point<3>& x : facet) box_.extend(x);
    for (const Picture_triangle& t : drawing.triangles)
      for (const Point<3>& x : t.corners) box_.extend(x);
  }

  /// Beside it, in the same view.
  void add_surface(const Surface_soup& surface) {
    for (const Point<3>& x : surface.points) box_.extend(x);
    const std::size_t open = draw_given(given_.drawing, surface, size());
    given_.title = fmt::format("the surface given: {}", counted(surface.facets.size(), "facet", "facets"));
    legend_.insert(legend_.begin(), {Legend_entry::patch, given_colour, "surface given"});
    if (open != 0)
      legend_.push_back({Legend_entry::line, open_edge,
                         counted(open, "edge of one facet, or another odd number",
                                 "edges of one facet, or another odd number")});
  }

  void write(io::Atomic_file& file) {
    choose_view();
    draw_groups();
    if (const Json* repaired = repaired_in(report_)) draw_changes((*repaired)["changes"]);
    const Json& certificate = report_["certificate"];
    result_.title = fmt::format("the environment: free {} {:.6g} in {}", D == 2 ? "area" : "volume",
                                certificate["free_volume"].template get<double>(),
                                counted(certificate["components"], "component", "components"));
    std::vector<Panel> panels;
    if (!given_.drawing.triangles.empty()) panels.push_back(std::move(given_));
    panels.push_back(std::move(result_));
    Figure_options options;
    options.camera = camera_;
    options.columns = panels.size();
    options.panel_width = panels.size() == 1 ? single_width : double_width;
    options.panel_height = shown_height;
    options.legend_columns = 2;
    file.write(encode_png(make_figure(panels, legend_, options)));
  }

 private:
  double size() const { return length(box_.high - box_.low); }

  /// The longest side is horizontal, the shortest one is seen along, obliquely, from where most of the
  /// groups face the eye.
  void choose_view() {
    if constexpr (D == 2) {
      camera_ = {{0, 0, 1}, {0, 1, 0}, 0};
    } else {
      const Vector<3> extent = box_.high - box_.low;
      std::array<std::size_t, 3> order{0, 1, 2};
      std::stable_sort(order.begin(), order.end(),
                       [&](std::size_t a, std::size_t b) { return extent[a] > 1.001 * extent[b]; });
      double best = -1;
      for (int i = 0; i < 8; ++i) {
        Vector<3> toward{};
        toward[order[2]] = (i & 4) != 0 ? -1 : 1;
        toward[order[1]] = (i & 2) != 0 ? -0.45 : 0.45;
        toward[order[0]] = (i & 1) != 0 ? 0.35 : -0.35;
        double seen = 0;
        for (const Patch& patch : patches_) seen += std::max(0.0, dot(patch.normal, toward));
        if (seen > (1 + 1e-9) * best) best = seen, camera_.toward = normalized(toward);
      }
      camera_.up[order[1]] = 1;
    }
    right_ = normalized(cross(camera_.up, camera_.toward));
    up_ = cross(camera_.toward, right_);
  }

  void draw_groups() {
    Drawing& drawing = result_.drawing;
    std::map<const Kind*, std::size_t> numbers;
    for (const Patch& patch : patches_) {
      const Kind* kind = kind_of(patch.name, report_);
      const Colour& colour = kind == nullptr ? other_group : kind->colour;
      const std::uint32_t material = drawing.add_material({colour, 0, D == 3});
      for (const auto& facet : patch.facets) {
        if (D == 3)
          add_patch(drawing, facet, material);
        else
          add_flat_line(drawing, {facet[0][0], facet[0][1]}, {facet[1][0], facet[1][1]},
                        4 * edge_size * size(), 1e-3 * size(), material);
      }
      if (++numbers[kind] <= most_names) name(patch);
    }
    for (const auto& [kind, n] : numbers)
      legend_.push_back({Legend_entry::patch, kind == nullptr ? other_group : kind->colour,
                         kind == nullptr ? counted(n, "group of the file", "groups of the file")
                                         : counted(n, kind->one, kind->many)});
  }

  /// The name stands where the normal of the group points to in the picture.
  void name(const Patch& patch) {
    const double across = dot(patch.normal, right_);
    const Vector<3> aside = across * right_ + dot(patch.normal, up_) * up_;
    const std::string text = drawable(patch.name);
    const double width = letter_width * static_cast<double>(text.size());
    Label label{patch.centre, text};
    if (length(aside) > 0.2 * length(patch.normal)) {
      const double radius =
          D == 3 ? std::sqrt(patch.extent / 3) * std::abs(dot(normalized(patch.normal), camera_.toward)) : 0;
      label.at = patch.centre + (radius + name_distance * size()) * normalized(aside);
      if (across < -0.5 * length(aside)) label.right = -width - 6;
      if (std::abs(across) <= 0.5 * length(aside)) label.right = -width / 2;
    }
    result_.labels.push_back(std::move(label));
  }

  /// Arrows from outside to the places.
  void draw_changes(const Json& changes) {
    std::size_t step = 0;
    std::size_t steps = 0;
    for (const Json& change : changes) steps += !change["places"].empty();
    const Point<3> middle = 0.5 * (box_.low + box_.high);
    for (const Json& change : changes) {
      const auto places =
          spread(change["places"], std::max<std::size_t>(2, most_arrows / std::max<std::size_t>(1, steps)),
                 apart * size());
      if (places.empty()) continue;
      const Colour& colour = step_colours[std::min(step++, std::size(step_colours) - 1)];
      const std::uint32_t material = result_.drawing.add_material({colour, 0, true});
      for (const Point<3>& p : places) {
        const Vector<3> out = p - middle;
        const Vector<3> side = dot(out, right_) * right_ + dot(out, up_) * up_ + 0.3 * size() * up_;
        const Vector<3> from = normalized(normalized(side, up_) + 0.5 * camera_.toward);
        add_arrow(result_.drawing, p + arrow_length * size() * from, -1.0 * from, arrow_length * size(),
                  arrow_size * size(), material);
      }
      legend_.push_back(
          {Legend_entry::line, colour, drawable(brief(change["text"].template get<std::string>()))});
    }
  }

  const Json& report_;
  std::vector<Patch> patches_;  // by descending extent
  Panel given_, result_;
  std::vector<Legend_entry> legend_;
  cellwalk::detail::Box<3> box_;
  Camera camera_;
  Vector<3> right_{}, up_{};
};

}  // namespace

template <int D>
void write_picture(io::Atomic_file& file, const Surface_soup& surface, const Snapshot<D>& snapshot,
                   const Groups<D>& groups, const Json& report) {
  Import_picture<D> picture(snapshot, groups, report);
  if (!surface.facets.empty()) picture.add_surface(surface);
  picture.write(file);
}

template void write_picture(io::Atomic_file&, const Surface_soup&, const Snapshot<2>&, const Groups<2>&,
                            const Json&);
template void write_picture(io::Atomic_file&, const Surface_soup&, const Snapshot<3>&, const Groups<3>&,
                            const Json&);

}  // namespace cellwalk::cli
