// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernels under test: a number policy with a strategy of the walk.
#ifndef CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_KERNELS_H
#define CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_KERNELS_H

#include <cellwalk/kernel/policies.h>
#include <cellwalk/walk/strategy.h>

#include <array>

#include "policies.h"

namespace cellwalk::exact_float {

template <int D>
using Walk_function = Walk_result<D> (*)(const Snapshot<D>&, const Particle<D>&, const Point<D>&,
                                         Walk_counts&, Walk_strategy, const Walk_options&);

template <int D>
struct Kernel {
  const char* name;
  const char* policy;  ///< as `cellwalk query --kernel` has it; null: only this experiment has it
  Walk_strategy strategy;
  bool is_exact;
  Walk_function<D> walk;
};

inline constexpr std::size_t kernel_count = 13;

/// exact: float planes with an error bound, then filtered signs (the default of the library); exact_signs:
/// filtered signs only.
template <int D>
std::array<Kernel<D>, kernel_count> kernels() {
  constexpr auto certified = Walk_strategy::certified, rule = Walk_strategy::exit_rule;
  return {{{"exact", "exact", certified, true, walk<Exact, D>},
           {"exact_signs", "exact", rule, true, walk<Exact, D>},
           {Adaptive::name, nullptr, rule, true, walk<Adaptive, D>},
           {Epick::name, nullptr, rule, true, walk<Epick, D>},
           {"lazy", "lazy", rule, true, walk<Lazy, D>},
           {"rational", "rational", rule, true, walk<Unfiltered, D>},
           {"double", "double", rule, false, walk<Double, D>},
           {Cartesian::name, nullptr, rule, false, walk<Cartesian, D>},
           {"double_16u", "double_16u", rule, false, walk<Scale_free, D>},
           {"double_1e-9", "double_1e-9", rule, false, walk<Tolerant, D>},
           {Long_double::name, nullptr, rule, false, walk<Long_double, D>},
           {Double_double::name, nullptr, rule, false, walk<Double_double, D>},
           {"float", "float", rule, false, walk<Float, D>}}};
}

}  // namespace cellwalk::exact_float

#endif  // CELLWALK_EXPERIMENTS_EXACT_VERSUS_FLOAT_KERNELS_H
