// SPDX-License-Identifier: LGPL-3.0-or-later
// A number policy of one's own: where all coordinates are small integers, signs can be had in 64-bit
// integers, exactly. The walk is compiled for it here, and gives the answers of the policy that is shipped.
#include <cellwalk/cellwalk.h>
#include <cellwalk/paper.h>  // for walks by signs alone
#include <cellwalk/walk/walk_impl.h>

#include <cstdint>
#include <cstdio>
#include <random>

//! [kernel]
/// Exact for integer coordinates of at most 2^19: differences are at most 2^20, a product of three of them
/// 2^60, and six of these fit into 64 bits.
struct Small_integers {
  static constexpr bool is_exact = true;            // no guard against contradicting signs is needed
  static constexpr bool uses_certificates = false;  // the walk asks for signs only
  static constexpr const char* name = "small integers";

  static int orientation(cellwalk::Predicate_counts& counts, const cellwalk::Point<3>& p,
                         const cellwalk::Point<3>& q, const cellwalk::Point<3>& r,
                         const cellwalk::Point<3>& s) {
    ++counts.orientations;
    const auto difference = [&p](const cellwalk::Point<3>& x, int i) {
      return static_cast<std::int64_t>(x[i]) - static_cast<std::int64_t>(p[i]);
    };
    const std::int64_t ax = difference(q, 0), ay = difference(q, 1), az = difference(q, 2);
    const std::int64_t bx = difference(r, 0), by = difference(r, 1), bz = difference(r, 2);
    const std::int64_t cx = difference(s, 0), cy = difference(s, 1), cz = difference(s, 2);
    const std::int64_t value = (ax * by - ay * bx) * cz + (bx * cy - by * cx) * az + (cx * ay - cy * ax) * bz;
    return (value > 0) - (value < 0);
  }
};
//! [kernel]

int main() {
  using namespace cellwalk;
  Simplex_grid_options<3> grid;
  grid.cells = {8, 8, 8};
  grid.map = scaled<3>(16);
  const auto environment = Environment<3>::build(tetrahedral_grid(grid));
  const Snapshot<3>& snapshot = environment.snapshot();
  const Locator<3> locator(snapshot);

  // Integer points, most of them on facets, edges and vertices; some targets lie outside.
  std::mt19937_64 random(7);
  const auto lattice_point = [&random](std::uint64_t range) {
    Point<3> p;
    for (double& x : p) x = 4 * static_cast<double>(random() % range);
    return p;
  };
  //! [walk]
  Walk_counts own, shipped;
  int different = 0, contacts = 0;
  for (int i = 0; i < 20000; ++i) {
    const Particle<3> particle = locator.particle_at(lattice_point(33)).value();
    const Point<3> target = lattice_point(36);
    const auto a = walk<Small_integers>(snapshot, particle, target, own);
    const auto b = walk<Exact>(snapshot, particle, target, shipped, Walk_strategy::exit_rule);
    different += a.status != b.status || a.cell != b.cell;
    contacts += a.status == Walk_status::contact;
  }
  //! [walk]
  std::printf("20000 walks, %d contacts, %d answers differ\n", contacts, different);
  std::printf("signs: %s\n",
              own.predicates.orientations == shipped.predicates.orientations ? "as many" : "others");
  return different;
}
