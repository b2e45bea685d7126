// SPDX-License-Identifier: LGPL-3.0-or-later
// The columns and rows of the table of answers, in 2D and 3D.
#include "answers.h"

#include <array>
#include <limits>
#include <string>
#include <tuple>

#include "cli/common/contact_kind_names.h"

namespace cellwalk::cli {
namespace {

/// A missing value, which is an empty field of a table.
constexpr double absent = std::numeric_limits<double>::quiet_NaN();

/// Three fields, without negative zeros; in 2D the third is empty.
template <std::size_t D>
std::array<double, 3> fields(const std::array<double, D>& p) {
  std::array<double, 3> f{absent, absent, absent};
  std::transform(p.begin(), p.end(), f.begin(), [](double x) { return x + 0.0; });
  return f;
}

}  // namespace

std::vector<std::string> answer_columns(bool of_edges, bool has_radii) {
  std::vector<std::string> columns{"row",  "status", "time", "x",  "y",     "z",
                                   "kind", "nx",     "ny",   "nz", "cells", "cell"};
  if (of_edges) columns.insert(columns.begin() + 7, "body");
  if (has_radii) columns.emplace_back("distance");
  return columns;
}

template <int D, std::size_t N>
void write_answers(io::Csv_writer& table, std::size_t first, const Snapshot<D>& snapshot,
                   std::span<const Query_row<D, N>> rows, const std::vector<Answer<D>>& answers,
                   bool has_radii) {
  constexpr bool has_body = N == 3;
  for (std::size_t row = 0; row < answers.size(); ++row) {
    const Answer<D>& answer = answers[row];
    double time = absent;
    std::array<double, 3> end{absent, absent, absent}, normal = end;
    const char *kind = "", *body = "";
    if (answer.status == Motion_status::free) {
      time = 1;
      end = fields(rows[row].points[1]);
    } else if (const auto& contact = answer.contact) {
      end = fields(contact->point);
      if (answer.status == Motion_status::contact) {
        time = contact->time;
        normal = fields(contact->normal);
      }
      kind = contact_kind_names[static_cast<std::size_t>(contact->kind)];
      body = feature_names[static_cast<std::size_t>(contact->body)];
    }
    const std::string cell =
        answer.cell == Cell::none ? std::string{} : std::to_string(snapshot.index(answer.cell));
    const auto write = [&](const auto& body_field, const auto& distance_field) {
      std::apply(
          [&](const auto&... values) { table.row(values...); },
          std::tuple_cat(std::tuple(first + row, motion_status_names[static_cast<std::size_t>(answer.status)],
                                    time, end[0], end[1], end[2], kind),
                         body_field, std::tuple(normal[0], normal[1], normal[2], answer.cells, cell),
                         distance_field));
    };
    const auto write_with = [&](const auto& distance_field) {
      if constexpr (has_body)
        write(std::tuple(body), distance_field);
      else
        write(std::tuple<>(), distance_field);
    };
    if (has_radii)
      write_with(std::tuple(answer.status == Motion_status::close ? answer.contact->distance : absent));
    else
      write_with(std::tuple<>());
  }
}

template void write_answers(io::Csv_writer&, std::size_t, const Snapshot<2>&,
                            std::span<const Query_row<2, 2>>, const std::vector<Answer<2>>&, bool);
template void write_answers(io::Csv_writer&, std::size_t, const Snapshot<3>&,
                            std::span<const Query_row<3, 2>>, const std::vector<Answer<3>>&, bool);

template void write_answers(io::Csv_writer&, std::size_t, const Snapshot<2>&,
                            std::span<const Query_row<2, 3>>, const std::vector<Answer<2>>&, bool);
template void write_answers(io::Csv_writer&, std::size_t, const Snapshot<3>&,
                            std::span<const Query_row<3, 3>>, const std::vector<Answer<3>>&, bool);

}  // namespace cellwalk::cli
