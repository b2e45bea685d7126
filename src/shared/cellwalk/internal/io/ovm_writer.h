// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells in OpenVolumeMesh, written into a file that the caller commits.
#ifndef CELLWALK_INTERNAL_IO_OVM_WRITER_H
#define CELLWALK_INTERNAL_IO_OVM_WRITER_H

#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/io/mesh_file.h>

namespace cellwalk::io {

/// Writes into a file that the caller commits.
template <int D>
void write_ovm(Atomic_file& file, const Cell_soup<D>& soup, const Soup_groups& groups = {});

extern template void write_ovm<2>(Atomic_file&, const Cell_soup<2>&, const Soup_groups&);
extern template void write_ovm<3>(Atomic_file&, const Cell_soup<3>&, const Soup_groups&);

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_OVM_WRITER_H
