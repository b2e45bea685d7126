// SPDX-License-Identifier: LGPL-3.0-or-later
// The complete sweep against the oracle that follows the definition of chains.
#include <cellwalk/edge/triangle.h>
#include <cellwalk/kernel/predicates.h>

#include <gtest/gtest.h>

#include <chrono>
#include <iostream>

#include "edge/chain_oracle.h"
#include "edge/edge_worlds.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {
namespace {

/// A half-facet of the snapshot in the soup: the facet of the same cell with the same points.
template <int D>
std::uint32_t soup_facet(const Cell_soup<D>& soup, const Snapshot<D>& snapshot, Half_facet f) {
  const auto sorted = [](auto loop) {
    std::vector<std::uint32_t> key(loop.begin(), loop.end());
    std::sort(key.begin(), key.end());
    return key;
  };
  const std::uint32_t c = snapshot.index(snapshot.cell_of(f));
  std::uint32_t i = soup.cell_begin[c];
  while (sorted(soup.facet(i)) != sorted(snapshot.loop(f))) ++i;
  return i;
}

template <int D>
std::vector<std::uint32_t> soup_chain(const Cell_soup<D>& soup, const Snapshot<D>& snapshot,
                                      const Chain& chain) {
  std::vector<std::uint32_t> r;
  for (const Half_facet f : chain) r.push_back(soup_facet(soup, snapshot, f));
  return r;
}

template <int D>
oracle::Edge_motion<D> motion_of(const Cell_soup<D>& soup, const Snapshot<D>& snapshot, const Way<D>& way,
                                 const Particle<D>& q, const Chain& chain) {
  oracle::Edge_motion<D> motion{way.from.position,
                                way.to.position,
                                q.position,
                                {},
                                snapshot.index(q.cell),
                                soup_chain(soup, snapshot, chain),
                                way.blocked};
  for (const Cell c : way.visited) motion.way.push_back(snapshot.index(c));
  return motion;
}

struct Seen {
  int sweeps = 0, judged = 0, by_events = 0, collinear = 0;
  int must_block = 0, must_free = 0, either = 0, touches = 0, choices = 0;
  int wrong_block = 0, wrong_free = 0, wrong_time = 0, wrong_chain = 0;
  int col_wrong_block = 0, col_wrong_free = 0, col_wrong_chain = 0;
  int blocked = 0, blocked_edge = 0, blocked_wrong = 0, blocked_chain = 0, threw = 0;
  long critical = 0;
  double seconds = 0;
  Edge_counts counts;
};

template <int D>
void explore(bool generic, std::size_t first, std::size_t worlds) {
  Seen seen;
  int shown = 0;
  for (std::uint64_t number = first; number < first + worlds; ++number) {
    Edge_world<D> w(number, generic);
    const oracle::Chain_oracle<D> oracle(w.world.soup);
    for (int k = 0; k < 60; ++k) {
      Particle<D> p = w.start();
      if (p.cell == Cell::none) continue;
      const Particle<D> q = w.end(p);
      if (q.cell == Cell::none) continue;
      Chain_result<D> edge = find_chain(w.snapshot, p, q, seen.counts.walk);
      for (int step = 0; step < 6 && !edge.contact; ++step) {
        const Particle<D> from = p;
        std::vector<Cell> visited;
        std::vector<Half_facet> crossed;
        w.choose_kind();
        const Point<D> target = w.target(p);
        const auto walked =
            move(w.snapshot, p, target, seen.counts.walk, {Walk_strategy::certified, &visited, &crossed});
        Particle<D> to = p;
        const bool blocked = walked.status != Walk_status::arrived;
        if (blocked) {
          to.position = target;
          to.cell = visited.back();
        }
        const Way<D> way{from, to, visited, crossed, blocked};
        const auto before = seen.counts;
        const Chain old = edge.chain;
        const Chain_result<D> result = sweep_triangle<D>(w.snapshot, way, q, old, seen.counts);
        ++seen.sweeps;
        const bool events = seen.counts.event_sweeps > before.event_sweeps;
        seen.by_events += events;
        const bool col = are_collinear(from.position, target, q.position);
        const auto t0 = std::chrono::steady_clock::now();
        const auto motion = motion_of(w.world.soup, w.snapshot, way, q, old);
        const char* branch = events                                       ? "events"
                             : seen.counts.clear > before.clear           ? "clear"
                             : seen.counts.same_chain > before.same_chain ? "same chain"
                             : seen.counts.same_cell > before.same_cell   ? "same cell"
                                                                          : "other";
        const auto show = [&](const char* what, const oracle::Outcomes& v) {
          if (++shown > 12) return;
          std::cout << w.world.name << " k " << k << " step " << step << ": " << what << " (" << branch
                    << (col ? ", collinear" : "") << (blocked ? ", p blocked" : "") << ") time "
                    << (result.contact ? result.contact->time : -1) << " oracle:";
          for (const auto& s : v.blocks)
            std::cout << " block " << double(s.numerator) / double(s.denominator);
          std::cout << " ends " << v.ends.size() << " end "
                    << double(v.end.numerator) / double(v.end.denominator) << "\n";
        };
        try {
          const auto verdict = oracle.judge(motion);
          ++seen.judged;
          seen.critical += verdict.critical;
          seen.touches += verdict.touches;
          seen.choices += verdict.choices > 0;
          seen.collinear += col;
          if (blocked) {
            ++seen.blocked;
            seen.blocked_edge += result.contact.has_value();
            if (result.contact
                    ? !(col ? !verdict.blocks.empty() : verdict.may_be_blocked_at(result.contact->time))
                    : !verdict.may_be_free()) {
              ++seen.blocked_wrong;
              show("blocked way, wrong", verdict);
            } else if (!result.contact &&
                       !oracle.is_end(motion, verdict, soup_chain(w.world.soup, w.snapshot, result.chain))) {
              ++seen.blocked_chain;
            }
          } else {
            seen.must_block += !verdict.may_be_free();
            seen.must_free += verdict.blocks.empty();
            seen.either += !verdict.blocks.empty() && verdict.may_be_free();
            if (result.contact) {
              if (verdict.blocks.empty()) {
                ++(col ? seen.col_wrong_block : seen.wrong_block);
                show("wrong block", verdict);
              } else if (!col && !verdict.may_be_blocked_at(result.contact->time)) {
                ++seen.wrong_time;
                show("wrong time", verdict);
              }
            } else {
              if (!verdict.may_be_free()) {
                ++(col ? seen.col_wrong_free : seen.wrong_free);
                show("wrong free", verdict);
              } else if (!oracle.is_end(motion, verdict,
                                        soup_chain(w.world.soup, w.snapshot, result.chain))) {
                ++(col ? seen.col_wrong_chain : seen.wrong_chain);
                show("wrong chain", verdict);
              }
            }
          }
        } catch (const std::exception& e) {
          ++seen.threw;
          if (++shown <= 12)
            std::cout << w.world.name << " k " << k << " step " << step << " " << branch << " threw "
                      << e.what() << "\n";
          if (std::string(e.what()) == "the chain before is none") break;
        }
        seen.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count();
        if (!blocked) edge = result;
        if (blocked) p = from;
      }
    }
  }
  std::cout << D << "D " << (generic ? "generic" : "degenerate") << ": sweeps " << seen.sweeps << " judged "
            << seen.judged << " threw " << seen.threw << " events " << seen.by_events << " same cell "
            << seen.counts.same_cell << " same chain " << seen.counts.same_chain << " clear "
            << seen.counts.clear << " collinear " << seen.collinear << " | must block " << seen.must_block
            << " must free " << seen.must_free << " either " << seen.either << " touches " << seen.touches
            << " choices " << seen.choices << " | wrong block " << seen.wrong_block << " free "
            << seen.wrong_free << " time " << seen.wrong_time << " chain " << seen.wrong_chain
            << " | collinear wrong block " << seen.col_wrong_block << " free " << seen.col_wrong_free
            << " chain " << seen.col_wrong_chain << " | p blocked " << seen.blocked << " edge "
            << seen.blocked_edge << " wrong " << seen.blocked_wrong << " chain " << seen.blocked_chain
            << " | critical " << seen.critical << " seconds " << seen.seconds << "\n";
}

TEST(ChainOracle, Explore2) {
  explore<2>(false, 0, oracle::scaled_count(12));
  explore<2>(true, 0, oracle::scaled_count(12));
}
TEST(ChainOracle, Explore3) {
  explore<3>(false, 0, oracle::scaled_count(12));
  explore<3>(true, 0, oracle::scaled_count(12));
}

}  // namespace
}  // namespace cellwalk::test
