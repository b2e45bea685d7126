// SPDX-License-Identifier: LGPL-3.0-or-later
// The bytes of a checkpoint, and the tests of those that are read.
#include "checkpoints.h"

#include <cellwalk/internal/io/mapped_file.h>
#include <cellwalk/internal/kernel/checksum.h>
#include <cellwalk/kernel/error.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <span>
#include <utility>
#include <variant>

#include "cli/common/output_folder.h"
#include "cli/common/printable.h"

namespace cellwalk::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* program = "cellwalk " CELLWALK_VERSION;
constexpr const char* environment_name = "environment.cellwalk";

}  // namespace

Run_settings::Run_settings(const Run_options& options, std::vector<std::string> notes_of_bodies,
                           std::vector<std::string> lines_of_import)
    : scene(options.scene),
      scene_text(options.scene_text),
      record(options.record),
      json(options.json),
      steps(options.steps),
      every(options.checkpoint_every),
      replaced(options.force ? Output_folder::place_of(options.folder).filename().string() : ""),
      sweep(options.body.sweep.sweep),
      notes(std::move(notes_of_bodies)),
      import_lines(std::move(lines_of_import)) {}

namespace {

/// True for settings that no run has, and that would lead out of its folder or end the program. The checksum
/// of a file does not prove who made it.
bool is_impossible(const Run_settings& settings, const Result_files::Lengths& lengths) {
  const auto leads_out = [](const auto& entry) {
    const fs::path name(entry.first);
    return name.is_absolute() || std::ranges::count(name, fs::path("..")) > 0;
  };
  return settings.every == 0 ||
         static_cast<std::uint32_t>(settings.sweep) > static_cast<std::uint32_t>(Sweep::faces) ||
         std::ranges::any_of(lengths, leads_out);
}

}  // namespace

Kept_run read_checkpoint(const fs::path& checkpoints) {
  Kept_run kept;
  kept.checkpoint = io::Checkpoint_folder(checkpoints, program).newest();
  for (const std::string& damage : kept.checkpoint.passed_over)
    fmt::print(stderr, "cellwalk: {}; going on from the checkpoint before\n", printable(damage));
  kept.rest = detail::Byte_reader(kept.checkpoint.state);
  kept.rest(kept.settings, kept.lengths);
  if (is_impossible(kept.settings, kept.lengths)) detail::Byte_reader::refuse();
  return kept;
}

template <int D>
Compiled_environment<D> take_environment(const fs::path& checkpoints, detail::Byte_reader& rest,
                                         detail::Environment_history& history) {
  const auto is_in_file = rest.next<bool>();
  const auto checksum = rest.next<std::uint64_t>();
  Any_compiled_environment any = [&] {
    if (!is_in_file) return open_compiled_copy(rest.next<std::vector<std::byte>>());
    const fs::path path = checkpoints / environment_name;
    const io::Mapped_file file = io::map_file(path);
    if (detail::checksum(file.bytes) != checksum)
      throw Error(Error_code::input, path.string() + ": its checksum differs: begin the run again");
    return open_compiled_copy(file.bytes);
  }();
  auto* const environment = std::get_if<Compiled_environment<D>>(&any);
  if (environment == nullptr) detail::Byte_reader::refuse();
  history = rest.next<detail::Environment_history>();
  return std::move(*environment);
}

template <int D>
Run_checkpoints<D>::Run_checkpoints(const fs::path& checkpoints, Result_files& place, Run_settings settings,
                                    bool changes)
    : folder_(checkpoints, program), place_(place), settings_(std::move(settings)), changes_(changes) {
  if (changes || !place.is_continued()) return;
  environment_ = detail::checksum(io::map_file(checkpoints / environment_name).bytes);
}

template <int D>
std::uint64_t Run_checkpoints<D>::keep_environment(const Environment<D>& environment,
                                                   const Certificate& certificate) {
  if (environment_) return *environment_;
  const std::vector<std::byte> bytes = compile_to_bytes<D>(environment, certificate, {});
  const std::array<std::span<const std::byte>, 1> pieces{bytes};
  io::write_durably(folder_.path() / environment_name, pieces);
  environment_ = detail::checksum(bytes);
  return *environment_;
}

template <int D>
void Run_checkpoints<D>::keep(std::uint32_t step, const Environment<D>& environment,
                              const Certificate& certificate,
                              const std::function<void(detail::Byte_writer&)>& save) {
  detail::Byte_writer parts;
  save(parts);
  detail::Byte_writer out;
  out(settings_, place_.sync());
  if (changes_)
    out(false, std::uint64_t{0}, compile_to_bytes<D>(environment, certificate, {}));
  else
    out(true, keep_environment(environment, certificate));
  out(detail::history_of(environment));
  out.put_bytes(parts.bytes());
  folder_.keep(step, out.bytes());
}

template Compiled_environment<2> take_environment(const fs::path&, detail::Byte_reader&,
                                                  detail::Environment_history&);
template Compiled_environment<3> take_environment(const fs::path&, detail::Byte_reader&,
                                                  detail::Environment_history&);
template class Run_checkpoints<2>;
template class Run_checkpoints<3>;

}  // namespace cellwalk::cli
