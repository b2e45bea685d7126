// SPDX-License-Identifier: LGPL-3.0-or-later
// What the figures in space have in common: floor, spikes, edges, contacts.
#ifndef CELLWALK_EXPERIMENTS_FIGURES_SPACE_PLOT_H
#define CELLWALK_EXPERIMENTS_FIGURES_SPACE_PLOT_H

#include <cellwalk/internal/drawing/figure.h>
#include <cellwalk/walk/contact.h>

#include <span>
#include <string>
#include <vector>

namespace cellwalk::figures {

namespace colours {
constexpr drawing::Colour floor{0.93, 0.93, 0.94}, spike{0.56, 0.56, 0.60}, cell{0.55, 0.63, 0.74},
    swept{0.95, 0.62, 0.12, 0.45}, start{0.08, 0.16, 0.42}, contact{0.80, 0.10, 0.10};
}

/// A panel under construction. Sizes are in units of the environment.
class Space_plot {
 public:
  /// Draws the walls on the floor and on spikes, and the outlines of the given cells.
  Space_plot(const std::string& title, const Snapshot<3>& snapshot, const std::vector<Cell>& cells);

  void line(const Point<3>& from, const Point<3>& to, double radius, const drawing::Colour& colour);
  void dashes(const Point<3>& from, const Point<3>& to, double radius, const drawing::Colour& colour);
  void triangle(const Point<3>& x, const Point<3>& y, const Point<3>& z, const drawing::Colour& colour);
  void ball(const Point<3>& at, double radius, const drawing::Colour& colour);
  /// The point and the normal of a contact.
  void contact(const Contact<3>& contact);
  void label(const Point<3>& at, const std::string& text, double right, double up);

  const drawing::Panel& panel() const { return panel_; }

 private:
  std::uint32_t material(const drawing::Colour& colour, bool lit);

  drawing::Panel panel_;
};

}  // namespace cellwalk::figures

#endif  // CELLWALK_EXPERIMENTS_FIGURES_SPACE_PLOT_H
