// SPDX-License-Identifier: LGPL-3.0-or-later
// The checksum of the header and the table of sections.
#include <cellwalk/internal/environment/image_format.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <memory>

namespace cellwalk::detail {
namespace {

struct Free_state {
  void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
};

}  // namespace

std::uint64_t checksum(Image_header header, std::span<const Image_section> table) {
  header.checksum = 0;
  const std::unique_ptr<XXH3_state_t, Free_state> state(XXH3_createState());
  if (!state) throw std::bad_alloc();
  XXH3_64bits_reset(state.get());
  XXH3_64bits_update(state.get(), &header, sizeof header);
  XXH3_64bits_update(state.get(), table.data(), table.size_bytes());
  return XXH3_64bits_digest(state.get());
}

}  // namespace cellwalk::detail
