// SPDX-License-Identifier: LGPL-3.0-or-later
// Environments that are written as bytes and opened again: the same to the bit, with all names; and bytes
// that are damaged, with and without checksums that fit.
#include <cellwalk/environment/compiled.h>
#include <cellwalk/environment/map.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/generators/lattice_world.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "environment/images.h"
#include "environment/sample_soups.h"
#include "environment/snapshot_checks.h"

namespace cellwalk {
namespace {

using Bytes = std::vector<std::byte>;

template <int D>
Bytes bytes_of(const Environment<D>& environment, const Groups<D>& groups = {}) {
  return compile_to_bytes<D>(environment, environment.certify(), groups);
}

template <int D>
Compiled_environment<D> opened(const Bytes& bytes) {
  return std::get<Compiled_environment<D>>(open_compiled_copy(bytes));
}

/// Edits drawn at random, most of which are made.
template <int D>
std::size_t edit(Environment<D>& environment, std::uint64_t seed, int edits) {
  Random random(seed);
  const Snapshot<D>& snapshot = environment.snapshot();
  std::size_t made = 0;
  for (int i = 0; i < edits; ++i) {
    const Cell cell = snapshot.cell(random.below(snapshot.cell_slots()));
    const auto kind = random.below(5);
    if (cell == Cell::none) continue;
    const Half_facet facet = Snapshot<D>::half_facet(cell, random.below(snapshot.facet_count(cell)));
    const Point<D> middle = test::mean_of_vertices<D>(snapshot.view(cell));
    const std::uint32_t point = snapshot.view(cell).point_index(0);
    try {
      if (kind == 0) environment.set_impassable(facet, !snapshot.is_impassable(facet));
      if (kind == 1) environment.insert_point(cell, middle);
      if (kind == 2) environment.fill(cell);
      if (kind == 3) environment.excavate(cell);
      if (kind == 4)
        environment.move_vertex(point, snapshot.point(point) + 0.0625 * (middle - snapshot.point(point)));
      ++made;
    } catch (const Error&) {  // not all are possible
    }
  }
  return made;
}

template <int D>
void expect_round_trip(const Environment<D>& environment, const Groups<D>& groups = {}) {
  const Certificate certificate = environment.certify();
  const Bytes bytes = compile_to_bytes<D>(environment, certificate, groups);
  Compiled_environment<D> again = opened<D>(bytes);
  EXPECT_TRUE(again.environment.is_frozen());
  EXPECT_EQ(compile_to_bytes<D>(again.environment, again.certificate, again.groups), bytes)
      << "all of it is the same";
  const Snapshot<D>&a = environment.snapshot(), &b = again.environment.snapshot();
  EXPECT_EQ(b.epoch(), a.epoch());
  ASSERT_EQ(b.cell_slots(), a.cell_slots());
  for (std::size_t i = 0; i < a.cell_slots(); ++i) EXPECT_EQ(b.cell(i), a.cell(i));
  const Certificate anew = again.environment.certify();
  EXPECT_EQ(anew.cells, certificate.cells);
  EXPECT_EQ(anew.walls, certificate.walls);
  EXPECT_EQ(anew.free_volume, certificate.free_volume);
  EXPECT_NO_THROW(check_compiled(again.environment));
}

template <int D>
void expect_samples_open() {
  for (auto& [name, soup] : test::sample_soups<D>()) {
    SCOPED_TRACE(name);
    Environment<D> environment = Environment<D>::build(soup);
    expect_round_trip(environment);
    EXPECT_GT(edit(environment, 3, 30), 5u);
    expect_round_trip(environment);
  }
}

TEST(Compiled, OpensAsItWasWritten2) { expect_samples_open<2>(); }
TEST(Compiled, OpensAsItWasWritten3) { expect_samples_open<3>(); }

TEST(Compiled, KeepsSlits) {
  Lattice_world_options<3> options = mixed_lattice_world<3>(5);
  options.slit_share = 0.1;
  const auto environment =
      Environment<3>::build(lattice_world(options), {.duplicates = Duplicate_vertices::keep});
  expect_round_trip(environment);
}

TEST(Compiled, KeepsGroups) {
  const auto environment = Environment<3>::build(hex_grid({.cells = {3, 2, 2}}));
  const Snapshot<3>& snapshot = environment.snapshot();
  Groups<3> groups;
  groups["a valve"].facets = {Snapshot<3>::half_facet(snapshot.cell(2), 4)};
  groups["empty"];
  groups["tissue"].cells = {snapshot.cell(0), snapshot.cell(7)};
  expect_round_trip(environment, groups);
  const Groups<3> again = opened<3>(bytes_of(environment, groups)).groups;
  ASSERT_EQ(again.size(), 3u);
  EXPECT_EQ(again.at("a valve").facets, groups["a valve"].facets);
  EXPECT_TRUE(again.at("empty").facets.empty() && again.at("empty").cells.empty());
  EXPECT_EQ(again.at("tissue").cells, groups["tissue"].cells);
}

/// An environment that is opened and thawed goes on as that which was never closed.
template <int D>
void expect_same_future() {
  std::size_t made = 0;
  for (auto& [name, soup] : test::sample_soups<D>()) {
    SCOPED_TRACE(name);
    Environment<D> kept = Environment<D>::build(soup);
    edit(kept, 7, 20);
    Compiled_environment<D> again = opened<D>(bytes_of(kept));
    again.environment.thaw();
    EXPECT_NO_THROW(again.environment.certify());
    for (std::uint64_t seed = 10; seed < 13; ++seed) {
      const std::size_t own = edit(kept, seed, 20);
      EXPECT_EQ(edit(again.environment, seed, 20), own);
      made += own;
      EXPECT_EQ(bytes_of(again.environment), bytes_of(kept));
    }
  }
  EXPECT_GT(made, 50u);
}

TEST(Compiled, GoesOnAsIfItHadNeverBeenClosed2) { expect_same_future<2>(); }
TEST(Compiled, GoesOnAsIfItHadNeverBeenClosed3) { expect_same_future<3>(); }

/// What refuses an image; empty if it is taken.
std::string refusal(const Bytes& bytes, Error_code code = Error_code::input) {
  try {
    open_compiled_copy(bytes);
    return {};
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
}

Bytes small_image() { return bytes_of(Environment<3>::build(hex_grid({.cells = {2, 1, 1}}))); }

TEST(Compiled, EachByteThatIsFlippedIsFound) {
  Bytes bytes = small_image();
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] ^= std::byte{1};
    EXPECT_NE(refusal(bytes), "") << "byte " << i;
    bytes[i] ^= std::byte{1};
  }
  EXPECT_EQ(refusal(bytes), "");
}

TEST(Compiled, WhatIsCutShortIsFound) {
  const Bytes bytes = small_image();
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_NE(refusal(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size))), "") << size;
  Bytes longer = bytes;
  longer.push_back({});
  EXPECT_NE(refusal(longer).find("more follows its end"), std::string::npos);
}

/// An image with another header.
Bytes with_header(const std::function<void(detail::Image_header&)>& change) {
  Bytes bytes = small_image();
  detail::Image_header header;
  std::memcpy(&header, bytes.data(), sizeof header);
  change(header);
  std::memcpy(bytes.data(), &header, sizeof header);
  test::seal(bytes);
  return bytes;
}

TEST(Compiled, OtherVersionsAndMachinesAreNamed) {
  EXPECT_NE(refusal(with_header([](auto& header) { header.version = 7; })).find("version 7 of the format"),
            std::string::npos);
  EXPECT_NE(
      refusal(with_header([](auto& header) { header.byte_order = 0x04030201; })).find("another byte order"),
      std::string::npos);
  EXPECT_NE(refusal(with_header([](auto& header) { header.dimension = 4; })).find("dimensions"),
            std::string::npos);
  EXPECT_NE(refusal(with_header([](auto& header) { header.magic[0] = 'c'; })).find("no compiled environment"),
            std::string::npos);
}

TEST(Compiled, BytesMustBeAligned) {
  alignas(64) std::array<std::byte, 128> bytes{};
  EXPECT_THROW(open_compiled({std::span(bytes).subspan(8), {}}), Error);
}

/// Words of an image are changed, with checksums that fit: it is refused, or all that it refers to is there.
template <int D>
void expect_damage_is_harmless(std::uint64_t seed) {
  Lattice_world_options<D> options = mixed_lattice_world<D>(seed);
  options.cells.fill(2);
  auto environment = Environment<D>::build(lattice_world(options));
  edit(environment, seed, 20);
  Groups<D> groups;
  groups["cells"].cells = {environment.snapshot().cell(0)};
  groups["facets"].facets = {Half_facet{4 * to_index(environment.snapshot().cell(0))}};
  const Bytes bytes = bytes_of(environment, groups);
  Random random(seed);
  std::set<std::string> reasons;
  std::size_t taken = 0, uncertified = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    Bytes damaged = bytes;
    const auto table = test::table_of(damaged);
    const auto& section = table[random.below(table.size())];
    if (section.bytes < 4) continue;
    const std::size_t at = section.offset + 2 * random.below(section.bytes / 2);
    const std::uint32_t values[]{0,
                                 1,
                                 0xffffffffu,
                                 0x40000000u,
                                 static_cast<std::uint32_t>(random.below(64)),
                                 static_cast<std::uint32_t>(random.below(0xffffffff))};
    const std::uint32_t value = values[random.below(std::size(values))];
    std::memcpy(damaged.data() + at, &value, std::min<std::size_t>(4, section.offset + section.bytes - at));
    test::seal(damaged);
    if (const std::string reason = refusal(damaged); !reason.empty()) {
      reasons.insert(reason);
      continue;
    }
    ++taken;
    Compiled_environment<D> again = opened<D>(damaged);
    again.environment.soup();
    try {
      again.environment.thaw();
      again.environment.certify();
      check_compiled(again.environment);
    } catch (const Error& error) {
      EXPECT_TRUE(error.code() == Error_code::not_certified || error.code() == Error_code::input)
          << error.what();
      ++uncertified;
    }
  }
  EXPECT_GT(reasons.size(), 8u);
  EXPECT_GT(taken, 100u);
  EXPECT_GT(uncertified, 20u);
}

TEST(Compiled, DamageWithChecksumsThatFitIsHarmless2) { expect_damage_is_harmless<2>(1); }
TEST(Compiled, DamageWithChecksumsThatFitIsHarmless3) { expect_damage_is_harmless<3>(2); }

TEST(Compiled, PlanesOfOthersAreFound) {
  Bytes bytes = bytes_of(Environment<3>::build(tetrahedral_grid({.cells = {2, 2, 2}})));
  EXPECT_NO_THROW(check_compiled(opened<3>(bytes).environment));
  const auto planes = test::section_of(bytes, "planes");
  planes[7] ^= std::byte{0x10};
  test::seal(bytes);
  try {
    check_compiled(opened<3>(bytes).environment);
    ADD_FAILURE() << "the plane was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::not_certified);
    EXPECT_NE(std::string(error.what()).find("has planes that are not its own"), std::string::npos);
  }
}

TEST(Compiled, PlanesWithoutAFacetAreRefused) {
  // A triangle of the plane has one lane of four to spare.
  Bytes bytes = bytes_of(Environment<2>::build(triangle_grid({.cells = {2, 2}})));
  constexpr std::size_t lane = 3, lanes = 4;
  for (const std::size_t row : {0u, 1u, 2u}) {  // two of the normal, and the offset
    Bytes other = bytes;
    float value = 0;
    std::byte* const at = test::section_of(other, "planes").data() + (lanes * row + lane) * sizeof value;
    std::memcpy(&value, at, sizeof value);
    EXPECT_EQ(value, row == 2 ? -1 : 0);
    value += 0.5F;
    std::memcpy(at, &value, sizeof value);
    test::seal(other);
    EXPECT_NE(refusal(other).find("a plane belongs to no facet"), std::string::npos);
  }
}

TEST(Compiled, FramesInWhichNoBoundHoldsAreRefused) {
  const Bytes bytes = bytes_of(Environment<3>::build(tetrahedral_grid({.cells = {2, 2, 2}})));
  constexpr double not_finite = std::numeric_limits<double>::infinity();
  for (const auto& [place, value] :
       {std::pair{0, not_finite}, {3, not_finite}, {3, 0.0}, {3, 0.3}, {3, -0.5}}) {
    Bytes other = bytes;
    std::memcpy(test::section_of(other, "state").data() + 8 * place, &value, sizeof value);
    test::seal(other);
    try {
      opened<3>(other);
      ADD_FAILURE() << value << " was taken at " << place;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("its frame is none"), std::string::npos) << error.what();
    }
  }
}

TEST(Compiled, PointsOutsideTheFrameAreRefused) {
  Bytes other = bytes_of(Environment<3>::build(tetrahedral_grid({.cells = {2, 2, 2}})));
  constexpr double centre = 4.5;
  std::memcpy(test::section_of(other, "state").data() + sizeof centre, &centre, sizeof centre);
  test::seal(other);
  EXPECT_NE(refusal(other).find("a point lies outside its frame"), std::string::npos);
}

TEST(Compiled, EditsLeaveTheBytesOfOthersAlone) {
  const Bytes bytes = small_image();
  Bytes copy = bytes;
  auto first = std::get<Compiled_environment<3>>(open_compiled_copy(copy));
  first.environment.thaw();
  EXPECT_GT(edit(first.environment, 1, 30), 5u);
  EXPECT_EQ(copy, bytes);
}

/// A snapshot whose arrays lie in memory of others grows out of it.
TEST(Compiled, GrowsOutOfItsImage) {
  const auto environment = Environment<3>::build(tetrahedral_grid({.cells = {2, 2, 2}}));
  auto again = opened<3>(bytes_of(environment));
  EXPECT_LT(again.environment.snapshot().bytes(), environment.snapshot().bytes() / 4)
      << "memory of others is not counted";
  again.environment.thaw();
  const Cell cell = again.environment.snapshot().cell(0);
  again.environment.insert_point(cell, test::mean_of_vertices<3>(again.environment.snapshot().view(cell)));
  EXPECT_GE(again.environment.snapshot().bytes(), environment.snapshot().bytes() / 2);
  EXPECT_NO_THROW(again.environment.certify());
}

}  // namespace
}  // namespace cellwalk
