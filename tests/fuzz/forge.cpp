// SPDX-License-Identifier: LGPL-3.0-or-later
#include "fuzz/forge.h"

#include <cellwalk/environment/compiled.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/generators/lattice_world.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include "environment/images.h"
#include "environment/sample_soups.h"
#include "fuzz/targets.h"

namespace cellwalk::fuzz {
namespace {

template <int D>
Image image_of(const Environment<D>& environment) {
  const Snapshot<D>& snapshot = environment.snapshot();
  Groups<D> groups;
  groups["cells"].cells = {snapshot.cell(0)};
  groups["facets"].facets = {Snapshot<D>::half_facet(snapshot.cell(0), 0)};
  return compile_to_bytes<D>(environment, environment.certify(), groups);
}

/// Points come and go, so that names are left free.
template <int D>
Environment<D> edited(Environment<D> environment) {
  for (std::size_t i = 0; i < 2; ++i) {
    const Cell_view<D> cell = environment.snapshot().view(environment.snapshot().cell(i));
    Point<D> middle{};
    for (std::size_t v = 0; v < cell.vertex_count(); ++v)
      for (std::size_t k = 0; k < D; ++k)
        middle[k] += cell.point(v)[k] / static_cast<double>(cell.vertex_count());
    environment.insert_point(environment.snapshot().cell(i), middle);
  }
  return environment;
}

template <int D>
Environment<D> lattice(std::uint64_t seed, bool is_simplicial) {
  auto options = mixed_lattice_world<D>(seed);
  options.cells = Grid_options<D>::filled(2);
  options.slit_share = 0.2;
  return Environment<D>::build(lattice_world(options),
                               {.duplicates = Duplicate_vertices::keep, .simplicial = is_simplicial});
}

std::vector<Image> made_images() {
  Cell_soup<3> prism;
  prism.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {0, 2, 2}, {0, 0, -1}};
  add_prism(prism, {0, 1, 2, 3, 4, 5});
  add_tetrahedron(prism, 6, 1, 2, 0);
  std::vector<Image> images;
  images.push_back(image_of(Environment<3>::build(tetrahedral_grid({.cells = {2, 1, 1}}))));
  images.push_back(image_of(edited(Environment<3>::build(tetrahedral_grid({.cells = {1, 1, 1}})))));
  images.push_back(image_of(lattice<3>(2, true)));
  images.push_back(image_of(Environment<3>::build(hex_grid({.cells = {2, 2, 1}, .solid_cells = {0}}))));
  images.push_back(image_of(lattice<3>(5, false)));
  images.push_back(image_of(Environment<3>::build(prism, {.split = false})));
  images.push_back(image_of(Environment<3>::build(test::pinched_tetrahedra())));
  images.push_back(image_of(Environment<2>::build(triangle_grid({.cells = {2, 2}}))));
  images.push_back(image_of(edited(Environment<2>::build(triangle_grid({.cells = {2, 1}})))));
  images.push_back(image_of(Environment<2>::build(square_grid({.cells = {3, 2}, .solid_cells = {1}}))));
  images.push_back(image_of(Environment<2>::build(test::collinear_polygon())));
  images.push_back(image_of(lattice<2>(3, false)));
  return images;
}

/// A number to put in the place of another: the greatest ones are those that mean "none" and bits.
template <class T>
T other_number(T own, std::span<const std::byte> image, Decoder& in) {
  const auto sections = test::table_of(image);
  const auto& counted = sections[in.below(sections.size())];
  const auto length = static_cast<T>(counted.bytes / std::max<std::uint64_t>(counted.element, 1));
  constexpr T top = static_cast<T>(T{1} << (std::numeric_limits<T>::digits - 1));
  switch (in.below(12)) {
    case 0:
      return 0;
    case 1:
      return std::numeric_limits<T>::max();
    case 2:
      return top;
    case 3:
      return length;
    case 4:
      return static_cast<T>(length - 1);
    case 5:
      return static_cast<T>(own + 1);
    case 6:
      return static_cast<T>(own - 1);
    case 7:
      return static_cast<T>(own ^ top);
    case 8:
      return static_cast<T>(own ^ (top >> 1));
    case 9:
      return static_cast<T>(own ^ (top >> 2));
    case 10:
      return static_cast<T>(own ^ (T{1} << in.below(std::numeric_limits<T>::digits)));
    default:
      return static_cast<T>(in.byte());
  }
}

template <class T>
T other_real(T own, Decoder& in) {
  switch (in.below(12)) {
    case 0:
      return 0;
    case 1:
      return -own;
    case 2:
      return 2 * own;
    case 3:
      return own / 2;
    case 4:
      return std::nextafter(own, T{100});
    case 5:
      return std::numeric_limits<T>::quiet_NaN();
    case 6:
      return std::numeric_limits<T>::infinity();
    case 7:
      return std::numeric_limits<T>::max();
    case 8:
      return std::numeric_limits<T>::denorm_min();
    case 9:
      return own + 1;
    default:
      return static_cast<T>(in.coordinate());
  }
}

/// Changes an entry of an array of T, or exchanges two.
template <class T, class Other>
void change(std::span<std::byte> section, const Other& other, Decoder& in) {
  const std::size_t count = section.size() / sizeof(T);
  if (count == 0) return;
  const auto at = [&](std::size_t i) { return section.data() + i * sizeof(T); };
  const std::size_t one = in.below(count), kind = in.below(8), two = kind < 2 ? in.below(count) : one;
  T value, elsewhere;
  std::memcpy(&value, at(one), sizeof value);
  std::memcpy(&elsewhere, at(two), sizeof elsewhere);
  if (kind == 0) std::memcpy(at(two), &value, sizeof value);
  const T now = kind < 2 ? elsewhere : other(value);
  std::memcpy(at(one), &now, sizeof now);
}

}  // namespace

const std::vector<Image>& sound_images() {
  static const std::vector<Image> images = made_images();
  return images;
}

Image forged_image(Decoder& in) {
  Image image = sound_images()[in.below(sound_images().size())];
  constexpr std::size_t most_changes = 3;
  for (std::size_t changes = in.below(most_changes) + 1; changes > 0; --changes) {
    const auto table = test::table_of(image);
    const std::string_view name = table[in.below(table.size())].name.data();
    const auto section = test::section_of(image, name);
    const auto number = [&](auto own) { return other_number(own, image, in); };
    const auto real = [&](auto own) { return other_real(own, in); };
    if (name == "planes")
      change<float>(section, real, in);
    else if (name == "points" || (name == "state" && in.flag()))
      change<double>(section, real, in);
    else if (name == "state")
      change<std::uint64_t>(section, number, in);
    else if (name == "shapes")
      change<std::uint16_t>(section, number, in);
    else
      change<std::uint32_t>(section, number, in);
  }
  test::seal(image);
  return image;
}

}  // namespace cellwalk::fuzz
