// SPDX-License-Identifier: LGPL-3.0-or-later
// All that an environment and what lies in it consist of, in bytes: equal bytes are the same state.
#ifndef CELLWALK_TESTS_RESHAPE_STATE_DIGEST_H
#define CELLWALK_TESTS_RESHAPE_STATE_DIGEST_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/body/body_access.h>
#include <cellwalk/reshape/move.h>

#include <string>

namespace cellwalk::test {

/// \pre bodies have no regions free of walls
template <int D>
std::string digest(const Environment<D>& environment, const Residents<D>& residents) {
  std::string bytes;
  const auto append = [&](const auto* from, std::size_t count) {
    bytes.append(reinterpret_cast<const char*>(from), count * sizeof(*from));
  };
  const auto note = [&](std::size_t number) { append(&number, 1); };
  const auto note_particle = [&](const Particle<D>& p) {
    append(&p.position, 1);
    note(to_index(p.cell));
    note(p.dimension);
    note(p.aimed);
  };
  const Snapshot<D>& s = environment.snapshot();
  for (const std::size_t n : {s.epoch(), s.geometry_epoch(), s.uncertified_planes(), s.cell_count(),
                              s.cell_slots(), s.half_facet_slots(), s.points().size()})
    note(n);
  for (std::size_t i = 0; i < s.cell_slots(); ++i) {
    const Cell c = s.cell(i);
    note(to_index(c));
    if (c == Cell::none) continue;
    note(s.is_solid(c));
    append(s.blocks(c), s.block_count(c));
    append(s.links(c), 4 * s.block_count(c));
    append(s.view(c).vertices.data(), s.view(c).vertices.size());
  }
  for (std::uint32_t p = 0; p < s.points().size(); ++p) {
    note(s.is_point(p));
    if (s.is_point(p)) append(&s.point(p), 1);
  }
  for (const auto& particles : residents.particles)
    for (const Particle<D>& p : particles) note_particle(p);
  for (Body<D>* body : residents.bodies) {
    for (const Particle<D>& p : body->particles()) note_particle(p);
    for (std::size_t e = 0; e < body->edges().size(); ++e) {
      note(body->chain(e).size());
      append(body->chain(e).data(), body->chain(e).size());
    }
    const detail::Body_access<D> access(*body);
    for (std::uint32_t f = 0; f < body->faces().size(); ++f) {
      note(access.supporting_walls(f).size());
      append(access.supporting_walls(f).data(), access.supporting_walls(f).size());
    }
  }
  return bytes;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_STATE_DIGEST_H
