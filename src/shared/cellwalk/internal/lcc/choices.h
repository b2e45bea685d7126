// SPDX-License-Identifier: LGPL-3.0-or-later
// The sides of walls that a motion on a map takes where it has a choice, and the search for those on which it
// gets furthest. Theory: docs/walk.md, choices.
#ifndef CELLWALK_INTERNAL_LCC_CHOICES_H
#define CELLWALK_INTERNAL_LCC_CHOICES_H

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace cellwalk::lcc::detail {

/// A ridge or vertex after which a motion may go on along several sides of walls.
template <class Dart_of>
struct Choice {
  Dart_of class_name;  ///< of the cells linked there
  bool is_vertex;
  std::size_t sides;      ///< as many
  std::size_t taken = 0;  ///< in the order of preference

  bool is_at_place_of(const Choice& other) const {
    return class_name == other.class_name && is_vertex == other.is_vertex;
  }
};

/// The choices of one motion, in order, and those of all tries before it.
template <class Dart_of>
class Choices {
 public:
  /// The side to take at the next choice of the walk: the first where none was set before.
  std::size_t take(const Choice<Dart_of>& choice) {
    if (passed_ == taken_.size()) taken_.push_back(choice);
    return taken_[passed_++].taken;
  }

  bool empty() const { return taken_.empty(); }

  /// Sets another side at the last choice that leaves one, for the next walk; false if none does. Where the
  /// walk came to a choice for the second time, all that follows was tried then, or will be.
  bool take_next() {
    for (; known_ < taken_.size(); ++known_) {
      Choice<Dart_of>& choice = taken_[known_];
      const auto is_same = [&](const auto& other) { return choice.is_at_place_of(other); };
      if (std::any_of(seen_.begin(), seen_.end(), is_same))
        choice.sides = 1;
      else
        seen_.push_back(choice);
    }
    while (!taken_.empty() && taken_.back().taken + 1 >= taken_.back().sides) taken_.pop_back();
    known_ = taken_.size();
    passed_ = 0;
    if (taken_.empty()) return false;
    ++taken_.back().taken;
    return true;
  }

 private:
  boost::container::small_vector<Choice<Dart_of>, 4> taken_;
  std::vector<Choice<Dart_of>> seen_;
  std::size_t passed_ = 0;  ///< by the walk
  std::size_t known_ = 0;   ///< choices that were looked up among those seen
};

}  // namespace cellwalk::lcc::detail

#endif  // CELLWALK_INTERNAL_LCC_CHOICES_H
