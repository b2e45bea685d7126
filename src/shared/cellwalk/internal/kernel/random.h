// SPDX-License-Identifier: LGPL-3.0-or-later
// Random numbers that are equal on every machine. The C++ standard specifies the engines exactly, but not the
// distributions, so the distributions are implemented here.
#ifndef CELLWALK_INTERNAL_KERNEL_RANDOM_H
#define CELLWALK_INTERNAL_KERNEL_RANDOM_H

#include <cellwalk/kernel/point.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace cellwalk {

/// A seeded stream of random numbers: the same seed gives the same numbers with every compiler and library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// 64 random bits.
  std::uint64_t bits() { return engine_(); }

  /// An integer in [0, n), without bias.
  /// \pre n > 0
  std::uint64_t below(std::uint64_t n) {
    const std::uint64_t rest = -n % n;  // 2^64 mod n values too many
    for (;;) {
      const std::uint64_t x = bits();
      if (x >= rest) return x % n;
    }
  }

  /// A multiple of 2^-53 in [0, 1).
  double real() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  /// A real in [low, high), rounded.
  double real(double low, double high) { return low + (high - low) * real(); }

  /// True with the given probability.
  bool chance(double probability) { return real() < probability; }

  /// Puts the values into random order.
  template <class T>
  void shuffle(std::vector<T>& values) {
    using std::swap;  // or that of T
    for (std::size_t i = values.size(); i > 1; --i) swap(values[i - 1], values[below(i)]);
  }

 private:
  std::mt19937_64 engine_;
};

/// Scrambles 64 bits (the finaliser of SplitMix64): a fixed pseudo-random function, for decisions that must
/// be equal in two places without communication.
constexpr std::uint64_t scramble(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_KERNEL_RANDOM_H
