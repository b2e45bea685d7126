// SPDX-License-Identifier: LGPL-3.0-or-later
// The camera of a picture, fitted to its drawing.
#ifndef CELLWALK_DRAWING_PICTURE_VIEW_H
#define CELLWALK_DRAWING_PICTURE_VIEW_H

#include <cellwalk/internal/drawing/picture.h>

namespace cellwalk::drawing::detail {

/// A point in the picture: pixels from the upper left, and the reciprocal of its distance from the eye
/// (parallel projection: minus the distance). Points with larger `near` are nearer; `near` is linear in the
/// picture over a flat triangle.
struct Projected {
  double x, y, near;
};

class Picture_view {
 public:
  Picture_view(const Drawing& drawing, const Picture_options& options);

  Projected project(const Point<3>& p) const;
  /// Unit vector from p to the eye.
  Vector<3> toward_eye(const Point<3>& p) const;
  bool is_perspective() const { return distance_ > 0; }
  const Vector<3>& right() const { return right_; }
  const Vector<3>& up() const { return up_; }
  const Vector<3>& toward() const { return toward_; }

 private:
  Vector<3> right_{1, 0, 0}, up_{0, 1, 0}, toward_{0, 0, 1};
  Point<3> centre_{};
  double distance_ = 0;  // of the eye from the centre; 0: parallel projection
  double scale_ = 1;     // pixels per unit (at the centre)
  double half_width_, half_height_;
};

}  // namespace cellwalk::drawing::detail

#endif  // CELLWALK_DRAWING_PICTURE_VIEW_H
