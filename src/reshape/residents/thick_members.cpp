// SPDX-License-Identifier: LGPL-3.0-or-later
// Boxes of all within the radius of each member, in an R-tree.
#include "thick_members.h"

#include <cellwalk/internal/kernel/distance.h>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <utility>

namespace cellwalk::detail {
namespace {

namespace bg = boost::geometry;

template <int D>
using Tree_point = bg::model::point<double, D, bg::cs::cartesian>;
template <int D>
using Tree_box = bg::model::box<Tree_point<D>>;

template <int D>
Tree_point<D> to_tree(const Point<D>& x) {
  if constexpr (D == 2)
    return {x[0], x[1]};
  else
    return {x[0], x[1], x[2]};
}

template <int D>
Tree_box<D> to_tree(const Box<D>& box) {
  return {to_tree<D>(box.low), to_tree<D>(box.high)};
}

template <int D>
Tree_box<D> box_around(const Thick_member<D>& member) {
  Box<D> box;
  for (const Point<D>& x : member.points) box.extend(x);
  return to_tree<D>(enlarged(box, member.radius));
}

}  // namespace

template <int D>
struct Thick_members<D>::Tree {
  using Entry = std::pair<Tree_box<D>, std::uint32_t>;

  explicit Tree(const std::vector<Entry>& all) : entries(all) {}

  bg::index::rtree<Entry, bg::index::quadratic<16>> entries;
};

template <int D>
Thick_members<D>::Thick_members() = default;
template <int D>
Thick_members<D>::~Thick_members() = default;

template <int D>
void Thick_members<D>::add(Thick_member<D> member) {
  members_.push_back(std::move(member));
  tree_.reset();
}

/// If memory runs out, the tree is made anew when it is needed.
template <int D>
void Thick_members<D>::move(Member vertex, const Point<D>& to) noexcept {
  for (std::uint32_t i = 0; i < members_.size(); ++i) {
    Thick_member<D>& member = members_[i];
    if (member.member.group != vertex.group) continue;
    const auto corner = std::ranges::find(member.corners, vertex.number);
    if (corner == member.corners.end()) continue;
    const Tree_box<D> before = box_around<D>(member);
    member.points[static_cast<std::size_t>(corner - member.corners.begin())] = to;
    if (!tree_) continue;
    try {
      tree_->entries.remove({before, i});
      tree_->entries.insert({box_around<D>(member), i});
    } catch (...) {
      tree_.reset();
    }
  }
}

template <int D>
std::vector<const Thick_member<D>*> Thick_members<D>::near(const Box<D>& box) {
  std::vector<const Thick_member<D>*> result;
  if (members_.empty()) return result;
  if (!tree_) {
    std::vector<typename Tree::Entry> all;
    for (const Thick_member<D>& member : members_)
      all.emplace_back(box_around<D>(member), static_cast<std::uint32_t>(all.size()));
    tree_ = std::make_unique<Tree>(all);
  }
  for (auto found = tree_->entries.qbegin(bg::index::intersects(to_tree<D>(box)));
       found != tree_->entries.qend(); ++found)
    result.push_back(&members_[found->second]);
  std::ranges::sort(result);
  return result;
}

template <int D>
std::vector<const Thick_member<D>*> Thick_members<D>::nearer_to(std::span<const Point<D>> hull) {
  Box<D> box;
  for (const Point<D>& x : hull) box.extend(x);
  std::vector<const Thick_member<D>*> result = near(box);
  Distance_counts uncounted;
  std::erase_if(result, [&](const Thick_member<D>* member) {
    Vector<D> direction{};
    return is_apart<D>(member->hull(), hull, member->radius, direction, uncounted);
  });
  return result;
}

template class Thick_members<2>;
template class Thick_members<3>;

}  // namespace cellwalk::detail
