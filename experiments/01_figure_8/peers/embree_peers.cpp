// SPDX-License-Identifier: LGPL-3.0-or-later
// Embree 3 or 4: occlusion rays from a to b, one at a time and in packets of four, with its robust mode and
// without. Its points are floats. Its answers follow the instruction set that it finds.
#include <memory>
#include <string>
#include <utility>

#include "common/peers/embree_walls.h"
#include "families.h"
#include "replay.h"

namespace cellwalk::figure_8 {
namespace {

using Embree = experiments::Embree_walls;
using experiments::Occlusion;

struct Embree_check : Stateless {
  static constexpr bool follows_processor = true;
  std::shared_ptr<Embree> embree;
};

struct Single_ray : Embree_check {
  template <class Counter>
  unsigned vertex(std::size_t, std::size_t v, const Point<3>* positions, const Point<3>& target,
                  Counter& counter) {
    Occlusion occlusion;
    return four_segments(v, positions, target, [&](const Point<3>& a, const Point<3>& b) {
      RTCRay ray{};
      ray.org_x = static_cast<float>(a[0]);
      ray.org_y = static_cast<float>(a[1]);
      ray.org_z = static_cast<float>(a[2]);
      ray.dir_x = static_cast<float>(b[0]) - ray.org_x;
      ray.dir_y = static_cast<float>(b[1]) - ray.org_y;
      ray.dir_z = static_cast<float>(b[2]) - ray.org_z;
      ray.tfar = 1;
      ray.mask = ~0u;
      counter.queries();
      occlusion.ask(embree->scene(), ray);
      return ray.tfar < 0;
    });
  }
};

/// All four segments at once, on the guess that the vertex reaches its target; where it does not, the edges
/// are cast again from where it stands.
struct Packet : Embree_check {
  template <class Counter>
  unsigned vertex(std::size_t, std::size_t v, const Point<3>* positions, const Point<3>& target,
                  Counter& counter) {
    Occlusion occlusion;
    const unsigned guess = cast(occlusion, v, positions, target, counter);
    return guess & 1 ? 1u | (cast(occlusion, v, positions, positions[v], counter) & 0xeu) : guess;
  }

 private:
  template <class Counter>
  unsigned cast(Occlusion& occlusion, std::size_t v, const Point<3>* positions, const Point<3>& p,
                Counter& counter) {
    alignas(16) RTCRay4 rays{};
    alignas(16) int valid[4] = {-1, -1, -1, -1};
    const auto set = [&](std::size_t i, const Point<3>& a, const Point<3>& b) {
      rays.org_x[i] = static_cast<float>(a[0]);
      rays.org_y[i] = static_cast<float>(a[1]);
      rays.org_z[i] = static_cast<float>(a[2]);
      rays.dir_x[i] = static_cast<float>(b[0]) - rays.org_x[i];
      rays.dir_y[i] = static_cast<float>(b[1]) - rays.org_y[i];
      rays.dir_z[i] = static_cast<float>(b[2]) - rays.org_z[i];
      rays.tfar[i] = 1;
      rays.mask[i] = ~0u;
    };
    set(0, positions[v], p);
    if (&p == &positions[v]) valid[0] = 0;
    for (std::size_t k = 0; k < trace_edges; ++k) set(k + 1, p, positions[trace_neighbour(v, k)]);
    counter.queries(valid[0] ? 4 : 3);
    occlusion.ask(embree->scene(), valid, rays);
    unsigned answer = 0;
    for (unsigned i = 0; i < 4; ++i) answer |= static_cast<unsigned>(rays.tfar[i] < 0) << i;
    return answer;
  }
};

}  // namespace

void add_embree_peers(const Grid_world& world, Peers& peers) {
  for (const bool robust : {false, true}) {
    Build build;
    const auto embree =
        measured_build(build, "wall", [&] { return std::make_shared<Embree>(world.walls, robust); });
    build.bytes = embree->bytes();
    const std::string suffix = robust ? "_robust" : "";
    add_peer(peers, "embree_ray" + suffix, Single_ray{{{}, embree}}, build);
    add_peer(peers, "embree_packet" + suffix, Packet{{{}, embree}}, build);
  }
}

}  // namespace cellwalk::figure_8
