// SPDX-License-Identifier: LGPL-3.0-or-later
// The layout of images of environments: a header, a table of sections, and the sections, each at a multiple
// of 64 bytes. Numbers are little-endian.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_IMAGE_FORMAT_H
#define CELLWALK_INTERNAL_ENVIRONMENT_IMAGE_FORMAT_H

#include <cellwalk/environment/certify.h>
#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/kernel/checksum.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

namespace cellwalk::detail {

constexpr std::array<char, 8> image_magic{'C', 'E', 'L', 'L', 'W', 'A', 'L', 'K'};
/// To be raised whenever the arrays of a snapshot get another meaning, as by another bound of the error of
/// planes.
constexpr std::uint32_t image_version = 2;
constexpr std::uint32_t image_byte_order = 0x01020304;
constexpr std::size_t image_alignment = 64;  // bytes; that of planes, and of lines of the cache

constexpr std::size_t aligned(std::size_t offset) {
  return (offset + image_alignment - 1) / image_alignment * image_alignment;
}

struct Image_header {
  std::array<char, 8> magic = image_magic;
  std::uint32_t version = image_version;
  std::uint32_t byte_order = image_byte_order;
  std::uint32_t dimension = 0;
  std::uint32_t sections = 0;
  std::uint64_t bytes = 0;  ///< of the whole image
  /// Of the header, with 0 here, and of the table.
  std::uint64_t checksum = 0;
  std::array<std::uint64_t, 3> unused{};
};
static_assert(sizeof(Image_header) == 64 && std::is_trivially_copyable_v<Image_header>);

struct Image_section {
  std::array<char, 16> name{};
  std::uint64_t offset = 0, bytes = 0;
  std::uint64_t element = 0;  ///< bytes of one value
  std::uint64_t checksum = 0;
};
static_assert(sizeof(Image_section) == 48 && std::is_trivially_copyable_v<Image_section>);

/// The members of a snapshot besides its arrays, and the results of its certification.
template <int D>
struct Image_state {
  std::array<double, D> frame_centre{};
  double frame_scale = 1;
  std::uint64_t uncertified_planes = 0, uniform_blocks = 0, epoch = 0, geometry_epoch = 0;
  std::uint64_t allow_duplicates = 0;
  std::array<std::uint64_t, 10> counts{};  ///< of the certificate, in the order of its members
  double volume = 0, free_volume = 0;
};
static_assert(std::is_trivially_copyable_v<Image_state<3>> && sizeof(Image_state<3>) == 8 * 21);

/// The checksum of a header and a table, whatever the header has as its own.
std::uint64_t checksum(Image_header header, std::span<const Image_section> table);

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_IMAGE_FORMAT_H
