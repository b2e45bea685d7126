// SPDX-License-Identifier: LGPL-3.0-or-later
// One row for each move, the counts of their ends, and the same as JSON.
#include "results.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <limits>

#include "cli/common/contact_kind_names.h"
#include "cli/common/counts_json.h"

namespace cellwalk::cli {
namespace {

/// The number of an empty field.
constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

template <int D>
std::vector<std::string> columns_of_moves() {
  if constexpr (D == 2)
    return {"row",     "status", "time", "x",  "y",  "kind", "body",
            "feature", "number", "cx",   "cy", "nx", "ny",   "cell"};
  else
    return {"row",    "status", "time", "x",  "y",  "z",  "kind", "body", "feature",
            "number", "cx",     "cy",   "cz", "nx", "ny", "nz",   "cell"};
}

/// The share of its way that a point can go; no_value where it is not known.
template <int D>
double time_of(const Vertex_result<D>& result) {
  switch (result.end) {
    case Move_end::reached:
      return 1;
    case Move_end::cell:
      return result.share;
    default:
      return result.hit ? result.hit->time : no_value;
  }
}

}  // namespace

template <int D>
Move_results<D>::Move_results(io::Atomic_file* file, const Snapshot<D>& snapshot) : snapshot_(snapshot) {
  if (file != nullptr) table_.emplace(*file, columns_of_moves<D>());
}

template <int D>
void Move_results<D>::add(const Vertex_result<D>& result) {
  const std::size_t row = count_++, end = static_cast<std::size_t>(result.end);
  ++ends_[end];
  if (!table_) return;
  const char *kind = "", *feature = "";
  std::string body, number;
  Vector<D> normal;
  normal.fill(no_value);
  Point<D> place;
  place.fill(no_value);
  Cell cell = result.cell;
  if (const auto& hit = result.hit) {
    kind = contact_kind_names[static_cast<std::size_t>(hit->kind)];
    body = std::to_string(hit->resident.owner);
    feature = feature_names[static_cast<std::size_t>(hit->resident.feature)];
    number = std::to_string(hit->resident.number);
    for (std::size_t k = 0; k < D; ++k) normal[k] = hit->normal[k] + 0.0;  // without negative zeros
    place = hit->point;
    cell = snapshot_.cell_of(hit->facet);
  }
  const std::string in_cell = cell == Cell::none ? std::string{} : std::to_string(snapshot_.index(cell));
  const Point<D>& x = result.position;
  const Point<D>& c = place;
  const Vector<D>& n = normal;
  const char* const status = move_end_names[end];
  if constexpr (D == 2)
    table_->row(row, status, time_of(result), x[0], x[1], kind, body, feature, number, c[0], c[1], n[0], n[1],
                in_cell);
  else
    table_->row(row, status, time_of(result), x[0], x[1], x[2], kind, body, feature, number, c[0], c[1], c[2],
                n[0], n[1], n[2], in_cell);
}

template <int D>
std::string describe_moves(const Move_results<D>& results, const Standing_bodies<D>& bodies,
                           const Reshape_counts& counts) {
  std::string text;
  const auto line = [&text](const char* name, const std::string& value) {
    text += fmt::format("  {:<12}{}\n", name, value);
  };
  std::string ends;
  for (std::size_t e = 0; e < results.ends().size(); ++e)
    if (results.ends()[e] != 0)
      ends += fmt::format("{} {} {}", ends.empty() ? ":" : ",", results.ends()[e], move_end_names[e]);
  line("moves", fmt::format("{}{}", results.count(), ends));
  line("work", fmt::format("{} moves tried, with {} cells around their points", counts.moves, counts.cells));
  if (bodies.empty()) return text;
  line("bodies", bodies.describe());
  line("near",
       fmt::format("{} walls; {} vertices, {} edges, {} faces: {} in the same cell, {} along the same chain, "
                   "{} apart from the walls, {} let go by them, {} hit, {} touched",
                   counts.walls, counts.vertices, counts.edges, counts.faces, counts.same_cell,
                   counts.same_chain, counts.apart, counts.left, counts.hits, counts.touches));
  if (counts.pushes != 0) line("pushes", std::to_string(counts.pushes));
  for (const std::string& note : bodies.notes()) line("note", note);
  return text;
}

template <int D>
nlohmann::ordered_json moves_json(const Move_results<D>& results, const Standing_bodies<D>& bodies,
                                  const Reshape_counts& counts) {
  nlohmann::ordered_json json{{"moves", results.count()}};
  for (std::size_t e = 0; e < results.ends().size(); ++e)
    json["status"][move_end_names[e]] = results.ends()[e];
  json["bodies"] = bodies.to_json();
  json["counts"] = to_json(counts);
  json["counts"]["walk"] = to_json(counts.walk);
  return json;
}

template class Move_results<2>;
template class Move_results<3>;
template std::string describe_moves(const Move_results<2>&, const Standing_bodies<2>&, const Reshape_counts&);
template std::string describe_moves(const Move_results<3>&, const Standing_bodies<3>&, const Reshape_counts&);
template nlohmann::ordered_json moves_json(const Move_results<2>&, const Standing_bodies<2>&,
                                           const Reshape_counts&);
template nlohmann::ordered_json moves_json(const Move_results<3>&, const Standing_bodies<3>&,
                                           const Reshape_counts&);

}  // namespace cellwalk::cli
