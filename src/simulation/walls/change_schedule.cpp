// SPDX-License-Identifier: LGPL-3.0-or-later
// The facets and cells of each change found by position, and stitches kept until they succeed.
#include <cellwalk/internal/records/scene_shape.h>
#include <cellwalk/internal/simulation/change_schedule.h>
#include <cellwalk/kernel/error.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

namespace cellwalk {
namespace {

constexpr std::array<const char*, change_kind_count> change_names{"open", "close", "excavate",
                                                                  "fill", "cut",   "sew"};

bool is_of_facets(Change_kind kind) { return kind == Change_kind::open || kind == Change_kind::close; }

/// True if a facet, whose cells are both free, is to become a wall or passable.
template <int D>
bool needs_change(const Snapshot<D>& snapshot, Change_kind kind, Half_facet facet) {
  const Cell other = snapshot.neighbour(facet);
  return other != Cell::none && !snapshot.is_solid(snapshot.cell_of(facet)) && !snapshot.is_solid(other) &&
         snapshot.is_impassable(facet) == (kind == Change_kind::open);
}

template <int D>
bool needs_change(const Snapshot<D>& snapshot, Change_kind kind, Cell cell) {
  return snapshot.is_solid(cell) == (kind == Change_kind::excavate);
}

/// The points of a facet or a cell, ascending.
template <int D>
std::vector<std::uint32_t> points_of(const Snapshot<D>& snapshot, Half_facet facet) {
  std::vector<std::uint32_t> points = snapshot.loop(facet);
  std::sort(points.begin(), points.end());
  return points;
}
template <int D>
std::vector<std::uint32_t> points_of(const Snapshot<D>& snapshot, Cell cell) {
  const auto vertices = snapshot.view(cell).vertices;
  std::vector<std::uint32_t> points(vertices.begin(), vertices.end());
  std::sort(points.begin(), points.end());
  return points;
}

/// True if a name is still that of the facet or cell with these points.
template <int D>
bool is_same(const Snapshot<D>& snapshot, Half_facet facet, const std::vector<std::uint32_t>& points) {
  if (to_index(facet) >= snapshot.half_facet_slots()) return false;
  const Cell cell = snapshot.cell_of(facet);
  return snapshot.is_cell(cell) && snapshot.facet_of(facet) < snapshot.facet_count(cell) &&
         points_of(snapshot, facet) == points;
}
template <int D>
bool is_same(const Snapshot<D>& snapshot, Cell cell, const std::vector<std::uint32_t>& points) {
  return snapshot.is_cell(cell) && points_of(snapshot, cell) == points;
}

template <int D>
Blade<D> blade_of(const Blade_stroke<D>& stroke) {
  if constexpr (D == 3)
    if (stroke.sweep) return swept_blade(stroke.points, *stroke.sweep);
  return blade_along<D>(stroke.points);
}

template <int D>
bool lies_in(const Environment_part<D>& part, const Point<D>& x) {
  return detail::is_in_shape(part, x) && (!part.plane || detail::is_in_front(*part.plane, x));
}

/// True if some cut is made before a suture runs out.
template <int D>
bool follows_a_cut(const std::vector<Environment_change<D>>& list, std::size_t suture) {
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].kind == Change_kind::cut &&
        (list[i].step < list[suture].until || (list[i].step == list[suture].until && i < suture)))
      return true;
  return false;
}

}  // namespace

template <int D>
Groups<D> all_groups(const Snapshot<D>& snapshot, const Environment_changes<D>& changes, Groups<D> of_file) {
  for (const auto& [name, part] : changes.groups)
    if (!of_file.emplace(name, select(snapshot, part)).second)
      throw Error(
          Error_code::input,
          fmt::format("groups.{}: the file of the environment has a group of that name: rename one", name));
  return of_file;
}

template <int D>
Change_schedule<D>::Change_schedule(const Snapshot<D>& snapshot, const Environment_changes<D>& changes,
                                    const Groups<D>& of_file) {
  const Groups<D> groups = all_groups(snapshot, changes, of_file);
  for (std::size_t i = 0; i < changes.list.size(); ++i) {
    const Environment_change<D>& change = changes.list[i];
    Planned& planned =
        planned_.emplace_back(Planned{i, change.kind, change.step, change.until, {}, {}, {}, {}});
    if (change.kind == Change_kind::cut) {
      planned.blade = change.blade;
      try {
        blade_of<D>(change.blade);
      } catch (const Error& e) {
        throw Error(e.code(), fmt::format("changes[{}].cut: {}", i, e.what()));
      }
      continue;
    }
    if (change.kind == Change_kind::sew) {
      if (!follows_a_cut(changes.list, i))
        throw Error(Error_code::input,
                    fmt::format("changes[{}].sew: no cut comes before it: cut first, or let it last", i));
      planned.suture = change.part;
      continue;
    }
    const auto group = groups.find(change.part.group);
    if (group == groups.end() && !change.part.group.empty())
      throw Error(
          Error_code::input,
          fmt::format("changes[{}].{}: there is no such group: name it in \"groups\", or in the file of "
                      "the environment",
                      i, change_names[static_cast<std::size_t>(change.kind)]));
    const Selection<D> part = group == groups.end() ? select(snapshot, change.part) : group->second;
    const bool of_facets = is_of_facets(change.kind);
    if (of_facets)
      for (const Half_facet f : part.facets) planned.facets.push_back({f, points_of(snapshot, f)});
    else
      for (const Cell c : part.cells) planned.cells.push_back({c, points_of(snapshot, c)});
    if (planned.is_done())
      throw Error(Error_code::input, fmt::format("changes[{}].{}: no {} of the environment lies there", i,
                                                 change_names[static_cast<std::size_t>(change.kind)],
                                                 of_facets ? "facet between two cells" : "cell"));
  }
}

template <int D>
bool Change_schedule<D>::is_due(std::uint32_t step) const {
  return std::any_of(planned_.begin(), planned_.end(), [&](const Planned& planned) {
    return planned.step <= step && step <= planned.until && !planned.is_done();
  });
}

template <int D>
std::vector<Change_outcome> Change_schedule<D>::apply(const Snapshot<D>& snapshot, Reshaping<D>& reshaping,
                                                      std::uint32_t step) {
  std::vector<Change_outcome> outcomes;
  for (Planned& planned : planned_) {
    if (step < planned.step || planned.until < step) continue;
    if (planned.suture)
      sew(snapshot, reshaping, planned, step, outcomes);
    else if (planned.blade)
      make_cut(reshaping, planned, outcomes);
    else
      apply_once(snapshot, reshaping, planned, outcomes);
  }
  return outcomes;
}

template <int D>
void Change_schedule<D>::make_cut(Reshaping<D>& reshaping, Planned& planned,
                                  std::vector<Change_outcome>& outcomes) {
  Change_outcome& outcome = outcomes.emplace_back();
  outcome.change = planned.number;
  outcome.kind = planned.kind;
  outcome.cut = reshaping.cut(blade_of<D>(*planned.blade), {.opening = planned.blade->opening});
  outcome.result.is_made = outcome.cut->opened != 0 || outcome.cut->slit != 0;
  if (!outcome.result.is_made)
    outcome.result.reason = "the blade parts no solid cells, and slits no membrane";
  planned.blade.reset();
  // A new point may have the index of one that is gone.
  for (const Cut_point& made : outcome.cut->points)
    std::erase_if(stitches_, [&](const Stitch& s) { return s.point == made.point || s.onto == made.point; });
  for (const auto& [point, between, share] : outcome.cut->points)
    if (between[0] == between[1]) stitches_.push_back({point, between[0]});
}

/// Makes the stitches that gape in a part. Those that are refused are kept.
template <int D>
void Change_schedule<D>::sew(const Snapshot<D>& snapshot, Reshaping<D>& reshaping, Planned& planned,
                             std::uint32_t step, std::vector<Change_outcome>& outcomes) {
  const auto note = [&] {
    Change_outcome& outcome = outcomes.emplace_back();
    outcome.change = planned.number;
    outcome.kind = planned.kind;
    planned.has_sewn = true;
    return &outcome;
  };
  for (std::size_t i = stitches_.size(); i-- > 0;) {
    const Stitch stitch = stitches_[i];
    if (!snapshot.is_point(stitch.point) || !snapshot.is_point(stitch.onto)) {  // relaxing took one away
      stitches_.erase(stitches_.begin() + static_cast<std::ptrdiff_t>(i));
      continue;
    }
    const Point<D>& x = snapshot.point(stitch.onto);
    if (!lies_in(*planned.suture, x + 0.5 * (snapshot.point(stitch.point) - x))) continue;
    Change_outcome& outcome = *note();
    outcome.stitch = stitch;
    Replacement made = reshaping.merge_vertices(stitch.point, stitch.onto);
    outcome.result = {made.is_made, std::move(made.reason), std::move(made.held_by)};
    if (!made.is_made) continue;
    stitches_.erase(stitches_.begin() + static_cast<std::ptrdiff_t>(i));
    // A vertex that was parted from the point that is gone now gapes from the other one.
    for (Stitch& other : stitches_)
      if (other.onto == stitch.point) other.onto = stitch.onto;
  }
  if (step < planned.until) return;
  if (!planned.has_sewn) note()->result.reason = "no cut gapes there";
  planned.suture.reset();
}

/// Keeps refused changes.
template <int D>
void Change_schedule<D>::apply_once(const Snapshot<D>& snapshot, Reshaping<D>& reshaping, Planned& planned,
                                    std::vector<Change_outcome>& outcomes) const {
  const auto change_all = [&](auto& all, const auto& change) {
    auto kept = all.begin();
    for (auto& [name, points] : all) {
      const bool is_there = is_same(snapshot, name, points);
      if (is_there && !needs_change(snapshot, planned.kind, name)) continue;
      Change_outcome& outcome = outcomes.emplace_back();
      outcome.change = planned.number;
      outcome.kind = planned.kind;
      if (is_there)
        outcome.result = change(name, outcome);
      else
        outcome.result.reason = "a cut, or relaxing, replaced it";
      if (is_there && !outcome.result.is_made) *kept++ = {name, std::move(points)};
    }
    all.erase(kept, all.end());
  };
  change_all(planned.facets, [&](Half_facet facet, Change_outcome& outcome) {
    outcome.facet = facet;
    outcome.cell = snapshot.cell_of(facet);
    return planned.kind == Change_kind::open ? reshaping.open(facet) : reshaping.close(facet);
  });
  change_all(planned.cells, [&](Cell cell, Change_outcome& outcome) {
    outcome.cell = cell;
    return planned.kind == Change_kind::excavate ? reshaping.excavate(cell) : reshaping.fill(cell);
  });
}

template Groups<2> all_groups(const Snapshot<2>&, const Environment_changes<2>&, Groups<2>);
template Groups<3> all_groups(const Snapshot<3>&, const Environment_changes<3>&, Groups<3>);
template class Change_schedule<2>;
template class Change_schedule<3>;

}  // namespace cellwalk
