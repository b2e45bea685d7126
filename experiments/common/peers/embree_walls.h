// SPDX-License-Identifier: LGPL-3.0-or-later
// The wall triangles in a scene of Embree 3 or 4, with its robust mode or without. Its points are floats.
#ifndef CELLWALK_EXPERIMENTS_COMMON_PEERS_EMBREE_WALLS_H
#define CELLWALK_EXPERIMENTS_COMMON_PEERS_EMBREE_WALLS_H

#if CELLWALK_WITH_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

#include <cstddef>
#include <cstring>

#include "wall_mesh.h"

namespace cellwalk::experiments {

class Embree_walls {
 public:
  Embree_walls(const Wall_mesh& walls, bool robust) {
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
  Embree_walls(const Embree_walls&) = delete;
  Embree_walls& operator=(const Embree_walls&) = delete;
  ~Embree_walls() {
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
  void ask(RTCScene scene, const int* valid, RTCRay8& rays) { rtcOccluded8(valid, scene, &context_, &rays); }
  void ask(RTCScene scene, const int* valid, RTCRay16& rays) {
    rtcOccluded16(valid, scene, &context_, &rays);
  }

 private:
  RTCIntersectContext context_;
#else
  void ask(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, &ray); }
  void ask(RTCScene scene, const int* valid, RTCRay4& rays) { rtcOccluded4(valid, scene, &rays); }
  void ask(RTCScene scene, const int* valid, RTCRay8& rays) { rtcOccluded8(valid, scene, &rays); }
  void ask(RTCScene scene, const int* valid, RTCRay16& rays) { rtcOccluded16(valid, scene, &rays); }
#endif
};

}  // namespace cellwalk::experiments

#endif  // CELLWALK_EXPERIMENTS_COMMON_PEERS_EMBREE_WALLS_H
