// SPDX-License-Identifier: LGPL-3.0-or-later
// Judges moves of walls by all that may become of each particle and edge that a wall meets.
#ifndef CELLWALK_TESTS_RESHAPE_FATE_JUDGE_H
#define CELLWALK_TESTS_RESHAPE_FATE_JUDGE_H

#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/reshape/reshaping.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "reshape/definition_oracle.h"

namespace cellwalk::test {

struct Fate_tally {
  int fates = 0, free_fates = 0;  ///< of what a wall meets, and of these those that may be free
  int choices = 0;    ///< moves blocked although all may be free by other choices, or because of a face
  int undecided = 0;  ///< touches
  int missed = 0, false_blocks = 0, wrong_times = 0, wrong_registrations = 0;
  int wrong() const { return missed + false_blocks + wrong_times + wrong_registrations; }
};

template <int D, class World>
class Fate_judge {
 public:
  explicit Fate_judge(const World& world) : world_(world) {}

  /// Notes the registrations of what walls meet, before the vertex moves.
  /// \param is_met whether a wall meets a set of points, closed
  template <class Is_met>
  void remember(const Is_met& is_met) {
    edges_.clear();
    const auto note = [&](const Source& source) {
      const Registered_edge<D> edge = now(source);
      const std::array<Point<D>, 2> ends{edge.p, edge.q};
      if (is_met(std::span(ends).first(source.is_edge ? 2 : 1))) edges_.push_back({source, edge});
    };
    for (std::size_t k = 0; k < world_.particles.size(); ++k) note({no_body, k, false});
    for (std::size_t b = 0; b < world_.bodies.size(); ++b) {
      for (std::size_t k = 0; k < world_.bodies[b]->vertex_count(); ++k) note({b, k, false});
      for (std::size_t k = 0; k < world_.bodies[b]->edges().size(); ++k) note({b, k, true});
    }
  }

  /// \param first_of_faces the first hit of a face, if there is one
  void judge(const Wall_motion<D>& motion, const Vertex_result<D>& result,
             const std::optional<Fraction>& first_of_faces, Fate_tally& tally) const {
    std::optional<Fraction> first = first_of_faces;
    bool has_choice = false;
    for (const auto& [source, before] : edges_) {
      const Fate fate = fate_of(motion, before);
      ++tally.fates;
      tally.free_fates += fate.may_be_free;
      has_choice |= fate.has_choice;
      if (result.end == Move_end::reached) {
        tally.missed += !fate.may_be_free;
        tally.wrong_registrations += fate.may_be_free && !is_end(motion, fate, now(source));
      } else if (fate.blocked && (!first || *fate.blocked < *first)) {
        first = fate.blocked;
      }
    }
    tally.undecided += result.end == Move_end::touch;
    if (result.end != Move_end::contact) return;
    const Fraction time = to_fraction(to_rational(result.hit->exact_time()));
    if (first && time == *first) return;
    if (has_choice || result.hit->resident.feature == Body_feature::face)
      ++tally.choices;
    else
      ++(first ? tally.wrong_times : tally.false_blocks);
  }

 private:
  static constexpr std::size_t no_body = static_cast<std::size_t>(-1);
  struct Source {
    std::size_t body, number;
    bool is_edge;
  };

  Registered_edge<D> now(const Source& source) const {
    if (source.body == no_body) {
      const Particle<D>& x = world_.particles[source.number];
      return {x.position, x.position, x.cell, x.cell, {}};
    }
    const Body<D>& body = *world_.bodies[source.body];
    const auto particles = body.particles();
    if (!source.is_edge) {
      const Particle<D>& x = particles[source.number];
      return {x.position, x.position, x.cell, x.cell, {}};
    }
    const auto [u, v] = body.edges()[source.number];
    return {particles[u].position,
            particles[v].position,
            particles[u].cell,
            particles[v].cell,
            {body.chain(source.number).begin(), body.chain(source.number).end()}};
  }

  const World& world_;
  std::vector<std::pair<Source, Registered_edge<D>>> edges_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_FATE_JUDGE_H
