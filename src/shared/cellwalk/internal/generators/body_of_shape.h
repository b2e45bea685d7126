// SPDX-License-Identifier: LGPL-3.0-or-later
// The bodies of the shapes that scenes name.
#ifndef CELLWALK_INTERNAL_GENERATORS_BODY_OF_SHAPE_H
#define CELLWALK_INTERNAL_GENERATORS_BODY_OF_SHAPE_H

#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/internal/records/body_shape.h>

namespace cellwalk {

/// The body of any shape.
/// \throw Error(usage) as the function of that shape
Body_soup<2> generate_body(const Body_shape<2>& shape);
Body_soup<3> generate_body(const Body_shape<3>& shape);

}  // namespace cellwalk

#endif  // CELLWALK_INTERNAL_GENERATORS_BODY_OF_SHAPE_H
