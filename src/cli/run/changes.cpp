// SPDX-License-Identifier: LGPL-3.0-or-later
// The changes due at each step, applied and noted in their table.
#include "changes.h"

#include <cellwalk/loading/environment_file.h>

#include <nlohmann/json.hpp>

#include "cli/common/counts_json.h"

namespace cellwalk::cli {

template <int D>
Run_changes<D>::Run_changes(Result_files& place, Environment<D>& environment,
                            const Environment_changes<D>& changes, const Groups<D>& groups,
                            const std::string& scene)
    : environment_(environment),
      schedule_(naming(scene, [&] { return Change_schedule<D>(environment.snapshot(), changes, groups); })),
      table_(environment.snapshot(), place.table("changes.csv", Changes_table<D>::columns())) {}

template <int D>
Run_changes<D>::Run_changes(Result_files& place, Environment<D>& environment, const Scene<D>& scene,
                            detail::Byte_reader& saved)
    : environment_(environment),
      schedule_(detail::State_access<D>(environment.snapshot(), scene).read_schedule(saved)),
      table_(environment.snapshot(), place.table("changes.csv", Changes_table<D>::columns())) {
  saved(table_, counts_);
}

template <int D>
void Run_changes<D>::save(detail::Byte_writer& out) const {
  detail::save(out, schedule_);
  out(table_, counts_);
}

template <int D>
std::vector<Change_outcome> Run_changes<D>::step(World<D>& world) {
  const std::uint32_t step = world.steps_done() + 1;
  std::vector<Change_outcome> outcomes = world.change(environment_, schedule_, counts_);
  table_.add(step, outcomes);
  return outcomes;
}

template <int D>
nlohmann::ordered_json Run_changes<D>::report() const {
  nlohmann::ordered_json json = table_.to_json();
  json["counts"] = to_json(counts_);
  json["counts"]["walk"] = to_json(counts_.walk);
  return json;
}

template class Run_changes<2>;
template class Run_changes<3>;

}  // namespace cellwalk::cli
