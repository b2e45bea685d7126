// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies scaled, rotated and moved to where they start.
#ifndef CELLWALK_GENERATORS_TRANSFORM_H
#define CELLWALK_GENERATORS_TRANSFORM_H

#include <cellwalk/records/body_soup.h>

namespace cellwalk {

/// The body at its place; radii are scaled. Each coordinate is computed with 113 binary digits and rounded
/// once, so that it is the double nearest to the exact one but where that is nearly in the middle of two; the
/// same bits come out on every machine. A body that is only moved is exact where the sums are doubles, and
/// quarter turns about the coordinate axes are exact.
/// \throw Error(usage) unless the scale is a positive number, axis and angle are finite, the axis is not
///        zero, and the coordinates that come out are finite
/// Cost: about 1.3 us a vertex.
template <int D>
Body_soup<D> transformed(Body_soup<D> body, const Body_placement<D>& placement);

extern template Body_soup<2> transformed(Body_soup<2>, const Body_placement<2>&);
extern template Body_soup<3> transformed(Body_soup<3>, const Body_placement<3>&);

}  // namespace cellwalk

#endif  // CELLWALK_GENERATORS_TRANSFORM_H
