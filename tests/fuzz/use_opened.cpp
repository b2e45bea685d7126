// SPDX-License-Identifier: LGPL-3.0-or-later
#include "fuzz/use_opened.h"

#include <cellwalk/body/body.h>
#include <cellwalk/internal/query/kernel_choice.h>
#include <cellwalk/query/query.h>
#include <cellwalk/reshape/reshaping.h>

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "fuzz/move_about.h"
#include "fuzz/targets.h"

namespace cellwalk::fuzz {
namespace {

Used opened_totals;

/// So much of each kind for an input.
constexpr std::size_t most_motions = 3, most_steps = 3, most_changes = 6, most_edits_of_opened = 4;

/// Any point that a motion may start from or go to; cells need not be what they seem.
template <int D>
Point<D> place_in(const Snapshot<D>& snapshot, Decoder& in) {
  Point<D> x;
  for (double& coordinate : x) coordinate = in.coordinate();
  const std::uint8_t kind = in.byte();
  if (kind % 4 == 3 || snapshot.cell_slots() == 0) return x;
  const Cell c = snapshot.cell(in.below(snapshot.cell_slots()));
  if (c == Cell::none) return x;
  const Cell_view<D> cell = snapshot.view(c);
  x = cell.point(in.below(cell.vertex_count()));
  if (kind % 4 == 2) return x;
  const std::size_t corners = kind % 4 == 1 ? 1 : cell.vertex_count();
  for (std::size_t i = 0; i < corners; ++i)
    x = combination<D>(x, cell.point(kind % 4 == 1 ? in.below(cell.vertex_count()) : i),
                       kind % 4 == 1 ? 0.5 : 1 / (2.0 + static_cast<double>(i)));
  return x;
}

template <int D>
class Use {
 public:
  Use(Environment<D>& environment, Decoder& in)
      : environment_(environment), snapshot_(environment.snapshot()), in_(in) {}

  void run() {
    attempt([&] { environment_.soup(); });
    attempt([&] { count_edge_cells(snapshot_, {.edges = 16}); });
    attempt([&] { locator_ = std::make_unique<Locator<D>>(snapshot_); });
    if (!locator_) return;
    for (std::size_t i = 0; i < most_motions; ++i) {
      attempt([&] { ask_motion(); });
      attempt([&] { ask_sweep(); });
    }
    attempt([&] { add_body(); });
    attempt([&] { add_body(); });
    for (std::size_t i = 0; i < most_steps; ++i) attempt([&] { step(); });
    attempt([&] { environment_.thaw(); });
    attempt([&] { reshape(); });
    for (std::size_t i = 0; i < most_edits_of_opened; ++i) attempt([&] { edit(); });
    attempt([&] { environment_.compact(); });
    attempt([&] { environment_.certify(); });
    attempt([&] { environment_.soup(); });
  }

 private:
  template <class Work>
  static void attempt(const Work& work) {
    const bool is_done = reads(work, {Error_code::other, Error_code::usage, Error_code::input,
                                      Error_code::not_certified, Error_code::outside});
    opened_totals.contradictions += is_done ? 0 : 1;
  }

  Point<D> place() { return place_in(snapshot_, in_); }

  Sweep_options sweep_options(Search_options& search) {
    Sweep_options options;
    options.sweep = static_cast<Sweep>(in_.below(3));
    options.touch = in_.flag() ? Touch::stop : Touch::pass;
    options.search = take_search(in_, search);
    return options;
  }

  void ask_motion() {
    Edge_counts counts;
    Walk_method method;
    method.kernel = static_cast<Kernel_choice>(in_.below(7));
    method.strategy = static_cast<Walk_strategy>(in_.below(3));
    const Touch touch = in_.flag() ? Touch::stop : Touch::pass;
    const Point<D> from = place(), to = place();
    answer_move(snapshot_, *locator_, from, to, {}, counts);
    ++opened_totals.motions;
    answer_move(snapshot_, *locator_, from, to, touch, method, counts);
  }

  void ask_sweep() {
    Edge_counts counts;
    const Edge_motion<D> motion{place(), place(), place()};
    answer_sweep(snapshot_, *locator_, motion, {}, counts);
    ++opened_totals.sweeps;
    Search_options search;
    answer_sweep(snapshot_, *locator_, motion, sweep_options(search), counts);
  }

  /// A path, or in space also a triangle with its face.
  void add_body() {
    Body_soup<D> soup;
    const std::size_t n = 2 + in_.below(3);
    const Point<D> first = place(), other = place();
    const double size = in_.flag() ? 1 : 0.125;
    for (std::uint32_t i = 0; i < n; ++i) {
      soup.points.push_back(combination<D>(first, i % 2 ? place() : other, i == 0 ? 0 : size));
      if (i > 0) soup.edges.push_back({i - 1, i});
    }
    if (D == 3 && n > 2) {
      soup.edges.insert(soup.edges.begin() + 1, {0, 2});
      soup.faces.push_back({0, 1, 2});
    }
    bodies_.push_back(std::make_unique<Body<D>>(snapshot_, *locator_, soup));
    ++opened_totals.bodies;
    particles_.push_back(bodies_.back()->particles()[0]);
  }

  void step() {
    for (const auto& body : bodies_) {
      std::vector<Point<D>> targets(body->positions().begin(), body->positions().end());
      const Point<D> to = place();
      for (Point<D>& x : targets) x = combination<D>(x, to, in_.flag() ? 1 : 0.25);
      Body_options options;
      Search_options search;
      options.sweep = sweep_options(search);
      options.clearance = in_.flag();
      options.rule = in_.flag() ? Step_rule::reject : Step_rule::slide;
      if (in_.flag()) options.rule = Step_rule::reject_at_target;
      Step_report<D> report;
      Body_counts counts;
      body->step(targets, options, report, counts);
      ++opened_totals.steps;
      body->validate();
      restore_body(snapshot_, save(*body)).validate();
    }
    Walk_counts counts;
    for (Particle<D>& particle : particles_) move(snapshot_, particle, place(), counts);
  }

  void reshape() {
    Residents<D> residents;
    for (const auto& body : bodies_) residents.bodies.push_back(body.get());
    residents.particles = {std::span(particles_)};
    constexpr std::array rules{At_contact::hold, At_contact::stop, At_contact::push};
    Reshaping<D> reshaping(environment_, residents, {.at_contact = rules[in_.below(rules.size())]});
    for (std::size_t i = 0; i < most_changes; ++i)
      attempt([&] {
        change(reshaping);
        ++opened_totals.changes;
      });
    reshaping.finish();
  }

  std::uint32_t point() { return static_cast<std::uint32_t>(in_.below(snapshot_.points().size())); }
  Cell cell() { return Cell{static_cast<std::uint32_t>(in_.below(snapshot_.half_facet_slots() / 4))}; }
  Half_facet facet() {
    return Half_facet{static_cast<std::uint32_t>(in_.below(snapshot_.half_facet_slots()))};
  }
  Point<D> middle_of(Cell c) {
    Point<D> x{};
    if (!snapshot_.is_cell(c)) return x;
    const Cell_view<D> view = snapshot_.view(c);
    x = view.point(0);
    for (std::size_t v = 1; v < view.vertex_count(); ++v)
      x = combination<D>(x, view.point(v), 1 / (1.0 + static_cast<double>(v)));
    return x;
  }

  void change(Reshaping<D>& reshaping) {
    const std::uint32_t u = point(), v = point();
    const Cell c = cell();
    switch (in_.below(13)) {
      case 0:
      case 1:
        return static_cast<void>(reshaping.move(u, combination<D>(snapshot_.point(u), place(), 0.125)));
      case 2:
        return static_cast<void>(reshaping.open(facet()));
      case 3:
        return static_cast<void>(reshaping.close(facet()));
      case 4:
        return static_cast<void>(reshaping.excavate(c));
      case 5:
        return static_cast<void>(reshaping.fill(c));
      case 6:
        return static_cast<void>(reshaping.insert_point(c, middle_of(c)));
      case 7:
        return static_cast<void>(reshaping.flip(facet()));
      case 8:
        return static_cast<void>(
            reshaping.split_edge(u, v, combination<D>(snapshot_.point(u), snapshot_.point(v), 0.5)));
      case 9:
        return static_cast<void>(reshaping.collapse(u, v));
      case 10: {
        const std::array points{u, v};
        return static_cast<void>(reshaping.relax(points));
      }
      case 11: {
        const std::array solid{c};
        return static_cast<void>(reshaping.split_vertex(u, solid, middle_of(c)));
      }
      default:
        return cut(reshaping);
    }
  }

  void cut(Reshaping<D>& reshaping) {
    Blade<D> blade;
    typename Blade<D>::Piece piece{};
    for (std::uint32_t i = 0; i < D; ++i) {
      blade.points.push_back(place());
      piece[i] = i;
    }
    blade.pieces = {piece};
    reshaping.cut(blade);
  }

  void edit() {
    const Cell c = cell();
    const std::uint32_t u = point();
    switch (in_.below(5)) {
      case 0:
        environment_.set_impassable(facet(), in_.flag());
        break;
      case 1:
        environment_.excavate(c);
        break;
      case 2:
        environment_.fill(c);
        break;
      case 3:
        environment_.move_vertex(u, combination<D>(snapshot_.point(u), place(), 0.0625));
        break;
      default:
        environment_.insert_point(c, middle_of(c));
    }
    ++opened_totals.edits;
  }

  Environment<D>& environment_;
  const Snapshot<D>& snapshot_;
  Decoder& in_;
  std::unique_ptr<Locator<D>> locator_;
  std::vector<std::unique_ptr<Body<D>>> bodies_;
  std::vector<Particle<D>> particles_;
};

}  // namespace

const Used& used() { return opened_totals; }
Used& counted_uses() { return opened_totals; }

template <int D>
void use(Environment<D>& environment, Decoder& in) {
  Use<D>(environment, in).run();
}

template void use(Environment<2>&, Decoder&);
template void use(Environment<3>&, Decoder&);

}  // namespace cellwalk::fuzz
