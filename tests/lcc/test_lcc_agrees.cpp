// SPDX-License-Identifier: LGPL-3.0-or-later
// The walker on darts and the walker on the snapshot share no data structure and no code: they must agree in
// degenerate worlds, about each motion and each edge.
#include <cellwalk/edge/chain.h>
#include <cellwalk/edge/contact_search.h>
#include <cellwalk/edge/sweep.h>
#include <cellwalk/environment/map.h>
#include <cellwalk/internal/environment/build_map.h>
#include <cellwalk/internal/walk/link_search.h>
#include <cellwalk/internal/walk/signs.h>
#include <cellwalk/lcc/contact_search.h>
#include <cellwalk/lcc/defect.h>
#include <cellwalk/lcc/walker.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <sstream>
#include <string>

#include "walk/oracle_trial.h"
#include "walk/reordered.h"

namespace cellwalk::oracle {
namespace {

constexpr std::size_t motions_in_ci = 20'000;
constexpr std::size_t motions_of_world = 80;

struct Agreement {
  std::size_t motions = 0, contacts = 0, choices = 0, stars = 0;
  std::size_t edges = 0, blocked_edges = 0, edge_choices = 0;
  std::size_t searches = 0, found = 0;
  std::size_t differ = 0;
  std::string first;
};

/// True if passable facets that contain a point link two cells.
template <int D>
bool are_linked(const Snapshot<D>& snapshot, Cell one, Cell other, const Point<D>& x) {
  Walk_counts counts;
  const auto cells = detail::linked_cells(snapshot, one, [&](const Cell_view<D>& cell, std::size_t i) {
    return detail::side<Exact>(cell, i, x, counts) == 0 && detail::in_facet(cell, i, x);
  });
  return std::find(cells.begin(), cells.end(), other) != cells.end();
}

/// True if a time is the greatest double that is not later than an exact one.
bool is_rounded_down(double time, const lcc::Rational& exact) {
  const double next = std::nextafter(time, std::numeric_limits<double>::infinity());
  return lcc::Rational(time) <= exact && exact < lcc::Rational(next);
}

template <int D>
class Both {
 public:
  struct Is_wall {
    const Map<D>* map;
    bool operator()(const Const_dart<D>& d) const { return map->info(d).is_impassable(); }
  };
  using Walker = lcc::Walker<Map<D>, Is_wall>;

  Both(std::uint64_t number, bool generic, Agreement& seen)
      : world_(make_world<D>(number)),
        oracle_(world_.soup),
        gluing_(glue(world_.soup)),
        storage_(build(world_.soup, gluing_, number % 2 == 1)),
        snapshot_(Snapshot<D>::compile(world_.soup, gluing_)),
        walker_(storage_->map, {&storage_->map}),
        source_(world_, number),
        generic_(generic),
        seen_(seen) {}

  void run() {
    EXPECT_FALSE(lcc::find_defect(walker_)) << world_.name;
    for (std::size_t k = 0; k < motions_of_world; ++k) {
      move_once();
      sweep_once();
    }
  }

 private:
  /// Facets seen counterclockwise from outside or, reversed, from inside.
  static std::unique_ptr<Map_storage<D>> build(const Cell_soup<D>& soup, const Gluing& gluing,
                                               bool is_reversed) {
    auto storage = build_map(soup, gluing);
    if (is_reversed) storage->map.reverse_orientation();
    return storage;
  }

  void move_once() {
    const Motion_kind kind = source_.kind(generic_);
    if (!has_particle_ || kind == Motion_kind::in_wall_plane || kind == Motion_kind::along_edge ||
        source_.random().below(8) == 0)
      put_particle(kind);
    const Point<D> from = particle_.position, to = source_.target(kind, from, last_);
    ++seen_.motions;
    Walk_counts counts;
    const Walk_result<D> flat = walk(snapshot_, particle_, to, counts);
    lcc::Counts signs;
    const auto mapped = walker_.walk(on_map(particle_), to_map_point(to), signs);
    seen_.contacts += flat.contact.has_value();
    seen_.choices += flat.had_choice;
    seen_.stars += signs.stars > 0;
    const std::string why = difference(flat, mapped, to);
    if (!why.empty()) note(why, from, to);
    has_particle_ = why.empty() && flat.status == Walk_status::arrived;
    if (!has_particle_) return;
    last_ = from;
    before_ = particle_;
    particle_ = {to, flat.cell, flat.dimension, flat.aimed};
  }

  /// The end p of an edge, along which a particle has just walked, moves.
  void sweep_once() {
    if (!has_particle_) return;
    const Particle<D>&p = before_, q = particle_;
    Motion_kind kind = source_.kind(generic_);
    if (kind == Motion_kind::in_wall_plane || kind == Motion_kind::along_edge) kind = Motion_kind::to_lattice;
    const Point<D> target = source_.target(kind, p.position, q.position);
    Walk_counts counts;
    const Walk_result<D> way = walk(snapshot_, p, target, counts);
    lcc::Counts signs;
    const auto check = walker_.check_edge(on_map(p), to_map_point(target), on_map(q), signs);
    ++seen_.edges;
    seen_.blocked_edges += check.status == lcc::Status::contact;
    if (way.contact) {
      if (!check.is_by_vertex || !is_rounded_down(way.contact->time, check.contact->time))
        note("way of an edge's end", p.position, target, &q.position);
      return;
    }
    // Where p had a choice, the edge may pass on another side than that which p prefers.
    const Particle<D> moved{target, way.cell, way.dimension, way.aimed};
    const auto chain = find_any_chain(snapshot_, moved, q, counts);
    seen_.edge_choices += way.had_choice || chain.has_choice;
    const bool is_free = check.status == lcc::Status::arrived;
    if (is_free != !chain.contact && !(way.had_choice && is_free))
      note("edge", p.position, target, &q.position);
    if (chain.contact && !way.had_choice) search_once(p, target, q);
  }

  /// Both searches of the paper, where the temporary particle is blocked.
  void search_once(const Particle<D>& p, const Point<D>& target, const Particle<D>& q) {
    Edge_counts counts;
    const auto before = find_any_chain(snapshot_, p, q, counts.walk);
    if (before.contact || before.has_choice) return;
    lcc::Counts signs;
    const auto search_flat = [&](Contact_search method) {
      Search_options search;
      search.method = method;
      search.cells = Search_cells::traversed;
      Sweep_options options;
      options.sweep = Sweep::three_segments;
      options.search = &search;
      counts.search_misses = 0;
      const auto contact = sweep_edge(snapshot_, p, target, q, before.chain, options, counts).contact;
      return counts.search_misses == 0 ? contact : std::nullopt;
    };
    const auto bisected = search_flat(Contact_search::dichotomic_segment);
    const auto found = search_flat(Contact_search::exhaustive);
    const auto bisected_on_map =
        lcc::dichotomic_search(walker_, on_map(p), to_map_point(target), on_map(q), 0x1p-20, signs);
    const auto found_on_map =
        lcc::exhaustive_search(walker_, on_map(p), to_map_point(target), on_map(q), signs);
    ++seen_.searches;
    if (bisected && (!bisected_on_map || bisected_on_map->time != lcc::Rational(bisected->time)) &&
        !has_choice_before(p, target, bisected->time))
      note("bisection", p.position, target, &q.position);
    if (bool(found) != bool(found_on_map)) return note("search", p.position, target, &q.position);
    if (!found) return;
    ++seen_.found;
    if (!is_rounded_down(found->time, found_on_map->time))
      return note("time of a search", p.position, target, &q.position);
    // Several obstacles may be met at that time, so that the normals may differ; both are against the motion.
    const Vector<D> normal = found_on_map->normal;
    if (std::abs(length(normal) - 1) > 1e-12 ||
        dot(normal, target - p.position) > 1e-9 * length(target - p.position))
      note("normal of a search", p.position, target, &q.position);
  }

  /// True if p has a choice of sides on its way to a position that a bisection tries which found this time.
  /// On the snapshot p takes the side that it prefers there, on the map any on which the edge is free.
  bool has_choice_before(const Particle<D>& p, const Point<D>& target, double found) const {
    Particle<D> reached = p;
    for (double half = 0.5; half >= 0x1p-20; half /= 2) {
      const double middle = 2 * half * std::floor(found / (2 * half)) + half;
      const Point<D> to = p.position + middle * (target - p.position);
      Walk_counts counts;
      const Walk_result<D> way = walk(snapshot_, reached, to, counts);
      if (way.had_choice) return true;
      if (middle <= found) reached = {to, way.cell, way.dimension, way.aimed};  // the edge was free there
    }
    return false;
  }

  std::string difference(const Walk_result<D>& flat, const lcc::Walk<Map<D>>& mapped,
                         const Point<D>& to) const {
    const bool arrives = flat.status == Walk_status::arrived;
    if (arrives != (mapped.status == lcc::Status::arrived) || mapped.status == lcc::Status::lost)
      return "status";
    if (flat.had_choice != mapped.had_choice) return "choice";
    if (arrives) {
      const Cell end = snapshot_.cell(storage_->map.info(mapped.dart).cell());
      return are_linked(snapshot_, flat.cell, end, to) ? "" : "end";
    }
    const Contact<D>& contact = *flat.contact;
    if (!is_rounded_down(contact.time, mapped.contact->time)) return "time";
    const int dimension = contact.kind == Contact_kind::facet  ? D - 1
                          : contact.kind == Contact_kind::edge ? 1
                                                               : 0;
    if (dimension != mapped.contact->dimension) return "kind";
    if (feature_of(snapshot_, contact) != feature_on_map(*mapped.contact)) return "feature";
    // Of two walls met exactly as head-on, snapshots compare rounded slopes.
    const Vector<D> normal = mapped.contact->normal;
    const Vector<D> way = normalized(to - particle_.position);
    const bool are_as_steep = std::abs(dot(normal - contact.normal, way)) < 1e-12;
    return length(normal - contact.normal) < 1e-12 || are_as_steep ? "" : "normal";
  }

  std::vector<Point<D>> feature_on_map(const lcc::Contact<Map<D>>& contact) const {
    std::vector<Point<D>> feature;
    const auto add = [&](const Const_dart<D>& d) {
      const auto& p = storage_->map.point(d);
      Point<D>& x = feature.emplace_back();
      for (int i = 0; i < D; ++i) x[static_cast<std::size_t>(i)] = p[i];
    };
    const auto next = [&](const Const_dart<D>& d) { return storage_->map.template beta<1>(d); };
    add(contact.feature);
    if (contact.dimension == 1) add(next(contact.feature));
    if (contact.dimension == 2)
      for (Const_dart<D> d = next(contact.feature); d != contact.feature; d = next(d)) add(d);
    std::sort(feature.begin(), feature.end());
    return feature;
  }

  lcc::Particle<Map<D>> on_map(const Particle<D>& particle) {
    const std::uint32_t c = snapshot_.index(particle.cell);
    const std::uint32_t begin = world_.soup.cell_begin[c], end = world_.soup.cell_begin[c + 1];
    const auto facet = begin + static_cast<std::uint32_t>(source_.random().below(end - begin));
    return {to_map_point(particle.position), storage_->dart_of_half_facet[facet]};
  }

  void put_particle(Motion_kind kind) {
    for (;;) {
      const Point<D> p = source_.start(kind);
      const Place place = oracle_.place(p);
      if (place.free_cells.empty()) continue;
      const std::size_t choice = source_.random().below(place.free_cells.size());
      particle_ = {p, snapshot_.cell(place.free_cells[choice]),
                   static_cast<std::uint16_t>(place.dimensions[choice]), 0};
      last_ = p;
      has_particle_ = true;
      return;
    }
  }

  void note(const std::string& what, const Point<D>& from, const Point<D>& to, const Point<D>* q = nullptr) {
    ++seen_.differ;
    if (!seen_.first.empty()) return;
    std::ostringstream text;
    text << what << " in " << world_.name << ':' << std::hexfloat;
    for (const Point<D>* x : {&from, &to, q})
      if (x)
        for (const double c : *x) text << ' ' << c;
    seen_.first = text.str();
  }

  const World<D> world_;
  const Oracle<D> oracle_;
  const Gluing gluing_;
  const std::unique_ptr<Map_storage<D>> storage_;
  const Snapshot<D> snapshot_;
  const Walker walker_;
  Motion_source<D> source_;
  const bool generic_;
  Agreement& seen_;
  Particle<D> particle_, before_;
  bool has_particle_ = false;
  Point<D> last_{};
};

template <int D>
void compare_walkers(bool generic) {
  Agreement seen;
  const std::size_t total = scaled_count(motions_in_ci);
  for (std::uint64_t number = 9'000'000; seen.motions < total; ++number) Both<D>(number, generic, seen).run();
  std::cout << D << "D, " << (generic ? "generic" : "degenerate") << ": " << seen.motions << " motions, "
            << seen.contacts << " contacts, " << seen.stars << " through stars, " << seen.choices
            << " with a choice of side; " << seen.edges << " edges, " << seen.blocked_edges << " blocked, "
            << seen.edge_choices << " with a choice; " << seen.searches << " searches, " << seen.found
            << " found; " << seen.differ << " differ\n";
  EXPECT_EQ(seen.differ, 0u) << seen.first;
  EXPECT_GT(seen.contacts, seen.motions / 5);
  EXPECT_GT(seen.edges, seen.motions / 4);
  EXPECT_GT(seen.blocked_edges, seen.edges / 10);
  EXPECT_GT(seen.found, seen.motions / 200);
  if (generic) return;
  EXPECT_GT(seen.stars, seen.motions / 10);
  EXPECT_GT(seen.choices, seen.motions / 1000);
  EXPECT_GT(seen.edge_choices, seen.edges / 1000);
}

TEST(LccWalker, AgreesWithSnapshots2) {
  for (const bool generic : {true, false}) compare_walkers<2>(generic);
}
TEST(LccWalker, AgreesWithSnapshots3) {
  for (const bool generic : {true, false}) compare_walkers<3>(generic);
}

}  // namespace
}  // namespace cellwalk::oracle
