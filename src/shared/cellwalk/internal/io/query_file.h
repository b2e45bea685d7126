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

/// Points from columns named PREFIXx, PREFIXy and, in 3D, PREFIXz; radii of motions from a column `radius`,
/// if there is one. Motions of points have the prefixes a and b, those of edges p, t and q. Other columns are
/// ignored. Rows with a malformed number, a number that is not finite or a fraction that is not a double, a
/// negative radius, or a wrong number of fields, are returned with the reason.
/// \param radius of all rows where the table has none
/// \throw Error(input) if a column is missing, or if the table has z and the dimension is 2
template <int D, std::size_t N>
std::vector<Query_row<D, N>> query_rows(const Csv_table& table,
                                        const std::array<std::string_view, N>& prefixes, double radius = 0);

/// The radius of a row: a finite number of at least 0, or the reason why there is none.
Parsed_number radius_of(const Csv_table& table, std::size_t row, std::size_t column);

extern template std::vector<Query_row<2, 1>> query_rows(const Csv_table&,
                                                        const std::array<std::string_view, 1>&, double);
extern template std::vector<Query_row<3, 1>> query_rows(const Csv_table&,
                                                        const std::array<std::string_view, 1>&, double);
extern template std::vector<Query_row<2, 2>> query_rows(const Csv_table&,
                                                        const std::array<std::string_view, 2>&, double);
extern template std::vector<Query_row<3, 2>> query_rows(const Csv_table&,
                                                        const std::array<std::string_view, 2>&, double);
extern template std::vector<Query_row<2, 3>> query_rows(const Csv_table&,
                                                        const std::array<std::string_view, 3>&, double);
extern template std::vector<Query_row<3, 3>> query_rows(const Csv_table&,
                                                        const std::array<std::string_view, 3>&, double);

}  // namespace cellwalk::io

#endif  // CELLWALK_INTERNAL_IO_QUERY_FILE_H
