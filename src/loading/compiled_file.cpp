// SPDX-License-Identifier: LGPL-3.0-or-later
#include "compiled_file.h"

#include <cellwalk/internal/io/mapped_file.h>
#include <cellwalk/io/ovm.h>
#include <cellwalk/loading/environment_file.h>

#include <algorithm>
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

/// Takes the unused names out of an environment, and follows with what refers to it.
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

bool is_compiled_file(const std::string& path) {
  return is_compiled_name(path) || io::begins_with(path, "CELLWALK");
}

Any_compiled_environment open_compiled_file(const std::string& path) {
  io::Mapped_file file = io::map_file(path);
  return naming(path, [&] { return open_compiled({file.bytes, std::move(file.owner)}); });
}

io::Mesh_file read_compiled(const std::string& path) {
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
      open_compiled_file(path));
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

template void write_environment(io::Atomic_file&, Environment<2>&, const Certificate&, Groups<2>);
template void write_environment(io::Atomic_file&, Environment<3>&, const Certificate&, Groups<3>);

}  // namespace cellwalk
