// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies that are registered again after edits. Theory: docs/bodies.md, registration.
#ifndef CELLWALK_BODY_REGISTRATION_REGISTER_AGAIN_H
#define CELLWALK_BODY_REGISTRATION_REGISTER_AGAIN_H

#include <memory>

#include "body/body_state.h"

namespace cellwalk::detail {

/// A body where it stands, in the environment as it is now.
/// \throw Error(outside) as Body::register_again() does
template <int D>
std::unique_ptr<Body_state<D>> registered_again(const Body_state<D>& body, const Locator<D>& locator);

extern template std::unique_ptr<Body_state<2>> registered_again(const Body_state<2>&, const Locator<2>&);
extern template std::unique_ptr<Body_state<3>> registered_again(const Body_state<3>&, const Locator<3>&);

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_REGISTRATION_REGISTER_AGAIN_H
