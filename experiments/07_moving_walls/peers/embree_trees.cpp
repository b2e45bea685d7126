// SPDX-License-Identifier: LGPL-3.0-or-later
// Embree 3 or 4: the boxes as user geometries, and rtcCollide of the scene of the walls with that of the
// groups of edges, which stands still.
//
//   embree_refit    RTC_BUILD_QUALITY_REFIT: the boxes of all nodes anew
//   embree_low      built anew, by Morton codes
//   embree_medium   built anew, by the surface area heuristic
#if CELLWALK_WITH_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

#include <utility>

#include "common/peers/float_box.h"
#include "tree.h"

namespace cellwalk::moving_walls {
namespace {

using experiments::Float_box;

/// A device with its count of bytes.
class Device {
 public:
  Device() : device_(rtcNewDevice("threads=1")) {
    rtcSetDeviceMemoryMonitorFunction(
        device_,
        [](void* sum, ssize_t bytes, bool) {
          *static_cast<ssize_t*>(sum) += bytes;
          return true;
        },
        &bytes_);
  }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  ~Device() { rtcReleaseDevice(device_); }
  RTCDevice get() const { return device_; }
  std::size_t bytes() const { return static_cast<std::size_t>(bytes_); }

 private:
  ssize_t bytes_ = 0;
  RTCDevice device_;
};

/// A scene of boxes.
class Box_scene {
 public:
  Box_scene(const Device& device, std::vector<Box> boxes, RTCBuildQuality quality)
      : boxes_(std::move(boxes)), scene_(rtcNewScene(device.get())) {
    geometry_ = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry_, static_cast<unsigned>(boxes_.size()));
    rtcSetGeometryUserData(geometry_, this);
    rtcSetGeometryBoundsFunction(
        geometry_,
        [](const RTCBoundsFunctionArguments* of) {
          const Float_box box(static_cast<Box_scene*>(of->geometryUserPtr)->boxes_[of->primID]);
          *of->bounds_o = {box.low[0], box.low[1], box.low[2], 0, box.high[0], box.high[1], box.high[2], 0};
        },
        nullptr);
    rtcSetGeometryBuildQuality(geometry_, quality);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(scene_, quality == RTC_BUILD_QUALITY_REFIT ? RTC_BUILD_QUALITY_LOW : quality);
    rtcCommitGeometry(geometry_);
    rtcAttachGeometry(scene_, geometry_);
    rtcCommitScene(scene_);
  }
  Box_scene(const Box_scene&) = delete;
  Box_scene& operator=(const Box_scene&) = delete;
  ~Box_scene() {
    rtcReleaseGeometry(geometry_);
    rtcReleaseScene(scene_);
  }

  void set(std::uint32_t i, const Box& box) { boxes_[i] = box; }
  void commit() {
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_);
  }
  RTCScene get() const { return scene_; }

 private:
  std::vector<Box> boxes_;
  RTCScene scene_;
  RTCGeometry geometry_;
};

std::vector<Box> boxes_of(const Body_edges& edges) {
  std::vector<Box> boxes;
  for (const Body_edges::Group& group : edges.groups) boxes.push_back(group.box);
  return boxes;
}

/// What boxes that meet are noted in.
struct Found {
  const Swept_walls& walls;
  const Body_edges& edges;
  std::vector<Pair>& pairs;

  void add(std::uint32_t triangle, std::uint32_t number) const {
    const Box& box = walls.boxes()[triangle];
    const Body_edges::Group& group = edges.groups[number];
    if (!walls.is_touched(triangle) || !meet(box, group.box)) return;
    for (std::uint32_t e = group.begin; e < group.end; ++e)
      if (meet(box, edges.boxes[e])) pairs.push_back({triangle, e});
  }
};

class Embree_tree : public Tree {
 public:
  Embree_tree(const Swept_walls& walls, const Body_edges& edges, RTCBuildQuality quality)
      : edges_(edges),
        bodies_(device_, boxes_of(edges), RTC_BUILD_QUALITY_MEDIUM),
        walls_(device_, walls.boxes(), quality) {}

  void update(const Swept_walls& walls) override {
    for (const std::uint32_t t : walls.touched()) walls_.set(t, walls.boxes()[t]);
    walls_.commit();
  }
  void find(const Swept_walls& walls, std::vector<Pair>& pairs) override {
    Found found{walls, edges_, pairs};
    rtcCollide(
        walls_.get(), bodies_.get(),
        [](void* user, RTCCollision* collisions, unsigned count) {
          for (unsigned i = 0; i < count; ++i)
            static_cast<Found*>(user)->add(collisions[i].primID0, collisions[i].primID1);
        },
        &found);
  }
  std::size_t bytes() const { return device_.bytes(); }

 private:
  const Body_edges& edges_;
  Device device_;
  Box_scene bodies_, walls_;
};

}  // namespace

void add_embree_trees(const Swept_walls& walls, const Body_edges& edges, Trees& trees) {
  const auto add = [&](const char* name, RTCBuildQuality quality) {
    experiments::Build build;
    auto tree = experiments::measured_build(
        build, "wall", [&] { return std::make_unique<Embree_tree>(walls, edges, quality); });
    build.bytes = tree->bytes();
    tree->name = name;
    tree->library = "embree";
    tree->build = build;
    trees.push_back(std::move(tree));
  };
  add("embree_refit", RTC_BUILD_QUALITY_REFIT);
  add("embree_low", RTC_BUILD_QUALITY_LOW);
  add("embree_medium", RTC_BUILD_QUALITY_MEDIUM);
}

}  // namespace cellwalk::moving_walls
