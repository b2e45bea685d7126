// SPDX-License-Identifier: LGPL-3.0-or-later
// The option of the edge length, and the numbers of cells of edges as a sentence and as JSON.
#include "edge_cells.h"

#include <cellwalk/internal/loading/report.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace cellwalk::cli {
namespace {

std::string sentence(const Edge_cells& edges) {
  const auto number = [](double value) { return fmt::format("{:.3g}", value); };
  if (edges.wall_distance == 0) return "no free space";
  const std::string found =
      edges.edges == 0 ? "do not fit" : fmt::format("lie in {:.2f} cells on average", edges.cells);
  return fmt::format("of length {} {}; walls are {} apart", number(edges.length), found,
                     number(edges.wall_distance));
}

}  // namespace

void add_edge_length(CLI::App& command, double& length) {
  command
      .add_option("--edge-length", length,
                  "Length of the edges of bodies whose cells the summary counts, in units of the environment")
      ->check(number_from(least_size, "greater than 0"))
      ->default_str("a tenth of the mean distance between walls")
      ->type_name("L");
}

std::string summary(const std::string& path, const Certificate& certificate, int dimension,
                    const Edge_cells& edges) {
  return fmt::format("{}: certified, {}D\n{}  {:<12}{}\n", path, dimension, describe(certificate, dimension),
                     "body edges", sentence(edges));
}

nlohmann::ordered_json to_json(const Edge_cells& edges) {
  return {{"length", edges.length},    {"wall_distance", edges.wall_distance},
          {"edges", edges.edges},      {"blocked", edges.blocked},
          {"mean_cells", edges.cells}, {"standard_error", edges.standard_error}};
}

}  // namespace cellwalk::cli
