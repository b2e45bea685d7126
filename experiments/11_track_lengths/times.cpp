// SPDX-License-Identifier: LGPL-3.0-or-later
#include "times.h"

#include <cellwalk/walk/walk.h>

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "common/processor_time.h"
#include "peers/midpoints.h"
#include "peers/plain_walk.h"
#include "peers/traverser.h"

namespace cellwalk::track_lengths {
namespace {

/// A method with its answers; `prepare` is not timed.
struct Method {
  std::string name;
  std::function<void()> prepare, run;
  std::shared_ptr<Peer_rows> rows;  // of peers
};

template <class Real>
Method plain_method(const std::string& name, const World& world, const Rays& rays, unsigned together) {
  auto walker = std::make_shared<Plain_walker<Real>>(world, together);
  walker->take(rays);
  auto rows = std::make_shared<Peer_rows>();
  return {name, [] {}, [walker, rows] { walker->run(*rows); }, rows};
}

template <class Peer>
Method peer_method(const std::string& name, const World& world, const Rays& rays) {
  auto peer = std::make_shared<Peer>(world);
  auto rows = std::make_shared<Peer_rows>();
  return {name, [] {}, [peer, rows, &rays] { peer->run(rays, *rows); }, rows};
}

std::vector<Method> all_methods(const World& world, const Rays& rays, const Tracer<3>& tracer, Traces& traces,
                                std::vector<Particle<3>>& particles) {
  std::vector<Method> methods;
  methods.push_back({"trace",
                     [&] {
                       particles = rays.starts;
                       traces.clear();
                     },
                     [&] {
                       Walk_counts counts;
                       tracer.trace(particles, rays.targets, traces, counts);
                     },
                     nullptr});
  methods.push_back(
      {"walk without lengths", [] {},
       [&] {
         Walk_counts counts;
         Walk_options options;
         options.locates_contact = false;
         for (std::size_t i = 0; i < rays.size(); ++i)
           if (walk(world.snapshot(), rays.starts[i], rays.targets[i], counts, options).status ==
               Walk_status::lost)
             throw std::runtime_error("a walk is lost");
       },
       nullptr});
  methods.push_back(plain_method<double>("plain walk, double", world, rays, 1));
  methods.push_back(plain_method<double>("plain walk, double, four rays together", world, rays, 4));
  methods.push_back(plain_method<float>("plain walk, single", world, rays, 1));
  methods.push_back(plain_method<float>("plain walk, single, four rays together", world, rays, 4));
  if (world.triangulation) methods.push_back(peer_method<Traverser>("CGAL traverser", world, rays));
  methods.push_back(peer_method<Midpoints>("midpoints by trees", world, rays));
  return methods;
}

}  // namespace

Comparison compare(const World& world, const Rays& rays, int rounds, bool warms_up) {
  const Tracer<3> tracer(world.snapshot());
  Traces traces;
  std::vector<Particle<3>> particles;
  const std::vector<Method> methods = all_methods(world, rays, tracer, traces, particles);
  Comparison comparison;
  for (const Method& method : methods)
    comparison.methods.push_back({method.name, method.rows != nullptr, {}, {}});
  for (int round = 0; round <= rounds; ++round)
    for (std::size_t i = 0; i < methods.size(); ++i) {
      if (warms_up && round > 0) {
        methods[i].prepare();
        methods[i].run();
      }
      methods[i].prepare();
      const double start = experiments::processor_seconds();
      methods[i].run();
      if (round > 0) comparison.methods[i].seconds.push_back(experiments::processor_seconds() - start);
    }
  comparison.crossings = traces.crossings.size();
  const Plain_tables<double> tables(world.snapshot());
  for (std::size_t i = 0; i < methods.size(); ++i)
    if (methods[i].rows)
      comparison.methods[i].failures = failures(world, tables.planes, rays, traces, *methods[i].rows);
  return comparison;
}

}  // namespace cellwalk::track_lengths
