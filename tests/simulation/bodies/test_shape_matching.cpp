// SPDX-License-Identifier: LGPL-3.0-or-later
// Goals of shape matching against what defines them: exact on maps of their kind, nearest among rotations,
// without momentum.
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/simulation/shape_matching.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

namespace cellwalk {
namespace {

constexpr Shape_mode modes[] = {Shape_mode::rigid, Shape_mode::linear, Shape_mode::quadratic};

template <int D>
using Rows = std::array<Vector<D>, D>;

template <std::size_t D>
std::array<double, D> image(const std::array<std::array<double, D>, D>& m, const std::array<double, D>& v) {
  std::array<double, D> result;
  for (std::size_t i = 0; i < D; ++i) result[i] = dot(m[i], v);
  return result;
}

Rows<2> random_rotation(Random& random, Rows<2>*) {
  const double a = random.real(-4, 4);
  return {{{std::cos(a), -std::sin(a)}, {std::sin(a), std::cos(a)}}};
}
Rows<3> random_rotation(Random& random, Rows<3>*) {
  for (;;) {
    Rows<3> m;
    for (Vector<3>& row : m)
      for (double& x : row) x = random.real(-1, 1);
    m[2] = cross(m[0], m[1]);
    if (length(m[2]) < 0.1) continue;
    m[1] = cross(m[2], m[0]);
    for (Vector<3>& row : m) row = (1 / length(row)) * row;
    return m;
  }
}
template <int D>
Rows<D> random_rotation(Random& random) {
  return random_rotation(random, static_cast<Rows<D>*>(nullptr));
}

/// n^D points of a grid about the origin, n > 1.
template <int D>
std::vector<Point<D>> block(int n) {
  std::vector<Point<D>> points(static_cast<std::size_t>(std::pow(n, D)));
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = 0, rest = i; k < D; ++k, rest /= static_cast<std::size_t>(n))
      points[i][k] = static_cast<double>(rest % static_cast<std::size_t>(n)) / (n - 1) - 0.5;
  return points;
}

template <int D>
std::vector<Point<D>> mapped(std::vector<Point<D>> points,
                             const std::function<Point<D>(const Point<D>&)>& map) {
  for (Point<D>& x : points) x = map(x);
  return points;
}

template <int D>
std::vector<Point<D>> goals_of(const std::vector<Point<D>>& rest, const Shape_material& material,
                               const std::vector<Point<D>>& positions, std::span<const double> masses = {}) {
  std::vector<Point<D>> goals(rest.size());
  Shape_matching<D>(rest, material, masses).goals(positions, goals);
  return goals;
}

template <int D>
double largest_difference(const std::vector<Point<D>>& a, const std::vector<Point<D>>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, length(a[i] - b[i]));
  return most;
}

template <int D>
void expect_moved_shapes_are_their_own_goals() {
  Random random(1);
  for (const double scale : {1e-6, 1.0, 1e6})
    for (const Shape_mode mode : modes)
      for (int i = 0; i < 20; ++i) {
        const auto rest = mapped<D>(block<D>(3), [&](const Point<D>& x) { return scale * x; });
        const Rows<D> turn = random_rotation<D>(random);
        Vector<D> shift;
        for (double& s : shift) s = scale * random.real(-9, 9);
        const auto moved = mapped<D>(rest, [&](const Point<D>& x) { return image(turn, x) + shift; });
        EXPECT_LT(largest_difference<D>(goals_of<D>(rest, {mode, 1, 0.7, true}, moved), moved),
                  1e-13 * scale);
      }
}

TEST(ShapeMatching, MovedShapesAreTheirOwnGoals2) { expect_moved_shapes_are_their_own_goals<2>(); }
TEST(ShapeMatching, MovedShapesAreTheirOwnGoals3) { expect_moved_shapes_are_their_own_goals<3>(); }

template <int D>
void expect_modes_reproduce_their_maps() {
  Random random(2);
  const auto rest = block<D>(4);
  for (int i = 0; i < 30; ++i) {
    Rows<D> linear;
    Vector<D> bend[D][D];
    for (std::size_t a = 0; a < D; ++a)
      for (std::size_t b = 0; b < D; ++b) {
        linear[a][b] = (a == b) + 0.4 * random.real(-1, 1);
        for (double& c : bend[a][b]) c = 0.3 * random.real(-1, 1);
      }
    const auto sheared = mapped<D>(rest, [&](const Point<D>& x) { return image(linear, x); });
    const auto bent = mapped<D>(sheared, [&](const Point<D>& x) {
      Point<D> y = x;
      for (std::size_t a = 0; a < D; ++a)
        for (std::size_t b = 0; b < D; ++b) y = y + (x[a] * x[b]) * bend[a][b];
      return y;
    });
    const auto far = [&](Shape_mode mode, double deformation, bool volume, const auto& positions) {
      return largest_difference<D>(goals_of<D>(rest, {mode, 1, deformation, volume}, positions), positions);
    };
    EXPECT_LT(far(Shape_mode::linear, 1, false, sheared), 1e-13);
    EXPECT_LT(far(Shape_mode::quadratic, 1, false, sheared), 1e-12);
    EXPECT_LT(far(Shape_mode::quadratic, 1, false, bent), 1e-12);
    // What a mode is not made for is far from its goals.
    EXPECT_GT(far(Shape_mode::rigid, 1, false, sheared), 1e-3);
    EXPECT_GT(far(Shape_mode::linear, 1, true, sheared), 1e-4);
    EXPECT_GT(far(Shape_mode::linear, 1, false, bent), 1e-3);
    EXPECT_GT(far(Shape_mode::quadratic, 0.5, false, bent), 1e-3);
    // Weight 0 of the deformed shape is the rigid mode.
    EXPECT_EQ(goals_of<D>(rest, {Shape_mode::linear, 1, 0, true}, bent),
              goals_of<D>(rest, {Shape_mode::rigid, 1, 0.5, true}, bent));
  }
}

TEST(ShapeMatching, ModesReproduceTheirMaps2) { expect_modes_reproduce_their_maps<2>(); }
TEST(ShapeMatching, ModesReproduceTheirMaps3) { expect_modes_reproduce_their_maps<3>(); }

TEST(ShapeMatching, TheLinearModeKeepsVolume) {
  const auto rest = block<3>(2);
  for (const double squeezed : {0.3, 0.9, 2.5}) {
    const auto positions = mapped<3>(rest, [&](const Point<3>& x) {
      return Point<3>{squeezed * x[0], 1.1 * x[1] + 0.2 * x[0], x[2]};
    });
    const auto volume = [&](bool keeps) {
      const auto g = goals_of<3>(rest, {Shape_mode::linear, 1, 1, keeps}, positions);
      return dot(g[1] - g[0], cross(g[2] - g[0], g[4] - g[0]));
    };
    EXPECT_NEAR(volume(true), 1, 1e-12);
    EXPECT_NEAR(volume(false), 1.1 * squeezed, 1e-12);
  }
  // In the plane it is the area.
  const auto flat = block<2>(2);
  const auto g = goals_of<2>(flat, {Shape_mode::linear, 1, 1, true}, mapped<2>(flat, [](const Point<2>& x) {
                               return Point<2>{0.5 * x[0], 0.9 * x[1]};
                             }));
  EXPECT_NEAR((g[1][0] - g[0][0]) * (g[2][1] - g[0][1]), 1, 1e-12);
}

template <int D>
void expect_goals_have_no_momentum() {
  Random random(3);
  const auto rest = block<D>(3);
  for (const Shape_mode mode : modes)
    for (int i = 0; i < 20; ++i) {
      std::vector<double> masses;
      for (std::size_t k = 0; k < rest.size(); ++k) masses.push_back(random.real(0.5, 2));
      auto positions = rest;
      for (Point<D>& x : positions)
        for (double& c : x) c += 5 + 0.3 * random.real(-1, 1);
      const auto goals = goals_of<D>(rest, {mode, 1, 0.6, true}, positions, masses);
      EXPECT_GT(largest_difference<D>(goals, positions), 0.01);
      Vector<D> push{};
      double turn[3] = {};
      for (std::size_t k = 0; k < rest.size(); ++k) {
        const Vector<D> d = masses[k] * (goals[k] - positions[k]);
        push = push + d;
        for (std::size_t a = 0; a < D; ++a) {
          const std::size_t b = (a + 1) % D;
          turn[a] += positions[k][a] * d[b] - positions[k][b] * d[a];
        }
      }
      EXPECT_LT(length(push), 1e-12);
      for (const double t : turn) EXPECT_LT(std::abs(t), 1e-11);
    }
}

TEST(ShapeMatching, GoalsNeitherPushNorTurnTheBody2) { expect_goals_have_no_momentum<2>(); }
TEST(ShapeMatching, GoalsNeitherPushNorTurnTheBody3) { expect_goals_have_no_momentum<3>(); }

/// Matrices of every rank and sign of the determinant; the nearest rotation has the largest trace of R^T M.
template <int D>
void expect_rotations_are_nearest() {
  Random random(4);
  int reflections = 0, singular = 0;
  const auto score = [](const Rows<D>& r, const Rows<D>& m) {
    double sum = 0;
    for (std::size_t i = 0; i < D; ++i) sum += dot(r[i], m[i]);
    return sum;
  };
  for (int i = 0; i < 200; ++i) {
    const Rows<D> left = random_rotation<D>(random), right = random_rotation<D>(random);
    Vector<D> values;
    for (double& v : values) v = static_cast<double>(random.below(4)) * (random.chance(0.3) ? -1 : 1);
    Rows<D> m{};
    double det = 1;
    for (std::size_t k = 0; k < D; ++k) {
      det *= values[k];
      for (std::size_t a = 0; a < D; ++a)
        for (std::size_t b = 0; b < D; ++b) m[a][b] += values[k] * left[k][a] * right[k][b];
    }
    reflections += det < 0;
    singular += det == 0;
    const Rows<D> r = nearest_rotation<D>(m);
    for (std::size_t a = 0; a < D; ++a)
      for (std::size_t b = 0; b < D; ++b) EXPECT_NEAR(dot(r[a], r[b]), a == b, 1e-13);
    if constexpr (D == 2)
      EXPECT_NEAR(r[0][0] * r[1][1] - r[0][1] * r[1][0], 1, 1e-13);
    else
      EXPECT_NEAR(dot(r[0], cross(r[1], r[2])), 1, 1e-13);
    for (int k = 0; k < 200; ++k) EXPECT_LE(score(random_rotation<D>(random), m), score(r, m) + 1e-12);
  }
  EXPECT_GT(reflections, 20);
  EXPECT_GT(singular, 20);
}

TEST(ShapeMatching, RotationsAreNearest2) { expect_rotations_are_nearest<2>(); }
TEST(ShapeMatching, RotationsAreNearest3) { expect_rotations_are_nearest<3>(); }

TEST(ShapeMatching, RotationsOfNothingAndOfWhatIsNotFiniteAreTheIdentity) {
  const Rows<3> one{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  EXPECT_EQ(nearest_rotation<3>({}), one);
  Rows<3> m = one;
  m[1][2] = std::nan("");
  EXPECT_EQ(nearest_rotation<3>(m), one);
}

/// Rest shapes and positions of every dimension: the rigid goals are congruent to the rest shape, not
/// mirrored, and all finite.
TEST(ShapeMatching, DegenerateShapesHaveGoals) {
  Random random(5);
  int tried = 0;
  for (int rest_dimension = 0; rest_dimension <= 3; ++rest_dimension)
    for (int dimension = 0; dimension <= 3; ++dimension)
      for (const Shape_mode mode : modes)
        for (const bool inside_out : {false, true}) {
          const auto flattened = [&](int n) {
            const Rows<3> turn = random_rotation<3>(random);
            return mapped<3>(block<3>(2), [&](const Point<3>& x) {
              Point<3> y{};
              for (int k = 0; k < n; ++k) y[k] = x[k];
              if (inside_out) y[0] = -y[0];
              return image(turn, y) + Vector<3>{7, 8, 9};
            });
          };
          const auto rest = mapped<3>(flattened(rest_dimension), [&](const Point<3>& x) {
            return inside_out && rest_dimension == 3 ? Point<3>{-x[0], x[1], x[2]} : x;
          });
          const auto positions = flattened(dimension);
          for (const double deformation : {0.0, 0.5}) {
            const auto goals = goals_of<3>(rest, {mode, 1, deformation, true}, positions);
            ++tried;
            for (const Point<3>& g : goals) {
              EXPECT_TRUE(is_finite(g));
              EXPECT_LT(length(g - Point<3>{7, 8, 9}), 4) << rest_dimension << dimension;
            }
            if (deformation > 0) continue;
            for (std::size_t i = 0; i < rest.size(); ++i)
              for (std::size_t j = 0; j < i; ++j)
                EXPECT_NEAR(length(goals[i] - goals[j]), length(rest[i] - rest[j]), 1e-12);
            const auto volume = [](const auto& p) {
              return dot(p[1] - p[0], cross(p[2] - p[0], p[4] - p[0]));
            };
            EXPECT_NEAR(volume(goals), volume(rest), 1e-12);
          }
        }
  EXPECT_EQ(tried, 4 * 4 * 3 * 2 * 2);
}

TEST(ShapeMatching, GivesTheSameBitsWithEveryCompiler) {
  Random random(6);
  std::uint64_t h = 0;
  const auto add = [&](const auto& goals) {
    for (const auto& g : goals)
      for (const double c : g) h = scramble(h ^ std::bit_cast<std::uint64_t>(c));
  };
  for (const Shape_mode mode : modes)
    for (int i = 0; i < 30; ++i) {
      auto solid = block<3>(3);
      auto flat = block<2>(3);
      for (auto& x : solid)
        for (double& c : x) c += 0.4 * random.real(-1, 1);
      for (auto& x : flat)
        for (double& c : x) c += 0.4 * random.real(-1, 1);
      add(goals_of<3>(block<3>(3), {mode, 1, 0.6, true}, solid));
      add(goals_of<2>(block<2>(3), {mode, 1, 0.6, true}, flat));
    }
  EXPECT_EQ(h, 7692919073144945642u);
}

}  // namespace
}  // namespace cellwalk
