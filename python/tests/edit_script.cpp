// SPDX-License-Identifier: LGPL-3.0-or-later
// edit_script ENV OUT.ovm < SCRIPT: makes edits among bodies and particles in C++, and prints the same of
// each as test_edits_script.py does in Python.
#include <cellwalk/body/body.h>
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/loading/environment_file.h>
#include <cellwalk/records/body_soup.h>
#include <cellwalk/reshape/reshaping.h>
#include <cellwalk/walk/locate.h>

#include <cstdio>
#include <iostream>
#include <list>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace cellwalk;

template <int D>
class Script {
 public:
  explicit Script(Environment<D>& environment) : environment_(environment), locator_(snapshot()) {}

  /// A line of the script, answered by a line.
  void run(const std::string& line) {
    std::istringstream in(line);
    std::string word;
    in >> word;
    if (word == "body" || word == "particles") {
      place(word == "body", in);
      return;
    }
    if (!reshaping_) reshaping_.emplace(environment_, residents_);
    if (word == "open") say(reshaping_->open(facet(in)));
    if (word == "close") say(reshaping_->close(facet(in)));
    if (word == "excavate") say(reshaping_->excavate(cell(in)));
    if (word == "fill") say(reshaping_->fill(cell(in)));
    if (word == "insert_point") {
      const Cell at = cell(in);
      say(reshaping_->insert_point(at, point(in)));
    }
    if (word == "flip") say(reshaping_->flip(facet(in)));
    if (word == "split_edge") {
      const auto u = number(in), v = number(in);
      say(reshaping_->split_edge(u, v, point(in)));
    }
    if (word == "remove_edge" || word == "collapse") {
      const auto u = number(in), v = number(in);
      say(word == "collapse" ? reshaping_->collapse(u, v) : reshaping_->remove_edge(u, v));
    }
    if (word == "split_vertex") {
      const auto vertex = number(in);
      std::vector<Cell> cells(number(in));
      for (Cell& c : cells) c = cell(in);
      say(reshaping_->split_vertex(vertex, cells, point(in)));
    }
    if (word == "relax") {
      std::vector<std::uint32_t> points(number(in));
      for (std::uint32_t& p : points) p = number(in);
      Relax_options options;
      in >> options.good_enough >> options.most_operations;
      const Relax_report done = reshaping_->relax(points, options);
      std::printf("%u %u %u %u %u %u %u %a %a\n", done.smoothed, done.flipped, done.edges_removed, done.split,
                  done.collapsed, done.tried, done.rounds, done.least_before, done.least_after);
    }
    if (word == "cut") cut(in);
  }

  void end(const std::string& path) {
    if (reshaping_) reshaping_->finish();
    io::write_ovm(path, environment_.soup());
  }

 private:
  const Snapshot<D>& snapshot() const { return environment_.snapshot(); }

  static std::uint32_t number(std::istream& in) {
    std::uint32_t result = 0;
    in >> result;
    return result;
  }
  static Point<D> point(std::istream& in) {
    Point<D> result{};
    for (double& x : result) in >> x;
    return result;
  }
  Cell cell(std::istream& in) const { return snapshot().cell(number(in)); }
  Half_facet facet(std::istream& in) const {
    const Cell of = cell(in);
    return Snapshot<D>::half_facet(of, number(in));
  }

  void place(bool is_body, std::istream& in) {
    Body_parts<D> parts;
    for (Point<D> x = point(in); in; x = point(in)) parts.points.push_back(x);
    if (!is_body) {
      std::vector<Particle<D>>& all = particles_.emplace_back();
      for (const Point<D>& x : parts.points) all.push_back(locator_.particle_at(x).value());
      residents_.particles.emplace_back(all);
      return;
    }
    for (std::uint32_t i = 0; i + 1 < parts.points.size(); ++i) parts.segments.push_back({i, i + 1});
    residents_.bodies.push_back(
        &bodies_.emplace_back(snapshot(), locator_, make_body(std::move(parts)).body));
  }

  void say(const Outcome& result) const {
    std::printf("%d '%s'", result.is_made, result.reason.c_str());
    for (const Resident& r : result.held_by)
      std::printf(" (%d %u %d %u)", r.is_particle, r.owner, static_cast<int>(r.feature), r.number);
    std::printf("\n");
  }
  void say(const Replacement& result) const {
    std::printf("%d '%s' %d", result.is_made, result.reason.c_str(),
                result.point == Replacement::none ? -1 : static_cast<int>(result.point));
    for (const Cell c : result.cells) std::printf(" %u", snapshot().index(c));
    std::printf("\n");
  }

  void cut(std::istream& in) {
    std::vector<Point<D>> points(number(in));
    for (Point<D>& x : points) x = point(in);
    Cut_options<D> options;
    in >> options.opening >> options.snap;
    Blade<D> blade;
    std::string by;
    in >> by;
    if (by == "polygon") blade = blade_along<D>(points);
    if constexpr (D == 3)
      if (by == "sweep") blade = swept_blade(points, point(in) - Point<D>{});
    if (by == "pieces") {
      blade.points = points;
      blade.pieces.resize(number(in));
      for (auto& piece : blade.pieces)
        for (std::uint32_t& p : piece) p = number(in);
    }
    const Cut_report done = reshaping_->cut(blade, options);
    std::printf("%zu %zu %zu %zu %zu %zu %zu %zu", done.edges, done.split, done.snapped, done.refused(),
                done.facets, done.opened, done.rim, done.held);
    for (const Cut_point& p : done.points)
      std::printf(" (%u %u %u %a)", p.point, p.between[0], p.between[1], p.share);
    std::printf("\n");
  }

  Environment<D>& environment_;
  Locator<D> locator_;
  std::list<Body<D>> bodies_;
  std::list<std::vector<Particle<D>>> particles_;
  Residents<D> residents_;
  std::optional<Reshaping<D>> reshaping_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    Loaded_environment loaded = load_environment(argv[1], {.duplicates = Duplicate_vertices::keep});
    std::visit(
        [&]<int D>(Environment<D>& environment) {
          Script<D> script(environment);
          for (std::string line; std::getline(std::cin, line);) script.run(line);
          script.end(argv[2]);
        },
        loaded.environment);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
