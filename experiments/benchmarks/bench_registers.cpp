// SPDX-License-Identifier: LGPL-3.0-or-later
// What wider registers would bring to the step of a body in its region: the test whether an open box holds
// its targets, and their copy. As the library does it, with the bounds of the targets in registers of two
// numbers and then a copy, beside registers of four (AVX2) and eight (AVX-512), which compare and copy what
// they have loaded. All give the same bits.
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/point.h>

#include <benchmark/benchmark.h>

#include <cstring>
#include <vector>

#if defined(__x86_64__)
#include <immintrin.h>

namespace {

using namespace cellwalk;

constexpr std::size_t corners = 8, numbers = 3 * corners, bodies = 225;

/// The bounds of each coordinate, as they lie in the points of a body.
struct Bounds {
  alignas(64) double low[numbers], high[numbers];
};

bool by_twos(const Bounds& bounds, const Point<3>* from, Point<3>* to) {
  const double* x = from->data();
  __m128d low[3], high[3];
  for (std::size_t k = 0; k < 3; ++k) low[k] = high[k] = _mm_loadu_pd(x + 2 * k);
  for (std::size_t i = 3; i < numbers / 2; ++i) {
    const __m128d pair = _mm_loadu_pd(x + 2 * i);
    low[i % 3] = _mm_min_pd(low[i % 3], pair);
    high[i % 3] = _mm_max_pd(high[i % 3], pair);
  }
  __m128d held = _mm_cmplt_pd(_mm_load_pd(bounds.low), low[0]);
  for (std::size_t k = 0; k < 3; ++k) {
    held = _mm_and_pd(held, _mm_cmplt_pd(_mm_load_pd(bounds.low + 2 * k), low[k]));
    held = _mm_and_pd(held, _mm_cmplt_pd(high[k], _mm_load_pd(bounds.high + 2 * k)));
  }
  if (_mm_movemask_pd(held) != 3) return false;
  std::memcpy(to, from, corners * sizeof(Point<3>));
  return true;
}

[[gnu::target("avx2")]] bool by_fours(const Bounds& bounds, const Point<3>* from, Point<3>* to) {
  const double* x = from->data();
  __m256d loaded[numbers / 4], held = _mm256_castsi256_pd(_mm256_set1_epi64x(-1));
  for (std::size_t i = 0; i < numbers / 4; ++i) {
    // The places of coordinates repeat after three registers.
    const std::size_t place = 4 * (i % 3);
    loaded[i] = _mm256_loadu_pd(x + 4 * i);
    held = _mm256_and_pd(held, _mm256_cmp_pd(_mm256_load_pd(bounds.low + place), loaded[i], _CMP_LT_OQ));
    held = _mm256_and_pd(held, _mm256_cmp_pd(loaded[i], _mm256_load_pd(bounds.high + place), _CMP_LT_OQ));
  }
  if (_mm256_movemask_pd(held) != 0xf) return false;
  for (std::size_t i = 0; i < numbers / 4; ++i) _mm256_storeu_pd(to->data() + 4 * i, loaded[i]);
  return true;
}

[[gnu::target("avx512f")]] bool by_eights(const Bounds& bounds, const Point<3>* from, Point<3>* to) {
  const double* x = from->data();
  __m512d loaded[numbers / 8];
  __mmask8 held = 0xff;
  for (std::size_t i = 0; i < numbers / 8; ++i) {
    loaded[i] = _mm512_loadu_pd(x + 8 * i);
    held = _mm512_mask_cmp_pd_mask(held, _mm512_load_pd(bounds.low + 8 * i), loaded[i], _CMP_LT_OQ);
    held = _mm512_mask_cmp_pd_mask(held, loaded[i], _mm512_load_pd(bounds.high + 8 * i), _CMP_LT_OQ);
  }
  if (held != 0xff) return false;
  for (std::size_t i = 0; i < numbers / 8; ++i) _mm512_storeu_pd(to->data() + 8 * i, loaded[i]);
  return true;
}

template <class Step>
void steps(benchmark::State& state, Step step, bool is_supported) {
  if (!is_supported) {
    state.SkipWithError("not among the instructions of this processor");
    return;
  }
  Random random(1);
  std::vector<Bounds> bounds(bodies);
  std::vector<Point<3>> targets(bodies * corners), positions(bodies * corners);
  for (std::size_t b = 0; b < bodies; ++b) {
    for (std::size_t i = 0; i < numbers; ++i) {
      bounds[b].low[i] = -1.0 - static_cast<double>(i % 3);
      bounds[b].high[i] = 2.0 + static_cast<double>(i % 3);
    }
  }
  for (Point<3>& x : targets)
    for (double& c : x) c = random.real(0, 1);
  std::size_t moved = 0;
  for (auto _ : state) {
    for (std::size_t b = 0; b < bodies; ++b)
      moved += step(bounds[b], targets.data() + corners * b, positions.data() + corners * b);
    benchmark::ClobberMemory();
  }
  if (moved != bodies * state.iterations() || positions != targets)
    state.SkipWithError("a body did not move as it should");
  state.counters["bodies"] =
      benchmark::Counter(bodies, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(steps, registers_of_two, by_twos, true);
BENCHMARK_CAPTURE(steps, registers_of_four, by_fours, __builtin_cpu_supports("avx2"));
BENCHMARK_CAPTURE(steps, registers_of_eight, by_eights, __builtin_cpu_supports("avx512f"));

}  // namespace

#endif
