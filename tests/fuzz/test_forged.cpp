// SPDX-License-Identifier: LGPL-3.0-or-later
// Compiled environments with changed entries and checksums that fit are refused, or used in all ways: a use
// may end in an Error, but it ends. Under the address sanitizer, nothing is read that is not there.
#include <cellwalk/environment/compiled.h>
#include <cellwalk/internal/kernel/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <variant>

#include "fuzz/forge.h"
#include "fuzz/targets.h"
#include "fuzz/use_opened.h"

namespace cellwalk::fuzz {
namespace {

std::string random_bytes(Random& random, std::size_t count) {
  std::string bytes(count, '\0');
  std::ranges::generate(bytes, [&] { return static_cast<char>(random.below(256)); });
  return bytes;
}

constexpr std::size_t bytes_of_uses = 200;

TEST(Forged, SoundImagesAreUsedWithoutAContradiction) {
  Random random(1);
  for (const Image& image : sound_images()) {
    auto opened = open_compiled_copy(image);
    const std::string bytes = random_bytes(random, bytes_of_uses);
    Decoder in(bytes);
    EXPECT_NO_THROW(std::visit([&](auto& known) { use(known.environment, in); }, opened));
  }
}

TEST(Forged, ImagesAreRefusedOrUsed) {
  Random random(2);
  const Used before = used();
  constexpr std::size_t images = 1500;
  for (std::size_t i = 0; i < images; ++i)
    EXPECT_NO_THROW(forged(random_bytes(random, bytes_of_uses))) << "input " << i;
  const auto grew = [&](std::size_t Used::*count) { return used().*count - before.*count; };
  EXPECT_EQ(grew(&Used::opened) + grew(&Used::refused), images);
  EXPECT_GT(grew(&Used::refused), 600u);
  EXPECT_GT(grew(&Used::opened), 300u);
  EXPECT_GT(grew(&Used::motions), 600u);
  EXPECT_GT(grew(&Used::sweeps), 300u);
  EXPECT_GT(grew(&Used::bodies), 200u);
  EXPECT_GT(grew(&Used::steps), 200u);
  EXPECT_GT(grew(&Used::changes), 500u);
  EXPECT_GT(grew(&Used::edits), 200u);
  EXPECT_GT(grew(&Used::contradictions), 100u);
}

}  // namespace
}  // namespace cellwalk::fuzz
