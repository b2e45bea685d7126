// SPDX-License-Identifier: LGPL-3.0-or-later
// The same free space by polyhedra and by tetrahedra: cells, memory, moves, and what exactly planar facets
// cost.
#ifndef CELLWALK_EXPERIMENTS_ABLATION_FORMS_H
#define CELLWALK_EXPERIMENTS_ABLATION_FORMS_H

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <string>
#include <type_traits>
#include <vector>

namespace cellwalk::ablation {

/// One mesh in one form.
struct Form_row {
  std::string mesh, form;  ///< "polyhedra" or "tetrahedra"
  std::uint64_t cells_read = 0;
  std::uint64_t not_planar = 0;  ///< cells split because a facet is not exactly planar
  std::uint64_t not_convex = 0;  ///< because they are not exactly convex
  std::uint64_t cells = 0, facets = 0, bytes = 0;
  std::uint64_t moves = 0, blocked = 0, crossings = 0;
  std::vector<double> nanoseconds;  ///< a move, of each round
};

/// All members, for experiments::shared_trials().
template <class Archive, class Value>
void members(Archive& archive, Value& row) requires std::same_as<std::remove_const_t<Value>, Form_row> {
  archive(row.mesh);
  archive(row.form);
  for (auto* count : {&row.cells_read, &row.not_planar, &row.not_convex, &row.cells, &row.facets, &row.bytes,
                      &row.moves, &row.blocked, &row.crossings})
    archive(*count);
  archive(row.nanoseconds);
}

struct Form_setting {
  std::string mesh;  ///< a generated one by its name, or a file
  std::filesystem::path file{};
  bool is_small = false;
  std::uint64_t seed = 1;
};

/// The generated meshes, and those of a folder of public ones, if it is not empty.
std::vector<Form_setting> form_settings(bool is_small, const std::filesystem::path& data, std::uint64_t seed);

/// Both forms of a mesh. Particles start at the same places, and make the same moves, of half the mean length
/// of an edge of the polyhedra.
/// \throw Error as Environment::build(), io::read_mesh()
std::vector<Form_row> run_forms(const Form_setting& setting, int rounds);

}  // namespace cellwalk::ablation

#endif  // CELLWALK_EXPERIMENTS_ABLATION_FORMS_H
