// SPDX-License-Identifier: LGPL-3.0-or-later
// The numbers behind a figure, and what must hold for it to be drawn.
#ifndef CELLWALK_EXPERIMENTS_FIGURES_NUMBERS_H
#define CELLWALK_EXPERIMENTS_FIGURES_NUMBERS_H

#include <cellwalk/internal/edge/may_intersect.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/walk/contact.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace cellwalk::figures {

using Json = nlohmann::ordered_json;

/// \throw Error(other) if a claim of a figure does not hold
void require(bool holds, const std::string& claim);

/// A time as a fraction: "9/16".
std::string text_of(const Exact_time& time);

/// The fraction, and the double that it is reported as.
Json to_json(const Exact_time& time);

/// Time, point and normal, the feature of the body, and the points of that of the environment.
template <int D>
Json to_json(const Snapshot<D>& snapshot, const Contact<D>& contact);

/// The cells that meet a closed triangle and are reached from `start`.
template <int D>
std::vector<Cell> cells_met(const Snapshot<D>& snapshot, Cell start, const Swept_triangle<D>& triangle);

/// Their indices in the input, ascending, each once.
template <int D>
Json to_json(const Snapshot<D>& snapshot, const std::vector<Cell>& cells);

}  // namespace cellwalk::figures

#endif  // CELLWALK_EXPERIMENTS_FIGURES_NUMBERS_H
