// SPDX-License-Identifier: LGPL-3.0-or-later
// XXH3 of 64 bits.
#include <cellwalk/internal/kernel/checksum.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace cellwalk::detail {

std::uint64_t checksum(std::span<const std::byte> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

}  // namespace cellwalk::detail
