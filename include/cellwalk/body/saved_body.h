// SPDX-License-Identifier: LGPL-3.0-or-later
// Registered bodies as bytes, from which they are restored without being located again: for checkpoints, and
// for copies in other processes.
#ifndef CELLWALK_BODY_SAVED_BODY_H
#define CELLWALK_BODY_SAVED_BODY_H

#include <cellwalk/body/body.h>

#include <cstddef>
#include <span>
#include <vector>

namespace cellwalk {

/// All parts of a body and of its registration: positions, edges, faces, particles, chains, the walls that
/// faces rest on, the regions free of walls and the vertices and edges that are stale in them. The same body
/// gives the same bytes. They are for the same version of the program on machines of the same byte order, and
/// carry a checksum.
/// \pre no edit since the body was registered
/// \throw Error(usage) if there was one
/// Cost: about that of a copy.
template <int D>
std::vector<std::byte> save(const Body<D>& body);

/// The body that was saved, in the same environment: the one in which it was, with no edit since, or a
/// compiled copy of that (compile_to_bytes()). From then on it does exactly what the saved body would have
/// done. So are its counts; but in a copy of an environment whose facets were opened or closed, those of
/// regions may be others.
/// \throw Error(input) for bytes that are no saved body, are damaged, or of another version or dimension, or
///        that do not fit the environment: a vertex is not in its cell, or an edge has no valid chain
/// Cost: that of Body::validate(), some 0.2 us a vertex and an edge; no point is located.
template <int D>
Body<D> restore_body(const Snapshot<D>& snapshot, std::span<const std::byte> bytes);

extern template std::vector<std::byte> save(const Body<2>&);
extern template std::vector<std::byte> save(const Body<3>&);
extern template Body<2> restore_body(const Snapshot<2>&, std::span<const std::byte>);
extern template Body<3> restore_body(const Snapshot<3>&, std::span<const std::byte>);

}  // namespace cellwalk

#endif  // CELLWALK_BODY_SAVED_BODY_H
