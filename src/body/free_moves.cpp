// SPDX-License-Identifier: LGPL-3.0-or-later
#include "free_moves.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace cellwalk::detail {
namespace {

/// A thread moves no fewer: to wake another takes some microseconds.
constexpr std::size_t least_vertices_of_thread = 1024;

template <class Work>
void for_each_word(std::size_t words, std::size_t words_at_once, bool parallel, const Work& work) {
  if (!parallel) {
    for (std::size_t word = 0; word < words; ++word) work(word);
    return;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, words, words_at_once), [&](const auto& range) {
    for (std::size_t word = range.begin(); word != range.end(); ++word) work(word);
  });
}

}  // namespace

template <int D>
Free_moves<D>::Free_moves(std::size_t vertices, const Body_certificates& certificates) : vertices_(vertices) {
  if (!certificates.star_regions ||
      vertices < std::max(certificates.least_vertices_of_parts, certificates.least_vertices_at_once))
    return;
  const std::size_t words = (vertices + bits - 1) / bits;
  left_.resize(words);
  is_reordered_.resize(words);
  chosen_.resize(vertices);
  before_.resize(vertices);
}

template <int D>
void Free_moves<D>::make_none() {
  for (std::size_t word = 0; word < word_count(); ++word)
    left_[word] = ~std::uint64_t{0} >> (bits - (end(word) - begin(word)));
}

template <int D>
std::size_t Free_moves<D>::make(const Movable<D>& body, std::span<const Point<D>> targets,
                                std::span<const std::uint64_t> is_supported, bool parallel) {
  for_each_word(word_count(), least_vertices_of_thread / bits, parallel, [&](std::size_t word) {
    find_plain(body, targets, is_supported, word);
    make(body, targets, word);
  });
  // What is known of a vertex is read where its neighbours are looked at.
  for (std::size_t word = 0; word < word_count(); ++word)
    for (std::uint64_t rest = is_reordered_[word]; rest != 0; rest &= rest - 1) {
      const std::uint32_t v = first_of(word, rest);
      body.pool.put_first(v, chosen_[v]);
    }
  std::size_t made = vertices_;
  for (const std::uint64_t left : left_) made -= static_cast<std::size_t>(std::popcount(left));
  return made;
}

/// True if all vertices of a word are known to lie in the region of the body alone, with their neighbours,
/// and their targets lie there: most are of that kind, and looked at side by side.
template <int D>
bool Free_moves<D>::are_in_body_region(const Movable<D>& body, std::span<const Point<D>> targets,
                                       std::size_t word) const {
  const std::size_t first = begin(word), count = end(word) - first;
  return body.region.has_region() && body.region.holds_stars(first, count) &&
         body.pool.holds_none(first, count) && body.region.holds_all(targets.subspan(first, count));
}

/// Finds the plain vertices of a word: all others are left. Reads only what make() leaves as it is.
template <int D>
void Free_moves<D>::find_plain(const Movable<D>& body, std::span<const Point<D>> targets,
                               std::span<const std::uint64_t> is_supported, std::size_t word) {
  std::uint64_t left = is_supported.empty() ? 0 : is_supported[word], reordered = 0;
  if (are_in_body_region(body, targets, word)) {
    left_[word] = left;
    is_reordered_[word] = 0;
    return;
  }
  const bool has_region = body.region.has_region();
  for (auto v = static_cast<std::uint32_t>(begin(word)); v < end(word); ++v) {
    const std::uint64_t bit = std::uint64_t{1} << v % bits;
    const bool is_held = has_region && body.region.holds(targets[v]);
    const bool stays = !has_region || is_held != body.region.is_outside(v);
    if (stays && is_held && body.region.holds_neighbours(v)) {
      if (body.pool.holds(v)) left |= bit;  // it is to be forgotten
      continue;
    }
    const int number = stays ? body.pool.known_with_star(v, targets[v], body.topology) : -1;
    if (number < 0) left |= bit;
    if (number <= 0) continue;
    chosen_[v] = static_cast<std::uint8_t>(number);
    reordered |= bit;
  }
  left_[word] = left;
  is_reordered_[word] = reordered & ~left;
}

/// Makes the moves of a word that are not left.
template <int D>
void Free_moves<D>::make(const Movable<D>& body, std::span<const Point<D>> targets, std::size_t word) {
  const std::size_t first = begin(word), count = end(word) - first;
  std::copy_n(body.positions.begin() + static_cast<std::ptrdiff_t>(first), count,
              before_.begin() + static_cast<std::ptrdiff_t>(first));
  const std::uint64_t left = left_[word];
  if (left == 0) {
    std::copy_n(targets.begin() + static_cast<std::ptrdiff_t>(first), count,
                body.positions.begin() + static_cast<std::ptrdiff_t>(first));
    body.region.mark_moved(first, count);
  } else {
    for (auto v = static_cast<std::uint32_t>(first); v < first + count; ++v) {
      if ((left >> v % bits & 1) != 0) continue;
      body.positions[v] = targets[v];
      body.region.mark_moved(v);
    }
  }
}

template <int D>
std::uint32_t Free_moves<D>::find_left(std::uint32_t vertex) const {
  std::size_t word = vertex / bits;
  if (word >= word_count()) return static_cast<std::uint32_t>(vertices_);
  std::uint64_t rest = left_[word] & ~std::uint64_t{0} << vertex % bits;
  while (rest == 0) {
    if (++word == word_count()) return static_cast<std::uint32_t>(vertices_);
    rest = left_[word];
  }
  return first_of(word, rest);
}

template <int D>
std::size_t Free_moves<D>::take_back_after(const Movable<D>& body, std::uint32_t vertex) {
  std::size_t count = 0;
  if (left_.empty()) return 0;
  for (const Corner& corner : body.topology.corners_of(vertex)) {
    const std::uint32_t v = corner.other;
    if (v < vertex || has(left_, v)) continue;
    left_[v / bits] |= std::uint64_t{1} << v % bits;
    body.positions[v] = before_[v];
    ++count;
  }
  return count;
}

template class Free_moves<2>;
template class Free_moves<3>;

}  // namespace cellwalk::detail
