// SPDX-License-Identifier: LGPL-3.0-or-later
// Choices and numbers out of bytes. Where bytes are short, all that follows is 0: every input means
// something, and a longer one that begins the same means the same at first.
#ifndef CELLWALK_TESTS_FUZZ_DECODER_H
#define CELLWALK_TESTS_FUZZ_DECODER_H

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>

namespace cellwalk::fuzz {

class Decoder {
 public:
  explicit Decoder(std::string_view bytes) : rest_(bytes) {}

  bool is_empty() const { return rest_.empty(); }
  std::string_view rest() const { return rest_; }

  std::uint8_t byte() {
    if (rest_.empty()) return 0;
    const auto value = static_cast<std::uint8_t>(rest_.front());
    rest_.remove_prefix(1);
    return value;
  }
  bool flag() { return byte() % 2 == 1; }

  /// A number below n, 0 if n is 0: of one byte up to 256, else of two.
  std::size_t below(std::size_t n) {
    std::size_t value = byte();
    if (n > 256) value = 256 * value + byte();
    return n == 0 ? 0 : value % n;
  }

  /// Mostly a multiple of 1/4 between -32 and 32, as degenerate positions need them; else any finite double.
  double coordinate() {
    const auto quarters = static_cast<std::int8_t>(byte());
    if (quarters != std::numeric_limits<std::int8_t>::min()) return quarters / 4.0;
    double value = 0;
    const std::string_view raw = rest_.substr(0, sizeof value);
    std::memcpy(&value, raw.data(), raw.size());
    rest_.remove_prefix(raw.size());
    return std::isfinite(value) ? value : 0;
  }

 private:
  std::string_view rest_;
};

}  // namespace cellwalk::fuzz

#endif  // CELLWALK_TESTS_FUZZ_DECODER_H
