// SPDX-License-Identifier: LGPL-3.0-or-later
// Steps by the rule of traces.
#ifndef CELLWALK_TESTS_BODY_REJECTING_H
#define CELLWALK_TESTS_BODY_REJECTING_H

#include <cellwalk/body/body.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <span>

namespace cellwalk::test {

inline Body_options rejecting(Sweep sweep, Touch touch, bool clearance) {
  Body_options options;
  options.sweep.sweep = sweep;
  options.sweep.touch = touch;
  options.clearance = clearance;
  options.rule = Step_rule::reject_at_target;
  options.reports_blocked = true;
  return options;
}

/// What blocks, and the contacts, which a copy of the body reports.
template <int D>
Step_report<D> reject(Body<D>& body, std::span<const Point<D>> targets, const Body_options& options,
                      Body_counts& counts) {
  Step_report<D> report;
  Body<D> copy = body;
  Body_options with_contacts = options;
  with_contacts.reports_blocked = false;
  Body_counts of_copy;
  copy.step(targets, with_contacts, report, of_copy);
  body.step(targets, options, report, counts);
  EXPECT_TRUE(std::ranges::equal(copy.positions(), body.positions()));
  return report;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_BODY_REJECTING_H
