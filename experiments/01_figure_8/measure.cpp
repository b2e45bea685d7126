// SPDX-License-Identifier: LGPL-3.0-or-later
#include "measure.h"

#include <algorithm>
#include <bit>
#include <regex>
#include <span>
#include <stdexcept>

#include "common/order_statistics.h"
#include "common/processor_time.h"

namespace cellwalk::figure_8 {
namespace {

using experiments::processor_seconds;
using Answers = std::vector<std::uint8_t>;

/// A number that changes with any answer: whole answers are kept for one method at a time only.
std::uint64_t digest(const Answers& answers) {
  std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a
  for (const std::uint8_t a : answers) hash = (hash ^ a) * 0x100000001b3u;
  return hash;
}

void compare(const Trace& trace, unsigned bits, const Answers& answers, Row& row) {
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const unsigned exact = trace.answers[i] & bits, own = answers[i] & bits;
    row.hits += static_cast<unsigned>(std::popcount(exact));
    row.wrong.missed += static_cast<unsigned>(std::popcount(exact & ~own));
    row.wrong.reported += static_cast<unsigned>(std::popcount(own & ~exact));
  }
}

Peers build(const Grid_world& world, const std::vector<Family>& families, const std::string& only) {
  Peers peers;
  for (const Family& family : families) family.make(world, peers);
  if (!only.empty()) {
    const std::regex pattern(only);
    std::erase_if(peers, [&](const auto& peer) { return !std::regex_search(peer->name(), pattern); });
  }
  return peers;
}

/// The first steps of a trace.
Trace beginning(const Trace& trace, std::uint32_t steps) {
  Trace first = trace;
  first.steps = steps;
  first.targets.resize(first.moves());
  first.answers.resize(first.moves());
  return first;
}

/// Seconds of a replay. The clock starts when another trace, or a part of this one, has been replayed, so
/// that no method pays for what the others left in the caches.
double timed_replay(Peer& peer, const Trace& before, const Trace& trace, Answers& answers) {
  peer.prepare(before);
  peer.replay(before, std::span(answers).first(before.moves()));
  peer.prepare(trace);
  const double start = processor_seconds();
  peer.replay(trace, answers);
  return processor_seconds() - start;
}

}  // namespace

double Row::median() const { return experiments::median(rounds); }

std::vector<Row> measure(const Grid_world& world, const Trace& trace, const std::vector<Family>& families,
                         const Measure_options& options) {
  const Peers peers = build(world, families, options.only);
  constexpr std::uint32_t part = 8;
  const Trace first = beginning(trace, (trace.steps + part - 1) / part);
  Answers answers(trace.moves());
  std::vector<Row> rows;
  std::vector<std::uint64_t> digests;
  std::vector<int> rounds;
  // A replay in less than a second: a method that finds its data in the caches is not compared with one that
  // meets most of them for the first time in its round.
  std::vector<bool> is_short;
  for (const auto& peer : peers) {
    Row row{peer->name(), peer->is_reproducible(), peer->build, 0, {}, {}, {}};
    // The round to warm up is the one whose answers are compared.
    const double seconds = timed_replay(*peer, first, trace, answers);
    compare(trace, peer->answer_bits(), answers, row);
    digests.push_back(digest(answers));
    rounds.push_back(std::clamp(static_cast<int>(options.seconds / seconds), 1, std::max(options.rounds, 1)));
    is_short.push_back(seconds < 1);
    peer->prepare(trace);
    row.counts = peer->count(trace, answers);
    if (digest(answers) != digests.back())
      throw std::runtime_error(row.method + " answers otherwise when it counts");
    rows.push_back(std::move(row));
  }
  for (int round = 0; round < options.rounds; ++round)
    for (std::size_t i = 0; i < peers.size(); ++i) {
      if (round >= rounds[i]) continue;
      const double seconds = timed_replay(*peers[i], is_short[i] ? trace : first, trace, answers);
      rows[i].rounds.push_back(seconds * 1e9 / static_cast<double>(trace.moves()));
      if (digest(answers) != digests[i])
        throw std::runtime_error(rows[i].method + " answers another round otherwise");
    }
  return rows;
}

}  // namespace cellwalk::figure_8
