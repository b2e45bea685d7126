// SPDX-License-Identifier: LGPL-3.0-or-later
// PNG with one colour type: a few lines with zlib, which is needed anyway, instead of a dependency on libpng.
#include <cellwalk/internal/drawing/picture.h>
#include <cellwalk/kernel/error.h>

#include <zlib.h>

namespace cellwalk::drawing {
namespace {

constexpr std::size_t bytes_per_pixel = 3;

void append_number(std::string& out, std::uint32_t n) {
  for (const int shift : {24, 16, 8, 0}) out += static_cast<char>(n >> shift & 0xff);
}

void append_chunk(std::string& out, const std::string& type, const std::string& data) {
  append_number(out, static_cast<std::uint32_t>(data.size()));
  const std::string body = type + data;
  out += body;
  append_number(out, static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(body.data()),
                                                      static_cast<uInt>(body.size()))));
}

/// A row as differences from the row above (filter type 2, Up); smooth pictures compress well.
void append_row(std::string& out, const std::uint8_t* row, const std::uint8_t* above, std::size_t size) {
  out += '\2';
  for (std::size_t i = 0; i < size; ++i)
    out += static_cast<char>(static_cast<std::uint8_t>(row[i] - (above ? above[i] : 0)));
}

}  // namespace

std::string encode_png(const Image& image) {
  const std::size_t row_size = bytes_per_pixel * static_cast<std::size_t>(image.width);
  std::string rows;
  rows.reserve((row_size + 1) * static_cast<std::size_t>(image.height));
  const std::uint8_t* above = nullptr;
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* row = image.rgb.data() + static_cast<std::size_t>(y) * row_size;
    append_row(rows, row, above, row_size);
    above = row;
  }
  uLongf size = compressBound(static_cast<uLong>(rows.size()));
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(rows.data()),
                static_cast<uLong>(rows.size()), Z_DEFAULT_COMPRESSION) != Z_OK)
    throw Error(Error_code::other, "picture: zlib could not compress it");
  packed.resize(size);

  std::string header;
  append_number(header, static_cast<std::uint32_t>(image.width));
  append_number(header, static_cast<std::uint32_t>(image.height));
  header += std::string("\x08\x02\x00\x00\x00", 5);  // 8 bits a channel, RGB, not interlaced
  std::string png = "\x89PNG\r\n\x1a\n";
  append_chunk(png, "IHDR", header);
  append_chunk(png, "IDAT", packed);
  append_chunk(png, "IEND", "");
  return png;
}

}  // namespace cellwalk::drawing
