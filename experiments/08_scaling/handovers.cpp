// SPDX-License-Identifier: LGPL-3.0-or-later
#include "handovers.h"

#include <algorithm>
#include <set>
#include <utility>

namespace cellwalk::scaling {
namespace {

constexpr std::uint32_t unknown = UINT32_MAX;

}  // namespace

Ranges::Ranges(const Snapshot<3>& snapshot, std::uint32_t ranks) : ranks_(ranks) {
  std::vector<std::uint32_t> blocks;  // of cells, in the order of the curve
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    if (const Cell cell = snapshot.cell(i); cell != Cell::none) blocks.push_back(to_index(cell));
  std::sort(blocks.begin(), blocks.end());
  owner_.assign(blocks.back() + 1, unknown);
  for (std::size_t i = 0; i < blocks.size(); ++i)
    owner_[blocks[i]] = static_cast<std::uint32_t>(i * ranks / blocks.size());
  count_ghosts(snapshot);
}

void Ranges::count_ghosts(const Snapshot<3>& snapshot) {
  std::vector<std::vector<std::uint32_t>> ranks_at(snapshot.points().size());
  for (std::uint32_t c = 0; c < owner_.size(); ++c) {
    if (owner_[c] == unknown) continue;
    const auto cell = snapshot.view(Cell{c});
    for (std::size_t v = 0; v < cell.vertex_count(); ++v) {
      std::vector<std::uint32_t>& ranks = ranks_at[cell.point_index(v)];
      if (std::find(ranks.begin(), ranks.end(), owner_[c]) == ranks.end()) ranks.push_back(owner_[c]);
    }
  }
  std::vector<std::set<std::uint32_t>> neighbours(ranks_);
  for (std::uint32_t c = 0; c < owner_.size(); ++c) {
    if (owner_[c] == unknown) continue;
    std::set<std::uint32_t> needed_by;
    const auto cell = snapshot.view(Cell{c});
    for (std::size_t v = 0; v < cell.vertex_count(); ++v)
      needed_by.insert(ranks_at[cell.point_index(v)].begin(), ranks_at[cell.point_index(v)].end());
    needed_by.erase(owner_[c]);
    ghosts_ += needed_by.size();
    neighbours[owner_[c]].insert(needed_by.begin(), needed_by.end());
  }
  for (const auto& others : neighbours)
    most_neighbours_ = std::max(most_neighbours_, static_cast<std::uint32_t>(others.size()));
}

void Counter::count_vertex(std::size_t number, Cell cell) {
  if (number >= before_.size()) before_.resize(number + 1, unknown);
  const std::uint32_t rank = ranges_.owner(cell);
  ++sum_.vertices;
  ++load_[rank];
  if (before_[number] != unknown && before_[number] != rank) {
    ++sum_.moved;
    ++received_[rank];
  }
  before_[number] = rank;
}

bool Counter::count_chain(const Chain& chain, Cell first) {
  std::uint32_t rank = ranges_.owner(first);
  std::uint64_t crossings = 0;
  for (const Half_facet facet : chain) {
    const std::uint32_t next = ranges_.owner(snapshot_.neighbour(facet));
    if (next == rank) continue;
    ++crossings;
    ++received_[next];
    rank = next;
  }
  ++sum_.edges;
  sum_.parted += crossings > 0;
  sum_.crossings += crossings;
  return crossings > 0;
}

std::uint64_t Counter::count_body(const Body<3>& body, std::size_t& number) {
  const auto particles = body.particles();
  bool is_parted = false;
  for (const Particle<3>& particle : particles) {
    count_vertex(number++, particle.cell);
    is_parted |= ranges_.owner(particle.cell) != ranges_.owner(particles.front().cell);
  }
  std::vector<bool> waits(particles.size());
  for (std::size_t e = 0; e < body.edges().size(); ++e) {
    const auto [u, v] = body.edges()[e];
    if (count_chain(body.chain(e), particles[u].cell)) waits[u] = waits[v] = true;
  }
  ++sum_.bodies;
  sum_.parted_bodies += is_parted;
  return static_cast<std::uint64_t>(std::count(waits.begin(), waits.end(), true));
}

void Counter::count(const World<3>& world) {
  load_.assign(ranges_.ranks(), 0);
  received_.assign(ranges_.ranks(), 0);
  std::size_t number = 0;
  for (const Particle<3>& particle : world.particles()) count_vertex(number++, particle.cell);
  std::uint64_t longest = 0;
  for (const Moving_body<3>& moving : world.bodies())
    longest = std::max(longest, count_body(moving.body(), number));
  sum_.longest += longest;
  sum_.most_vertices += *std::max_element(load_.begin(), load_.end());
  sum_.most_received += *std::max_element(received_.begin(), received_.end());
}

}  // namespace cellwalk::scaling
