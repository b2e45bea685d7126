// SPDX-License-Identifier: LGPL-3.0-or-later
#include "motion.h"

#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cellwalk::real_scenes {
namespace {

Lists neighbours_of(const Traced_body& body) {
  std::vector<std::vector<std::uint32_t>> joined(body.vertices);
  for (const auto& [a, b] : body.edges) {
    joined[a].push_back(b);
    joined[b].push_back(a);
  }
  Lists lists;
  for (std::vector<std::uint32_t>& list : joined) {
    std::ranges::sort(list);
    lists.entries.insert(lists.entries.end(), list.begin(), list.end());
    lists.end_list();
  }
  return lists;
}

/// Grows groups one after the other, each by the vertex with the most edges into it.
class Group_maker {
 public:
  explicit Group_maker(Joints& joints)
      : joints_(joints), is_taken_(joints.vertices()), edges_in_(joints.vertices()) {}

  void run() {
    joints_.group_of.resize(joints_.vertices());
    for (std::uint32_t v = 0; v < joints_.vertices(); ++v)
      if (!is_taken_[v]) grow(v);
  }

 private:
  void grow(std::uint32_t v) {
    std::vector<std::uint32_t> reached, group;
    for (std::uint32_t next = v;;) {
      is_taken_[next] = 1;
      group.push_back(next);
      joints_.group_of[next] = static_cast<std::uint32_t>(joints_.groups.size());
      for (const std::uint32_t q : joints_.neighbours[next])
        if (edges_in_[q]++ == 0) reached.push_back(q);
      if (group.size() == Joints::group_size) break;
      const auto best = best_of(reached);
      if (best == reached.end()) break;
      next = *best;
    }
    for (const std::uint32_t q : reached) edges_in_[q] = 0;
    add(joints_.groups, group);
    reached.insert(reached.end(), group.begin(), group.end());
    std::ranges::sort(reached);
    reached.erase(std::unique(reached.begin(), reached.end()), reached.end());
    add(joints_.hulls, reached);
  }
  std::vector<std::uint32_t>::const_iterator best_of(const std::vector<std::uint32_t>& reached) const {
    auto best = reached.end();
    for (auto q = reached.begin(); q != reached.end(); ++q) {
      if (is_taken_[*q]) continue;
      if (best == reached.end() || edges_in_[*q] > edges_in_[*best] ||
          (edges_in_[*q] == edges_in_[*best] && *q < *best))
        best = q;
    }
    return best;
  }
  static void add(Lists& lists, const std::vector<std::uint32_t>& list) {
    lists.entries.insert(lists.entries.end(), list.begin(), list.end());
    lists.end_list();
  }

  Joints& joints_;
  std::vector<std::uint8_t> is_taken_;
  std::vector<std::uint32_t> edges_in_;  ///< from the group that grows
};

bool are_joined_alike(const Traced_body& a, const Traced_body& b) {
  return a.vertices == b.vertices && a.edges == b.edges;
}

void drop_steps(Body_trace& trace, std::uint32_t count) {
  const auto drop = [](auto& values, std::size_t n) {
    values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n));
  };
  drop(trace.before, count * trace.vertices());
  drop(trace.targets, count * trace.vertices());
  drop(trace.answers, count * trace.answers_of_step());
  trace.steps -= count;
}

double common_radius(const Body_trace& trace) {
  std::vector<double> all;
  for (const Traced_body& body : trace.bodies) {
    if (body.radii.empty()) all.push_back(0);
    all.insert(all.end(), body.radii.begin(), body.radii.end());
  }
  const auto [least, most] = std::ranges::minmax(all);
  if (least != most)
    throw Error(Error_code::input, "edges of the trace have different radii: give all the same");
  return least;
}

double median_step(const Body_trace& trace) {
  std::vector<double> lengths;
  for (std::size_t i = 0; i < trace.targets.size(); ++i) {
    double length = 0;
    for (std::size_t k = 0; k < 3; ++k)
      length = std::max(length, std::abs(trace.targets[i][k] - trace.before[i][k]));
    if (length > 0) lengths.push_back(length);
  }
  if (lengths.empty()) return 0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

}  // namespace

Joints make_joints(const Traced_body& body) {
  Joints joints;
  joints.neighbours = neighbours_of(body);
  Group_maker(joints).run();
  return joints;
}

void note_blocked(const Motion& motion, std::span<const std::uint8_t> answers,
                  std::span<std::uint8_t> blocked) {
  std::size_t at = 0, vertex = 0;
  for (const auto& joints : motion.joints)
    for (std::size_t v = 0; v < joints->vertices(); ++v) {
      const std::size_t count = 1 + joints->neighbours[v].size();
      std::uint8_t bits = 0;
      for (std::size_t i = 0; i < count; ++i) bits |= answers[at + i];
      blocked[vertex++] = bits & body_trace_blocked;
      at += count;
    }
}

Motion make_motion(Body_trace trace, std::uint32_t first_step) {
  Motion motion;
  motion.trace = std::move(trace);
  drop_steps(motion.trace, first_step);
  std::size_t vertices = 0;
  for (const Traced_body& body : motion.trace.bodies) {
    const bool is_known = !motion.joints.empty() && are_joined_alike(body, *(&body - 1));
    motion.joints.push_back(is_known ? motion.joints.back() : std::make_shared<Joints>(make_joints(body)));
    motion.first_vertex.push_back(vertices);
    vertices += body.vertices;
  }
  motion.first_vertex.push_back(vertices);
  motion.blocked.resize(motion.trace.moves());
  const std::size_t answers = motion.trace.answers_of_step();
  for (std::size_t s = 0; s < motion.trace.steps; ++s)
    note_blocked(motion, std::span(motion.trace.answers).subspan(s * answers, answers),
                 std::span(motion.blocked).subspan(s * vertices, vertices));
  motion.radius = common_radius(motion.trace);
  motion.step_length = median_step(motion.trace);
  return motion;
}

}  // namespace cellwalk::real_scenes
