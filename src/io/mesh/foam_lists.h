// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: the lists of numbers, points and faces of an OpenFOAM mesh, as text or binary.
#ifndef CELLWALK_IO_MESH_FOAM_LISTS_H
#define CELLWALK_IO_MESH_FOAM_LISTS_H

#include <cellwalk/kernel/point.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "foam_reader.h"

namespace cellwalk::io {

/// The labels that a list may hold.
struct Label_range {
  std::string_view what;    ///< "points of a face", in errors
  std::int64_t first, end;  ///< the least, and the one after the greatest
};

/// Labels of what is counted elsewhere: 32 bits hold them.
inline constexpr std::int64_t end_of_labels = std::numeric_limits<std::uint32_t>::max();

/// Appends a list of labels, of which -1 becomes the greatest number of 32 bits.
/// \param most_equal the greatest length of a list in the form N{value}, since nothing else bounds that
/// \throw Error(input) with the place of a label out of range, or where the list is broken
void append_labels(Foam_reader& in, const Label_range& range, std::size_t most_equal,
                   std::vector<std::uint32_t>& to);

/// A list of labels that is all that follows.
std::vector<std::uint32_t> read_labels(Foam_reader& in, const Label_range& range, std::size_t most_equal);

std::vector<Point<3>> read_foam_points(Foam_reader& in);

/// Loops of points, in flat arrays.
struct Foam_faces {
  std::vector<std::uint32_t> begin{0};  ///< points of face f: [begin[f], begin[f+1])
  std::vector<std::uint32_t> points;

  std::size_t size() const { return begin.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t f) const {
    return {points.data() + begin[f], points.data() + begin[f + 1]};
  }
};

/// Faces of at least three points, as a list of lists or, as binary files have them, in compact form.
Foam_faces read_foam_faces(Foam_reader& in, std::size_t point_count);

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_FOAM_LISTS_H
