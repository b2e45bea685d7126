// SPDX-License-Identifier: LGPL-3.0-or-later
// What libFuzzer calls: the target CELLWALK_FUZZ_TARGET. A Finding ends the program, as every exception that
// nobody catches.
#include <cstddef>
#include <cstdint>

#include "fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  cellwalk::fuzz::CELLWALK_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
  return 0;
}
