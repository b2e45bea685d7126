// SPDX-License-Identifier: LGPL-3.0-or-later
// The catheter tip: the first particle steers along the path, each follower is pulled along by its predecessor.
#include <cellwalk/simulation/world.h>

#include <algorithm>

namespace cellwalk {
namespace {

/// A link stretched to this many spacings holds the tip back until the neighbours have caught up.
constexpr double most_stretched = 1.5;

}  // namespace

template <int D>
bool World<D>::in_sight(const Particle<D>& from, const Point<D>& to) {
  return walk<Exact>(snapshot_, from, to, counts_).status == Walk_status::arrived;
}

template <int D>
void World<D>::push(std::size_t particle, const Vector<D>& displacement) {
  const Point<D> before = particles_[particle].position;
  advance(snapshot_, particles_[particle], displacement, {0, scene_.friction}, met_, counts_);
  velocities_[particle] = (1 / scene_.time_step) * (particles_[particle].position - before);
  report(particle);
}

/// The length of the link from particle i to its predecessor, along the trail that joins them.
template <int D>
double World<D>::link_length(std::size_t i) const {
  double sum = 0;
  Point<D> last = particles_[i].position;
  for (const Point<D>& p : trails_[i - free_count_]) {
    sum += length(p - last);
    last = p;
  }
  return sum + length(particles_[i - 1].position - last);
}

/// Where the tip is pushed in this step: along the path by the catheter's advance.
template <int D>
Vector<D> World<D>::steer(const Catheter<D>& catheter) {
  const Particle<D>& tip = particles_[free_count_];
  for (std::size_t i = free_count_ + 1; i < particles_.size(); ++i)
    if (link_length(i) > most_stretched * catheter.spacing) {
      ++steps_waited_;
      return {};
    }
  Point<D> target = tip.position;
  double left = catheter.advance;
  while (next_way_point_ < path_.size() && left > 0) {
    const Point<D>& aim = path_[next_way_point_];
    const bool is_last = next_way_point_ + 1 == path_.size();
    // Walls may keep the tip off a way point. It counts as passed where the tip is nearer to the next one than it is,
    // and has that one in sight.
    if (!is_last) {
      const Point<D>& next = path_[next_way_point_ + 1];
      if (length(next - tip.position) < length(next - aim) && in_sight(tip, next)) {
        ++next_way_point_;
        continue;
      }
    }
    const double distance = length(aim - target);
    if (distance > left) {
      target = target + (left / distance) * (aim - target);
      break;
    }
    target = aim;
    left -= distance;
    // The last one is reached only where the tip stands on it; walls may forbid that for ever.
    if (is_last && tip.position != aim) break;
    ++next_way_point_;
  }
  return target - tip.position;
}

/// Pulls a follower towards its predecessor until the link is no longer than the spacing, and towards the middle of its
/// neighbours as far as the catheter is stiff. Where a wall hides the predecessor, the follower is pulled along the
/// places where that has been, so that links go round corners.
template <int D>
void World<D>::follow(const Catheter<D>& catheter, std::size_t i) {
  std::vector<Point<D>>& trail = trails_[i - free_count_];
  const Point<D>& before = particles_[i - 1].position;
  if (trail.empty() || trail.back() != before) trail.push_back(before);
  // The latest place in sight; what came before it is forgotten. It stays until a later one is in sight: where the
  // predecessor has just gone round a corner, it was last seen there.
  for (std::size_t k = trail.size(); k-- > 0;)
    if (in_sight(particles_[i], trail[k])) {
      trail.erase(trail.begin(), trail.begin() + static_cast<std::ptrdiff_t>(k));
      break;
    }
  const Point<D> here = particles_[i].position;
  const double excess = link_length(i) - catheter.spacing, distance = length(trail.front() - here);
  Vector<D> pull{};
  if (excess > 0 && distance > 0) pull = std::min(1.0, excess / distance) * (trail.front() - here);
  Vector<D> motion = pull;
  if (i + 1 < particles_.size()) {
    // Stiffness gives way as links are stretched: what hangs on a corner then moves like a thread, which gets round.
    const double stretch = std::max(excess, link_length(i + 1) - catheter.spacing) / catheter.spacing;
    const double yield = std::clamp(1 - stretch / (most_stretched - 1), 0.0, 1.0);
    motion = pull + (0.5 * catheter.stiffness * yield) * (0.5 * (before + particles_[i + 1].position) - here);
    // It gives way too where it would push the follower behind a corner, out of sight of its trail.
    Particle<D> trial = particles_[i];
    advance(snapshot_, trial, motion, {0, scene_.friction}, met_, counts_);
    if (!in_sight(trial, trail.front())) motion = pull;
  }
  push(i, motion);
}

template <int D>
void World<D>::step_catheter(const Catheter<D>& catheter) {
  push(free_count_, steer(catheter));
  for (std::size_t i = free_count_ + 1; i < particles_.size(); ++i) follow(catheter, i);
  if (particles_.size() - free_count_ < catheter.particles &&
      length(particles_.back().position - entry_.position) >= catheter.spacing)
    enter();
}

template <int D>
void World<D>::enter() {
  particles_.push_back(entry_);
  velocities_.push_back({});
  trails_.emplace_back();
}

template bool World<2>::in_sight(const Particle<2>&, const Point<2>&);
template void World<2>::push(std::size_t, const Vector<2>&);
template double World<2>::link_length(std::size_t) const;
template Vector<2> World<2>::steer(const Catheter<2>&);
template void World<2>::follow(const Catheter<2>&, std::size_t);
template void World<2>::step_catheter(const Catheter<2>&);
template void World<2>::enter();
template bool World<3>::in_sight(const Particle<3>&, const Point<3>&);
template void World<3>::push(std::size_t, const Vector<3>&);
template double World<3>::link_length(std::size_t) const;
template Vector<3> World<3>::steer(const Catheter<3>&);
template void World<3>::follow(const Catheter<3>&, std::size_t);
template void World<3>::step_catheter(const Catheter<3>&);
template void World<3>::enter();

}  // namespace cellwalk
