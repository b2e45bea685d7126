// SPDX-License-Identifier: LGPL-3.0-or-later
// The parts of a run: the world, its walls and changes, and the files. A new run makes the parts; one that
// goes on reads them from its checkpoint.
#ifndef CELLWALK_CLI_RUN_PARTS_H
#define CELLWALK_CLI_RUN_PARTS_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/kernel/byte_archive.h>
#include <cellwalk/internal/records/scene.h>
#include <cellwalk/internal/simulation/body_trace_recorder.h>
#include <cellwalk/internal/simulation/world.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "changes.h"
#include "files.h"
#include "options.h"
#include "picture.h"
#include "recording.h"
#include "result_files.h"
#include "sharing.h"
#include "trace.h"
#include "walls.h"

namespace cellwalk::cli {

/// The data with which a run begins, and to which it refers until it ends.
template <int D>
struct Run_input {
  const Scene<D>& scene;
  const Run_options& options;
  Environment<D>& environment;
  const Certificate& certificate;           ///< of the environment at the start
  const std::vector<std::string>& notes;    ///< on the files of bodies
  std::vector<std::string> import_lines{};  ///< on the import of the environment

  std::uint32_t steps() const { return options.steps > 0 ? options.steps : scene.steps; }
};

/// The world of a new run.
/// \throw Error as World, naming the scene
template <int D>
World<D> make_world(const Run_input<D>& input, const std::vector<Body_soup<D>>& shapes);
/// The steps after which the first rank needs all positions.
template <int D>
State_times state_times(const Run_input<D>& input, const World<D>& world);

template <int D>
struct Run_parts {
  /// Of a new run.
  /// \param made make_world() of the input
  /// \param groups that the file of the environment names
  /// \throw Error as the parts, naming the scene
  Run_parts(const Run_input<D>& input, Result_files& place, World<D>&& made, const Groups<D>& groups,
            bool is_recorded);
  /// Of one that goes on from where it was saved.
  /// \throw Error(input) for bytes that are none of this scene and environment
  Run_parts(const Run_input<D>& input, Result_files& place, bool is_recorded, detail::Byte_reader& saved);
  Run_parts(const Run_parts&) = delete;
  Run_parts& operator=(const Run_parts&) = delete;

  /// Makes the next step.
  void step(Run_sharing<D>& sharing, bool is_last);
  /// Writes all parts. Files must be synced after that.
  void save(detail::Byte_writer& out);

  World<D> world;
  std::unique_ptr<Body_trace_recorder> record;
  std::optional<Kept_trace> kept_trace;  ///< of `record`, where files stay
  Run_files<D> files;
  std::optional<Run_walls<D>> walls;
  std::optional<Run_changes<D>> changes;
  std::optional<Run_recording<D>> motion;
  std::optional<Run_picture<D>> picture;
};

extern template World<2> make_world(const Run_input<2>&, const std::vector<Body_soup<2>>&);
extern template World<3> make_world(const Run_input<3>&, const std::vector<Body_soup<3>>&);
extern template State_times state_times(const Run_input<2>&, const World<2>&);
extern template State_times state_times(const Run_input<3>&, const World<3>&);
extern template struct Run_parts<2>;
extern template struct Run_parts<3>;

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_RUN_PARTS_H
