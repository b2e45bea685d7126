// SPDX-License-Identifier: LGPL-3.0-or-later
// A band of rows of a picture: a depth buffer for opaque triangles, and a list of fragments per sample for
// translucent ones, which are sorted by depth before they are blended.
#ifndef CELLWALK_DRAWING_PICTURE_BAND_H
#define CELLWALK_DRAWING_PICTURE_BAND_H

#include <cellwalk/internal/drawing/picture.h>

#include <array>
#include <cstdint>
#include <vector>

namespace cellwalk::drawing::detail {

constexpr int subpixel = 256;  // corners are snapped to this fraction of a sample: exact edge functions

struct Vec3 {
  float x, y, z;
};
inline float dot3(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 to_float(const Vector<3>& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

/// A triangle in samples, ready to be filled.
struct Screen_triangle {
  std::array<std::int32_t, 3> x, y;  // in 1/subpixel samples
  std::array<float, 3> near;
  std::array<Vec3, 3> normal, eye;
  std::uint32_t material;
};

struct Fragment {
  float near, red, green, blue, opacity;
  std::int32_t next;
};

struct Lights {
  Vec3 key, fill;
};

/// The samples of a band of rows.
class Band {
 public:
  Band(int width, int first_row, int rows);

  void fill(const Screen_triangle& t, const Material& material, const Lights& lights, bool opaque,
            bool perspective);
  /// The finished colour of a sample over a background.
  Vec3 resolve(int x, int row, Vec3 background);

 private:
  int width_, first_row_, rows_;
  std::vector<float> near_;
  std::vector<Vec3> colour_;
  std::vector<std::int32_t> head_;
  std::vector<Fragment> fragments_;
  std::vector<Fragment> stack_;
};

}  // namespace cellwalk::drawing::detail

#endif  // CELLWALK_DRAWING_PICTURE_BAND_H
