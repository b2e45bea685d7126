// SPDX-License-Identifier: LGPL-3.0-or-later
// Tables of queries.
#ifndef CELLWALK_INTERNAL_IO_QUERY_FILE_H
#define CELLWALK_INTERNAL_IO_QUERY_FILE_H

#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/records/queries.h>

#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

namespace cellwalk::io {

/// Points from columns named PREFIXx, PREFIXy and, in 3D, PREFIXz. Other columns are ignored. Rows with a
/// malformed number, a number that is not finite or a fraction that is not a double, or with a wrong number
/// of fields, are returned with the reason.
/// \throw Error(input) if a column is missing, or if the table has z and the dimension is 2
template <int D, std::size_t N>
std::vector<Query_row<D, N>> query_rows(const Csv_table& table,
                                        const std::array<std::string_view, N>& prefixes);

/// Motions of points: columns ax,ay,az,bx,by,bz (2D: without z).
/// \throw Error(input) as above
template <int D>
std::vector<Move_query<D>> read_moves(const std::filesystem::path& path, const Table_part& part = {}) {
  return query_rows<D, 2>(Csv_table::read(path, part), {"a", "b"});
}

/// Motions of edges: columns px,py,pz,tx,ty,tz,qx,qy,qz (2D: without z); p moves to t, q stands still.
/// \throw Error(input) as above
template <int D>
std::vector<Sweep_query<D>> read_sweeps(const std::filesystem::path& path, const Table_part& part = {}) {
  return query_rows<D, 3>(Csv_table::read(path, part), {"p", "t", "q"});
}

extern template std::vector<Query_row<2, 1>> query_rows(const Csv_table&,
                                                        const std::array<std::string_view, 1>&);
extern template std::vector<Query_row<3, 1>> query_rows(const Csv_table&,
                                                        const std::array<std::string_view, 1>&);
extern template std::vector<Query_row<2, 2>> query_rows(const Csv_table&,
                                                        const std::array<std::string_view, 2>&);
extern template std::vector<Query_row<3, 2>> query_rows(const Csv_table&,
                                                        const std::array<std::string_view, 2>&);
extern template std::vector<Query_row<2, 3>> query_rows(const Csv_table&,
                                                        const std::array<std::string_view, 3>&);
extern template std::vector<Query_row<3, 3>> query_rows(const Csv_table&,
                                                        const std::array<std::string_view, 3>&);

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_QUERY_FILE_H
