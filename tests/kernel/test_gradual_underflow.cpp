// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/kernel/gradual_underflow.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

namespace cellwalk {
namespace {

TEST(GradualUnderflow, IsThere) { EXPECT_NO_THROW(expect_gradual_underflow()); }

#ifdef __SSE2__
TEST(GradualUnderflow, IsMissedWhereTheProcessorFlushes) {
  const unsigned int usual = _mm_getcsr();
  for (const unsigned int flushes : {0x8000u, 0x0040u, 0x8040u}) {  // results, operands, both
    _mm_setcsr(usual | flushes);
    EXPECT_THROW(expect_gradual_underflow(), Error) << flushes;
    _mm_setcsr(usual);
  }
}
#endif

}  // namespace
}  // namespace cellwalk
