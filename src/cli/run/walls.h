// SPDX-License-Identifier: LGPL-3.0-or-later
// Walls that move in a run: by a pulsation, or by a table.
#ifndef CELLWALK_CLI_RUN_WALLS_H
#define CELLWALK_CLI_RUN_WALLS_H

#include <cellwalk/internal/io/csv.h>
#include <cellwalk/internal/simulation/elastic_foundation.h>
#include <cellwalk/internal/simulation/saved_state.h>
#include <cellwalk/internal/simulation/tissue.h>
#include <cellwalk/internal/simulation/wall_pulsation.h>
#include <cellwalk/internal/simulation/world.h>

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/common/move_end_names.h"
#include "cli/common/moves_file.h"
#include "result_files.h"

namespace cellwalk::cli {

/// Moves the walls before each step of a world. Writes their contacts to walls.csv and, if they are soft, the
/// forces on them to forces.csv.
template <int D>
class Run_walls {
 public:
  /// \param place of the tables
  /// \param name of the scene, for errors
  /// \throw Error(input) for a table that is none, or an environment with cells at points that move that are
  ///        no simplices
  Run_walls(Result_files& place, Environment<D>& environment, const Scene<D>& scene, const std::string& name);
  /// Those that were saved, in an environment that is as it was then.
  Run_walls(Result_files& place, Environment<D>& environment, const Scene<D>& scene, const std::string& name,
            detail::Byte_reader& saved);
  void save(detail::Byte_writer& out) const;

  /// Moves the walls to where they are to be after the next step. The rest of a motion that is blocked is
  /// tried again in the step after.
  void step(World<D>& world);

  /// To be called after changes of facets and cells.
  void follow(std::span<const Change_outcome> changes);

  /// Completes the tables.
  void finish();

  nlohmann::ordered_json report() const;
  std::string describe() const;

 private:
  /// How they move is left.
  struct Still {};
  Run_walls(Result_files& place, Environment<D>& environment, const Scene<D>& scene, const std::string& name,
            Still);
  template <class Archive>
  void archive(Archive& a) {
    a(largest_stretch_, largest_yield_, largest_force_, motion_, next_, pending_, relax_options_.keep,
      relaxed_.smoothed, relaxed_.flipped, relaxed_.edges_removed, relaxed_.split, relaxed_.collapsed, moves_,
      ends_, hits_, counts_);
  }
  friend detail::Byte_reader;
  friend detail::Byte_writer;

  std::vector<Vertex_move<D>> targets(const World<D>& world, std::uint32_t step);
  void move(World<D>& world, std::uint32_t step, const std::vector<Vertex_move<D>>& moves);
  bool relax(World<D>& world, std::span<const Vertex_result<D>> short_of_target);
  void go_on(World<D>& world, std::uint32_t step, const std::vector<Vertex_move<D>>& moves,
             std::vector<Vertex_result<D>>& short_of_target);
  void record(std::uint32_t step, const Move_report<D>& report);
  void record_forces(std::uint32_t step);

  Environment<D>& environment_;
  double time_step_;
  Reshape_options options_;
  io::Csv_writer table_;
  std::optional<Wall_pulsation<D>> pulsation_;
  std::optional<Elastic_foundation<D>> foundation_;
  std::optional<Tissue_material> material_;
  std::vector<Scene_shape<D>> fixed_;
  std::string name_;                 ///< of the scene
  std::optional<Tissue<D>> tissue_;  ///< from the first step on
  double largest_stretch_ = 0;       ///< of the tissue, in any step
  std::optional<io::Csv_writer> forces_;
  double largest_yield_ = 0, largest_force_ = 0;  ///< of any step
  std::vector<Timed_move<D>> motion_;
  std::size_t next_ = 0;                       ///< of the motion
  std::map<std::uint32_t, Point<D>> pending_;  ///< places of the motion that points did not reach yet
  std::optional<Wall_relaxation> relaxation_;
  Relax_options relax_options_;
  Relax_report relaxed_;     ///< operations of all steps
  std::uint64_t moves_ = 0;  ///< of points, requested
  std::array<std::uint64_t, move_end_names.size()> ends_{};
  std::uint64_t hits_ = 0;
  Reshape_counts counts_;
};

extern template class Run_walls<2>;
extern template class Run_walls<3>;

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_WALLS_H
