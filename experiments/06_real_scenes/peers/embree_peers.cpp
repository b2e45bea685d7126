// SPDX-License-Identifier: LGPL-3.0-or-later
// Embree 3 or 4: all segments of a step as occlusion rays in packets of 8 or 16, on the guess that every
// vertex reaches its target. Rays to a vertex that did not are cast again, one by one. Its points are floats,
// and its answers follow the instruction set that it finds.
#include "common/peers/embree_walls.h"
#include "peer.h"

namespace cellwalk::real_scenes {
namespace {

using experiments::Embree_walls;
using experiments::Occlusion;

struct Place {
  float x, y, z;
};

inline Place place(const Point<3>& p) {
  return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

/// Sets a lane of a packet to the segment from a to b.
template <class Rays>
void set(Rays& rays, std::size_t i, const Place& a, const Place& b) {
  rays.org_x[i] = a.x, rays.org_y[i] = a.y, rays.org_z[i] = a.z;
  rays.dir_x[i] = b.x - a.x, rays.dir_y[i] = b.y - a.y, rays.dir_z[i] = b.z - a.z;
  rays.tfar[i] = 1;
}

template <std::size_t lanes, class Rays>
class Packets : public Peer {
 public:
  Packets(const Motion& motion, std::shared_ptr<Embree_walls> walls)
      : motion_(motion),
        walls_(std::move(walls)),
        places_(motion.trace.vertices()),
        targets_(places_.size()) {
    const std::size_t rays = motion.trace.answers_of_step();
    packets_.resize((rays + lanes - 1) / lanes);
    for (Rays& packet : packets_) {
      packet = Rays{};
      for (unsigned& mask : packet.mask) mask = ~0u;
    }
  }

  void prepare() override {}
  void place(std::span<const Point<3>> positions) override { positions_ = positions; }
  void step(std::span<const Point<3>> targets, std::span<std::uint8_t> blocked) override {
    round(positions_, places_);
    round(targets, targets_);
    fill();
    cast();
    answer(blocked);
  }

 private:
  static void round(std::span<const Point<3>> points, std::vector<Place>& places) {
    for (std::size_t i = 0; i < points.size(); ++i) places[i] = real_scenes::place(points[i]);
  }
  void fill() {
    std::size_t ray = 0;
    const auto add = [&](const Place& a, const Place& b) {
      set(packets_[ray / lanes], ray % lanes, a, b);
      ++ray;
    };
    for (std::size_t b = 0; b < motion_.bodies(); ++b) {
      const Lists& neighbours = motion_.joints[b]->neighbours;
      const Place* const x = places_.data() + motion_.first_vertex[b];
      const Place* const t = targets_.data() + motion_.first_vertex[b];
      for (std::uint32_t v = 0; v < neighbours.size(); ++v) {
        add(x[v], t[v]);
        for (const std::uint32_t q : neighbours[v]) add(t[v], q < v ? t[q] : x[q]);
      }
    }
    rays_ = ray;
  }
  void cast() {
    alignas(64) int valid[lanes];
    std::fill_n(valid, lanes, -1);
    for (std::size_t i = 0; i < packets_.size(); ++i) {
      if (i + 1 == packets_.size())
        for (std::size_t k = rays_ - i * lanes; k < lanes; ++k) valid[k] = 0;
      occlusion_.ask(walls_->scene(), valid, packets_[i]);
    }
  }
  bool is_hit(std::size_t ray) const { return packets_[ray / lanes].tfar[ray % lanes] < 0; }
  bool cast_again(const Place& a, const Place& b) {
    RTCRay ray{};
    ray.org_x = a.x, ray.org_y = a.y, ray.org_z = a.z;
    ray.dir_x = b.x - a.x, ray.dir_y = b.y - a.y, ray.dir_z = b.z - a.z;
    ray.tfar = 1;
    ray.mask = ~0u;
    occlusion_.ask(walls_->scene(), ray);
    return ray.tfar < 0;
  }
  void answer(std::span<std::uint8_t> blocked) {
    std::size_t ray = 0;
    for (std::size_t b = 0; b < motion_.bodies(); ++b) {
      const Lists& neighbours = motion_.joints[b]->neighbours;
      const std::size_t first = motion_.first_vertex[b];
      for (std::uint32_t v = 0; v < neighbours.size(); ++v) {
        bool stays = is_hit(ray++);
        for (const std::uint32_t q : neighbours[v]) {
          const std::size_t edge = ray++;
          if (stays) continue;
          const bool is_guess_wrong = q < v && blocked[first + q];
          stays = is_guess_wrong ? cast_again(targets_[first + v], places_[first + q]) : is_hit(edge);
        }
        blocked[first + v] = stays;
      }
    }
  }

  const Motion& motion_;
  std::shared_ptr<Embree_walls> walls_;
  std::span<const Point<3>> positions_;
  std::vector<Place> places_, targets_;
  std::vector<Rays> packets_;
  std::size_t rays_ = 0;
  Occlusion occlusion_;
};

}  // namespace

void add_embree_peers(const Scene_walls& walls, const Motion& motion, Peers& peers) {
  for (const bool robust : {false, true}) {
    Build build;
    const auto embree = experiments::measured_build(
        build, "wall", [&] { return std::make_shared<Embree_walls>(*walls.mesh, robust); });
    build.bytes = embree->bytes();
    const auto add = [&](std::unique_ptr<Peer> peer, const std::string& name) {
      peer->name = name + (robust ? "_robust" : "");
      peer->library = "embree";
      peer->is_reproducible = false;
      peer->build = build;
      peers.push_back(std::move(peer));
    };
    add(std::make_unique<Packets<8, RTCRay8>>(motion, embree), "embree_8");
    add(std::make_unique<Packets<16, RTCRay16>>(motion, embree), "embree_16");
  }
}

}  // namespace cellwalk::real_scenes
