// SPDX-License-Identifier: LGPL-3.0-or-later
// The parts of an environment that an image has, and an environment made of them.
#ifndef CELLWALK_ENVIRONMENT_ENVIRONMENT_IMAGE_H
#define CELLWALK_ENVIRONMENT_ENVIRONMENT_IMAGE_H

#include <cellwalk/environment/compiled.h>
#include <cellwalk/internal/environment/cell_check.h>
#include <cellwalk/internal/environment/environment_history.h>
#include <cellwalk/internal/environment/image_format.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace cellwalk::detail {

/// A run of slots: its length, and its first one.
struct Image_run {
  std::uint32_t length = 0, first = 0;
  bool operator==(const Image_run&) const = default;
};

/// The small parts, in the form that an image has them.
template <int D>
struct Image_lists {
  std::vector<Image_state<D>> state;  ///< one
  /// Of each shape: the number of its vertices and of its facets, the begins of loops, the loops.
  std::vector<std::uint16_t> shapes;
  std::vector<Image_run> free_blocks, free_vertices;
  std::vector<std::uint32_t> free_indices, free_points;
  /// Of each group: the bytes of its name, these in words, its facets and its cells, with their numbers
  /// before.
  std::vector<std::uint32_t> groups;
};

template <int D>
class Environment_image {
 public:
  /// Calls visit(name, array) for the large arrays of a snapshot, in the order of the image.
  /// \tparam S Snapshot<D>, const or not
  template <class S, class Visit>
  static void for_each_array(S& snapshot, const Visit& visit) {
    visit("planes", snapshot.planes_);
    visit("links", snapshot.links_);
    visit("vertex_begin", snapshot.vertex_begin_);
    visit("shape", snapshot.shape_);
    visit("index", snapshot.index_);
    visit("vertices", snapshot.vertices_);
    visit("cell_of_index", snapshot.cell_of_index_);
    visit("points", snapshot.points_);
  }
  /// The same for the lists.
  template <class Lists, class Visit>
  static void for_each_list(Lists& lists, const Visit& visit) {
    visit("state", lists.state);
    visit("shapes", lists.shapes);
    visit("free_blocks", lists.free_blocks);
    visit("free_vertices", lists.free_vertices);
    visit("free_indices", lists.free_indices);
    visit("free_points", lists.free_points);
    visit("groups", lists.groups);
  }

  static Image_lists<D> lists(const Environment<D>& environment, const Certificate& certificate,
                              const Groups<D>& groups);
  /// \param snapshot has its arrays
  /// \throw Error(input) if an index refers to nothing
  static Compiled_environment<D> assemble(Snapshot<D> snapshot, const Image_lists<D>& lists);

  /// The state that is not in arrays and lists.
  static Environment_history history(const Environment<D>& environment);
  /// \throw Error(input) for that of another environment
  static void follow(Environment<D>& environment, const Environment_history& history);

  /// \throw Error(input) naming the problem
  static void check(const Snapshot<D>& snapshot);
  /// A copy whose planes are made anew.
  static Snapshot<D> certified_again(const Snapshot<D>& snapshot);
  /// True if both have the same planes at a cell.
  static bool has_same_planes(const Snapshot<D>& a, const Snapshot<D>& b, Cell cell);

 private:
  static void check_frame(const Snapshot<D>& snapshot);
  static void check_sizes(const Snapshot<D>& snapshot);
  static void check_shapes(const Snapshot<D>& snapshot);
  static void check_blocks(const Snapshot<D>& snapshot);
  static void check_links(const Snapshot<D>& snapshot);
  static void check_cell(const Snapshot<D>& snapshot, std::uint32_t block);
  static bool is_sound_tetrahedron(const Snapshot<D>& snapshot, std::uint32_t block);
  static void check_facet(const Snapshot<D>& snapshot, Cell own, std::size_t i);
  static bool is_sound_facet(const Snapshot<D>& snapshot, std::uint32_t facet, std::uint32_t tetrahedron);
  static std::ptrdiff_t check_links_of(const Snapshot<D>& snapshot, std::uint32_t begin, std::uint32_t end,
                                       std::uint32_t tetrahedron);
  static std::size_t other_side(const Snapshot<D>& snapshot, Cell own, std::size_t i, Cell beyond);
  static void check_free(const Snapshot<D>& snapshot);
};

[[noreturn]] void refuse_image(const char* what);

}  // namespace cellwalk::detail

#endif  // CELLWALK_ENVIRONMENT_ENVIRONMENT_IMAGE_H
