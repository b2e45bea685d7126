// SPDX-License-Identifier: LGPL-3.0-or-later
// The small parts of an image: shapes, free slots and names, groups, the certificate.
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>

#include "environment_image.h"

namespace cellwalk::detail {
namespace {

/// The counts of a certificate, in the order of the image.
template <class C>
auto counts_of(C& c) {
  return std::array{&c.cells, &c.facets,          &c.ridges,    &c.vertices,   &c.solid_cells,
                    &c.walls, &c.boundary_facets, &c.membranes, &c.components, &c.pinched_vertices};
}

/// Reads a list from its beginning to its end.
template <class T>
class List_reader {
 public:
  explicit List_reader(std::span<const T> list) : rest_(list) {}

  bool is_at_end() const { return rest_.empty(); }
  std::span<const T> take(std::size_t count) {
    if (count > rest_.size()) refuse_image("a list ends too early");
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }
  T take() { return take(1)[0]; }

 private:
  std::span<const T> rest_;
};

void put_shape(std::vector<std::uint16_t>& list, const Cell_shape& shape) {
  list.push_back(shape.vertex_count);
  list.push_back(static_cast<std::uint16_t>(shape.facet_count()));
  list.insert(list.end(), shape.loop_begin.begin(), shape.loop_begin.end());
  list.insert(list.end(), shape.loops.begin(), shape.loops.end());
}

Cell_shape take_shape(List_reader<std::uint16_t>& list) {
  Cell_shape shape;
  shape.vertex_count = list.take();
  const auto begins = list.take(list.take() + std::size_t{1});
  shape.loop_begin.assign(begins.begin(), begins.end());
  const auto loops = list.take(shape.loop_begin.back());
  shape.loops.assign(loops.begin(), loops.end());
  return shape;
}

template <class Name>
void put_names(std::vector<std::uint32_t>& list, const std::vector<Name>& names) {
  list.push_back(static_cast<std::uint32_t>(names.size()));
  for (const Name name : names) list.push_back(to_index(name));
}

constexpr std::size_t words_of(std::size_t bytes) { return (bytes + 3) / 4; }

template <int D>
std::vector<std::uint32_t> list_of(const Groups<D>& groups) {
  std::vector<std::uint32_t> list;
  for (const auto& [name, selection] : groups) {
    list.push_back(static_cast<std::uint32_t>(name.size()));
    const std::size_t first = list.size();
    list.resize(first + words_of(name.size()));
    std::memcpy(list.data() + first, name.data(), name.size());
    put_names(list, selection.facets);
    put_names(list, selection.cells);
  }
  return list;
}

template <int D>
Groups<D> groups_of(const Snapshot<D>& snapshot, const std::vector<std::uint32_t>& from) {
  Groups<D> groups;
  List_reader<std::uint32_t> list(from);
  while (!list.is_at_end()) {
    const std::uint32_t bytes = list.take();
    const auto words = list.take(words_of(bytes));
    std::string name(bytes, '\0');
    std::memcpy(name.data(), words.data(), bytes);
    Selection<D> selection;
    for (const std::uint32_t facet : list.take(list.take())) {
      if (facet >= snapshot.half_facet_slots() || !snapshot.is_cell(snapshot.cell_of(Half_facet{facet})) ||
          snapshot.facet_of(Half_facet{facet}) >= snapshot.facet_count(snapshot.cell_of(Half_facet{facet})))
        refuse_image("a group names a facet that is not there");
      selection.facets.push_back(Half_facet{facet});
    }
    for (const std::uint32_t cell : list.take(list.take())) {
      if (!snapshot.is_cell(Cell{cell})) refuse_image("a group names a cell that is not there");
      selection.cells.push_back(Cell{cell});
    }
    if (!groups.emplace(std::move(name), std::move(selection)).second)
      refuse_image("two groups have one name");
  }
  return groups;
}

}  // namespace

void refuse_image(const char* what) {
  throw Error(Error_code::input, std::string("this compiled environment is damaged: ") + what +
                                     "; make it again, by `cellwalk import`");
}

template <int D>
Image_lists<D> Environment_image<D>::lists(const Environment<D>& environment, const Certificate& certificate,
                                           const Groups<D>& groups) {
  const Snapshot<D>& s = *environment.snapshot_;
  Image_state<D> state;
  std::copy(s.frame_.centre.begin(), s.frame_.centre.end(), state.frame_centre.begin());
  state.frame_scale = s.frame_.scale;
  state.uncertified_planes = s.uncertified_planes_;
  state.uniform_blocks = s.uniform_blocks_;
  state.epoch = s.epoch_;
  state.geometry_epoch = s.geometry_epoch_;
  state.allow_duplicates = environment.allow_duplicates_ ? 1 : 0;
  std::ranges::transform(counts_of(certificate), state.counts.begin(), [](const auto* n) { return *n; });
  state.volume = certificate.volume;
  state.free_volume = certificate.free_volume;

  Image_lists<D> lists;
  lists.state = {state};
  for (const Cell_shape& shape : s.shapes_) put_shape(lists.shapes, shape);
  for (const auto& [length, first] : s.free_blocks_) lists.free_blocks.push_back({length, first});
  for (const auto& [length, first] : s.free_vertices_) lists.free_vertices.push_back({length, first});
  lists.free_indices.assign(s.free_indices_.begin(), s.free_indices_.end());
  lists.free_points.assign(s.free_points_.begin(), s.free_points_.end());
  lists.groups = list_of<D>(groups);
  return lists;
}

template <int D>
Compiled_environment<D> Environment_image<D>::assemble(Snapshot<D> s, const Image_lists<D>& lists) {
  if (lists.state.size() != 1) refuse_image("it has no state");
  const Image_state<D>& state = lists.state[0];
  std::copy(state.frame_centre.begin(), state.frame_centre.end(), s.frame_.centre.begin());
  s.frame_.scale = state.frame_scale;
  s.uncertified_planes_ = state.uncertified_planes;
  s.uniform_blocks_ = state.uniform_blocks;
  s.epoch_ = state.epoch;
  s.geometry_epoch_ = state.geometry_epoch;
  for (List_reader<std::uint16_t> list(lists.shapes); !list.is_at_end();)
    s.shapes_.push_back(take_shape(list));
  for (const Image_run run : lists.free_blocks) s.free_blocks_.emplace(run.length, run.first);
  for (const Image_run run : lists.free_vertices) s.free_vertices_.emplace(run.length, run.first);
  s.free_indices_.insert(lists.free_indices.begin(), lists.free_indices.end());
  s.free_points_.insert(lists.free_points.begin(), lists.free_points.end());
  check(s);

  Groups<D> groups = groups_of(s, lists.groups);
  Certificate certificate;
  std::size_t k = 0;
  for (std::size_t* const count : counts_of(certificate)) *count = state.counts[k++];
  certificate.volume = state.volume;
  certificate.free_volume = state.free_volume;
  Environment<D> environment;
  *environment.snapshot_ = std::move(s);
  environment.allow_duplicates_ = state.allow_duplicates != 0;
  return {std::move(environment), certificate, std::move(groups)};
}

template Image_lists<2> Environment_image<2>::lists(const Environment<2>&, const Certificate&,
                                                    const Groups<2>&);
template Image_lists<3> Environment_image<3>::lists(const Environment<3>&, const Certificate&,
                                                    const Groups<3>&);
template Compiled_environment<2> Environment_image<2>::assemble(Snapshot<2>, const Image_lists<2>&);
template Compiled_environment<3> Environment_image<3>::assemble(Snapshot<3>, const Image_lists<3>&);

}  // namespace cellwalk::detail
