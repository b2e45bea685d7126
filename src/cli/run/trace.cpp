// SPDX-License-Identifier: LGPL-3.0-or-later
// The start, the checkpoints and the end of a trace of a run.
#include "trace.h"

#include <cellwalk/internal/io/mapped_file.h>
#include <cellwalk/internal/io/trace_file.h>
#include <cellwalk/internal/kernel/byte_archive.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <type_traits>
#include <utility>
#include <vector>

#include "cli/common/environment_file.h"

namespace cellwalk::cli {

template <int D>
void check_recordable(const Scene<D>& scene, const std::string& scene_name) {
  const auto refuse = [&](const char* key, const char* what) {
    throw Error(Error_code::input, fmt::format("{}: {}: {}", scene_name, key, what));
  };
  if (D == 2) refuse("dimension", "a trace holds 3D bodies: record a scene of dimension 3");
  if (scene.walls) refuse("walls", "a trace has walls that stand still: leave them out");
  if (!scene.changes.list.empty())
    refuse("changes", "a trace has walls that stay as they are: leave them out");
  if (!scene.particles.empty()) refuse("particles", "a trace holds bodies only: leave them out");
}

std::unique_ptr<Body_trace_recorder> start_trace(const std::string& scene_name, const World<3>& world) {
  return naming(scene_name, [&] { return std::make_unique<Body_trace_recorder>(world); });
}

std::unique_ptr<Body_trace_recorder> start_trace(const std::string&, const World<2>&) { return nullptr; }

std::unique_ptr<Body_trace_recorder> go_on_with_trace(const World<3>& world, Body_trace trace) {
  return std::make_unique<Body_trace_recorder>(world, std::move(trace));
}

std::unique_ptr<Body_trace_recorder> go_on_with_trace(const World<2>&, Body_trace) { return nullptr; }

void write_trace(const Body_trace& trace, io::Atomic_file* file, const std::filesystem::path& results) {
  if (file != nullptr) return io::write_trace(*file, trace);
  io::Atomic_file inside(results / kept_trace_name);
  io::write_trace(inside, trace);
  inside.commit();
}

Kept_trace::Kept_trace(Result_files& place)
    : path_(place.aside_path("record.content")), file_(place.aside("record.content")) {}

void Kept_trace::append(const Body_trace& trace) {
  const auto tail = [](const auto& list, std::size_t& done) {
    const std::vector since(list.begin() + static_cast<std::ptrdiff_t>(done), list.end());
    done = list.size();
    return since;
  };
  detail::Byte_writer out;
  out(trace.steps, tail(trace.before, before_), tail(trace.targets, targets_), tail(trace.answers, answers_));
  file_->write({reinterpret_cast<const char*>(out.bytes().data()), out.bytes().size()});
}

Body_trace Kept_trace::read() {
  const io::Mapped_file file = io::map_file(path_);
  const auto take = [](auto& all, std::size_t& done, detail::Byte_reader& in) {
    const auto since = in.next<std::remove_reference_t<decltype(all)>>();
    all.insert(all.end(), since.begin(), since.end());
    done = all.size();
  };
  Body_trace trace;
  detail::Byte_reader in(file.bytes);
  while (!in.is_at_end()) {
    in(trace.steps);
    take(trace.before, before_, in);
    take(trace.targets, targets_, in);
    take(trace.answers, answers_, in);
  }
  return trace;
}

template void check_recordable(const Scene<2>&, const std::string&);
template void check_recordable(const Scene<3>&, const std::string&);

}  // namespace cellwalk::cli
