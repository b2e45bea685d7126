// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies read from files before a change, and their positions written after it.
#include "standing_bodies.h"

#include <cellwalk/internal/io/csv.h>
#include <cellwalk/io/body_file.h>
#include <cellwalk/loading/environment_file.h>
#include <cellwalk/walk/locate.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace cellwalk::cli {

template <int D>
Standing_bodies<D>::Standing_bodies(const std::vector<std::string>& files, const Snapshot<D>& snapshot) {
  if (files.empty()) return;
  const Locator<D> locator(snapshot);
  for (const std::string& file : files) {
    const io::Body_file<D> read = io::read_body<D>(file);
    naming(file, [&]() -> Body<D>& { return bodies_.emplace_back(snapshot, locator, read.body); });
    for (const std::string& note : read.report.notes) notes_.push_back(file + ": " + note);
  }
}

template <int D>
Residents<D> Standing_bodies<D>::residents() {
  Residents<D> result;
  for (Body<D>& body : bodies_) result.bodies.push_back(&body);
  return result;
}

template <int D>
void Standing_bodies<D>::write_positions(io::Atomic_file* file) const {
  if (file == nullptr) return;
  std::vector<std::string> columns{"body", "vertex", "x", "y", "z"};
  columns.resize(2 + D);
  io::Csv_writer table(*file, columns);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const auto all = bodies_[b].positions();
    for (std::size_t v = 0; v < all.size(); ++v)
      if constexpr (D == 2)
        table.row(b, v, all[v][0], all[v][1]);
      else
        table.row(b, v, all[v][0], all[v][1], all[v][2]);
  }
}

template <int D>
template <class Size>
std::size_t Standing_bodies<D>::sum(const Size& size) const {
  std::size_t result = 0;
  for (const Body<D>& body : bodies_) result += size(body);
  return result;
}

template <int D>
std::string Standing_bodies<D>::describe() const {
  return fmt::format("{} with {} vertices, {} edges, {} faces", bodies_.size(),
                     sum([](const Body<D>& body) { return body.vertex_count(); }),
                     sum([](const Body<D>& body) { return body.edges().size(); }),
                     sum([](const Body<D>& body) { return body.faces().size(); }));
}

template <int D>
nlohmann::ordered_json Standing_bodies<D>::to_json() const {
  nlohmann::ordered_json json{{"count", bodies_.size()},
                              {"vertices", sum([](const Body<D>& body) { return body.vertex_count(); })},
                              {"edges", sum([](const Body<D>& body) { return body.edges().size(); })},
                              {"faces", sum([](const Body<D>& body) { return body.faces().size(); })}};
  if (!notes_.empty()) json["notes"] = notes_;
  return json;
}

template class Standing_bodies<2>;
template class Standing_bodies<3>;

}  // namespace cellwalk::cli
