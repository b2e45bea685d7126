// SPDX-License-Identifier: LGPL-3.0-or-later
#include "plain_walk.h"

#include <algorithm>

#include "plain_steps.h"

namespace cellwalk::track_lengths {
namespace {

constexpr std::size_t rays_of_block = 1024;
/// Of a walk that ends; rays cross less than a quarter of it.
constexpr unsigned most_steps = 500;

template <class Real>
void walk_on_this_processor(const Plain_mesh<Real>& mesh, const Plain_ray* rays, unsigned count,
                            unsigned together, const Plain_rows& rows) {
#if defined(CELLWALK_HAS_FUSED_WALK)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return fused_walk(mesh, rays, count, together, rows);
#endif
  follow(mesh, rays, count, together, rows);
}

}  // namespace

template <class Real>
void Plain_walker<Real>::take(const Rays& rays) {
  rays_.clear();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Point<3>&a = rays.starts[i].position, &b = rays.targets[i];
    rays_.push_back({{a[0], a[1], a[2]}, {b[0], b[1], b[2]}, to_index(rays.starts[i].cell)});
  }
}

template <class Real>
void Plain_walker<Real>::run(Peer_rows& rows) const {
  const Plain_mesh<Real> mesh{tables_.planes.data(),
                              reinterpret_cast<const unsigned(*)[4]>(tables_.neighbours.data()), most_steps};
  std::array<std::size_t, Peer_rows::most_lists> used{};
  rows.rows.resize(rays_.size());
  std::array<unsigned char, rays_of_block> list{};
  std::array<unsigned long, rays_of_block> begin{}, end{};
  std::array<Plain_end, rays_of_block> how{};
  for (std::size_t first = 0; first < rays_.size(); first += rays_of_block) {
    const std::size_t count = std::min(rays_of_block, rays_.size() - first);
    Plain_rows to{{}, list.data(), begin.data(), end.data(), how.data()};
    for (std::size_t i = 0; i < together_; ++i) {
      Peer_rows::List& of = rows.lists[i];
      const std::size_t room = used[i] + rays_of_block * most_steps;
      if (of.cells.size() < room) {
        of.cells.resize(2 * room);
        of.lengths.resize(2 * room);
      }
      to.lists[i] = {of.cells.data() + used[i], of.lengths.data() + used[i]};
    }
    walk_on_this_processor(mesh, rays_.data() + first, static_cast<unsigned>(count), together_, to);
    const std::array<std::size_t, Peer_rows::most_lists> before = used;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = before[list[i]];
      rows.rows[first + i] = {static_cast<Peer_row::End>(how[i]), list[i], at + begin[i], at + end[i]};
      used[list[i]] = std::max(used[list[i]], at + end[i]);
    }
  }
}

template class Plain_walker<double>;
template class Plain_walker<float>;

}  // namespace cellwalk::track_lengths
