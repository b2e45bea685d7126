// SPDX-License-Identifier: LGPL-3.0-or-later
// All certificates of bodies, none, and each alone.
#ifndef CELLWALK_TESTS_BODY_CERTIFICATE_SETS_H
#define CELLWALK_TESTS_BODY_CERTIFICATE_SETS_H

#include <cellwalk/internal/body/certificates.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cellwalk::test {

struct Certificate_set {
  const char* name;
  bool clearance;
  detail::Body_certificates of_body;
  bool of_edges;
  /// What is counted more often where they decide than where there are none.
  std::uint64_t (*counted)(const Body_counts&);

  Body_options chosen(Body_options options) const {
    options.clearance = clearance;
    options.sweep.certificates = of_edges;
    return options;
  }
};

/// The first set is the empty one. Where regions for parts of a body are asked for, bodies of any size have
/// them.
inline std::vector<Certificate_set> certificate_sets() {
  constexpr std::size_t any = 1, never = ~std::size_t{0};
  constexpr detail::Body_certificates no_others{false, false, false, false, never};
  constexpr bool none = false, all = true;
  const auto in_region = [](const Body_counts& c) { return c.in_region; };
  const auto same_chain = [](const Body_counts& c) { return c.edges.same_chain; };
  return {
      {"none", false, no_others, none, in_region},
      {"all", true, {}, all, in_region},
      {"all, in bodies of any size", true, {true, true, true, true, any, 0}, all, in_region},
      {"region of the body", true, {true, false, false, false, never}, none, in_region},
      {"region of the body by clusters", true, {true, false, true, false, any, 0}, none, in_region},
      {"regions of stars", true, {false, true, false, false, any, 0}, none, in_region},
      {"regions of stars by clusters", true, {false, true, true, false, any, 0}, none, in_region},
      {"chains in place", false, {false, false, false, true, never}, all, same_chain},
      {"same chain", false, no_others, all, same_chain},
  };
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_BODY_CERTIFICATE_SETS_H
