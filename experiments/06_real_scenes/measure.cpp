// SPDX-License-Identifier: LGPL-3.0-or-later
#include "measure.h"

#include <algorithm>
#include <limits>
#include <regex>
#include <stdexcept>

#include "common/processor_time.h"

namespace cellwalk::real_scenes {
namespace {

using experiments::processor_seconds;

/// What a replay found.
struct Replayed {
  std::vector<double> step_seconds;
  std::uint64_t missed = 0, reported = 0;
  std::uint64_t digest = 0xcbf29ce484222325u;  ///< changes with any answer (FNV-1a)

  double seconds() const {
    double sum = 0;
    for (const double s : step_seconds) sum += s;
    return sum;
  }
};

Replayed replay(Peer& peer, const Motion& motion, std::vector<std::uint8_t>& blocked) {
  Replayed result;
  peer.prepare();
  for (std::size_t s = 0; s < motion.trace.steps; ++s) {
    peer.place(motion.trace.before_step(s));
    const auto targets = motion.trace.targets_of_step(s);
    const double start = processor_seconds();
    peer.step(targets, blocked);
    result.step_seconds.push_back(processor_seconds() - start);
    peer.note(blocked);
    const auto exact = motion.blocked_in_step(s);
    for (std::size_t v = 0; v < blocked.size(); ++v) {
      result.missed += exact[v] && !blocked[v];
      result.reported += blocked[v] && !exact[v];
      result.digest = (result.digest ^ blocked[v]) * 0x100000001b3u;
    }
  }
  return result;
}

Peers build(const Scene_walls& walls, const Motion& motion, const std::string& only) {
  Peers peers;
  add_cellwalk_peers(walls, motion, peers);
  // Rays have no radius, and Bullet's boxes with distances would be cgal_doubles.
#ifdef CELLWALK_WITH_BULLET
  if (motion.radius == 0) add_bullet_peers(walls, motion, peers);
#endif
#ifdef CELLWALK_WITH_FCL
  add_fcl_peers(walls, motion, peers);
#endif
#ifdef CELLWALK_WITH_EMBREE
  if (motion.radius == 0) add_embree_peers(walls, motion, peers);
#endif
  add_cgal_peers(walls, motion, peers);
  if (!only.empty()) {
    const std::regex pattern(only);
    std::erase_if(peers, [&](const auto& peer) { return !std::regex_search(peer->name, pattern); });
  }
  return peers;
}

void note_times(Row& row, const Replayed& replayed, std::size_t moves) {
  row.rounds.push_back(replayed.seconds() * 1e9 / static_cast<double>(moves));
  row.step_us.resize(replayed.step_seconds.size(), std::numeric_limits<double>::infinity());
  for (std::size_t s = 0; s < row.step_us.size(); ++s)
    row.step_us[s] = std::min(row.step_us[s], replayed.step_seconds[s] * 1e6);
}

}  // namespace

std::vector<Row> measure(const Scene_walls& walls, const Motion& motion, const Measure_options& options) {
  const Peers peers = build(walls, motion, options.only);
  std::vector<std::uint8_t> blocked(motion.trace.vertices());
  std::vector<Row> rows;
  std::vector<std::uint64_t> digests;
  std::vector<int> rounds;
  for (const auto& peer : peers) {
    // The round to warm up is the one whose answers are judged.
    const Replayed replayed = replay(*peer, motion, blocked);
    rows.push_back({peer->name,
                    peer->library,
                    peer->is_exact,
                    peer->is_reproducible,
                    peer->margin_steps,
                    peer->build,
                    peer->edge_cells,
                    replayed.missed,
                    replayed.reported,
                    peer->counts(),
                    {},
                    {}});
    digests.push_back(replayed.digest);
    const double wanted = options.seconds / std::max(replayed.seconds(), 1e-9);
    rounds.push_back(wanted < options.rounds ? std::max(1, static_cast<int>(wanted)) : options.rounds);
  }
  for (int round = 0; round < options.rounds; ++round)
    for (std::size_t i = 0; i < peers.size(); ++i) {
      if (round >= rounds[i]) continue;
      const Replayed replayed = replay(*peers[i], motion, blocked);
      if (replayed.digest != digests[i])
        throw std::runtime_error(rows[i].method + " answers another round otherwise");
      note_times(rows[i], replayed, motion.trace.moves());
    }
  return rows;
}

}  // namespace cellwalk::real_scenes
