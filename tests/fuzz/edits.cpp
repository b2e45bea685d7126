// SPDX-License-Identifier: LGPL-3.0-or-later
// Edits from bytes. After each, map and snapshot must be valid and in step, the snapshot what compiling from
// scratch gives, and certification from scratch of the same mind; particles must not pass walls, be they
// registered before the edit or after it.
#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/map.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/walk/locate.h>
#include <cellwalk/walk/walk.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "environment/sample_soups.h"
#include "fuzz/decoder.h"
#include "fuzz/move_about.h"
#include "fuzz/targets.h"

namespace cellwalk::fuzz {
namespace {

constexpr std::size_t most_edits = 12, most_cells = 150;

Environment<2> small_environment_2(Decoder& in) {
  switch (in.below(5)) {
    case 0:
      return Environment<2>::build(square_grid({.cells = {2, 2}}));
    case 1:
      return Environment<2>::build(triangle_grid({.cells = {2, 2}}));
    case 2:
      return Environment<2>::build(test::pinched_squares());
    case 3:
      return Environment<2>::build(test::collinear_polygon());
    default:
      return Environment<2>::build(square_grid({.cells = {3, 2}, .solid_cells = {1}}));
  }
}

Environment<3> small_environment_3(Decoder& in) {
  Cell_soup<3> soup;
  switch (in.below(6)) {
    case 0:
      return Environment<3>::build(hex_grid({.cells = {2, 1, 1}}));
    case 1:
      return Environment<3>::build(tetrahedral_grid({.cells = {1, 1, 1}}));
    case 2:
      return Environment<3>::build(test::pinched_tetrahedra());
    case 3:
      soup.points = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 2}};
      add_pyramid(soup, {0, 1, 2, 3, 4});
      return Environment<3>::build(soup);
    case 4:
      soup.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {0, 2, 2}, {0, 0, -1}};
      add_prism(soup, {0, 1, 2, 3, 4, 5});
      add_tetrahedron(soup, 6, 1, 2, 0);
      return Environment<3>::build(soup, {.split = false});
    default:
      return Environment<3>::build(hex_grid({.cells = {2, 2, 1}, .solid_cells = {0}}));
  }
}

template <int D>
Environment<D> small_environment(Decoder& in) {
  if constexpr (D == 2)
    return small_environment_2(in);
  else
    return small_environment_3(in);
}

/// All that a snapshot says of its facets but for the order of its own arrays.
template <int D>
auto facets_of(const Snapshot<D>& snapshot) {
  std::set<std::tuple<std::uint32_t, bool, std::vector<std::uint32_t>, std::uint32_t, bool>> facets;
  for (std::uint32_t i = 0; i < snapshot.cell_count(); ++i) {
    const Cell c = snapshot.cell(i);
    demand(snapshot.index(c) == i, "a cell has another index than its own");
    for (std::size_t k = 0; k < snapshot.facet_count(c); ++k) {
      const Half_facet f = snapshot.half_facet(c, k);
      auto loop = snapshot.loop(f);
      if (D == 3) std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
      const Cell neighbour = snapshot.neighbour(f);
      facets.emplace(i, snapshot.is_solid(c), loop,
                     neighbour == Cell::none ? no_facet : snapshot.index(neighbour),
                     snapshot.is_impassable(f));
    }
  }
  return facets;
}

template <int D>
void demand_sound(const Environment<D>& environment) {
  demand(environment.storage().map.is_valid(), "the map is not valid");
  environment.certify();  // an Error here is none of an edit: it leaves the target
  const Cell_soup<D> soup = environment.soup();
  demand(facets_of(environment.snapshot()) == facets_of(Snapshot<D>::compile(soup, glue(soup))),
         "the snapshot is not what compiling from scratch gives");
}

/// True if certification from scratch takes the environment with a point elsewhere.
template <int D>
bool is_certified(Cell_soup<D> soup, std::uint32_t point, const Point<D>& position) {
  soup.points[point] = position;
  return reads([&] { certify(Snapshot<D>::compile(soup, glue(soup))); }, {Error_code::not_certified});
}

template <int D>
class Editing {
 public:
  explicit Editing(Decoder& in) : in_(in), environment_(small_environment<D>(in)) {}

  void run() {
    for (std::size_t i = 0; i < most_edits && !in_.is_empty(); ++i) {
      const std::uint8_t kind = in_.byte();
      if (kind % 5 == 3) {
        keep_particle();
        continue;
      }
      if (kind % 5 == 4) {
        move_about(snapshot(), environment_.soup(), in_, 1);
        continue;
      }
      replaced_ = Cell::none;
      const Cell_soup<D> before = environment_.soup();
      const bool done = kind % 5 == 0 ? wall() : kind % 5 == 1 ? move() : insert();
      if (!done) {
        const Cell_soup<D> after = environment_.soup();
        demand(before.points == after.points && before.vertices == after.vertices &&
                   before.impassable == after.impassable,
               "an edit that is refused changes something");
      }
      demand_sound(environment_);
      walk_kept_particle();
    }
    move_about(snapshot(), environment_.soup(), in_, 3);
  }

 private:
  const Snapshot<D>& snapshot() const { return environment_.snapshot(); }

  bool wall() {
    const Half_facet facet{static_cast<std::uint32_t>(in_.below(snapshot().half_facet_slots() + 1))};
    const bool is_wall = in_.flag();
    const bool done = reads([&] { environment_.set_impassable(facet, is_wall); },
                            {Error_code::usage, Error_code::not_certified});
    if (done) demand(snapshot().is_impassable(facet) == is_wall, "a wall is not what it was made");
    return done;
  }

  bool move() {
    const auto point = static_cast<std::uint32_t>(in_.below(snapshot().points().size()));
    const Point<D> position = some_point(snapshot(), in_);
    const bool certified = is_certified(environment_.soup(), point, position);
    const bool done = reads([&] { environment_.move_vertex(point, position); }, {Error_code::not_certified});
    demand(done == certified,
           certified ? "a vertex may not move where it could" : "a vertex moves where it makes cells wrong");
    demand(!done || snapshot().point(point) == position, "a vertex is not where it was moved");
    return done;
  }

  bool insert() {
    if (snapshot().cell_count() > most_cells) return false;
    // A name of a cell, or of none.
    const bool is_named = in_.byte() % 8 != 7;
    const Cell cell =
        is_named ? snapshot().cell(in_.below(snapshot().cell_count()))
                 : Cell{static_cast<std::uint32_t>(in_.below(snapshot().half_facet_slots() / 4 + 1))};
    const Point<D> position = some_point(snapshot(), in_);
    const bool done = reads(
        [&] {
          for (const Cell added : environment_.insert_point(cell, position))
            demand(in_closure(snapshot(), added, position), "a new cell does not have the new point");
        },
        {Error_code::usage, Error_code::not_certified});
    if (done) replaced_ = cell;
    return done;
  }

  void keep_particle() {
    const Point<D> x = some_point(snapshot(), in_);
    const Location<D> here = Locator<D>(snapshot()).locate(x);
    if (here.status != Location_status::free) return;
    kept_ = Particle<D>{x, here.cells[in_.below(here.cells.size())], here.dimension, 0};
    target_ = some_point(snapshot(), in_);
  }

  /// A particle that was registered before an edit is refused, or goes where one that is registered now can
  /// go. It is not asked for where its cell moved away from it: then it is to be located again.
  void walk_kept_particle() {
    if (!kept_) return;
    const bool is_in_its_cell = in_closure(snapshot(), kept_->cell, kept_->position);
    if (is_in_its_cell || kept_->cell == replaced_) demand_no_wall_passed();
    if (!is_in_its_cell) kept_.reset();
  }

  void demand_no_wall_passed() {
    Walk_counts counts;
    Walk_result<D> result;
    Particle<D> particle = *kept_;
    if (!reads([&] { result = cellwalk::move(snapshot(), particle, target_, counts); }, {Error_code::usage}))
      return;
    if (result.status != Walk_status::arrived) return;
    bool can = false;
    for (const Cell cell : Locator<D>(snapshot()).locate(kept_->position).cells) {
      const auto now = walk(snapshot(), Particle<D>{kept_->position, cell, D, 0}, target_, counts);
      can |= now.status == Walk_status::arrived;
    }
    demand(can, "a particle that was registered before an edit passes a wall");
  }

  Decoder& in_;
  Environment<D> environment_;
  std::optional<Particle<D>> kept_;
  Point<D> target_{};
  Cell replaced_ = Cell::none;  ///< by the last edit
};

}  // namespace

void edits(std::string_view bytes) {
  Decoder in(bytes);
  if (in.flag())
    Editing<3>(in).run();
  else
    Editing<2>(in).run();
}

}  // namespace cellwalk::fuzz
