// SPDX-License-Identifier: LGPL-3.0-or-later
// The targets of points, their moves among bodies, and moves repeated after a relaxation.
#include "walls.h"

#include <cellwalk/loading/environment_file.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "cli/common/contact_kind_names.h"
#include "cli/common/counts_json.h"

namespace cellwalk::cli {

template <int D>
Run_walls<D>::Run_walls(Result_files& place, Environment<D>& environment, const Scene<D>& scene,
                        const std::string& name, Still)
    : environment_(environment),
      time_step_(scene.time_step),
      table_(place.table("walls.csv", {"step", "vertex", "time", "x", "y", "z", "kind", "nx", "ny", "nz",
                                       "cell", "body", "particle", "feature", "number"})) {
  options_.at_contact = scene.walls->push ? At_contact::push : At_contact::stop;
  const Scene_walls<D>& walls = *scene.walls;
  if (walls.soft) forces_.emplace(place.table("forces.csv", {"step", "vertices", "largest_yield", "force"}));
  name_ = name;
  material_ = walls.tissue;
  fixed_ = walls.fixed;
  relaxation_ = walls.relax;
  if (!relaxation_) return;
  relax_options_.good_enough = relaxation_->good_enough;
  relax_options_.most_rounds = static_cast<int>(relaxation_->rounds);
  relax_options_.most_operations = relaxation_->operations;
}

template <int D>
Run_walls<D>::Run_walls(Result_files& place, Environment<D>& environment, const Scene<D>& scene,
                        const std::string& name)
    : Run_walls(place, environment, scene, name, Still{}) {
  const Scene_walls<D>& walls = *scene.walls;
  if (walls.pulsation) pulsation_.emplace(environment.snapshot(), *walls.pulsation, walls.fixed);
  if (walls.soft) foundation_.emplace(environment.snapshot(), *walls.soft, walls.fixed);
  if (!walls.motion.empty()) motion_ = read_timed_moves(walls.motion, environment);
  if (!relaxation_) return;
  std::set<std::uint32_t> named;
  for (const Timed_move<D>& timed : motion_) named.insert(timed.move.point);
  relax_options_.keep.assign(named.begin(), named.end());
}

template <int D>
Run_walls<D>::Run_walls(Result_files& place, Environment<D>& environment, const Scene<D>& scene,
                        const std::string& name, detail::Byte_reader& saved)
    : Run_walls(place, environment, scene, name, Still{}) {
  const detail::State_access<D> parts(environment.snapshot(), scene);
  if (scene.walls->pulsation) pulsation_ = parts.read_pulsation(saved);
  if (scene.walls->soft) foundation_ = parts.read_foundation(saved);
  if (saved.next<bool>()) tissue_ = parts.read_tissue(saved);
  saved(*this);
}

template <int D>
void Run_walls<D>::save(detail::Byte_writer& out) const {
  if (pulsation_) detail::save(out, *pulsation_);
  if (foundation_) detail::save(out, *foundation_);
  out(tissue_.has_value());
  if (tissue_) detail::save(out, *tissue_);
  out(*this);
}

/// Where points are to be after a step, as far as they are not there for sure.
template <int D>
std::vector<Vertex_move<D>> Run_walls<D>::targets(const World<D>& world, std::uint32_t step) {
  if (material_ && !tissue_)
    naming(name_, [&] { tissue_.emplace(environment_.snapshot(), *material_, fixed_); });
  if (tissue_) return tissue_->targets(world);
  if (pulsation_) {
    auto result = pulsation_->targets(step * time_step_);
    if (foundation_)
      for (auto& [point, target] : result) target = foundation_->yielding(point, target);
    return result;
  }
  if (foundation_) return foundation_->targets();
  for (; next_ < motion_.size() && motion_[next_].step <= step; ++next_)
    pending_[motion_[next_].move.point] = motion_[next_].move.target;
  std::vector<Vertex_move<D>> result;
  for (const auto& [point, target] : pending_) result.push_back({point, target});
  return result;
}

template <int D>
void Run_walls<D>::follow(std::span<const Change_outcome> changes) {
  if (!tissue_ || changes.empty()) return;
  std::vector<Cut_point> points;
  for (const Change_outcome& change : changes)
    if (change.cut) points.insert(points.end(), change.cut->points.begin(), change.cut->points.end());
  tissue_->follow_changes(points);
}

template <int D>
void Run_walls<D>::step(World<D>& world) {
  const std::uint32_t step = world.steps_done() + 1;
  if (foundation_) foundation_->press(world);
  const std::vector<Vertex_move<D>> moves = targets(world, step);
  if (!moves.empty()) move(world, step, moves);
  if (foundation_) record_forces(step);
  if (!tissue_) return;
  tissue_->follow();
  largest_stretch_ = std::max(largest_stretch_, tissue_->largest_stretch());
}

template <int D>
void Run_walls<D>::move(World<D>& world, std::uint32_t step, const std::vector<Vertex_move<D>>& moves) {
  Move_report<D> report = world.move_walls(environment_, moves, options_, counts_);
  record(step, report);
  for (std::uint32_t i = 0; relaxation_ && i < relaxation_->tries && relax(world, report.short_of_target);
       ++i)
    go_on(world, step, moves, report.short_of_target);
  moves_ += moves.size();
  ends_[static_cast<std::size_t>(Move_end::reached)] += moves.size() - report.short_of_target.size();
  std::map<std::uint32_t, Point<D>> left;
  for (const Vertex_result<D>& result : report.short_of_target) {
    ++ends_[static_cast<std::size_t>(result.end)];
    if (const auto found = pending_.find(result.point); found != pending_.end()) left.insert(*found);
  }
  pending_ = std::move(left);
  if (foundation_) foundation_->follow(moves, report);
}

/// Makes cells around the points better that would make one flat. Returns whether anything was done.
template <int D>
bool Run_walls<D>::relax(World<D>& world, std::span<const Vertex_result<D>> short_of_target) {
  std::set<std::uint32_t> points;
  for (const Vertex_result<D>& result : short_of_target)
    if (result.end == Move_end::cell) points.insert(result.point);
  if (points.empty()) return false;
  for (std::uint32_t ring = 0; ring < relaxation_->rings; ++ring)
    for (const std::uint32_t point : std::vector(points.begin(), points.end()))
      for (const Cell cell : environment_.cells_around(point)) {
        const auto vertices = environment_.snapshot().view(cell).vertices;
        points.insert(vertices.begin(), vertices.end());
      }
  const std::vector<std::uint32_t> around(points.begin(), points.end());
  const Relax_report made = world.relax(environment_, around, relax_options_, counts_);
  relaxed_.smoothed += made.smoothed;
  relaxed_.flipped += made.flipped;
  relaxed_.edges_removed += made.edges_removed;
  relaxed_.split += made.split;
  relaxed_.collapsed += made.collapsed;
  return made.operations() > 0;
}

/// Moves the points again that would have made a cell flat.
template <int D>
void Run_walls<D>::go_on(World<D>& world, std::uint32_t step, const std::vector<Vertex_move<D>>& moves,
                         std::vector<Vertex_result<D>>& short_of_target) {
  std::map<std::uint32_t, Point<D>> targets;
  for (const auto& [point, target] : moves) targets[point] = target;
  std::vector<Vertex_move<D>> again;
  std::vector<Vertex_result<D>> left;
  for (const Vertex_result<D>& result : short_of_target) {
    if (result.end == Move_end::cell)
      again.push_back({result.point, targets.at(result.point)});
    else
      left.push_back(result);
  }
  const Move_report<D> report = world.move_walls(environment_, again, options_, counts_);
  record(step, report);
  left.insert(left.end(), report.short_of_target.begin(), report.short_of_target.end());
  short_of_target = std::move(left);
}

template <int D>
void Run_walls<D>::record_forces(std::uint32_t step) {
  const double yield = foundation_->largest_yield(), force = foundation_->force();
  forces_->row(step, foundation_->yielding_count(), yield, force);
  largest_yield_ = std::max(largest_yield_, yield);
  largest_force_ = std::max(largest_force_, force);
}

template <int D>
void Run_walls<D>::finish() {
  table_.commit();
  if (forces_) forces_->commit();
}

template <int D>
void Run_walls<D>::record(std::uint32_t step, const Move_report<D>& report) {
  // In the plane the third coordinates are left empty, as the writer does with numbers that are not finite.
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  const Snapshot<D>& snapshot = environment_.snapshot();
  for (const Wall_hit<D>& hit : report.hits) {
    const Point<D>& x = hit.point;
    const Vector<D> n = hit.normal + Vector<D>{};  // no negative zeros
    const Resident& resident = hit.resident;
    const std::string body = resident.is_particle ? "" : std::to_string(resident.owner);
    const std::string particle = resident.is_particle ? std::to_string(resident.number) : "";
    const std::string number = resident.is_particle ? "" : std::to_string(resident.number);
    const char* const feature =
        resident.is_particle ? "" : feature_names[static_cast<std::size_t>(resident.feature)];
    table_.row(step, hit.vertex, hit.time, x[0], x[1], D == 3 ? x[D - 1] : nothing,
               contact_kind_names[static_cast<std::size_t>(hit.kind)], n[0], n[1],
               D == 3 ? n[D - 1] : nothing, snapshot.index(snapshot.cell_of(hit.facet)), body, particle,
               feature, number);
  }
  hits_ += report.hits.size();
}

template <int D>
nlohmann::ordered_json Run_walls<D>::report() const {
  nlohmann::ordered_json json{{"moves", moves_}};
  for (std::size_t e = 0; e < ends_.size(); ++e) json["status"][move_end_names[e]] = ends_[e];
  json["contacts"] = hits_;
  if (foundation_) json["soft"] = {{"largest_yield", largest_yield_}, {"largest_force", largest_force_}};
  if (tissue_) json["tissue"] = {{"edges", tissue_->edge_count()}, {"largest_stretch", largest_stretch_}};
  if (relaxation_)
    json["relaxed"] = {{"smoothed", relaxed_.smoothed},
                       {"flipped", relaxed_.flipped},
                       {"edges_removed", relaxed_.edges_removed},
                       {"split", relaxed_.split},
                       {"collapsed", relaxed_.collapsed}};
  json["counts"] = to_json(counts_);
  json["counts"]["walk"] = to_json(counts_.walk);
  return json;
}

template <int D>
std::string Run_walls<D>::describe() const {
  std::string ends;
  for (std::size_t e = 1; e < ends_.size(); ++e)
    if (ends_[e] != 0) ends += fmt::format(", {} {}", ends_[e], move_end_names[e]);
  std::string soft;
  if (foundation_)
    soft = fmt::format("; they yield by up to {:.3g} to forces up to {:.3g}", largest_yield_, largest_force_);
  if (tissue_) soft = fmt::format("; edges of tissue are stretched by up to {:.3g}", largest_stretch_);
  if (relaxation_) soft = fmt::format("; {} operations made cells better", relaxed_.operations());
  return fmt::format("{} moves of points: {} {}{}; {} contacts, {} pushes{}", moves_, ends_[0],
                     move_end_names[0], ends, hits_, counts_.pushes, soft);
}

template class Run_walls<2>;
template class Run_walls<3>;

}  // namespace cellwalk::cli
