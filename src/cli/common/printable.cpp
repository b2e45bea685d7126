// SPDX-License-Identifier: LGPL-3.0-or-later
// Control characters of a message, written as escapes.
#include "printable.h"

#include <fmt/format.h>

namespace cellwalk::cli {

std::string printable(std::string_view message) {
  constexpr unsigned char first_printed = ' ', delete_character = 0x7f;
  std::string line;
  for (const char c : message) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= first_printed && code != delete_character)
      line += c;
    else if (c == '\n')
      line += "\\n";
    else
      line += fmt::format("\\x{:02x}", code);
  }
  return line;
}

}  // namespace cellwalk::cli
