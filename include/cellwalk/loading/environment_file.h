// SPDX-License-Identifier: LGPL-3.0-or-later
// Environments from files: read, meshed if the file contains no cells, and certified.
#ifndef CELLWALK_LOADING_ENVIRONMENT_FILE_H
#define CELLWALK_LOADING_ENVIRONMENT_FILE_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/selection.h>
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/kernel/error.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace cellwalk {

/// of_dimension<3>(any) is the one of three dimensions, or an Error.
using Any_environment = std::variant<Environment<2>, Environment<3>>;
/// Of the same dimension.
using Any_groups = std::variant<Groups<2>, Groups<3>>;

struct Loaded_environment {
  Any_environment environment;
  Build_report built;
  io::Read_report read;
  Any_groups groups{};       ///< that the file names
  bool is_compiled = false;  ///< opened as it was compiled
};

/// Runs `work`, and prepends `path: ` to the message of an Error that does not name the file.
template <class Work>
auto naming(const std::string& path, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const Error& error) {
    const std::string message = error.what();
    throw Error(error.code(), message.starts_with(path) ? message : path + ": " + message);
  }
}

/// Reads a file of cells and certifies it unchanged: nothing is split, merged or flipped.
///
/// A compiled environment (open_compiled()) is mapped, whatever its name, and was certified when it was
/// written: nothing is certified again, and vertices in the same place stay as they are. It gets its map if
/// options.keep_map is set, and is built of its cells if options.simplicial is set and it has others than
/// simplices.
/// \throw Error(input) if it is unreadable or contains no cells, Error(not_certified) with the cell and the
///        reason
/// Cost: that of reading and of Environment::build(), or of open_compiled().
Loaded_environment load_environment(const std::string& path, Build_options options);

/// True if a file has the name of compiled environments, *.cellwalk.
bool is_compiled_name(const std::filesystem::path& path);

/// True if a file has this name, or is none but begins as compiled environments do.
bool is_compiled_file(const std::string& path);

/// Writes an environment: compiled, if the file is named *.cellwalk, or else in OpenVolumeMesh. It appears
/// complete or not at all. Indices that edits left unused are given up first, as OpenVolumeMesh has none: see
/// Environment::compact().
/// \param path of the file
/// \param environment whose unused indices are given up
/// \param certificate of the environment as it is now
/// \param groups of its facets and cells
/// \throw Error(other) if it cannot be written
template <int D>
void write_environment(const std::filesystem::path& path, Environment<D>& environment,
                       const Certificate& certificate, const Groups<D>& groups = {});
extern template void write_environment(const std::filesystem::path&, Environment<2>&, const Certificate&,
                                       const Groups<2>&);
extern template void write_environment(const std::filesystem::path&, Environment<3>&, const Certificate&,
                                       const Groups<3>&);

enum class Mesher { tetgen, mesh3 };

struct Mesher_options {
  Mesher mesher = Mesher::tetgen;
  /// TetGen: bound of circumradius to shortest edge; 0: none; not given: its default
  std::optional<double> quality{};
  /// Bound of circumradii (Mesh_3), or of volumes by that of a regular tetrahedron of this circumradius
  /// (TetGen), in units of the surface; 0: the default of Mesh_3, none for TetGen
  double cell_size = 0;
  double distance = 0;          ///< Mesh_3: maximal distance of the boundary from the surface; 0: its default
  bool keep_obstacles = false;  ///< not by Mesh_3
  /// Names of the obstacles in messages; default: "obstacle 1", ...
  std::vector<std::string> obstacle_names{};
  /// Surfaces that are not closed, not manifold or cross themselves are refused, as those with obstacles and
  /// for Mesh_3 always are, and cells that do not conform; false: they are repaired, and get common facets
  bool is_strict = false;
  Repair_options repair{};  ///< with points inside, also a surface without defects is meshed around them
  double time_limit = 600;  ///< seconds that TetGen or Mesh_3 may take in all, greater than 0
  /// Called at least every tenth of a second while TetGen or Mesh_3 runs. An exception that it throws ends
  /// the mesher and passes through.
  std::function<void()> on_wait{};
};

struct Import_options {
  std::vector<std::string> obstacles;  ///< files of closed surfaces inside; only with a surface
  Mesher_options mesher;
  Build_options build{.keep_map = false};
  /// For files of cells, unless duplicates are kept: where facets of two free cells overlap in a plane (2D: a
  /// line), they get common pieces. 0: by exact tests, and facets that only rounding keeps apart are refused.
  /// Otherwise, as a part of the diagonal, within this distance of each other. Not given: cells stay as they
  /// are, and Environment::build() refuses those that overlap.
  std::optional<double> conform = 0;
  /// If not 0: 3D cells are surrounded by solid ones up to a box at this distance, see surround_by_tissue().
  double tissue = 0;
  /// Names of caps and mouths: each goes to the one whose centre is the nearest to the point.
  std::map<std::string, Point<3>> names{};
  /// Called before each stage of long work with its description, such as "reading part.off".
  std::function<void(const std::string&)> on_stage{};
  /// Called with a surface as it was read, before it is meshed.
  std::function<void(const Surface_soup&)> on_surface{};
};

/// The report of an import, stage by stage. Nothing is repaired silently.
struct Import_report {
  struct Stage {
    std::string title;  ///< "read", "repaired", "meshed", "refined", "changed", "noted", "tissue"
    std::vector<std::string> lines;
  };
  std::vector<Stage> stages;
  /// The same for programs: read, repaired, meshed, refined, changed, tissue, certificate.
  nlohmann::ordered_json json;
};

struct Imported_environment {
  Any_environment environment;
  Build_report built;
  Import_report report;
  Any_groups groups{};       ///< that the file names
  bool is_compiled = false;  ///< opened as it was compiled
};

/// Converts any mesh file to a certified environment: cells are certified, and split or given common facets
/// if necessary; a surface is filled with tetrahedra, after repairs if it needs any, a planar domain with
/// triangles.
/// \throw Error(input) if a file is unreadable, a surface encloses nothing, or an obstacle is not a closed
///        surface, Error(not_certified)
///        with the cell and the reason, Error(usage) for obstacles without a surface, for tissue in 2D or as
///        surround_by_tissue(), and if this build cannot mesh
/// Cost: that of the readers, the mesher and Environment::build().
Imported_environment import_environment(const std::string& path, const Import_options& options);

}  // namespace cellwalk

#endif  // CELLWALK_LOADING_ENVIRONMENT_FILE_H
