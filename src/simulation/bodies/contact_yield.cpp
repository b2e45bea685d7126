// SPDX-License-Identifier: LGPL-3.0-or-later
// The depth of a contact, shared among the corners of its wall by their weights.
#include "contact_yield.h"

#include <algorithm>
#include <array>

namespace cellwalk::detail {
namespace {

/// The weights of the corners of a facet at a place near it, none of them negative, of sum 1.
std::array<double, 2> weights_at(const std::array<Point<2>, 2>& corners, const Point<2>& x) {
  const Vector<2> along = corners[1] - corners[0];
  const double share = std::clamp(dot(x - corners[0], along) / dot(along, along), 0.0, 1.0);
  return {1 - share, share};
}

std::array<double, 3> weights_at(const std::array<Point<3>, 3>& corners, const Point<3>& x) {
  const Vector<3> normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  std::array<double, 3> result;
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector<3> to_next = corners[(k + 1) % 3] - x, to_last = corners[(k + 2) % 3] - x;
    result[k] = std::max(0.0, dot(cross(to_next, to_last), normal));
    sum += result[k];
  }
  for (double& w : result) w /= sum;
  return result;
}

}  // namespace

template <int D>
void add_yields(const Snapshot<D>& snapshot, const World<D>& world, const Run_contact<D>& met, double share,
                Yields<D>& yields) {
  const Contact<D>& contact = met.contact;
  if (!met.body || contact.facet == Half_facet::none) return;
  const Moving_body<D>& body = world.bodies()[*met.body];
  const Vector<D> left = body.targets()[contact.vertex] - body.body().positions()[contact.vertex];
  const double depth = -dot(left, contact.normal);
  const std::vector<std::uint32_t> loop = snapshot.loop(contact.facet);
  if (!(depth > 0) || loop.size() != D) return;
  std::array<Point<D>, static_cast<std::size_t>(D)> corners;
  for (std::size_t k = 0; k < corners.size(); ++k) corners[k] = snapshot.point(loop[k]);
  const auto weights = weights_at(corners, contact.point);
  double squares = 0;
  for (const double w : weights) squares += w * w;
  if (!(squares > 0)) return;
  for (std::size_t k = 0; k < corners.size(); ++k)
    yields.emplace_back(loop[k], (-share * depth * weights[k] / squares) * contact.normal);
}

template void add_yields(const Snapshot<2>&, const World<2>&, const Run_contact<2>&, double, Yields<2>&);
template void add_yields(const Snapshot<3>&, const World<3>&, const Run_contact<3>&, double, Yields<3>&);

}  // namespace cellwalk::detail
