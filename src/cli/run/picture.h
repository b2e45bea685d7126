// SPDX-License-Identifier: LGPL-3.0-or-later
// The still picture of a run: walls, particles and bodies, their earlier places, and the contacts with their
// normals.
#ifndef CELLWALK_CLI_RUN_PICTURE_H
#define CELLWALK_CLI_RUN_PICTURE_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/drawing/picture.h>
#include <cellwalk/internal/records/scene.h>
#include <cellwalk/internal/simulation/world.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cellwalk::cli {

/// Collects the content of a picture of the last step. Its memory and that of the drawing are bounded,
/// whatever the size and the length of the run: a hundred bytes for each of the 12,000 latest positions of
/// particles and each of some 100,000 contacts, and 250 MB while the picture is drawn.
template <int D>
class Run_picture {
 public:
  /// \param snapshot of the world; it must outlive the picture
  /// \param walls_move where they did so, earlier contacts of the catheter lie off them, and are left out
  Run_picture(const Snapshot<D>& snapshot, const World<D>& world, bool walls_move);

  /// To be called after each step.
  void record(const World<D>& world);

  /// Where there is more to draw than the bound allows, round shapes get fewer sides, and then a share of
  /// them is drawn; the caption contains this share.
  drawing::Drawing draw(const World<D>& world, std::string caption) const;

  template <class Archive>
  void archive(Archive& a) {
    a(trails_, catheter_, bodies_, particles_);
  }

 private:
  /// A contact as it is drawn.
  struct Mark {
    std::uint32_t step;
    Point<D> point;
    Vector<D> normal;

    template <class Archive>
    void archive(Archive& a) {
      a(step, point, normal);
    }
  };
  using Marks = std::vector<Mark>;

  /// One in each cube of a coarse grid, the earliest.
  Marks thinned(const Marks& marks) const;

  const Snapshot<D>* snapshot_;
  bool walls_move_;
  std::vector<std::vector<Point<D>>> trails_;  ///< of particles, the latest steps; none if there are many
  Marks catheter_;                             ///< all, or of the latest steps if walls move
  Marks bodies_, particles_;                   ///< of the latest steps
  std::size_t next_thinning_ = 0;              ///< number of the catheter's marks at which they are thinned
};

extern template class Run_picture<2>;
extern template class Run_picture<3>;

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_PICTURE_H
