// SPDX-License-Identifier: LGPL-3.0-or-later
// Compiled environments: the arrays of a snapshot as bytes, which are used where they lie. A file of them is
// mapped into memory instead of read, and processes that map it share its pages. See docs/formats.md.
#ifndef CELLWALK_ENVIRONMENT_COMPILED_H
#define CELLWALK_ENVIRONMENT_COMPILED_H

#include <cellwalk/environment/certify.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/selection.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <variant>
#include <vector>

namespace cellwalk {

/// Bytes that last as long as their owner is held.
struct Held_bytes {
  std::span<std::byte> bytes;
  std::shared_ptr<const void> owner;
};

/// The content of an image.
template <int D>
struct Compiled_environment {
  Environment<D> environment;  ///< frozen; Environment::thaw() gives it a map
  Certificate certificate;     ///< of when the image was written
  Groups<D> groups;
};
/// of_dimension<3>(any) is the one of three dimensions, or an Error.
using Any_compiled_environment = std::variant<Compiled_environment<2>, Compiled_environment<3>>;

/// True if bytes begin as those of an image do.
bool is_compiled(std::span<const std::byte> bytes);

/// Writes an environment as bytes: all indices and names of cells, facets and points, those that edits left
/// unused, too, its epochs, and a checksum of each array. The same environment gives the same bytes.
/// \param certificate of the environment as it is now
/// \param put is called with one piece after the other
/// \pre no Reshaping of the environment is open
/// Cost: linear; about 20 ms for 10^6 tetrahedra, and the time of `put`.
template <int D>
void write_compiled(const Environment<D>& environment, const Certificate& certificate,
                    const Groups<D>& groups, const std::function<void(std::span<const std::byte>)>& put);

/// The same as one array.
template <int D>
std::vector<std::byte> compile_to_bytes(const Environment<D>& environment, const Certificate& certificate,
                                        const Groups<D>& groups);

/// Opens an image. Its arrays stay where they are; edits write there.
///
/// Checksums are compared, and it is tested, whoever made the image, that each index refers to something,
/// cells are convex, and that each facet between two is the same from both. Nothing reads beyond it then, and
/// motions end. The rest that makes answers right, Environment::certify() and then check_compiled() test.
/// \throw Error(input) for bytes that are no image, damaged, cut short, of another version or byte order; for
///   any number of threads the same one: the first test that fails, at the lowest cell where it does
/// \throw Error(usage) for bytes that do not begin at a multiple of 64
/// Cost: linear; about 50 ms for 10^6 tetrahedra by one thread, of which 10 are for reading each page once,
/// and 30 by two.
Any_compiled_environment open_compiled(Held_bytes image);

/// As above, from a buffer that is copied.
Any_compiled_environment open_compiled_copy(std::span<const std::byte> bytes);

/// Tests that the certificates of all cells, their planes, are those that compiling gives.
/// \pre Environment::certify() throws nothing
/// \throw Error(not_certified) naming the first cell that has others
/// Cost: linear, about 0.5 us a tetrahedron; memory of a second snapshot.
template <int D>
void check_compiled(const Environment<D>& environment);

extern template void write_compiled(const Environment<2>&, const Certificate&, const Groups<2>&,
                                    const std::function<void(std::span<const std::byte>)>&);
extern template void write_compiled(const Environment<3>&, const Certificate&, const Groups<3>&,
                                    const std::function<void(std::span<const std::byte>)>&);
extern template std::vector<std::byte> compile_to_bytes(const Environment<2>&, const Certificate&,
                                                        const Groups<2>&);
extern template std::vector<std::byte> compile_to_bytes(const Environment<3>&, const Certificate&,
                                                        const Groups<3>&);
extern template void check_compiled(const Environment<2>&);
extern template void check_compiled(const Environment<3>&);

}  // namespace cellwalk

#endif  // CELLWALK_ENVIRONMENT_COMPILED_H
