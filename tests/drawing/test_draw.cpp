// SPDX-License-Identifier: LGPL-3.0-or-later
// Pictures of bodies among walls.
#include <cellwalk/drawing/draw.h>
#include <cellwalk/generators/body_shapes.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace cellwalk {
namespace {

template <int D>
class Drawn {
 public:
  Drawn()
      : environment_(Environment<D>::build(grid())),
        body_(environment_, rope<D>({centre(), centre(0.6)}, 0.2)),
        contacts_(body_.step(targets())) {}

  std::string bytes(bool with_body, bool with_contacts) const {
    const auto file =
        std::filesystem::temp_directory_path() / ("cellwalk_drawn_" + std::to_string(::getpid()) + ".png");
    draw(environment_, with_body ? std::vector<const Body<D>*>{&body_} : std::vector<const Body<D>*>{},
         with_contacts ? contacts_ : std::vector<Contact<D>>{}, file.string());
    std::ifstream in(file, std::ios::binary);
    const std::string read{std::istreambuf_iterator<char>(in), {}};
    in.close();
    std::filesystem::remove(file);
    return read;
  }
  std::size_t contacts() const { return contacts_.size(); }
  const Environment<D>& environment() const { return environment_; }

 private:
  std::vector<Point<D>> targets() const {
    std::vector<Point<D>> shifted(body_.positions().begin(), body_.positions().end());
    for (Point<D>& x : shifted) x[1] += 3;
    return shifted;
  }
  static Cell_soup<D> grid() {
    if constexpr (D == 2)
      return square_grid({.cells = {2, 2}});
    else
      return hex_grid({.cells = {2, 2, 2}});
  }
  static Point<D> centre(double shift = 0) {
    Point<D> x;
    x.fill(0.7);
    x[0] += shift;
    return x;
  }

  Environment<D> environment_;
  Body<D> body_;
  std::vector<Contact<D>> contacts_;
};

template <int D>
void expect_all_is_drawn() {
  const Drawn<D> drawn;
  ASSERT_GT(drawn.contacts(), 0u);
  const std::string all = drawn.bytes(true, true), body = drawn.bytes(true, false),
                    walls = drawn.bytes(false, false);
  EXPECT_EQ(all.substr(1, 3), "PNG");
  EXPECT_TRUE(all == drawn.bytes(true, true));
  EXPECT_FALSE(all == body);
  EXPECT_FALSE(body == walls);
}

TEST(Draw, WallsBodiesAndContactsAreSeen2) { expect_all_is_drawn<2>(); }
TEST(Draw, WallsBodiesAndContactsAreSeen3) { expect_all_is_drawn<3>(); }

TEST(Draw, AFileThatCannotBeWrittenIsAnError) {
  const Drawn<3> drawn;
  try {
    draw<3>(drawn.environment(), {}, {}, "/nowhere/at/all.png");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::other);
  }
}

}  // namespace
}  // namespace cellwalk
