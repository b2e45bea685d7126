// SPDX-License-Identifier: LGPL-3.0-or-later
// A picture of bodies among walls.
#ifndef CELLWALK_DRAWING_DRAW_H
#define CELLWALK_DRAWING_DRAW_H

#include <cellwalk/body/body.h>
#include <cellwalk/environment/environment.h>

#include <string>
#include <vector>

namespace cellwalk {

/// Draws the walls of an environment, translucent in 3D, with bodies and contacts, whose normals are arrows.
/// \param bodies not null; their positions are those where they stand now
/// \param file a PNG of 1600 x 1000 pixels; replaced if it is there
/// \throw Error(other) if the file cannot be written
/// Degenerate cases: of large environments and bodies only a share is drawn.
/// Cost: about a second, and up to 300 MB of memory.
template <int D>
void draw(const Snapshot<D>& snapshot, const std::vector<const Body<D>*>& bodies,
          const std::vector<Contact<D>>& contacts, const std::string& file);
template <int D>
void draw(const Environment<D>& environment, const std::vector<const Body<D>*>& bodies,
          const std::vector<Contact<D>>& contacts, const std::string& file) {
  draw(environment.snapshot(), bodies, contacts, file);
}

extern template void draw(const Snapshot<2>&, const std::vector<const Body<2>*>&,
                          const std::vector<Contact<2>>&, const std::string&);
extern template void draw(const Snapshot<3>&, const std::vector<const Body<3>*>&,
                          const std::vector<Contact<3>>&, const std::string&);

}  // namespace cellwalk

#endif  // CELLWALK_DRAWING_DRAW_H
