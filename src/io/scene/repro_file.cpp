// SPDX-License-Identifier: LGPL-3.0-or-later
// The cells of an environment as JSON, and the coordinates of a motion as hexadecimal numbers.
#include <cellwalk/internal/io/json_file.h>
#include <cellwalk/internal/io/repro_file.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <string_view>
#include <vector>

#include "io/files/text.h"
#include "json_node.h"

namespace cellwalk::io {
namespace {

using detail::Json_node;

/// The latter has a radius.
constexpr const char *thin_format = "cellwalk motion 1", *thick_format = "cellwalk motion 2";

/// Facets with their vertices, in 2D the corners of a cell in order, and their wall marks.
template <int D>
nlohmann::ordered_json to_json(const Cell_soup<D>& soup, std::size_t cell) {
  auto facets = nlohmann::ordered_json::array(), walls = nlohmann::ordered_json::array();
  for (std::uint32_t f = soup.cell_begin[cell]; f < soup.cell_begin[cell + 1]; ++f) {
    facets.push_back(std::vector<std::uint32_t>(soup.facet(f).begin(), soup.facet(f).end()));
    if (soup.impassable[f]) walls.push_back(f - soup.cell_begin[cell]);
  }
  nlohmann::ordered_json result{{"facets", facets}};
  if (!walls.empty()) result["walls"] = walls;
  if (soup.solid[cell]) result["solid"] = true;
  return result;
}

template <int D>
void add_cell(const Json_node& node, Cell_soup<D>& soup) {
  node.expect_keys({"facets", "walls", "solid"});
  const std::size_t first = soup.facet_count();
  for (const Json_node& facet : node.at("facets").elements()) {
    std::vector<std::uint32_t> loop;
    for (const Json_node& v : facet.elements())
      loop.push_back(static_cast<std::uint32_t>(v.integer_in(0, soup.points.size() - 1)));
    if (D == 2 ? loop.size() != 2 : loop.size() < 3)
      facet.fail(D == 2 ? "expected 2 vertices" : "expected 3 vertices or more");
    soup.add_facet(loop);
  }
  const std::size_t facets = soup.facet_count() - first;
  if (facets <= D) node.at("facets").fail("a cell has more facets");
  if (const auto walls = node.find("walls"))
    for (const Json_node& wall : walls->elements())
      soup.impassable[first + wall.integer_in(0, facets - 1)] = 1;
  const auto solid = node.find("solid");
  soup.end_cell(solid && solid->boolean());
}

template <int D>
Repro<D> repro(const Json_node& root) {
  Repro<D> record;
  record.kernel = root.at("kernel").string();
  record.strategy = root.at("strategy").string();
  if (const auto note = root.find("note")) record.note = note->string();
  record.from = root.at("from").tuple<D>();
  record.to = root.at("to").tuple<D>();
  if (root.at("format").string() == thick_format) {
    const Json_node radius = root.at("radius");
    record.radius = radius.number();
    if (record.radius < 0) radius.fail(fmt::format("expected a number of at least 0, not {}", record.radius));
  }
  for (const Json_node& point : root.at("points").elements()) record.soup.points.push_back(point.tuple<D>());
  if (record.soup.points.empty()) root.at("points").fail("expected points");
  for (const Json_node& cell : root.at("cells").elements()) add_cell(cell, record.soup);
  if (record.soup.cell_count() == 0) root.at("cells").fail("expected cells");
  if (const auto cell = root.find("cell"))
    record.cell = static_cast<std::uint32_t>(cell->integer_in(0, record.soup.cell_count() - 1));
  return record;
}

}  // namespace

template <int D>
void write_repro(Atomic_file& file, const Repro<D>& record) {
  const bool is_thick = record.radius != 0;
  nlohmann::ordered_json json{{"format", is_thick ? thick_format : thin_format},
                              {"dimension", D},
                              {"note", record.note},
                              {"kernel", record.kernel},
                              {"strategy", record.strategy},
                              {"from", record.from},
                              {"to", record.to}};
  if (is_thick) json["radius"] = record.radius;
  if (record.cell) json["cell"] = *record.cell;
  json["points"] = record.soup.points;
  json["cells"] = nlohmann::ordered_json::array();
  for (std::size_t c = 0; c < record.soup.cell_count(); ++c) json["cells"].push_back(to_json(record.soup, c));
  write_json(file, json);
}

template <int D>
void write_repro(const std::filesystem::path& path, const Repro<D>& record) {
  Atomic_file file(path);
  write_repro(file, record);
  file.commit();
}

template void write_repro(Atomic_file&, const Repro<2>&);
template void write_repro(Atomic_file&, const Repro<3>&);
template void write_repro(const std::filesystem::path&, const Repro<2>&);
template void write_repro(const std::filesystem::path&, const Repro<3>&);

Any_repro parse_repro(const std::string& name, std::string_view text) {
  const auto document = detail::parse_json(name, text);
  const Json_node root(*document, name);
  const std::string format = root.at("format").string();
  if (format != thin_format && format != thick_format)
    root.at("format").fail(fmt::format("expected \"{}\" or \"{}\"", thin_format, thick_format));
  std::vector<std::string_view> keys{"format", "dimension", "note",   "kernel", "strategy",
                                     "from",   "to",        "points", "cells",  "cell"};
  if (format == thick_format) keys.push_back("radius");
  root.expect_keys(keys);
  if (root.at("dimension").integer_in(2, 3) == 2) return repro<2>(root);
  return repro<3>(root);
}

Any_repro read_repro(const std::filesystem::path& path) { return parse_repro(path.string(), load(path)); }

}  // namespace cellwalk::io
