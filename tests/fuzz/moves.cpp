// SPDX-License-Identifier: LGPL-3.0-or-later
// Moves of walls from bytes, in a small world of simplices with particles and bodies in it. Moves that are
// held or only asked for are judged by the oracles of the layer `reshape`; after pushes and stops all that
// lies in the world must be valid, and the environment certified.
#include "fuzz/moves.h"

#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/generators/lattice_world.h>
#include <cellwalk/reshape/reshaping.h>
#include <cellwalk/walk/locate.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "environment/sample_soups.h"
#include "fuzz/decoder.h"
#include "fuzz/move_about.h"
#include "fuzz/targets.h"
#include "reshape/wall_judge.h"

namespace cellwalk::fuzz {
namespace {

constexpr std::size_t most_phases = 3, most_moves = 8, most_edits = 6;

Judged_moves change_totals;

template <int D>
Cell_soup<D> some_soup(Decoder& in) {
  const bool is_grid = in.flag();
  const std::size_t kind = in.below(4);
  if (is_grid && kind < 2) {
    Simplex_grid_options<D> options;
    for (auto& n : options.cells) n = static_cast<std::uint32_t>(1 + in.below(D == 2 ? 3 : 2));
    if constexpr (D == 2)
      return triangle_grid(options);
    else
      return tetrahedral_grid(options);
  }
  if (is_grid) {
    auto options = mixed_lattice_world<D>(in.byte());
    options.cells = Grid_options<D>::filled(2);
    return lattice_world(options);
  }
  if constexpr (D == 2) {
    if (kind == 0) return test::pinched_squares();
    if (kind == 1) return test::collinear_polygon();
    return square_grid({.cells = {3, 2}, .solid_cells = {1}});
  } else {
    if (kind == 0) return test::pinched_tetrahedra();
    if (kind == 1) return hex_grid({.cells = {2, 2, 1}, .solid_cells = {0}});
    return hex_grid({.cells = {2, 1, 1}});
  }
}

/// As the oracles know a world.
template <int D>
class Moved_world {
 public:
  explicit Moved_world(Decoder& in)
      : environment(Environment<D>::build(some_soup<D>(in),
                                          {.duplicates = Duplicate_vertices::keep, .simplicial = true})),
        snapshot(environment.snapshot()) {
    for (std::size_t n = in.below(most_edits); n > 0; --n) edit(in);
    const Locator<D> locator(snapshot);
    for (std::size_t n = in.below(4); n > 0; --n) {
      const auto sides = locator.particles_at(some_point(snapshot, in));
      if (!sides.empty()) particles.push_back(sides[in.below(sides.size())]);
    }
    for (std::size_t n = in.below(4); n > 0; --n) add_body(locator, in);
  }
  Moved_world(const Moved_world&) = delete;

  Residents<D> residents() {
    Residents<D> result;
    for (const auto& body : bodies) result.bodies.push_back(body.get());
    result.particles = {std::span(particles)};
    return result;
  }

  /// What must hold whatever was moved.
  void demand_sound() const {
    environment.certify();  // an Error here is none of a move: it leaves the target
    for (const auto& body : bodies) body->validate();
    for (const Particle<D>& p : particles)
      demand(!snapshot.is_solid(p.cell) && in_closure(snapshot, p.cell, p.position),
             "a particle is not in its cell");
  }

  Environment<D> environment;
  const Snapshot<D>& snapshot;
  std::vector<Particle<D>> particles;
  std::vector<std::unique_ptr<Body<D>>> bodies;

 private:
  /// A wall made or opened, or a vertex moved.
  void edit(Decoder& in) {
    if (in.flag()) {
      const Half_facet facet{static_cast<std::uint32_t>(in.below(snapshot.half_facet_slots()))};
      reads([&] { environment.set_impassable(facet, in.flag()); },
            {Error_code::usage, Error_code::not_certified});
    } else {
      const auto point = static_cast<std::uint32_t>(in.below(snapshot.points().size()));
      const Point<D> position = some_point(snapshot, in);
      reads([&] { environment.move_vertex(point, position); }, {Error_code::not_certified});
    }
  }

  /// A path of two to four vertices, with a face of its first three in half of the cases; none where it would
  /// cross a wall.
  void add_body(const Locator<D>& locator, Decoder& in) {
    Body_soup<D> soup;
    const std::size_t shape = in.byte(), n = 2 + shape % 3;
    for (std::uint32_t i = 0; i < n; ++i) {
      soup.points.push_back(some_point(snapshot, in));
      if (i > 0) soup.edges.push_back({i - 1, i});
    }
    if (D == 3 && n > 2 && shape / 3 % 2 == 0) {
      soup.edges.insert(soup.edges.begin() + 1, {0, 2});
      soup.faces.push_back({0, 1, 2});
    }
    reads([&] { bodies.push_back(std::make_unique<Body<D>>(snapshot, locator, soup)); },
          {Error_code::input, Error_code::outside});
  }
};

template <int D>
class Moving {
 public:
  explicit Moving(Decoder& in) : in_(in), world_(in) {}

  void run() {
    for (std::size_t i = 0; i < most_phases && !in_.is_empty(); ++i) {
      phase();
      world_.demand_sound();
    }
  }

 private:
  void phase() {
    const std::uint8_t kind = in_.byte();
    constexpr std::array rules{At_contact::hold, At_contact::hold, At_contact::stop, At_contact::push};
    const At_contact rule = rules[kind % 4];
    Reshaping<D> reshaping(world_.environment, world_.residents(), {.at_contact = rule});
    for (std::size_t i = 0; i < most_moves && !in_.is_empty(); ++i) {
      const auto vertex = static_cast<std::uint32_t>(in_.below(world_.snapshot.points().size()));
      const Point<D> target = some_point(world_.snapshot, in_);
      // Whatever is done then, the question is judged.
      if (rule == At_contact::hold)
        judge_.judge(reshaping, vertex, target, kind / 4 % 2 == 1);
      else
        move(reshaping, vertex, target);
      demand(tally_.wrong() == 0, fault());
    }
    reshaping.finish();
    change_totals.pushed += reshaping.counts().pushes;
    count();
  }

  /// A move with a stop or with pushes.
  void move(Reshaping<D>& reshaping, std::uint32_t vertex, const Point<D>& target) {
    const Point<D> from = world_.snapshot.point(vertex);
    judge_.judge(reshaping, vertex, target, true);
    const Vertex_result<D> asked = reshaping.test_move(vertex, target);
    const Vertex_result<D> result = reshaping.move(vertex, target);
    demand(world_.snapshot.point(vertex) == result.position, "a vertex is not where its result says");
    demand(asked.end != Move_end::reached || result.end == Move_end::reached,
           "a vertex stops where it was said to be free");
    demand(result.end != Move_end::reached || result.position == target, "a vertex arrives elsewhere");
    const bool is_refused = result.end == Move_end::cell || result.end == Move_end::boundary;
    demand(!is_refused || result.position == from, "a vertex moves although a cell would be wrong");
    change_totals.stopped += result.end == Move_end::contact && result.position != from;
  }

  void count() {
    change_totals.moves += static_cast<std::size_t>(tally_.moves);
    change_totals.reached += static_cast<std::size_t>(tally_.reached);
    change_totals.touching += static_cast<std::size_t>(tally_.free_touching);
    change_totals.contacts += static_cast<std::size_t>(tally_.contacts);
    tally_ = {};
  }

  std::string fault() const {
    const auto& t = tally_;
    const test::Fate_tally& f = t.fates;
    std::string text = "a move of a wall is";
    const auto add = [&text](int count, const char* what) {
      if (count != 0) text += std::string(" ") + what;
    };
    add(t.missed + f.missed, "missed");
    add(t.false_blocks + f.false_blocks, "blocked by nothing");
    add(t.wrong_times + f.wrong_times, "blocked at a wrong time");
    add(t.wrong_sides + f.wrong_registrations, "registered on a wrong side");
    add(t.wrong_ends, "ended wrongly");
    add(t.tunnels, "the boundary passed through itself");
    return text;
  }

  Decoder& in_;
  Moved_world<D> world_;
  typename test::Wall_judge<D, Moved_world<D>>::Tally tally_;
  test::Wall_judge<D, Moved_world<D>> judge_{world_, tally_};
};

}  // namespace

const Judged_moves& judged_moves() { return change_totals; }

void moves(std::string_view bytes) {
  Decoder in(bytes);
  if (in.flag())
    Moving<3>(in).run();
  else
    Moving<2>(in).run();
}

}  // namespace cellwalk::fuzz
