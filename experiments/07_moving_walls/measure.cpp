// SPDX-License-Identifier: LGPL-3.0-or-later
#include "measure.h"

#include <algorithm>
#include <array>
#include <optional>

#include "common/processor_time.h"
#include "judge.h"
#include "peers/tree.h"
#include "recorder.h"

namespace cellwalk::moving_walls {
namespace {

using experiments::processor_seconds;

/// Microseconds of processor time that a function takes.
template <class Function>
double microseconds(const Function& function) {
  const double start = processor_seconds();
  function();
  return 1e6 * (processor_seconds() - start);
}

Trees make_trees(const Swept_walls& walls, const Body_edges& edges) {
  Trees trees;
#ifdef CELLWALK_WITH_BULLET
  add_bullet_trees(walls, edges, trees);
#endif
#ifdef CELLWALK_WITH_EMBREE
  add_embree_trees(walls, edges, trees);
#endif
#ifdef CELLWALK_WITH_FCL
  add_fcl_trees(walls, edges, trees);
#endif
  add_cgal_trees(walls, edges, trees);
  return trees;
}

/// Tests pairs until each move is known to be blocked or has none left.
void answer(const Swept_walls& walls, const Body_edges& edges, const std::vector<Pair>& pairs,
            Arithmetic arithmetic, std::vector<std::uint8_t>& blocked, Tally& tally) {
  blocked.assign(walls.moves().size(), 0);
  Predicate_counts counts;
  for (const auto& [t, e] : pairs)
    for (const std::uint32_t v : walls.walls().triangles[t]) {
      const std::uint32_t move = walls.rank(v);
      if (move == nothing || blocked[move]) continue;
      const Moving_wall wall = moving_wall(walls, t, move);
      if (!meet(experiments::box_of(wall.from, wall.to, wall.still[0], wall.still[1]), edges.boxes[e]))
        continue;
      ++tally.tests;
      blocked[move] = passes(arithmetic, wall, edges.ends[e], counts);
    }
  tally.signs += counts.orientations;
  tally.exact_signs += counts.fallbacks;
}

void compare(const std::vector<std::uint8_t>& blocked, const std::optional<Judgement>& truth, Tally& tally) {
  for (std::size_t i = 0; i < blocked.size(); ++i) {
    tally.blocked += blocked[i];
    if (!truth) continue;
    tally.missed += truth->blocked[i] && !blocked[i];
    tally.reported += blocked[i] && !truth->blocked[i];
  }
}

/// Says that the first blocked move is free.
void spoil(std::vector<std::uint8_t>& blocked) {
  if (const auto hit = std::ranges::find(blocked, 1); hit != blocked.end()) *hit = 0;
}

/// Drops the pairs of edges that end in the lower half of the box of their triangle.
void spoil(const Swept_walls& walls, const Body_edges& edges, std::vector<Pair>& pairs) {
  std::erase_if(pairs, [&](const Pair& pair) {
    const Box& box = walls.boxes()[pair.triangle];
    return edges.boxes[pair.edge].low[2] < (box.low[2] + box.high[2]) / 2;
  });
}

/// One round through the motion.
class Round {
 public:
  Round(Scene& scene, const Measure_options& options, Result& result)
      : scene_(scene),
        options_(options),
        result_(result),
        walls_(scene.snapshot()),
        edges_(scene.bodies()),
        swept_(walls_, positions()),
        trees_(make_trees(swept_, edges_)) {
    if (!result.rows.empty()) return;
    result.cells = scene.snapshot().cell_count();
    result.points = scene.snapshot().points().size();
    result.walls = walls_.triangles.size();
    result.bodies = scene.bodies().size();
    result.edges = edges_.ends.size();
    result.rows.push_back({"cellwalk", "cellwalk", Arithmetic::exact, {}, {}, 0, {}});
    for (const auto& tree : trees_)
      for (const Arithmetic a : arithmetics)
        result.rows.push_back({tree->name, tree->library, a, {}, {}, 0, tree->build});
  }

  void run() {
    for (int s = 1; s <= options_.steps; ++s) step(s);
  }

 private:
  std::vector<Point<3>> positions() const {
    std::vector<Point<3>> x;
    for (const std::uint32_t p : walls_.points) x.push_back(scene_.snapshot().point(p));
    return x;
  }

  void step(int s) {
    // What is done for the first time in a scene is not timed.
    const bool is_timed = s > 1;
    Recorded_step recorded = record_step(scene_, walls_, static_cast<double>(s) / options_.steps);
    const double boxes_us = microseconds([&] { swept_.begin(recorded.moves); });
    std::optional<Judgement> truth;
    if (options_.judged > 0 && s % options_.judged == 0) truth = judge(swept_, edges_);
    note(recorded, truth);

    Row& own = result_.rows.front();
    if (options_.spoiled == Spoiled::hits) spoil(recorded.blocked);
    compare(recorded.blocked, truth, own.tally);
    own.pairs += recorded.counts.edges;
    own.tally.signs += recorded.counts.walk.predicates.orientations;
    own.tally.exact_signs += recorded.counts.walk.predicates.fallbacks;
    if (is_timed) add(own.times, recorded.close_us, 0, recorded.move_us);
    for (std::size_t i = 0; i < trees_.size(); ++i) step(*trees_[i], boxes_us, truth, is_timed, i);
  }

  void step(Tree& tree, double boxes_us, const std::optional<Judgement>& truth, bool is_timed,
            std::size_t number) {
    pairs_.clear();
    const double update_us = boxes_us + microseconds([&] { tree.update(swept_); });
    const double query_us = microseconds([&] { tree.find(swept_, pairs_); });
    if (options_.spoiled == Spoiled::boxes) spoil(swept_, edges_, pairs_);
    for (std::size_t a = 0; a < arithmetics.size(); ++a) {
      Row& row = result_.rows[1 + number * arithmetics.size() + a];
      const double answer_us =
          microseconds([&] { answer(swept_, edges_, pairs_, arithmetics[a], blocked_, row.tally); });
      compare(blocked_, truth, row.tally);
      row.pairs += pairs_.size();
      if (is_timed) add(row.times, update_us, query_us, answer_us);
    }
  }

  void note(const Recorded_step& recorded, const std::optional<Judgement>& truth) {
    ++result_.steps;
    result_.point_moves += recorded.point_moves;
    result_.moves += recorded.moves.size();
    result_.dropped += recorded.dropped;
    if (!truth) return;
    Judged& judged = result_.judged;
    ++judged.steps;
    judged.moves += truth->blocked.size();
    judged.blocked += static_cast<std::uint64_t>(std::ranges::count(truth->blocked, 1));
    judged.bad_stops += truth->bad_stops;
    judged.pairs += truth->pairs;
    judged.touches += truth->touches;
  }
  static void add(Times& times, double update, double query, double answer) {
    times.update.push_back(update);
    times.query.push_back(query);
    times.answer.push_back(answer);
  }

  Scene& scene_;
  const Measure_options& options_;
  Result& result_;
  Walls walls_;
  Body_edges edges_;
  Swept_walls swept_;
  Trees trees_;
  std::vector<Pair> pairs_;
  std::vector<std::uint8_t> blocked_;
};

}  // namespace

Result measure(const std::function<std::unique_ptr<Scene>()>& make, const std::string& name,
               std::string_view movers, const Measure_options& options) {
  Result result;
  result.scene = name;
  result.movers = movers;
  for (int round = 0; round < options.rounds; ++round) {
    experiments::Build build;
    const auto scene = experiments::measured_build(build, "cell", make);
    Round(*scene, options, result).run();
    if (round == 0) result.rows.front().build = build;
  }
  return result;
}

}  // namespace cellwalk::moving_walls
