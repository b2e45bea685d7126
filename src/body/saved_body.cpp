// SPDX-License-Identifier: LGPL-3.0-or-later
// The bytes of a body, with tests that restored names, sizes and invariants are sound.
#include <cellwalk/body/body.h>
#include <cellwalk/internal/body/body_access.h>
#include <cellwalk/internal/kernel/byte_archive.h>
#include <cellwalk/internal/kernel/checksum.h>
#include <cellwalk/internal/walk/saved_particle.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>

#include "body_state.h"

namespace cellwalk {
namespace detail {
namespace {

constexpr std::array<char, 8> magic{'C', 'W', 'B', 'O', 'D', 'Y', '\r', '\n'};
/// To be raised whenever bodies get other parts, or these another meaning.
constexpr std::uint32_t version = 3;
/// That of bodies with a radius.
constexpr std::uint32_t version_with_radii = 4;
constexpr std::uint32_t byte_order = 0x01020304;

/// The bytes before the state.
struct Head {
  std::array<char, 8> magic = detail::magic;
  std::uint32_t version = detail::version, byte_order = detail::byte_order, dimension = 0, unused = 0;
  std::uint64_t checksum = 0;  ///< of all that follows

  template <class Archive>
  void archive(Archive& a) {
    a(magic, version, byte_order, dimension, unused, checksum);
  }
};

[[noreturn]] void refuse(const std::string& what) { throw Error(Error_code::input, what); }

/// The numbers by which the environment of a body is recognised.
template <int D>
std::array<std::uint64_t, 5> identity(const Snapshot<D>& snapshot) {
  return {snapshot.epoch(), snapshot.geometry_epoch(), snapshot.half_facet_slots(), snapshot.cell_count(),
          snapshot.points().size()};
}

/// The parts of a body, and a body made of them.
template <int D>
class Saved_body {
 public:
  static void write(const Body<D>& body, Byte_writer& out) {
    auto& state = const_cast<Body_state<D>&>(Body_access<D>::state_of(body));  // only read
    state.check_epoch();
    out(identity(*state.snapshot), state.positions, state.topology.edges(), state.topology.faces());
    if (!state.thick.are_none()) out(state.soup().radii);
    Body_certificates chosen = state.certificates;
    visit_certificates(out, chosen);
    visit_state(out, state);
  }

  static Body<D> read(const Snapshot<D>& snapshot, Byte_reader& in, bool has_radii) {
    const auto known = in.next<std::array<std::uint64_t, 5>>();
    if (known != identity(snapshot))
      refuse(
          "this body was saved in another environment, or before an edit: restore it in the one in which it "
          "was");
    auto positions = in.next<std::vector<Point<D>>>();
    auto edges = in.next<std::vector<std::array<std::uint32_t, 2>>>();
    auto faces = in.next<std::vector<std::array<std::uint32_t, 3>>>();
    std::vector<double> radii;
    if (has_radii) in(radii);
    Body_certificates chosen;
    visit_certificates(in, chosen);
    const std::size_t vertices = positions.size();
    auto state = std::make_unique<Body_state<D>>(snapshot, std::move(positions),
                                                 topology_of(vertices, std::move(edges), std::move(faces)),
                                                 radii, chosen);
    visit_state(in, *state);
    in.expect_end();
    check(*state);
    Body<D> body = Body_access<D>::body_of(std::move(state));
    check_registration(body);
    return body;
  }

 private:
  template <class Archive>
  static void visit_certificates(Archive& a, Body_certificates& chosen) {
    a(chosen.body_region, chosen.star_regions, chosen.clusters, chosen.chains_in_place,
      chosen.least_vertices_of_parts, chosen.least_edges_a_vertex);
  }
  template <class Archive>
  static void visit_state(Archive& a, Body_state<D>& state) {
    a(state.particles, state.chains, state.supporting_walls, state.may_have_supporting_walls,
      state.are_faces_swept, state.is_apart, state.region, state.pool);
  }

  static Body_topology topology_of(std::size_t vertices, std::vector<std::array<std::uint32_t, 2>> edges,
                                   std::vector<std::array<std::uint32_t, 3>> faces) {
    try {
      return Body_topology(vertices, std::move(edges), std::move(faces));
    } catch (const Error& error) {
      refuse(error.what());
    }
  }

  /// Tests that sizes agree, and that each name refers to something.
  static void check(const Body_state<D>& state) {
    const Snapshot<D>& snapshot = *state.snapshot;
    const auto is_facet = [&](Half_facet f) {
      if (to_index(f) >= snapshot.half_facet_slots()) return false;
      const Cell cell = snapshot.cell_of(f);
      return snapshot.is_cell(cell) && snapshot.facet_of(f) < snapshot.facet_count(cell);
    };
    const auto is_particle = [&](const Particle<D>& p) {
      return is_finite(p.position) && snapshot.is_cell(p.cell);
    };
    bool is_good = std::ranges::all_of(state.positions, is_finite<D>) &&
                   state.particles.size() == state.positions.size() &&
                   state.chains.size() == state.topology.edges().size() &&
                   state.supporting_walls.size() == state.topology.faces().size() &&
                   state.region.is_consistent(state.positions.size(), state.chains.size()) &&
                   state.pool.is_consistent(state.positions.size());
    is_good = is_good && std::ranges::all_of(state.particles, is_particle);
    for (const Chain& chain : state.chains) is_good = is_good && std::ranges::all_of(chain, is_facet);
    for (const Supporting_walls& walls : state.supporting_walls)
      is_good = is_good && std::ranges::all_of(walls, is_facet);
    const auto has_anchor = [&](const Clear_region<D>& region) { return is_particle(region.anchor()); };
    if (state.region.has_region()) is_good = is_good && has_anchor(*state.region.region());
    is_good = is_good && std::ranges::all_of(state.pool.regions(), has_anchor);
    if (!is_good) Byte_reader::refuse();
  }

  /// Tests I1, I2 and I3, of a copy, since stale vertices and edges are registered for that.
  static void check_registration(const Body<D>& body) {
    Body<D> copy = body;
    Body_counts uncounted;
    try {
      copy.refresh(uncounted);
      copy.validate();
    } catch (const Error& error) {
      refuse(std::string("a saved body does not fit this environment: ") + error.what());
    }
  }
};

}  // namespace
}  // namespace detail

template <int D>
std::vector<std::byte> save(const Body<D>& body) {
  detail::Byte_writer state;
  detail::Saved_body<D>::write(body, state);
  detail::Head head;
  head.dimension = D;
  if (!detail::Body_access<D>::state_of(body).thick.are_none()) head.version = detail::version_with_radii;
  head.checksum = detail::checksum(state.bytes());
  detail::Byte_writer out;
  out(head);
  out.put_bytes(state.bytes());
  return out.take();
}

template <int D>
Body<D> restore_body(const Snapshot<D>& snapshot, std::span<const std::byte> bytes) {
  const detail::Head expected;
  constexpr std::size_t head_size = 32;
  if (bytes.size() < head_size) detail::refuse("these bytes are no saved body, or are cut short");
  detail::Byte_reader in(bytes.first(head_size));
  const auto head = in.next<detail::Head>();
  if (head.magic != expected.magic) detail::refuse("these bytes are no saved body, or are cut short");
  if (head.byte_order != expected.byte_order)
    detail::refuse("this body was saved on a machine of another byte order: save it on this one");
  const bool has_radii = head.version == detail::version_with_radii;
  if (head.version != expected.version && !has_radii)
    detail::refuse("this body was saved in version " + std::to_string(head.version) +
                   " of the format, and this program reads version " + std::to_string(expected.version) +
                   ": save it again");
  if (head.dimension != D)
    detail::refuse("this body was saved in " + std::to_string(head.dimension) +
                   "D, and the environment is of " + std::to_string(D) + "D");
  if (head.checksum != detail::checksum(bytes.subspan(head_size)))
    detail::refuse("this saved body is damaged: its checksum differs");
  detail::Byte_reader state(bytes.subspan(head_size));
  return detail::Saved_body<D>::read(snapshot, state, has_radii);
}

template std::vector<std::byte> save(const Body<2>&);
template std::vector<std::byte> save(const Body<3>&);
template Body<2> restore_body(const Snapshot<2>&, std::span<const std::byte>);
template Body<3> restore_body(const Snapshot<3>&, std::span<const std::byte>);

}  // namespace cellwalk
