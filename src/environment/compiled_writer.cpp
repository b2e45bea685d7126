// SPDX-License-Identifier: LGPL-3.0-or-later
// The sections of an environment, written as one image to a file or to memory.
#include <algorithm>
#include <cstring>

#include "environment_image.h"

namespace cellwalk {
namespace detail {
namespace {

/// The sections of an image, and where their values are.
class Image_writer {
 public:
  template <class Array>
  void add(const char* name, const Array& values) {
    Image_section section;
    std::strncpy(section.name.data(), name, section.name.size() - 1);
    const auto bytes = std::as_bytes(std::span(values.data(), values.size()));
    section.bytes = bytes.size();
    section.element = sizeof(*values.data());
    section.checksum = checksum(bytes);
    table_.push_back(section);
    content_.push_back(bytes);
  }

  template <class Put>
  void write(int dimension, const Put& put) {
    Image_header header;
    header.dimension = static_cast<std::uint32_t>(dimension);
    header.sections = static_cast<std::uint32_t>(table_.size());
    std::size_t end = sizeof header + table_.size() * sizeof table_[0];
    for (Image_section& section : table_) {
      section.offset = aligned(end);
      end = section.offset + section.bytes;
    }
    header.bytes = end;
    header.checksum = checksum(header, table_);

    put(std::as_bytes(std::span(&header, 1)));
    put(std::as_bytes(std::span(table_)));
    std::size_t at = sizeof header + table_.size() * sizeof table_[0];
    constexpr std::array<std::byte, image_alignment> zeros{};
    for (std::size_t i = 0; i < table_.size(); ++i) {
      put(std::span(zeros).first(table_[i].offset - at));
      put(content_[i]);
      at = table_[i].offset + table_[i].bytes;
    }
  }

 private:
  std::vector<Image_section> table_;
  std::vector<std::span<const std::byte>> content_;
};

}  // namespace
}  // namespace detail

template <int D>
void write_compiled(const Environment<D>& environment, const Certificate& certificate,
                    const Groups<D>& groups, const std::function<void(std::span<const std::byte>)>& put) {
  using Image = detail::Environment_image<D>;
  const detail::Image_lists<D> lists = Image::lists(environment, certificate, groups);
  detail::Image_writer writer;
  const auto add = [&](const char* name, const auto& values) { writer.add(name, values); };
  Image::for_each_list(lists, add);
  Image::for_each_array(environment.snapshot(), add);
  writer.write(D, put);
}

template <int D>
std::vector<std::byte> compile_to_bytes(const Environment<D>& environment, const Certificate& certificate,
                                        const Groups<D>& groups) {
  std::vector<std::byte> bytes;
  write_compiled<D>(environment, certificate, groups, [&](std::span<const std::byte> part) {
    bytes.insert(bytes.end(), part.begin(), part.end());
  });
  return bytes;
}

template void write_compiled(const Environment<2>&, const Certificate&, const Groups<2>&,
                             const std::function<void(std::span<const std::byte>)>&);
template void write_compiled(const Environment<3>&, const Certificate&, const Groups<3>&,
                             const std::function<void(std::span<const std::byte>)>&);
template std::vector<std::byte> compile_to_bytes(const Environment<2>&, const Certificate&, const Groups<2>&);
template std::vector<std::byte> compile_to_bytes(const Environment<3>&, const Certificate&, const Groups<3>&);

}  // namespace cellwalk
