// SPDX-License-Identifier: LGPL-3.0-or-later
// One row for each change, with its place, its outcome and the reason of a refusal.
#include "changes_table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <limits>
#include <numeric>
#include <utility>

#include "contact_kind_names.h"

namespace cellwalk::cli {
namespace {

struct Change_words {
  const char *verb, *done, *thing;
};

/// By Change_kind.
constexpr std::array<Change_words, change_kind_count> change_words{{{"open", "opened", "facet"},
                                                                    {"close", "closed", "facet"},
                                                                    {"excavate", "excavated", "cell"},
                                                                    {"fill", "filled", "cell"},
                                                                    {"cut", "made", "cut"},
                                                                    {"sew", "sewn", "point"}}};

/// The mean of the vertices of a facet, or of a cell if there is none.
template <int D>
Point<D> place_of(const Snapshot<D>& snapshot, const Change_outcome& outcome) {
  Vector<D> sum{};
  std::size_t count = 0;
  const auto add = [&](const Point<D>& x) {
    sum = sum + (x - Point<D>{});
    ++count;
  };
  if (outcome.facet != Half_facet::none) {
    for (const std::uint32_t v : snapshot.loop(outcome.facet)) add(snapshot.point(v));
  } else {
    const Cell_view<D> view = snapshot.view(outcome.cell);
    for (std::size_t v = 0; v < view.vertex_count(); ++v) add(view.point(v));
  }
  return Point<D>{} + (1.0 / static_cast<double>(count)) * sum;
}

}  // namespace

template <int D>
Changes_table<D>::Changes_table(const Snapshot<D>& snapshot, io::Atomic_file& file) : snapshot_(snapshot) {
  table_.emplace(file, columns());
}

template <int D>
Changes_table<D>::Changes_table(const Snapshot<D>& snapshot, io::Csv_writer table)
    : snapshot_(snapshot), table_(std::move(table)) {}

template <int D>
const std::vector<std::string>& Changes_table<D>::columns() {
  static const std::vector<std::string> names{"step",     "change",  "kind",   "status", "cell",
                                              "facet",    "x",       "y",      "z",      "body",
                                              "particle", "feature", "number", "reason"};
  return names;
}

template <int D>
void Changes_table<D>::add(std::uint32_t step, const std::vector<Change_outcome>& outcomes) {
  for (const Change_outcome& outcome : outcomes) {
    // A stitch may have another point to go to when it is tried again.
    const std::uint64_t thing = outcome.stitch ? outcome.stitch->point : to_index(outcome.facet);
    const std::array<std::uint64_t, 3> what{outcome.change, thing, to_index(outcome.cell)};
    if (outcome.result.is_made) {
      ++made_[static_cast<std::size_t>(outcome.kind)];
      left_.erase(what);
    } else {
      ++refusals_;
      left_.insert(what);
    }
    if (outcome.cut) {
      cuts_.edges += outcome.cut->edges;
      cuts_.split += outcome.cut->split;
      cuts_.snapped += outcome.cut->snapped;
      cuts_.facets += outcome.cut->facets;
      cuts_.opened += outcome.cut->opened;
      cuts_.rim += outcome.cut->rim;
      cuts_.held += outcome.cut->held;
      cuts_.slit += outcome.cut->slit;
    }
    if (table_) write(step, outcome);
  }
}

template <int D>
void Changes_table<D>::write(std::uint32_t step, const Change_outcome& outcome) {
  // In the plane the third coordinate is left empty, as the writer does with numbers that are not finite.
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  // A cut has no place, nor has a facet or cell that a cut replaced.
  const bool has_cell = outcome.cell != Cell::none;
  Point<D> x;
  x.fill(nothing);
  if (has_cell) x = place_of(snapshot_, outcome);
  if (outcome.stitch) x = snapshot_.point(outcome.stitch->onto);
  const std::string cell = has_cell ? std::to_string(snapshot_.index(outcome.cell)) : "";
  const std::string facet =
      outcome.facet == Half_facet::none ? "" : std::to_string(snapshot_.facet_of(outcome.facet));
  const auto row = [&](const char* status, const std::string& body, const std::string& particle,
                       const char* feature, const std::string& number) {
    table_->row(step == 0 ? "" : std::to_string(step), outcome.change,
                change_words[static_cast<std::size_t>(outcome.kind)].verb, status, cell, facet, x[0], x[1],
                D == 3 ? x[D - 1] : nothing, body, particle, feature, number, outcome.result.reason);
  };
  if (outcome.result.is_made) return row("made", "", "", "", "");
  if (outcome.result.held_by.empty()) return row("refused", "", "", "", "");
  for (const Resident& held : outcome.result.held_by) {
    const std::string number = std::to_string(held.number);
    if (held.is_particle)
      row("refused", "", number, "", "");
    else
      row("refused", std::to_string(held.owner), "", feature_names[static_cast<std::size_t>(held.feature)],
          number);
  }
}

template <int D>
std::uint64_t Changes_table<D>::made() const {
  return std::accumulate(made_.begin(), made_.end(), std::uint64_t{0});
}

template <int D>
nlohmann::ordered_json Changes_table<D>::to_json() const {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (std::size_t k = 0; k < change_words.size(); ++k) json[change_words[k].done] = made_[k];
  if (cuts_.edges != 0)
    json["cuts"] = {{"edges", cuts_.edges},   {"split", cuts_.split},   {"snapped", cuts_.snapped},
                    {"facets", cuts_.facets}, {"parted", cuts_.opened}, {"rim", cuts_.rim},
                    {"held", cuts_.held},     {"slit", cuts_.slit}};
  json["refusals"] = refusals_;
  json["left"] = left_.size();
  return json;
}

template <int D>
std::string Changes_table<D>::describe() const {
  std::string text;
  for (std::size_t k = 0; k < change_words.size(); ++k)
    if (made_[k] != 0)
      text += fmt::format("{}{} {}{} {}", text.empty() ? "" : ", ", made_[k], change_words[k].thing,
                          made_[k] == 1 ? "" : "s", change_words[k].done);
  if (cuts_.edges != 0)
    text += fmt::format(
        " ({} edges passed: {} split, {} at an end; {} facets, {} vertices parted, {} at rims, {} held, {} "
        "facets of membranes slit)",
        cuts_.edges, cuts_.split, cuts_.snapped, cuts_.facets, cuts_.opened, cuts_.rim, cuts_.held,
        cuts_.slit);
  if (text.empty()) text = "none made";
  if (refusals_ != 0) text += fmt::format("; {} refused, {} of them to the end", refusals_, left_.size());
  return text;
}

template class Changes_table<2>;
template class Changes_table<3>;

}  // namespace cellwalk::cli
