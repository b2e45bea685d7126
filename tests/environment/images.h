// SPDX-License-Identifier: LGPL-3.0-or-later
// Images of environments that were damaged, with checksums that fit.
#ifndef CELLWALK_TESTS_ENVIRONMENT_IMAGES_H
#define CELLWALK_TESTS_ENVIRONMENT_IMAGES_H

#include <cellwalk/environment/compiled.h>
#include <cellwalk/internal/environment/image_format.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

namespace cellwalk::test {

/// The table of an image.
/// \pre the image is none that was cut short
inline std::vector<detail::Image_section> table_of(std::span<const std::byte> image) {
  detail::Image_header header;
  std::memcpy(&header, image.data(), sizeof header);
  std::vector<detail::Image_section> table(header.sections);
  const std::span<std::byte> bytes = std::as_writable_bytes(std::span(table));
  std::ranges::copy(image.subspan(sizeof header, bytes.size()), bytes.begin());
  return table;
}

/// The bytes of a section.
inline std::span<std::byte> section_of(std::span<std::byte> image, std::string_view name) {
  for (const detail::Image_section& section : table_of(image))
    if (name == section.name.data()) return image.subspan(section.offset, section.bytes);
  return {};
}

/// Makes all checksums those of the bytes as they are.
inline void seal(std::span<std::byte> image) {
  detail::Image_header header;
  std::memcpy(&header, image.data(), sizeof header);
  std::vector<detail::Image_section> table = table_of(image);
  for (detail::Image_section& section : table)
    section.checksum = detail::checksum(image.subspan(section.offset, section.bytes));
  header.checksum = detail::checksum(header, table);
  std::memcpy(image.data(), &header, sizeof header);
  std::ranges::copy(std::as_bytes(std::span(table)), image.begin() + sizeof header);
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_ENVIRONMENT_IMAGES_H
