// SPDX-License-Identifier: LGPL-3.0-or-later
// The choice between a compiled file, cells that are built, and a surface that is meshed first.
#include <cellwalk/internal/environment/groups.h>
#include <cellwalk/loading/environment_file.h>

#include <fmt/core.h>

#include "compiled_file.h"

namespace cellwalk {
namespace {

/// \param soup of the file
template <int D>
Loaded_environment build_as_it_stands(Cell_soup<D>& soup, const Build_options& options, io::Mesh_file& file) {
  const Group_places<D> places(soup, file.groups);
  Build_report report;
  auto environment = Environment<D>::build(std::move(soup), options, &report);
  if (report.flipped)
    throw Error(Error_code::not_certified,
                "every cell is inverted; `cellwalk import` turns them round and writes an environment");
  Groups<D> groups = places.find(environment.snapshot(), report.origin);
  return {std::move(environment), std::move(report), std::move(file.report), std::move(groups)};
}

template <int D>
bool has_simplices_only(const Snapshot<D>& snapshot) {
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    if (const Cell c = snapshot.cell(i); c != Cell::none && snapshot.view(c).vertex_count() != D + 1)
      return false;
  return true;
}

template <int D>
Loaded_environment as_loaded(Compiled_environment<D> compiled, const Build_options& options) {
  if (options.keep_map) compiled.environment.thaw();
  const Snapshot<D>& snapshot = compiled.environment.snapshot();
  Build_report built;
  built.cells_read = snapshot.cell_count();
  built.points_read = compiled.certificate.vertices;
  built.certificate = compiled.certificate;
  io::Read_report read{compiled_format, built.points_read, built.cells_read, 0, {}};
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    if (const Cell c = snapshot.cell(i); c != Cell::none) read.facets += snapshot.facet_count(c);
  return {std::move(compiled.environment), std::move(built), std::move(read), std::move(compiled.groups),
          true};
}

}  // namespace

Loaded_environment load_environment(const std::string& path, Build_options options) {
  options.split = false;
  const Cells_input input(path);
  if (input.is_compiled()) {
    Any_compiled_environment compiled = input.open();
    const bool is_fit =
        !options.simplicial ||
        std::visit([](const auto& known) { return has_simplices_only(known.environment.snapshot()); },
                   compiled);
    if (is_fit)
      return naming(path, [&] {
        return std::visit([&](auto& known) { return as_loaded(std::move(known), options); }, compiled);
      });
  }
  io::Mesh_file file = input.mesh();
  return naming(path, [&]() -> Loaded_environment {
    if (auto* soup = std::get_if<Cell_soup<3>>(&file.mesh)) return build_as_it_stands(*soup, options, file);
    if (auto* soup = std::get_if<Cell_soup<2>>(&file.mesh)) return build_as_it_stands(*soup, options, file);
    throw Error(Error_code::input,
                fmt::format("holds a {}, no cells; make an environment of it with `cellwalk import`",
                            io::kind_name(file.mesh)));
  });
}

}  // namespace cellwalk
