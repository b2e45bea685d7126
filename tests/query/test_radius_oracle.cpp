// SPDX-License-Identifier: LGPL-3.0-or-later
// Random motions with a radius against all walls in rational arithmetic, half of them degenerate, in the
// worlds of the walk; and against the same worlds listed in another order, or scaled.
#include <cellwalk/internal/edge/thick_sweep.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/walk/walk.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "edge/relisted.h"
#include "edge/thick_motions.h"
#include "oracle/oracle.h"
#include "oracle/seed.h"
#include "query/thick_judge.h"
#include "walk/oracle_trial.h"

namespace cellwalk::test {
namespace {

struct Radius_seen {
  int motions = 0, particles = 0, free = 0, blocked = 0, close = 0, outside = 0;
  int starts_at_r = 0, still_ends_at_r = 0, touches = 0;  ///< exactly
  int by_edge = 0, by_face = 0, at_once = 0, several = 0, twins = 0, without_flood = 0;
  std::array<int, 3> kinds{};  ///< of features of walls
  int faults = 0;
  std::map<std::string, int> by_fault;
  std::string first;  ///< of each kind
};

std::ostream& operator<<(std::ostream& out, const Radius_seen& seen) {
  return out << seen.motions << " motions, " << seen.particles << " of particles; " << seen.free << " free, "
             << seen.blocked << " blocked, " << seen.close << " too close, " << seen.outside
             << " outside; at exactly r: " << seen.starts_at_r << " starts, " << seen.still_ends_at_r
             << " still ends, " << seen.touches << " free sweeps; " << seen.by_edge << " by the edge, "
             << seen.by_face << " by the face, at a vertex " << seen.kinds[0] << ", edge " << seen.kinds[1]
             << ", facet " << seen.kinds[2] << "; at time 0 " << seen.at_once << "; several walls block "
             << seen.several << "; found without a flood " << seen.without_flood << "; twins " << seen.twins
             << "; faults " << seen.faults << '\n'
             << seen.first;
}

template <int D>
struct Listing {
  explicit Listing(const Cell_soup<D>& soup)
      : snapshot(Snapshot<D>::compile(soup, glue(soup))), locator(snapshot) {}
  Listing(const Listing&) = delete;

  Answer<D> answer(const Thick_motion<D>& m, bool is_particle) const {
    Edge_counts counts;
    if (m.third) return answer_face(m, counts);
    if (is_particle) return answer_move<D>(snapshot, locator, m.p, m.target, {}, counts, m.radius);
    return answer_sweep<D>(snapshot, locator, {m.p, m.target, m.q, m.radius}, {}, counts);
  }

  Answer<D> answer_face(const Thick_motion<D>& m, Edge_counts& counts) const {
    const auto start = locator.particle_at(m.p);
    Answer<D> answer;
    answer.status = Motion_status::outside;
    if (!start) return answer;
    const auto result =
        detail::sweep_thick<D>(snapshot, start->cell, {m.p, m.target, m.q, m.radius, m.third}, counts);
    answer.status = result.starts_close ? Motion_status::close
                    : result.contact    ? Motion_status::contact
                                        : Motion_status::free;
    answer.contact = result.contact;
    if (!result.contact) answer.cell = walk(snapshot, *start, m.target, counts.walk).cell;
    return answer;
  }

  /// The contact of a motion that is blocked, by all walls of the environment instead of those of a flood.
  std::optional<Contact<D>> contact_without_flood(Thick_motion<D> m, bool is_particle) const {
    std::vector<Half_facet> walls;
    for (std::size_t index = 0; index < snapshot.cell_slots(); ++index) {
      const Cell cell = snapshot.cell(index);
      for (std::size_t i = 0; !snapshot.is_solid(cell) && i < snapshot.facet_count(cell); ++i)
        if (const auto half = Snapshot<D>::half_facet(cell, i); snapshot.is_impassable(half))
          walls.push_back(half);
    }
    return detail::contact_without_flood<D>(snapshot, locator.particle_at(m.p)->cell,
                                            in_library(m, is_particle), walls);
  }
  std::optional<Contact<D>> contact_by_flood(const Thick_motion<D>& m, bool is_particle) const {
    Edge_counts counts;
    return detail::sweep_thick<D>(snapshot, locator.particle_at(m.p)->cell, in_library(m, is_particle),
                                  counts)
        .contact;
  }

  const Snapshot<D> snapshot;
  const Locator<D> locator;

 private:
  static detail::Thick_motion<D> in_library(const Thick_motion<D>& m, bool is_particle) {
    detail::Thick_motion<D> motion{m.p, m.target, m.q, m.radius, m.third};
    if (is_particle) motion.q.reset();
    return motion;
  }
};

template <int D>
Cell_soup<D> scaled(Cell_soup<D> soup, double factor) {
  for (Point<D>& x : soup.points) x = factor * x;
  return soup;
}

template <int D>
class Radius_trial {
 public:
  Radius_trial(std::uint64_t number, Radius_seen& seen, bool of_faces)
      : seen_(seen),
        world_(thick_world<D>(number)),
        listing_(world_.soup),
        other_(relisted(world_.soup, number + 1).soup),
        larger_(test::scaled(world_.soup, factor)),
        judge_(listing_.snapshot),
        places_(world_.soup),
        motions_(world_, judge_.oracle(), number, of_faces) {}

  void try_motions(int count) {
    for (int k = 0; k < count; ++k) {
      Thick_motion<D> motion = motions_.next();
      for (int tries = 0; tries < 5 && !is_inside(motion); ++tries) motion = motions_.next();
      const bool is_particle = k % 8 == 0 && !motion.third;
      if (is_particle) motion.q = motion.p;
      try_motion(motion, is_particle, k % 3 == 0);
    }
  }

 private:
  static constexpr double factor = 0x1p7;

  bool is_inside(const Point<D>& x) const { return !places_.place(x).free_cells.empty(); }
  bool is_inside(const Thick_motion<D>& m) const {
    return std::ranges::all_of(before(m), [&](const Point<D>& x) { return is_inside(x); });
  }

  void try_motion(const Thick_motion<D>& m, bool is_particle, bool with_twins) {
    ++seen_.motions;
    seen_.particles += is_particle;
    const Answer<D> answer = listing_.answer(m, is_particle);
    if (!is_inside(m)) {
      ++seen_.outside;
      // What leaves free space meets a wall, too.
      const bool is_right = answer.status == Motion_status::outside ||
                            (answer.status == Motion_status::close &&
                             std::ranges::any_of(before(m), [&](const Point<D>& x) { return is_inside(x); }));
      if (!is_right) note(m, is_particle, "status of a start outside");
      return;
    }
    const Thick_truth<D> truth = judge_.truth_of(m);
    count(m, truth);
    const std::string fault = judge_.fault_of(answer, m, truth);
    if (!fault.empty()) return note(m, is_particle, fault);
    if (answer.contact && answer.status == Motion_status::contact) {
      seen_.by_edge += answer.contact->body == Body_feature::edge;
      seen_.by_face += answer.contact->body == Body_feature::face;
      ++seen_.kinds[static_cast<std::size_t>(answer.contact->kind)];
      seen_.at_once += answer.contact->time == 0;
      try_without_flood(m, is_particle);
    }
    if (!with_twins) return;
    ++seen_.twins;
    const std::string of_order = difference(m, answer, other_.answer(m, is_particle), 1);
    if (!of_order.empty()) note(m, is_particle, "another order: " + of_order);
    Thick_motion<D> larger{factor * m.p, factor * m.target, factor * m.q, factor * m.radius};
    if (m.third) larger.third = factor * *m.third;
    const std::string of_scale = difference(m, answer, larger_.answer(larger, is_particle), factor);
    if (!of_scale.empty()) note(m, is_particle, "scaled: " + of_scale);
  }

  /// Without a flood, the contact is the same in all that it has, or left open.
  void try_without_flood(const Thick_motion<D>& m, bool is_particle) {
    const auto found = listing_.contact_without_flood(m, is_particle);
    if (!found) return;
    ++seen_.without_flood;
    const Contact<D> by_flood = listing_.contact_by_flood(m, is_particle).value();
    const auto all = [](const Contact<D>& c) {
      return std::tie(c.time, c.point, c.normal, c.kind, c.corner, c.facet, c.cell, c.body);
    };
    if (found->exact_time() != by_flood.exact_time() || all(*found) != all(by_flood))
      note(m, is_particle, "without a flood: another contact");
  }

  void count(const Thick_motion<D>& m, const Thick_truth<D>& truth) {
    const Fraction square = Fraction(m.radius) * Fraction(m.radius);
    ++(truth.is_close ? seen_.close : truth.blocking.empty() ? seen_.free : seen_.blocked);
    if (truth.is_close) return;
    seen_.several += truth.blocking.size() > 1;
    if (truth.start_square == square) {
      ++seen_.starts_at_r;
      seen_.still_ends_at_r += judge_.oracle().square_to_walls(still_corners(m)) == square;
    }
    if (truth.blocking.empty() && motions_.radius_kind() == Radius_kind::of_sweep)
      seen_.touches += judge_.oracle().square_to_walls(swept(m)) == square;
  }

  /// What differs in the answers, of which the second is of a world scaled by this factor.
  static std::string difference(const Thick_motion<D>& m, const Answer<D>& a, const Answer<D>& b,
                                double scale) {
    if (a.status != b.status) return "status";
    if (a.contact.has_value() != b.contact.has_value()) return "contact";
    if (!a.contact) return "";
    const Contact<D>&x = *a.contact, &y = *b.contact;
    if (x.exact_time() != y.exact_time() || x.time != y.time) return "time";
    if (scale * x.distance != y.distance) return "distance";
    if (a.status == Motion_status::close) return "";  // of several nearest walls, any
    if (x.body != y.body) return "feature of the body";
    if (x.kind != y.kind) return "kind";
    if (scale != 1) return scale * x.point == y.point && x.normal == y.normal ? "" : "point or normal";
    double size = 0;
    for (const Point<D>& z : swept(m)) size = std::max(size, length(z));
    if (length(y.point - x.point) > 1e-9 * size) return "point";
    return length(x.normal - y.normal) > 1e-9 ? "normal" : "";
  }

  void note(const Thick_motion<D>& m, bool is_particle, const std::string& fault) {
    ++seen_.faults;
    if (++seen_.by_fault[fault] > 3) return;
    std::ostringstream text;
    text << world_.name << (is_particle ? ", particle: " : ": ") << fault << ';' << std::hexfloat;
    for (const Point<D>& x : swept(m)) {
      text << " {";
      for (const double c : x) text << c << ", ";
      text << "}";
    }
    text << " r " << m.radius << '\n';
    seen_.first += text.str();
  }

  Radius_seen& seen_;
  const oracle::World<D> world_;
  const Listing<D> listing_, other_, larger_;
  const Thick_judge<D> judge_;
  const oracle::Oracle<D> places_;
  Thick_motions<D> motions_;
};

template <int D>
void try_worlds(std::size_t worlds_in_ci, bool of_faces = false) {
  Radius_seen seen;
  const std::size_t worlds = oracle::scaled_count(worlds_in_ci);
  for (std::uint64_t i = 0; i < worlds; ++i) Radius_trial<D>(i, seen, of_faces).try_motions(32);
  std::cout << D << "D: " << seen;
  for (const auto& [fault, count] : seen.by_fault) ADD_FAILURE() << count << " times: " << fault;
  EXPECT_EQ(seen.faults, 0) << seen.first;
  if (worlds < worlds_in_ci) return;  // too few to meet everything
  const int percent = seen.motions / 100;
  EXPECT_GT(seen.free, 15 * percent);
  EXPECT_GT(seen.blocked, 15 * percent);
  EXPECT_GT(seen.close, 5 * percent);
  EXPECT_GT(seen.starts_at_r, 3 * percent);
  EXPECT_GT(seen.still_ends_at_r, percent);
  EXPECT_GT(seen.touches, 0);
  EXPECT_GT(seen.by_edge, 2 * percent);
  if (of_faces) {
    EXPECT_GT(seen.by_face, 2 * percent);
  }
  // In the plane walls have no edges, in space their vertices are seldom met.
  EXPECT_GT(seen.kinds[0], D == 2 ? 5 * percent : 0);
  if (D == 3) {
    EXPECT_GT(seen.kinds[1], 2 * percent);
  }
  EXPECT_GT(seen.kinds[2], 10 * percent);
  EXPECT_GT(seen.at_once, percent);
  EXPECT_GT(seen.several, 5 * percent);
  EXPECT_GT(seen.without_flood, seen.blocked / 2);
}

TEST(RadiusOracle, Motions2) { try_worlds<2>(114); }
TEST(RadiusOracle, Motions3) { try_worlds<3>(76); }
TEST(RadiusOracle, MotionsOfFaces) { try_worlds<3>(76, true); }

}  // namespace
}  // namespace cellwalk::test
