// SPDX-License-Identifier: LGPL-3.0-or-later
// Files damaged at random.
#ifndef CELLWALK_TESTS_IO_DAMAGED_H
#define CELLWALK_TESTS_IO_DAMAGED_H

#include <random>
#include <string>
#include <string_view>

namespace cellwalk::io {

/// Replaces, removes or inserts a few bytes, preferring those that mean something to a parser.
inline std::string damaged(std::string text, std::mt19937& random) {
  constexpr std::string_view meaningful("0123456789 -+.,()\"/\n#eEx\0\xff", 27);
  for (unsigned n = 1 + random() % 4; n > 0; --n) {
    const std::size_t at = random() % text.size();
    const char c = meaningful[random() % meaningful.size()];
    switch (random() % 4) {
      case 0:
        text[at] = c;
        break;
      case 1:
        text.erase(at, 1 + random() % 3);
        break;
      case 2:
        text.insert(at, 1, c);
        break;
      default:
        text[at] = static_cast<char>(random());
        break;
    }
    if (text.empty()) text.push_back(' ');
  }
  return text;
}

}  // namespace cellwalk::io

#endif  // CELLWALK_TESTS_IO_DAMAGED_H
