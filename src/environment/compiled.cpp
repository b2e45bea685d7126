// SPDX-License-Identifier: LGPL-3.0-or-later
// The opening of an image: every section is tested by its checksum and its size.
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <string>
#include <utility>

#include "environment_image.h"

namespace cellwalk {
namespace detail {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw Error(Error_code::input, what); }

/// The sections of an image in their order, each tested by its checksum.
class Image_reader {
 public:
  explicit Image_reader(Held_bytes image) : image_(std::move(image)) {
    read_header();
    read_table();
  }

  std::uint32_t dimension() const { return header_.dimension; }

  /// The values of the next section.
  template <class T>
  std::span<T> take(const char* name) {
    if (next_ == table_.size()) refuse_image("sections are missing");
    const Image_section& section = table_[next_++];
    if (std::strncmp(section.name.data(), name, section.name.size()) != 0 || section.element != sizeof(T) ||
        section.bytes % sizeof(T) != 0)
      refuse_image("it has other sections");
    const auto bytes = image_.bytes.subspan(section.offset, section.bytes);
    if (checksum(bytes) != section.checksum) refuse_image("a checksum differs");
    return {reinterpret_cast<T*>(bytes.data()), section.bytes / sizeof(T)};
  }
  void expect_end() const {
    if (next_ != table_.size()) refuse_image("it has further sections");
  }
  const std::shared_ptr<const void>& owner() const { return image_.owner; }

 private:
  void read_header() {
    const auto bytes = image_.bytes;
    if (!is_compiled(bytes)) refuse("this is no compiled environment: make one, by `cellwalk import`");
    if (bytes.size() < sizeof header_) refuse_image("it is cut short");
    std::memcpy(&header_, bytes.data(), sizeof header_);
    if (header_.byte_order != image_byte_order)
      refuse(
          "this environment was compiled on a machine of another byte order: compile it here, by `cellwalk "
          "import`");
    if (header_.version != image_version)
      refuse("this environment was compiled in version " + std::to_string(header_.version) +
             " of the format, and this program reads version " + std::to_string(image_version) +
             ": compile it again, by `cellwalk import`");
    if (header_.bytes > bytes.size()) refuse_image("it is cut short");
    if (header_.bytes < bytes.size()) refuse_image("more follows its end");
  }
  void read_table() {
    const std::size_t room = (image_.bytes.size() - sizeof header_) / sizeof(Image_section);
    if (header_.sections > room) refuse_image("it is cut short");
    table_.resize(header_.sections);
    const std::span<std::byte> table = std::as_writable_bytes(std::span(table_));
    std::ranges::copy(image_.bytes.subspan(sizeof header_, table.size()), table.begin());
    if (checksum(header_, table_) != header_.checksum) refuse_image("a checksum differs");
    std::size_t end = sizeof header_ + table.size();
    for (const Image_section& section : table_) {
      if (section.offset != aligned(end) || section.offset > header_.bytes ||
          section.bytes > header_.bytes - section.offset)
        refuse_image("a section lies elsewhere");
      const auto gap = image_.bytes.subspan(end, section.offset - end);
      if (std::ranges::any_of(gap, [](std::byte b) { return b != std::byte{}; }))
        refuse_image("a gap is used");
      end = section.offset + section.bytes;
    }
    if (end != header_.bytes) refuse_image("a section lies elsewhere");
  }

  Held_bytes image_;
  Image_header header_;
  std::vector<Image_section> table_;
  std::size_t next_ = 0;
};

template <int D>
Compiled_environment<D> open(Image_reader& reader) {
  using Image = Environment_image<D>;
  Image_lists<D> lists;
  Image::for_each_list(lists, [&]<class T>(const char* name, std::vector<T>& list) {
    const std::span<T> values = reader.take<T>(name);
    list.assign(values.begin(), values.end());
  });
  Snapshot<D> snapshot;
  Image::for_each_array(snapshot, [&]<class T>(const char* name, Flat_array<T>& array) {
    array = Flat_array<T>(reader.take<T>(name), reader.owner());
  });
  reader.expect_end();
  return Image::assemble(std::move(snapshot), lists);
}

}  // namespace
}  // namespace detail

bool is_compiled(std::span<const std::byte> bytes) {
  return bytes.size() >= detail::image_magic.size() &&
         std::memcmp(bytes.data(), detail::image_magic.data(), detail::image_magic.size()) == 0;
}

Any_compiled_environment open_compiled(Held_bytes image) {
  if (reinterpret_cast<std::uintptr_t>(image.bytes.data()) % detail::image_alignment != 0)
    throw Error(Error_code::usage, "a compiled environment must begin at a multiple of 64 bytes in memory");
  detail::Image_reader reader(std::move(image));
  if (reader.dimension() == 2) return detail::open<2>(reader);
  if (reader.dimension() == 3) return detail::open<3>(reader);
  detail::refuse_image("it has neither two nor three dimensions");
}

Any_compiled_environment open_compiled_copy(std::span<const std::byte> bytes) {
  constexpr std::align_val_t alignment{detail::image_alignment};
  const std::shared_ptr<void> memory(::operator new(std::max<std::size_t>(bytes.size(), 1), alignment),
                                     [](void* p) { ::operator delete(p, alignment); });
  if (!bytes.empty()) std::memcpy(memory.get(), bytes.data(), bytes.size());
  return open_compiled({{static_cast<std::byte*>(memory.get()), bytes.size()}, memory});
}

}  // namespace cellwalk
