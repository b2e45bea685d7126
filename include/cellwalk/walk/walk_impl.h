// SPDX-License-Identifier: LGPL-3.0-or-later
// The walk, for any number policy. The shipped policies are compiled once, in src/walk/walk.cpp; include this
// header only to walk with a policy of your own (static constants is_exact, uses_certificates;
// orientation(counts, points..)).
#ifndef CELLWALK_WALK_WALK_IMPL_H
#define CELLWALK_WALK_WALK_IMPL_H

#include <cellwalk/internal/kernel/check_finite.h>
#include <cellwalk/internal/kernel/uncertified.h>
#include <cellwalk/internal/walk/certified_exit.h>
#include <cellwalk/internal/walk/in_boundary.h>
#include <cellwalk/internal/walk/predictive_exit.h>
#include <cellwalk/internal/walk/sides_taken.h>
#include <cellwalk/internal/walk/signs.h>
#include <cellwalk/internal/walk/star.h>
#include <cellwalk/walk/strategy.h>
#include <cellwalk/walk/walk.h>

#include <boost/container/small_vector.hpp>

namespace cellwalk {
namespace detail {

/// One walk in progress.
template <class Kernel, int D>
class Particle_walk {
 public:
  /// \param choices if not null, the sides to take; others taken are appended
  Particle_walk(const Snapshot<D>& snapshot, const Particle<D>& from, const Point<D>& to, Walk_counts& counts,
                Walk_strategy strategy, const Walk_options& options, Sides_taken* choices = nullptr)
      : snapshot_(snapshot),
        a_(from.position),
        b_(to),
        counts_(counts),
        strategy_(strategy),
        options_(options),
        choices_(choices),
        cell_(from.cell) {
    result_.aimed = from.aimed;
    starts_inside_ = from.dimension == D;
    in_boundary_ = !starts_inside_;
    if (Kernel::uses_certificates && strategy == Walk_strategy::certified)
      planes_b_ = snapshot.frame().map(b_, y_b_);
    check_has_planes(snapshot, cell_);
    if (planes_b_) return;  // points in the frame are finite
    check_finite(b_, "the target of a motion");
    map_start();
  }

  Walk_result<D> run() {
    ++counts_.walks;
    if (options_.visited) options_.visited->push_back(cell_);
    // Exact walks end as every accepted cell holds a further piece of the segment, if planes are their own.
    const std::size_t limit = 4 * snapshot_.cell_count() + 64;
    for (;;) {
      if (planes_b_ && run_certified()) break;
      if (!step()) break;
      if (result_.cells > limit) {
        if (Kernel::is_exact) refuse_uncertified();
        result_.status = Walk_status::lost;
        break;
      }
    }
    if (result_.cells == 1 && result_.status == Walk_status::arrived) ++counts_.stays;
    result_.cell = cell_;
    return result_;
  }

 private:
  /// Leaves the cell or ends the walk; true if the walk continues.
  bool step() {
    const Cell_view<D> cell = view_of_particle(snapshot_, cell_);
    on_planes_ = false;
    const Exit exit = find_exit(cell);
    result_.on_planes |= on_planes_;
    // Where the motion runs in the boundary of the cell, walls may begin on it before it leaves.
    if (Kernel::is_exact && in_boundary_ && on_planes_) {
      const Exit place = detail::next_in_boundary(cell, a_, b_, passed_, exit.kind == Exit::arrived, counts_);
      if (place.kind != Exit::none) return pass_star(place);
      in_boundary_ = false;
    }
    switch (exit.kind) {
      case Exit::arrived:
        result_.status = Walk_status::arrived;
        return false;
      case Exit::none:
        result_.status = Walk_status::lost;
        return false;
      case Exit::facet:
        return pass(exit.facet_index);
      default:
        result_.aimed = exit.facet_index;
        return pass_star(exit);
    }
  }

  /// Continues at a ridge or vertex of the cell; false if the walk ends there.
  bool pass_star(const Exit& exit) {
    const Star_search<Kernel, D> star(snapshot_, cell_, exit.u, exit.v, a_, b_, counts_);
    if (star.candidates().empty()) return block(exit, star.wall());
    const bool has_choice = star.has_choice();
    const auto& next =
        has_choice && choices_ ? star.on_side(next_side(exit, star)) : star.candidates().front();
    result_.had_choice |= has_choice;
    passed_ = exit;
    if (Kernel::is_exact && star.cell(next) == cell_) {
      // Of the ridges and vertices of the cell that the line passes, each is passed once, and the start.
      if (++places_passed_ > snapshot_.view(cell_).shape->loops.size() + 1) refuse_uncertified();
      return true;
    }
    if (options_.crossed) {
      const Star_path path = star.path(next);
      options_.crossed->insert(options_.crossed->end(), path.begin(), path.end());
    }
    if (options_.exits) options_.exits->push_back({Half_facet::none, exit.u, exit.v});
    enter(star.cell(next));
    in_boundary_ = true;
    return true;
  }

  std::size_t next_side(const Exit& place, const Star_search<Kernel, D>& star) {
    if (choices_passed_ == choices_->size())
      choices_->push_back({std::min(place.u, place.v), std::max(place.u, place.v), star.least_cell(),
                           static_cast<std::uint16_t>(star.side_count()), 0});
    return (*choices_)[choices_passed_++].taken;
  }

  bool enter(Cell next) {
    ++counts_.crossings;
    ++result_.cells;
    cell_ = next;
    places_passed_ = 0;
    starts_inside_ = true;
    in_boundary_ = false;
    result_.aimed = 0;
    if (options_.visited) options_.visited->push_back(next);
    return true;
  }

  bool block(const Exit& exit, Half_facet wall) {
    if (wall == Half_facet::none) {  // no wall in the way: signs contradict each other (inexact policies)
      result_.status = Walk_status::lost;
      return false;
    }
    result_.status = Walk_status::contact;
    if (options_.exits)
      options_.exits->push_back(exit.kind == Exit::facet ? Cell_exit{wall}
                                                         : Cell_exit{Half_facet::none, exit.u, exit.v});
    Contact<D>& contact = result_.contact.emplace();
    const Cell_view<D> wall_view = snapshot_.view(snapshot_.cell_of(wall));
    contact.kind = exit.kind == Exit::facet    ? Contact_kind::facet
                   : exit.kind == Exit::vertex ? Contact_kind::vertex
                                               : Contact_kind::edge;
    if (exit.kind != Exit::facet)
      contact.corner = corner_of(wall_view, snapshot_.facet_of(wall), exit.u, exit.v);
    contact.facet = wall;
    contact.cell = cell_;
    if (options_.locates_contact) locate_contact(snapshot_, a_, b_, contact);
    return false;
  }

  Exit find_exit(const Cell_view<D>& cell) {
    if (planes_b_) return exit_after_doubt(cell);
    if (strategy_ == Walk_strategy::predictive_simplex && starts_inside_ && !in_boundary_ && a_ != b_)
      return predictive(cell);
    return exit_by_rule(cell);
  }

  /// The exit by exact signs alone: facets with the target strictly outside, then their ridges.
  Exit exit_by_rule(const Cell_view<D>& cell) {
    const std::size_t facets = cell.facet_count();
    boost::container::small_vector<std::int8_t, 32> sides(facets);
    bool outside = false;
    for (std::size_t i = 0; i < facets; ++i) {
      sides[i] = static_cast<std::int8_t>(side<Kernel>(cell, i, b_, counts_));
      outside |= sides[i] > 0;
      on_planes_ |= sides[i] == 0;
    }
    return exit_by_sides(cell, sides, outside);
  }

  template <class Sides>
  Exit exit_by_sides(const Cell_view<D>& cell, const Sides& sides, bool outside) {
    if (!outside) {
      result_.dimension = lowest_dimension(cell, b_, [&](std::size_t i) { return sides[i] == 0; });
      return {Exit::arrived};
    }
    const std::size_t facets = cell.facet_count();
    const std::size_t forecast = result_.aimed < facets ? result_.aimed : 0;
    for (std::size_t k = 0; k < facets; ++k) {
      const std::size_t i = forecast + k < facets ? forecast + k : forecast + k - facets;
      if (sides[i] <= 0) continue;
      const Exit exit = exit_through(cell, i, Line<Kernel, D>{a_, b_, counts_});
      if (exit.kind != Exit::none) return exit;
    }
    return {};
  }

  /// Follows the walk as far as the planes decide it; true if it ended, false if the cell needs exact signs.
  bool run_certified() {
    if (!map_start()) return false;
    const Frame_line<D> line(y_a_, y_b_);
    // One block a cell in all cells (tetrahedra, triangles) is worth a loop of its own.
    const Certified_exit exit =
        snapshot_.uniform_blocks() == 1 ? follow([&](Cell cell, bool starts_inside) {
          return certified_exit<D>(*snapshot_.blocks(cell), line, starts_inside);
        })
                                        : follow([&](Cell cell, bool starts_inside) {
                                            return exit_of_blocks(snapshot_, cell, line, starts_inside);
                                          });
    switch (exit.verdict) {
      case Certified_exit::inside:
        arrive_inside();
        return true;
      case Certified_exit::leaves:
        pass(static_cast<std::uint16_t>(exit.facet));
        return true;
      default:
        return false;
    }
  }

  /// Crosses facets as long as find_exit proves a passable exit; returns its proof for the last cell.
  template <class Find_exit>
  Certified_exit follow(Find_exit find_exit) {
    // The state of the walk in registers.
    Cell cell = cell_;
    bool starts_inside = starts_inside_;
    std::uint32_t crossed = 0;
    const std::size_t limit = snapshot_.half_facet_slots();
    std::uint64_t evaluated = 0;
    Certified_exit exit;
    for (;;) {
      snapshot_.prefetch_neighbours(cell);
      exit = find_exit(cell, starts_inside);
      evaluated += 2 * snapshot_.block_count(cell);
      if (exit.verdict != Certified_exit::leaves) break;
      const Half_facet f = Snapshot<D>::half_facet(cell, exit.facet);
      if (snapshot_.is_impassable(f)) break;
      cell = snapshot_.neighbour(f);
      starts_inside = true;
      if (++crossed > limit) [[unlikely]]
        refuse_uncertified();
      if (options_.visited) options_.visited->push_back(cell);
      if (options_.crossed) options_.crossed->push_back(f);
      if (options_.exits) options_.exits->push_back({f});
    }
    counts_.plane_blocks += evaluated;
    counts_.crossings += crossed;
    result_.cells += crossed;
    if (crossed) result_.aimed = 0;
    cell_ = cell;
    starts_inside_ = starts_inside;
    return exit;
  }

  /// Passes the interior of a facet; false if the walk ends there.
  bool pass(std::uint16_t facet) {
    const Half_facet f = Snapshot<D>::half_facet(cell_, facet);
    result_.aimed = facet;
    if (snapshot_.is_impassable(f)) return block({Exit::facet, facet, 0, 0}, f);
    if (options_.crossed) options_.crossed->push_back(f);
    if (options_.exits) options_.exits->push_back({f});
    return enter(snapshot_.neighbour(f));
  }

  /// Maps the start into the frame, once.
  bool map_start() {
    if (!mapped_a_) {
      mapped_a_ = true;
      planes_a_ = snapshot_.frame().map(a_, y_a_);
      if (!planes_a_) check_finite(a_, "the position of a particle");
    }
    return planes_a_;
  }

  /// Exact signs for undecided planes, and for the ridges.
  Exit exit_after_doubt(const Cell_view<D>& cell) {
    const std::size_t facets = cell.facet_count();
    boost::container::small_vector<std::int8_t, 32> sides(4 * ((facets + 3) / 4));
    bool outside = false;
    for (std::size_t i = 0; i < facets; ++i) {
      if (i % 4 == 0) {
        const Block_sides s = classify(snapshot_.blocks(cell_)[i / 4], y_b_);
        for (std::size_t lane = 0; lane < 4; ++lane)
          sides[i + lane] = static_cast<std::int8_t>(int(s.outside >> lane & 1) - int(s.inside >> lane & 1));
      }
      if (sides[i] == 0) {
        ++counts_.uncertain_lanes;
        sides[i] = static_cast<std::int8_t>(side<Kernel>(cell, i, b_, counts_));
      }
      outside |= sides[i] > 0;
      on_planes_ |= sides[i] == 0;
    }
    return exit_by_sides(cell, sides, outside);
  }

  Exit predictive(const Cell_view<D>& cell) {
    const auto exit = predictive_exit<Kernel>(cell, a_, b_, result_.aimed, counts_);
    if (!exit) return exit_by_rule(cell);
    return exit->kind == Exit::arrived ? arrive_inside() : *exit;
  }

  Exit arrive_inside() {
    result_.dimension = D;
    return {Exit::arrived};
  }

  const Snapshot<D>& snapshot_;
  const Point<D> a_, b_;
  Walk_counts& counts_;
  const Walk_strategy strategy_;
  const Walk_options& options_;
  Sides_taken* choices_;
  std::size_t choices_passed_ = 0;
  Cell cell_;
  Walk_result<D> result_;
  Float_point<D> y_a_, y_b_;
  bool planes_a_ = false;  ///< a lies in the frame (known once mapped_a_)
  bool planes_b_ = false;  ///< b lies in the frame, and planes are to be used
  bool mapped_a_ = false;
  /// The line holds a point of the cell strictly before any exit: a is inside, or a facet was crossed.
  bool starts_inside_;
  bool in_boundary_;               ///< the line may run in the boundary of the cell from where it entered it
  bool on_planes_ = false;         ///< b lies on the plane of a facet of the cell
  Exit passed_;                    ///< the last ridge or vertex passed
  std::size_t places_passed_ = 0;  ///< of the cell, without leaving it
};

}  // namespace detail

template <class Kernel, int D>
Walk_result<D> walk(const Snapshot<D>& snapshot, const Particle<D>& particle, const Point<D>& target,
                    Walk_counts& counts, Walk_strategy strategy, const Walk_options& options) {
  Walk_result<D> result =
      detail::Particle_walk<Kernel, D>(snapshot, particle, target, counts, strategy, options).run();
  if constexpr (Kernel::is_exact) {
    if (result.had_choice && result.contact) [[unlikely]]
      result =
          detail::furthest_walk(snapshot, particle.position, target, options,
                                [&](const Walk_options& recorded, detail::Sides_taken& choices) {
                                  return detail::Particle_walk<Kernel, D>(snapshot, particle, target, counts,
                                                                          strategy, recorded, &choices)
                                      .run();
                                });
  }
  return result;
}

template <class Kernel, int D>
Walk_result<D> walk(const Snapshot<D>& snapshot, const Particle<D>& particle, const Point<D>& target,
                    Walk_counts& counts, const Walk_options& options) {
  return walk<Kernel>(snapshot, particle, target, counts, Walk_strategy::certified, options);
}

template <class Kernel, int D>
Walk_result<D> detail::move_by_walk(const Snapshot<D>& snapshot, Particle<D>& particle,
                                    const Point<D>& target, Walk_counts& counts,
                                    const Walk_options& options) {
  const Walk_result<D> result = walk<Kernel>(snapshot, particle, target, counts, options);
  if (result.status == Walk_status::arrived) particle = {target, result.cell, result.dimension, result.aimed};
  return result;
}

template <class Kernel, int D>
Walk_result<D> move(const Snapshot<D>& snapshot, Particle<D>& particle, const Point<D>& target,
                    Walk_counts& counts, Walk_strategy strategy, const Walk_options& options) {
  if (strategy == Walk_strategy::certified) return move<Kernel>(snapshot, particle, target, counts, options);
  const Walk_result<D> result = walk<Kernel>(snapshot, particle, target, counts, strategy, options);
  if (result.status == Walk_status::arrived) particle = {target, result.cell, result.dimension, result.aimed};
  return result;
}

}  // namespace cellwalk

#endif  // CELLWALK_WALK_WALK_IMPL_H
