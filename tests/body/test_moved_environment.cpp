// SPDX-License-Identifier: LGPL-3.0-or-later
// Environments that are moved with all that lies in them: bodies, particles and locators go on as in one that
// stays where it is.
#include <cellwalk/body/body.h>
#include <cellwalk/environment/compiled.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/map.h>
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/generators/transform.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace cellwalk {
namespace {

template <class E>
concept Has_snapshot = requires(E&& environment) {
  std::forward<E>(environment).snapshot();
};
template <class E>
concept Has_storage = requires(E&& environment) {
  std::forward<E>(environment).storage();
};
// What would not outlive the statement does not compile.
static_assert(Has_snapshot<Environment<3>&> && Has_snapshot<const Environment<2>&>);
static_assert(!Has_snapshot<Environment<3>> && !Has_snapshot<const Environment<2>>);
static_assert(Has_storage<Environment<3>&> && !Has_storage<Environment<3>>);

Environment<3> small_grid(bool keep_map = true) {
  Build_options options;
  options.keep_map = keep_map;
  options.simplicial = true;
  return Environment<3>::build(hex_grid({.cells = {4, 2, 2}}), options);
}

/// An environment that owns what lies in it.
struct Owning_world {
  Environment<3> environment;
  Locator<3> locator;
  Body<3> body;
  Particle<3> particle;

  static Owning_world make(bool keep_map) {
    Environment<3> environment = small_grid(keep_map);
    Locator<3> locator(environment.snapshot());
    Body_placement<3> placement;
    placement.position = {0.5, 0.5, 0.5};
    Body<3> body(environment.snapshot(), locator, transformed(hexahedron_body(0.25, true), placement));
    Particle<3> particle = locator.particle_at({0.5, 0.5, 0.5}).value();
    return {std::move(environment), std::move(locator), std::move(body), particle};
  }

  /// Goes on; returns all that came of it.
  std::vector<std::byte> run(int steps) {
    Body_counts counts;
    Step_report<3> report;
    Walk_counts walks;
    std::vector<Point<3>> targets;
    for (int k = 0; k < steps; ++k) {
      targets.clear();
      for (const Point<3>& x : body.positions()) targets.push_back(x + Vector<3>{0.25, 0.03125, 0.0625});
      body.step(targets, {}, report, counts);
      move(environment.snapshot(), particle, particle.position + Vector<3>{0.25, 0.125, 0}, walks);
      EXPECT_EQ(locator.locate(particle.position).status, Location_status::free);
    }
    body.refresh(counts);
    body.validate();
    std::vector<std::byte> bytes = save(body);
    const auto* const place = reinterpret_cast<const std::byte*>(particle.position.data());
    bytes.insert(bytes.end(), place, place + sizeof particle.position);
    return bytes;
  }
  /// Edits where nothing lies, after which all is registered again.
  void edit() {
    environment.thaw();
    environment.set_impassable(passable_facet(), true);
    body.register_again(locator);
    const Cell far = locator.particle_at({3.25, 1.5, 1.25}).value().cell;
    const auto view = environment.snapshot().view(far);
    Point<3> middle{};
    for (std::size_t v = 0; v < 4; ++v) middle = middle + 0.25 * view.point(v);
    environment.insert_point(far, middle);
    environment.compact();
    locator = Locator<3>(environment.snapshot());
    body.register_again(locator);
    particle = locator.particle_at(particle.position).value();
  }
  Half_facet passable_facet() const {
    const Snapshot<3>& s = environment.snapshot();
    const Cell c = locator.particle_at({3.25, 1.5, 1.25}).value().cell;
    for (std::size_t i = 0; i < s.facet_count(c); ++i)
      if (!s.is_impassable(s.half_facet(c, i))) return s.half_facet(c, i);
    throw Error(Error_code::other, "no facet to close");
  }
};

/// Moves an owner about, in each of several ways.
Owning_world carried_about(Owning_world owner, int way) {
  if (way == 0) return owner;
  if (way == 1) {
    std::vector<Owning_world> all;
    all.push_back(std::move(owner));
    for (int k = 0; k < 20; ++k)
      all.push_back(Owning_world::make(false));  // moves the first one again and again
    return std::move(all.front());
  }
  if (way == 2) {
    Owning_world other = Owning_world::make(true);
    other = std::move(owner);
    return other;
  }
  std::variant<int, Owning_world> held{0};
  held = std::move(owner);
  Owning_world back = std::get<Owning_world>(std::move(held));
  return back;
}

TEST(MovedEnvironment, LetsWhatLiesInItGoOn) {
  int trials = 0;
  for (const bool keep_map : {true, false})
    for (int way = 0; way < 4; ++way)
      for (const int when : {0, 1, 2, 4, 7}) {
        Owning_world stays = Owning_world::make(keep_map), goes = Owning_world::make(keep_map);
        const Snapshot<3>* const place = &goes.environment.snapshot();
        EXPECT_EQ(goes.run(when), stays.run(when));
        goes = carried_about(std::move(goes), way);
        EXPECT_EQ(&goes.environment.snapshot(), place);
        EXPECT_EQ(goes.run(3), stays.run(3));
        goes.edit();
        stays.edit();
        goes = carried_about(std::move(goes), way);
        EXPECT_EQ(goes.run(3), stays.run(3));
        EXPECT_NO_THROW(goes.environment.certify());
        ++trials;
      }
  EXPECT_EQ(trials, 40);
}

TEST(MovedEnvironment, RefusesWhateverIsAskedOfWhatWasMovedFrom) {
  for (const bool keep_map : {true, false}) {
    Environment<3> environment = small_grid(keep_map);
    const Environment<3> other = std::move(environment);
    const std::vector<std::function<void()>> calls{[&] { environment.snapshot(); },
                                                   [&] { environment.storage(); },
                                                   [&] { environment.thaw(); },
                                                   [&] { environment.compact(); },
                                                   [&] { environment.cells_around(0); },
                                                   [&] { environment.soup(); },
                                                   [&] { environment.set_impassable(Half_facet{0}, true); },
                                                   [&] { environment.excavate(Cell{0}); },
                                                   [&] { environment.fill(Cell{0}); },
                                                   [&] {
                                                     environment.move_vertex(0, {0, 0, 0});
                                                   },
                                                   [&] {
                                                     environment.insert_point(Cell{0}, {0.5, 0.5, 0.5});
                                                   },
                                                   [&] { environment.certify(); },
                                                   [&] { check_compiled(environment); },
                                                   [&] { compile_to_bytes(environment, {}, {}); }};
    for (const auto& call : calls) {
      try {
        call();
        ADD_FAILURE() << &call - calls.data();
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), Error_code::usage) << &call - calls.data();
      }
    }
    environment.freeze();
    EXPECT_TRUE(environment.is_frozen());
    environment = small_grid();
    EXPECT_NO_THROW(environment.certify());
  }
}

TEST(OfDimension, ThrowsWhereAVariantWould) {
  std::variant<Environment<2>, Environment<3>> any = small_grid();
  EXPECT_EQ(&of_dimension<3>(any), &std::get<1>(any));
  const auto& constant = any;
  EXPECT_EQ(of_dimension<3>(constant).snapshot().points().size(), 45u);
  try {
    of_dimension<2>(any);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::input);
    EXPECT_EQ(std::string(error.what()),
              "this has dimension 3, where 2 is expected: give one of that dimension");
  }
  EXPECT_THROW(of_dimension<2>(constant), Error);
  EXPECT_THROW(of_dimension<2>(std::move(any)), Error);
  const Environment<3> out = of_dimension<3>(std::move(any));
  EXPECT_EQ(out.snapshot().points().size(), 45u);
}

}  // namespace
}  // namespace cellwalk
