// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/body/body.h>
#include <cellwalk/simulation/trace_body.h>

#include <algorithm>
#include <utility>

namespace cellwalk {

Trace_counts& Trace_counts::operator+=(const Trace_counts& other) {
  moves += other.moves;
  vertex_hits += other.vertex_hits;
  edge_hits += other.edge_hits;
  triangle_hits += other.triangle_hits;
  rounds += other.rounds;
  held += other.held;
  edges += other.edges;
  return *this;
}

Body_soup<3> trace_body_soup(Trace_positions positions) {
  Body_soup<3> soup;
  soup.points.assign(positions.begin(), positions.end());
  for (std::uint32_t v = 0; v < trace_vertices; ++v)
    for (std::size_t k = 0; k < trace_edges; ++k)
      if (const auto w = static_cast<std::uint32_t>(trace_neighbour(v, k)); v < w)
        soup.edges.push_back({v, w});
  return soup;
}

Trace_body::Trace_body(const Snapshot<3>& snapshot, const Locator<3>& locator, Trace_positions positions)
    : snapshot_(&snapshot), epoch_(snapshot.epoch()), chains_(trace_edges * trace_vertices) {
  const Body<3> body(snapshot, locator, trace_body_soup(positions));
  std::ranges::copy(body.particles(), particles_.begin());
  std::size_t edge = 0;
  for (std::size_t v = 0; v < trace_vertices; ++v)
    for (std::size_t k = 0; k < trace_edges; ++k)
      if (v < trace_neighbour(v, k)) chains_[place(v, k)] = body.chain(edge++);
}

Chain Trace_body::chain(std::size_t vertex, std::size_t k) const {
  const Chain& stored = chains_[place(vertex, k)];
  return stored.empty() || vertex < trace_neighbour(vertex, k) ? stored : reversed(*snapshot_, stored);
}

Trace_body::Move Trace_body::move(std::size_t vertex, const Point<3>& target, Sweep sweep,
                                  Trace_counts& counts) {
  snapshot_->check_epoch(epoch_, "this body of a trace was registered: make it anew");
  ++counts.moves;
  Move result;
  const Particle<3> from = particles_[vertex];
  Particle<3> to = from;
  visited_.clear();
  crossed_.clear();
  const Walk_result<3> walked = cellwalk::move(*snapshot_, to, target, counts.edges.walk,
                                               {Walk_strategy::certified, &visited_, &crossed_});
  if (walked.contact) {
    result.answer = sweep == Sweep::triangle ? trace_segment_bit | trace_triangle_bits : trace_segment_bit;
    result.contact = vertex_contact(*snapshot_, from.position, target, *walked.contact, counts.edges.walk);
    ++counts.vertex_hits;
    ++counts.held;
    return result;
  }
  const Way<3> way{from, to, visited_, crossed_, false};
  Sweep_options options;
  options.sweep = sweep;
  std::array<Chain, trace_edges> chains;
  for (std::size_t k = 0; k < trace_edges; ++k) {
    const Particle<3>& q = particles_[trace_neighbour(vertex, k)];
    Sweep_result<3> swept = sweep_edge_along(*snapshot_, way, q, chain(vertex, k), options, counts.edges);
    chains[k] = std::move(swept.chain);
    if (!swept.contact) continue;
    if (!result.contact || is_before(*swept.contact, *result.contact)) result.contact = swept.contact;
    bool hits = true;
    if (sweep == Sweep::triangle) {
      result.answer |= 1u << (4 + k);
      ++counts.triangle_hits;
      Chain_result<3> anew = find_any_chain(*snapshot_, to, q, counts.edges.walk);
      hits = anew.contact.has_value();
      counts.rounds += !hits;
      chains[k] = std::move(anew.chain);
    }
    if (!hits) continue;
    result.answer |= 1u << (1 + k);
    ++counts.edge_hits;
  }
  if ((result.answer & trace_edge_bits) != 0) {
    ++counts.held;
    return result;
  }
  particles_[vertex] = to;
  for (std::size_t k = 0; k < trace_edges; ++k)
    chains_[place(vertex, k)] = vertex < trace_neighbour(vertex, k) || chains[k].empty()
                                    ? std::move(chains[k])
                                    : reversed(*snapshot_, chains[k]);
  return result;
}

}  // namespace cellwalk
