// SPDX-License-Identifier: LGPL-3.0-or-later
#include "answers.h"

#include <cellwalk/body/body.h>
#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/edge/sweep_along.h>
#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/reshape/reshaping.h>

#include <fmt/format.h>

#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <variant>

#include "case.h"

namespace cellwalk::corpus {
namespace {

/// An answer: the first contact, if any.
struct Row {
  bool is_contact = false;
  std::size_t move = 0;
  std::string time;
};

std::string text_of(const Exact_time& time) {
  std::ostringstream text;
  text << to_rational(time);
  return text.str();
}

template <int D>
class Answerer {
 public:
  explicit Answerer(const std::filesystem::path& file)
      : soup_(std::get<Cell_soup<D>>(io::read_ovm(file).mesh)),
        environment_(Environment<D>::build(soup_, {.duplicates = Duplicate_vertices::keep})),
        locator_(environment_.snapshot()) {}

  Row answer(const Case<D>& c, Touch touch) const {
    if (c.moves_wall) return moving_wall(c);
    return c.points.size() == 1 ? walk(c, touch) : body(c, touch);
  }

 private:
  Row walk(const Case<D>& c, Touch touch) const {
    const Snapshot<D>& snapshot = environment_.snapshot();
    Edge_counts counts;
    Particle<D> p = locator_.particle_at(c.side.empty() ? c.points[0] : c.side[0]).value();
    if (!c.side.empty() && move(snapshot, p, c.points[0], counts.walk).contact)
      throw std::runtime_error(c.id + ": the point does not come to its start");
    std::optional<Contact<D>> contact;
    if (touch == Touch::stop) {
      contact = first_touch(snapshot, p, c.moves[0].to, counts);
    } else {
      const Walk_result<D> result = cellwalk::walk(snapshot, p, c.moves[0].to, counts.walk);
      if (result.contact)
        contact = vertex_contact(snapshot, c.points[0], c.moves[0].to, *result.contact, counts.walk);
    }
    if (!contact) return {};
    return {true, 0, text_of(contact->exact_time())};
  }

  Row body(const Case<D>& c, Touch touch) const {
    Body_soup<D> soup;
    soup.points = c.side.empty() ? c.points : c.side;
    for (std::uint32_t v = 1; v < soup.points.size(); ++v)
      for (std::uint32_t u = 0; u < v; ++u) soup.edges.push_back({u, v});
    std::sort(soup.edges.begin(), soup.edges.end());
    if (soup.points.size() == 3) soup.faces = {{0, 1, 2}};
    Body<D> body(environment_.snapshot(), locator_, soup);
    Body_options options;
    options.sweep.sweep = soup.faces.empty() ? Sweep::triangle : Sweep::faces;
    Body_counts counts;
    for (std::uint32_t v = static_cast<std::uint32_t>(c.side.size()); v-- > 0;)
      if (body.move_vertex(v, c.points[v], options, counts))
        throw std::runtime_error(c.id + ": the body does not come to its start");
    options.sweep.touch = touch;
    for (std::size_t m = 0; m < c.moves.size(); ++m)
      if (const auto contact = body.move_vertex(c.moves[m].vertex, c.moves[m].to, options, counts))
        return {true, m, text_of(contact->exact_time())};
    return {};
  }

  /// Each in an environment of its own, as walls do not go back.
  Row moving_wall(const Case<D>& c) const {
    Environment<D> environment =
        Environment<D>::build(soup_, {.duplicates = Duplicate_vertices::keep, .simplicial = true});
    Body<D> body(environment.snapshot(), Locator<D>(environment.snapshot()), {c.points, {{0, 1}}, {}});
    Reshaping<D> reshaping(environment, {{&body}, {}}, {.at_contact = At_contact::hold});
    const Vertex_result<D> result = reshaping.move(c.moves[0].vertex, c.moves[0].to);
    if (result.end == Move_end::reached) return {};
    if (result.end != Move_end::contact) throw std::runtime_error(c.id + ": the vertex cannot move");
    return {true, 0, text_of(result.hit->exact_time())};
  }

  Cell_soup<D> soup_;
  Environment<D> environment_;
  Locator<D> locator_;
};

template <int D>
Row answer_in(std::map<std::string, std::unique_ptr<Answerer<D>>>& worlds,
              const std::filesystem::path& folder, const nlohmann::ordered_json& json, Touch touch) {
  const std::string name = json.at("world");
  auto& world = worlds[name];
  if (!world) world = std::make_unique<Answerer<D>>(folder / "worlds" / (name + ".ovm"));
  return world->answer(question<D>(json), touch);
}

}  // namespace

void answer(const std::filesystem::path& folder, Touch touch, const std::filesystem::path& table) {
  std::map<std::string, std::unique_ptr<Answerer<2>>> worlds_2;
  std::map<std::string, std::unique_ptr<Answerer<3>>> worlds_3;
  io::Csv_writer rows(table, {"id", "answer", "move", "time"});
  std::vector<const char*> files{"walks.jsonl", "sweeps.jsonl", "faces.jsonl"};
  // Walls that move have no Touch::stop.
  if (touch == Touch::pass) files.push_back("moving_walls.jsonl");
  for (const char* file : files) {
    std::ifstream lines(folder / file);
    if (!lines) throw std::runtime_error(fmt::format("{}: cannot be read", (folder / file).string()));
    for (std::string line; std::getline(lines, line);) {
      const auto json = nlohmann::ordered_json::parse(line);
      const bool is_flat = json.at("points").at(0).size() == 2;
      const Row row =
          is_flat ? answer_in<2>(worlds_2, folder, json, touch) : answer_in<3>(worlds_3, folder, json, touch);
      const std::string id = json.at("id");
      if (row.is_contact)
        rows.row(id, "contact", row.move, row.time);
      else
        rows.row(id, "free", "", "");
    }
  }
  rows.commit();
}

}  // namespace cellwalk::corpus
