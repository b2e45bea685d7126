// SPDX-License-Identifier: LGPL-3.0-or-later
// Sums in fixed point: each value becomes a whole number of units, and those are added without rounding.
#include <cellwalk/kernel/error.h>
#include <cellwalk/walk/tally.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace cellwalk {
namespace {

__extension__ using Unsigned = unsigned __int128;  // not of ISO C++

/// The bits of a value of the size of the bound; 2^32 of them fit into 127 bits.
constexpr int bits_of_largest = 94;

}  // namespace

Tally::Tally(std::size_t cells, double largest) : sums_(cells), largest_(largest) {
  if (!(std::isfinite(largest) && largest > 0))
    throw Error(Error_code::usage, "the largest value of a tally must be a positive number");
  unit_exponent_ = std::ilogb(largest) + 1 - bits_of_largest;
}

void Tally::add(std::size_t cell, double value) {
  // value = mantissa 2^exponent
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const int biased = static_cast<int>(bits >> 52 & 0x7ff);
  const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52) - 1);
  const auto mantissa = static_cast<Fixed>(biased == 0 ? fraction : fraction | std::uint64_t{1} << 52);
  const int shift = std::max(biased, 1) - 1075 - unit_exponent_;
  Fixed units = 0;
  if (shift >= 0)
    units = mantissa << shift;
  else if (shift > -64)
    units = (mantissa + (Fixed{1} << (-shift - 1))) >> -shift;  // half a unit is rounded away from 0
  sums_[cell] += std::signbit(value) ? -units : units;
}

void Tally::add(const Tally& other) {
  if (other.size() != size() || other.largest_ != largest_)
    throw Error(Error_code::usage, "tallies of other cells or other bounds cannot be added");
  for (std::size_t i = 0; i < size(); ++i) sums_[i] += other.sums_[i];
}

double Tally::operator[](std::size_t cell) const {
  const Fixed sum = sums_[cell];
  auto size = static_cast<Unsigned>(sum < 0 ? -sum : sum);
  // Of more than 64 bits, those below the upper 64 only count in that they are not all 0.
  int exponent = unit_exponent_;
  const auto high = static_cast<std::uint64_t>(size >> 64);
  if (high != 0) {
    const int shift = 64 - std::countl_zero(high);
    const bool is_rest = (size & ((static_cast<Unsigned>(1) << shift) - 1)) != 0;
    size = size >> shift | is_rest;
    exponent += shift;
  }
  const double rounded = std::ldexp(static_cast<double>(static_cast<std::uint64_t>(size)), exponent);
  return sum < 0 ? -rounded : rounded;
}

std::vector<std::uint64_t> Tally::words() const {
  std::vector<std::uint64_t> words;
  words.reserve(2 * size());
  for (const Fixed sum : sums_) {
    words.push_back(static_cast<std::uint64_t>(sum));
    words.push_back(static_cast<std::uint64_t>(sum >> 64));
  }
  return words;
}

void Tally::add_words(const std::vector<std::uint64_t>& words) {
  for (std::size_t i = 0; i < size(); ++i)
    sums_[i] += static_cast<Fixed>(static_cast<Unsigned>(words[2 * i + 1]) << 64 | words[2 * i]);
}

}  // namespace cellwalk
