// SPDX-License-Identifier: LGPL-3.0-or-later
// Two panels in one view: the surface with its open edges; walls, groups with their names, and arrows.
#include "import_picture.h"

#include <cellwalk/internal/drawing/bodies.h>
#include <cellwalk/internal/drawing/figure.h>
#include <cellwalk/internal/kernel/box.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "import_picture_parts.h"

namespace cellwalk::cli {
namespace {

using namespace drawing;
using Json = nlohmann::ordered_json;

constexpr Colour given_colour{0.74, 0.77, 0.81}, wall_colour{0.95, 0.86, 0.85}, open_edge{0.86, 0.08, 0.10},
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
constexpr int single_width = 1200, double_width = 800;                   // pixels
constexpr double least_height = 0.4, largest_height = 0.85;              // of the width
constexpr double letter_width = 13.5, line_height = 23, name_room = 50;  // of names, pixels
constexpr double step_turn = 0.45;                                       // of arrows between steps, radians
/// Steps that move and open nothing at their places, or whose facets have a colour.
constexpr const char* unmarked[] = {"bent", "turned", "sheets"};

std::string counted(std::size_t n, const char* one, const char* many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
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
    const std::size_t open = draw_given(given_.drawing, surface, given_colour, open_edge, edge_size * size());
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
    const int width = given_.drawing.triangles.empty() ? single_width : double_width;
    const double shape = frame(width);
    std::vector<Panel> panels;
    if (!given_.drawing.triangles.empty()) panels.push_back(std::move(given_));
    panels.push_back(std::move(result_));
    Figure_options options;
    options.camera = camera_;
    options.columns = panels.size();
    options.panel_width = width;
    options.panel_height = static_cast<int>(width * std::clamp(shape + 0.1, least_height, largest_height));
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
      const std::uint32_t material = drawing.add_material({colour, 0, false});
      for (const auto& facet : patch.facets) {
        if (D == 3)
          add_patch(drawing, facet, material);
        else
          add_flat_line(drawing, {facet[0][0], facet[0][1]}, {facet[1][0], facet[1][1]},
                        4 * edge_size * size(), 1e-3 * size(), material);
      }
      if (D == 3)  // so that a small one is seen, and one that is seen from the side
        for (const auto& edge : border_of(patch)) add_tube(drawing, edge, edge_size * size(), material);
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

  /// Arrows from outside to the places; those of each step come from a side of their own.
  void draw_changes(const Json& changes) {
    std::vector<const Json*> marked;
    for (const Json& change : changes)
      if (!change["places"].empty() && std::ranges::find(unmarked, change["step"]) == std::end(unmarked))
        marked.push_back(&change);
    const std::size_t most = most_arrows / std::max<std::size_t>(1, marked.size());
    const Point<3> middle = 0.5 * (box_.low + box_.high);
    for (std::size_t i = 0; i < marked.size(); ++i) {
      const Colour& colour = step_colours[std::min(i, std::size(step_colours) - 1)];
      const std::uint32_t material = result_.drawing.add_material({colour});
      const double angle = step_turn * (static_cast<double>(i) - static_cast<double>(marked.size() - 1) / 2);
      for (const Point<3>& p :
           spread((*marked[i])["places"], std::max<std::size_t>(2, most), apart * size())) {
        const Vector<3> out = p - middle;
        const double x = dot(out, right_), y = dot(out, up_) + 0.3 * size();
        const Vector<3> side = (std::cos(angle) * x - std::sin(angle) * y) * right_ +
                               (std::sin(angle) * x + std::cos(angle) * y) * up_;
        const Vector<3> from = normalized(normalized(side, up_) + 0.5 * camera_.toward);
        add_arrow(result_.drawing, p + arrow_length * size() * from, -1.0 * from, arrow_length * size(),
                  arrow_size * size(), material);
      }
      legend_.push_back(
          {Legend_entry::line, colour, in_brief((*marked[i])["text"].template get<std::string>())});
    }
  }

  /// Moves names down that would lie on others.
  void part_names(double pixels) {
    std::vector<Label>& labels = result_.labels;
    const auto height = [&](const Label& label) { return pixels * dot(label.at, up_) + label.up; };
    std::ranges::stable_sort(labels, std::greater{}, height);
    for (std::size_t i = 0; i < labels.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        const double across =
            pixels * dot(labels[i].at - labels[k].at, right_) + labels[i].right - labels[k].right;
        const std::string& left = (across > 0 ? labels[k] : labels[i]).text;
        const double overlap = height(labels[i]) + line_height - height(labels[k]);
        if (std::abs(across) < letter_width * static_cast<double>(left.size()) && overlap > 0)
          labels[i].up -= overlap;
      }
  }

  /// Makes both drawings as large as what both show, with room for names on both sides; returns height by
  /// width.
  double frame(double width) {
    cellwalk::detail::Box<3> seen;  // right, up, toward the eye
    for (const Panel* panel : {&given_, &result_})
      for (const Picture_triangle& t : panel->drawing.triangles)
        for (const Point<3>& x : t.corners)
          seen.extend(Point<3>{dot(x, right_), dot(x, up_), dot(x, camera_.toward)});
    auto [low, high] = seen;
    std::size_t letters = 0;
    for (const Label& label : result_.labels) letters = std::max(letters, label.text.size());
    const double share = std::min(0.25, (letter_width * static_cast<double>(letters) + name_room) / width);
    const double pad = letters == 0 ? 0 : share / (1 - 2 * share) * (high[0] - low[0]);
    low[0] -= pad, high[0] += pad;
    part_names(width / std::max(high[0] - low[0], 1e-300));
    const Point<3> middle = 0.5 * (low + high);
    for (Panel* panel : {&given_, &result_}) {
      const std::uint32_t invisible = panel->drawing.add_material({{0, 0, 0, 0}});
      if (panel->drawing.triangles.empty()) continue;
      for (std::size_t i = 0; i < 3; ++i)
        for (const Point<3>& end : {low, high}) {
          Point<3> x = middle;
          x[i] = end[i];
          const Point<3> p = x[0] * right_ + x[1] * up_ + x[2] * camera_.toward;
          panel->drawing.triangles.push_back({{p, p, p}, {up_, up_, up_}, invisible});
        }
    }
    return (high[1] - low[1]) / std::max(high[0] - low[0], 1e-300);
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
