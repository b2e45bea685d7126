// SPDX-License-Identifier: LGPL-3.0-or-later
// A mesh file becomes an environment; then questions about motions of points and of edges that were in no
// cell before.
//
// usage: import_and_query MESH    a closed surface (needs meshing), or cells of space
#include <cellwalk/cellwalk.h>
#include <cellwalk/loading/environment_file.h>

#include <cstdio>
#include <string>

using namespace cellwalk;

namespace {

//! [answer]
std::string text(const Answer<3>& answer) {
  if (!answer.contact) return motion_status_names[static_cast<int>(answer.status)];
  const Contact<3>& contact = *answer.contact;
  char line[128];
  std::snprintf(line, sizeof line, "contact at time %.6f, point (%.6f %.6f %.6f), by %s", contact.time,
                contact.point[0], contact.point[1], contact.point[2],
                contact.body == Body_feature::vertex ? "the moving end" : "the edge");
  return line;
}
//! [answer]

//! [query]
void ask(const Snapshot<3>& snapshot) {
  const Locator<3> locator(snapshot);  // once: it takes some time for each cell
  Edge_counts counts;

  // Points: from here to there.
  const Point<3> inside{1, 0, 0}, opposite{-1, 0, 0}, beside{1, 0.125, 0.125}, outside{9, 0, 0};
  for (const Point<3>& target : {beside, opposite, outside})
    std::printf("point: %s\n", text(answer_move(snapshot, locator, inside, target, {}, counts)).c_str());
  std::printf("point: %s\n", text(answer_move(snapshot, locator, outside, inside, {}, counts)).c_str());

  // Edges: one end moves, the other stands still, and everything between is swept.
  const Edge_motion<3> free_motion{{1, 0.125, 0}, {1, 0.125, 0.125}, inside};
  const Edge_motion<3> blocked_motion{{1, 0.125, 0}, {-0.1875, 1, 0}, {1, -0.125, 0}};
  for (const Edge_motion<3>& motion : {free_motion, blocked_motion})
    std::printf("edge: %s\n", text(answer_sweep(snapshot, locator, motion, {}, counts)).c_str());
}
//! [query]

}  // namespace

//! [import]
int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: import_and_query MESH\n");
    return 2;
  }
  try {
    const Imported_environment imported = import_environment(argv[1], {});
    for (const auto& stage : imported.report.stages)
      std::printf("%s: %s\n", stage.title.c_str(), stage.title == "read" ? "done" : stage.lines[0].c_str());
    ask(of_dimension<3>(imported.environment).snapshot());
  } catch (const Error& error) {  // one line: what is wrong, where, and what to do
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());
  }
}
//! [import]
