// SPDX-License-Identifier: LGPL-3.0-or-later
// The calls of zlib, piece by piece, and the alphabet of base64.
#include <cellwalk/internal/io/gzip.h>
#include <cellwalk/kernel/error.h>

#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <limits>
#include <utility>

#include "text.h"

namespace cellwalk::io {
namespace {

constexpr std::size_t chunk_size = std::size_t{1} << 16;

/// Compresses pieces one after the other.
class Deflater {
 public:
  Deflater() {
    constexpr int largest_window_with_gzip_frame = 15 + 16, memory_level = 8;  // zlib's default
    if (deflateInit2(&stream_, Z_DEFAULT_COMPRESSION, Z_DEFLATED, largest_window_with_gzip_frame,
                     memory_level, Z_DEFAULT_STRATEGY) != Z_OK)
      throw Error(Error_code::other, "zlib cannot be started: out of memory");
  }
  ~Deflater() { deflateEnd(&stream_); }
  Deflater(const Deflater&) = delete;
  Deflater& operator=(const Deflater&) = delete;

  /// Passes the compressed bytes to `take`. Nothing may follow the last piece.
  template <class Take>
  void put(std::string_view bytes, bool is_last, Take&& take) {
    constexpr std::size_t most = std::numeric_limits<uInt>::max();
    do {
      const std::size_t size = std::min(bytes.size(), most);
      const int flush = is_last && size == bytes.size() ? Z_FINISH : Z_NO_FLUSH;
      stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
      stream_.avail_in = static_cast<uInt>(size);
      do {
        stream_.next_out = reinterpret_cast<Bytef*>(chunk_.data());
        stream_.avail_out = static_cast<uInt>(chunk_.size());
        deflate(&stream_, flush);
        take(std::string_view(chunk_.data(), chunk_.size() - stream_.avail_out));
      } while (stream_.avail_out == 0);
      bytes.remove_prefix(size);
    } while (!bytes.empty());
  }

 private:
  z_stream stream_{};
  std::string chunk_ = std::string(chunk_size, '\0');
};

}  // namespace

struct Gzip_file::Stream : Deflater {};

Gzip_file::Gzip_file(std::filesystem::path path)
    : file_(std::move(path)), stream_(std::make_unique<Stream>()) {}

Gzip_file::~Gzip_file() = default;

void Gzip_file::write(std::string_view bytes) {
  stream_->put(bytes, false, [&](std::string_view packed) { file_.write(packed); });
}

void Gzip_file::commit() {
  stream_->put({}, true, [&](std::string_view packed) { file_.write(packed); });
  file_.commit();
}

void gzip_file(const std::filesystem::path& file, const std::filesystem::path& packed) {
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(file.string(), "cannot be opened: check that it exists and may be read");
  Gzip_file out(packed);
  std::string piece(chunk_size, '\0');
  do {
    in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    out.write(std::string_view(piece).substr(0, static_cast<std::size_t>(in.gcount())));
  } while (in);
  if (in.bad()) fail(file.string(), "reading failed");
  out.commit();
}

std::string gzip(std::string_view bytes) {
  std::string packed;
  Deflater().put(bytes, true, [&](std::string_view piece) { packed += piece; });
  return packed;
}

void append_base64(std::string& out, std::span<const unsigned char> bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const unsigned group =
        bytes[i] << 16 | (left > 1 ? bytes[i + 1] << 8 : 0) | (left > 2 ? bytes[i + 2] : 0);
    out.push_back(digits[group >> 18]);
    out.push_back(digits[group >> 12 & 63]);
    out.push_back(left > 1 ? digits[group >> 6 & 63] : '=');
    out.push_back(left > 2 ? digits[group & 63] : '=');
  }
}

}  // namespace cellwalk::io
