// SPDX-License-Identifier: LGPL-3.0-or-later
// Double positions just before a contact, in the order in which they are tried.
#ifndef CELLWALK_INTERNAL_BODY_STOP_CANDIDATES_H
#define CELLWALK_INTERNAL_BODY_STOP_CANDIDATES_H

#include <cellwalk/walk/contact.h>

#include <functional>

namespace cellwalk::detail {

/// Offers positions to `try_at` until it returns true: the exact point p(s) with each coordinate rounded up
/// or down, along the normal of the contact first, and towards p across it; the point rounded towards p,
/// shifted along the normal by 1, 2, 4 .. 1024 ulp of its largest coordinate, at the origin of p's; then
/// p(s (1 - 2^-k)) for k = 20 .. 1. s is the time of the contact.
/// False if it never does.
/// \pre the contact is not at time 0
template <int D>
bool try_stops(const Point<D>& p, const Point<D>& target, const Contact<D>& contact,
               const std::function<bool(const Point<D>&)>& try_at);

/// The distance between doubles of the size of a point's largest coordinate.
template <int D>
double ulp(const Point<D>& p);

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_BODY_STOP_CANDIDATES_H
