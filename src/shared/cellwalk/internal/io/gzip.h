// SPDX-License-Identifier: LGPL-3.0-or-later
// Compression with gzip by zlib, into the project's atomic files instead of zlib's own, and encoding in
// base64, which no dependency offers with padding.
#ifndef CELLWALK_INTERNAL_IO_GZIP_H
#define CELLWALK_INTERNAL_IO_GZIP_H

#include <cellwalk/internal/io/atomic_file.h>

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace cellwalk::io {

/// A compressed file that is written in pieces and appears on commit(), or not at all. Its bytes depend on
/// the content and on the version of zlib, not on the pieces; they contain no date.
class Gzip_file final : public Byte_sink {
 public:
  /// \throw Error(other) if the file cannot be written
  explicit Gzip_file(std::filesystem::path path);
  ~Gzip_file() override;

  /// \throw Error(other) if the device is full
  void write(std::string_view bytes) override;
  /// \throw Error(other) if the rest cannot be written, or the file cannot be renamed
  void commit() override;

 private:
  struct Stream;
  Atomic_file file_;
  std::unique_ptr<Stream> stream_;
};

/// Compresses a file into another, which appears when it is complete. Its bytes are those of a Gzip_file.
/// \throw Error(input) if the file cannot be read, Error(other) if the other cannot be written
void gzip_file(const std::filesystem::path& file, const std::filesystem::path& packed);

/// Compresses bytes in memory.
std::string gzip(std::string_view bytes);

/// Appends bytes in base64, padded, without line ends.
void append_base64(std::string& out, std::span<const unsigned char> bytes);

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_GZIP_H
