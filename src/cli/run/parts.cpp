// SPDX-License-Identifier: LGPL-3.0-or-later
// The construction of all parts, from a scene or a checkpoint, and the order of their steps.
#include "parts.h"

#include <cellwalk/internal/simulation/saved_state.h>
#include <cellwalk/kernel/error.h>

#include <fmt/core.h>

#include <utility>

namespace cellwalk::cli {

template <int D>
World<D> make_world(const Run_input<D>& input, const std::vector<Body_soup<D>>& shapes) {
  try {
    return World<D>(input.environment.snapshot(), input.scene, shapes, input.options.body);
  } catch (const Error& error) {
    // The values of a scene are input, whatever they would be in a call.
    const auto code = error.code() == Error_code::usage ? Error_code::input : error.code();
    throw Error(code, fmt::format("{}: {}", input.options.scene, error.what()));
  }
}

template <int D>
State_times state_times(const Run_input<D>& input, const World<D>& world) {
  const Scene_output& output = input.scene.output;
  return {input.steps(), output.frame_every,
          motion_interval(input.scene, input.environment.snapshot(), world, input.steps()),
          output.picture.has_value() && !world.particles().empty()};
}

template <int D>
Run_parts<D>::Run_parts(const Run_input<D>& input, Result_files& place, World<D>&& made,
                        const Groups<D>& groups, bool is_recorded)
    : world(std::move(made)),
      record(is_recorded ? start_trace(input.options.scene, world) : nullptr),
      files(place, input.environment, world, input.scene) {
  const Scene<D>& scene = input.scene;
  if (record && place.grows()) kept_trace.emplace(place);
  if (scene.walls) walls.emplace(place, input.environment, scene, input.options.scene);
  if (!scene.changes.list.empty())
    changes.emplace(place, input.environment, scene.changes, groups, input.options.scene);
  const Snapshot<D>& snapshot = input.environment.snapshot();
  if (const std::uint32_t every = motion_interval(scene, snapshot, world, input.steps()); every > 0)
    motion.emplace(place, snapshot, world, Motion_times{scene.time_step, input.steps(), every},
                   wall_motion(scene));
  if (scene.output.picture) picture.emplace(snapshot, world, scene.walls.has_value());
}

template <int D>
Run_parts<D>::Run_parts(const Run_input<D>& input, Result_files& place, bool is_recorded,
                        detail::Byte_reader& saved)
    : world(detail::State_access<D>(input.environment.snapshot(), input.scene)
                .read_world(saved, input.options.body)),
      files(place, input.environment, world, input.scene) {
  const Scene<D>& scene = input.scene;
  if (is_recorded) {
    kept_trace.emplace(place);
    record = go_on_with_trace(world, kept_trace->read());
  }
  saved(files);
  if (scene.walls) walls.emplace(place, input.environment, scene, input.options.scene, saved);
  if (!scene.changes.list.empty()) changes.emplace(place, input.environment, scene, saved);
  if (saved.next<bool>()) motion.emplace(place, input.environment.snapshot(), wall_motion(scene), saved);
  if (scene.output.picture) {
    picture.emplace(input.environment.snapshot(), world, scene.walls.has_value());
    saved(*picture);
  }
  saved.expect_end();
  place.check_complete();
}

template <int D>
void Run_parts<D>::step(Run_sharing<D>& sharing, bool is_last) {
  if (changes) {
    const std::vector<Change_outcome> made = changes->step(world);
    if (walls) walls->follow(made);
  }
  if (walls) walls->step(world);
  world.step();
  sharing.step();
  if (record) record->record_step();
  files.record(world, is_last);
  if (motion) motion->record(world, is_last);
  if (picture) picture->record(world);
}

template <int D>
void Run_parts<D>::save(detail::Byte_writer& out) {
  detail::save(out, world);
  if (record) kept_trace->append(record->trace());
  out(files);
  if (walls) walls->save(out);
  if (changes) changes->save(out);
  out(motion.has_value());
  if (motion) motion->save(out);
  if (picture) out(*picture);
}

template World<2> make_world(const Run_input<2>&, const std::vector<Body_soup<2>>&);
template World<3> make_world(const Run_input<3>&, const std::vector<Body_soup<3>>&);
template State_times state_times(const Run_input<2>&, const World<2>&);
template State_times state_times(const Run_input<3>&, const World<3>&);
template struct Run_parts<2>;
template struct Run_parts<3>;

}  // namespace cellwalk::cli
