// SPDX-License-Identifier: LGPL-3.0-or-later
// Imported environments in files that are named after all they depend on.
#include <cellwalk/internal/environment/image_format.h>
#include <cellwalk/internal/io/mapped_file.h>
#include <cellwalk/internal/io/mesh_files.h>
#include <cellwalk/internal/kernel/checksum.h>
#include <cellwalk/internal/loading/import_call.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <span>
#include <system_error>
#include <utility>

namespace cellwalk {
namespace {

namespace fs = std::filesystem;

std::uint64_t content(const fs::path& file) { return detail::checksum(io::map_file(file).bytes); }

/// A description of all bytes that are read for a mesh; none if they can be read only once, or not at all.
std::optional<std::string> described_bytes(const fs::path& mesh) {
  std::error_code none;
  const std::vector<fs::path> files = io::files_of_mesh(mesh);
  const bool can_be_read_again =
      std::ranges::all_of(files, [&none](const fs::path& file) { return fs::is_regular_file(file, none); });
  if (files.empty() || !can_be_read_again) return std::nullopt;
  std::string text;
  for (const fs::path& file : files)
    text +=
        fmt::format("{} {:016x}\n",
                    files.size() == 1 ? file.extension().string() : file.lexically_relative(mesh).string(),
                    content(file));
  return text;
}

std::string described(const Import_call::Value& value) {
  return std::visit(
      []<class T>(const T& v) -> std::string {
        if constexpr (std::is_same_v<T, std::vector<double>>)
          return fmt::format("{}", fmt::join(v, ","));
        else
          return fmt::format("{}", v);
      },
      value);
}

/// The name of the file for an import; none if it cannot be named.
std::optional<fs::path> kept_name(const Import_call& call, const Build_options& options) {
  std::string text = fmt::format("cellwalk {} image {} simplicial {}\n", CELLWALK_VERSION,
                                 detail::image_version, options.simplicial);
  std::vector<std::string> meshes{call.file};
  meshes.insert(meshes.end(), call.obstacles.begin(), call.obstacles.end());
  for (const std::string& mesh : meshes) {
    const std::optional<std::string> bytes = described_bytes(mesh);
    if (!bytes) return std::nullopt;
    text += "mesh\n" + *bytes;
  }
  for (const auto& [name, value] : call.options) text += fmt::format("{}={}\n", name, described(value));
  const std::uint64_t sum = detail::checksum(std::as_bytes(std::span(text.data(), text.size())));
  return fs::path(call.cache) / fmt::format("{:016x}.cellwalk", sum);
}

std::vector<std::string> lines_of(const Import_report& report) {
  std::vector<std::string> lines;
  for (const Import_report::Stage& stage : report.stages)
    for (const std::string& line : stage.lines) lines.push_back(stage.title + ": " + line);
  return lines;
}

/// \return why it is not kept; empty if it is
std::string keep(const fs::path& name, Imported_environment& imported) {
  try {
    std::error_code failed;
    fs::create_directories(name.parent_path(), failed);
    if (failed) return name.parent_path().string() + ": " + failed.message();
    std::visit(
        [&]<int D>(Environment<D>& environment) {
          write_environment(name, environment, imported.built.certificate,
                            std::get<Groups<D>>(imported.groups));
        },
        imported.environment);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace

Kept_import import_or_reopen(const Import_call& call, const Build_options& options,
                             std::function<void(const std::string&)> on_stage) {
  Import_options how = import_options(call);
  how.build.simplicial = how.build.simplicial || options.simplicial;
  how.build.keep_map = options.keep_map;
  how.on_stage = std::move(on_stage);
  const std::optional<fs::path> name = kept_name(call, how.build);
  Build_options as_it_is;
  as_it_is.keep_map = options.keep_map;
  std::string damage;
  std::error_code none;
  if (name && fs::exists(*name, none)) {
    try {
      return {load_environment(name->string(), as_it_is),
              {fmt::format("{}, from the cache: {}", call.file, name->string())}};
    } catch (const Error& error) {
      damage = error.what();
    }
  }
  Imported_environment imported = import_environment(call.file, how);
  const std::string not_kept = name ? keep(*name, imported) : call.file + " can be read only once";
  std::vector<std::string> lines{
      not_kept.empty() ? fmt::format("{}, kept for the next run: {}", call.file, name->string())
                       : fmt::format("{}, and not kept for the next run: {}", call.file, not_kept)};
  if (!damage.empty()) lines.push_back("again, as the cache was damaged: " + damage);
  for (std::string& line : lines_of(imported.report)) lines.push_back(std::move(line));
  if (not_kept.empty()) return {load_environment(name->string(), as_it_is), std::move(lines)};
  return {{std::move(imported.environment), std::move(imported.built), {}, std::move(imported.groups)},
          std::move(lines)};
}

}  // namespace cellwalk
