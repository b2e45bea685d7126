// SPDX-License-Identifier: GPL-3.0-or-later
// Copies, seams, sides, directions, sheets and caps, in this order.
#include "prepare.h"

#include <string>
#include <utility>

#include "caps.h"
#include "near_points.h"
#include "parts.h"
#include "patches.h"
#include "sides.h"
#include "tidy.h"

namespace cellwalk::detail {
namespace {

/// Points nearer to a side than this part of the size lie on it, up to rounding.
constexpr double on_side = 1e-11;

class Preparation {
 public:
  Preparation(const Repair_options& options, Repair_report& report) : options_(options), report_(report) {}

  Prepared run(const Surface_soup& soup, const std::function<void()>& on_wait) {
    Facets& surface = result_.surface;
    surface = read_facets(soup, report_.changes);
    report_.size = surface.size;
    result_.given = surface;
    leave_out();
    join_seams();
    split_sides();
    const Turned turned = turn_to_agree(surface);
    note("turned", "turned to agree with their neighbours", turned.facets);
    note("one_sided", "of one-sided bands, which bound nothing", turned.one_sided);
    result_.one_sided = turned.one_sided;
    sheets_.add(find_inner_sheets(surface));
    set_sheets_aside();
    if (on_wait) on_wait();
    result_.caps = add_caps(surface);
    leave_out_collinear(surface);  // parts of caps between points on a line
    if (on_wait) on_wait();
    return std::move(result_);
  }

 private:
  void say(const std::string& step, const std::string& text, const Found& found) {
    detail::report(report_.changes, step, text, found);
  }
  void note(const std::string& step, const std::string& what, const Found& found) {
    say(step, counted(found.count, "facet", "facets") + " " + what, found);
  }

  /// Triangles that collapsed, or are given twice. Sheets are marked.
  void leave_out() {
    note("collinear", "with all corners on one line left out", leave_out_collinear(result_.surface));
    const Copies copies = settle_copies(result_.surface);
    note("repeated", "given twice left out", copies.repeated);
    sheets_.add(copies.sheets);
  }

  void join_seams() {
    const double size = report_.size;
    const Found seams = detail::join_seams(result_.surface, options_.seam * size);
    if (seams.count == 0) return;
    say("seams",
        fmt::format("{} of seams joined with others, the farthest by {:.2g}",
                    counted(seams.count, "point", "points"), seams.measured * size),
        seams);
    leave_out();
  }

  void split_sides() {
    const double size = report_.size;
    const Found split = split_uneven_sides(result_.surface, options_.seam * size, on_side * size);
    if (split.count == 0) return;
    say("split",
        fmt::format("{} split at {}, the farthest off by {:.2g}", counted(split.count, "side", "sides"),
                    split.count == 1 ? "a point on it" : "points on them", split.measured * size),
        split);
    leave_out();
  }

  void set_sheets_aside() {
    Facets& surface = result_.surface;
    const std::size_t count = number_connected(surface.facets, Part::sheet);
    if (count == 0) return;
    const std::string what =
        fmt::format("{} of {}", counted(count, "sheet", "sheets"), counted(sheets_.count, "facet", "facets"));
    if (options_.sheets == Sheets::refuse)
      refuse_surface(
          fmt::format("has {} inside, or given on both sides{}; remove them, or keep them as "
                      "membranes (--sheets keep)",
                      what, sheets_.where()));
    if (options_.sheets == Sheets::open)
      std::erase_if(surface.facets, [](const Facet& f) { return f.part == Part::sheet; });
    say("sheets", what + (options_.sheets == Sheets::open ? " opened" : " kept as membranes"), sheets_);
    report_.changes.back().count = count;
  }

  const Repair_options& options_;
  Repair_report& report_;
  Prepared result_;
  Found sheets_;
};

}  // namespace

Prepared prepare(const Surface_soup& soup, const Repair_options& options, Repair_report& report,
                 const std::function<void()>& on_wait) {
  return Preparation(options, report).run(soup, on_wait);
}

}  // namespace cellwalk::detail
