// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies made up at random in the worlds of the oracle, what they are asked, and how answers differ.
#ifndef CELLWALK_TESTS_BODY_RANDOM_BODIES_H
#define CELLWALK_TESTS_BODY_RANDOM_BODIES_H

#include <cellwalk/body/body.h>
#include <cellwalk/edge/contact_search.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "walk/oracle_worlds.h"

namespace cellwalk::test {

/// What a call answered.
template <int D>
struct Answer {
  Step_report<D> report;
  std::optional<Error_code> error;
};

/// In what two answers differ; nothing if they do not. Where a wall is met by more than one of its facets,
/// the facet may differ.
template <int D>
std::string difference(const Answer<D>& a, const Answer<D>& b) {
  if (a.error != b.error) return "an error";
  const auto &of_a = a.report.contacts, &of_b = b.report.contacts;
  if (of_a.size() != of_b.size()) return "the number of contacts";
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    const Contact<D>&x = of_a[i], &y = of_b[i];
    if (x.vertex != y.vertex) return "the vertex of a contact";
    if (x.exact_time() != y.exact_time()) return "the time of a contact";
    if (x.point != y.point || x.normal != y.normal) return "the place or the normal of a contact";
    if (x.body != y.body || x.kind != y.kind || x.feature != y.feature) return "the feature of a contact";
  }
  const auto equal = [](const Rejected_move<D>& x, const Rejected_move<D>& y) {
    return x.vertex == y.vertex && x.is_vertex_blocked == y.is_vertex_blocked && x.edges == y.edges &&
           x.swept_edges == y.swept_edges;
  };
  if (!std::ranges::equal(a.report.blocked, b.report.blocked, equal)) return "what blocks";
  return {};
}

/// Something that is asked of a body.
template <int D>
struct Call {
  enum class Kind { step, step_at_target, move_vertex };

  Kind kind = Kind::step;
  std::vector<Point<D>> targets;
  std::uint32_t vertex = 0;
  Body_options options;

  Answer<D> ask(Body<D>& body, const Body_options& by, Body_counts& counts) const {
    Answer<D> answer;
    try {
      if (kind != Kind::move_vertex)
        body.step(targets, by, answer.report, counts);
      else if (auto contact = body.move_vertex(vertex, targets[vertex], by, counts))
        answer.report.contacts.push_back(*contact);
    } catch (const Error& error) {
      answer.error = error.code();
    }
    return answer;
  }
};

enum class Body_kind {
  simplex,
  simplices,  ///< many, which no edge joins
  rod,        ///< as long as free space allows, with bends where it does not
  block       ///< a small grid of vertices
};

/// Makes bodies, and calls of them.
template <int D>
class Random_bodies {
 public:
  /// \param generic in general position; else mostly in degenerate ones
  Random_bodies(const oracle::World<D>& world, const Snapshot<D>& snapshot, std::uint64_t seed, bool generic)
      : world_(world), snapshot_(snapshot), source_(world, seed), generic_(generic) {
    const auto kind_of_world = seed % oracle::world_kinds;
    has_slits_ = kind_of_world == 9 || kind_of_world == 10 || kind_of_world >= 12;
  }

  Random& random() { return source_.random(); }
  bool is_generic() const { return generic_; }

  Body_soup<D> make(Body_kind kind, const Locator<D>& locator) {
    Body_soup<D> soup = kind == Body_kind::simplex     ? simplex()
                        : kind == Body_kind::simplices ? simplices(locator)
                        : kind == Body_kind::rod       ? rod(locator)
                                                       : block();
    std::ranges::sort(soup.edges);
    return soup;
  }

  /// \param number of the call: what is reported depends on it
  Call<D> call(std::span<const Point<D>> positions, std::size_t number) {
    Call<D> call;
    call.targets = targets(positions);
    call.vertex = static_cast<std::uint32_t>(random().below(positions.size()));
    const auto which = random().below(4);
    call.kind = which < 2    ? Call<D>::Kind::step
                : which == 2 ? Call<D>::Kind::step_at_target
                             : Call<D>::Kind::move_vertex;
    Body_options& options = call.options;
    const auto sweep = random().below(3);
    options.sweep.sweep = sweep == 0                 ? Sweep::three_segments
                          : sweep == 1 || has_slits_ ? Sweep::triangle  // no faces are swept among slits
                                                     : Sweep::faces;
    if (random().below(3) == 0) options.rule = Step_rule::reject;
    if (random().below(4) == 0) options.sweep.touch = Touch::stop;
    if (random().below(6) == 0) options.sweep.search = &searches[random().below(2)];
    options.most_contacts = 1 + static_cast<int>(random().below(4));
    if (call.kind == Call<D>::Kind::step_at_target) {
      options.rule = Step_rule::reject_at_target;
      options.reports_blocked = number % 2 != 0;
    }
    return call;
  }

 private:
  static constexpr std::array<Search_options, 2> searches{
      {{Contact_search::dichotomic}, {Contact_search::exhaustive}}};
  static constexpr int many = 12;                   ///< simplices
  static constexpr std::uint32_t most_of_rod = 48;  ///< vertices
  static constexpr std::uint32_t side_of_block = D == 2 ? 6 : 4;

  double eighths(int most) { return (static_cast<double>(random().below(2 * most + 1)) - most) / 8; }

  oracle::Motion_kind kind() {
    using oracle::Motion_kind;
    for (;;) {
      const Motion_kind kind = source_.kind(generic_);
      if (kind != Motion_kind::in_wall_plane && kind != Motion_kind::along_edge) return kind;
    }
  }

  double cell_size() const {
    const auto loop = world_.soup.facet(0);
    return length(world_.soup.points[loop[1]] - world_.soup.points[loop[0]]);
  }

  /// Up to a size along each axis.
  Vector<D> any_path(double size) {
    Vector<D> way;
    for (double& x : way) x = size * (generic_ ? random().real(-1, 1) : eighths(8));
    return way;
  }

  /// Small, or with corners anywhere.
  Body_soup<D> simplex() {
    Body_soup<D> soup;
    const oracle::Motion_kind of_start = kind();
    const Point<D> first = source_.start(of_start);
    const bool small = random().below(2) == 0;
    for (std::uint32_t v = 0; v <= D; ++v) {
      Point<D> x = v == 0 ? first : source_.target(of_start, first, first);
      if (small && v > 0) x = first + any_path(cell_size() / 4);
      soup.points.push_back(x);
      for (std::uint32_t w = v + 1; w <= D; ++w) soup.edges.push_back({v, w});
    }
    if (D == 3) soup.faces = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
    return soup;
  }

  /// Those that have room, if they are soon found.
  Body_soup<D> simplices(const Locator<D>& locator) {
    Body_soup<D> soup;
    for (int k = 0; k < many; ++k) {
      Body_soup<D> one = simplex();
      for (int tried = 0; tried < 20 && !has_room(one, locator); ++tried) one = simplex();
      const auto first = static_cast<std::uint32_t>(soup.points.size());
      soup.points.insert(soup.points.end(), one.points.begin(), one.points.end());
      for (const auto& [u, v] : one.edges) soup.edges.push_back({first + u, first + v});
      for (const auto& [u, v, w] : one.faces) soup.faces.push_back({first + u, first + v, first + w});
    }
    return soup;
  }

  bool has_room(const Body_soup<D>& soup, const Locator<D>& locator) const {
    try {
      Body<D>(snapshot_, locator, soup);
    } catch (const Error&) {
      return false;
    }
    return true;
  }

  Body_soup<D> rod(const Locator<D>& locator) {
    Body_soup<D> soup;
    Particle<D> p;
    while (p.cell == Cell::none) p = locator.particle_at(source_.start(kind())).value_or(Particle<D>{});
    const double spacing = cell_size() / static_cast<double>(4 << random().below(3));
    Vector<D> way = any_path(spacing);
    Walk_counts counts;
    for (std::uint32_t v = 0; v < most_of_rod; ++v) {
      soup.points.push_back(p.position);
      if (v > 0) soup.edges.push_back({v - 1, v});
      for (int tried = 0; tried < 20; ++tried) {
        if (tried > 0 || random().below(8) == 0) way = any_path(spacing);
        if (way != Vector<D>{} && move(snapshot_, p, p.position + way, counts).status == Walk_status::arrived)
          break;
      }
    }
    return soup;
  }

  Body_soup<D> block() {
    constexpr std::uint32_t n = side_of_block, layers = D == 2 ? 1 : n;
    Body_soup<D> soup;
    const Point<D> corner = source_.start(kind());
    const double spacing = cell_size() / static_cast<double>(8 << random().below(3));
    for (std::uint32_t v = 0; v < n * n * layers; ++v) {
      const std::uint32_t place[] = {v % n, v / n % n, v / (n * n)};
      Point<D> x = corner;
      for (std::size_t k = 0; k < D; ++k) x[k] += spacing * place[k];
      soup.points.push_back(x);
      for (std::uint32_t k = 0, before = 1; k < D; ++k, before *= n)
        if (place[k] > 0) soup.edges.push_back({v - before, v});
    }
    return soup;
  }

  /// All vertices a little the same way, or each to where the next one is, or some of them anywhere.
  std::vector<Point<D>> targets(std::span<const Point<D>> positions) {
    std::vector<Point<D>> result(positions.begin(), positions.end());
    const auto which = random().below(6);
    if (which < 3) {
      if (random().below(4) == 0)
        for (double& x : drift_) x = cell_size() * (generic_ ? random().real(-0.2, 0.2) : eighths(2));
      for (Point<D>& x : result) x = x + drift_;
      return result;
    }
    if (which == 3) {
      std::shift_left(result.begin(), result.end(), 1);
      result.back() = result.back() + any_path(cell_size() / 4);
      return result;
    }
    for (Point<D>& x : result)
      if (random().below(2) == 0) x = source_.target(kind(), x, x);
    return result;
  }

  const oracle::World<D>& world_;
  const Snapshot<D>& snapshot_;
  oracle::Motion_source<D> source_;
  const bool generic_;
  bool has_slits_ = false;
  Vector<D> drift_{};
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_BODY_RANDOM_BODIES_H
