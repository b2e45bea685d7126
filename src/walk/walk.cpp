// SPDX-License-Identifier: LGPL-3.0-or-later
// A walk by float planes alone, the late location of contacts, and the walks of all number policies.
#include <cellwalk/internal/kernel/crossing.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/policies.h>
#include <cellwalk/walk/walk_impl.h>

#include <tuple>

namespace cellwalk {

template <int D>
Cell detail::certain_end(const Snapshot<D>& snapshot, const Particle<D>& from, const Point<D>& target,
                         Walk_counts& counts, std::vector<Half_facet>* crossed) {
  Float_point<D> a, b;
  if (!snapshot.frame().map(from.position, a) || !snapshot.frame().map(target, b)) return Cell::none;
  const Frame_line<D> line(a, b);
  Cell cell = from.cell;
  bool starts_inside = from.dimension == D;
  std::uint64_t crossings = 0;
  for (;; ++crossings) {
    if (crossings > snapshot.half_facet_slots()) [[unlikely]]
      refuse_uncertified();
    const Certified_exit exit = exit_of_blocks(snapshot, cell, line, starts_inside);
    counts.plane_blocks += 2 * snapshot.block_count(cell);
    if (exit.verdict == Certified_exit::inside) break;
    const Half_facet f = Snapshot<D>::half_facet(cell, exit.facet);
    if (exit.verdict != Certified_exit::leaves || snapshot.is_impassable(f)) return Cell::none;
    cell = snapshot.neighbour(f);
    starts_inside = true;
    if (crossed) crossed->push_back(f);
  }
  ++counts.walks;
  counts.stays += crossings == 0;
  counts.crossings += crossings;
  return cell;
}

void detail::refuse_removed_cell() {
  throw Error(Error_code::usage,
              "a particle is in a cell that is not there: locate it again after cells were replaced");
}

template <int D>
void locate_contact(const Snapshot<D>& snapshot, const Point<D>& a, const Point<D>& b, Contact<D>& contact) {
  if (contact.normal != Vector<D>{}) return;
  const auto corners = detail::spanning_corners(snapshot.view(snapshot.cell_of(contact.facet)),
                                                snapshot.facet_of(contact.facet));
  std::tie(contact.time, contact.point) = std::apply(
      [&](const auto&... corner) {
        const Timed_point<D> met = timed_point(Crossing<D>{a, b, {*corner...}});
        return std::pair(met.time, met.point);
      },
      corners);
  contact.normal = detail::inner_normal(corners);
}

template <int D>
Walk_result<D> detail::walk_on_sides(const Snapshot<D>& snapshot, const Particle<D>& particle,
                                     const Point<D>& target, Walk_counts& counts, const Walk_options& options,
                                     Sides_taken& choices) {
  return Particle_walk<Exact, D>(snapshot, particle, target, counts, Walk_strategy::certified, options,
                                 &choices)
      .run();
}

template Walk_result<2> detail::walk_on_sides(const Snapshot<2>&, const Particle<2>&, const Point<2>&,
                                              Walk_counts&, const Walk_options&, Sides_taken&);
template Walk_result<3> detail::walk_on_sides(const Snapshot<3>&, const Particle<3>&, const Point<3>&,
                                              Walk_counts&, const Walk_options&, Sides_taken&);
template void locate_contact(const Snapshot<2>&, const Point<2>&, const Point<2>&, Contact<2>&);
template void locate_contact(const Snapshot<3>&, const Point<3>&, const Point<3>&, Contact<3>&);

#define CELLWALK_INSTANTIATE(KERNEL, D)                                                                      \
  template Walk_result<D> walk<KERNEL, D>(const Snapshot<D>&, const Particle<D>&, const Point<D>&,           \
                                          Walk_counts&, const Walk_options&);                                \
  template Walk_result<D> walk<KERNEL, D>(const Snapshot<D>&, const Particle<D>&, const Point<D>&,           \
                                          Walk_counts&, Walk_strategy, const Walk_options&);                 \
  template Walk_result<D> move<KERNEL, D>(const Snapshot<D>&, Particle<D>&, const Point<D>&, Walk_counts&,   \
                                          Walk_strategy, const Walk_options&);                               \
  template Walk_result<D> detail::move_by_walk<KERNEL, D>(const Snapshot<D>&, Particle<D>&, const Point<D>&, \
                                                          Walk_counts&, const Walk_options&);

template Cell detail::certain_end<2>(const Snapshot<2>&, const Particle<2>&, const Point<2>&, Walk_counts&,
                                     std::vector<Half_facet>*);
template Cell detail::certain_end<3>(const Snapshot<3>&, const Particle<3>&, const Point<3>&, Walk_counts&,
                                     std::vector<Half_facet>*);

CELLWALK_INSTANTIATE(Exact, 2)
CELLWALK_INSTANTIATE(Exact, 3)
CELLWALK_INSTANTIATE(Lazy, 2)
CELLWALK_INSTANTIATE(Lazy, 3)
CELLWALK_INSTANTIATE(Unfiltered, 2)
CELLWALK_INSTANTIATE(Unfiltered, 3)
CELLWALK_INSTANTIATE(Double, 2)
CELLWALK_INSTANTIATE(Double, 3)
CELLWALK_INSTANTIATE(Tolerant, 2)
CELLWALK_INSTANTIATE(Tolerant, 3)
CELLWALK_INSTANTIATE(Scale_free, 2)
CELLWALK_INSTANTIATE(Scale_free, 3)
CELLWALK_INSTANTIATE(Float, 2)
CELLWALK_INSTANTIATE(Float, 3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
