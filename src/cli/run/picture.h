// SPDX-License-Identifier: LGPL-3.0-or-later
// The still picture of a run: walls, what moved, where it had been, and the contacts with their normals.
#ifndef CELLWALK_CLI_RUN_PICTURE_H
#define CELLWALK_CLI_RUN_PICTURE_H

#include <cellwalk/internal/drawing/picture.h>
#include <cellwalk/internal/simulation/saved_contacts.h>
#include <cellwalk/records/cell_soup.h>
#include <cellwalk/simulation/world.h>

#include <string>
#include <vector>

namespace cellwalk::cli {

/// Collects what a picture of the last step shows.
template <int D>
class Run_picture {
 public:
  /// \param walls_move where they did so, earlier contacts of the catheter lie off them, and are left out
  Run_picture(const World<D>& world, bool walls_move);

  /// To be called after each step.
  void record(const World<D>& world);

  drawing::Drawing draw(const Cell_soup<D>& soup, const World<D>& world, const Scene<D>& scene,
                        const std::string& caption) const;

  template <class Archive>
  void archive(Archive& a) {
    a(trails_, catheter_contacts_, body_contacts_, free_contacts_);
  }

 private:
  bool walls_move_;
  std::vector<std::vector<Point<D>>> trails_;  ///< of the particles, the latest steps only
  std::vector<Run_contact<D>> catheter_contacts_;
  std::vector<Run_contact<D>> body_contacts_, free_contacts_;  ///< of the latest steps
};

extern template class Run_picture<2>;
extern template class Run_picture<3>;

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_PICTURE_H
