// SPDX-License-Identifier: LGPL-3.0-or-later
// Embree 3 or 4: occlusion rays from a to b, one at a time and in packets of four, with its robust mode and
// without. Its points are floats. Its answers follow the instruction set that it finds.
#if CELLWALK_WITH_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

#include <cstring>
#include <memory>
#include <string>
#include <utility>

#include "families.h"
#include "measured_build.h"
#include "replay.h"

namespace cellwalk::figure_8 {
namespace {

class Embree {
 public:
  Embree(const Wall_mesh& walls, bool robust) {
    device_ = rtcNewDevice("threads=1");
    rtcSetDeviceMemoryMonitorFunction(
        device_,
        [](void* sum, ssize_t bytes, bool) {
          *static_cast<ssize_t*>(sum) += bytes;
          return true;
        },
        &bytes_);
    scene_ = rtcNewScene(device_);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    if (robust) rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry mesh = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), walls.points.size()));
    for (const Point<3>& p : walls.points)
      for (const double x : p) *vertices++ = static_cast<float>(x);
    auto* indices = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            3 * sizeof(unsigned), walls.triangles.size());
    std::memcpy(indices, walls.triangles.data(), walls.triangles.size() * sizeof(walls.triangles[0]));
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene_, mesh);
    rtcReleaseGeometry(mesh);
    rtcCommitScene(scene_);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
  ~Embree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  RTCScene scene() const { return scene_; }
  std::size_t bytes() const { return static_cast<std::size_t>(bytes_); }

 private:
  ssize_t bytes_ = 0;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

/// Is anything hit? Rays that hit get a negative tfar.
class Occlusion {
 public:
#if CELLWALK_WITH_EMBREE == 3
  Occlusion() { rtcInitIntersectContext(&context_); }
  void ask(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, &context_, &ray); }
  void ask(RTCScene scene, const int* valid, RTCRay4& rays) { rtcOccluded4(valid, scene, &context_, &rays); }

 private:
  RTCIntersectContext context_;
#else
  void ask(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, &ray); }
  void ask(RTCScene scene, const int* valid, RTCRay4& rays) { rtcOccluded4(valid, scene, &rays); }
#endif
};

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
