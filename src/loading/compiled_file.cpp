// SPDX-License-Identifier: LGPL-3.0-or-later
// The mapping of compiled files, and the compaction of an environment before it is written.
#include "compiled_file.h"

#include <cellwalk/internal/io/ovm_writer.h>
#include <cellwalk/internal/loading/environment_writer.h>
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/loading/environment_file.h>

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

namespace cellwalk {
namespace {

template <int D>
bool has_unused_names(const Snapshot<D>& snapshot) {
  if (snapshot.cell_slots() != snapshot.cell_count()) return true;
  for (std::uint32_t p = 0; p < snapshot.points().size(); ++p)
    if (!snapshot.is_point(p)) return true;
  return false;
}

/// Takes the unused names out of an environment, and renames the members of groups.
template <int D>
void compact(Environment<D>& environment, Groups<D>& groups) {
  const Compaction names = environment.compact();
  for (auto& [name, group] : groups) {
    for (Half_facet& facet : group.facets) facet = names.half_facets[to_index(facet)];
    for (Cell& cell : group.cells) cell = names.cells[to_index(cell)];
  }
}

}  // namespace

bool is_compiled_name(const std::filesystem::path& path) { return path.extension() == ".cellwalk"; }

namespace {

constexpr std::string_view beginning = "CELLWALK";

std::string_view text_of(const io::Mapped_file& file) {
  return {reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size()};
}

}  // namespace

bool is_compiled_file(const std::string& path) {
  return is_compiled_name(path) || io::begins_with(path, beginning);
}

Cells_input::Cells_input(std::string path) : path_(std::move(path)) {
  std::error_code none;
  const auto status = std::filesystem::status(path_, none);
  const bool is_pipe = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
                       !std::filesystem::is_directory(status);
  if (is_pipe) pipe_ = io::map_file(path_);
  is_compiled_ = pipe_ ? text_of(*pipe_).starts_with(beginning) : is_compiled_file(path_);
}

Any_compiled_environment Cells_input::open() const {
  io::Mapped_file file = pipe_ ? *pipe_ : io::map_file(path_);
  return naming(path_, [&] { return open_compiled({file.bytes, std::move(file.owner)}); });
}

io::Mesh_file Cells_input::mesh() const {
  if (!is_compiled_) return pipe_ ? io::read_mesh(path_, std::string(text_of(*pipe_))) : io::read_mesh(path_);
  return std::visit(
      []<int D>(const Compiled_environment<D>& compiled) {
        const Snapshot<D>& snapshot = compiled.environment.snapshot();
        io::Mesh_file file;
        file.groups = soup_groups(snapshot, compiled.groups);
        Cell_soup<D> soup = compiled.environment.soup();
        file.report = {compiled_format, soup.points.size(), soup.cell_count(), soup.facet_count(), {}};
        file.mesh = std::move(soup);
        return file;
      },
      open());
}

template <int D>
void write_environment(io::Atomic_file& file, Environment<D>& environment, const Certificate& certificate,
                       Groups<D> groups) {
  if (!is_compiled_name(file.destination())) {
    io::write_ovm(file, environment.soup(), soup_groups(environment.snapshot(), groups));
    return;
  }
  if (has_unused_names(environment.snapshot())) compact(environment, groups);
  write_compiled<D>(environment, certificate, groups, [&](std::span<const std::byte> part) {
    file.write({reinterpret_cast<const char*>(part.data()), part.size()});
  });
}

template <int D>
void write_environment(const std::filesystem::path& path, Environment<D>& environment,
                       const Certificate& certificate, const Groups<D>& groups) {
  io::Atomic_file file(path);
  write_environment<D>(file, environment, certificate, groups);
  file.commit();
}

template void write_environment(io::Atomic_file&, Environment<2>&, const Certificate&, Groups<2>);
template void write_environment(io::Atomic_file&, Environment<3>&, const Certificate&, Groups<3>);
template void write_environment(const std::filesystem::path&, Environment<2>&, const Certificate&,
                                const Groups<2>&);
template void write_environment(const std::filesystem::path&, Environment<3>&, const Certificate&,
                                const Groups<3>&);

}  // namespace cellwalk
