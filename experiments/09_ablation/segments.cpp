// SPDX-License-Identifier: LGPL-3.0-or-later
#include "segments.h"

#include <cellwalk/body/body.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/walk/locate.h>

#include "wall_judge.h"

namespace cellwalk::ablation {
namespace {

using real_scenes::Loaded_scene;
using real_scenes::Motion;

/// The verdicts on the recorded motion, step by step.
class Asked {
 public:
  Asked(const Motion& motion, const Wall_judge& judge) : motion_(motion), judge_(judge) {}

  Asked_tally run() {
    const Body_trace& trace = motion_.trace;
    for (std::size_t s = 0; s < trace.steps; ++s) {
      const auto before = trace.before_step(s), targets = trace.targets_of_step(s);
      std::vector<Point<3>> at(before.begin(), before.end());
      for (std::size_t b = 0; b < motion_.bodies(); ++b) {
        const std::size_t first = motion_.first_vertex[b];
        for (std::uint32_t v = 0; v < motion_.joints[b]->vertices(); ++v) {
          ask(at, b, v, targets[first + v]);
          if (!motion_.blocked_in_step(s)[first + v]) at[first + v] = targets[first + v];
        }
      }
    }
    return tally_;
  }

 private:
  void ask(const std::vector<Point<3>>& at, std::size_t b, std::uint32_t v, const Point<3>& target) {
    const auto neighbours = motion_.joints[b]->neighbours[v];
    const std::size_t first = motion_.first_vertex[b];
    const std::uint8_t* answers = motion_.trace.answers.data() + answer_;
    answer_ += 1 + neighbours.size();
    const Point<3>& from = at[first + v];
    ++tally_.moves;
    const bool is_blocked = is_yes(judge_.judge_segment(from, target), answers[0], body_trace_blocked);
    tally_.vertices_blocked += is_blocked;
    if (is_blocked) return;
    bool any_swept = false, any_at_end = false;
    for (std::size_t i = 0; i < neighbours.size(); ++i) {
      const Point<3>& q = at[first + neighbours[i]];
      const bool swept = is_yes(judge_.judge({from, target, q, q}), answers[1 + i], body_trace_swept);
      const bool at_end = is_yes(judge_.judge_segment(target, q), answers[1 + i], body_trace_blocked);
      ++tally_.edges;
      tally_.swept += swept;
      tally_.at_end += at_end;
      tally_.unseen += swept && !at_end;
      any_swept |= swept;
      any_at_end |= at_end;
    }
    tally_.rounds += any_swept && !any_at_end;
  }
  /// What the judge says, compared with what was recorded; that where the judge cannot tell.
  bool is_yes(Verdict verdict, std::uint8_t answer, std::uint8_t bit) {
    const bool recorded = (answer & bit) != 0;
    if (verdict == Verdict::undecided) {
      ++tally_.undecided;
      return recorded;
    }
    tally_.wrong += recorded != (verdict == Verdict::blocked);
    return verdict == Verdict::blocked;
  }

  const Motion& motion_;
  const Wall_judge& judge_;
  std::size_t answer_ = 0;
  Asked_tally tally_;
};

Stop_tally run_stops(const Loaded_scene& scene, const Snapshot<3>& snapshot, const Wall_judge& judge,
                     Sweep sweep) {
  const Body_trace& trace = scene.motion.trace;
  const Locator<3> locator(snapshot);
  Body_options options;
  options.sweep.sweep = sweep;
  options.most_contacts = 1;
  Stop_tally tally;
  for (std::size_t s = 0; s < trace.steps; ++s) {
    bool is_through = false;
    for (std::size_t b = 0; b < trace.bodies.size(); ++b) {
      const std::size_t first = scene.motion.first_vertex[b], count = trace.bodies[b].vertices;
      const auto before = trace.before_step(s).subspan(first, count);
      Body<3> body(snapshot, locator, {{before.begin(), before.end()}, trace.bodies[b].edges, {}});
      Step_report<3> report;
      Body_counts counts;
      body.step(trace.targets_of_step(s).subspan(first, count), options, report, counts);
      tally.moves += count;
      tally.contacts += report.contacts.size();
      for (const Contact<3>& contact : report.contacts) tally.of_edges += contact.body == Body_feature::edge;
      // Each vertex went straight to where it is, while those after it stood where they were.
      const auto after = body.positions();
      std::vector<Point<3>> at(before.begin(), before.end());
      for (std::uint32_t v = 0; v < count; ++v) {
        bool is_blocked = false, is_decided = true;
        for (const std::uint32_t q : scene.motion.joints[b]->neighbours[v]) {
          const Verdict verdict = judge.judge({at[v], after[v], at[q], at[q]});
          is_blocked |= verdict == Verdict::blocked;
          is_decided &= verdict != Verdict::undecided;
        }
        at[v] = after[v];
        tally.through += is_blocked;
        tally.undecided += !is_blocked && !is_decided;
        is_through |= is_blocked;
      }
    }
    tally.steps_through += is_through;
  }
  return tally;
}

}  // namespace

Segment_row run_segments(const std::string& name, const Loaded_scene& scene) {
  const auto environment = Environment<3>::build(
      scene.soup, {.duplicates = Duplicate_vertices::keep, .split = false, .keep_map = false});
  const Wall_judge judge(experiments::wall_mesh(scene.soup, scene.gluing));
  return {name, Asked(scene.motion, judge).run(),
          run_stops(scene, environment.snapshot(), judge, Sweep::three_segments),
          run_stops(scene, environment.snapshot(), judge, Sweep::triangle)};
}

}  // namespace cellwalk::ablation
