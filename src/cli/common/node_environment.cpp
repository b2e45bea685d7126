// SPDX-License-Identifier: LGPL-3.0-or-later
// An environment that one rank compiles into an unnamed file, and the others of its node map.
#include "node_environment.h"

#include <cellwalk/environment/compiled.h>

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <variant>

#include "environment_file.h"

namespace cellwalk::cli {
namespace {

/// Writes all bytes; false if the system refuses.
bool write_all(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return true;
}

/// The name by which ranks of this node open the compiled bytes of an environment: those of an unnamed file
/// of this process, which lasts as long as some rank runs. Empty if there is no memory for it.
std::string keep_for_node(const Loaded_environment& loaded) {
  const int descriptor = memfd_create("environment", MFD_CLOEXEC);
  if (descriptor < 0) return {};
  bool is_written = true;
  const auto put = [&](std::span<const std::byte> bytes) {
    is_written = is_written && write_all(descriptor, bytes);
  };
  const auto write = [&]<int D>(const Environment<D>& environment) {
    const auto* const groups = std::get_if<Groups<D>>(&loaded.groups);  // none if it is generated
    write_compiled(environment, loaded.built.certificate, groups ? *groups : Groups<D>{}, put);
  };
  std::visit(write, loaded.environment);
  if (is_written) return fmt::format("/proc/{}/fd/{}", getpid(), descriptor);
  close(descriptor);
  return {};
}

std::optional<Loaded_environment> map_kept(const std::string& name) {
  if (name.empty()) return std::nullopt;
  try {
    Build_options options;
    options.keep_map = false;
    return load_environment(name, options);
  } catch (const Error&) {  // a node whose processes do not see each other
    return std::nullopt;
  }
}

}  // namespace

Loaded_environment once_a_node(Ranks& ranks, const std::function<Loaded_environment()>& make) {
  if (!ranks.shares_node()) return make();
  if (!ranks.is_first_on_node()) {
    std::optional<Loaded_environment> mapped = map_kept(ranks.broadcast_on_node({}));
    return mapped ? std::move(*mapped) : make();
  }
  Loaded_environment own = make();
  const std::string name = keep_for_node(own);
  ranks.broadcast_on_node(name);
  if (auto mapped = map_kept(name)) own.environment = std::move(mapped->environment);
  return own;
}

Loaded_environment load_once_a_node(Ranks& ranks, const std::string& path, const Build_options& options) {
  const auto load = [&] { return load_with_progress(path, options); };
  if (options.keep_map || is_compiled_file(path)) return load();
  return once_a_node(ranks, load);
}

}  // namespace cellwalk::cli
