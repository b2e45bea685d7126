// SPDX-License-Identifier: LGPL-3.0-or-later
// The states and contacts that the first rank gathers after each step.
#include "sharing.h"

namespace cellwalk::cli {

template <int D>
std::string why_not_shared(const Scene<D>& scene, bool is_recorded, bool is_kept) {
  if (scene.walls) return "walls move";
  if (!scene.changes.list.empty()) return "facets or cells change";
  if (is_recorded) return "a trace is recorded";
  return is_kept ? "checkpoints are kept" : "";
}

template <int D>
Run_sharing<D>::Run_sharing(Ranks& ranks, World<D>& world, const State_times& times)
    : ranks_(ranks), world_(world), times_(times) {
  if (!ranks.is_alone()) part_.emplace(world, ranks.rank(), ranks.size());
}

/// Of a frame, the step before it is needed too, for velocities.
template <int D>
bool Run_sharing<D>::needs_states() const {
  const std::uint32_t step = world_.steps_done();
  const auto is_due = [](std::uint32_t at, std::uint32_t every) { return every > 0 && at % every == 0; };
  if (step == times_.steps || times_.trails) return true;
  if (times_.frames > 0 && step + 1 == times_.steps) return true;
  return is_due(step, times_.frames) || is_due(step + 1, times_.frames) || is_due(step, times_.motion);
}

template <int D>
void Run_sharing<D>::exchange(const State_request& request) {
  bool is_own = true;
  ranks_.gather(ranks_.is_first() ? std::string{} : part_->state_of_part(request),
                [&](const std::string& told) {
                  if (!is_own) part_->take_over(told);
                  is_own = false;
                });
}

template <int D>
void Run_sharing<D>::step() {
  if (!part_) return;
  exchange({true, needs_states()});
  if (ranks_.is_first()) part_->sort_contacts();
}

template <int D>
void Run_sharing<D>::finish() {
  if (part_) exchange({false, true});
}

template std::string why_not_shared(const Scene<2>&, bool, bool);
template std::string why_not_shared(const Scene<3>&, bool, bool);
template class Run_sharing<2>;
template class Run_sharing<3>;

}  // namespace cellwalk::cli
