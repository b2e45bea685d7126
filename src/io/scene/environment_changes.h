// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: parts of an environment, and changes of them.
#ifndef CELLWALK_IO_SCENE_ENVIRONMENT_CHANGES_H
#define CELLWALK_IO_SCENE_ENVIRONMENT_CHANGES_H

#include <cellwalk/internal/records/environment_change.h>

#include "json_node.h"

namespace cellwalk::io::detail {

/// `{"box": ...}` or `{"ball": ...}`.
/// \throw Error(input) naming the key
template <int D>
Scene_shape<D> shape(const Json_node& node);

/// The keys `groups` and `changes` of an object; none if it has neither.
/// \param most_steps the greatest step of a change; 0: they have no steps
/// \throw Error(input) naming the key
template <int D>
Environment_changes<D> changes(const Json_node& node, std::uint64_t most_steps);

extern template Scene_shape<2> shape(const Json_node&);
extern template Scene_shape<3> shape(const Json_node&);
extern template Environment_changes<2> changes(const Json_node&, std::uint64_t);
extern template Environment_changes<3> changes(const Json_node&, std::uint64_t);

}  // namespace cellwalk::io::detail

#endif  // CELLWALK_IO_SCENE_ENVIRONMENT_CHANGES_H
